//! From blocks to one table, with every run there exactly once.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use csv::StringRecord;

use super::blocks::{PLAN, RUNS, block_path, complete, flush_names, is_under_way, known_plan};
use super::{BatchError, Plan};
use crate::error::Attempt;
use crate::results::{Draft, prepare};
use crate::runs::{NAMED_BY, OUTCOME};

/// What a run came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// No contact.
    Completed,
    /// A contact.
    Collision,
    /// It was not made: the reader has refused its parameters.
    Refused,
    /// It was begun and failed.
    Failed,
}

impl Made {
    /// As rows spell it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Completed => "completed",
            Self::Collision => "collision",
            Self::Refused => "refused",
            Self::Failed => "failed",
        }
    }

    fn named(name: &str) -> Option<Self> {
        let all = [
            Self::Completed,
            Self::Collision,
            Self::Refused,
            Self::Failed,
        ];
        all.into_iter().find(|made| made.name() == name)
    }
}

/// Merges the folders of the shards of one sweep into another folder, and tells the plan and what its runs came to.
///
/// # Errors
/// When they are not of one plan, or a run is missing or there twice, or reading or writing fails.
pub fn merge(dirs: &[PathBuf], out: &Path) -> Result<(Plan, Vec<Made>), BatchError> {
    let mut plan: Option<Plan> = None;
    for dir in dirs {
        let Some(known) = known_plan(dir)? else {
            return Err(BatchError::NoPlan {
                path: dir.join(PLAN),
                reason: "there is no such file".to_string(),
            });
        };
        if !is_under_way(dir) {
            return Err(BatchError::NoBlocks { dir: dir.clone() });
        }
        match &plan {
            None => plan = Some(known),
            Some(plan) => plan.same(&known, dir)?,
        }
    }
    let Some(plan) = plan else {
        let dir = out.to_path_buf();
        return Err(BatchError::NoBlocks { dir });
    };
    if is_under_way(out) {
        return Err(BatchError::Begun {
            dir: out.to_path_buf(),
            complete: complete(out)?.len(),
            blocks: plan.blocks(),
        });
    }
    prepare(out)?;
    let made = assemble(&plan, dirs, out)?;
    Draft::write(out, PLAN, &plan.json())?.rename(&out.join(PLAN))?;
    flush_names(out);
    Ok((plan, made))
}

/// Puts the blocks in some folders together to `runs.csv` in another.
pub(super) fn assemble(plan: &Plan, dirs: &[PathBuf], out: &Path) -> Result<Vec<Made>, BatchError> {
    let places = places(plan, dirs)?;
    let (draft, file) = Draft::begin(out, RUNS)?;
    let mut writer = BufWriter::new(file);
    let mut header: Option<String> = None;
    let mut made = Vec::new();
    for (number, path) in (0..).zip(&places) {
        let text = fs::read_to_string(path).map_err(Attempt::Read.on(path))?;
        made.extend(check(plan, plan.block(number), path, &text)?);
        let (first, rows) = text.split_once('\n').unwrap_or((&text, ""));
        let written = match &header {
            None => {
                header = Some(first.to_string());
                writer.write_all(text.as_bytes())
            }
            Some(header) if header == first => writer.write_all(rows.as_bytes()),
            Some(_) => return Err(damaged(path, "its header is not that of the others")),
        };
        written.map_err(Attempt::Write.on(draft.path()))?;
    }
    let flushed = writer
        .into_inner()
        .map_err(std::io::IntoInnerError::into_error)
        .and_then(|file: File| file.sync_all());
    flushed.map_err(Attempt::Write.on(draft.path()))?;
    draft.rename(&out.join(RUNS))?;
    flush_names(out);
    Ok(made)
}

/// Where each block is, which must be in one of the folders and no other.
fn places(plan: &Plan, dirs: &[PathBuf]) -> Result<Vec<PathBuf>, BatchError> {
    let mut found: Vec<Option<&PathBuf>> = vec![None; plan.blocks() as usize];
    for dir in dirs {
        for block in complete(dir)? {
            let path = || block_path(dir, block);
            match found.get_mut(block as usize) {
                None => return Err(damaged(&path(), "the plan has no such block")),
                Some(Some(one)) => {
                    return Err(BatchError::Twice {
                        block,
                        one: one.clone(),
                        two: dir.clone(),
                    });
                }
                Some(place) => *place = Some(dir),
            }
        }
    }
    let numbered = || (0..).zip(&found);
    let missing: Vec<u64> = numbered()
        .filter_map(|(number, place)| place.is_none().then_some(number))
        .collect();
    if !missing.is_empty() {
        let blocks = plan.blocks();
        return Err(BatchError::Incomplete { missing, blocks });
    }
    Ok(numbered()
        .filter_map(|(number, place)| place.map(|dir| block_path(dir, number)))
        .collect())
}

/// What the runs of a finished table came to.
pub(super) fn read_all(plan: &Plan, path: &Path) -> Result<Vec<Made>, BatchError> {
    let text = fs::read_to_string(path).map_err(Attempt::Read.on(path))?;
    check(plan, 0..plan.runs(), path, &text)
}

/// What the runs of a table came to, which must be those at these places, in their order.
fn check(
    plan: &Plan,
    places: Range<u64>,
    path: &Path,
    text: &str,
) -> Result<Vec<Made>, BatchError> {
    plan.made(places, text)
        .map_err(|reason| damaged(path, &reason))
}

impl Plan {
    /// What the runs of a table, `runs.csv` or one of its blocks, came to, which must be those at these places, in their order.
    ///
    /// # Errors
    /// When it is another table.
    pub fn made(&self, places: Range<u64>, text: &str) -> Result<Vec<Made>, String> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let no_table = |error: csv::Error| error.to_string();
        let mut names: Vec<&str> = NAMED_BY.into();
        names.extend(self.varied.iter().map(String::as_str));
        names.push(OUTCOME);
        let outcome = names.len() - 1;
        let header = reader.headers().map_err(no_table)?;
        if !header.iter().take(names.len()).eq(names.iter().copied()) {
            return Err("its header is another".to_string());
        }
        let mut made = Vec::new();
        let mut expected = places.clone();
        let mut row = StringRecord::new();
        while reader.read_record(&mut row).map_err(no_table)? {
            let fields = expected.next().map(|place| self.fields(self.run(place)));
            let is_meant = fields.is_some_and(|fields| fields.iter().eq(row.iter().take(outcome)));
            let Some(found) = row.get(outcome).and_then(Made::named).filter(|_| is_meant) else {
                return Err(format!("its run {} is another", made.len() + 1));
            };
            made.push(found);
        }
        if expected.next().is_some() {
            let count = places.end - places.start;
            return Err(format!("it has {} of {count} runs", made.len()));
        }
        Ok(made)
    }
}

fn damaged(path: &Path, reason: &str) -> BatchError {
    BatchError::Damaged {
        path: path.to_path_buf(),
        reason: reason.to_string(),
    }
}
