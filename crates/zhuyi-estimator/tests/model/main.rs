//! The model from outside, worked by hand:
//!
//! - `counterexamples`: most of them where an easier reading of the paper goes wrong;
//! - `failures`: where the model itself breaks a law that one would expect;
//! - `aggregation`: several futures of one actor;
//! - `recording`: the coarse view of long lists.
//!
//! What holds whatever the numbers is in `laws/` beside this folder; `dense_scan.rs` compares with an oracle that shares no
//! line with the crate.

mod aggregation;
mod counterexamples;
mod failures;
mod recording;
mod scene;
