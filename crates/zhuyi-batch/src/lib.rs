//! Many runs: every run of a plan, in blocks that survive a kill, on one machine or on many; and what is counted over runs.
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
//!
//! Beside the sweeps of files:
//! ```text
//!  cells ──▶ [sweep] ──Records──▶ [runs]: runs.csv          Trials ──▶ [shares]: share of collisions per rate ──▶ [mrf]
//!  Files ──▶ [results]: written each complete or not at all, or compared          two tables ──▶ [diff]
//! ```
//!
//! What it guarantees, each shown by a test: the same plan gives the same bytes at any number of threads; the order of the cells changes
//! nothing; a run alone is the run of its sweep. It knows no study: those are in `zhuyi-studies`.

mod batch_error;
mod blocks;
pub mod choice;
pub mod claim;
pub mod columns;
pub mod diff;
pub mod distances;
pub mod error;
pub mod estimators;
pub mod evidence;
mod make;
pub mod manoeuvres;
mod merge;
pub mod mrf;
pub mod parallel;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod plan;
pub mod progress;
pub mod rates;
pub mod results;
pub mod runs;
mod sample;
pub mod schema;
pub mod shares;
pub mod statistics;
pub mod strata;
pub mod sweep;
pub mod table;
#[cfg(test)]
mod testing;
pub mod text;

pub use batch_error::BatchError;
pub use blocks::{Folder, Shard};
pub use error::LabError;
pub use make::Batch;
pub use merge::{Made, Tell, merge};
pub use plan::{Named, Plan, Run};
pub use progress::Progress;
pub use results::{Difference, Results, prepare};
pub use sample::{Distribution, Sampling, samples};
