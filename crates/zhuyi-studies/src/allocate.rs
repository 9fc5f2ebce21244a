//! Budget to safety: every policy on the same drives at every budget, and the responses of the safety check.
//!
//! ```text
//!  Allocating ──▶ [best_static] ─ rates per budget ─┐
//!     └──────▶ scenario x policy x budget x seed ───┴▶ [drive] ──Driven──▶ [tally], paired by seed ──▶ allocation.md, .csv
//! ```
//!
//! A drive is named by scenario and seed; policy and budget change nothing in its draws (reading R18), so that policies
//! are compared in pairs. `best-static` is the one allocation of fixed rates that collides least over all scenarios and
//! seeds at a budget: what a designer finds who knows the scenarios (Suraksha, ISSRE 2021). Left out: several budgets in
//! one drive.

pub mod best_static;
pub mod drive;
pub mod feedback;
mod page;
pub mod responses;
pub mod smallest;
mod table;
pub mod tally;

use rayon::prelude::*;
use zhuyi_core::FrameRates;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::{Chip, Compute, POLICIES as KNOWN};
use zhuyi_sim::{DecisionError, RunSpec, known_future};

use drive::Driven;
pub use feedback::Feedback;
pub use responses::Answered;
pub use smallest::Smallest;
use tally::Tally;
use zhuyi_batch::parallel::one_by_one;
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::uniform;
use zhuyi_batch::results::Results;

/// The name under which the allocation found by search is asked for.
pub const BEST_STATIC: &str = "best-static";

/// What the paper's model drives: these policies share by its demand.
pub const ZHUYI: [&str; 8] = [
    "proportional",
    "demand-first",
    "demand-hysteresis",
    "demand-only",
    "phantom",
    "phantom-only",
    "importance",
    "edf",
];

/// The policies of `--policy all`: those that need nothing but their name, and the best static one.
pub fn all_policies() -> Vec<String> {
    let plain = KNOWN.iter().filter(|entry| !entry.takes_more());
    let plain = plain.map(|entry| entry.id);
    plain.chain([BEST_STATIC]).map(String::from).collect()
}

/// What is spent.
#[derive(Clone, Debug, PartialEq)]
pub enum Budgets {
    /// [Hz] frames per second over all cameras; a frame takes its period.
    Fps(Vec<f64>),
    /// [TOPS] speeds of the accelerator for which frames queue.
    Tops(Vec<f64>),
}

/// One budget: as typed, and what follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// In its own unit.
    pub amount: f64,
    /// [Hz] frames per second that policies may share.
    pub fps: f64,
    /// How long a frame takes.
    pub compute: Compute,
}

/// What to drive.
#[derive(Clone, Debug)]
pub struct Allocating {
    /// The scenarios.
    pub scenarios: Vec<Scenario>,
    /// The ego.
    pub system: System,
    /// The root of all randomness.
    pub root_seed: u64,
    /// How many seeds, from 0.
    pub seeds: u64,
    /// In ascending order.
    pub budgets: Budgets,
    /// By name; [`BEST_STATIC`] for the one found by search.
    pub policies: Vec<String>,
    /// The command that does the same.
    pub command: String,
}

/// All drives of one policy at one budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// By scenario, then seed.
    pub drives: Vec<Vec<Driven>>,
}

/// All that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Allocated {
    /// By policy, then budget.
    pub cells: Vec<Vec<Cell>>,
    /// The rates of [`BEST_STATIC`] at each budget, as a policy is spelt; empty if it was not asked for.
    pub best_static: Vec<best_static::Found>,
    /// What the responses to alarms do.
    pub answered: Vec<Answered>,
    /// The smallest drive in which a demand that is met is too little.
    pub smallest: Vec<Smallest>,
    /// What the literal l_0 does (reading R22).
    pub feedback: Option<Feedback>,
}

impl Allocating {
    /// The budgets, each with what follows from it.
    pub fn budgets(&self) -> Vec<Budget> {
        match &self.budgets {
            Budgets::Fps(all) => all
                .iter()
                .map(|fps| Budget {
                    amount: *fps,
                    fps: *fps,
                    compute: self.system.compute,
                })
                .collect(),
            Budgets::Tops(all) => all
                .iter()
                .map(|tops| {
                    let chip = Chip {
                        tops: *tops,
                        ..self.chip()
                    };
                    Budget {
                        amount: *tops,
                        fps: chip.capacity(),
                        compute: Compute::Accelerator(chip),
                    }
                })
                .collect(),
        }
    }

    /// The accelerator of the system, or the usual one.
    pub fn chip(&self) -> Chip {
        match self.system.compute {
            Compute::Accelerator(chip) => chip,
            Compute::Ideal => Chip::default(),
        }
    }

