//! The coarse view of a recording saves work and changes no answer.

use crate::scene::{CAR, Scene};
use proptest::prelude::*;
use zhuyi_core::{Across, Along, Trajectory};
use zhuyi_estimator::{Criterion, Estimate, Estimator, Params, Recording, Solver};

prop_compose! {
    /// A lead recorded every `step` seconds while its pedals and its steering wander. Its speed is measured for
    /// itself and not well, now and then a piece is out of place, and `now` may lie before the record.
    fn any_scene()(
        speed in 0.0..35.0_f64,
        accel in -6.0..2.0_f64,
        gap in -10.0..80.0_f64,
        lead in 0.0..35.0_f64,
        step in 0.01..0.08_f64,
        jerks in prop::collection::vec((-8.0..8.0_f64, -1.0..1.0_f64, prop::bool::weighted(0.02)), 40..500),
        beside in (-4.0..4.0_f64, -1.0..1.0_f64),
        speedometer in 0.0..4.0_f64,
        now in prop_oneof![-6.0..0.0_f64, 0.0..12.0_f64],
        current_latency in 0.03..0.5_f64,
    ) -> Scene {
        let mut scene = Scene::following(speed, gap, lead);
        (scene.ego.accel, scene.now, scene.current_latency) = (accel, now, current_latency);
        let mut piece = scene.along[0];
        let mut beside = Across { time: 0.0, d: beside.0, d_rate: beside.1 };
        (scene.along, scene.across) = (Vec::new(), Vec::new());
        for (count, (jerk, push, hitch)) in jerks.into_iter().enumerate() {
            let time = count as f64 * step;
            let v = piece.v_at(time).max(0.0);
            let accel = (0.98 * piece.v_rate + jerk * step).max(-v / step);
            piece = Along::constant_accel(time, piece.s_at(time) + if hitch { push } else { 0.0 }, v, accel);
            let d = beside.d + step * beside.d_rate;
            beside = Across { time, d, d_rate: 0.95 * beside.d_rate + push * step.sqrt() };
            scene.along.push(Along { v: piece.v + speedometer * push, ..piece });
            scene.across.push(beside);
        }
        // The ego meets it where it is at `now`.
        let piece = scene.along.iter().rev().find(|piece| piece.time <= now).unwrap_or(&scene.along[0]);
        scene.ego.s = piece.s_at(now) - CAR.length - gap;
        scene
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn law_a_recording_has_the_answer_of_its_list(
        scene in any_scene(),
        criterion in prop::sample::select(vec![Criterion::Paper, Criterion::Standstill]),
        solver in prop::sample::select(vec![Solver::Exact, Solver::Paper]),
    ) {
        let (along, across, known_until) = (scene.along.clone(), scene.across.clone(), scene.future().known_until);
        let recording = Recording::new(Trajectory { along, across, known_until });
        let params = Params { criterion, solver, ..Params::default() };
        let (ego, l0) = (&scene.ego, scene.current_latency);
        let found = Estimator::new(params.clone()).recorded(ego, CAR, &recording, scene.now, l0);
        let expected = scene.ask(&params);
        let close = (found.t_n.unwrap_or(0.0) - expected.t_n.unwrap_or(0.0)).abs() < 1e-6;
        prop_assert!(close, "{found:?} {expected:?}");
        let but_t_n = |estimate: Estimate| Estimate { t_n: None, ..estimate };
        prop_assert_eq!(but_t_n(found), but_t_n(expected));
    }
}

/// Pieces that share one time have no duration to fit a curve to. A car stands 60 m ahead, noted 40 times at the start
/// and every second from then on.
#[test]
fn hand_pieces_without_duration_rule_nothing_out() {
    let scene = Scene::following(20.0, 60.0, 0.0);
    let note = |count: i32| Along {
        time: f64::from((count - 40).max(0)),
        ..scene.along[0]
    };
    let along = (0..100).map(note).collect();
    let recording = Recording::new(Trajectory {
        along,
        across: vec![scene.across[0]; 100],
        known_until: 20.0,
    });
    let estimator = Estimator::new(Params::default());
    let found = estimator.recorded(&scene.ego, CAR, &recording, 0.0, scene.current_latency);
    assert_eq!(found, scene.ask(&Params::default()));
    assert_eq!(found.latency, Some(0.109));
}

/// A car stands 44 m ahead of an ego at 20 m/s, too near for Eq. 1 (39.6 m) but not for braking at once (40.8 m), and
/// for one hundredth of a second at 6.5 s it is noted 20 m further. That is a t_n for the latencies that do not touch:
/// l = 0.043 (t_r = 0.092, 42.7 m), not 0.076 (0.289, 46.6 m).
#[test]
fn hand_a_moment_out_of_place_is_not_passed_over() {
    let mut scene = Scene::following(20.0, 44.0, 0.0);
    let standing = scene.along[0];
    let note = |count: i32| Along {
        time: f64::from(count) / 100.0,
        s: standing.s + if count == 650 { 20.0 } else { 0.0 },
        ..standing
    };
    scene.along = (0..2100).map(note).collect();
    let (along, across) = (scene.along.clone(), scene.across.clone());
    let recording = Recording::new(Trajectory {
        along,
        across,
        known_until: 20.0,
    });
    let estimator = Estimator::new(Params::default());
    let found = estimator.recorded(&scene.ego, CAR, &recording, 0.0, scene.current_latency);
    assert_eq!((found.latency, found.t_n), (Some(0.043), Some(6.5)));
    assert_eq!(found, scene.ask(&Params::default()));
}
