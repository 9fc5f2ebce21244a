//! Stages of the loop as traits: what a user may replace without a fork.
//!
//! ```text
//!  Truth ──▶ [Sensor] ──Frame──▶ [Tracker] ──Track──▶ [Predictor] ──Forecast──▶ [Planner] ──Command──▶ vehicle
//!                                    └──────── Observation ──▶ [Observer]
//! ```
//!
//! Each trait is implemented by the crate of its stage: `CameraSensor` and `KalmanTracker` (zhuyi-perception),
//! `KinematicPredictor` (zhuyi-prediction), `RuleBasedPlanner` (zhuyi-planner). The simulation calls all of them through
//! these traits alone. An object serves one run at a time, in one thread.

mod observer;
mod planner;
mod predictor;
mod sensor;
mod tracker;

pub use observer::{Observation, Observer};
pub use planner::Planner;
pub use predictor::Predictor;
pub use sensor::{Sensor, Truth};
pub use tracker::{Knowledge, Tracker};
