//! The minimum required rate with a rate of its own for each camera: a frontier in place of a number.
//!
//! ```text
//!  scenarios ──same rate on all──▶ MRF ──▶ [search]: settle ──▶ frontier ──check──▶ collides? settle again
//!                                                                  └─ beside it, for one scenario, every combination
//! ```
//! Each analysed camera has its own rate; a camera that is not analysed goes with the first analysed one of its group, or keeps
//! the rate of the system file and is not counted (reading R19: `front_60` goes with `front_120`, `rear` keeps 30). A
//! combination is free when none of the seeds collides, and safe when it and all in which no camera is slower are free
//! ([`combinations`]). The draws are those of the seed alone, whatever the rates (reading R18).
//!
//! A run ends at its first collision, a combination at its first seed that collides, seeds in ascending order; no estimator is
//! asked. A run is counted once, however often its outcome is used. The paper (section on related work) holds that the grid
//! search of Suraksha "could easily become infeasible in multi-camera setting"; here both are counted. What is left
//! out: pruning by what a camera sees. A camera that sees nobody still takes part in the decision that a track is lost, so that
//! its rate is never proven not to matter; it is tried instead.

pub mod brute_force;
pub mod combinations;
pub mod search;
pub mod searched;

mod in_short;
mod page;
mod table;

use zhuyi_core::FrameRates;
use zhuyi_scenario::{Scenario, System};

pub use brute_force::BruteForce;
pub use combinations::Combinations;
pub use search::Search;
pub use searched::Searched;

use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::own;
use zhuyi_batch::results::Results;
use zhuyi_batch::runs::Typed;
use zhuyi_batch::sweep::{Cell, Experiment};

/// What is searched.
#[derive(Clone, Debug)]
pub struct PerCamera {
    /// The scenarios.
    pub scenarios: Vec<Scenario>,
    /// The ego.
    pub system: System,
    /// The combinations of the rates of its analysed cameras, in the order of the rig.
    pub combinations: Combinations,
    /// How many seeds, from 0; at least one.
    pub seeds: u64,
    /// The root of all randomness.
    pub root_seed: u64,
    /// The place of the scenario of which every combination is tried as well.
    pub brute_force: Option<usize>,
    /// How to type one of the runs.
    pub typed: Typed,
    /// The command that makes its files, for them to tell.
    pub command: String,
}

/// What it took to know whether combinations collide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// How many were tried.
    pub combinations: u64,
    /// How many runs that took.
    pub runs: u64,
}

/// All that the files tell.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Each scenario, in their order.
    pub scenarios: Vec<Searched>,
    /// The one of which every combination was tried.
    pub brute_force: Option<BruteForce>,
}

/// Whether some seed collides, and how many runs it took to know.
#[derive(Clone, Copy, Debug)]
struct Trial {
    collides: bool,
    runs: u64,
}

/// Makes the files `mrf_per_camera.md` and `mrf_per_camera.csv`.
///
/// # Panics
/// If there is no seed, or the combinations are not those of the system's analysed cameras.
pub fn per_camera(plan: &PerCamera, progress: &dyn Progress) -> Results {
    let found = found(plan, progress);
    Results {
        files: vec![
            ("mrf_per_camera.md", page::markdown(plan, &found)),
            ("mrf_per_camera.csv", table::csv(plan, &found)),
        ],
        claims: Vec::new(),
        summary: page::summary(plan, &found),
    }
}

/// Searches without telling it.
///
/// # Panics
/// If there is no seed, or the combinations are not those of the system's analysed cameras.
pub fn found(plan: &PerCamera, progress: &dyn Progress) -> Found {
    assert!(plan.seeds > 0, "at least one seed");
    assert_eq!(
        plan.combinations.cameras(),
        plan.cameras().count(),
        "one rate per analysed camera"
    );
    Found {
        scenarios: searched::all(plan, progress),
        brute_force: plan
            .brute_force
            .map(|scenario| BruteForce::of(plan, scenario, progress)),
    }
}

impl PerCamera {
    /// What its runs have in common.
    pub fn experiment(&self) -> Experiment<'_> {
        Experiment {
            scenarios: &self.scenarios,
            system: &self.system,
            root_seed: self.root_seed,
        }
    }

    /// The places of the cameras that have a rate of their own.
    pub fn cameras(&self) -> impl Iterator<Item = usize> {
        analysed(&self.system)
    }

    /// Their names.
    pub fn names(&self) -> Vec<&str> {
        let eyes = &self.system.perception.eyes;
        self.cameras()
            .map(|place| eyes[place].camera.name.as_str())
            .collect()
    }

    /// The rates of all cameras in a combination.
    pub fn frame_rates(&self, combination: usize) -> FrameRates {
        let mut demands = self.system.default_rates.all().to_vec();
        for (camera, rate) in self.cameras().zip(self.combinations.rates(combination)) {
            demands[camera] = f64::from(rate);
        }
        own(&self.system, &demands)
    }

    /// The name of a run.
    pub(crate) fn cell(&self, scenario: usize, combination: usize, seed: u64) -> Cell {
        Cell {
            scenario,
            rates: self.frame_rates(combination),
            seed,
        }
    }

    /// Tries a combination, up to its first seed that collides.
    fn attempt(&self, scenario: usize, combination: usize) -> Trial {
        let mut cell = self.cell(scenario, combination, 0);
        let experiment = self.experiment();
        for seed in 0..self.seeds {
            cell.seed = seed;
            if experiment.collides(&cell) {
                let (collides, runs) = (true, seed + 1);
                return Trial { collides, runs };
            }
        }
        Trial {
            collides: false,
            runs: self.seeds,
        }
    }
}

/// The places of a system's analysed cameras.
pub fn analysed(system: &System) -> impl Iterator<Item = usize> {
    let eyes = system.perception.eyes.iter().enumerate();
    eyes.filter(|(_, eye)| eye.camera.analysed)
        .map(|(place, _)| place)
}

impl Effort {
    fn add(&mut self, trial: Trial) {
        self.combinations += 1;
        self.runs += trial.runs;
    }

    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            combinations: self.combinations + other.combinations,
            runs: self.runs + other.runs,
        }
    }
}
