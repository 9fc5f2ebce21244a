//! From blocks to one table, with every run there exactly once.

use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use csv::StringRecord;

use crate::blocks::{PLAN, RUNS, block_path, complete, flush_names, is_under_way, known_plan};
use crate::error::Attempt;
use crate::manoeuvres::COLUMN;
use crate::results::{Draft, prepare};
use crate::runs::{NAMED_BY, OUTCOME};
use crate::{BatchError, Plan, Run};

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

/// Is told what each run came to, in order, and when its manoeuvres began and ended as [`spelt`](crate::manoeuvres::spelt): a
/// sweep may have more runs than a list of them has room for.
pub type Tell<'a> = &'a mut dyn FnMut(&Plan, Run, Made, &str);

/// Merges the folders of the shards of one sweep into another folder, tells what its runs came to and gives its plan.
///
/// # Errors
/// When they are not of one plan, or a run is missing or there twice, or reading or writing fails.
pub fn merge(dirs: &[PathBuf], out: &Path, tell: Tell<'_>) -> Result<Plan, BatchError> {
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
    assemble(&plan, dirs, out, tell)?;
    Draft::write(out, PLAN, &plan.json())?.rename(&out.join(PLAN))?;
    flush_names(out);
    Ok(plan)
}

/// Puts the blocks in some folders together to `runs.csv` in another.
pub(super) fn assemble(
    plan: &Plan,
    dirs: &[PathBuf],
    out: &Path,
    tell: Tell<'_>,
) -> Result<(), BatchError> {
    let places = places(plan, dirs)?;
    let (draft, file) = Draft::begin(out, RUNS)?;
    let mut writer = BufWriter::new(file);
    let mut header: Option<String> = None;
    for (number, dir) in (0..).zip(places) {
        let path = &block_path(dir, number);
        let text = fs::read_to_string(path).map_err(Attempt::Read.on(path))?;
        check(plan, plan.block(number), path, text.as_bytes(), tell)?;
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
    Ok(())
}

/// The folder that each block is in, which must be in one of the folders and no other.
fn places<'d>(plan: &Plan, dirs: &'d [PathBuf]) -> Result<Vec<&'d Path>, BatchError> {
    let mut found: Vec<Option<&'d Path>> = vec![None; plan.blocks() as usize];
    for dir in dirs {
        for block in complete(dir)? {
            let path = || block_path(dir, block);
            match found.get_mut(block as usize) {
                None => return Err(damaged(&path(), "the plan has no such block")),
                Some(Some(one)) => {
                    return Err(BatchError::Twice {
                        block,
                        one: one.to_path_buf(),
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
    Ok(found.into_iter().flatten().collect())
}

/// Tells what the runs of a finished table came to.
pub(super) fn read_all(plan: &Plan, path: &Path, tell: Tell<'_>) -> Result<(), BatchError> {
    let file = File::open(path).map_err(Attempt::Read.on(path))?;
    check(plan, 0..plan.runs(), path, BufReader::new(file), tell)
}

/// Tells what the runs of a table came to, which must be those at these places, in their order.
fn check(
    plan: &Plan,
    places: Range<u64>,
    path: &Path,
    text: impl Read,
    tell: Tell<'_>,
) -> Result<(), BatchError> {
    plan.made(places, text, tell)
        .map_err(|reason| damaged(path, &reason))
}

impl Plan {
    /// Tells what the runs of a table, `runs.csv` or one of its blocks, came to, which must be those at these places, in
    /// their order.
    ///
    /// # Errors
    /// When it is another table.
    pub fn made(&self, places: Range<u64>, text: impl Read, tell: Tell<'_>) -> Result<(), String> {
        let mut reader = csv::Reader::from_reader(text);
        let no_table = |error: csv::Error| error.to_string();
        let mut names: Vec<&str> = NAMED_BY.into();
        names.extend(self.varied.iter().map(String::as_str));
        names.push(OUTCOME);
        let outcome = names.len() - 1;
        let header = reader.headers().map_err(no_table)?;
        if !header.iter().take(names.len()).eq(names.iter().copied()) {
            return Err("its header is another".to_string());
        }
        // A table of an earlier version has none.
        let manoeuvres = header.iter().position(|name| name == COLUMN);
        let mut expected = places.clone();
        let reached = |expected: &Range<u64>| expected.start - places.start;
        let mut row = StringRecord::new();
        while reader.read_record(&mut row).map_err(no_table)? {
            let before = reached(&expected);
            let run = expected.next().map(|place| self.run(place));
            let is_meant = |run: &Run| self.fields(*run).iter().eq(row.iter().take(outcome));
            let made = row.get(outcome).and_then(Made::named);
            let Some((run, made)) = run.filter(is_meant).zip(made) else {
                return Err(format!("its run {} is another", before + 1));
            };
            let manoeuvres = manoeuvres.and_then(|place| row.get(place));
            tell(self, run, made, manoeuvres.unwrap_or(""));
        }
        if !expected.is_empty() {
            let (found, count) = (reached(&expected), places.end - places.start);
            return Err(format!("it has {found} of {count} runs"));
        }
        Ok(())
    }
}

pub(super) fn damaged(path: &Path, reason: &str) -> BatchError {
    BatchError::Damaged {
        path: path.to_path_buf(),
        reason: reason.to_string(),
    }
}
