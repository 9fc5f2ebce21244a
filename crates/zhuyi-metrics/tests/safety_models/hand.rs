//! Answers worked by hand, and who is no danger to whom.

use crate::scene::Scene;
use zhuyi_estimator::{Estimator, Params, Reaction, State};
use zhuyi_metrics::safety_models::{
    CarefulDriver, CutInRule, PylotDeadline, Rss, SafetyForceField, SafetyModels, TtcThreshold,
    VisibilityBudget,
};

fn assert_near(ours: f64, expected: f64) {
    assert!((ours - expected).abs() < 1e-9, "{ours}, not {expected}");
}

#[test]
fn hand_rss_takes_the_larger_of_both_axes() {
    // 12 m/s behind 6 m/s: braking takes 12 - 3 = 9 m. 9.75 m + 13.5 m of response: with rho = 1 the ego reaches
    // 15 m/s: 12 + 1.5 + 225/12 - 3 = 29.25 m.
    let scene = Scene::following(12.0, 29.25, 6.0);
    assert_near(scene.time(&Rss::default()), 1.0);
    // In the next lane, 1.5 m between the sides: 1.5 - 0.3 - 0.5625 = rho^2. Nearer than 9 m only this counts, at
    // 29.25 m the longitudinal axis leaves more time.
    let near = Scene::following(12.0, 8.0, 6.0).aside(3.5, 0.0);
    assert_near(near.time(&Rss::default()), 0.6375_f64.sqrt());
    assert_near(scene.aside(3.5, 0.0).time(&Rss::default()), 1.0);
    // It drifts over at 1 m/s: 0.75 + 0.28125 + 1.75^2/2 = 2.5625 m of its own, more than there are.
    assert_eq!(
        near.aside(3.5, -1.0).ask(&Rss::default()),
        Reaction::TooLate
    );
    // In the ego's lane, nearer than 9 m: both axes are violated.
    let in_lane = Scene::following(12.0, 8.0, 6.0);
    assert_eq!(in_lane.ask(&Rss::default()), Reaction::TooLate);
}

#[test]
fn hand_a_cap_leaves_more_time() {
    // 20 m/s is above the cap of 50 km/h: the ego holds it. 20^2/12 - 10^2/12 = 25 m, the other 20 m are 1 s.
    let scene = Scene::following(20.0, 45.0, 10.0);
    assert_near(scene.time(&Rss::capped()), 1.0);
    assert!(scene.time(&Rss::default()) < 1.0);
}

#[test]
fn hand_sff_lets_both_brake() {
    // Both at 20 m/s brake alike: what the ego loses is 20 t_r.
    let sff = SafetyForceField::default();
    assert_near(Scene::following(20.0, 10.0, 20.0).time(&sff), 0.5);
    // The other may brake by 8 and the ego by no more than 5: 40 m - 25 m = 15 m.
    let bounds = SafetyForceField {
        least_decel: 5.0,
        most_decel: 8.0,
    };
    assert_near(Scene::following(20.0, 25.0, 20.0).time(&bounds), 0.5);
    // It crosses the lane at 20 m/s, 1 m to the side on 4 m, and is out of it after 20 m and before the ego is there.
    let crossing = Scene::following(10.0, 60.0, 20.0).aside(3.0, -5.0);
    assert_eq!(crossing.ask(&sff), Reaction::NoDanger);
    // At 10 m/s it comes to stand in the lane after 100/12 m, which are also what the ego needs: 60 m are 6 s.
    let stuck = Scene::following(10.0, 60.0, 10.0).aside(3.0, -5.0);
    assert_near(stuck.time(&sff), 6.0);
    // Its heading brings it 3.5 - 2 = 1.5 m over in 15 m of driving; standing after 12 m it never gets there.
    let drifting = Scene::following(30.0, 10.0, 12.0).aside(3.5, -1.2);
    assert_eq!(drifting.ask(&sff), Reaction::NoDanger);
}

