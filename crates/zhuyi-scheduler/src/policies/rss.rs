//! Demand first, with the demand that Responsibility-Sensitive Safety leads to.
//!
//! d_i is the RSS demand of camera i [Hz]: the longest response time with which the distances are still safe, turned
//! into a rate (zhuyi-metrics, `safety_models::rss`); [`demand_first`](crate::sharing::demand_first) shares. Source:
//! Shalev-Shwartz, Shammah & Shashua, arXiv 1708.06374. RSS itself knows of no cameras. Left out: lateral responses.

use crate::demands::{self, share};
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "rss",
    meaning: "demand first, with the demand of RSS",
    source: "Shalev-Shwartz et al., arXiv 1708.06374",
    make: |_| Ok(Box::new(Rss)),
};

/// The demand of RSS first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rss;

impl Policy for Rss {
    fn name(&self) -> &'static str {
        "rss"
    }

    fn demand_models(&self) -> &[&str] {
        &[demands::RSS]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        share(situation, rates, demands::RSS, sharing::demand_first)
    }
}
