//! Laws of the model on random cars ahead, whatever the numbers.

use crate::scene::{CAR, L0, Scene};
use proptest::prelude::*;
use zhuyi_core::{ActorId, Forecast, Trajectory};
use zhuyi_estimator::ego_motion::{EgoMotion, Start, braking_decel, reaction_time};
use zhuyi_estimator::{Aggregation, Criterion, Estimate, Estimator, Grid, Params, Solver, State};

prop_compose! {
    /// A lead in the ego's lane that may change its speed once and may cut in from the side.
    fn any_scene()(
        speed in 0.0..40.0_f64,
        accel in -6.0..3.0_f64,
        gap in 0.5..150.0_f64,
        lead in 0.0..40.0_f64,
        change in prop::option::of((0.0..5.0_f64, -9.0..-0.5_f64, 0.0..1.0_f64)),
        cut_in in prop::option::of(0.1..4.0_f64),
        current_latency in 0.03..0.5_f64,
    ) -> Scene {
        let mut scene = Scene::following(speed, gap, lead);
        scene.ego.accel = accel;
        scene.current_latency = current_latency;
        if let Some(time) = cut_in {
            scene.across[0].d = -3.5;
            scene = scene.jumps_to(time, 0.0);
        }
        match change {
            Some((time, accel, share)) if lead > 0.0 => scene.then(time, accel, share * lead),
            _ => scene,
        }
    }
}

prop_compose! {
    fn any_params()(
        grid in prop::sample::select(vec![Grid::Ms33, Grid::Thirtieths, Grid::Fps]),
        criterion in prop::sample::select(vec![Criterion::Paper, Criterion::Standstill]),
    ) -> Params {
        Params { grid, criterion, ..Params::default() }
    }
}

/// How much is tolerated, as a number that grows: the latency, below it "at once", below that nothing.
fn tolerance(estimate: &Estimate) -> f64 {
    match estimate.state {
        State::None | State::Tolerable => estimate.latency.unwrap_or(f64::NAN),
        State::BeyondGrid => 0.0,
        State::Unavoidable | State::Alongside => -1.0,
    }
}

