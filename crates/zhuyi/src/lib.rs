//! Closed-loop multi-lane driving simulator with a camera-rate scheduler, and the estimator of the paper *Zhuyi* (DAC 2022).
//!
//! How often must the frames of each camera be processed for the car to stay safe? This crate re-exports the crates of the
//! workspace under one name, each as a module, and the types that most programs need in the [`prelude`].
//!
//! ```toml
//! [dependencies]
//! zhuyi = { path = "zhuyi/crates/zhuyi" }
//! ```
//!
//! # A tour
//!
//! Read a scenario and the system (car, cameras, planner, estimator) that it runs on. Both come with the program here; files are
//! read in the same way.
//! ```
//! use zhuyi::prelude::*;
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let system = System::read(&Source::new("default.ron", embedded::system()), &[])?;
//! let text = embedded::scenario("cut-in").expect("a scenario of the paper's");
//! let scenario = Scenario::read(&Source::new("cut-in.ron", text), &system, &[])?;
//!
//! // Run it once, with every camera at 5 FPR.
//! let rates = FrameRates::new(vec![5.0; system.perception.eyes.len()]);
//! let spec = RunSpec::new(scenario.clone(), system.clone()).with_seed(3);
//! let run = spec.clone().at_rates(rates.clone()).run()?;
//! assert!(!run.collided());
//! assert!(run.extremes(&scenario.road).gap.is_some_and(|metres| metres > 1.0));
//!
//! // With the recorded future known, ask the estimator which rate each camera needed at each step.
//! let estimator = Estimator::new(system.estimator.clone());
//! let peaks = Hindsight::new(&run.trace, &scenario.road, &system, &rates).peaks(&estimator);
//! assert!(peaks.largest > 1.0 && peaks.largest < 5.0);
//!
//! // Let a policy set the rates while driving, within a budget of 20 frames per second for all five cameras.
//! let run = spec.under_policy("phantom", 20.0)?.run()?;
//! assert!(!run.collided());
//! assert!(run.decisions.iter().all(|decision| decision.granted.iter().sum::<f64>() < 20.0 + 1e-8));
//! # Ok(())
//! # }
//! ```
//!
//! # Where to look
//!
//! | to | module |
//! |---|---|
//! | embed the estimator in a stack of one's own | [`estimator`], [`estimator::Estimator::moment`] |
//! | replace a stage: sensor, tracker, predictor, planner, policy, safety model; or watch a run | [`stages`], [`sim::RunSpec`] |
//! | read and write scenario files | [`scenario`] |
//! | run a scenario step by step or as a whole | [`sim`] |
//! | evaluate a recording | [`log`] |
//! | compare with RSS, SFF or TTC, measure criticality | [`metrics`] |
//! | run sweeps, find minimum required rates | [`batch`] |
//! | make the paper's table, compare policies and models | [`studies`] |
//! | draw figures and reports | [`report`] |
//! | look at the stages | [`world`], [`perception`], [`prediction`], [`planner`] |
//! | use the nouns: road, body, track, forecast, command | [`core`] |

pub use zhuyi_batch as batch;
pub use zhuyi_core as core;
pub use zhuyi_core::stages;
pub use zhuyi_estimator as estimator;
pub use zhuyi_log as log;
pub use zhuyi_metrics as metrics;
pub use zhuyi_perception as perception;
pub use zhuyi_planner as planner;
pub use zhuyi_prediction as prediction;
pub use zhuyi_report as report;
pub use zhuyi_scenario as scenario;
pub use zhuyi_scheduler as scheduler;
pub use zhuyi_sim as sim;
pub use zhuyi_studies as studies;
pub use zhuyi_world as world;

/// Types and functions that most programs need.
pub mod prelude {
    pub use zhuyi_core::{
        ActorId, Body, Camera, CameraId, Command, Detection, Footprint, Forecast, Frame,
        FrameRates, Frenet, Lane, Manoeuvre, Pose, Road, Scene, Segment, SimTime, Track,
    };
    pub use zhuyi_estimator::{
        Demand, Ego, Estimate, Estimator, Future, Params, SafetyModel, Watch,
    };
    pub use zhuyi_scenario::{Scenario, Setting, Source, System, embedded, load};
    pub use zhuyi_scheduler::{CameraState, DemandSeries, Policy, PolicyError, Situation, policy};
    pub use zhuyi_sim::{
        Action, Hindsight, Outcome, Peaks, RunRecord, RunSpec, Setup, Simulation, Trace,
    };
}
