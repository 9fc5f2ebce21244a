//! `zhuyi merge`: the shards of one sweep, put together.

use std::path::PathBuf;

use clap::Args;

use super::Task;
use super::sweep::{Told, parquet};
use crate::answer::Answer;
use crate::error::Error;
use crate::problems::Problems;

/// `zhuyi merge` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi merge shard-1 shard-2 shard-3 --out merged

Every run of the plan must be there exactly once. The merged runs.csv has the bytes that one undisturbed sweep writes. Where blocks \
are missing nothing is written and the exit code is 3.")]
pub struct Arguments {
    /// Folders of zhuyi sweep --shard
    #[arg(value_name = "DIR", required = true)]
    dirs: Vec<PathBuf>,
    /// Folder for runs.csv and plan.json; made if it is missing, and the files in it replaced
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
    /// Write DIR/runs.parquet too: the same rows in typed columns (a program built with the feature parquet)
    #[arg(long)]
    parquet: bool,
}

/// The folders to merge.
#[derive(Debug)]
pub struct Merge {
    dirs: Vec<PathBuf>,
    out: PathBuf,
    parquet: Option<parquet::Write>,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Merge, Error> {
        let Self { dirs, out, parquet } = self;
        let mut problems = Problems::default();
        let parquet = parquet::asked(parquet, &mut problems);
        problems.finish(Some(Merge { dirs, out, parquet }))
    }
}

impl Task for Merge {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let mut told = Told::default();
        let plan =
            zhuyi_batch::merge(&self.dirs, &self.out, &mut |plan, run, made, manoeuvres| {
                told.add(plan, run, made, manoeuvres);
            })?;
        if let Some(write) = self.parquet {
            write(&self.out)?;
        }
        Ok(Answer::new(told.text(&plan, &self.out)))
    }
}
