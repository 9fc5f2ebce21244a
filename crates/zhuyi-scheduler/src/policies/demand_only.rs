//! The demands and no more: what nobody asks for is not processed.
//!
//! ```text
//! f_i = cut(d, B)_i
//! ```
//!
//! d_i is the demand of the paper's model [Hz], B the budget; [`cut`](crate::sharing::cut) has the equations. It is what
//! the paper's figure of 36 % supposes: each camera runs at its estimate. It spends the least and has nothing in reserve
//! for whom nobody has confirmed yet. Left out: what was before.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "demand-only",
    meaning: "the demand and no more: what is left of the budget is saved",
    source: "the paper's figure of 36 %",
    make: |_| Ok(Box::new(DemandOnly)),
};

/// The demand and no more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DemandOnly;

impl Policy for DemandOnly {
    fn name(&self) -> &'static str {
        "demand-only"
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::ZHUYI, sharing::cut)
    }
}
