//! The nouns of zhuyi. No policy, no input or output, no randomness.
//!
//! ```text
//!  road, vehicle ── Scene ──▶ camera ── Frame ──▶ Track ──▶ Forecast
//!        ▲                                          │
//!        └──────────────── Command ◀────────────────┘
//! ```
//!
//! Conventions, everywhere: strict SI in `f64`; time is [`SimTime`], integer nanoseconds; a place on the road is a
//! [`Frenet`] pair `(s, d)`, `d` and headings positive to the left; the reference point of a body is the centre of
//! its box; a gap is bumper to bumper; a closing speed is positive when approaching; a deceleration named `*_decel`
//! is positive.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // Of the standard library: no result depends on these.

pub mod approach;
pub mod boxes;
pub mod camera;
pub mod command;
pub mod forecast;
pub mod frame;
pub mod geometry;
pub mod idm;
pub mod lane_change;
pub mod lane_frame;
pub mod occlusion;
pub mod quadratic;
pub mod road;
pub mod room;
pub mod scene;
pub mod stages;
pub mod time;
pub mod track;

pub use camera::{Camera, CameraId, FrameRates, Sector};
pub use command::{Command, Manoeuvre};
pub use forecast::{Across, Along, Extent, Forecast, Trajectory};
pub use frame::{Detection, Frame};
pub use geometry::{Axes, Footprint, Point, Pose};
pub use lane_change::{LaneChange, Lateral};
pub use lane_frame::LaneFrame;
pub use road::{Frenet, Lane, Road, RoadError, Segment};
pub use scene::{ActorId, Body, Scene};
pub use time::SimTime;
pub use track::Track;

/// [m/s2] standard gravity (ISO 80000-3).
pub const GRAVITY: f64 = 9.806_65;
