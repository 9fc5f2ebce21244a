//! The planner as a whole, from tracks to a command, by situations worked by hand.

use zhuyi_core::stages::Planner;
use zhuyi_core::{
    Across, ActorId, Along, Body, Command, Footprint, Forecast, Frenet, Lane, Manoeuvre, Pose,
    Road, SimTime, Track, Trajectory,
};
use zhuyi_planner::{PlannerParams, RuleBasedPlanner};

fn params() -> PlannerParams {
    PlannerParams {
        time_headway: 1.0,
        min_gap: 3.0,
        max_accel: 1.5,
        comfortable_decel: 3.0,
        exponent: 4.0,
        comfort_decel_limit: 1.0,
        brake_above: 3.0,
        release_below: 1.0,
        max_decel: 4.0,
        evade_above: 6.0,
        standstill_gap: 3.0,
        anticipation: 0.5,
        lateral_margin: 0.2,
        evasion_lateral_accel: 5.0,
        safe_decel: 4.0,
        lateral_gain: 1.0,
        heading_gain: 1.5,
    }
}

const BOX: Footprint = Footprint {
    length: 4.6,
    width: 1.8,
};

fn road() -> Road {
    Road::straight(2000.0, 3, 3.5).expect("a road")
}

fn ego(speed: f64) -> Body {
    let road = Frenet { s: 100.0, d: 0.0 };
    Body {
        footprint: BOX,
        road,
        pose: Pose::new(100.0, 0.0, 0.0),
        turn: 0.0,
        extent: BOX,
        speed,
        accel: 0.0,
        s_rate: speed,
        d_rate: 0.0,
    }
}

/// A track whose rear bumper is `gap` metres ahead of the ego's front bumper.
fn track(gap: f64, d: f64, speed: f64, d_rate: f64) -> Track {
    Track {
        actor: ActorId(0),
        time: SimTime::ZERO,
        seen: SimTime::ZERO,
        footprint: BOX,
        road: Frenet {
            s: 100.0 + BOX.length + gap,
            d,
        },
        turn: 0.0,
        extent: BOX,
        s_rate: speed,
        s_accel: 0.0,
        d_rate,
        s_deviation: 0.1,
        d_deviation: 0.1,
    }
}

fn forecast(track: &Track) -> Forecast {
    let trajectory = Trajectory {
        along: vec![Along::constant_accel(0.0, track.road.s, track.s_rate, 0.0)],
        across: vec![Across {
            time: 0.0,
            d: track.road.d,
            d_rate: track.d_rate,
        }],
        extents: Vec::new(),
        known_until: f64::INFINITY,
    };
    Forecast {
        actor: track.actor,
        footprint: track.footprint,
        trajectories: vec![(1.0, trajectory)],
    }
}

fn plan(speed: f64, tracks: &[Track]) -> Command {
    let (params, road) = (params(), road());
    let forecasts: Vec<_> = tracks.iter().map(forecast).collect();
    RuleBasedPlanner::new(&params, road.clone(), Lane(2), speed).plan(
        SimTime::ZERO,
        &ego(speed),
        tracks,
        &forecasts,
    )
}

#[test]
fn hand_an_empty_road_at_the_desired_speed_asks_for_nothing() {
    let command = plan(20.0, &[]);
    assert_eq!(
        (command.accel, command.curvature, command.manoeuvre),
        (0.0, 0.0, Manoeuvre::Follow)
    );
}

#[test]
fn hand_comfort_ends_at_its_limit() {
    // 20 m/s towards a standing car at 85 m: car following wants 1.5 (1 - (117.3 / 85)^2) = -1.36, required are 400 / 164 = 2.4.
    let command = plan(20.0, &[track(85.0, 0.0, 0.0, 0.0)]);
    assert_eq!(
        (command.accel, command.manoeuvre),
        (-1.0, Manoeuvre::Follow)
    );
}

