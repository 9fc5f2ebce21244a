//! System tests: the whole loop, from scenario files to outcomes. One binary, one file per topic.
//!
//! | file | what it shows |
//! |---|---|
//! | `architecture` | the arrows between the crates are those of docs/architecture.md |
//! | `circles` | import circles inside crates are those of docs/architecture.md |
//! | `criteria` | what the nine ask for under each criterion of the estimator (`--ignored`) |
//! | `cut_out` | the side actors block the evasion; the lead's occlusion is what the cut-out asks for |
//! | `repeatable` | the same run gives the same bits; runs that differ in rates alone share their draws |
//! | `processors` | the same run gives the same bits whatever instructions the processor has |
//! | `physics` | nothing reverses, jumps or passes through anything in any of the nine |
//! | `knowledge` | the planner acts on confirmed tracks alone |
//! | `rings` | closed roads: a car that stands on one is braked for as on a straight road, laps change nothing |
//! | `turned` | boxes that stand askew, and gaps along lanes in bends |
//! | `rogue_policies` | a policy that gives what no camera may have, or more than there is, is an error that names the run |
//! | `stepwise` | a run observed and acted on from outside is that of the built-in loop; a reset run is a new one |
//! | `scheduling` | every policy drives within its budget; the estimate in the loop |
//!
//! The command itself is tested in `crates/zhuyi-cli/tests`, where Cargo hands over the real binary.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.
#![allow(clippy::print_stdout)] // A skipped test says so.

mod architecture;
mod circles;
mod criteria;
mod cut_out;
mod knowledge;
mod physics;
mod processors;
mod repeatable;
mod rings;
mod rogue_policies;
mod scheduling;
mod stepwise;
mod turned;

use zhuyi_core::FrameRates;
use zhuyi_scenario::{Scenario, Setting, Source, System, embedded, load};
use zhuyi_sim::{RunRecord, RunSpec};

/// An embedded scenario and the default system, with settings.
fn read(name: &str, settings: &[&str]) -> (Scenario, System) {
    let text = embedded::scenario(name).expect("an embedded scenario");
    let settings: Vec<_> = settings
        .iter()
        .map(|s| Setting::parse(s).expect("a setting"))
        .collect();
    load(
        &Source::new(format!("{name}.ron"), text),
        &Source::new("default.ron", embedded::system()),
        &settings,
    )
    .unwrap_or_else(|invalid| panic!("{}", invalid.render(false)))
}

/// One run at the same rate on every camera.
fn run(scenario: &Scenario, system: &System, fps: u32, seed: u64) -> RunRecord {
    let rates = FrameRates::new(vec![f64::from(fps); system.perception.eyes.len()]);
    RunSpec::new(scenario.clone(), system.clone())
        .with_seed(seed)
        .at_rates(rates.clone())
        .run_fixed()
}

/// How many of `seeds` collide.
fn collisions(scenario: &Scenario, system: &System, fps: u32, seeds: u64) -> usize {
    (0..seeds)
        .filter(|seed| run(scenario, system, fps, *seed).collided())
        .count()
}
