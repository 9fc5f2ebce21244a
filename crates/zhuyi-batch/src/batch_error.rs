//! What can go wrong with the folder of a sweep.

use std::path::PathBuf;

use crate::error::LabError;

/// Why a sweep could not be begun, gone on with, or put together.
#[derive(Debug, thiserror::Error)]
pub enum BatchError {
    /// Reading or writing failed. What was complete before is still there.
    #[error(transparent)]
    Files(#[from] LabError),
    /// A folder with the blocks of a sweep.
    #[error("{} holds {complete} of {blocks} blocks of a sweep: --resume goes on with it, another folder begins anew", dir.display())]
    Begun {
        /// The folder.
        dir: PathBuf,
        /// How many of its blocks are complete.
        complete: usize,
        /// How many it will have.
        blocks: u64,
    },
    /// A folder of another sweep.
    #[error("{} holds another sweep; these parts of its plan differ: {differing}", dir.display())]
    OtherPlan {
        /// The folder.
        dir: PathBuf,
        /// The fields of the plan that differ.
        differing: String,
    },
    /// No `plan.json` that can be used.
    #[error("{} is not the plan of a sweep: {reason}", path.display())]
    NoPlan {
        /// The file.
        path: PathBuf,
        /// Why it is none.
        reason: String,
    },
    /// A folder that should have blocks.
    #[error("{} has no blocks to merge", dir.display())]
    NoBlocks {
        /// The folder.
        dir: PathBuf,
    },
    /// A block that is not what the plan says.
    #[error("{} does not hold the runs that the plan has there: {reason}; remove it and go on with --resume", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// In what it differs.
        reason: String,
    },
    /// Blocks that are not there.
    #[error("{} of {blocks} blocks are missing: {}", missing.len(), some(missing))]
    Incomplete {
        /// Their numbers.
        missing: Vec<u64>,
        /// How many there should be.
        blocks: u64,
    },
    /// A block in two folders.
    #[error("block {block} is in {} and in {}: every run must be there once", one.display(), two.display())]
    Twice {
        /// Its number.
        block: u64,
        /// A folder.
        one: PathBuf,
        /// Another.
        two: PathBuf,
    },
}

/// The first few of a list of numbers.
fn some(numbers: &[u64]) -> String {
    let mut told: Vec<String> = numbers.iter().take(5).map(u64::to_string).collect();
    if numbers.len() > told.len() {
        told.push("..".to_string());
    }
    told.join(", ")
}
