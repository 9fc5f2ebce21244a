//! What holds whatever the numbers.

use crate::scene::{CAR, Scene};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use zhuyi_estimator::{Estimator, Params, Reaction, State};
use zhuyi_metrics::safety_models::{CarefulDriver, Rss, SafetyForceField, SafetyModels};

prop_compose! {
    fn any_rss()(
        response in 0.1..2.0_f64,
        accel in prop_oneof![Just(0.0), 0.1..5.0_f64],
        least_brake in 2.0..9.0_f64,
        harder in 0.0..5.0_f64,
        lateral_accel in 0.1..2.0_f64,
        lateral_brake in 0.2..2.0_f64,
        lateral_margin in 0.0..0.5_f64,
        speed_cap in prop::option::of(0.0..40.0_f64),
    ) -> Rss {
        Rss {
            response, accel, least_brake, most_brake: least_brake + harder, correct_brake: least_brake / 2.0,
            lateral_accel, lateral_brake, lateral_margin, speed_cap,
        }
    }
}

prop_compose! {
    fn any_scene()(
        speed in 0.5..40.0_f64,
        gap in -20.0..100.0_f64,
        lead in 0.0..40.0_f64,
        d in prop_oneof![Just(0.0), -8.0..8.0_f64],
        d_rate in prop_oneof![Just(0.0), -2.0..2.0_f64],
        accel in prop_oneof![Just(0.0), -4.0..2.0_f64],
    ) -> Scene {
        let mut scene = Scene::following(speed, gap, lead).aside(d, d_rate);
        scene.ego.accel = accel;
        scene
    }
}

/// Whether the actor goes across rather than along the path.
fn crosses(scene: &Scene) -> bool {
    let (v, d_rate) = (scene.along[0].v, scene.across[0].d_rate);
    d_rate.abs() > v && v * v + d_rate * d_rate >= 0.01
}

/// In the order of the time that it leaves.
fn ranked(reaction: Reaction) -> f64 {
    match reaction {
        Reaction::NotDefined => -2.0,
        Reaction::TooLate => -1.0,
        Reaction::Within(time) => time,
        Reaction::NoDanger => f64::INFINITY,
    }
}

/// [s] the step of the simulations that the closed forms are compared with.
const STEP: f64 = 2e-3;

/// The ego's places from t_0 on when it holds, builds up its braking at a jerk and brakes until it stands.
fn drive(scene: &Scene, onset: f64, decel: f64, jerk: f64) -> Vec<f64> {
    let (mut s, mut v, mut places) = (0.0, scene.ego.speed, vec![]);
    for count in 0..(20.0 / STEP) as usize {
        places.push(s);
        let time = (f64::from(count as u32) + 0.5) * STEP - onset;
        let full = scene.ego.accel.min(-decel);
        let a = if time < 0.0 {
            scene.ego.accel
        } else {
            (scene.ego.accel - jerk * time).max(full)
        };
        let next = (v + a * STEP).max(0.0);
        s += f64::midpoint(v, next) * STEP;
        v = next;
        if v == 0.0 && a <= 0.0 {
            places.resize((20.0 / STEP) as usize, s);
            break;
        }
    }
    places
}

/// The actor's places along and across when it keeps its speed and ends on the ego's path.
fn goes_on(scene: &Scene) -> impl Fn(f64) -> (f64, f64) {
    let (along, across) = (scene.along[0], scene.across[0]);
    let meets = -across.d / across.d_rate;
    move |time| {
        let d = across.d + time * across.d_rate;
        let arrived = across.d == 0.0 || (meets > 0.0 && time >= meets);
        (along.s + along.v * time, if arrived { 0.0 } else { d })
    }
}

/// The same when it brakes from t_0 on and keeps its heading.
fn brakes(scene: &Scene, decel: f64) -> impl Fn(f64) -> (f64, f64) {
    let (along, across) = (scene.along[0], scene.across[0]);
    move |time| {
        let time = time.min(along.v / decel);
        let covered = time * (along.v - decel * time / 2.0);
        let heading = if along.v > 0.0 {
            across.d_rate / along.v
        } else {
            0.0
        };
        (along.s + covered, across.d + covered * heading)
    }
}

/// Whether boxes that are larger by `extra` all round meet.
fn touch(places: &[f64], actor: impl Fn(f64) -> (f64, f64), extra: f64) -> bool {
    places.iter().enumerate().any(|(count, place)| {
        let (s, d) = actor(count as f64 * STEP);
        (s - place).abs() < CAR.length + extra && d.abs() < CAR.width + extra
    })
}