#[test]
fn hand_hard_braking_asks_for_what_is_required() {
    // 20 m/s, standing car at 60 m, 3 m to spare: 400 / (2 x 57) = 3.51.
    let command = plan(20.0, &[track(60.0, 0.0, 0.0, 0.0)]);
    assert!((command.accel + 400.0 / 114.0).abs() < 1e-12);
    assert_eq!(command.manoeuvre, Manoeuvre::Brake);
}

#[test]
fn hand_neighbours_are_ignored_until_they_come_over() {
    assert_eq!(plan(20.0, &[track(40.0, -3.5, 0.0, 0.0)]).accel, 0.0);
    // Half a second at 3.2 m/s brings the box to 1.9 m, within 1.8 + 0.2: in the way.
    assert_eq!(
        plan(20.0, &[track(40.0, -3.5, 0.0, 3.2)]).manoeuvre,
        Manoeuvre::Brake
    );
    assert_eq!(
        plan(20.0, &[track(40.0, -3.5, 0.0, 2.9)]).manoeuvre,
        Manoeuvre::Follow
    );
}

#[test]
fn hand_what_is_behind_does_not_brake_the_ego() {
    assert_eq!(plan(20.0, &[track(-30.0, 0.0, 30.0, 0.0)]).accel, 0.0);
}

/// 20 m/s, a standing car 30 m ahead: 400 / 60 = 6.7 m/s2, more than 6.
fn wall() -> Track {
    track(30.0, 0.0, 0.0, 0.0)
}

#[test]
fn hand_what_braking_cannot_avoid_is_evaded_to_the_left() {
    let command = plan(20.0, &[wall()]);
    assert_eq!(command.manoeuvre, Manoeuvre::Evade);
    let brakes = plan(20.0, &[track(34.0, 0.0, 0.0, 0.0)]); // 400 / 68 = 5.9
    assert_eq!(brakes.manoeuvre, Manoeuvre::Brake);
}

#[test]
fn hand_a_blocked_lane_is_not_taken() {
    let manoeuvre = |side: &[Track]| plan(20.0, &[&[wall()], side].concat()).manoeuvre;
    let (left, right) = (track(-5.0, 3.5, 20.0, 0.0), track(-5.0, -3.5, 20.0, 0.0)); // alongside
    assert_eq!(manoeuvre(&[left]), Manoeuvre::Evade); // to the right
    assert_eq!(manoeuvre(&[left, right]), Manoeuvre::Brake);
    // A fast follower close behind in the new lane would have to brake harder than b_safe; one far behind would not.
    let chaser = |gap: f64| track(-9.2 - gap, 3.5, 30.0, 0.0);
    assert_eq!(manoeuvre(&[chaser(20.0), right]), Manoeuvre::Brake);
    assert_eq!(manoeuvre(&[chaser(120.0), right]), Manoeuvre::Evade);
    // A standing car in the new lane as near as the one in the old.
    assert_eq!(
        manoeuvre(&[track(30.0, 3.5, 0.0, 0.0), right]),
        Manoeuvre::Brake
    );
}

#[test]
fn hand_an_evasion_that_comes_too_late_is_not_begun() {
    // 8 m ahead: 0.4 s to get there, 1.1 s to be out of its way.
    assert_eq!(
        plan(20.0, &[track(8.0, 0.0, 0.0, 0.0)]).manoeuvre,
        Manoeuvre::Brake
    );
}

#[test]
fn law_the_steering_returns_to_the_lane() {
    let (params, road) = (params(), road());
    let mut planner = RuleBasedPlanner::new(&params, road.clone(), Lane(2), 20.0);
    let aside = |d: f64| Body {
        road: Frenet { s: 100.0, d },
        ..ego(20.0)
    };
    assert!(planner.plan(SimTime::ZERO, &aside(0.5), &[], &[]).curvature < 0.0);
    assert!(
        planner
            .plan(SimTime::ZERO, &aside(-0.5), &[], &[])
            .curvature
            > 0.0
    );
}
