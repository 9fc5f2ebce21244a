//! Eyes: camera rig, frame clocks, visibility and occlusion, confirmation, tracks.
//!
//! ```text
//!            ┌──────────────────────── Eyes ────────────────────────┐     ┌────────── Tracker ──────────┐
//!  Truth ──▶ │ clock ── exposure ──▶ sight ──▶ stream ──▶ in flight │ ──▶ │ confirmation, loss ─ belief │ ──▶ Track
//!            │   ▲                 who is     noise,       latency  │Frame│ K and M frames      Kalman   │
//!            └───┼─────────────────visible────misses────────────────┘     └─────────────────────────────┘
//!            frame rates
//! ```
//!
//! - [`clock`]: when a camera exposes (reading R15).
//! - [`sight`]: what it can see from where it is (R17).
//! - [`CameraSensor`], [`stream`], [`normal`]: what a camera finds of that, and what chance adds (R18).
//! - [`eyes`]: the rig at work; frames from exposure to delivery (R15).
//! - [`axis`], [`belief`]: the Kalman filter of one actor.
//! - [`tracker`]: which actors the ego believes in, and where they are now (R16).
//!
//! What it leaves out: images, classes, and association. A detection carries the identity of its actor, so two cars
//! are never swapped and nothing is invented where nothing is. Bodies hide each other; buildings, weather and night
//! do not exist. The ego knows its own pose exactly.

pub mod axis;
pub mod belief;
mod camera_sensor;
pub mod clock;
pub mod eyes;
pub mod normal;
pub mod params;
pub mod sight;
mod silhouette;
pub mod stream;
pub mod tracker;

pub use camera_sensor::CameraSensor;
pub use clock::Clock;
pub use eyes::Eyes;
pub use params::{Errors, Eye, OwnErrors, Perception};
pub use sight::{View, visible_share};
pub use stream::Purpose;
pub use tracker::KalmanTracker;
