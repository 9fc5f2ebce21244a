//! Scripted and reactive actors, each behaviour, trigger and action by a case worked by hand.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

use zhuyi_core::idm::Idm;
use zhuyi_core::{
    ActorId, Command, Footprint, Frenet, Lane, Manoeuvre as Doing, Pose, Road, Segment, SimTime,
};
use zhuyi_world::script::{
    Action, Actor, Behaviour, Manoeuvre, Place, Start as At, Station, Trigger,
};
use zhuyi_world::{Ego, Start, Vehicle, World};

const STEP: SimTime = SimTime::from_millis(10);

fn vehicle() -> Vehicle {
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
    }
}

fn road(curvature: f64) -> Road {
    let line = if curvature == 0.0 {
        Segment::Line { length: 2000.0 }
    } else {
        Segment::Arc {
            length: 600.0,
            curvature,
        }
    };
    Road::new(Pose::default(), &[line], 3, 3.5).expect("a road")
}

fn actor(
    lane: u8,
    along: Place,
    speed: f64,
    behaviour: Behaviour,
    manoeuvres: Vec<Manoeuvre>,
) -> Actor {
    Actor {
        name: "a".into(),
        footprint: Footprint {
            length: 4.6,
            width: 1.85,
        },
        mass: 1600.0,
        start: At {
            lane: Lane(lane),
            along,
        },
        speed,
        behaviour,
        manoeuvres,
    }
}

/// Runs `actors` beside an ego in the middle lane at `speed` that is told `accel`; hands every scene to `look`.
fn drive(
    road: &Road,
    actors: &[Actor],
    speed: f64,
    accel: impl Fn(f64) -> f64,
    seconds: f64,
    mut look: impl FnMut(&zhuyi_core::Scene),
) -> Option<ActorId> {
    let vehicle = vehicle();
    let ego = Ego {
        road: Frenet { s: 100.0, d: 0.0 },
        heading: 0.0,
        speed,
        accel: 0.0,
        steering: 0.0,
    };
    let starts: Vec<_> = actors
        .iter()
        .map(|a| Start::of(a, &ego, &vehicle))
        .collect();
    let mut world = World::new(road.clone(), &vehicle, actors, ego, &starts);
    look(world.scene());
    for step in 0..(seconds * 100.0) as i64 {
        let now = STEP.seconds() * step as f64;
        let curvature = road.curvature(world.scene().ego.road.s);
        let contact = world.step(
            Command {
                accel: accel(now),
                curvature,
                manoeuvre: Doing::Follow,
            },
            STEP,
        );
        look(world.scene());
        if let Some(contact) = contact {
            return Some(contact.actor);
        }
    }
    None
}

fn at(when: Trigger, then: Action) -> Manoeuvre {
    Manoeuvre { when, then }
}

#[test]
fn hand_starts_are_bumper_to_bumper() {
    let road = road(0.0);
    let places = [
        (Place::Ahead(20.0), 124.7),
        (Place::Behind(5.0), 90.3),
        (Place::Beside(-3.0), 97.0),
        (Place::At(7.0), 7.0),
    ];
    for (place, centre) in places {
        let actors = [actor(1, place, 10.0, Behaviour::Cruise, vec![])];
        drive(
            &road,
            &actors,
            10.0,
            |_| 0.0,
            0.0,
            |scene| {
                assert!((scene.actors[0].road.s - centre).abs() < 1e-12);
                assert_eq!(scene.actors[0].road.d, -3.5);
            },
        );
    }
}

#[test]
fn hand_brake_ends_at_v_squared_over_2b() {
    let script = vec![at(Trigger::Time(1.0), Action::Brake { decel: 4.0 })];
    let actors = [actor(1, Place::At(200.0), 20.0, Behaviour::Cruise, script)];
    let mut end = 0.0;
    drive(
        &road(0.0),
        &actors,
        5.0,
        |_| 0.0,
        8.0,
        |scene| end = scene.actors[0].road.s,
    );
    assert!((end - (200.0 + 20.0 + 50.0)).abs() < 1e-6, "{end}");
}

#[test]
fn hand_reach_speed_takes_dv_over_a() {
    let script = vec![at(
        Trigger::Time(0.0),
        Action::ReachSpeed {
            speed: 12.0,
            accel: 2.0,
        },
    )];
    let actors = [actor(1, Place::At(200.0), 20.0, Behaviour::Cruise, script)];
    drive(
        &road(0.0),
        &actors,
        5.0,
        |_| 0.0,
        6.0,
        |scene| {
            let expected = (20.0 - 2.0 * scene.time.seconds()).max(12.0);
            assert!((scene.actors[0].speed - expected).abs() < 1e-9);
        },
    );
}

