//! Why a policy gives no rates.

use crate::policies::exec::ProgramError;

/// A limit on the rates that a policy gives, broken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RateLimit {
    /// A rate that no camera may have, or none at all.
    #[error("gives `{camera}` {got} frames per second, outside {floor} to {cap}")]
    Range {
        /// The camera.
        camera: String,
        /// [Hz] its rate.
        got: f64,
        /// [Hz] the least.
        floor: f64,
        /// [Hz] the most.
        cap: f64,
    },
    /// More than there is.
    #[error("gives {sum} frames per second altogether, with a budget of {budget}")]
    Budget {
        /// [Hz] sum of the rates, with the least for every camera.
        sum: f64,
        /// [Hz] the budget.
        budget: f64,
    },
}

/// Why a policy gives no rates.
#[derive(Debug, thiserror::Error)]
pub enum PolicyError {
    /// The caller's list does not fit the rig.
    #[error("{places} places for the rates of {cameras} cameras")]
    Places {
        /// Cameras of the rig.
        cameras: usize,
        /// Places in the list.
        places: usize,
    },
    /// No budget to share.
    #[error("the budget must be positive and finite, got {got} frames per second")]
    Budget {
        /// [Hz] the budget.
        got: f64,
    },
    /// A number of the situation is none.
    #[error("the {what} must be finite, got {got}")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// [-] what it is, in its own unit.
        got: f64,
    },
    /// A number of one camera is none, or negative.
    #[error("the {what} of the camera `{camera}` must be finite and not negative, got {got}")]
    Camera {
        /// Which camera.
        camera: String,
        /// Which number.
        what: &'static str,
        /// [Hz] what it is.
        got: f64,
    },
    /// A clairvoyant policy was not told the future.
    #[error(
        "`clairvoyant` needs the demand that follows from the true future, and `{camera}` has none"
    )]
    NoFuture {
        /// The first camera without.
        camera: String,
    },
    /// A static allocation names a camera that the rig does not have.
    #[error("`{policy}` names the camera `{named}`; the rig has {}", rig.join(", "))]
    NoSuchCamera {
        /// The policy.
        policy: String,
        /// The name that fits no camera.
        named: String,
        /// The names that there are.
        rig: Vec<String>,
    },
    /// The policy's rates break the limits.
    #[error("`{policy}` {limit}")]
    Rates {
        /// The policy.
        policy: String,
        /// The limit that they break.
        limit: RateLimit,
    },
    /// A program of the user failed.
    #[error(transparent)]
    Program(#[from] Box<ProgramError>),
}
