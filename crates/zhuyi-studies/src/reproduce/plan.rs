//! The plan of the paper's experiment: scenarios, rates, seeds.

use zhuyi_core::FrameRates;
use zhuyi_scenario::{Invalid, Scenario, Source, System, embedded};

use zhuyi_batch::rates::uniform;
use zhuyi_batch::sweep::{Cell, Experiment, grid};
use zhuyi_batch::text::spans;

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
