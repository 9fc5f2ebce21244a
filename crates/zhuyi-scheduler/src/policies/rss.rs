//! Demand first, with the demand that Responsibility-Sensitive Safety leads to.
//!
//! d_i is the RSS demand of camera i [Hz]: the longest response time with which the distances are still safe, turned
//! into a rate (zhuyi-estimator, `rivals::rss`); [`demand_first`](crate::sharing::demand_first) shares. Source:
//! Shalev-Shwartz, Shammah & Shashua, arXiv 1708.06374. RSS itself knows of no cameras. Left out: lateral responses.

use crate::sharing;
use crate::{LooksAt, Policy, PolicyError, Situation};

/// The demand of RSS first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rss;

impl Policy for Rss {
    fn name(&self) -> &'static str {
        "rss"
    }

    fn looks_at(&self) -> LooksAt {
        LooksAt {
            rivals: true,
            ..LooksAt::PAPER
        }
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        situation.share(rates, |d| d.rss, sharing::demand_first)
    }
}
