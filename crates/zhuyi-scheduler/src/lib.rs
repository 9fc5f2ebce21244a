//! The paper's use of the estimate: which camera's frames are processed how often when there is not enough for all,
//! and a check that says when it is too little.
//!
//! ```text
//!   demand per camera ──┬──▶ safety check ──▶ alarm ──▶ response: none, brake, limit functions, raise rates
//!   (zhuyi, rss, ttc,   │                                  │
//!    pylot, offline)    ▼                                  ▼
//!   budget ─────────▶ policy ──▶ rates in [floor, 30], sum within the budget ──▶ cameras
//!                       ▲                                                          │ frames
//!                       └ sharing: cut, share the rest, raise                      ▼
//!                                             queue ──▶ accelerator ──▶ ready times, transfers avoided
//! ```
//!
//! [`policy`] makes one by its name; [`POLICIES`] lists them, with what each shares by and where it comes from, and [`policies`] has a file for
//! each. A policy of one's own in Rust is a type with [`Policy`]:
//!
//! ```
//! use zhuyi_core::{Body, Camera, Footprint};
//! use zhuyi_scheduler::{CameraState, DemandSeries, Policy, Situation, policy};
//! let rig = [("front_120", 0.0), ("left", 1.6), ("right", -1.6)].map(|(name, yaw)| Camera::new(name, yaw, 2.0, 80.0));
//! let cameras = rig.each_ref().map(|camera| CameraState { camera, rate: 10.0 });
//! let situation = Situation {
//!     scenario: "cut-in",
//!     seed: 0,
//!     time: 0.0,
//!     budget: 24.0,
//!     ego: &Body::aligned(Footprint { length: 4.5, width: 1.8 }, 0.0, 0.0, 20.0),
//!     tracks: &[],
//!     cameras: &cameras,
//!     demands: &[DemandSeries::new("zhuyi", [8.0, 3.0, 1.0])],
//! };
//! let mut rates = [0.0; 3];
//! policy("proportional")?.decide(&situation, &mut rates)?;
//! assert_eq!(rates, [16.0, 6.0, 2.0]);
//! policy("demand-first")?.decide(&situation, &mut rates)?;
//! assert_eq!(rates, [12.0, 7.0, 5.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What it guarantees, each with a test: after a decision every rate is finite, in [floor, 30] with floor = min(1,
//! budget / cameras), and their sum is within the budget; the sharing rules never take when the budget grows (raising
//! rates: where those fit it) and do not look at a camera's place in the rig; a program that hangs, dies or talks nonsense is an error and not a hang.
//!
//! The crate knows the nouns alone: demands are numbers to it, whoever computed them, and the truth is out of reach.
//! Left out: what a change of rates costs, cameras of different resolution, several accelerators.

pub mod chip;
pub mod demands;
pub mod policies;
pub mod queue;
pub mod safety;
pub mod score;
pub mod search;
pub mod sharing;

pub use chip::{Chip, Compute, Discipline};
pub use policies::{MakePolicy, POLICIES, UnknownPolicy, policy, policy_maker};
pub use queue::{Accelerator, Queued};
pub use zhuyi_core::stages::{
    CameraState, DemandSeries, Policy, PolicyError, RateLimit, Situation,
};
