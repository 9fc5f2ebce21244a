//! Cases worked by hand, most of them where an easier reading of the paper goes wrong.

use crate::scene::{CAR, L0, Scene};
use zhuyi_core::{Across, Along};
use zhuyi_estimator::ego_motion::{EgoMotion, Start, reaction_time};
use zhuyi_estimator::{Binding, Criterion, Estimate, Grid, Params, Solver, State};

fn thirtieths() -> Params {
    Params {
        grid: Grid::Thirtieths,
        ..Params::default()
    }
}

fn answer(estimate: &Estimate) -> (State, Option<f64>) {
    (estimate.state, estimate.latency)
}

/// Both at 20 m/s; the lead stays until 1.1 s and then brakes at 9 m/s2 to 15 + 22 + 22.2 = 59.2 m. l = 0.175 means
/// t_r = 0.883 and an end at 17.7 + 40.8 = 58.5 m: no contact, so the time out of the corridor (1.0 to 1.1 s) may
/// serve. l = 0.208 means t_r = 1.081, within that time, and an end at 62.4 m: reading R9 refuses it.
#[test]
fn hand_an_actor_that_flickers_out_and_then_brakes_opens_nothing() {
    let scene = Scene::following(20.0, 15.0, 20.0)
        .then(1.1, -9.0, 0.0)
        .jumps_to(1.0, 3.5)
        .jumps_to(1.1, 0.0);
    let estimate = scene.ask(&Params::default());
    assert_eq!(answer(&estimate), (State::Tolerable, Some(0.175)));
    assert_eq!(estimate.binding, Some(Binding::PassThrough));
    let t_r = reaction_time(0.208, L0, 5);
    assert!(t_r > 1.0 && t_r < 1.1, "{t_r}");
    let params = Params {
        solver: Solver::Paper,
        ..Params::default()
    };
    assert!(scene.ask(&params).latency.unwrap() <= 0.175);
}

/// Both at 20 m/s, gap 5 m, the lead brakes at 9 m/s2 from 1.5 s. With l = 0.2: t_r = 1.033, slow enough after
/// 2/4.9 s more, at 1.441 s, before the lead slows. The replay ends at 20.7 + 40.8 = 61.5 m, the lead's rear at 5 +
/// 30 + 22.2 = 57.2 m. Without contact t_r may be 0.820: 4/30 s (t_r = 0.633) but not 5/30 (0.833).
#[test]
fn hand_the_two_criteria_differ() {
    let scene = Scene::following(20.0, 5.0, 20.0).then(1.5, -9.0, 0.0);
    let paper = scene.ask(&thirtieths());
    assert_eq!(answer(&paper), (State::Tolerable, Some(0.2)));
    assert_eq!(paper.fpr(), Some(5.0));
    assert!((paper.t_n.unwrap() - (t_r(0.2) + 2.0 / 4.9)).abs() < 1e-6);

    let replay = EgoMotion::new(Start::new(20.0, 0.0), t_r(0.2), 4.9);
    let inside = replay.distance(20.0) - (scene.along[2].s_at(20.0) - CAR.length);
    assert!((inside - 4.26).abs() < 0.01, "{inside}");

    let standstill = scene.ask(&Params {
        criterion: Criterion::Standstill,
        ..thirtieths()
    });
    assert_eq!(answer(&standstill), (State::Tolerable, Some(4.0 / 30.0)));
    assert_eq!((standstill.fpr(), standstill.t_n), (Some(7.5), None));
    assert_eq!(standstill.binding, Some(Binding::PassThrough));
}

fn t_r(latency: f64) -> f64 {
    reaction_time(latency, L0, 5)
}

/// Reading R22: 40 mph, a car stands 48.4 m ahead. Eq. 1 leaves (0.9 x 48.4 - 17.88^2 / 9.8) / 17.88 = 0.611 s to
/// react. From l_0 = 1/30 that is l = 3/30. With l_0 = the latency just granted the K term vanishes: l climbs as
/// long as (k + 6)/30 <= 0.611, to 13/30.
#[test]
fn hand_a_current_latency_that_follows_the_demand_settles_far_too_slow() {
    let mut scene = Scene::following(40.0 * 0.44704, 48.4, 0.0);
    let first = scene.ask(&thirtieths());
    assert_eq!(first.fpr(), Some(10.0));
    for _ in 0..30 {
        scene.current_latency = scene.ask(&thirtieths()).latency.unwrap();
    }
    assert_eq!(scene.current_latency, 13.0 / 30.0);
    assert!((scene.ask(&thirtieths()).fpr().unwrap() - 2.3).abs() < 0.01);
}

