//! Lane changes that interrupt others: the move across the road goes on without a jump.

use zhuyi_core::{Body, Command, Footprint, Frenet, Lane, Manoeuvre as Doing, Pose};
use zhuyi_core::{Road, Segment, SimTime};
use zhuyi_world::script::{Action, Actor, Behaviour, Manoeuvre, Place, Start as At, Trigger};
use zhuyi_world::{Ego, Start, Vehicle, World};

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
    let mut world = World::new(&road, &vehicle, &actors, ego, &starts);
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
    bodies
}

/// A car turns back half-way: its speed of 1.64 m/s to the side and its heading of 0.061 rad once vanished within a step.
#[test]
fn regress_a_lane_change_back_half_way_goes_on_from_where_it_is() {
    let script = vec![change(2.0, 2, 4.0), change(4.0, 1, 4.0)];
    let bodies = bodies(1, 26.8224, script, 12.0);
    let at = |time: f64| &bodies[(time / DT).round() as usize];
    // 15/8 x 3.5 m / 4 s at half-way.
    assert!((at(4.0).d_rate - 1.640625).abs() < 1e-9);
    assert!((at(4.01).d_rate - 1.640625).abs() < 0.01);
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
