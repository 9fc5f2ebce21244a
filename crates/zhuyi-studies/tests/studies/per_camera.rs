use rayon::ThreadPoolBuilder;
use zhuyi_batch::runs::Typed;
use zhuyi_batch::sweep::{Cell, Experiment};
use zhuyi_studies::per_camera::{Combinations, PerCamera, found};
use zhuyi_studies::{Plan, per_camera};

use crate::small::{cut_short, plan};

/// Every combination of these rates in the scenarios of a plan; the first of them by brute force, too.
fn per_camera_of(plan: Plan) -> PerCamera {
    let typed = Typed::embedded(&plan.experiment());
    PerCamera {
        combinations: Combinations::new(&plan.rates, 3).unwrap(),
        scenarios: plan.scenarios,
        system: plan.system,
        seeds: plan.seeds,
        root_seed: plan.root_seed,
        brute_force: Some(0),
        typed,
        command: "zhuyi mrf --per-camera".to_string(),
    }
}

#[test]
fn law_the_search_says_what_every_combination_says_in_fewer_runs() {
    // 343 combinations, more than a check has boxes. The conflict is over after 10 s.
    let plan = cut_short(
        plan(&["challenging-cut-in"], &[1, 2, 3, 4, 5, 6, 30], 2),
        10,
    );
    let plan = per_camera_of(plan);
    let found = found(&plan, &());
    let (searched, all) = (&found.scenarios[0], found.brute_force.as_ref().unwrap());
    assert_eq!(all.effort.combinations, 343);
    assert_eq!(searched.frontier, all.frontier);
    assert_eq!(all.differences(searched), 0);
    assert!(all.collides.contains(&true) && !all.frontier.is_empty());
    let found = searched.uniform.and(searched.settled);
    assert!(
        found.runs * 10 < all.effort.runs,
        "{found:?}, {:?}",
        all.effort
    );
    assert!(
        searched.effort().runs < all.effort.runs,
        "{:?}",
        searched.effort()
    );
}

#[test]
fn law_a_combination_ends_at_its_first_collision_and_is_the_run_of_its_rates() {
    // At 2 FPR in front, seeds 0 to 3 are free of collisions and seed 4 collides.
    let plan = cut_short(plan(&["challenging-cut-in"], &[2, 30], 6), 10);
    let plan = per_camera_of(plan);
    let all = found(&plan, &()).brute_force.unwrap();
    let experiment = plan.experiment();
    let mut runs = 0;
    for (place, collides) in all.collides.iter().enumerate() {
        let rates = plan.combinations.rates(place);
        let frame_rates = plan.frame_rates(place);
        // front_120, front_60 with it, left, right, and rear as the system has it.
        let expected = [rates[0], rates[0], rates[1], rates[2], 30].map(f64::from);
        assert_eq!(frame_rates.all(), expected);
        let collided = |seed: &u64| collided(&experiment, &frame_rates, *seed);
        let first = (0..plan.seeds).find(collided);
        assert_eq!(*collides, first.is_some(), "{rates:?}");
        runs += first.map_or(plan.seeds, |seed| seed + 1);
    }
    assert_eq!((all.effort.combinations, all.effort.runs), (8, runs));
    assert!(all.collides.contains(&true) && all.collides.contains(&false));
}

fn collided(experiment: &Experiment<'_>, rates: &zhuyi_core::FrameRates, seed: u64) -> bool {
    let cell = Cell {
        scenario: 0,
        rates: rates.clone(),
        seed,
    };
    experiment.record(&cell, &[]).collision.is_some()
}

#[test]
fn law_the_same_files_at_one_and_two_threads() {
    let plan = cut_short(plan(&["cut-out", "challenging-cut-in"], &[1, 3, 30], 1), 8);
    let plan = per_camera_of(plan);
    let at = |threads: usize| {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| per_camera(&plan, &()))
    };
    let one = at(1);
    assert_eq!(one, at(2));
    let [("mrf_per_camera.md", page), ("mrf_per_camera.csv", csv)] = one.files.as_slice() else {
        panic!("{:?}", one.files)
    };
    for words in [
        "Written by `zhuyi mrf --per-camera`: rates 1, 3, 30 FPR on each of front_120, left and right \
         (front_60 goes with front_120, rear keeps 30 and is not counted), 1 seed, root seed 0.",
        "## How slow each camera may be",
        "## Every combination of cut-out",
        "Both agree on which of them are safe",
        "One of the runs again: `zhuyi run cut-out --fpr front_120=",
    ] {
        assert!(page.contains(words), "{words} is not in\n{page}");
    }
    let header =
        "scenario,method,quantity,front_120_hz,left_hz,right_hz,value\ncut-out,search,mrf_hz,,,,";
    assert!(csv.starts_with(header), "{csv}");
    for row in [
        "cut-out,brute_force,combinations,,,,27\n",
        "cut-out,both,combinations_judged_differently,,,,0\n",
        "challenging-cut-in,search,violations,,,,0\n",
    ] {
        assert!(csv.contains(row), "{row} is not in\n{csv}");
    }
}
