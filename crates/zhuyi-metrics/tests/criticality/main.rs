//! The criticality metrics from outside, by kind of evidence:
//!
//! - `hand`: cases worked by hand, most of them where a metric is undefined;
//! - `turned`: boxes that stand or turn across the path, the right values of small recordings among them;
//! - `laws`: what holds whatever the numbers;
//! - `replay`: against vehicles that drive on in steps of 1 ms, and places of 10 cm that remember who was there;
//! - `published`: numbers of regulations and of cut-ins worked out by others, and recordings, where they are there.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

mod hand;
mod laws;
mod published;
mod replay;
mod scene;
mod turned;
