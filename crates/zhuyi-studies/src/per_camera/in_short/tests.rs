use super::*;
use crate::Plan;
use crate::per_camera::Combinations;
use zhuyi_batch::runs::Typed;

/// 1, 2 and 3 FPR on three cameras, in the first scenarios that come with the program.
fn plan(scenarios: usize) -> PerCamera {
    let mut plan = Plan::embedded().unwrap();
    plan.scenarios.truncate(scenarios);
    PerCamera {
        typed: Typed::embedded(&plan.experiment()),
        combinations: Combinations::new(&[1, 2, 3], 3).unwrap(),
        scenarios: plan.scenarios,
        system: plan.system,
        seeds: 10,
        root_seed: 0,
        brute_force: None,
        command: String::new(),
    }
}

/// A search that came to this frontier, by levels.
fn searched(plan: &PerCamera, mrf: Mrf, frontier: &[[usize; 3]]) -> Searched {
    let all = &plan.combinations;
    let frontier: Vec<usize> = frontier.iter().map(|levels| all.at(levels)).collect();
    let above = |place: usize| frontier.iter().any(|one| all.is_at_most(*one, place));
    let effort = |combinations, runs| Effort { combinations, runs };
    Searched {
        mrf,
        cheapest: frontier.iter().copied().min_by_key(|one| all.sum(*one)),
        safe: (0..all.count()).map(above).collect(),
        frontier,
        free_but_not_safe: Vec::new(),
        uniform: effort(2, 11),
        settled: effort(3, 14),
        checked: effort(7, 70),
        violations: 0,
    }
}

fn told(plan: &PerCamera, scenarios: Vec<Searched>, brute_force: Option<BruteForce>) -> String {
    let found = Found {
        scenarios,
        brute_force,
    };
    in_short(plan, &found)
}

/// The first scenario, where all collide but what is at least one of these, by levels, and not among the `harmed`.
fn brute_force(plan: &PerCamera, from: &[[usize; 3]], harmed: &[[usize; 3]]) -> BruteForce {
    let all = &plan.combinations;
    let free = |place: usize| {
        from.iter().any(|one| all.is_at_most(all.at(one), place))
            && !harmed.iter().any(|one| all.at(one) == place)
    };
    let collides: Vec<bool> = (0..all.count()).map(|place| !free(place)).collect();
    let safe = all.safe(&collides);
    BruteForce {
        scenario: 0,
        frontier: all.minimal(&safe),
        collides,
        safe,
        effort: Effort {
            combinations: 27,
            runs: 190,
        },
    }
}

#[test]
fn hand_costs_and_idle_cameras() {
    let plan = plan(2);
    let scenarios = vec![
        searched(&plan, Mrf::Rate(3), &[[2, 0, 0]]),
        searched(&plan, Mrf::Rate(1), &[[0, 0, 0]]),
    ];
    let told = told(&plan, scenarios, None);
    for words in [
        "In 2 of 2 scenarios there is one slowest safe combination",
        "The cameras left and right never need more than 1 FPR, the lowest rate tested; front_120 does.",
        // 3 + 1 + 1 and 1 + 1 + 1 against 3 x 3 and 3 x 1.
        "take 8 FPR, added up over 2 scenarios; the same rate on all of these cameras, the MRF, takes 12: 33 % less.",
        "Over those with an MRF above 1 (1): 5 against 9, 44 % less.",
        // Twice 11 + 14 and twice 70; 2 x 27 combinations of 10 runs.
        "tried 24 of 54 combinations in 190 runs: 50 to find the slowest safe ones, 140 to check",
        "take up to 540. None of the 14 that were checked collides; that is no proof",
    ] {
        assert!(told.contains(words), "{words} is not in\n{told}");
    }
}

#[test]
fn hand_a_trade_no_frontier_and_harm() {
    let plan = plan(2);
    let mut traded = searched(&plan, Mrf::Rate(2), &[[0, 2, 0], [2, 0, 0], [1, 1, 1]]);
    traded.violations = 4;
    let none = searched(&plan, Mrf::Above(3), &[]);
    let told = told(&plan, vec![traded, none], None);
    for words in [
        "In 0 of 2 scenarios there is one slowest",
        "In 1 there are several. In 1 even the highest rates collide.",
        "take 5 FPR, added up over 1 scenario; the same rate on all of these cameras, the MRF, takes 6: 17 % less.",
        "Of the 14 that were checked 4 collide although one with a slower camera does not: a higher rate can harm.",
    ] {
        assert!(told.contains(words), "{words} is not in\n{told}");
    }
    assert!(!told.contains("never need"), "{told}");
}

#[test]
fn hand_agreement_and_the_lack_of_it_are_told() {
    let plan = plan(1);
    let searched = || vec![searched(&plan, Mrf::Rate(2), &[[1, 0, 0]])];
    let agreed = told(
        &plan,
        searched(),
        Some(brute_force(&plan, &[[1, 0, 0]], &[])),
    );
    // 190 against 11 + 14 + 70.
    for words in [
        "27 in 190 runs, 2.0 times those of the search there, 95. Both agree",
        "Nowhere does a higher rate bring a collision",
    ] {
        assert!(agreed.contains(words), "{words} is not in\n{agreed}");
    }
    // (3, 1, 1) collides: it and (2, 1, 1) are not safe.
    let harmed = brute_force(&plan, &[[1, 0, 0]], &[[2, 0, 0]]);
    let told = told(&plan, searched(), Some(harmed));
    for words in [
        "THEY DO NOT AGREE: the search takes 2 to be safe that are not.",
        "in truth: (2, 1, 2) and (2, 2, 1).",
        "To 1 combination free of collisions there is one that collides",
    ] {
        assert!(told.contains(words), "{words} is not in\n{told}");
    }
}
