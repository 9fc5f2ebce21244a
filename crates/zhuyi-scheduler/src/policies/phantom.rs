//! Demand first, with the demand that also counts who may stand where no camera looks.
//!
//! d_i is the larger of the demand of the paper's model on what is confirmed and on phantoms, cars assumed at the edges
//! of what the cameras see [Hz] (zhuyi-estimator, `phantom`); [`demand_first`](crate::sharing::demand_first) shares. A
//! hidden obstacle asks for nothing before it is confirmed, and the frames that confirm it must have been taken before:
//! this demand is there in time. Source: our own. Left out: memory of what was seen there a moment ago.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "phantom",
    meaning: "demand first, counting cars assumed where no camera looks",
    source: "our own",
    make: |_| Ok(Box::new(Phantom)),
};

/// The demand with phantoms first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Phantom;

impl Policy for Phantom {
    fn name(&self) -> &'static str {
        "phantom"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::PHANTOM]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::PHANTOM, sharing::demand_first)
    }
}