    /// The unit of the budgets as it is spelt.
    pub fn unit(&self) -> &'static str {
        match self.budgets {
            Budgets::Fps(_) => "frames/s",
            Budgets::Tops(_) => "TOPS",
        }
    }

    /// A run of a system through a scenario, by its place.
    fn spec(&self, scenario: usize, system: &System, seed: u64) -> RunSpec {
        RunSpec::new(self.scenarios[scenario].clone(), system.clone())
            .with_root_seed(self.root_seed)
            .with_seed(seed)
    }

    /// The system with another way to compute.
    fn with(&self, compute: Compute) -> System {
        let mut system = self.system.clone();
        system.compute = compute;
        system
    }

    /// All drives of a system under a policy with a budget [Hz], together.
    fn tally(
        &self,
        system: &System,
        policy: (&str, f64),
        progress: &dyn Progress,
    ) -> Result<Tally, DecisionError> {
        let one = |(scenario, seed): &(usize, u64)| {
            let driven = drive::drive(self.spec(*scenario, system, *seed), policy, Vec::new());
            progress.step();
            driven
        };
        let driven: Result<Vec<Driven>, _> = one_by_one(&self.drives()).map(one).collect();
        Ok(Tally::of(driven?.iter(), system.perception.eyes.len()))
    }

    /// Every scenario with every seed, scenarios outermost.
    fn drives(&self) -> Vec<(usize, u64)> {
        let of = |scenario| (0..self.seeds).map(move |seed| (scenario, seed));
        (0..self.scenarios.len()).flat_map(of).collect()
    }
}

/// Drives it all.
///
/// # Errors
/// If a policy fails, which only a program of the user's can.
///
/// # Panics
/// If a policy has no known name, or there is no budget, policy, scenario or seed.
pub fn allocate(plan: &Allocating, progress: &dyn Progress) -> Result<Allocated, DecisionError> {
    let budgets = plan.budgets();
    let futures = futures(plan, progress);
    let found = if plan.policies.iter().any(|policy| policy == BEST_STATIC) {
        best_static::search(plan, &budgets, progress)
    } else {
        Vec::new()
    };
    let drives = plan.drives();
    let mut jobs = Vec::new();
    for policy in &plan.policies {
        for (place, budget) in budgets.iter().enumerate() {
            let name = found.get(place).filter(|_| policy == BEST_STATIC);
            let name = name.map_or(policy.as_str(), |found| &found.policy);
            jobs.extend(drives.iter().map(|drive| (name, budget, *drive)));
        }
    }
    let systems: Vec<System> = budgets.iter().map(|b| plan.with(b.compute)).collect();
    progress.start("drives", jobs.len() as u64);
    let one = |(job, (name, budget, (scenario, seed))): (usize, &(&str, &Budget, (usize, u64)))| {
        let place = job / drives.len() % budgets.len();
        let future = futures.get(job % drives.len()).cloned().unwrap_or_default();
        let spec = plan.spec(*scenario, &systems[place], *seed);
        let driven = drive::drive(spec, (name, budget.fps), future);
        progress.step();
        driven
    };
    let driven: Result<Vec<Driven>, DecisionError> =
        one_by_one(&jobs).enumerate().map(one).collect();
    let cell = |drives: &[Driven]| Cell {
        drives: drives
            .chunks(plan.seeds as usize)
            .map(<[Driven]>::to_vec)
            .collect(),
    };
    let cells: Vec<Cell> = driven?.chunks(drives.len()).map(cell).collect();
    Ok(Allocated {
        cells: cells.chunks(budgets.len()).map(<[Cell]>::to_vec).collect(),
        best_static: found,
        answered: responses::answered(plan, progress)?,
        smallest: smallest::smallest(plan)?,
        feedback: feedback::feedback(plan, progress)?,
    })
}

impl Allocated {
    /// The files of the command: the page, the table, and what was drawn.
    pub fn results(&self, plan: &Allocating, figures: Vec<(&'static str, String)>) -> Results {
        let (md, csv) = match plan.budgets {
            Budgets::Fps(_) => ("allocation.md", "allocation.csv"),
            Budgets::Tops(_) => ("allocation_tops.md", "allocation_tops.csv"),
        };
        let mut files = vec![
            (md, page::markdown(plan, self)),
            (csv, table::csv(plan, self)),
        ];
        files.extend(figures);
        Results {
            files,
            claims: Vec::new(),
            summary: page::summary(plan, self),
        }
    }
}

/// The future of every drive with all cameras at 30 FPR, if somebody asks for it.
fn futures(plan: &Allocating, progress: &dyn Progress) -> Vec<Vec<Vec<f64>>> {
    if !plan.policies.iter().any(|policy| policy == "clairvoyant") {
        return Vec::new();
    }
    let drives = plan.drives();
    progress.start("drives at 30 FPR", drives.len() as u64);
    let full: FrameRates = uniform(&plan.system, 30);
    let ideal = plan.with(Compute::Ideal);
    let one = |(scenario, seed): &(usize, u64)| {
        let spec = plan.spec(*scenario, &ideal, *seed);
        let run = spec.at_rates(full.clone()).run_fixed();
        let scenario = &plan.scenarios[*scenario];
        progress.step();
        known_future(&run.trace, &scenario.road, &ideal, &full)
    };
    one_by_one(&drives).map(one).collect()
}