#[test]
fn hand_a_lane_change_takes_its_duration_and_ends_in_the_lane() {
    let script = vec![at(
        Trigger::Time(0.5),
        Action::ChangeLane {
            lane: Lane(3),
            duration: 3.0,
        },
    )];
    let actors = [actor(
        2,
        Place::Ahead(30.0),
        20.0,
        Behaviour::Cruise,
        script,
    )];
    drive(
        &road(0.0),
        &actors,
        20.0,
        |_| 0.0,
        5.0,
        |scene| {
            let (t, body) = (scene.time.seconds(), &scene.actors[0]);
            if t <= 0.5 {
                assert_eq!(body.road.d, 0.0);
            } else if t >= 3.5 {
                assert!((body.road.d - 3.5).abs() < 1e-12 && body.d_rate.abs() < 1e-9);
            } else if (t - 2.0).abs() < 1e-9 {
                assert!((body.road.d - 1.75).abs() < 1e-9); // half-way at half time
            }
        },
    );
}

#[test]
fn hand_triggers_fire_at_their_thresholds() {
    // The ego closes at 10 m/s on a gap of 50 m: 30 m after 2 s, TTC 2 s after 3 s.
    let cases = [
        (Trigger::GapToEgo(30.0), 2.0),
        (Trigger::TimeToCollision(2.0), 3.0),
        (Trigger::Time(1.25), 1.25),
    ];
    for (trigger, expected) in cases {
        let script = vec![at(trigger, Action::Brake { decel: 1.0 })];
        let actors = [actor(
            1,
            Place::Ahead(50.0),
            10.0,
            Behaviour::Cruise,
            script,
        )];
        let mut began = None;
        drive(
            &road(0.0),
            &actors,
            20.0,
            |_| 0.0,
            4.0,
            |scene| {
                if scene.actors[0].accel < 0.0 && began.is_none() {
                    began = Some(scene.time.seconds() - 0.01);
                }
            },
        );
        let began = began.expect("the trigger fires");
        assert!((began - expected).abs() < 0.011, "{trigger:?} at {began}");
    }
}

/// Side by side in another lane there is no time to collision: a trigger of it once fired at 0 s. A gap at most a number is
/// there all the same: it is negative.
#[test]
fn regress_side_by_side_there_is_no_time_to_collision() {
    let brakes = |trigger| {
        let script = vec![at(trigger, Action::Brake { decel: 3.0 })];
        let actors = [actor(
            1,
            Place::Beside(-1.0),
            20.5,
            Behaviour::Cruise,
            script,
        )];
        let mut brakes = false;
        drive(
            &road(0.0),
            &actors,
            20.0,
            |_| 0.0,
            5.0,
            |scene| brakes |= scene.actors[0].accel < 0.0,
        );
        brakes
    };
    assert!(!brakes(Trigger::TimeToCollision(0.1)));
    assert!(brakes(Trigger::GapToEgo(0.0)));
}

#[test]
fn hand_distance_to_another_actor_is_centre_to_centre() {
    let script = vec![at(
        Trigger::DistanceTo {
            actor: ActorId(1),
            distance: 40.0,
        },
        Action::Brake { decel: 1.0 },
    )];
    let actors = [
        actor(1, Place::At(200.0), 10.0, Behaviour::Cruise, script),
        actor(1, Place::At(270.0), 0.0, Behaviour::Obstacle, vec![]),
    ];
    let mut began = None;
    drive(
        &road(0.0),
        &actors,
        5.0,
        |_| 0.0,
        4.0,
        |scene| {
            if scene.actors[0].accel < 0.0 && began.is_none() {
                began = Some(scene.time.seconds());
            }
        },
    );
    assert!((began.expect("fires") - 3.01).abs() < 0.011);
}

fn follower() -> Behaviour {
    let driver = Idm {
        desired_speed: 30.0,
        time_headway: 1.2,
        min_gap: 2.0,
        max_accel: 1.5,
        comfortable_decel: 2.0,
        exponent: 4.0,
    };
    Behaviour::Follow {
        driver,
        max_decel: 8.0,
    }
}

#[test]
fn law_a_follower_does_not_rear_end_a_braking_ego() {
    for speed in [9.0, 18.0, 31.0] {
        for decel in [2.0, 4.75, 9.0] {
            let gap = 2.0 + 1.2 * speed;
            let actors = [actor(2, Place::Behind(gap), speed, follower(), vec![])];
            let mut smallest = gap;
            let hit = drive(
                &road(0.0),
                &actors,
                speed,
                |t| if t < 1.0 { 0.0 } else { -decel },
                20.0,
                |scene| {
                    let gap = scene.ego.rear() - scene.actors[0].front();
                    if gap < smallest {
                        smallest = gap;
                    }
                },
            );
            assert!(
                hit.is_none() && smallest > 0.3,
                "at {speed} m/s, {decel} m/s2: {smallest} m"
            );
        }
    }
}

#[test]
fn law_a_car_that_holds_beside_stays_beside_a_braking_ego() {
    let station = Station {
        offset: 1.0,
        max_accel: 3.0,
        max_decel: 7.0,
    };
    let actors = [actor(
        3,
        Place::Beside(1.0),
        18.0,
        Behaviour::HoldBeside(station),
        vec![],
    )];
    drive(
        &road(0.0),
        &actors,
        18.0,
        |t| if t < 2.0 { 0.0 } else { -4.75 },
        12.0,
        |scene| {
            let offset = scene.actors[0].road.s - scene.ego.road.s;
            assert!((offset - 1.0).abs() < 1.5, "{offset} at {:?}", scene.time);
        },
    );
}

