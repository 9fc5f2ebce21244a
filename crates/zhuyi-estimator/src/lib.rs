//! The Zhuyi model: how slow may perception be before the ego can no longer brake in time?
//!
//! ```text
//!   Ego ──────────────┐
//!   Future, l_0 ──────┤ per actor and future                                per actor                  per camera
//!                     ▼                                                        │                           │
//!   solver::conflict: when in the ego's corridor?    (R7, R8)                  │                           │
//!   ego_motion: hold, brake, stand                   (R1-R3)                   │                           │
//!   constraints at t_n, no contact before            (R5, R6, R9)              │                           │
//!   solver::exact | paper: such a t_n for this l?    (R11)                     │                           │
//!   estimator: the largest l of the grid             (R4, R12) ── Estimate ──▶ aggregation (R13) ──▶ demand (R14)
//! ```
//!
//! | question | ask |
//! |---|---|
//! | one actor, one future | [`Estimator::trajectory`], for recorded runs [`Estimator::recorded`] |
//! | one recorded actor, step after step | [`Estimator::playback`] |
//! | one actor, several futures with probabilities | [`Estimator::forecast`] |
//! | all actors and cameras of a moment | [`Estimator::moment`] |
//! | all cameras, with any other source of answers | [`Estimator::demands`], [`Estimator::demands_into`] |
//! | what an actor asks that is not known exactly | [`Estimator::uncertain`] |
//! | the same where the ego may also evade | [`Estimator::evading`] |
//! | an actor where nobody looks | [`phantom`] |
//! | what RSS or another model asks for | [`Estimator::by_model`] |
//!
//! The modules at the top state the formulas; `solver` finds their answers quickly and means nothing of its own.
//!
//! To embed it, start with [`embedding`]: what goes in, units, frames, readings.
//!
//! The answer is an [`Estimate`]: a [`State`], the tolerable latency where there is one, the time t_n that made it
//! so, and what refused the next larger latency. [`Estimate::fpr`] turns it into frames per second.
//!
//! What the model guarantees, each with a test: an ego that follows the procedure (hold for t_r, then brake) at the
//! tolerable latency touches nobody up to t_n, under [`Criterion::Standstill`] for good; a larger gap, a faster actor,
//! a slower ego, fewer frames to confirm or harder braking never lower the latency; only differences in place and time
//! count; the paper's jumps never tolerate more than the exact solver. Where each is a law, how often it was tried and
//! what the model gets wrong: [`laws`]. The answer to a question depends on nothing but the question,
//! and asking about one future allocates nothing.
//!
//! Source: "Zhuyi: Perception Processing Rate Estimation for Safety in Autonomous Vehicles" (DAC 2022). "Reading
//! R1" and so on name the places where the paper leaves a choice, and the choice taken. Left out, as in the paper:
//! limits of the brakes. Three things that the paper leaves out are options, and off: uncertainty of what is perceived
//! ([`uncertainty`]), actors not yet seen ([`phantom`]), steering as a way out ([`evasion`]).

#[doc = include_str!("embedding.md")]
pub mod embedding {}

pub mod aggregation;
pub mod constraints;
pub mod demand;
pub mod ego_motion;
pub mod estimate;
pub mod evasion;
pub mod future;
pub mod grid;
#[doc = include_str!("laws.md")]
pub mod laws {}
pub mod model;
pub mod moment;
pub mod paper;
pub mod params;
pub mod phantom;
pub mod samples;
pub mod uncertainty;

mod estimator;
mod judge;
mod solver;

pub use aggregation::ForecastEstimate;
pub use demand::{Demand, Watch};
pub use estimate::{Binding, Ego, Estimate, State, Tolerance};
pub use estimator::Estimator;
pub use evasion::{Evasion, EvasionEstimate, Procedure, Sides};
pub use future::{ActorStart, Future};
pub use grid::Latencies;
pub use model::{Reaction, SafetyModel};
pub use moment::{Answer, Moment, Seen};
pub use params::{Aggregation, Criterion, Grid, Params, Solver};
pub use phantom::{Phantom, PhantomParams, Phantoms, Surroundings};
pub use solver::playback::Playback;
pub use solver::recording::Recording;
pub use uncertainty::Uncertainty;
