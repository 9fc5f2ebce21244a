//! Policies in situations worked by hand.

use crate::situation::Scene;
use zhuyi_scheduler::demands::{IMPORTANCE, OFFLINE, PHANTOM, PYLOT, RSS, TTC, ZHUYI};
use zhuyi_scheduler::search::allocations;
use zhuyi_scheduler::{PolicyError, policy};

fn rates(name: &str, scene: &Scene) -> Vec<f64> {
    let mut policy = policy(name).expect("a policy");
    scene.rates(&mut *policy).expect("rates")
}

#[test]
fn hand_each_policy_looks_at_its_own_number() {
    // Two cameras; each model asks 9 of the first and 3 of the second, or the other way round.
    let mut scene = Scene::asking(&[1.0, 1.0], 12.0);
    let settings = [
        ("proportional", ZHUYI),
        ("demand-first", ZHUYI),
        ("demand-hysteresis", ZHUYI),
        ("edf", ZHUYI),
        ("importance", IMPORTANCE),
        ("phantom", PHANTOM),
        ("rss", RSS),
        ("ttc", TTC),
        ("pylot", PYLOT),
        ("clairvoyant", OFFLINE),
    ];
    for (name, model) in settings {
        let quiet = scene.clone();
        assert_eq!(rates(name, &scene), [6.0, 6.0], "{name} without demand");
        *scene.demand(model, 0) = 9.0;
        *scene.demand(model, 1) = 3.0;
        assert_eq!(rates(name, &scene), [9.0, 3.0], "{name}");
        assert_eq!(rates("uniform", &scene), [6.0, 6.0]);
        scene = quiet;
    }
}

#[test]
fn hand_a_surplus_goes_in_proportion_or_in_equal_parts_or_is_left() {
    // 8 + 3 + 1 = 12 of 24: twice the demand, or four more for each, or as much as asked for.
    let scene = Scene::asking(&[8.0, 3.0, 1.0], 24.0);
    assert_eq!(rates("proportional", &scene), [16.0, 6.0, 2.0]);
    assert_eq!(rates("demand-first", &scene), [12.0, 7.0, 5.0]);
    for name in ["demand-only", "phantom-only"] {
        assert_eq!(rates(name, &scene), [8.0, 3.0, 1.0], "{name}");
    }
}

#[test]
fn hand_a_shortage_stops_at_the_floor() {
    // 20 + 10 + 1 + 1 = 32 of 17: 15 are left above the two floors, half the demand of the others.
    let scene = Scene::asking(&[20.0, 10.0, 1.0, 1.0], 17.0);
    for name in ["proportional", "demand-first", "demand-only", "edf", "rss"] {
        assert_eq!(rates(name, &scene), [10.0, 5.0, 1.0, 1.0], "{name}");
    }
    // With fewer frames than cameras all get the same.
    let scene = Scene::asking(&[20.0, 10.0, 1.0, 1.0], 2.0);
    assert_eq!(rates("proportional", &scene), [0.5; 4]);
}

#[test]
fn hand_no_camera_gets_more_than_thirty() {
    let scene = Scene::asking(&[50.0, 1.0], 200.0);
    for name in ["uniform", "proportional", "demand-first", "importance"] {
        assert_eq!(rates(name, &scene), [30.0, 30.0], "{name}");
    }
}

#[test]
fn hand_many_harmless_actors_outweigh_an_urgent_one_in_importance_only() {
    // In front one actor at 8 FPR; to the left twelve at 1 FPR each, whose largest is 1.
    let mut scene = Scene::asking(&[8.0, 1.0], 20.0);
    *scene.demand(IMPORTANCE, 1) = 12.0;
    assert_eq!(rates("importance", &scene), [8.0, 12.0]);
    // The demands 8 and 1 leave 11 of the 20, 5.5 for each.
    assert_eq!(rates("demand-first", &scene), [13.5, 6.5]);
}

#[test]
fn hand_hysteresis_keeps_the_rates_for_a_second() {
    let mut policy = policy("demand-hysteresis").unwrap();
    let mut rates = |time: f64, demands: [f64; 2]| {
        let scene = Scene {
            time,
            ..Scene::asking(&demands, 12.0)
        };
        scene.rates(&mut *policy).unwrap()
    };
    assert_eq!(rates(0.0, [2.0, 2.0]), [6.0, 6.0]);
    assert_eq!(rates(0.1, [10.0, 2.0]), [10.0, 2.0]);
    assert_eq!(rates(0.2, [2.0, 2.0]), [10.0, 2.0]);
    assert_eq!(rates(1.1, [2.0, 2.0]), [10.0, 2.0]);
    assert_eq!(rates(1.2, [2.0, 2.0]), [6.0, 6.0]);
}