/// The answer against a simulation: nothing touches a little earlier, and something does a little later.
fn confirmed(answer: Reaction, touches: impl Fn(f64, f64) -> bool) -> bool {
    let (smaller, larger, little) = (-0.05, 0.05, 0.002);
    match answer {
        Reaction::NoDanger => !touches(20.0, smaller),
        Reaction::NotDefined => false,
        Reaction::TooLate => touches(0.0, larger),
        Reaction::Within(time) => {
            !touches((time - little).max(0.0), smaller) && touches(time + little, larger)
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    #[test]
    fn law_the_longitudinal_distance_of_the_response_is_the_gap(
        rss in any_rss(), gap in 0.0..200.0_f64, rear in 0.0..40.0_f64, front in 0.0..40.0_f64,
    ) {
        match rss.longitudinal_response(gap, rear, front) {
            Reaction::Within(rho) => {
                let back = rss.longitudinal_distance(rho, rear, front);
                prop_assert!((back - gap).abs() < 1e-9, "rho {rho}: {back}");
            }
            Reaction::TooLate => prop_assert!(rss.longitudinal_distance(0.0, rear, front) > gap),
            Reaction::NoDanger => prop_assert!(rss.longitudinal_distance(1e3, rear, front) <= gap),
            Reaction::NotDefined => prop_assert!(false, "defined for all speeds"),
        }
    }

    #[test]
    fn law_the_opposite_distance_of_the_response_is_the_gap(
        rss in any_rss(), gap in 0.0..400.0_f64, ego in 0.0..40.0_f64, other in 0.0..40.0_f64,
    ) {
        match rss.opposite_response(gap, ego, other) {
            Reaction::Within(rho) => {
                let back = rss.opposite_distance(rho, ego, other);
                prop_assert!((back - gap).abs() < 1e-9, "rho {rho}: {back}");
            }
            Reaction::TooLate => prop_assert!(rss.opposite_distance(0.0, ego, other) > gap),
            Reaction::NoDanger => prop_assert!(rss.opposite_distance(1e3, ego, other) <= gap),
            Reaction::NotDefined => prop_assert!(false, "defined for all speeds"),
        }
    }

    #[test]
    fn law_the_response_of_a_distance_is_the_one_it_was_made_with(
        rss in any_rss(), rho in 0.0..5.0_f64, rear in 1.0..40.0_f64, front in 0.0..40.0_f64,
    ) {
        let gap = rss.longitudinal_distance(rho, rear, front);
        if gap > 0.0 {
            let back = ranked(rss.longitudinal_response(gap, rear, front));
            prop_assert!((back - rho).abs() < 1e-9, "{back}");
        }
    }

    #[test]
    fn law_the_lateral_distance_of_the_response_is_the_edge_gap(
        rss in any_rss(), edge_gap in 0.0..8.0_f64, ego in -3.0..3.0_f64, other in -3.0..3.0_f64,
    ) {
        match rss.lateral_response(edge_gap, ego, other) {
            Reaction::Within(rho) => {
                let back = rss.lateral_distance(rho, ego, other);
                prop_assert!((back - edge_gap).abs() < 1e-9, "rho {rho}: {back}");
                prop_assert!(rss.lateral_distance(rho + 1e-3, ego, other) > edge_gap);
            }
            answer => {
                prop_assert_eq!(answer, Reaction::TooLate);
                for tenths in 0..100 {
                    let rho = f64::from(tenths) / 10.0;
                    prop_assert!(rss.lateral_distance(rho, ego, other) > edge_gap, "{rho}");
                }
            }
        }
    }

    #[test]
    fn law_rss_is_dangerous_only_if_both_axes_are(rss in any_rss(), scene in any_scene()) {
        let (along, across) = (scene.along[0], scene.across[0]);
        let (gap, edge_gap) = (along.s - CAR.length, across.d.abs() - CAR.width);
        let inward = if across.d == 0.0 { -across.d_rate.abs() } else { -across.d_rate * across.d.signum() };
        let dangerous = |rho: f64| {
            let long = rss.longitudinal_distance(rho, scene.ego.speed, along.v) > gap;
            let lat = edge_gap < 0.0 || rss.lateral_distance(rho, 0.0, inward) > edge_gap;
            long && lat
        };
        match scene.ask(&rss) {
            Reaction::NotDefined => prop_assert!(crosses(&scene)),
            Reaction::NoDanger => prop_assert!(gap < -2.0 * CAR.length),
            Reaction::TooLate => prop_assert!(dangerous(0.0)),
            Reaction::Within(rho) => {
                prop_assert!(!dangerous((rho - 1e-6).max(0.0)));
                prop_assert!(dangerous(rho + 1e-6));
            }
        }
    }

    #[test]
    fn law_a_cap_never_asks_for_more(rss in any_rss(), scene in any_scene()) {
        let free = Rss { speed_cap: None, ..rss };
        prop_assert!(ranked(scene.ask(&rss)) >= ranked(scene.ask(&free)) - 1e-9);
    }

    #[test]
    fn law_a_larger_gap_never_leaves_less_time(
        speed in 0.0..40.0_f64, gap in 0.0..100.0_f64, more in 0.0..50.0_f64, lead in 0.0..40.0_f64,
    ) {
        let (near, far) = (Scene::following(speed, gap, lead), Scene::following(speed, gap + more, lead));
        for model in SafetyModels::default().all() {
            prop_assert!(ranked(far.ask(model)) >= ranked(near.ask(model)) - 1e-9, "{}", model.name());
        }
    }

    #[test]
    fn law_only_differences_of_place_and_time_count(
        scene in any_scene(), s in -500.0..500.0_f64, d in -9.0..9.0_f64, t in -50.0..50.0_f64,
    ) {
        let mut moved = scene;
        moved.ego.s += s;
        moved.ego.d += d;
        moved.along[0].s += s;
        moved.along[0].time += t;
        moved.across[0].d += d;
        moved.across[0].time += t;
        let future = zhuyi_estimator::Future { now: t, ..moved.future() };
        for model in SafetyModels::default().all() {
            let (here, there) = (scene.ask(model), model.reaction(&moved.ego, CAR, &future));
            let same = match (here, there) {
                (Reaction::Within(here), Reaction::Within(there)) => (here - there).abs() < 1e-6,
                (here, there) => here == there,
            };
            prop_assert!(same, "{}: {here:?} {there:?}", model.name());
        }
    }

    #[test]
    fn law_the_grid_holds_the_largest_latency_in_time(scene in any_scene(), current in 0.03..1.0_f64) {
        let estimator = Estimator::new(Params::default());
        for model in SafetyModels::default().all() {
            let estimate = estimator.by_model(model, &scene.ego, CAR, &scene.future(), current);
            let Some(estimate) = estimate else {
                prop_assert_eq!(scene.ask(model), Reaction::NotDefined);
                continue;
            };
            let exact = scene.ask(model).latency(current, 5);
            let grid = estimator.latencies();
            match (estimate.state, exact) {
                (State::Tolerable, Some(exact)) => {
                    let found = estimate.latency.expect("tolerable");
                    prop_assert!(found <= exact + 1e-9);
                    prop_assert!(grid.iter().all(|latency| *latency <= found || *latency > exact - 1e-9));
                }
                (State::BeyondGrid, Some(exact)) => prop_assert!(exact < grid[grid.len() - 1] + 1e-9),
                (state, exact) => prop_assert!(exact.is_none(), "{}: {state:?}", model.name()),
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

    #[test]
    fn law_the_driver_agrees_with_small_steps(scene in any_scene(), build_up in prop_oneof![Just(0.0), 0.2..1.0_f64]) {
        let driver = CarefulDriver { decel: 7.0, build_up };
        if scene.along[0].s < -CAR.length {
            prop_assert_eq!(scene.ask(&driver), Reaction::NoDanger);
            return Ok(());
        }
        let touches = |onset: f64, extra: f64| {
            touch(&drive(&scene, onset, 7.0, 7.0 / build_up), goes_on(&scene), extra)
        };
        let answer = scene.ask(&driver);
        if crosses(&scene) {
            prop_assert_eq!(answer, Reaction::NotDefined);
            return Ok(());
        }
        prop_assert!(confirmed(answer, touches), "{answer:?}");
    }

    #[test]
    fn law_claimed_sets_agree_with_small_steps(scene in any_scene()) {
        let sff = SafetyForceField::default();
        if scene.along[0].s < -CAR.length {
            prop_assert_eq!(scene.ask(&sff), Reaction::NoDanger);
            return Ok(());
        }
        let touches = |onset: f64, extra: f64| {
            touch(&drive(&scene, onset, 6.0, f64::INFINITY), brakes(&scene, 6.0), extra)
        };
        let answer = scene.ask(&sff);
        if crosses(&scene) {
            prop_assert_eq!(answer, Reaction::NotDefined);
            return Ok(());
        }
        prop_assert!(confirmed(answer, touches), "{answer:?}");
    }

    #[test]
    fn law_wider_bounds_claim_more(scene in any_scene(), less in 0.0..3.0_f64, more in 0.0..3.0_f64) {
        let wide = SafetyForceField { least_decel: 6.0 - less, most_decel: 6.0 + more };
        let sharp = scene.ask(&SafetyForceField::default());
        // Where holding on is no danger and braking in between is, the answers are not in order.
        if sharp != Reaction::NoDanger && scene.ask(&wide) != Reaction::NoDanger {
            prop_assert!(ranked(scene.ask(&wide)) <= ranked(sharp) + 1e-9);
        }
    }
}
