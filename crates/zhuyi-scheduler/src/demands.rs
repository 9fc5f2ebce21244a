//! Ids of the demand models that the built-in policies look at.
//!
//! What each stands for, and how it is computed, is told where it is computed: `zhuyi_sim::demand_models`. A policy may look at
//! others, under ids of their own.

pub use zhuyi_core::stages::policy::ZHUYI;

/// The paper's model, or what an actor would demand that stands where no camera looks, whichever is more.
pub const PHANTOM: &str = "phantom";
/// Responsibility-Sensitive Safety.
pub const RSS: &str = "rss";
/// Time to collision against a threshold.
pub const TTC: &str = "ttc";
/// Pylot's deadline.
pub const PYLOT: &str = "pylot";
/// Sum of 1/l over the actors that a camera covers.
pub const IMPORTANCE: &str = "importance";
/// The paper's model with the true future, where that is known.
pub const OFFLINE: &str = "offline";

use zhuyi_core::stages::{PolicyError, Situation};

/// Shares the budget by the demands of one model, as `rule` has it.
pub(crate) fn share(
    situation: &Situation<'_>,
    rates: &mut [f64],
    model: &str,
    rule: impl Fn(&[f64], f64) -> Vec<f64>,
) -> Result<(), PolicyError> {
    situation.check(rates)?;
    let demands = situation.demands(model)?;
    rates.copy_from_slice(&rule(demands, situation.budget));
    Ok(())
}
