//! Several futures of one actor (reading R13), worked by hand. What holds for all is in `tests/laws/aggregation.rs`.

use crate::scene::{CAR, L0, Scene};
use zhuyi_core::{ActorId, Forecast, Trajectory};
use zhuyi_estimator::{Aggregation, Estimator, Params, State};

fn forecast(scenes: &[(f64, Scene)]) -> Forecast {
    let trajectory = |scene: &Scene| Trajectory {
        along: scene.along.clone(),
        across: scene.across.clone(),
        extents: Vec::new(),
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

/// A car 5 m ahead of a standing ego backs into it, or moves over before. All aggregations give the largest latency; the
/// state is that of a conflict unless the futures without one make up the share that counts.
#[test]
fn hand_futures_before_a_standing_ego() {
    let (backs, leaves) = (
        Scene::following(0.0, 5.0, -1.0),
        Scene::following(0.0, 5.0, -1.0).jumps_to(-1.0, 3.5),
    );
    let of = |weight: f64, aggregation: Aggregation| {
        let scenes = [(weight, backs.clone()), (1.0 - weight, leaves.clone())];
        let estimator = Estimator::new(Params {
            aggregation,
            ..Params::default()
        });
        let found = estimator.forecast(&backs.ego, &forecast(&scenes), 0.0, L0);
        assert_eq!(found.estimate.latency, Some(1.0));
        (found.estimate.state, found.trajectory)
    };
    for aggregation in [
        Aggregation::Percentile(0.99),
        Aggregation::Worst,
        Aggregation::Mean,
    ] {
        assert_eq!(of(0.5, aggregation), (State::Standing, Some(0)));
    }
    assert_eq!(
        of(0.005, Aggregation::Percentile(0.99)),
        (State::None, Some(1))
    );
}
