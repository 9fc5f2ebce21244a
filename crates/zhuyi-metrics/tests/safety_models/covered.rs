//! Whom the models speak of, and boxes that do not stand along the path.

use crate::scene::{CAR, Scene};
use std::f64::consts::FRAC_PI_2;
use zhuyi_core::Footprint;
use zhuyi_estimator::{Estimator, Params, Reaction, SafetyModel};
use zhuyi_metrics::safety_models::{Rss, SafetyModels, TtcThreshold};

const BUS: Footprint = Footprint {
    length: 12.0,
    width: 2.5,
};

fn not_defined(scene: &Scene) -> Vec<&'static str> {
    let safety_models = SafetyModels::default();
    let models = safety_models.all().into_iter();
    let names = models.filter(|model| scene.ask(*model) == Reaction::NotDefined);
    names.map(SafetyModel::name).collect()
}

/// A car comes towards the ego at 10 m/s, and one crosses 40 m ahead: only some sources speak of them. That holds from where
/// the motion is nearer to square than to along the path; one that stands, or is behind, is covered by all.
#[test]
fn hand_models_answer_for_whom_their_source_speaks_of() {
    let towards = Scene::following(10.0, 100.0, -10.0);
    assert_eq!(not_defined(&towards), ["sff", "r157-cut-in", "r157-driver"]);
    let crosses = Scene::following(10.0, 40.0, 0.0).aside(-8.0, 4.0);
    let left_out = ["rss", "rss-capped", "sff", "r157-cut-in", "r157-driver"];
    assert_eq!(not_defined(&crosses), left_out);

    let at = |speed: f64, d_rate: f64| Scene::following(10.0, 40.0, speed).aside(-8.0, d_rate);
    assert_eq!(not_defined(&at(3.0, 3.1)), left_out);
    assert_eq!(not_defined(&at(3.0, 2.9)), [""; 0]);
    assert_eq!(
        not_defined(&at(-3.0, 2.9)),
        ["sff", "r157-cut-in", "r157-driver"]
    );
    assert_eq!(not_defined(&at(-0.05, 0.05)), [""; 0]);
    let behind = Scene::following(10.0, -30.0, -10.0).aside(-8.0, 4.0);
    assert_eq!(not_defined(&behind), [""; 0]);
    assert_eq!(not_defined(&behind.aside(-8.0, 12.0)), [""; 0]);

    let estimator = Estimator::new(Params::default());
    for model in SafetyModels::default().all() {
        let answer = estimator.by_model(model, &crosses.ego, CAR, &crosses.future(), 0.1);
        assert_eq!(answer.is_none(), left_out.contains(&model.name()));
    }
}

/// 12 m/s, braking by 3 m/s2 after accelerating by 3 m/s2 for 1 s: 12 + 1.5 + 15^2/6 = 51 m. The other at 9 m/s, 0.75 s of 3
/// m/s2, 6 m/s2: 6.75 + 0.84375 + 11.25^2/12 = 18.140625 m. At 69.140625 m the ego has 1 s; as far from one that stands it has
/// more.
#[test]
fn hand_rss_brakes_for_one_that_comes_towards_it() {
    let towards = Scene::following(12.0, 69.140_625, -9.0);
    let time = towards.time(&Rss::default());
    assert!((time - 1.0).abs() < 1e-9, "{time}");
    let standing = Scene::following(12.0, 69.140_625, 0.0);
    assert!(standing.time(&Rss::default()) > 2.0);
}

/// It crosses 40 m ahead at 4 m/s, 8 m to the right: in the ego's path from (8 - 2) / 4 = 1.5 s to (8 + 2) / 4 = 2.5 s. The
/// ego is there after 40 m: at 10 m/s it has left; at 20 m/s they meet after 2 s, at 30 m/s (1.33 s) when it comes in at 1.5 s.
#[test]
fn hand_ttc_of_one_that_crosses_is_that_of_the_boxes() {
    let ttc = TtcThreshold {
        threshold: 0.5,
        ..TtcThreshold::default()
    };
    let at = |speed: f64| Scene::following(speed, 40.0, 0.0).aside(-8.0, 4.0);
    assert_eq!(at(10.0).ask(&ttc), Reaction::NoDanger);
    assert!((at(20.0).time(&ttc) - 1.5).abs() < 1e-9);
    assert!((at(30.0).time(&ttc) - 1.0).abs() < 1e-9);
}

/// A bus of 12 m x 2.5 m stands across the path, its middle 5 m to the left, its flank 46.5 m ahead. Every model that looks at
/// the actor asks for what it asks before a car that stands there; along the path it would be in nobody's lane.
#[test]
fn hand_a_bus_across_the_path_is_what_its_extents_are() {
    let car = Scene::following(10.0, 46.5, 0.0);
    let across = car.aside(5.0, 0.0).turned(BUS, FRAC_PI_2);
    let along = car.aside(5.0, 0.0).turned(BUS, 0.0);
    for model in SafetyModels::default().all() {
        let (found, expected) = (across.ask(model), car.ask(model));
        match (found, expected) {
            (Reaction::Within(found), Reaction::Within(expected)) => {
                assert!((found - expected).abs() < 1e-6, "{}", model.name());
            }
            _ => assert_eq!(found, expected, "{}", model.name()),
        }
        if !["pylot", "rss", "rss-capped"].contains(&model.name()) {
            assert_eq!(along.ask(model), Reaction::NoDanger, "{}", model.name());
        }
    }
}
