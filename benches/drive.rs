//! Wall time of the numbers that matter: a whole run, its offline estimate, one call of the estimator.
//!
//! `cargo bench --bench drive`. Machines are noisy: quote medians and ratios. Instruction counts repeat to the last digit:
//! `valgrind --tool=callgrind target/release/zhuyi run cut-in`.

use std::hint::black_box;

use divan::Bencher;
use zhuyi_core::{Across, Along, Footprint, FrameRates};
use zhuyi_estimator::{Ego, Estimator, Future, Params};
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

/// One actor on one piece of constant acceleration: a car that brakes at 3 m/s2, 40 m ahead.
#[divan::bench]
fn one_actor(bencher: Bencher<'_, '_>) {
    let estimator = Estimator::new(Params::default());
    let footprint = Footprint {
        length: 4.6,
        width: 1.85,
    };
    let ego = Ego {
        s: 0.0,
        d: 0.0,
        speed: 25.0,
        accel: 0.0,
        footprint,
    };
    let stop = 20.0 / 3.0;
    let along = [
        Along::constant_accel(0.0, 44.6, 20.0, -3.0),
        Along::constant_accel(stop, 44.6 + 10.0 * stop, 0.0, 0.0),
    ];
    let across = [Across {
        time: 0.0,
        d: 0.0,
        d_rate: 0.0,
    }];
    let future = Future {
        along: &along,
        across: &across,
        known_until: 20.0,
        now: 0.0,
    };
    bencher.bench_local(|| {
        estimator.trajectory(black_box(&ego), footprint, black_box(&future), 1.0 / 30.0)
    });
}
