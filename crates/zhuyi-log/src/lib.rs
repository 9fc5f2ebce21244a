//! Recordings: a trace file, read and evaluated.
//!
//! ```text
//!  TRACE.csv ──[reading]──▶ Log ──[replay]──▶ Moment: ego, actors with futures ──[evaluation]──▶ Evaluation
//!                 │                   ▲                                                │
//!                 ▼                   │ road, or the ego's own recorded path           ├──▶ actors.csv, cameras.csv
//!              Invalid            [path]                                               └──▶ Summary
//! ```
//!
//! Any trace will do: other vehicles than ours, any time step, actors that appear and vanish. Any vehicle can be the
//! ego. What is asked of whom is the estimator's business; this crate makes its questions from rows of x, y, heading
//! and speed. What wrong units give away is in [`consistency`]. Other models than the estimator start from the same [`Moment`]s.
//!
//! ```
//! use zhuyi_core::Camera;
//! use zhuyi_estimator::{Estimator, Params, State, Watch};
//! use zhuyi_log::{Log, Replay, evaluate};
//!
//! // An ego at 10 m/s, half a second long; a car stands 54 m ahead of it, 50 m bumper to bumper.
//! let mut trace = String::from("time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n");
//! for step in 0..6 {
//!     let time = f64::from(step) / 10.0;
//!     trace += &format!("{time},ego,{},0,0,10,0,4,2\n{time},wreck,54,0,0,0,0,4,2\n", 10.0 * time);
//! }
//! let log = Log::read(&trace, Some("ego"))?;
//! # let front = Camera {
//! #     name: "front".into(), forward: 0.0, left: 0.0, yaw: 0.0, fov: 2.0, range: 100.0, analysed: true,
//! # };
//! let rig = [Watch { camera: &front, current_latency: 1.0 / 30.0 }];
//! let replay = Replay::new(&log, log.find("ego").unwrap(), None, 20.0);
//! let evaluation = evaluate(&replay, &Estimator::new(Params::default()), &rig);
//! let first = &evaluation.steps[0];
//! // By hand in the documentation of the estimator: 0.604 s.
//! assert_eq!(first.actors[0].estimate.latency, Some(0.604));
//! assert_eq!(first.demands[0].latency, 0.604);
//! assert_eq!(first.actors[0].estimate.extrapolated, 19.5);
//! # Ok::<(), zhuyi_log::Invalid>(())
//! ```
#![cfg_attr(test, allow(clippy::disallowed_methods))] // Of the standard library: no result depends on these.
#![doc = include_str!("recordings.md")]

pub mod consistency;
pub mod evaluation;
pub mod files;
pub mod invalid;
pub mod log;
pub mod path;
pub mod reading;
pub mod replay;
pub mod summary;

pub use consistency::{Consistency, Disagreement};
pub use evaluation::{Answer, Answers, Evaluation, evaluate, evaluate_with_criticality};
pub use invalid::{Invalid, Rule, Violation};
pub use log::{Log, Row, Step, Vehicle};
pub use replay::{Actor, Moment, Replay, places_on};
pub use summary::{Peak, Summary};
