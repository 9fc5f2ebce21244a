//! The demands first, and what is left in equal parts.
//!
//! ```text
//! f_i = demand_first(d, B)_i
//! ```
//!
//! d_i is the demand of the paper's model [Hz], B the budget; [`demand_first`](crate::sharing::demand_first) has the
//! equations. It differs from `proportional` where there is more than enough: the surplus does not follow the demand,
//! so that a camera which sees nothing yet is ready for something new. Left out: what was before.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "demand-first",
    meaning: "the demand, then the rest in equal parts",
    source: "our own",
    make: |_| Ok(Box::new(DemandFirst)),
};

/// The demand, then equal parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DemandFirst;

impl Policy for DemandFirst {
    fn name(&self) -> &'static str {
        "demand-first"
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::ZHUYI, sharing::demand_first)
    }
}
