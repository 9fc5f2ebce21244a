//! The paper's table, end to end: a plan, its runs, and every file made from them.
//!
//! ```text
//!  Plan ──▶ sweep ──▶ Table ─┬────────────────▶ table1.md, table1.csv
//!                │           └─▶ claims ──────▶ claims.md
//!                └─▶ reruns at the rates asked for ─▶ runs.csv          manifest.json
//!       └──a few runs step by step, for claims 5 to 9 ─▶ claims.md
//! ```
//! Nothing here reads a clock, a path or the machine: the same plan makes the same bytes.

use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Invalid, Scenario, Source, System, embedded};

use crate::claims;
use crate::estimators::VARIANTS;
use crate::manifest;
use crate::paper;
use crate::progress::Progress;
use crate::rates::uniform;
use crate::reruns::Reruns;
use crate::results::Results;
use crate::runs;
use crate::summary;
use crate::sweep::{Cell, Experiment, grid};
use crate::table::{Table, files};
use crate::text::spans;

/// What is run: every scenario at every rate with every seed.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The scenarios, in the order of the table.
    pub scenarios: Vec<Scenario>,
    /// The ego.
    pub system: System,
    /// The texts of the scenarios, in their order, for their hashes.
    pub scenario_sources: Vec<Source>,
    /// The text of the system, for its hash.
    pub system_source: Source,
    /// [Hz] the rates, the same on all cameras, ascending and at least one.
    pub rates: Vec<u32>,
    /// How many seeds, from 0; at least one.
    pub seeds: u64,
    /// The root of all randomness.
    pub root_seed: u64,
}

impl Plan {
    /// The paper's experiment, rates 1 to 30 and ten seeds, on these files.
    ///
    /// # Errors
    /// All violations of all files.
    pub fn read(scenarios: &[Source], system: &Source) -> Result<Self, Invalid> {
        let meant = System::read(system, &[])?;
        let mut read = Vec::new();
        let mut invalid: Option<Invalid> = None;
        for source in scenarios {
            match Scenario::read(source, &meant, &[]) {
                Ok(scenario) => read.push(scenario),
                Err(more) => {
                    invalid = Some(match invalid {
                        Some(found) => found.and(more),
                        None => more,
                    });
                }
            }
        }
        invalid.map_or(Ok(()), Err)?;
        Ok(Self {
            scenarios: read,
            system: meant,
            scenario_sources: scenarios.to_vec(),
            system_source: system.clone(),
            rates: (1..=30).collect(),
            seeds: 10,
            root_seed: 0,
        })
    }

    /// The paper's experiment on the files that come with the program.
    ///
    /// # Errors
    /// When they are broken, which the tests of zhuyi-scenario exclude.
    pub fn embedded() -> Result<Self, Invalid> {
        let scenario = |name| {
            Some(Source::new(
                format!("{name}.ron"),
                embedded::scenario(name)?,
            ))
        };
        let scenarios: Vec<Source> = embedded::names().filter_map(scenario).collect();
        Self::read(&scenarios, &Source::new("default.ron", embedded::system()))
    }

    /// Its runs, in order.
    pub fn cells(&self) -> Vec<Cell> {
        let rates: Vec<FrameRates> = self
            .rates
            .iter()
            .map(|rate| uniform(&self.system, *rate))
            .collect();
        grid(self.scenarios.len(), &rates, 0..self.seeds)
    }

    /// What its runs have in common.
    pub fn experiment(&self) -> Experiment<'_> {
        Experiment {
            scenarios: &self.scenarios,
            system: &self.system,
            root_seed: self.root_seed,
        }
    }

    /// [Hz] the highest of its rates.
    pub fn highest_rate(&self) -> u32 {
        self.rates.last().copied().unwrap_or(1)
    }

    /// The place of a scenario among those of the plan.
    pub fn place(&self, scenario: &str) -> Option<usize> {
        self.scenarios.iter().position(|one| one.name == scenario)
    }

    /// Panics where the docs of its fields are not heeded.
    pub(crate) fn assert_complete(&self) {
        assert!(
            !self.rates.is_empty() && self.rates.is_sorted(),
            "rates in ascending order, got {:?}",
            self.rates
        );
        assert!(self.seeds > 0, "at least one seed");
    }

    /// The command that makes its files from the scenarios and system that come with the program.
    pub(crate) fn command(&self) -> String {
        let rates: Vec<_> = self.rates.iter().map(u32::to_string).collect();
        let fpr = if self.rates.iter().copied().eq(1..=30) {
            String::new()
        } else {
            format!(" --fpr {}", rates.join(","))
        };
        let seeds = if self.seeds == 10 {
            String::new()
        } else {
            format!(" --seeds {}", self.seeds)
        };
        format!("zhuyi reproduce{fpr}{seeds}")
    }

    /// How it is told in the files: `rates 1 to 30, 10 seeds, root seed 0`.
    pub(crate) fn spelt(&self) -> String {
        let Self {
            seeds,
            root_seed,
            rates,
            ..
        } = self;
        format!(
            "rates {} FPR, {seeds} seeds, root seed {root_seed}",
            spans(rates)
        )
    }
}

/// Runs the plan and makes the files `table1.md`, `table1.csv`, `claims.md`, `runs.csv` and `manifest.json`.
///
/// # Panics
/// If the plan has no rate, a rate of 0, rates out of order or no seed.
pub fn reproduce(plan: &Plan, progress: &dyn Progress) -> Results {
    plan.assert_complete();
    let (experiment, cells) = (plan.experiment(), plan.cells());
    let estimators = VARIANTS.map(|variant| variant.estimator(&plan.system));
    progress.start("runs", cells.len() as u64);
    let records = experiment.run(&cells, |cell| put_to(cell, &estimators), || progress.step());
    let table = Table::new(plan, &records);
    let reruns = Reruns::new(plan, &records, progress);
    let mut claims = claims::examine(plan, &table, &reruns);
    claims.extend(claims::examine_runs(plan, progress));
    let parts = [
        ("sweep", records.as_slice()),
        ("rerun_largest", &reruns.largest),
        ("rerun_own", &reruns.own),
    ];
    Results {
        files: vec![
            ("table1.md", files::markdown(plan, &table)),
            ("table1.csv", files::csv(&table)),
            ("claims.md", claims::markdown(plan, &claims)),
            ("runs.csv", runs::csv(&experiment, &parts)),
            ("manifest.json", manifest::json(plan)),
        ],
        summary: summary::text(plan, &table, &claims),
        claims,
    }
}

/// At the rates of the paper's table every variant, elsewhere the table's own alone, which its sums need.
fn put_to<'e>(cell: &Cell, estimators: &'e [Estimator]) -> &'e [Estimator] {
    let rate = cell.rates.all()[0];
    let in_the_paper = paper::RATES.iter().any(|tested| f64::from(*tested) == rate);
    if in_the_paper {
        estimators
    } else {
        &estimators[..1]
    }
}
