//! Earliest deadline first: an order of frames on the accelerator rather than a choice of rates.
//!
//! ```text
//! f_i = demand_first(d, B)_i,   deadline of a frame = its exposure + 1/d_i
//! ```
//!
//! d_i is the demand of the paper's model [Hz]. The cameras expose as under `demand-first`; what differs is
//! that frames wait for the accelerator in the order of their deadlines ([`Discipline::for_policy`]), which matters only
//! where they do wait ([`Compute::Accelerator`](crate::Compute)). Source: Liu & Layland, "Scheduling Algorithms for
//! Multiprogramming in a Hard-Real-Time Environment" (1973). Left out: interruption of a frame under work.
//!
//! [`Discipline::for_policy`]: crate::Discipline::for_policy

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "edf",
    meaning: "demand first; the accelerator takes the frame that is due first",
    source: "Liu & Layland 1973",
    make: |_| Ok(Box::new(Edf)),
};

/// Rates of `demand-first`; the order of frames is the point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edf;

impl Policy for Edf {
    fn name(&self) -> &'static str {
        "edf"
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::ZHUYI, sharing::demand_first)
    }
}
