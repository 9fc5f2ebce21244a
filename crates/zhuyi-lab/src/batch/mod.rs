//! Sweeps of any size: every run of a plan, in blocks that survive a kill, on one machine or on many.
//!
//! ```text
//!  Plan ─┬─ plan.json
//!        └─ runs 0, 1, 2, .. ──[Batch]──▶ blocks/000000.csv, blocks/000001.csv, .. ──[assemble]──▶ runs.csv
//!                                              └── of shard k of n: those with number mod n = k - 1
//! ```
//!
//! The order of the runs: scenario, point (one value for each varied parameter), rate, seed, the last changing fastest. A run
//! is named by these and draws by scenario, seed and root seed alone (reading R18), so runs that differ in a varied parameter
//! alone share their draws, and neither the blocks nor the shards nor the threads can change a byte of a row.
//!
//! The contract of a folder, which a kill at any moment keeps:
//!
//! | what lies there | what it says |
//! |---|---|
//! | `plan.json` | which sweep this is, with a BLAKE3 hash; it never changes |
//! | `blocks/` | the sweep is under way |
//! | `blocks/000012.csv` | block 12 is complete: it was flushed to the disk under another name and then renamed |
//! | `runs.csv` and no `blocks/` | all runs are made |
//!
//! Left out: a lock. Two processes that go on with the same folder do the same work twice and write the same bytes.

mod blocks;
mod error;
mod make;
mod merge;
#[cfg(feature = "parquet")]
pub mod parquet;
mod plan;
mod sample;
mod table;

pub use blocks::{Folder, Shard};
pub use error::BatchError;
pub use make::Batch;
pub use merge::{Made, Tell, merge};
pub use plan::{Named, Plan, Run, schema};
pub use sample::{Distribution, Sampling, samples};
pub use table::table;
