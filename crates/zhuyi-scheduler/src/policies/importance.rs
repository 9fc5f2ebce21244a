//! Rates by the importance of the actors that a camera covers.
//!
//! ```text
//! w_i = sum of 1/l over the actors that camera i covers,   f_i = in_proportion(w, B)_i
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | l | tolerable latency of an actor | s |
//! | w_i | importance of the camera | Hz |
//!
//! Source: "the inverse of the per-actor tolerable latency estimate is proportional to the actor's importance" (the
//! paper's section on a Zhuyi-based system). The paper ranks actors by it, not cameras; the sum is our reading. Many
//! harmless actors outweigh a single urgent one, and nobody is promised the demand. A camera without actors has the
//! floor, unless all others have 30.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "importance",
    meaning: "in proportion to the sum of 1/latency over the actors that a camera covers",
    source: "the paper, section on a Zhuyi-based system",
    make: |_| Ok(Box::new(Importance)),
};

/// In proportion to the importance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Importance;

impl Policy for Importance {
    fn name(&self) -> &'static str {
        "importance"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::IMPORTANCE]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(
            situation,
            rates,
            demands::IMPORTANCE,
            sharing::in_proportion,
        )
    }
}
