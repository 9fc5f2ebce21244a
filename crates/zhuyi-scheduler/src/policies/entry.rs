//! Entries of the registry of policies: name, meaning, source, and what makes one.

use crate::Policy;

/// A policy as it is known by name.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Name, and what follows its colon where something does, in capitals for what the user writes: `static:CAMERA=RATE,..`.
    pub id: &'static str,
    /// What it shares by, in half a sentence.
    pub meaning: &'static str,
    /// Where it comes from; empty for a program of the user's.
    pub source: &'static str,
    /// Makes one for a run from what follows the colon.
    pub(super) make: fn(&str) -> Result<Box<dyn Policy>, UnknownPolicy>,
}

impl Entry {
    /// Returns its name, up to its colon.
    pub fn name(&self) -> &'static str {
        self.id.split(':').next().unwrap_or(self.id)
    }

    /// Returns whether something follows its name.
    pub fn takes_more(&self) -> bool {
        self.id.contains(':')
    }
}

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