fn forecast(scenes: &[(f64, Scene)]) -> Forecast {
    let trajectory = |scene: &Scene| Trajectory {
        along: scene.along.clone(),
        across: scene.across.clone(),
        known_until: 20.0,
    };
    let trajectories = scenes
        .iter()
        .map(|(weight, scene)| (*weight, trajectory(scene)))
        .collect();
    Forecast {
        actor: ActorId(0),
        footprint: CAR,
        trajectories,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn law_a_larger_gap_never_hurts(scene in any_scene(), params in any_params(), more in 0.0..50.0_f64) {
        let mut further = scene.clone();
        for piece in &mut further.along {
            piece.s += more;
        }
        // A cut-in beside or behind the ego is none of its business, one ahead of it is.
        prop_assume!(scene.ask(&params).state != State::None || further.ask(&params).state == State::None);
        prop_assert!(tolerance(&further.ask(&params)) >= tolerance(&scene.ask(&params)));
    }

    #[test]
    fn law_wider_margins_never_help(
        scene in any_scene(),
        params in any_params(),
        c1 in 0.5..0.9_f64,
        c2 in 0.5..0.9_f64,
    ) {
        let usual = tolerance(&scene.ask(&params));
        for narrower in [Params { c1, ..params.clone() }, Params { c2, ..params }] {
            prop_assert!(tolerance(&scene.ask(&narrower)) <= usual);
        }
    }

    #[test]
    fn law_more_frames_to_confirm_never_help(scene in any_scene(), params in any_params(), k in 0..10_u32) {
        let few = scene.ask(&Params { confirm_frames: k, ..params.clone() });
        let more = scene.ask(&Params { confirm_frames: k + 1, ..params });
        prop_assert!(tolerance(&more) <= tolerance(&few));
    }

    #[test]
    fn law_harder_braking_never_hurts(scene in any_scene(), params in any_params(), c3 in 4.9..12.0_f64) {
        let usual = tolerance(&scene.ask(&params));
        let harder = tolerance(&scene.ask(&Params { c3, ..params }));
        prop_assert!(harder >= usual);
    }

    #[test]
    fn law_only_differences_count(scene in any_scene(), params in any_params(), by in -64_i32..64) {
        let by = f64::from(by); // moves binary numbers without rounding the differences away
        let expected = scene.ask(&params);
        let (mut along, mut mirrored, mut later) = (scene.clone(), scene.clone(), scene);
        along.ego.s += by;
        along.along.iter_mut().for_each(|piece| piece.s += by);
        mirrored.across.iter_mut().for_each(|piece| (piece.d, piece.d_rate) = (-piece.d, -piece.d_rate));
        later.now += by;
        later.along.iter_mut().for_each(|piece| piece.time += by);
        later.across.iter_mut().for_each(|piece| piece.time += by);
        for moved in [along, mirrored, later] {
            let found = moved.ask(&params);
            prop_assert_eq!((found.state, found.latency), (expected.state, expected.latency));
            prop_assert!((found.t_n.unwrap_or(0.0) - expected.t_n.unwrap_or(0.0)).abs() < 1e-6);
        }
    }

    #[test]
    fn law_cutting_a_piece_in_two_changes_nothing(scene in any_scene(), params in any_params(), at in 0.1..15.0_f64) {
        let mut cut = scene.clone();
        let index = cut.along.iter().rposition(|piece| piece.time <= at).unwrap();
        let piece = cut.along[index];
        let accel = 2.0 * piece.s_half_accel;
        cut.along.insert(index + 1, zhuyi_core::Along::constant_accel(at, piece.s_at(at), piece.v_at(at), accel));
        let (found, expected) = (cut.ask(&params), scene.ask(&params));
        prop_assert_eq!((found.state, found.latency), (expected.state, expected.latency));
    }

    /// An ego that follows the procedure at the latency it was granted does not touch: up to t_n, or for good.
    #[test]
    fn law_the_procedure_is_sound(scene in any_scene(), params in any_params(), jumps in any::<bool>()) {
        let params = Params { solver: if jumps { Solver::Paper } else { Solver::Exact }, ..params };
        let estimate = scene.ask(&params);
        let (State::Tolerable, Some(latency)) = (estimate.state, estimate.latency) else { return Ok(()) };
        let t_r = reaction_time(latency, scene.current_latency, params.confirm_frames);
        let start = Start::new(scene.ego.speed, scene.ego.accel);
        let motion = EgoMotion::new(start, t_r, braking_decel(start.accel, params.c3, params.c4));
        let until = estimate.t_n.unwrap_or(params.horizon);
        for step in 0..=2000 {
            let time = until * f64::from(step) / 2000.0;
            let along = scene.along.iter().rev().find(|piece| piece.time <= time).unwrap();
            let across = scene.across.iter().rev().find(|piece| piece.time <= time).unwrap();
            let clearance = along.s_at(time) - CAR.length - motion.distance(time);
            let past = across.d == 0.0 && clearance < -1e-6;
            // One that was let go by before it cut in is behind the ego, not in front of it.
            let behind = scene.across.len() > 1 && along.s_at(scene.across[1].time) < -CAR.length;
            prop_assert!(!past || behind, "{clearance} m at {time} s");
        }
    }

    #[test]
    fn law_the_jumps_never_tolerate_more_than_the_exact_solver(scene in any_scene()) {
        let exact = scene.ask(&Params::default());
        let jumps = scene.ask(&Params { solver: Solver::Paper, ..Params::default() });
        prop_assert!(tolerance(&jumps) <= tolerance(&exact));
    }

    #[test]
    fn law_standstill_tolerates_no_more_than_no_margins(scene in any_scene()) {
        // Without margins and with contact ruled out for good, the ego is behind the lead when it stands.
        let standstill = Params { criterion: Criterion::Standstill, ..Params::default() };
        let free = Params { c1: 1.0, c2: 1.0, ..Params::default() };
        prop_assume!(scene.ask(&standstill).state == State::Tolerable && scene.ego.speed < 30.0);
        prop_assert!(tolerance(&scene.ask(&standstill)) <= tolerance(&scene.ask(&free)));
    }

    #[test]
    fn law_a_percentile_lies_between_the_worst_and_the_best(
        scenes in prop::collection::vec((0.01..1.0_f64, any_scene()), 1..8),
        share in 0.01..1.0_f64,
    ) {
        let ego = scenes[0].1.ego;
        let aggregate = |aggregation: Aggregation| {
            let estimator = Estimator::new(Params { aggregation, ..Params::default() });
            estimator.forecast(&ego, &forecast(&scenes), 0.0, L0)
        };
        let each: Vec<f64> = scenes.iter().map(|(_, scene)| {
            let seen = Scene { ego, current_latency: L0, ..scene.clone() };
            seen.ask(&Params::default())
        }).filter(|estimate| estimate.state != State::Alongside).map(|estimate| tolerance(&estimate)).collect();
        prop_assume!(!each.is_empty());
        let worst = each.iter().copied().min_by(f64::total_cmp).unwrap();
        let best = each.iter().copied().max_by(f64::total_cmp).unwrap();
        let found = tolerance(&aggregate(Aggregation::Percentile(share)).estimate);
        prop_assert!(worst <= found && found <= best);
        prop_assert_eq!(tolerance(&aggregate(Aggregation::Worst).estimate), worst);
        prop_assert_eq!(tolerance(&aggregate(Aggregation::Percentile(1.0)).estimate), worst);
        let mean = tolerance(&aggregate(Aggregation::Mean).estimate);
        prop_assert!(worst - 1e-12 <= mean && mean <= best.max(1.0 / 30.0) + 1e-12);
    }
}

/// Three futures of a car 60 m ahead of an ego at 20 m/s: it drives on (nothing refused), stands (by hand 0.9 x 60
/// = 54 m less 40.8 m leave 0.659 s, so l = 0.109 with t_r = 0.487), or stands in its way at 40 m (unavoidable).
#[test]
fn hand_aggregation_of_three_futures() {
    let scenes = [
        Scene::following(20.0, 60.0, 20.0),
        Scene::following(20.0, 60.0, 0.0),
        Scene::following(20.0, 40.0, 0.0),
    ];
    let of = |weights: [f64; 3], aggregation: Aggregation| {
        let weighted: Vec<_> = weights.into_iter().zip(scenes.clone()).collect();
        let estimator = Estimator::new(Params {
            aggregation,
            ..Params::default()
        });
        let found = estimator.forecast(&scenes[0].ego, &forecast(&weighted), 0.0, L0);
        (
            found.estimate.state,
            found.estimate.latency,
            found.trajectory,
        )
    };
    let standing = (State::Tolerable, Some(0.109), Some(1));
    let unavoidable = (State::Unavoidable, None, Some(2));
    assert_eq!(
        of([0.9, 0.09, 0.01], Aggregation::Percentile(0.99)),
        standing
    );
    assert_eq!(
        of([90.0, 8.0, 2.0], Aggregation::Percentile(0.99)),
        unavoidable
    );
    assert_eq!(
        of([90.0, 8.0, 2.0], Aggregation::Percentile(0.9)),
        (State::Tolerable, Some(1.0), Some(0))
    );
    assert_eq!(of([0.9, 0.09, 0.01], Aggregation::Worst), unavoidable);
    let (state, mean, _) = of([0.5, 0.25, 0.25], Aggregation::Mean);
    assert_eq!(state, State::Tolerable);
    assert!((mean.unwrap() - (0.5 + 0.109 / 4.0 + 1.0 / 120.0)).abs() < 1e-12);
}

/// Seven of twelve equal futures are 7/12 of the probability, although seven times 0.1 is less than 7/12 of their sum
/// in floating point.
#[test]
fn hand_a_percentile_forgives_the_rounding_of_weights() {
    let future = |count: i32| {
        (
            0.1,
            Scene::following(20.0, 60.0, if count < 7 { 20.0 } else { 0.0 }),
        )
    };
    let scenes: Vec<_> = (0..12).map(future).collect();
    let params = Params {
        aggregation: Aggregation::Percentile(7.0 / 12.0),
        ..Params::default()
    };
    let found = Estimator::new(params).forecast(&scenes[0].1.ego, &forecast(&scenes), 0.0, L0);
    assert_eq!(found.estimate.latency, Some(1.0));
}

/// A future in which the actor starts beside the ego asks for no rate and does not silence the others.
#[test]
fn hand_futures_alongside_are_left_out() {
    let (beside, standing) = (
        Scene::following(20.0, -3.0, 20.0),
        Scene::following(20.0, 60.0, 0.0),
    );
    let estimator = Estimator::new(Params::default());
    let ask = |scenes: &[(f64, Scene)]| {
        let found = estimator.forecast(&beside.ego, &forecast(scenes), 0.0, L0);
        (
            found.estimate.state,
            found.estimate.latency,
            found.trajectory,
        )
    };
    assert_eq!(
        ask(&[(0.9, beside.clone()), (0.1, standing)]),
        (State::Tolerable, Some(0.109), Some(1))
    );
    assert_eq!(
        ask(&[(1.0, beside.clone())]),
        (State::Alongside, None, Some(0))
    );
    assert_eq!(ask(&[]), (State::None, Some(1.0), None));
}
