//! The paper's claims, each examined: holds, fails, or a figure to look at (reading, section 4).
//!
//! ```text
//!  Table, Reruns ──▶ [examine]: claims 1 to 4, on the table
//!  Plan ──a few runs at its highest rate──▶ [examine_runs]: claims 5 to 9, on the course of the demand over time, on
//!                                           sensitivity, work and throughput; `zhuyi figures` draws the same numbers
//! ```
//!
//! A claim that does not hold is a result like any other.

mod course;
mod distance;
mod foresight;
mod fraction;
mod required;
pub mod run;
mod safe;
mod sensitivity;
mod throughput;
mod work;

use std::fmt::Write as _;

use crate::claims::run::course::{self as courses, Course};
use crate::reproduce::plan::Plan;
use crate::reproduce::table::Table;
use crate::reruns::Reruns;
pub use zhuyi_batch::claim::{Claim, Verdict};
use zhuyi_batch::progress::Progress;

/// Examines claims 1 to 4.
pub fn examine(plan: &Plan, table: &Table, reruns: &Reruns) -> Vec<Claim> {
    vec![
        required::claim(table),
        safe::at_every_rate(table),
        safe::at_the_rates_asked_for(plan, table, reruns),
        fraction::claim(table),
        distance::claim(table),
    ]
}

/// Examines claims 5 to 9, on runs of its own with the plan's seeds.
pub fn examine_runs(plan: &Plan, progress: &dyn Progress) -> Vec<Claim> {
    progress.start("runs step by step", courses::SHOWN.len() as u64 + 1);
    let of = |scenario: &str| {
        let found = courses::courses(plan, scenario).unwrap_or_default();
        progress.step();
        found
    };
    let courses: Vec<Vec<Course>> = courses::SHOWN.into_iter().map(of).collect();
    let mut claims = vec![course::front(&courses), course::sides(&courses)];
    claims.extend(sensitivity::claims(plan));
    claims.push(work::claim(plan, &courses));
    claims.push(foresight::claim(plan));
    progress.step();
    claims.push(throughput::claim());
    claims
}

/// `claims.md`.
pub fn markdown(plan: &Plan, claims: &[Claim]) -> String {
    let mut text = format!(
        "# Claims 1 to 9\n\nWritten by `{}`: {}.\n",
        plan.command(),
        plan.spelt()
    );
    for Claim {
        number,
        title,
        verdict,
        figures,
        details,
    } in claims
    {
        let _ = write!(
            text,
            "\n## {number}. {title}: {verdict}\n\n{figures}. Command: `{}`.\n\n{details}",
            plan.command()
        );
    }
    text
}
