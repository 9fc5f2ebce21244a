//! The same rate for every camera: what a system without any estimate does.
//!
//! ```text
//! f_i = min(B/n, 30)
//! ```
//!
//! B is the budget [Hz], n the number of cameras. The baseline of all comparisons. Left out: everything that is known.

use crate::policies::entry::Entry;
use crate::{Policy, PolicyError, Situation};
use zhuyi_core::camera::FULL_RATE;

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "uniform",
    meaning: "the same rate for every camera",
    source: "the fixed rates of the paper's experiments",
    make: |_| Ok(Box::new(Uniform)),
};

/// Every camera the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Uniform;

impl Policy for Uniform {
    fn name(&self) -> &'static str {
        "uniform"
    }

    fn demand_models(&self) -> &[&str] {
        &[]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        situation.check(rates)?;
        let share = situation.budget / situation.cameras.len() as f64;
        rates.fill(share.min(FULL_RATE));
        Ok(())
    }
}
