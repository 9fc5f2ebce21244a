//! Actors and the ego on a closed road: laps, leaders and distances round the seam.

use std::f64::consts::TAU;

use zhuyi_core::idm::Idm;
use zhuyi_core::{
    ActorId, Command, Footprint, Frenet, Lane, Manoeuvre as Doing, Pose, Road, Segment, SimTime,
};
use zhuyi_world::script::{Action, Actor, Behaviour, Manoeuvre, Place, Start as At, Trigger};
use zhuyi_world::{Ego, Start, Vehicle, World};

const STEP: SimTime = SimTime::from_millis(10);
const CAR: Footprint = Footprint {
    length: 4.6,
    width: 1.85,
};
/// [m] a lap of the ring.
const LAP: f64 = 400.0;

fn vehicle() -> Vehicle {
    Vehicle {
        footprint: CAR,
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

fn ring() -> Road {
    let circle = Segment::Arc {
        length: LAP,
        curvature: TAU / LAP,
    };
    Road::closed(Pose::default(), &[circle], 3, 3.5).expect("a ring")
}

fn actor(lane: u8, s: f64, speed: f64, behaviour: Behaviour) -> Actor {
    Actor {
        name: "a".into(),
        footprint: CAR,
        mass: 1600.0,
        start: At {
            lane: Lane(lane),
            along: Place::At(s),
        },
        speed,
        behaviour,
        manoeuvres: Vec::new(),
    }
}

fn follower() -> Behaviour {
    Behaviour::Follow {
        driver: Idm {
            desired_speed: 20.0,
            time_headway: 1.5,
            min_gap: 2.0,
            max_accel: 1.5,
            comfortable_decel: 2.0,
            exponent: 4.0,
        },
        max_decel: 9.0,
    }
}

/// Drives an ego in the middle lane from 10 m on at `speed` beside `actors`; hands every scene to `look`. Returns whom it
/// touched.
fn drive(
    road: &Road,
    actors: &[Actor],
    speed: f64,
    seconds: f64,
    mut look: impl FnMut(&zhuyi_core::Scene),
) -> Option<ActorId> {
    let vehicle = vehicle();
    let curvature = road.curvature(0.0);
    let ego = Ego {
        road: Frenet { s: 10.0, d: 0.0 },
        heading: -vehicle.slip_angle(vehicle.steering_for(curvature)),
        speed,
        accel: 0.0,
        steering: vehicle.steering_for(curvature),
    };
    let starts: Vec<_> = actors
        .iter()
        .map(|a| Start::of(a, &ego, &vehicle))
        .collect();
    let mut world = World::new(road.clone(), &vehicle, actors, ego, &starts);
    look(world.scene());
    let command = Command {
        accel: 0.0,
        curvature,
        manoeuvre: Doing::Follow,
    };
    for _ in 0..(seconds * 100.0) as u32 {
        let contact = world.step(command, STEP);
        look(world.scene());
        let (now, mut within) = (world.scene().time, world.scene().clone());
        world.scene_at(now, &mut within);
        assert_eq!(&within, world.scene());
        for (index, body) in within.actors.iter().enumerate() {
            assert_eq!(*body, world.actor_at(index, now));
        }
        if let Some(contact) = contact {
            return Some(contact.actor);
        }
    }
    None
}

#[test]
fn law_bodies_are_told_in_the_lap_nearest_to_the_ego() {
    // The ego laps a standing car in another lane three times and is lapped by a fast one; nothing but s jumps.
    let road = ring();
    let actors = [
        actor(1, 300.0, 0.0, Behaviour::Obstacle),
        actor(3, 390.0, 40.0, Behaviour::Cruise),
    ];
    let mut before: Option<zhuyi_core::Scene> = None;
    let (mut jumps, mut last) = (0, 0.0);
    let touched = drive(&road, &actors, 20.0, 60.0, |scene| {
        last = scene.ego.road.s;
        for (index, body) in scene.actors.iter().enumerate() {
            let way = body.road.s - scene.ego.road.s;
            assert!(way.abs() <= LAP / 2.0 + 1e-9, "{way}");
            let there = road.world_from_road(body.road);
            assert!(libm::hypot(there.x - body.pose.x, there.y - body.pose.y) < 1e-9);
            let Some(before) = &before else { continue };
            let was = &before.actors[index];
            let moved = body.road.s - was.road.s;
            jumps += u32::from(moved.abs() > LAP / 2.0);
            let laps = (moved / LAP).round() * LAP;
            assert!((moved - laps).abs() < 0.5, "{moved}");
            assert!(
                (body.pose.heading - was.pose.heading).abs() < 0.02,
                "it turns in a step"
            );
        }
        before = Some(scene.clone());
    });
    assert_eq!(touched, None);
    assert!(
        (last - (10.0 + 1200.0)).abs() < 5.0,
        "the ego counts on: {last}"
    );
    assert!(jumps >= 5, "{jumps}");
}

#[test]
fn hand_a_contact_across_the_seam_comes_when_it_should() {
    // Centres 40 m apart, boxes of 4.6 m: 35.4 m at 20 m/s.
    let actors = [actor(2, 50.0, 0.0, Behaviour::Obstacle)];
    let mut time = 0.0;
    let touched = drive(&ring(), &actors, 20.0, 60.0, |scene| {
        time = scene.time.seconds();
    });
    assert_eq!(touched, Some(ActorId(0)));
    assert!((time - 1.77).abs() < 0.03, "{time}");
    // Centres 30 m apart, but behind it: the rest of the lap.
    let actors = [actor(2, -20.0, 0.0, Behaviour::Obstacle)];
    let touched = drive(&ring(), &actors, 20.0, 60.0, |scene| {
        time = scene.time.seconds();
    });
    assert_eq!(touched, Some(ActorId(0)));
    assert!((time - (400.0 - 30.0 - 4.6) / 20.0).abs() < 0.03, "{time}");
}

#[test]
fn law_followers_on_a_ring_follow_all_the_way_round() {
    // Eight cars at 50 m from each other: each follows the next, the first one the last across the seam, and all come to one
    // speed, at which the gap is what the driver keeps. One that saw nobody ahead would reach 20 m/s.
    let actors: Vec<_> = (0..8)
        .map(|i| actor(1, 50.0 * f64::from(i), 5.0, follower()))
        .collect();
    let mut speeds = Vec::new();
    let touched = drive(&ring(), &actors, 0.0, 300.0, |scene| {
        speeds = scene.actors.iter().map(|body| body.s_rate).collect();
        let mut order: Vec<f64> = scene
            .actors
            .iter()
            .map(|a| a.road.s.rem_euclid(LAP))
            .collect();
        order.sort_by(f64::total_cmp);
        assert!(order.windows(2).all(|two| two[1] - two[0] > CAR.length));
    });
    assert_eq!(touched, None);
    let (least, most) = (
        speeds.iter().copied().fold(f64::INFINITY, f64::min),
        speeds.iter().copied().fold(0.0, f64::max),
    );
    assert!(
        most - least < 0.1 && most < 19.0 && least > 12.0,
        "{speeds:?}"
    );
}

#[test]
fn hand_a_distance_between_actors_counts_the_shorter_way() {
    // 30 m before the seam and 30 m behind it, in a lane each: 60 m apart, closing at 10 m/s.
    let mut waiting = actor(1, 30.0, 0.0, Behaviour::Cruise);
    waiting.manoeuvres.push(Manoeuvre {
        when: Trigger::DistanceTo {
            actor: ActorId(1),
            distance: 40.0,
        },
        then: Action::ReachSpeed {
            speed: 5.0,
            accel: 5.0,
        },
    });
    let coming = actor(3, 370.0, 10.0, Behaviour::Cruise);
    let mut begun = None;
    drive(&ring(), &[waiting, coming], 0.0, 10.0, |scene| {
        if begun.is_none() && scene.actors[0].speed > 0.0 {
            begun = Some(scene.time.seconds());
        }
    });
    // Lane 3 lies 3.5 m inside of the reference line, which is gone along faster than the lane.
    let rate = 10.0 / (1.0 - 3.5 * TAU / LAP);
    let expected = (60.0 - 40.0) / rate;
    let begun = begun.expect("it begins");
    assert!((begun - expected).abs() < 0.03, "{begun} {expected}");
}
