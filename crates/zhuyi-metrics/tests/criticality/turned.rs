//! Boxes that do not stand along the path: extents as they stand (reading R7).

use crate::scene::{CAR, Scene, steady};
use std::f64::consts::FRAC_PI_2;
use zhuyi_core::{Extent, Footprint};
use zhuyi_estimator::{Estimator, Params};
use zhuyi_metrics::criticality::{Criticality, Limits};

const SALOON: Footprint = Footprint {
    length: 4.5,
    width: 1.8,
};

/// A scene of an ego of 4.5 m x 1.8 m at 10 m/s and a box whose centre is `s` ahead.
fn before(actor: Footprint, s: f64, d: f64, d_rate: f64) -> Scene {
    let mut scene = Scene::in_lane(&steady(s - CAR.length, 10.0, 0.0)).sideways(d, d_rate);
    scene.ego.footprint = SALOON;
    scene.standing(actor.turned(FRAC_PI_2))
}

fn near(found: Option<f64>, expected: f64) -> bool {
    found.is_some_and(|found| (found - expected).abs() < 1e-9)
}

/// A bus of 12 m x 2.5 m stands across the lane 50 m ahead, its centre 5 m to the left: y from -1 to 11 m. The gap is 50 -
/// 1.25 - 2.25 = 46.5 m: TTC 4.65 s, DRAC 100 / 93, and the estimator asks for what a car asks that stands 46.5 m ahead.
#[test]
fn hand_a_bus_across_the_lane_is_an_obstacle() {
    let bus = Footprint {
        length: 12.0,
        width: 2.5,
    };
    let scene = before(bus, 50.0, 5.0, 0.0);
    let limits = Limits::default();
    let found = scene.ask(&limits);
    assert!(near(found.ttc, 4.65) && near(found.ttc_2d, 4.65) && near(found.thw, 4.65));
    assert!(near(found.drac, 100.0 / 93.0) && near(found.btn, 100.0 / 93.0 / 9.0));
    assert_eq!(found.pet, Some(0.0));
    assert!(found.ttb.is_some() && found.impact_speed == Some(0.0));

    let mut standing = Scene::in_lane(&steady(50.0 - 1.25 + 2.25 - CAR.length, 10.0, 0.0));
    standing.ego.footprint = SALOON;
    let estimator = Estimator::new(Params::default());
    let latency = |scene: &Scene, actor: Footprint| {
        let estimate = estimator.trajectory(&scene.ego, actor, &scene.future(), 1.0 / 30.0);
        (estimate.state, estimate.latency)
    };
    assert_eq!(latency(&scene, bus), latency(&standing, SALOON));
    assert!(latency(&scene, bus).1.is_some_and(|latency| latency < 1.0));

    // Along the lane it would be 5 m to the left and in nobody's way.
    let aligned = scene.clone().standing(bus);
    assert_eq!(aligned.ask(&limits), Criticality::default());
}

/// A car of 4.5 m x 1.8 m crosses 60 m ahead at 4 m/s from 10 m to the right. It has left the ego's path (0.9 m to the left of
/// its middle) with its rear after (10 + 2.25 + 0.9) / 4 = 3.2875 s; the ego's front is there after (60 - 0.9 - 2.25) / 10 =
/// 5.685 s.
#[test]
fn hand_who_crosses_is_as_wide_as_it_is_long() {
    let scene = before(SALOON, 60.0, -10.0, 4.0);
    assert!(near(scene.ask(&Limits::default()).pet, 5.685 - 3.2875));
}

/// A car that stands 30 m ahead and 2.5 m to the left turns from along to across the path from 1 s to 3 s: its half width
/// grows from 1 to 2 m, its half length falls from 2 to 1 m. At 2 s both are 1.5 m, and its side comes into the path of an ego
/// of 2 m width at 30 m/s, whose rear has passed the car's front, 30 + 1.5 + 2 m further on, after 33.5 / 30 s: PET 2 - 33.5 / 30.
#[test]
fn hand_a_car_that_turns_in_behind_has_a_pet() {
    let mut scene = Scene::in_lane(&steady(30.0 - CAR.length, 30.0, 0.0)).sideways(2.5, 0.0);
    let first = Extent::held(CAR);
    let turns = Extent {
        time: 1.0,
        along_rate: -0.5,
        across_rate: 0.5,
        ..first
    };
    let last = Extent {
        time: 3.0,
        along: 1.0,
        across: 2.0,
        along_rate: 0.0,
        across_rate: 0.0,
    };
    scene.extents = vec![first, turns, last];
    let found = scene.ask(&Limits::default());
    assert!(near(found.pet, 2.0 - 33.5 / 30.0), "{:?}", found.pet);
    // Seen at 2.5 s, which moves the ego there, it is in the way as it stands then: 1.75 m to the side, 1.25 m to the rear.
    scene.now = 2.5;
    assert_eq!(
        scene.ask(&Limits::default()).ttc,
        Some((30.0 - 1.25 - 2.0) / 30.0)
    );
}

/// Two cars at one speed but for rounding never meet in any time that means something; nor does one that creeps have a headway.
#[test]
fn hand_a_gap_that_closes_by_less_than_a_millimetre_per_second_does_not_close() {
    let ask = |ego_speed: f64, actor_speed: f64| {
        Scene::in_lane(&steady(30.0, ego_speed, actor_speed)).ask(&Limits::default())
    };
    let equal = ask(20.0, 20.0 - 1e-7);
    assert_eq!((equal.ttc, equal.ttc_2d, equal.drac), (None, None, None));
    assert_eq!((equal.ttb, equal.thw), (None, Some(1.5)));
    let slow = ask(20.0, 20.0 - 0.002);
    assert!(slow.ttc.is_some_and(|ttc| (ttc - 15_000.0).abs() < 1e-6));
    let creeps = ask(1e-7, 0.0);
    assert_eq!(
        (creeps.thw, creeps.ttc, creeps.ttc_2d, creeps.ttb),
        (None, None, None, None)
    );
}
