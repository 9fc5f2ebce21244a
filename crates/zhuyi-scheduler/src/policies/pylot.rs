//! Demand first, with the deadline of Pylot, which falls with the speed of the ego.
//!
//! d_i is the Pylot demand of camera i [Hz]: its deadline turned into a rate (zhuyi-metrics, `safety_models::pylot`);
//! [`demand_first`](crate::sharing::demand_first) shares. Source: Gog et al., Pylot (ICRA 2021) and D3 (EuroSys 2022).
//! Left out by the model: who is there. Pylot itself chooses among networks by its deadline, not among cameras.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "pylot",
    meaning: "demand first, with Pylot's deadline, which knows the ego's speed alone",
    source: "Gog et al., ICRA 2021, EuroSys 2022 (D3)",
    make: |_| Ok(Box::new(Pylot)),
};

/// The demand of Pylot's deadline first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pylot;

impl Policy for Pylot {
    fn name(&self) -> &'static str {
        "pylot"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::PYLOT]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::PYLOT, sharing::demand_first)
    }
}
