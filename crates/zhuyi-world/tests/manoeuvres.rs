//! Manoeuvres that interrupt others: the move across the road goes on without a jump, and each is known to have begun and ended.

use zhuyi_core::{Body, Command, Footprint, Frenet, Lane, Manoeuvre as Doing, Pose};
use zhuyi_core::{Road, Segment, SimTime};
use zhuyi_world::script::{Action, Actor, Behaviour, Manoeuvre, Place, Start as At, Trigger};
use zhuyi_world::{Ego, Progress, Start, Vehicle, World};

const STEP: SimTime = SimTime::from_millis(10);
/// [s] the same.
const DT: f64 = 0.01;

fn road() -> Road {
    let line = Segment::Line { length: 3000.0 };
    Road::new(Pose::default(), &[line], 3, 3.5).expect("a road")
}

fn change(at: f64, lane: u8, duration: f64) -> Manoeuvre {
    Manoeuvre {
        when: Trigger::Time(at),
        then: Action::ChangeLane {
            lane: Lane(lane),
            duration,
        },
    }
}

/// The body of an actor of these manoeuvres at every step, on a straight road 500 m ahead of an ego that stands.
fn bodies(lane: u8, speed: f64, manoeuvres: Vec<Manoeuvre>, seconds: f64) -> Vec<Body> {
    drive(lane, speed, manoeuvres, seconds).0
}

/// The same, with how far each manoeuvre came.
fn drive(
    lane: u8,
    speed: f64,
    manoeuvres: Vec<Manoeuvre>,
    seconds: f64,
) -> (Vec<Body>, Vec<Progress>) {
    let (road, vehicle) = (
        road(),
        Vehicle {
            footprint: Footprint {
                length: 4.8,
                width: 1.9,
            },
            mass: 1800.0,
            wheelbase: 2.8,
            accel_lag: 0.1,
            max_jerk: 50.0,
            max_accel: 3.0,
            max_decel: 9.0,
            friction: 0.9,
            steering_lag: 0.1,
            max_steering: 0.6,
            max_steering_rate: 0.7,
        },
    );
    let actor = Actor {
        name: "a".into(),
        footprint: Footprint {
            length: 4.6,
            width: 1.85,
        },
        mass: 1600.0,
        start: At {
            lane: Lane(lane),
            along: Place::At(600.0),
        },
        speed,
        behaviour: Behaviour::Cruise,
        manoeuvres,
    };
    let ego = Ego {
        road: Frenet { s: 100.0, d: 0.0 },
        heading: 0.0,
        speed: 0.0,
        accel: 0.0,
        steering: 0.0,
    };
    let starts = [Start::of(&actor, &ego, &vehicle)];
    let actors = [actor];
    let mut world = World::new(road.clone(), &vehicle, &actors, ego, &starts);
    let mut bodies = vec![world.scene().actors[0]];
    for _ in 0..(seconds / DT).round() as usize {
        let stand = Command {
            accel: 0.0,
            curvature: 0.0,
            manoeuvre: Doing::Follow,
        };
        assert!(world.step(stand, STEP).is_none());
        bodies.push(world.scene().actors[0]);
    }
    (bodies, world.progress(false).remove(0))
}

/// A car turns back half-way: its speed of 1.64 m/s to the side and its heading of 0.061 rad once vanished within a step.
#[test]
fn regress_a_lane_change_back_half_way_goes_on_from_where_it_is() {
    let script = vec![change(2.0, 2, 4.0), change(4.0, 1, 4.0)];
    let bodies = bodies(1, 26.8224, script, 12.0);
    let at = |time: f64| &bodies[(time / DT).round() as usize];
    // 15/8 x 3.5 m / 4 s at half-way.
    assert!((at(4.0).d_rate - 1.640_625).abs() < 1e-9);
    assert!((at(4.01).d_rate - 1.640_625).abs() < 0.01);
    assert!((at(4.01).pose.heading - at(4.0).pose.heading).abs() < 1e-3);
    // It goes on to the left by T v_0 times the largest x - 6 x^3 + 8 x^4 - 3 x^5 less the way back, then comes home.
    let farthest = bodies.iter().map(|body| body.road.d).fold(-3.5, f64::max);
    assert!(farthest > -1.75 && farthest < 0.0, "{farthest}");
    let home = at(8.01);
    assert!((home.road.d + 3.5).abs() < 1e-12, "{home:?}");
    assert_eq!((home.d_rate, home.pose.heading), (0.0, 0.0));
}

