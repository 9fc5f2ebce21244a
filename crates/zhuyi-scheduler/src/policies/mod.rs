//! The policies, one file each, and the names by which they are asked for.

pub mod clairvoyant;
pub mod demand_first;
pub mod demand_only;
pub mod edf;
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

/// The names that [`policy`] knows, each with a line for help texts. Words in capitals stand for what the user writes.
pub const NAMES: [(&str, &str); 15] = [
    ("uniform", "the same rate for every camera"),
    ("proportional", "in proportion to the demand (the paper's)"),
    ("demand-first", "the demand, then the rest in equal parts"),
    (
        "demand-hysteresis",
        "demand first; a demand that falls is kept for a second",
    ),
    (
        "demand-only",
        "the demand and no more: what is left of the budget is saved",
    ),
    (
        "phantom",
        "demand first, counting cars assumed where no camera looks",
    ),
    ("phantom-only", "the same demand and no more"),
    (
        "importance",
        "in proportion to the sum of 1/latency over the actors that a camera covers",
    ),
    ("rss", "demand first, with the demand of RSS"),
    ("ttc", "demand first, with the demand of time to collision"),
    (
        "pylot",
        "demand first, with Pylot's deadline, which knows the ego's speed alone",
    ),
    (
        "edf",
        "demand first, and the accelerator takes the frame with the earliest deadline",
    ),
    (
        "static:CAMERA=RATE,..",
        "these rates throughout; cameras not named share what is left",
    ),
    (
        "clairvoyant",
        "demand first, with the demand that follows from the true future",
    ),
    (
        "exec:COMMAND",
        "ask a program: one line of JSON in, one out, per decision",
    ),
];

/// Why a name stands for no policy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UnknownPolicy {
    /// No such name.
    #[error("there is no policy `{name}`")]
    Name {
        /// What was asked for.
        name: String,
    },
    /// `exec:` and nothing behind it.
    #[error("`exec:` needs a command, as in `exec:./my-policy`")]
    NoCommand,
    /// Something in `static:..` is not CAMERA=RATE.
    #[error("`static:` needs CAMERA=RATE,.. such as `static:front=10,left=1`, got `{entry}`")]
    StaticEntry {
        /// What stands there.
        entry: String,
    },
    /// A rate in `static:..` is no rate.
    #[error("the rate of `{camera}` must be above 0 and at most 30 frames per second, got `{got}`")]
    StaticRate {
        /// Whose.
        camera: String,
        /// What stands there.
        got: String,
    },
    /// A camera stands twice in `static:..`.
    #[error("`static:` names the camera `{camera}` twice")]
    StaticTwice {
        /// Which.
        camera: String,
    },
}

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
/// If the name is none of [`NAMES`], or what follows its colon makes no sense.
pub fn policy(name: &str) -> Result<Box<dyn Policy>, UnknownPolicy> {
    if let Some(command) = name.strip_prefix("exec:") {
        return if command.trim().is_empty() {
            Err(UnknownPolicy::NoCommand)
        } else {
            Ok(Box::new(Exec::new(command)))
        };
    }
    if let Some(rates) = name.strip_prefix("static:") {
        return Ok(Box::new(Static::parse(rates)?));
    }
    Ok(match name {
        "uniform" => Box::new(Uniform),
        "proportional" => Box::new(Proportional),
        "demand-first" => Box::new(DemandFirst),
        "demand-hysteresis" => Box::new(Hysteresis::default()),
        "demand-only" => Box::new(DemandOnly),
        "phantom" => Box::new(Phantom),
        "phantom-only" => Box::new(PhantomOnly),
        "importance" => Box::new(Importance),
        "rss" => Box::new(Rss),
        "ttc" => Box::new(Ttc),
        "pylot" => Box::new(Pylot),
        "edf" => Box::new(Edf),
        "clairvoyant" => Box::new(Clairvoyant),
        _ => {
            return Err(UnknownPolicy::Name {
                name: name.to_string(),
            });
        }
    })
}