/// 20 m/s before a standing car: braking takes 40.82 m, so at 0.9 gap = 40.82 + 20 x 0.02 only t_r = 0 to 0.02 s
/// will do, and below 45.35 m nothing does.
#[test]
fn hand_beyond_the_grid_and_unavoidable() {
    let at_once = 400.0 / 9.8;
    let beyond = Scene::following(20.0, (at_once + 0.4) / 0.9, 0.0).ask(&Params::default());
    assert_eq!(answer(&beyond), (State::BeyondGrid, None));
    assert_eq!(
        (beyond.fpr(), beyond.binding),
        (Some(30.0), Some(Binding::Distance))
    );
    let too_late = Scene::following(20.0, (at_once - 0.1) / 0.9, 0.0).ask(&Params::default());
    assert_eq!(answer(&too_late), (State::Unavoidable, None));
    assert_eq!(
        (too_late.fpr(), too_late.binding),
        (Some(30.0), Some(Binding::Distance))
    );
}

/// 30 m/s, 10 m behind a lead at 10 m/s. The constraints alone accept any latency: the ego drives through, stops,
/// and later finds the lead far ahead.
#[test]
fn hand_driving_through_a_slower_lead_is_not_tolerable() {
    let estimate = Scene::following(30.0, 10.0, 10.0).ask(&Params::default());
    assert_eq!(answer(&estimate), (State::Unavoidable, None));
    assert_eq!(estimate.binding, Some(Binding::PassThrough));
}

/// 30 m/s on both sides and a lead at 50 m: at C2 = 0.9 the ego must fall to 27 m/s. With the horizon at 1 s only
/// t_r up to 1 - 3/4.9 = 0.388 s leaves it the time: l = 0.076 (t_r = 0.289), while 0.109 (0.487) fails for the
/// speed alone.
#[test]
fn hand_the_speed_binds_where_the_horizon_is_short() {
    let params = Params {
        horizon: 1.0,
        ..Params::default()
    };
    let estimate = Scene::following(30.0, 50.0, 30.0).ask(&params);
    assert_eq!(answer(&estimate), (State::Tolerable, Some(0.076)));
    assert_eq!(estimate.binding, Some(Binding::Speed));
}

#[test]
fn hand_no_conflict() {
    let aside = Scene::following(30.0, 5.0, 0.0).jumps_to(-1.0, 2.21);
    assert_eq!(
        answer(&aside.ask(&Params::default())),
        (State::None, Some(1.0))
    );
    let mut tailgater = Scene::following(10.0, -4.5 - CAR.length, 30.0);
    assert_eq!(
        answer(&tailgater.ask(&Params::default())),
        (State::None, Some(1.0))
    );
    // Half a metre further it overlaps the ego lengthwise.
    tailgater.along[0].s += 0.51;
    assert_eq!(
        answer(&tailgater.ask(&Params::default())),
        (State::Alongside, None)
    );
}

/// 2.1 m apart sideways is within the margin, but not contact: an actor abreast of the ego, a little faster, drives
/// off ahead.
#[test]
fn hand_an_actor_abreast_in_the_margin_may_be_tolerable() {
    let estimate = Scene::following(20.0, -3.0, 25.0)
        .jumps_to(-1.0, 2.1)
        .ask(&Params::default());
    assert_eq!(answer(&estimate), (State::Tolerable, Some(1.0)));
    // 1.9 m is contact: no rate helps.
    let estimate = Scene::following(20.0, -3.0, 25.0)
        .jumps_to(-1.0, 1.9)
        .ask(&Params::default());
    assert_eq!(
        (answer(&estimate), estimate.fpr()),
        ((State::Alongside, None), None)
    );
}

/// Reading R9: a car 40 m ahead in the next lane, 1 m/s faster, cuts in at 3 s and then brakes. That the ego is
/// behind it and slower before the cut-in is enough.
#[test]
fn hand_before_the_conflict_the_true_gap_counts() {
    let scene = Scene::following(20.0, 40.0, 21.0)
        .jumps_to(-1.0, 3.5)
        .jumps_to(3.0, 0.0)
        .then(3.5, -9.0, 0.0);
    let estimate = scene.ask(&Params {
        confirm_frames: 0,
        ..Params::default()
    });
    // Slow enough 0.22 s after the reaction at 1 s, well before the cut-in.
    assert_eq!(answer(&estimate), (State::Tolerable, Some(1.0)));
    assert!((estimate.t_n.unwrap() - (1.0 + 1.1 / 4.9)).abs() < 1e-6);
}

/// A stopped ego has no acceleration, whatever its sensor says: it stands.
#[test]
fn hand_a_stopped_ego_tolerates_everything_ahead() {
    let mut scene = Scene::following(0.0, 1.0, 0.0);
    scene.ego.accel = 2.0;
    assert_eq!(
        answer(&scene.ask(&Params::default())),
        (State::Standing, Some(1.0))
    );
}

/// The ego brakes at 5 m/s2 already: a_b = 5.5, and it stands after 20 m whatever the reaction time.
#[test]
fn hand_an_ego_that_stops_by_itself_needs_nobody() {
    let mut scene = Scene::following((2.0 * 5.0 * 20.0_f64).sqrt(), 22.3, 0.0);
    scene.ego.accel = -5.0;
    assert_eq!(
        answer(&scene.ask(&Params::default())),
        (State::Tolerable, Some(1.0))
    );
}

