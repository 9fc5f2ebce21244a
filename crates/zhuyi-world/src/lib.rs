//! Truth: vehicle motion, actuators, scripted and reactive actors, contact and crash.
//!
//! ```text
//!  Command ──▶ [actuator] ──▶ ego ─┐
//!  script ──▶ [actors] ────────────┼─▶ Scene at any instant of the step ──▶ contact ──▶ crash
//! ```
//!
//! [`World::step`] moves everything by one step; [`World::scene_at`], or [`World::actor_at`] of one actor, tells the truth at any
//! instant within the last step, by the very motion of that step, so that a camera's exposure needs no rounding to steps.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // Of the standard library: no result depends on these.

pub mod actor;
pub mod contact;
pub mod crash;
pub mod progress;
pub mod script;
mod struck;
pub mod vehicle;
mod world;

pub use contact::{Contact, Side};
pub use crash::Crash;
pub use progress::Progress;
pub use vehicle::{Ego, Vehicle};
pub use world::{Start, World};
