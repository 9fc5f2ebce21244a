//! The policies, one file each, and the names by which they are asked for.

pub mod clairvoyant;
pub mod demand_first;
pub mod demand_only;
pub mod edf;
mod entry;
pub mod exec;
pub mod fixed;
pub mod hysteresis;
pub mod importance;
pub mod phantom;
pub mod phantom_only;
pub mod proportional;
pub mod pylot;
pub mod rss;
pub mod ttc;
pub mod uniform;

pub use clairvoyant::Clairvoyant;
pub use demand_first::DemandFirst;
pub use demand_only::DemandOnly;
pub use edf::Edf;
pub use entry::{Entry, UnknownPolicy};
pub use exec::Exec;
pub use fixed::Static;
pub use hysteresis::Hysteresis;
pub use importance::Importance;
pub use phantom::Phantom;
pub use phantom_only::PhantomOnly;
pub use proportional::Proportional;
pub use pylot::Pylot;
pub use rss::Rss;
pub use ttc::Ttc;
pub use uniform::Uniform;

use std::sync::Arc;

use crate::Policy;

/// All policies, in the order of help texts and tables. A policy is added by its file and a line here.
pub const POLICIES: [Entry; 15] = [
    uniform::ENTRY,
    proportional::ENTRY,
    demand_first::ENTRY,
    hysteresis::ENTRY,
    demand_only::ENTRY,
    phantom::ENTRY,
    phantom_only::ENTRY,
    importance::ENTRY,
    rss::ENTRY,
    ttc::ENTRY,
    pylot::ENTRY,
    edf::ENTRY,
    fixed::ENTRY,
    clairvoyant::ENTRY,
    exec::ENTRY,
];

/// Function that makes a policy for one run.
pub type MakePolicy = Arc<dyn Fn() -> Box<dyn Policy> + Send + Sync>;

/// Returns what makes the policy of this name, one for each run.
///
/// # Errors
/// As [`policy`].
pub fn policy_maker(name: &str) -> Result<MakePolicy, UnknownPolicy> {
    policy(name)?;
    let name = name.to_string();
    Ok(Arc::new(move || {
        policy(&name).unwrap_or_else(|unknown| unreachable!("made before: {unknown}"))
    }))
}

/// The policy of this name, for one run.
///
/// ```
/// use zhuyi_scheduler::policy;
/// assert_eq!(policy("proportional")?.name(), "proportional");
/// assert_eq!(policy("static:front=10,left=1")?.name(), "static:front=10,left=1");
/// assert_eq!(policy("fair").unwrap_err().to_string(), "there is no policy `fair`");
/// # Ok::<(), zhuyi_scheduler::UnknownPolicy>(())
/// ```
///
/// # Errors
/// If the name is none of [`POLICIES`], or what follows its colon makes no sense.
pub fn policy(name: &str) -> Result<Box<dyn Policy>, UnknownPolicy> {
    let (known, rest) = match name.split_once(':') {
        Some((known, rest)) => (known, Some(rest)),
        None => (name, None),
    };
    let fits = |entry: &&Entry| entry.name() == known && entry.takes_more() == rest.is_some();
    match POLICIES.iter().find(fits) {
        Some(entry) => (entry.make)(rest.unwrap_or_default()),
        None => Err(UnknownPolicy::Name {
            name: name.to_string(),
        }),
    }
}
