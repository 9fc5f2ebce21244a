//! The folder of a sweep: what lies there says how far the sweep is, at any moment.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::error::{Attempt, LabError};
use crate::merge::{self, Tell};
use crate::results::{Draft, prepare};
use crate::{BatchError, Plan};

/// The plan's file.
pub(super) const PLAN: &str = "plan.json";
/// The table of all runs.
pub(super) const RUNS: &str = "runs.csv";
/// The folder of the blocks.
const BLOCKS: &str = "blocks";
/// What that is called from the moment on at which it is not needed any more.
const SPENT: &str = ".blocks.spent";

/// A part of the blocks: those whose number leaves `index - 1` when divided by `of`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub index: u64,
    /// Of how many.
    pub of: u64,
}

impl Shard {
    /// All of them.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Whether a block belongs to it.
    pub fn has(self, block: u64) -> bool {
        block % self.of == self.index - 1
    }
}

/// The folder of a sweep.
#[derive(Debug)]
pub struct Folder<'a> {
    dir: PathBuf,
    plan: &'a Plan,
    finished: bool,
}

impl<'a> Folder<'a> {
    /// Begins a sweep in a folder, which is made if it is missing, or goes on with one where `resume` says so and one is there.
    ///
    /// # Errors
    /// When the folder cannot be written to, has complete blocks and `resume` does not say to go on, or has those of another plan.
    pub fn open(dir: &Path, plan: &'a Plan, resume: bool) -> Result<Self, BatchError> {
        prepare(dir)?;
        let blocks = dir.join(BLOCKS);
        let complete = complete(dir)?;
        let known = known_plan(dir)?;
        let mut folder = Self {
            dir: dir.to_path_buf(),
            plan,
            finished: false,
        };
        match (known, resume) {
            (Some(known), true) => {
                plan.same(&known, dir)?;
                folder.finished = !blocks.exists() && dir.join(RUNS).exists();
                if !folder.finished {
                    make_dir(&blocks)?;
                }
            }
            (known, _) if !complete.is_empty() => {
                return Err(BatchError::Begun {
                    dir: dir.to_path_buf(),
                    complete: complete.len(),
                    blocks: known.as_ref().unwrap_or(plan).blocks(),
                });
            }
            _ => {
                // The blocks' folder first: from now on an old runs.csv is not the end of this sweep.
                make_dir(&blocks)?;
                Draft::write(dir, PLAN, &plan.json())?.rename(&dir.join(PLAN))?;
                flush_names(dir);
            }
        }
        Ok(folder)
    }

    /// The numbers of the blocks of a shard that are not complete, ascending.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn missing(&self, shard: Shard) -> Result<Vec<u64>, BatchError> {
        if self.finished {
            return Ok(Vec::new());
        }
        let complete = complete(&self.dir)?;
        let missing = |number: &u64| shard.has(*number) && !complete.contains(number);
        Ok((0..self.plan.blocks()).filter(missing).collect())
    }

    /// Writes a block: under another name, flushed to the disk, then renamed, which is its completion.
    ///
    /// # Errors
    /// When that fails: then the block is missing, and all others are as they were.
    pub fn write(&self, number: u64, text: &str) -> Result<(), BatchError> {
        let blocks = self.dir.join(BLOCKS);
        let name = block_name(number);
        Draft::write(&blocks, &name, text)?.rename(&blocks.join(&name))?;
        flush_names(&blocks);
        Ok(())
    }

    /// Puts all blocks together to `runs.csv`, after which they are not needed any more, and tells what the runs came to.
    ///
    /// # Errors
    /// When blocks are missing or are not what the plan says, or when reading or writing fails.
    pub fn finish(&self, tell: Tell<'_>) -> Result<(), BatchError> {
        if self.finished {
            merge::read_all(self.plan, &self.dir.join(RUNS), tell)?;
            return Ok(self.tidy()?);
        }
        merge::assemble(self.plan, std::slice::from_ref(&self.dir), &self.dir, tell)?;
        // Renamed first, so that a kill does not leave a part of the blocks, which would look like a sweep under way.
        let (blocks, spent) = (self.dir.join(BLOCKS), self.dir.join(SPENT));
        remove(&spent)?;
        fs::rename(&blocks, &spent).map_err(Attempt::Rename.on(&spent))?;
        Ok(self.tidy()?)
    }

    /// Removes the spent blocks and what killed processes have left half written.
    fn tidy(&self) -> Result<(), LabError> {
        remove(&self.dir.join(SPENT))?;
        remove_drafts(&self.dir)
    }
}

/// Whether a sweep is under way in a folder.
pub(super) fn is_under_way(dir: &Path) -> bool {
    dir.join(BLOCKS).exists()
}

/// The path of a block in a folder.
pub(super) fn block_path(dir: &Path, number: u64) -> PathBuf {
    dir.join(BLOCKS).join(block_name(number))
}

fn block_name(number: u64) -> String {
    format!("{number:06}.csv")
}

/// The numbers of the complete blocks of a folder; drafts and strangers are passed over.
pub(super) fn complete(dir: &Path) -> Result<BTreeSet<u64>, LabError> {
    let blocks = dir.join(BLOCKS);
    let entries = match fs::read_dir(&blocks) {
        Ok(entries) => entries,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(BTreeSet::new()),
        Err(error) => return Err(Attempt::Read.on(blocks)(error)),
    };
    let mut numbers = BTreeSet::new();
    for entry in entries {
        let name = entry.map_err(Attempt::Read.on(&blocks))?.file_name();
        let name = name.to_string_lossy();
        let number = name.strip_suffix(".csv").and_then(|name| name.parse().ok());
        numbers.extend(number.filter(|number| block_name(*number) == name));
    }
    Ok(numbers)
}

/// The plan of a folder, if it has one.
pub(super) fn known_plan(dir: &Path) -> Result<Option<Plan>, BatchError> {
    let path = dir.join(PLAN);
    match fs::read_to_string(&path) {
        Ok(text) => match Plan::read(&text) {
            Ok(plan) => Ok(Some(plan)),
            Err(reason) => Err(BatchError::NoPlan { path, reason }),
        },
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Attempt::Read.on(path)(error).into()),
    }
}

fn make_dir(dir: &Path) -> Result<(), LabError> {
    fs::create_dir_all(dir).map_err(Attempt::CreateDirectory.on(dir))
}

/// Removes a folder with all that is in it, if it is there.
fn remove(dir: &Path) -> Result<(), LabError> {
    match fs::remove_dir_all(dir) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(Attempt::Remove.on(dir)(error)),
        _ => Ok(()),
    }
}

/// Removes what killed processes have left half written.
fn remove_drafts(dir: &Path) -> Result<(), LabError> {
    let ours = [PLAN, RUNS, "runs.parquet", "writable"].map(|name| format!(".{name}."));
    for entry in fs::read_dir(dir).map_err(Attempt::Read.on(dir))? {
        let entry = entry.map_err(Attempt::Read.on(dir))?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if ours.iter().any(|ours| name.starts_with(ours)) && name.ends_with(".draft") {
            // Gone already where another process has tidied up.
            let _ = fs::remove_file(entry.path());
        }
    }
    Ok(())
}

/// Makes the names in a folder last through a power cut, where the system has that.
pub(super) fn flush_names(dir: &Path) {
    if let Ok(opened) = File::open(dir) {
        // Where it cannot be done the files themselves are flushed all the same.
        let _ = opened.sync_all();
    }
}
