//! Scenario and system files: RON as typed, checked, in SI.

pub mod embedded;
pub mod model;

mod body;
mod conflict;
mod fields;
mod invalid;
mod limits;
mod load;
mod node;
mod read;
mod reading;
mod show;
mod source;
mod suggestion;
mod syntax;

pub use conflict::Conflict;
pub use invalid::{Invalid, Rule, Violation};
pub use load::load;
pub use model::{EgoStart, Jitter, Scenario, System};
pub use source::{Kind, Setting, Source};
pub use suggestion::did_you_mean;