#[test]
fn hand_on_a_curve_the_inner_lane_advances_faster_along_the_reference_line() {
    // Radius 200 m to the left; left lane at d = 3.5: 10 m/s for 10 s are 100 m x 200 / 196.5 of the reference line.
    let actors = [actor(3, Place::At(200.0), 10.0, Behaviour::Cruise, vec![])];
    let mut end = 0.0;
    drive(
        &road(1.0 / 200.0),
        &actors,
        5.0,
        |_| 0.0,
        10.0,
        |scene| end = scene.actors[0].road.s,
    );
    assert!(
        (end - (200.0 + 100.0 * 200.0 / 196.5)).abs() < 1e-6,
        "{end}"
    );
}

#[test]
fn law_the_scene_within_a_step_joins_its_ends() {
    let script = vec![at(
        Trigger::Time(0.0),
        Action::ChangeLane {
            lane: Lane(3),
            duration: 2.0,
        },
    )];
    let actors = [actor(
        2,
        Place::Ahead(30.0),
        20.0,
        Behaviour::Cruise,
        script,
    )];
    let (road, vehicle) = (road(0.002), vehicle());
    let ego = Ego {
        road: Frenet { s: 100.0, d: 0.0 },
        heading: 0.0,
        speed: 20.0,
        accel: 0.0,
        steering: 0.0,
    };
    let starts = [Start::of(&actors[0], &ego, &vehicle)];
    let mut world = World::new(road.clone(), &vehicle, &actors, ego, &starts);
    for _ in 0..50 {
        let before = world.scene().clone();
        world.step(
            Command {
                accel: -3.0,
                curvature: 0.003,
                manoeuvre: Doing::Follow,
            },
            STEP,
        );
        let mut scene = before.clone();
        world.scene_at(before.time, &mut scene);
        for (a, b) in std::iter::once((&scene.ego, &before.ego))
            .chain(scene.actors.iter().zip(&before.actors))
        {
            assert!((a.road.s - b.road.s).abs() < 1e-9 && (a.road.d - b.road.d).abs() < 1e-9);
        }
        let after = world.scene().clone();
        world.scene_at(after.time, &mut scene);
        assert_eq!(scene, after);
    }
}

#[test]
fn hand_a_car_that_stops_in_a_lane_change_stays_where_it_is() {
    // 8 m/s at 8 m/s2: stands after 1 s of a change that takes 6 s.
    let script = vec![
        at(
            Trigger::Time(0.0),
            Action::ChangeLane {
                lane: Lane(3),
                duration: 6.0,
            },
        ),
        at(Trigger::Time(0.0), Action::Brake { decel: 8.0 }),
    ];
    let actors = [actor(2, Place::Ahead(30.0), 8.0, Behaviour::Cruise, script)];
    let mut stopped = None;
    drive(
        &road(0.0),
        &actors,
        1.0,
        |_| 0.0,
        4.0,
        |scene| {
            let body = &scene.actors[0];
            if scene.time.seconds() > 1.02 {
                assert_eq!((body.speed, body.d_rate), (0.0, 0.0));
                assert_eq!(*stopped.get_or_insert(body.road.d), body.road.d);
            }
        },
    );
    assert!(stopped.expect("it stops") < 0.2);
}

#[test]
fn regress_a_car_that_stops_in_a_lane_change_does_not_spin() {
    // Half-way across at 3.3 m/s to the side it comes to a stand; its heading once went to 90 degrees and back in a step.
    let script = vec![
        at(
            Trigger::Time(0.0),
            Action::ChangeLane {
                lane: Lane(3),
                duration: 2.0,
            },
        ),
        at(Trigger::Time(0.5), Action::Brake { decel: 8.0 }),
        at(
            Trigger::Time(3.0),
            Action::ReachSpeed {
                speed: 8.0,
                accel: 2.0,
            },
        ),
    ];
    let actors = [actor(2, Place::Ahead(30.0), 8.0, Behaviour::Cruise, script)];
    let mut before: Option<f64> = None;
    let mut stood = 0.0;
    drive(
        &road(0.0),
        &actors,
        1.0,
        |_| 0.0,
        8.0,
        |scene| {
            let body = &scene.actors[0];
            let turned = (body.pose.heading - before.unwrap_or(0.0)).abs();
            assert!(turned < 0.02, "{turned} rad at {:?}", scene.time);
            if body.speed == 0.0 {
                stood = body.pose.heading;
            }
            before = Some(body.pose.heading);
        },
    );
    // atan(d'/v_w) with d' at most 15/8 x 3.5 m / 2 s.
    assert!(stood > 0.2 && stood < (3.28125_f64 / 5.0).atan());
    assert_eq!(before, Some(0.0));
}
