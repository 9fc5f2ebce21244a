//! Where the model itself breaks a law that one would expect: the smallest examples, worked by hand.
//!
//! How often each happens among random cases is counted in `tests/laws`; `src/laws.md` tells the figures.

use crate::scene::{CAR, L0, Scene};
use zhuyi_core::Footprint;
use zhuyi_estimator::evasion::{Evasion, Procedure, Sides};
use zhuyi_estimator::model::{Reaction, SafetyModel};
use zhuyi_estimator::{
    Criterion, Ego, Estimate, Estimator, Future, Grid, Params, Solver, State, Uncertainty,
};

fn answer(estimate: &Estimate) -> (State, Option<f64>) {
    (estimate.state, estimate.latency)
}

/// 15 m/s, a lead 30 m ahead at 10 m/s brakes at 5 m/s2 from 1 s on; K = 0. After t_r = 1 s the jumps of Eq. 3 come to
/// the ego's standstill, 1 + 15/4.9 = 4.061 s, in three. After t_r = 1/30 s the ego is first as slow as allowed at
/// 1/30 + 6/4.9 = 1.258 s, when the lead has begun to slow; from there each jump leaves 0.9 x 5/4.9 = 92 % of the
/// excess, and ten jumps do not get to where the lead stands. So 1 s is tolerable and 1/30 s is not, nor is braking
/// at once. Enough jumps close the hole.
#[test]
fn hand_jumps_chase_a_braking_lead_in_vain() {
    let scene = Scene::following(15.0, 30.0, 10.0).then(1.0, -5.0, 0.0);
    let jumps = Params {
        solver: Solver::Paper,
        grid: Grid::Thirtieths,
        confirm_frames: 0,
        ..Params::default()
    };
    let found = scene.ask(&jumps);
    assert_eq!(answer(&found), (State::Tolerable, Some(1.0)));
    assert!((found.t_n.unwrap() - (1.0 + 15.0 / 4.9)).abs() < 1e-6);

    let cautious = Params {
        cautious: true,
        ..jumps
    };
    assert_eq!(answer(&scene.ask(&cautious)), (State::Unavoidable, None));
    let patient = Params {
        max_steps: 1000,
        ..cautious
    };
    assert_eq!(answer(&scene.ask(&patient)), (State::Tolerable, Some(1.0)));
}

/// 20 m/s, braking at 8 m/s2 already, and a car stands 30 m ahead: the ego stops by itself after 25 m, and Eq. 1 allows
/// 27. With C4 = 0.5 the procedure brakes at 4.9 m/s2 only. To react at 9/30 s (t_r = 1.633) ends after 26.9 m, at
/// 8/30 s (1.433) after 27.9, at once after 40.8: the later the better.
#[test]
fn hand_a_procedure_weaker_than_the_ego_punishes_reacting() {
    let mut scene = Scene::following(20.0, 30.0, 0.0);
    scene.ego.accel = -8.0;
    let weak = Params {
        c4: 0.5,
        grid: Grid::Thirtieths,
        ..Params::default()
    };
    assert_eq!(answer(&scene.ask(&weak)), (State::Tolerable, Some(1.0)));
    let cautious = |c4: f64| Params {
        c4,
        cautious: true,
        ..weak.clone()
    };
    assert_eq!(
        answer(&scene.ask(&cautious(0.5))),
        (State::Unavoidable, None)
    );
    // The cautious variant costs nothing where there is no hole.
    assert_eq!(
        answer(&scene.ask(&cautious(1.1))),
        (State::Tolerable, Some(1.0))
    );
}

/// Reading R8: ego and actor at 10 m/s, the actor in the next lane with its front 25 cm behind the ego's rear. It cuts in
/// after 1 s: not the ego's to prevent. Half a metre more gap, half a metre per second more of the actor's speed, or less
/// of the ego's, and it cuts in beside the ego: what was no conflict is alongside.
#[test]
fn hand_more_room_may_make_a_stay_the_egos_business() {
    let behind = |ego: f64, more: f64, actor: f64| {
        Scene::following(ego, -8.25 + more, actor)
            .jumps_to(-1.0, 3.5)
            .jumps_to(1.0, 0.0)
            .ask(&Params::default())
    };
    let alongside = (State::Alongside, None);
    assert_eq!(answer(&behind(10.0, 0.0, 10.0)), (State::None, Some(1.0)));
    assert_eq!(answer(&behind(10.0, 0.5, 10.0)), alongside);
    assert_eq!(answer(&behind(10.0, 0.0, 10.5)), alongside);
    assert_eq!(answer(&behind(9.5, 0.0, 10.0)), alongside);
}

