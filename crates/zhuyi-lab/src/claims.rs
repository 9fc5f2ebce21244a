//! The paper's claims on the table, each examined: holds, fails, or a figure to look at (reading, section 4, claims 1 to 4).
//!
//! A claim that does not hold is a result like any other. The claims on the course of the demand over time, on sensitivity, work and
//! throughput are other commands' matter.

mod distance;
mod fraction;
mod required;
mod safe;

use std::fmt::{self, Write as _};

use crate::reproduce::Plan;
use crate::reruns::Reruns;
use crate::table::Table;

/// A claim and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Its number in the reading's section 4: `1`, `2a`, `2b`, `3`, `4`.
    pub number: &'static str,
    /// What is claimed.
    pub title: &'static str,
    /// What became of it.
    pub verdict: Verdict,
    /// The figures, in one sentence without its full stop.
    pub figures: String,
    /// All that is to be told, in Markdown.
    pub details: String,
}

/// What became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds.
    Holds,
    /// It does not.
    Fails,
    /// A figure to look at, without a bound to hold.
    FigureOnly,
}

impl Verdict {
    fn holds_if(condition: bool) -> Self {
        if condition { Self::Holds } else { Self::Fails }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::FigureOnly => "figure only",
        })
    }
}

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

/// `claims.md`.
pub fn markdown(plan: &Plan, claims: &[Claim]) -> String {
    let mut text = format!(
        "# Claims 1 to 4\n\nWritten by `{}`: {}.\n",
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
