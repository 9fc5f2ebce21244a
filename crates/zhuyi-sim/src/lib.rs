//! The loop: one readable tick, the trace, the outcome, and the offline estimate from the trace.
//!
//! ```text
//!  [world] ──Scene──▶ [cameras] ──Frame──▶ [tracker] ──Track──▶ [prediction] ──Forecast─┐
//!     ▲                                       │                                         │
//!     │                                       ▼                                         │
//!     └── Actuation ◀── [actuator] ◀─Command─ [planner] ◀──────────────────────────────┘
//!  every step: row ──▶ Trace ──▶ recorded futures ──▶ [estimator] ──▶ demand per camera
//!
//!  the second loop, where rates change ([decisions]):
//!  Tracks ──▶ [online] ──demand per camera──▶ [scheduler: policy, safety check] ──rates, measures──▶ [cameras], [planner]
//!  Frames ──▶ [pipeline] where they queue for an accelerator ──▶ [tracker]
//! ```
//!
//! What it guarantees, each shown by a test: the same scenario, system, rates and seeds give the same run to the last bit, at any
//! number of threads and in any order; runs that differ in frame rates alone share their draws; exposures fall on their own
//! instants, not on steps; the planner sees confirmed tracks and nothing else.

mod decisions;
pub mod demand_models;
pub mod draws;
mod instant;
pub mod notes;
pub mod offline;
pub mod online;
pub mod outcome;
mod pipeline;
pub mod recorded;
pub mod simulation;
pub mod spec;
pub mod stages;
pub mod starts;
pub mod surroundings;
pub mod trace;
pub mod trace_csv;
mod uncleared;
pub mod waterfall;
pub mod witness;

pub use decisions::{DecisionError, known_future};
pub use draws::Draws;
pub use notes::{Note, notes};
pub use offline::{Hindsight, Peak, Peaks};
pub use online::{Asked, Online};
pub use outcome::{Collision, Extremes, Frames, Outcome, RunRecord};
pub use simulation::{Action, Simulation};
pub use spec::{RunSpec, SpecError, equal_parts};
pub use stages::Setup;
pub use surroundings::{believed, surroundings};
pub use trace::{STEP, Trace};
pub use waterfall::{Cause, Stage, Waterfall};
pub use witness::Witness;