/// The criterion `standstill` knows no margins, so before a standing car it asks for less than `paper`: 10 m/s, 50 m.
/// The margin leaves 45 - 10.2 = 34.8 m of reaction, so l = 0.604 (t_r = 3.457), without it they are 39.8: l = 0.67
/// (3.853), while 0.703 would be 4.051.
#[test]
fn hand_standstill_asks_for_less_before_a_standing_car() {
    let scene = Scene::following(10.0, 50.0, 0.0);
    let of = |criterion| {
        scene
            .ask(&Params {
                criterion,
                ..Params::default()
            })
            .latency
    };
    assert_eq!(of(Criterion::Paper), Some(0.604));
    assert_eq!(of(Criterion::Standstill), Some(0.67));
}

/// An actor 5 m ahead backs up at 1 m/s into an ego that stands: no braking helps, and it is put down as that (reading
/// R8b). An ego that creeps at the border of standing is asked as any other: `paper` grants what reacts before the touch
/// after 5 / 1.1 = 4.545 s, t_r = 4.447 (l = 0.769) but not 4.645 (0.802), and `standstill` calls it unavoidable.
#[test]
fn hand_an_actor_that_backs_into_a_standing_ego_is_not_put_down_to_the_ego() {
    let of = |speed: f64, accel: f64, criterion| {
        let mut scene = Scene::following(speed, 5.0, -1.0);
        scene.ego.accel = accel;
        answer(&scene.ask(&Params {
            criterion,
            ..Params::default()
        }))
    };
    let standing = (State::Standing, Some(1.0));
    for criterion in [Criterion::Paper, Criterion::Standstill] {
        for (speed, accel) in [
            (0.0, 0.0),
            (0.0, 1.0),
            (-2.0, 1.0),
            (0.099, 0.0),
            (0.099, -5.0),
        ] {
            assert_eq!(of(speed, accel, criterion), standing, "{speed} {accel}");
        }
        // Starting off.
        assert_ne!(of(0.099, 0.1, criterion).0, State::Standing);
    }
    assert_eq!(
        of(0.1, 0.0, Criterion::Paper),
        (State::Tolerable, Some(0.769))
    );
    assert_eq!(
        of(0.1, 0.0, Criterion::Standstill),
        (State::Unavoidable, None)
    );
}

/// Reading R8b is decided after `none` and before `alongside`: an actor in the next lane is nobody's business, and one
/// beside a standing ego that moves over into it is `standing` though the conflict begins with the bodies side by side.
#[test]
fn hand_standing_comes_after_none_and_before_alongside() {
    let beside = |speed: f64| Scene::following(speed, -3.0, speed).jumps_to(-1.0, 3.5);
    let ask = |scene: Scene| answer(&scene.ask(&Params::default()));
    assert_eq!(ask(beside(0.0)), (State::None, Some(1.0)));
    assert_eq!(
        ask(beside(0.0).jumps_to(1.0, 0.0)),
        (State::Standing, Some(1.0))
    );
    assert_eq!(
        ask(beside(10.0).jumps_to(1.0, 0.0)),
        (State::Alongside, None)
    );
}

/// A model with one answer.
struct Always(Reaction);
impl SafetyModel for Always {
    fn name(&self) -> &'static str {
        "always"
    }
    fn reaction(&self, _: &Ego, _: Footprint, _: &Future<'_>) -> Reaction {
        self.0
    }
}

/// No way of asking tells a standing ego anything else: every criterion and solver, evasion, uncertainty, other models.
#[test]
fn hand_a_standing_ego_is_standing_by_every_way_of_asking() {
    let scene = Scene::following(0.0, 5.0, -1.0);
    let standing = (State::Standing, Some(1.0));
    let ways = [
        Params {
            solver: Solver::Paper,
            ..Params::default()
        },
        Params {
            evasion: Some(Evasion::default()),
            ..Params::default()
        },
        Params {
            uncertainty: Some(Uncertainty::example()),
            ..Params::default()
        },
    ];
    for params in ways {
        let estimator = Estimator::new(params);
        let (ego, future) = (&scene.ego, scene.future());
        assert_eq!(
            answer(&estimator.trajectory(ego, CAR, &future, L0)),
            standing
        );
        let evading = estimator.evading(ego, CAR, &future, Sides::BOTH, L0);
        assert_eq!(
            (answer(&evading.estimate), evading.procedure),
            (standing, Procedure::Brake)
        );
    }
    let by = |scene: &Scene, reaction| {
        let estimator = Estimator::new(Params::default());
        let model = Always(reaction);
        let found = estimator.by_model(&model, &scene.ego, CAR, &scene.future(), L0);
        answer(&found.expect("always defined"))
    };
    assert_eq!(by(&scene, Reaction::TooLate), standing);
    assert_eq!(by(&scene, Reaction::Within(0.0)), standing);
    assert_eq!(by(&scene, Reaction::NoDanger), (State::None, Some(1.0)));
    let moving = Scene::following(1.0, 5.0, -1.0);
    assert_eq!(by(&moving, Reaction::TooLate), (State::Unavoidable, None));
}
