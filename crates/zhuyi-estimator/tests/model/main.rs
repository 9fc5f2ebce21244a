//! The model from outside, by kind of evidence:
//!
//! - `counterexamples`: cases worked by hand, most of them where an easier reading of the paper goes wrong;
//! - `laws`: what holds whatever the numbers;
//! - `plain`: the exact solver against one without anything that makes it fast;
//! - `recording`: the coarse view of long lists against the lists themselves.
//!
//! `dense_scan.rs` beside this folder compares with an oracle that shares no line with the crate.

mod counterexamples;
mod laws;
mod plain;
mod recording;
mod scene;
