//! The demand with phantoms and no more: what neither a confirmed actor nor an assumed one asks for is not processed.
//!
//! d_i is that of [`phantom`](crate::policies::phantom) [Hz]; [`cut`](crate::sharing::cut) shares. It is to `phantom`
//! what `demand-only` is to `demand-first`. Source: our own. Left out: what was before.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "phantom-only",
    meaning: "the same demand and no more",
    source: "our own",
    make: |_| Ok(Box::new(PhantomOnly)),
};

/// The demand with phantoms and no more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PhantomOnly;

impl Policy for PhantomOnly {
    fn name(&self) -> &'static str {
        "phantom-only"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::PHANTOM]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::PHANTOM, sharing::cut)
    }
}
