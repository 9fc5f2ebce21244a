//! Wall time of the numbers that matter: a whole run, and its offline estimate. One call of the estimator is timed and
//! counted by the benches `estimator` and `instructions`.
//!
//! `cargo bench --bench drive`. Machines are noisy: quote medians and ratios. Instruction counts repeat to the last digit:
//! `valgrind --tool=callgrind target/release/zhuyi run cut-in`.

use divan::Bencher;
use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Draws, Hindsight, Simulation};

fn main() {
    divan::main();
}

fn read(name: &str) -> (Scenario, System) {
    let text = embedded::scenario(name).expect("an embedded scenario");
    let system = Source::new("default.ron", embedded::system());
    load(&Source::new(format!("{name}.ron"), text), &system, &[]).expect("a valid scenario")
}

const SCENARIOS: [&str; 3] = [
    "cut-out-fast",
    "challenging-cut-in-curved",
    "vehicle-following",
];

/// 30 s at 100 Hz with five cameras at 30 FPR, without the estimate.
#[divan::bench(args = SCENARIOS)]
fn run(bencher: Bencher<'_, '_>, name: &str) {
    let (scenario, system) = read(name);
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let draws = Draws {
        root: 0,
        scenario: name,
        seed: 0,
    };
    bencher.bench_local(|| Simulation::new(&scenario, &system, &rates, draws).run());
}

/// The demand on every camera at every 10 ms step of such a run.
#[divan::bench(args = SCENARIOS)]
fn offline_estimate(bencher: Bencher<'_, '_>, name: &str) {
    let (scenario, system) = read(name);
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let run = Simulation::new(
        &scenario,
        &system,
        &rates,
        Draws {
            root: 0,
            scenario: name,
            seed: 0,
        },
    )
    .run();
    let estimator = Estimator::new(system.estimator.clone());
    bencher.bench_local(|| Hindsight::new(&run.trace, &system, &rates).peaks(&estimator));
}
