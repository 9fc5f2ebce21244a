//! One implementation per stage, as a user would write it: a package of its own that knows the facade crate `zhuyi` and nothing
//! else. Each is at most 60 lines. `tests/outside.rs` puts each in place of the built-in one and checks that a result changes as
//! predicted.
//!
//! | file | stage | what it does otherwise |
//! |---|---|---|
//! | `planner` | [`Planner`](zhuyi::stages::Planner) | brakes for whatever is ahead |
//! | `tracker` | [`Tracker`](zhuyi::stages::Tracker) | believes at first sight |
//! | `radar` | [`Sensor`](zhuyi::stages::Sensor) | sees through other actors |
//! | `policy` | [`Policy`](zhuyi::stages::Policy) | looks at tracks, not at demands |
//! | `observer` | [`Observer`](zhuyi::stages::Observer) | writes a row per step |
//! | `safety_model` | [`SafetyModel`](zhuyi::estimator::SafetyModel) | demands half a second, whatever comes |

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

pub mod observer;
pub mod planner;
pub mod policy;
pub mod radar;
pub mod safety_model;
pub mod tracker;
