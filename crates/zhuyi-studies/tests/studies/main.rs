//! The studies from outside.
//!
//! - `determinism`: the same bytes at any number of threads, in any order of cells, and from a run done again;
//! - `table`: what a table makes of records that were written by hand (readings R20 and R21);
//! - `claims`: verdicts on tables that were written by hand;
//! - `files`: shape of every file of a small plan;
//! - `reruns`: which rates are run again;
//! - `moves`: the file of `zhuyi robustness` on a small plan;
//! - `compare`: the audit of all models against hand counts and replays, and its files;
//! - `per_camera`: the search for a rate of each camera against every combination, and its files;
//! - `choices`: maps over two factors, and the border search against the full grid;
//! - `beyond`: the file of `zhuyi beyond`.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod allocate;
mod beyond;
mod choices;
mod claims;
mod compare;
mod determinism;
mod files;
mod moves;
mod per_camera;
mod reruns;
mod small;
mod table;
