//! Rates in proportion to the demands: the rule of the paper.
//!
//! ```text
//! f_i = clamp(k d_i, floor, 30),   k such that the sum is the budget
//! ```
//!
//! d_i is the demand of the paper's model [Hz]; [`in_proportion`](crate::sharing::in_proportion) has the rest.
//! Source: "process these images at rates proportional to the estimated rates" (the paper's section on a Zhuyi-based
//! system). The paper says so of times when the rates suffice; in times when they do not, the same factor shortens
//! all of them here. Left out: that a quiet camera, too, takes a share of what is more than enough.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "proportional",
    meaning: "in proportion to the demand (the paper's)",
    source: "the paper, section on a Zhuyi-based system",
    make: |_| Ok(Box::new(Proportional)),
};

/// In proportion to the demand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Proportional;

impl Policy for Proportional {
    fn name(&self) -> &'static str {
        "proportional"
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::ZHUYI, sharing::in_proportion)
    }
}
