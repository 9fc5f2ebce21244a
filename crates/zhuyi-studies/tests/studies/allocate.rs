use rayon::ThreadPoolBuilder;
use zhuyi_batch::rates::group;
use zhuyi_core::FrameRates;
use zhuyi_scheduler::search::allocations;
use zhuyi_sim::RunSpec;
use zhuyi_studies::allocate::tally::{newcombe, paired, safe_from};
use zhuyi_studies::allocate::{Allocated, BEST_STATIC, all_policies};
use zhuyi_studies::{Allocating, Budgets, allocate};

use crate::small::plan;

/// These embedded scenarios under these policies.
fn allocating(names: &[&str], budgets: Budgets, policies: &[&str], seeds: u64) -> Allocating {
    let plan = plan(names, &[30], seeds);
    Allocating {
        scenarios: plan.scenarios,
        system: plan.system,
        root_seed: 0,
        seeds,
        budgets,
        policies: policies.iter().map(|name| (*name).to_string()).collect(),
        command: "zhuyi allocate".to_string(),
    }
}

fn collisions(allocated: &Allocated, policy: usize, budget: usize) -> usize {
    let cell = &allocated.cells[policy][budget];
    cell.all().filter(|d| d.collision.is_some()).count()
}

/// What the paper could not do: half of what equal parts need is enough where it goes to the camera that needs it, and a
/// demand that knows only of who is confirmed comes too late for that.
#[test]
fn hand_phantoms_are_safe_at_half_of_what_equal_parts_need() {
    let plan = allocating(
        &["cut-out-fast"],
        Budgets::Fps(vec![15.0, 25.0, 30.0]),
        &["uniform", "demand-first", "phantom"],
        3,
    );
    let found = allocate(&plan, &()).unwrap();
    assert_eq!(collisions(&found, 0, 0), 3);
    assert!(collisions(&found, 0, 1) > 0);
    assert_eq!(collisions(&found, 0, 2), 0);
    assert_eq!(collisions(&found, 1, 0), 3);
    assert_eq!(collisions(&found, 2, 0), 0);
    let half = found.cells[2][0].all().zip(found.cells[0][2].all());
    for (phantom, uniform) in half {
        let frames = [phantom, uniform].map(|driven| driven.frames.processed);
        assert!(2 * frames[0] < frames[1] + 30, "{frames:?}");
    }
    // Met in full, the demand of who is confirmed is no safer than that.
    let [only, first, phantoms] = found.smallest.as_slice() else {
        panic!("three policies")
    };
    assert!(only.tally.collisions > 0 && only.budget > first.budget);
    assert_eq!((first.tally.collisions, phantoms.tally.collisions), (0, 0));
}

/// One and two threads make the same files, and each row of the table is there.
#[test]
fn law_the_same_bytes_at_any_number_of_threads() {
    let policies = all_policies();
    let names: Vec<&str> = policies.iter().map(String::as_str).collect();
    let mut plan = allocating(
        &["cut-in", "front-right-activity-1"],
        Budgets::Fps(vec![4.0, 10.0]),
        &names,
        2,
    );
    for scenario in &mut plan.scenarios {
        scenario.duration = zhuyi_core::SimTime::from_millis(6000);
    }
    let files = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let found = allocate(&plan, &()).unwrap();
            found.results(&plan, Vec::new()).files
        })
    };
    let one = files(1);
    assert_eq!(one, files(2));
    let (name, csv) = &one[1];
    assert_eq!(*name, "allocation.csv");
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    // Two scenarios and both together, at two budgets.
    assert_eq!(rows.len(), 3 * 2 * policies.len());
}

/// The search gives up early and remembers; trying every allocation in full finds no better one.
#[test]
fn law_the_best_static_rates_are_those_of_trying_all() {
    let plan = allocating(
        &["cut-out-fast"],
        Budgets::Fps(vec![10.0, 13.0]),
        &[BEST_STATIC],
        2,
    );
    let found = allocate(&plan, &()).unwrap();
    for (place, budget) in [10.0, 13.0].into_iter().enumerate() {
        let cost = |rates: &Vec<f64>| {
            let names = ["front", "left", "right", "rear"];
            let of = |name: &str| rates[names.iter().position(|n| *n == group(name)).unwrap()];
            let eyes = plan.system.perception.eyes.iter();
            let rates = FrameRates::new(eyes.map(|eye| of(&eye.camera.name)).collect());
            let collides = |seed: u64| {
                let scenario = &plan.scenarios[0];
                let run = RunSpec::new(scenario.clone(), plan.system.clone())
                    .with_seed(seed)
                    .at_rates(rates.clone())
                    .run_fixed();
                usize::from(run.collided())
            };
            (0..2).map(collides).sum::<usize>()
        };
        let choices = zhuyi_studies::allocate::best_static::CHOICES;
        let candidates = allocations(&[2, 1, 1, 1], &choices, budget);
        let least = candidates.iter().map(cost).min().unwrap();
        let best = &found.best_static[place];
        assert_eq!(best.collisions as usize, least, "{}", best.policy);
        assert_eq!(collisions(&found, 0, place), least);
        assert!(best.tried as usize <= candidates.len());
    }
}

/// 20.784 TOPS are 40 frames a second.
#[test]
fn hand_a_budget_in_tops_is_one_in_frames_that_queue() {
    let plan = allocating(
        &["cut-in"],
        Budgets::Tops(vec![20.784]),
        &["uniform", "edf"],
        1,
    );
    let [budget] = plan.budgets().try_into().unwrap();
    assert!((budget.fps - 40.0).abs() < 1e-9);
    let found = allocate(&plan, &()).unwrap();
    for cells in &found.cells {
        let driven = cells[0].drives[0][0];
        let per_second = driven.frames.processed as f64 / driven.seconds;
        assert!((39.0..=40.0).contains(&per_second), "{per_second}");
        assert_eq!(driven.collision, None);
    }
    let results = found.results(&plan, Vec::new());
    assert_eq!(results.files[0].0, "allocation_tops.md");
}

#[test]
fn hand_pairs_of_the_same_drives() {
    let plan = allocating(
        &["cut-out-fast"],
        Budgets::Fps(vec![25.0]),
        &["uniform", "phantom"],
        4,
    );
    let found = allocate(&plan, &()).unwrap();
    let (uniform, phantom) = (&found.cells[0][0], &found.cells[1][0]);
    let pair = paired(phantom, uniform);
    assert_eq!(pair.only_first, 0);
    assert_eq!(pair.only_second as usize, collisions(&found, 0, 0));
    let itself = paired(uniform, uniform);
    assert_eq!((itself.only_first, itself.only_second), (0, 0));
    assert_eq!((itself.collisions.value, itself.frames.value), (0.0, 0.0));
    // Whichever comes first.
    let back = paired(uniform, phantom);
    assert!((back.collisions.low + pair.collisions.high).abs() < 1e-12);
}

/// Newcombe (1998), an example of method 10.
#[test]
fn paper_the_interval_for_pairs() {
    let found = newcombe([36, 12, 2, 0]);
    assert!((found.low - 0.0569).abs() < 5e-5 && (found.high - 0.3404).abs() < 5e-5);
}

#[test]
fn hand_a_budget_is_safe_where_all_larger_ones_are() {
    assert_eq!(safe_from(&[0, 2, 0]), Some(2));
    assert_eq!(safe_from(&[0, 0]), Some(0));
    assert_eq!(safe_from(&[1]), None);
}
