//! Demand first, with the demand that follows from the true future: no car can have it, so it bounds what better
//! prediction could bring.
//!
//! d_i is the offline demand of camera i [Hz], the paper's model on the recorded future;
//! [`demand_first`](crate::sharing::demand_first) shares. The future is that of a recorded run: where the rates change
//! what the ego does, it is no longer quite true. Source: the offline estimates of the paper's experiments.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "clairvoyant",
    meaning: "demand first, with the demand that follows from the true future",
    source: "the paper's offline estimates",
    make: |_| Ok(Box::new(Clairvoyant)),
};

/// The demand with the future known first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clairvoyant;

impl Policy for Clairvoyant {
    fn name(&self) -> &'static str {
        "clairvoyant"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::OFFLINE]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::OFFLINE, sharing::demand_first)
    }
}
