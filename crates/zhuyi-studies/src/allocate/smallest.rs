//! The smallest drive in which a demand that is met in full is too little: one standing car on an empty road.
//!
//! As long as nobody is confirmed, nobody asks for anything, and every camera runs at 1 FPR. A car that comes into sight
//! at the limit of the range is then confirmed K to K + 1 s later and a period after that is known of: at 70 mph the ego
//! has gone on for about 200 m by then. The estimate is right about whom it is asked about; it is not asked about whom no
//! camera has confirmed. What helps is a reserve ([`demand-first`](zhuyi_scheduler::policies::demand_first)) or an
//! assumption about what is not seen yet ([`phantom-only`](zhuyi_scheduler::policies::phantom_only)).

use zhuyi_scenario::{Scenario, Source};
use zhuyi_sim::{DecisionError, RunSpec};

use super::drive::{Driven, drive};
use super::tally::Tally;
use super::{Allocating, Budgets};

/// The scenario.
const FILE: &str = include_str!("one-standing-car.ron");

/// Who drives through it.
const POLICIES: [&str; 3] = ["demand-only", "demand-first", "phantom-only"];

/// [Hz] enough for 30 on each of five cameras: nobody is short of anything. A fifth of it for who spends all.
const BUDGETS: [f64; 3] = [150.0, 30.0, 150.0];

/// One policy in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Smallest {
    /// Its name.
    pub policy: &'static str,
    /// [Hz] its budget.
    pub budget: f64,
    /// All seeds together.
    pub tally: Tally,
}

/// All seeds of the plan. None where budgets are those of an accelerator, or the system is one that cannot start there.
pub(super) fn smallest(plan: &Allocating) -> Result<Vec<Smallest>, DecisionError> {
    let source = Source::new("one-standing-car.ron", FILE);
    let scenario = Scenario::read(&source, &plan.system, &[]);
    let (Budgets::Fps(_), Ok(scenario)) = (&plan.budgets, scenario) else {
        return Ok(Vec::new());
    };
    let one = |policy, budget, seed| {
        let spec = RunSpec::new(scenario.clone(), plan.system.clone());
        let spec = spec.with_root_seed(plan.root_seed).with_seed(seed);
        drive(spec, (policy, budget), Vec::new())
    };
    let pairs = POLICIES.into_iter().zip(BUDGETS);
    pairs
        .map(|(policy, budget)| {
            let driven = (0..plan.seeds).map(|seed| one(policy, budget, seed));
            let driven: Vec<Driven> = driven.collect::<Result<_, _>>()?;
            Ok(Smallest {
                policy,
                budget,
                tally: Tally::of(driven.iter(), plan.system.perception.eyes.len()),
            })
        })
        .collect()
}
