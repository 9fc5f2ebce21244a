//! Stages of the loop as traits: what a user may replace without a fork.
//!
//! ```text
//!  Truth ──▶ [Sensor] ──Frame──▶ [Tracker] ──Track──▶ [Predictor] ──Forecast──▶ [Planner] ──Command──▶ vehicle
//!                                    ├──────── Observation ──▶ [Observer]
//!                                    └── Situation ──▶ [Policy] ──rates──▶ sensors
//! ```
//!
//! Each trait is implemented by the crate of its stage: `CameraSensor` and `KalmanTracker` (zhuyi-perception),
//! `KinematicPredictor` (zhuyi-prediction), `RuleBasedPlanner` (zhuyi-planner), the policies (zhuyi-scheduler). The simulation calls all of them through
//! these traits alone. An object serves one run at a time, in one thread.

mod observer;
mod planner;
pub mod policy;
mod predictor;
mod sensor;
mod tracker;

pub use observer::{Observation, Observer};
pub use planner::Planner;
pub use policy::{CameraState, DemandSeries, Policy, PolicyError, RateLimit, Situation};
pub use predictor::Predictor;
pub use sensor::{Sensor, Truth};
pub use tracker::{Knowledge, Tracker};
