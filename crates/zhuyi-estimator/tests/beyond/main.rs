//! The options that go beyond the paper, from outside: worked by hand, and laws.
//!
//! - `uncertainty`: what is not known exactly shrinks the gap;
//! - `phantom`: the nearest place that nobody sees;
//! - `edges`: every one of them, against a plain scan of the path;
//! - `evasion`: to the side instead of braking, against a plain scan of its rule.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

mod edges;
mod evasion;
mod phantom;
#[path = "../model/scene.rs"]
mod scene;
mod uncertainty;
