//! Perception from the outside.
//!
//! - `rig`: the small world that the others look at.
//! - `sight`: angular widths and occlusion, by hand and against a fan of rays cast by parry.
//! - `delivery`: exposures, latency, changes of rate, noise and its pairing.
//! - `confirmation`: how long it takes to believe in an actor, and to lose it.
//! - `losses`: latencies that vary, frames that are lost.
//! - `filter`: the Kalman filter against the truth and against its own covariance.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

mod confirmation;
mod delivery;
mod filter;
mod losses;
mod rig;
mod sight;
