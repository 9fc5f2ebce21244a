//! Demand first, with the demand that time to collision leads to: the braking cone of simpler systems.
//!
//! d_i is the TTC demand of camera i [Hz]: what is left of the time to collision above a threshold, turned into a rate
//! (zhuyi-metrics, `safety_models::ttc`); [`demand_first`](crate::sharing::demand_first) shares. Source: Hayward 1972.
//! Left out by the measure: how hard anybody can brake.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "ttc",
    meaning: "demand first, with the demand of time to collision",
    source: "Hayward 1972",
    make: |_| Ok(Box::new(Ttc)),
};

/// The demand of TTC first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ttc;

impl Policy for Ttc {
    fn name(&self) -> &'static str {
        "ttc"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::TTC]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::TTC, sharing::demand_first)
    }
}