#[test]
fn hand_the_driver_takes_the_actor_as_it_goes_on() {
    let sharp = CarefulDriver {
        decel: 6.0,
        build_up: 0.0,
    };
    // 20 m/s behind 8 m/s: 12^2/12 = 12 m, the other 24 m are 2 s.
    assert_near(Scene::following(20.0, 36.0, 8.0).time(&sharp), 2.0);
    // In the next lane and drifting over at 0.5 m/s it is there after 3 s, when the 36 m are just closed.
    let drifting = Scene::following(20.0, 36.0, 8.0).aside(3.5, -0.5);
    assert_near(drifting.time(&sharp), 2.0);
    assert_eq!(drifting.aside(3.5, 0.5).ask(&sharp), Reaction::NoDanger);
    // At 1/3 m/s it is there after 4.5 s: the ego has passed 54 m by then and needs 36 + 2 x 4 m.
    let slow = drifting.aside(3.5, -1.0 / 3.0);
    assert_eq!(slow.ask(&sharp), Reaction::NoDanger);
    // An ego that brakes by 6 m/s2 already does all that is needed.
    let mut braking = Scene::following(20.0, 12.0, 8.0);
    braking.ego.accel = -6.0;
    assert_eq!(braking.ask(&sharp), Reaction::NoDanger);
}

#[test]
fn hand_rules_of_ttc_look_at_the_lane() {
    // TTC = 3 s. The sides are 1.5 m apart, and 0.45 m make an actor one of the lane.
    let beside = Scene::following(20.0, 30.0, 10.0).aside(3.5, 0.0);
    for (rate, danger) in [(0.0, false), (-0.34, false), (-0.36, true), (0.36, false)] {
        let scene = beside.aside(3.5, rate);
        for answer in [
            scene.ask(&CutInRule::default()),
            scene.ask(&TtcThreshold::default()),
        ] {
            assert_eq!(answer != Reaction::NoDanger, danger, "{rate}: {answer:?}");
        }
    }
    // The ego covers the 30 m in 1.5 s, but the gap closes in 3 s.
    let entering = beside.aside(3.5, -0.36);
    assert_near(
        entering.time(&VisibilityBudget {
            decel: 10.0,
            ..VisibilityBudget::default()
        }),
        0.5,
    );
    // Less than 2 s: too late for the one, not for the other. 19 / 10 - 10 / 12.
    let near = Scene::following(20.0, 19.0, 10.0);
    assert_eq!(near.ask(&TtcThreshold::default()), Reaction::TooLate);
    assert_near(near.time(&CutInRule::default()), 1.9 - 10.0 / 12.0);
}

#[test]
fn hand_who_is_no_danger() {
    let behind = Scene::following(10.0, -8.1, 30.0);
    let far_aside = Scene::following(20.0, 5.0, 0.0).aside(30.0, 0.0);
    let faster = Scene::following(10.0, 5.0, 30.0);
    for (scene, but) in [
        (behind, vec!["pylot"]),
        // RSS: 28 - 0.3 - 0.5625 = rho^2, so even there 5.2 s are the most.
        (far_aside, vec!["rss", "rss-capped", "pylot"]),
        // RSS and SFF expect it to brake, RoboRun does not see it move.
        (
            faster,
            vec!["rss", "rss-capped", "sff", "pylot", "visibility"],
        ),
    ] {
        let models = SafetyModels::default();
        let danger: Vec<_> = models
            .all()
            .iter()
            .filter(|model| scene.ask(**model) != Reaction::NoDanger)
            .map(|model| model.name())
            .collect();
        assert_eq!(danger, but, "{scene:?}");
    }
}

#[test]
fn hand_the_same_confirmation_for_all() {
    // Pylot at 30 m/s: 0.2 s, whatever the scene. (0.2 + 5/30) / 6 = 0.0611 s; the grid has 0.043 s below it.
    let scene = Scene::following(30.0, 10.0, 30.0);
    let estimator = Estimator::new(Params::default());
    let model = PylotDeadline::default();
    let future = scene.future();
    let estimate = estimator.by_model(&model, &scene.ego, scene.footprint, &future, 1.0 / 30.0);
    let estimate = estimate.expect("defined for all");
    assert_eq!(estimate.state, State::Tolerable);
    assert_near(estimate.latency.expect("tolerable"), 0.043);
    let latency = scene.ask(&model).latency(1.0 / 30.0, 5);
    assert_near(latency.expect("within"), 0.2 / 6.0 + 1.0 / 36.0);
}
