//! The coarse view of a recording saves work and changes no answer.

use crate::scene::{CAR, Scene};
use proptest::prelude::*;
use zhuyi_core::{Across, Along, Trajectory};
use zhuyi_estimator::{Criterion, Estimator, Params, Recording, Solver};

prop_compose! {
    /// A lead recorded every `step` seconds while its pedals and its steering wander; now and then a piece is out of place.
    fn any_scene()(
        speed in 0.0..35.0_f64,
        accel in -6.0..2.0_f64,
        gap in -10.0..80.0_f64,
        lead in 0.0..35.0_f64,
        step in 0.01..0.08_f64,
        jerks in prop::collection::vec((-8.0..8.0_f64, -1.0..1.0_f64, prop::bool::weighted(0.02)), 40..500),
        now in -1.0..12.0_f64,
        current_latency in 0.03..0.5_f64,
    ) -> Scene {
        let mut scene = Scene::following(speed, gap, lead);
        (scene.ego.accel, scene.now, scene.current_latency) = (accel, now, current_latency);
        let (mut piece, mut beside) = (scene.along[0], Across { time: 0.0, d: 0.0, d_rate: 0.0 });
        for (count, (jerk, push, hitch)) in jerks.into_iter().enumerate() {
            let time = count as f64 * step;
            let v = piece.v_at(time).max(0.0);
            let accel = (0.98 * piece.v_rate + jerk * step).max(-v / step);
            piece = Along::constant_accel(time, piece.s_at(time) + if hitch { push } else { 0.0 }, v, accel);
            let d = beside.d + step * beside.d_rate;
            beside = Across { time, d, d_rate: 0.95 * beside.d_rate + push * step.sqrt() };
            scene.along.push(piece);
            scene.across.push(beside);
        }
        // The ego meets it where it is at `now`.
        let place = scene.along.iter().rev().find(|piece| piece.time <= now).map_or(0.0, |piece| piece.s_at(now));
        scene.ego.s = place - CAR.length - gap;
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
        prop_assert_eq!(zhuyi_estimator::Estimate { t_n: None, ..found }, zhuyi_estimator::Estimate { t_n: None, ..expected });
    }
}

/// Two pieces at one time have no duration to fit a curve to.
#[test]
fn hand_pieces_without_duration_rule_nothing_out() {
    let scene = Scene::following(20.0, 60.0, 0.0);
    let along = vec![scene.along[0]; 200];
    let recording = Recording::new(Trajectory {
        along,
        across: vec![scene.across[0]; 200],
        known_until: 20.0,
    });
    let estimator = Estimator::new(Params::default());
    let found = estimator.recorded(&scene.ego, CAR, &recording, 0.0, scene.current_latency);
    assert_eq!(found, scene.ask(&Params::default()));
}
