//! The paper's table, end to end: a plan, its runs, and every file made from them.
//!
//! ```text
//!  Plan ──▶ sweep ──▶ Table ─┬────────────────▶ table1.md, table1.csv
//!                │           └─▶ claims ──────▶ claims.md
//!                └─▶ reruns at the rates asked for ─▶ runs.csv          manifest.json
//!       └──a few runs step by step, for claims 5 to 9 ─▶ claims.md
//! ```
//! Nothing here reads a clock, a path or the machine: the same plan makes the same bytes.

pub mod manifest;
pub mod page;
pub mod paper;
pub mod plan;
pub mod summary;
pub mod table;

use zhuyi_estimator::Estimator;

use crate::claims;
pub use crate::reproduce::plan::Plan;
use crate::reproduce::table::Table;
use crate::reruns::Reruns;
use zhuyi_batch::estimators::VARIANTS;
use zhuyi_batch::progress::Progress;
use zhuyi_batch::results::Results;
use zhuyi_batch::runs;
use zhuyi_batch::sweep::Cell;

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
            ("table1.md", page::markdown(plan, &table)),
            ("table1.csv", page::csv(&table)),
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