#[test]
fn hand_static_names_cameras_and_groups_and_leaves_the_rest_to_the_others() {
    // front_120, front_60, left, right, rear; 5 of 27 are left for two.
    let scene = Scene::asking(&[1.0; 5], 27.0);
    assert_eq!(
        rates("static:front=10,left=2", &scene),
        [10.0, 10.0, 2.0, 2.5, 2.5]
    );
    assert_eq!(
        rates("static:front_60=4,front=10", &scene),
        [10.0, 4.0, 13.0 / 3.0, 13.0 / 3.0, 13.0 / 3.0]
    );
}

#[test]
fn hand_static_refuses_what_it_cannot_do() {
    let refused = |name: &str, budget: f64| {
        let scene = Scene::asking(&[1.0; 3], budget);
        scene
            .rates(&mut *policy(name).unwrap())
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        refused("static:fornt=10", 30.0),
        "`static:fornt=10` names the camera `fornt`; the rig has front_120, front_60, left"
    );
    // Half a word is no group.
    assert!(refused("static:fron=10", 30.0).contains("names the camera `fron`;"));
    // 2 x 10 and the floor of 1 for the left one.
    assert_eq!(
        refused("static:front=10", 20.5),
        "`static:front=10` gives 21 frames per second altogether, with a budget of 20.5"
    );
    assert_eq!(
        refused("static:left=0.5", 30.0),
        "`static:left=0.5` gives `left` 0.5 frames per second, outside 1 to 30"
    );
}

#[test]
fn hand_the_clairvoyant_needs_the_future() {
    let mut scene = Scene::asking(&[1.0, 1.0], 10.0);
    scene.demands.retain(|series| series.model != OFFLINE);
    let error = scene
        .rates(&mut *policy("clairvoyant").unwrap())
        .unwrap_err();
    assert!(matches!(error, PolicyError::NoDemand { model, .. } if model == OFFLINE));
    assert!(scene.rates(&mut *policy("proportional").unwrap()).is_ok());
}

#[test]
fn hand_a_situation_without_sense_is_an_error_for_every_policy() {
    let good = Scene::asking(&[1.0, 1.0], 10.0);
    let broken: [fn(&mut Scene); 8] = [
        |scene| scene.budget = 0.0,
        |scene| scene.budget = f64::INFINITY,
        |scene| scene.time = f64::NAN,
        |scene| scene.ego_speed = f64::NAN,
        |scene| *scene.demand(ZHUYI, 1) = f64::NAN,
        |scene| *scene.demand(OFFLINE, 1) = -1.0,
        |scene| *scene.demand(IMPORTANCE, 1) = f64::INFINITY,
        |scene| scene.rates[1] = -1.0,
    ];
    let names = zhuyi_scheduler::POLICIES.map(|entry| match entry.id {
        "static:CAMERA=RATE,.." => "static:front=2",
        "exec:COMMAND" => "exec:false",
        name => name,
    });
    for name in names {
        for breaks in broken {
            let mut scene = good.clone();
            breaks(&mut scene);
            let error = scene.rates(&mut *policy(name).unwrap()).unwrap_err();
            assert!(error.to_string().contains("must be"), "{name}: {error}");
        }
        let error = good.decided(&mut *policy(name).unwrap(), 3).unwrap_err();
        assert_eq!(error.to_string(), "3 places for the rates of 2 cameras");
    }
}

#[test]
fn hand_no_camera_is_no_problem() {
    let scene = Scene::asking(&[], 10.0);
    for name in [
        "uniform",
        "proportional",
        "demand-first",
        "importance",
        "clairvoyant",
    ] {
        assert_eq!(rates(name, &scene), [0.0; 0], "{name}");
    }
}

#[test]
fn law_the_search_finds_each_allocation_that_nothing_can_be_added_to() {
    // Against all of them: 3 groups of 2, 1 and 2 cameras.
    let (sizes, choices) = ([2, 1, 2], &[1.0, 2.0, 5.0, 10.0, 15.0, 30.0]);
    for budget in [4.0, 5.0, 11.0, 40.0, 77.5, 200.0] {
        let cost = |rates: [f64; 3]| {
            rates
                .iter()
                .zip(sizes)
                .map(|(r, n)| r * f64::from(n))
                .sum::<f64>()
        };
        let all = || {
            choices.iter().flat_map(|a| {
                choices
                    .iter()
                    .flat_map(move |b| choices.iter().map(move |c| [*a, *b, *c]))
            })
        };
        let fits: Vec<[f64; 3]> = all().filter(|rates| cost(*rates) <= budget).collect();
        let is_beaten = |rates: &[f64; 3]| {
            fits.iter()
                .any(|other| other != rates && other.iter().zip(rates).all(|(o, r)| o >= r))
        };
        let mut expected: Vec<_> = fits
            .iter()
            .filter(|rates| !is_beaten(rates))
            .map(|r| r.to_vec())
            .collect();
        let mut found = allocations(&[2, 1, 2], choices, budget);
        assert_eq!(found.is_empty(), budget < 5.0);
        expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
        found.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(found, expected, "budget {budget}");
    }
}
