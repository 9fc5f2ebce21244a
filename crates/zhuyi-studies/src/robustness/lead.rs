//! Vehicle following over the lead's braking, which the paper does not give: MRF, estimate and sum for each.
//!
//! One value had to be chosen for the scenario's file. The table shows what another one would have made of the row; none was
//! chosen for its sum.

use zhuyi_scenario::Scenario;
use zhuyi_world::script::Action;

use crate::reproduce::plan::Plan;
use zhuyi_batch::estimators::{TABLE, VARIANTS};
use zhuyi_batch::mrf::{Mrf, required};
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::uniform;
use zhuyi_batch::sweep::{Experiment, Record, grid};
use zhuyi_batch::text::{cells, markdown_table};

/// The scenario.
const NAME: &str = "vehicle-following";

/// [m/s2] braking of the lead.
const DECELS: [f64; 8] = [3.0, 3.2, 3.4, 3.6, 3.8, 4.0, 4.1, 4.2];

/// The table as Markdown; none of a plan without the scenario.
pub(super) fn braking_lead(plan: &Plan, progress: &dyn Progress) -> Option<String> {
    let place = plan.scenarios.iter().position(|one| one.name == NAME)?;
    let scenarios: Vec<Scenario> = DECELS
        .iter()
        .map(|decel| braking(&plan.scenarios[place], *decel))
        .collect();
    let experiment = Experiment {
        scenarios: &scenarios,
        system: &plan.system,
        root_seed: plan.root_seed,
    };
    let rates = plan.rates.iter().map(|rate| uniform(&plan.system, *rate));
    let runs = grid(scenarios.len(), &rates.collect::<Vec<_>>(), 0..plan.seeds);
    progress.start("braking of the lead", runs.len() as u64);
    let estimators = [VARIANTS[TABLE].estimator(&plan.system)];
    let records = experiment.run(&runs, |_| &estimators, || progress.step());
    let per_rate = plan.seeds as usize;
    let rows = records
        .chunks(plan.rates.len() * per_rate)
        .zip(DECELS)
        .map(|(records, decel)| row(plan, records, per_rate, decel));
    let header = cells(&[
        "lead brakes at [m/s2]",
        "MRF [FPR]",
        "estimate at the highest rate [FPR]",
        "largest sum [FPR]",
        "fraction",
    ]);
    Some(markdown_table(&header, &rows.collect::<Vec<_>>()))
}

/// The scenario with another braking of its lead.
fn braking(scenario: &Scenario, decel: f64) -> Scenario {
    let mut changed = scenario.clone();
    let manoeuvres = changed
        .actors
        .iter_mut()
        .flat_map(|actor| &mut actor.manoeuvres);
    for manoeuvre in manoeuvres {
        if let Action::Brake { decel: brake } = &mut manoeuvre.then {
            *brake = decel;
        }
    }
    changed
}

fn row(plan: &Plan, records: &[Record], per_rate: usize, decel: f64) -> Vec<String> {
    let by_rate = || records.chunks(per_rate);
    let collided = |runs: &[Record]| runs.iter().filter(|run| run.collision.is_some()).count();
    let collisions = by_rate().map(|runs| collided(runs) as u32);
    let found = required(
        &plan
            .rates
            .iter()
            .copied()
            .zip(collisions)
            .collect::<Vec<_>>(),
    )
    .mrf;
    let counts = |rate: u32| matches!(found, Mrf::Rate(mrf) if rate >= mrf);
    let largest = plan
        .rates
        .iter()
        .zip(by_rate())
        .filter(|(rate, _)| counts(**rate))
        .flat_map(|(_, runs)| runs.iter().flat_map(|run| &run.peaks))
        .map(|peaks| peaks.sum)
        .fold(0.0, f64::max);
    let fastest = by_rate().last().unwrap_or_default();
    let estimates: Vec<f64> = fastest
        .iter()
        .flat_map(|run| &run.peaks)
        .map(|peaks| peaks.largest)
        .collect();
    let mean = estimates.iter().sum::<f64>() / estimates.len() as f64;
    vec![
        format!("{decel:.1}"),
        found.to_string(),
        if estimates.len() == per_rate {
            format!("{mean:.2}")
        } else {
            "N/A".to_string()
        },
        format!("{largest:.2}"),
        format!("{:.3}", largest / 90.0),
    ]
}