/// Offset, speed to the side and heading never jump, whenever one lane change interrupts another, also below 5 m/s, where the
/// clock of lane changes goes by the way.
#[test]
fn law_lateral_motion_is_continuous_over_interruptions() {
    let mut drawn = (1..).map(|i| f64::from(i) * 0.618_033_988_749_894_9 % 1.0);
    let mut draw = |low: f64, high: f64| low + (high - low) * drawn.next().unwrap_or(0.5);
    for case in 0..60 {
        let speed = if case % 3 == 0 {
            draw(0.5, 5.0)
        } else {
            draw(5.0, 35.0)
        };
        let (mut lane, mut time, mut script) = (2, 0.5, Vec::new());
        for _ in 0..4 {
            lane = 1 + (lane + draw(0.0, 2.0) as u8) % 3;
            script.push(change(time, lane, draw(2.0, 5.0)));
            time += draw(0.3, 2.5);
        }
        script.push(Manoeuvre {
            when: Trigger::Time(time),
            then: Action::Brake { decel: 4.0 },
        });
        let bodies = bodies(2, speed, script.clone(), 12.0);
        for pair in bodies.windows(2) {
            let (before, after) = (&pair[0], &pair[1]);
            // The way of a step is its mean speed, and that changes by no more than the largest acceleration of the quintics.
            let way = after.road.d - before.road.d;
            let mean = f64::midpoint(before.d_rate, after.d_rate);
            assert!(
                (way - mean * DT).abs() < 1e-4,
                "{way} {mean} in {script:?} at {speed} m/s"
            );
            assert!(
                (after.d_rate - before.d_rate).abs() < 0.25,
                "{} to {} in {script:?} at {speed} m/s",
                before.d_rate,
                after.d_rate
            );
            assert!((after.pose.heading - before.pose.heading).abs() < 0.05);
        }
    }
}

fn at(time: f64, then: Action) -> Manoeuvre {
    let when = Trigger::Time(time);
    Manoeuvre { when, then }
}

/// A lane change ends in its lane, `ReachSpeed` at its speed, `Brake` at standstill, `Behave` at once; what another of its kind
/// takes over ends there, and what is under way at the end has no end.
#[test]
fn hand_manoeuvres_begin_and_end_where_they_should() {
    let millis = SimTime::from_millis;
    let ended = |began, ended| Progress::Ended {
        began: millis(began),
        ended: millis(ended),
    };
    let replaced = |began, ended| Progress::Replaced {
        began: millis(began),
        ended: millis(ended),
    };
    let reach = |speed, accel| Action::ReachSpeed { speed, accel };
    let never = Manoeuvre {
        when: Trigger::GapToEgo(0.0),
        then: Action::Brake { decel: 1.0 },
    };
    let (_, progress) = drive(
        1,
        20.0,
        vec![
            at(0.5, reach(24.0, 2.0)), // 2 s
            change(1.0, 2, 3.0),
            at(3.0, reach(14.0, 2.0)),             // would take 5 s
            at(4.0, Action::Brake { decel: 8.0 }), // from 22 m/s: 2.75 s
            change(4.5, 1, 2.0),
            at(6.9, Action::Behave(Behaviour::Cruise)),
            at(7.0, reach(1.0, 0.25)), // not there at 8 s
            never,
        ],
        8.0,
    );
    // 22 - 8 x 0.5 = 18 m/s at 4.5 s, 5 m/s at 6.125 s; behind that the clock of lane changes slows down: 1.625 s of 2 s are
    // done then, and (6.75 - 6.125) / 2 s more until it stands: it never arrives.
    let expected = [
        ended(500, 2500),
        ended(1000, 4000),
        replaced(3000, 4000),
        ended(4000, 6750),
        Progress::UnderWay {
            began: millis(4500),
        },
        ended(6900, 6900),
        Progress::UnderWay {
            began: millis(7000),
        },
        Progress::Waiting,
    ];
    assert_eq!(progress, expected);
    assert_eq!(progress[7].began(), None);
    assert_eq!(
        (progress[2].began(), progress[2].ended()),
        (Some(millis(3000)), Some(millis(4000)))
    );
}

/// What is reached at the last step of a run has ended.
#[test]
fn hand_a_manoeuvre_that_ends_with_the_run_has_ended() {
    let (_, progress) = drive(1, 20.0, vec![change(1.0, 2, 3.0)], 4.0);
    assert_eq!(progress[0].ended(), Some(SimTime::from_seconds(4.0)));
    let (_, progress) = drive(1, 20.0, vec![change(1.0, 2, 3.0)], 3.99);
    assert_eq!(progress[0].ended(), None);
}