/// The jumps of Eq. 3 on a standing car: the ego is slow enough only once it stands, one jump of v_e / a_b away.
#[test]
fn hand_the_jumps_agree_with_the_exact_solver_before_a_standing_car() {
    let scene = Scene::following(15.0, 60.0, 0.0);
    let exact = scene.ask(&Params::default());
    let paper = scene.ask(&Params {
        solver: Solver::Paper,
        ..Params::default()
    });
    assert_eq!((exact.state, exact.latency), (paper.state, paper.latency));
    assert!((exact.t_n.unwrap() - paper.t_n.unwrap()).abs() < 1e-6);
}

/// The ego brakes at 6 m/s2, but the procedure of these parameters only at 4.9. A lead 7.5 m ahead at 12.445 m/s brakes
/// hard from 1.5 s on. Until then the ego may have 11.2 m/s; it falls to that by 1.5 s if it holds its own braking for
/// 1.318 s or more. l = 0.274 (t_r = 1.477) will do, 0.241 (1.279) not, nor 0.307 (1.675). To react later may be
/// better here, and no bisection of the grid would find the one latency that is tolerable.
#[test]
fn hand_a_procedure_weaker_than_the_ego_is_not_monotone() {
    let mut scene = Scene::following(20.0, 7.5, 12.445).then(1.5, -9.0, 0.0);
    scene.ego.accel = -6.0;
    let estimate = scene.ask(&Params {
        c4: 0.5,
        ..Params::default()
    });
    assert_eq!(answer(&estimate), (State::Tolerable, Some(0.274)));
}

/// Eq. 3 by hand: 20 m/s, 3 m behind a lead at 18 m/s, K = 0, l = 1. At 1 s the ego is 20 - 18.9 = 1.1 m too far and
/// 3.8 m/s too fast: the smaller jump is 3.8/4.9 = 0.776 s. At 1.776 s it is 34.04 - 31.46 = 2.57 m too far alone:
/// (16.2 + sqrt(16.2^2 + 9.8 x 2.57))/4.9 = 6.767 s, to t_n = 8.543 s. Two jumps, so one is not enough.
#[test]
fn hand_the_jumps_take_the_smaller_step_when_both_constraints_are_unmet() {
    let params = Params {
        solver: Solver::Paper,
        confirm_frames: 0,
        max_steps: 2,
        ..Params::default()
    };
    let scene = Scene::following(20.0, 3.0, 18.0);
    let estimate = scene.ask(&params);
    assert_eq!(answer(&estimate), (State::Tolerable, Some(1.0)));
    assert!(
        (estimate.t_n.unwrap() - 8.543).abs() < 1e-3,
        "{:?}",
        estimate.t_n
    );
    let one = scene.ask(&Params {
        max_steps: 1,
        ..params
    });
    assert!(one.latency != Some(1.0));
    // Nothing refuses l = 1 or the next, the jumps miss their t_n.
    assert_eq!(one.binding, None);
}

#[test]
fn hand_lists_that_are_empty_or_not_numbers_do_not_panic() {
    let mut scene = Scene::following(20.0, 30.0, 10.0);
    scene.along[0].s = f64::NAN;
    scene.across[0].d_rate = f64::NAN;
    scene.ask(&Params::default());
    scene.along.clear();
    assert_eq!(scene.ask(&Params::default()).state, State::None);
    scene.along.push(Along::constant_accel(0.0, 30.0, 0.0, 0.0));
    scene.across.clear();
    assert_eq!(scene.ask(&Params::default()).state, State::None);
    scene.across.push(Across {
        time: 5.0,
        d: 0.0,
        d_rate: 0.0,
    }); // extended backwards
    assert_eq!(scene.ask(&Params::default()).state, State::Unavoidable);
}

/// At the very instant at which the ego reacts, after 1 s, the actor's next piece begins, 15 m nearer and on the ego
/// (which went 20 m). The piece before, 30 m away and faster, holds no more at that instant; at 0.967 s it does.
#[test]
fn hand_the_end_of_a_piece_belongs_to_the_next() {
    let params = Params {
        confirm_frames: 0,
        c1: 1.0,
        c2: 1.0,
        ..Params::default()
    };
    let mut scene = Scene::following(20.0, 5.0, 25.0);
    scene
        .along
        .push(Along::constant_accel(1.0, 15.0 + CAR.length, 25.0, 0.0));
    let estimate = scene.ask(&params);
    assert_eq!(answer(&estimate), (State::Tolerable, Some(0.967)));
    assert_eq!(estimate.binding, Some(Binding::PassThrough));
}

/// A t_n may lie at the very end of the horizon: with t_r = 1 s = horizon, K = 0 frames left to confirm at l_0 = 1 s, the
/// ego at 10 m/s is at that instant behind a lead at 20 m/s, 100 m ahead.
#[test]
fn hand_the_end_of_the_horizon_counts() {
    let params = Params {
        horizon: 1.0,
        ..Params::default()
    };
    let mut scene = Scene::following(10.0, 100.0, 20.0);
    scene.current_latency = 1.0;
    let estimate = scene.ask(&params);
    assert_eq!(answer(&estimate), (State::Tolerable, Some(1.0)));
    assert_eq!((estimate.t_n, estimate.binding), (Some(1.0), None));
}
