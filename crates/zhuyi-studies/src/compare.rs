//! All models on the same runs: what each asked for, what was needed, and what came of it.
//!
//! ```text
//!  runs at one rate ──▶ every step, every model ──▶ [audit]: asked against needed ──┐
//!         └─ largest demands ──▶ run again at them ──▶ [closed_loop]: collisions ───┼──▶ compare.md, compare.csv,
//!  runs at 1 to 30 FPR ──▶ MRF ───────────────────────────┘        [scenes] ────────┘    compare_demand.csv
//! ```
//! What was needed has two senses that do not lean on each other:
//!
//! - at a step: the largest latency of the grid with which an ego that holds a_0 for t_r and then brakes at a_b touches
//!   nobody within the horizon, given the future that was recorded (criterion `standstill`: it has none of the margins
//!   C1 and C2, so what is called too little here ends in a contact, not in a margin used up). It is the answer of Zhuyi's own
//!   procedure, with the same a_b and the same held a_0, which favours `zhuyi` over models that assume other things;
//! - in a scenario: the MRF of the closed loop, whose planner brakes as it likes, and the runs made again at what was asked: it favours
//!   no model's assumptions.
//!
//! Every model is asked about the same step with the same l_0, the same confirmation and the same grid of latencies, and
//! counts the same actors for the same cameras (readings R14, R21). Left out: what a model would have made of a run that
//! it had steered itself, and of perceived in place of true motion.

pub mod audit;
pub mod causes;
pub mod closed_loop;
pub mod curve;
pub mod joint;
pub mod models;
pub mod scenes;

mod findings;
mod ideas;
mod in_short;
mod page;
mod table;

use rayon::prelude::*;
use zhuyi_core::FrameRates;
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::{Outcome, RunSpec, STEP};

use audit::{Audit, Audited};
use closed_loop::ClosedLoop;
use models::{Assumptions, Panel};
use zhuyi_batch::parallel::one_by_one;
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::uniform;
use zhuyi_batch::results::Results;
use zhuyi_batch::sweep::{Cell, Experiment, grid};

/// What is compared on what.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The scenarios.
    pub scenarios: Vec<Scenario>,
    /// The ego.
    pub system: System,
    /// The root of all randomness.
    pub root_seed: u64,
    /// [Hz] the rate of all cameras in the runs that the models are asked about.
    pub fpr: u32,
    /// How many seeds, from 0; at least one.
    pub seeds: u64,
    /// How many steps apart the models are asked; at least one.
    pub every: usize,
    /// The command that makes its files, for them to tell.
    pub command: String,
}

impl Comparison {
    /// What its runs have in common.
    pub fn experiment(&self) -> Experiment<'_> {
        Experiment {
            scenarios: &self.scenarios,
            system: &self.system,
            root_seed: self.root_seed,
        }
    }

    /// Whether the demands of a camera count.
    pub(crate) fn analysed(&self) -> impl Iterator<Item = usize> {
        let eyes = self.system.perception.eyes.iter().enumerate();
        eyes.filter(|(_, eye)| eye.camera.analysed)
            .map(|(place, _)| place)
    }

    /// [ms] from one step at which the models are asked to the next.
    pub(crate) fn every_ms(&self) -> f64 {
        self.every as f64 * STEP.seconds() * 1000.0
    }
}

/// All that the files tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Names of the models, in the order of all columns; what was needed is the answer of that at [`models::NEEDED`].
    pub models: Vec<&'static str>,
    /// Their parameters.
    pub assumptions: Assumptions,
    /// What came of each scenario, in their order.
    pub scenarios: Vec<Audited>,
    /// The closed loop, in the same order.
    pub closed_loop: ClosedLoop,
}

/// Makes the files `compare.md`, `compare.csv` and `compare_demand.csv`.
///
/// # Panics
/// If there is no seed, no rate, or `every` is zero.
pub fn compare(comparison: &Comparison, progress: &dyn Progress) -> Results {
    let compared = compared(comparison, progress);
    Results {
        files: vec![
            ("compare.md", page::markdown(comparison, &compared)),
            ("compare.csv", table::csv(comparison, &compared)),
            (
                "compare_demand.csv",
                table::demand_csv(comparison, &compared),
            ),
        ],
        claims: Vec::new(),
        summary: page::summary(comparison, &compared),
    }
}

/// Makes all runs and asks all models, without telling it.
///
/// # Panics
/// If there is no seed, no rate, or `every` is zero.
pub fn compared(comparison: &Comparison, progress: &dyn Progress) -> Compared {
    let Comparison {
        seeds, every, fpr, ..
    } = comparison;
    assert!(
        *seeds > 0 && *every > 0 && *fpr > 0,
        "at least one seed, step and frame, got {seeds}, {every} and {fpr}"
    );
    let panel = Panel::new(&comparison.system);
    let rates = [uniform(&comparison.system, *fpr)];
    let cells = grid(comparison.scenarios.len(), &rates, 0..*seeds);
    progress.start("models asked", cells.len() as u64);
    let one = |cell: &Cell| {
        let audit = audited(comparison, &panel, &rates[0], cell);
        progress.step();
        audit
    };
    let runs: Vec<Option<Audit>> = one_by_one(&cells).map(one).collect();
    let scenarios: Vec<Audited> = runs
        .chunks(*seeds as usize)
        .map(|runs| Audited::new(runs, panel.models.len()))
        .collect();
    let closed_loop = ClosedLoop::new(comparison, &scenarios, progress);
    Compared {
        models: panel.names(),
        assumptions: panel.assumptions(),
        scenarios,
        closed_loop,
    }
}

/// One run put to all models; none if it collided, as in the table (reading R21).
fn audited(
    comparison: &Comparison,
    panel: &Panel,
    rates: &FrameRates,
    cell: &Cell,
) -> Option<Audit> {
    let scenario = &comparison.scenarios[cell.scenario];
    let run = RunSpec::new(scenario.clone(), comparison.system.clone())
        .with_root_seed(comparison.root_seed)
        .with_seed(cell.seed)
        .at_rates(rates.clone())
        .run_fixed();
    let completed = matches!(run.outcome, Outcome::Completed);
    completed.then(|| {
        Audit::of(
            comparison,
            panel,
            rates,
            cell.seed,
            (&run.trace, &scenario.road),
        )
    })
}
