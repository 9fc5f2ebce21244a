//! From file to meaning: scenario and system files, checked, in SI; and plans of sweeps.
//!
//! ```text
//!  cut-in.ron ── Source ─┐                               ┌─▶ Scenario   road, ego's start, actors
//!  default.ron ─ Source ─┼─▶ nodes ─▶ readers, checks ───┤
//!  --set a.b=3 ─ Setting ┘   (ron)        │              └─▶ System     vehicle, cameras, planner, estimator
//!                                         └─▶ Invalid: every violation, each with its place
//! ```
//!
//! - [`System::read`], then [`Scenario::read`] against it; or [`load`] for both at once.
//! - A [`Setting`] is one value from elsewhere, by the path of the field that it stands above.
//! - [`Invalid`] holds everything that is wrong and draws it with carets.
//! - [`Scenario::to_ron`] and [`System::to_ron`] write files in which nothing is left to defaults.
//! - [`Plan`] is what a file says of a sweep, each part with its place.
//! - [`embedded`] holds the scenarios and the system that come with the program.
//!
//! **Why not serde's derive.** It stops at the first error and hands on no positions, and a file is to be told all of
//! its errors at once, each with a caret. So `ron` parses, but one level at a time into slices of the text; an address
//! is a position, and a broken field keeps no other from being read. As with `deny_unknown_fields` nothing is skipped,
//! and of fields that differ in their unit alone exactly one is allowed.
//!
//! # A scenario file
//!
//! ```ron
#![doc = include_str!("template.ron")]
//! ```
//!
//! # The default system file
//!
//! ```ron
#![doc = include_str!("../../../scenarios/system/default.ron")]
//! ```
//!
//! # A plan of a sweep
//!
//! ```ron
#![doc = include_str!("../../../scenarios/plans/faster-cutter.ron")]
//! ```
//!
//! # What is wrong with one
//!
//! ```
//! use zhuyi_scenario::{Scenario, Source, System, embedded};
//! let system = System::read(&Source::new("default.ron", embedded::system()), &[])?;
//! let broken = embedded::template().replace("speed_mph: 60", "speed_mph: 600");
//! let invalid = Scenario::read(&Source::new("new.ron", broken), &system, &[]).unwrap_err();
//! assert_eq!(invalid.to_string(), "\
//! error: `speed_mph` must be 0 to 80 m/s, got 600 mph (268.224 m/s)
//!   --> new.ron:14:41
//!    |
//! 14 |     ego: (lane: 2, s_m: 100, speed_mph: 600),
//!    |                                         ^^^");
//! # Ok::<(), zhuyi_scenario::Invalid>(())
//! ```

pub mod embedded;
pub mod model;

mod body;
mod conflict;
mod fields;
mod invalid;
mod limits;
mod load;
mod node;
mod plan;
mod read;
mod reading;
mod show;
mod source;
mod suggestion;
mod syntax;

pub use conflict::Conflict;
pub use invalid::{Invalid, Rule, Violation};
pub use load::load;
pub use model::{EgoStart, Jitter, Online, Scenario, System};
pub use plan::{Piece, Plan, Values, Varied};
pub use source::{Kind, Setting, Source};
pub use suggestion::did_you_mean;
