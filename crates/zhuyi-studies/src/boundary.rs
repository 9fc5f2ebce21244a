//! The minimum required rate as a function of a free choice, found with the drives put on the border of safe and unsafe.
//!
//! ```text
//! MRF(v) = lowest r with no collision at (v, r') for every tested r' >= r
//!
//! rate ▲  . . . . . .        ● driven, no collision      the border is a staircase: at each value that is looked at, the cell
//!      │  ● . . ● ● .        ○ driven, a collision       above it and the one below it are driven
//!      │  ○ . . ○ ● .
//!      │  . . . . ○ .
//!      └──────────────▶ value
//! ```
//!
//! Some values far apart are scanned from the highest rate down to the first that collides. Where two of them have the same MRF, so
//! have those between; where they differ, the value halfway is looked at, from the rates of both on, until neighbours are left. At each
//! value the search goes on until the MRF is driven clean and the rate below it is driven to a collision, so a border that is not
//! where it was looked for is followed. What is taken over and never driven is then audited: cells drawn at random from all that are
//! left are driven, and those that contradict are told.
//!
//! The border is sharp only for its seeds. Where a drive in ten collides, a few centimetres shift the frames against what they see
//! and decide: within a value or two of a step the MRF may go back and forth. `zhuyi map` with the values around it shows how
//! frayed it is there.
//!
//! A cell is unsafe at its first collision and gets no more drives. Left out: what is safe below the MRF (`zhuyi mrf` tells), and
//! islands between two values of one MRF, which the audit may or may not meet.

mod search;
mod table;

use rayon::prelude::*;
use std::collections::BTreeMap;

use zhuyi_batch::choice::{Bench, Choice, Chosen};
use zhuyi_batch::mrf::Mrf;
use zhuyi_batch::parallel::one_by_one;
use zhuyi_batch::progress::Progress;
use zhuyi_batch::results::Results;
use zhuyi_batch::shares::{Share, Stop, Trials};
use zhuyi_batch::sweep::Experiment;

/// What is searched.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// The scenarios and the system.
    pub bench: Bench,
    /// What is chosen, one at a time.
    pub choices: Vec<Choice>,
    /// [Hz] rates of all cameras, ascending.
    pub rates: Vec<u32>,
    /// How many drives a cell without a collision has.
    pub seeds: u64,
    /// The root of all randomness.
    pub root_seed: u64,
    /// How many cells of each curve are audited.
    pub audits: usize,
    /// The command that searches.
    pub command: String,
}

/// The MRF of a scenario over the values of a choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The scenario's name.
    pub scenario: String,
    /// The choice.
    pub path: String,
    /// In the order of the values.
    pub points: Vec<Point>,
    /// All cells that were driven, by the places of value and rate.
    pub cells: BTreeMap<(usize, usize), Cell>,
}

/// The MRF at a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// The value, as typed.
    pub value: String,
    /// The MRF.
    pub mrf: Mrf,
    /// Whether it was driven there, not taken over from its neighbours.
    pub driven: bool,
}

/// A cell that was driven.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// What its drives came to.
    pub share: Share,
    /// Whether it was an audit, and then whether it contradicts.
    pub audit: Option<bool>,
}

impl Curve {
    /// How many drives were made.
    pub fn drives(&self) -> u64 {
        let drives = self.cells.values().map(|cell| u64::from(cell.share.drives));
        drives.sum()
    }
}

impl Boundary {
    /// The curves of what [`Bench::choose_all`] gave; those of a choice stand together.
    pub fn curves(&self, chosen: &[Vec<Chosen>], progress: &dyn Progress) -> Vec<Curve> {
        let scenarios = self.bench.scenarios.len();
        progress.start("curves", chosen.len() as u64);
        let curve = |(place, chosen): (usize, &Vec<Chosen>)| {
            let choice = &self.choices[place / scenarios];
            let drive = |value: usize, rate: usize| {
                let (scenario, system) = &chosen[value];
                let experiment = Experiment {
                    scenarios: std::slice::from_ref(scenario),
                    system,
                    root_seed: self.root_seed,
                };
                self.trials().share(&experiment, 0, self.rates[rate], &())
            };
            let mut search = search::Search::new((chosen.len(), self.rates.len()), drive);
            search.trace();
            let scenario = self.bench.scenarios[place % scenarios].stem().to_string();
            search.audit(
                self.audits,
                self.root_seed,
                &format!("{} {scenario}", choice.path),
            );
            let curve = Curve {
                points: self.points(&search.found, choice),
                cells: search.cells,
                path: choice.path.clone(),
                scenario,
            };
            progress.step();
            curve
        };
        one_by_one(chosen).enumerate().map(curve).collect()
    }

    fn trials(&self) -> Trials {
        Trials {
            drives: self.seeds,
            strata: 1,
            stop: Stop::Collision,
        }
    }

    fn points(&self, found: &[search::Found], choice: &Choice) -> Vec<Point> {
        let point = |(found, value): (&search::Found, &String)| Point {
            value: value.clone(),
            mrf: match self.rates.get(found.place) {
                None => Mrf::Above(self.rates.last().copied().unwrap_or_default()),
                Some(rate) if found.place == 0 && *rate > 1 => Mrf::AtMost(*rate),
                Some(rate) => Mrf::Rate(*rate),
            },
            driven: found.driven,
        };
        found.iter().zip(&choice.values).map(point).collect()
    }
}

/// Searches, and makes the files `boundary.md`, `boundary.csv` and `boundary_samples.csv`.
pub fn boundary(plan: &Boundary, chosen: &[Vec<Chosen>], progress: &dyn Progress) -> Results {
    let curves = plan.curves(chosen, progress);
    table::results(plan, &curves)
}
