//! `zhuyi diff`: what changed between two folders of results.

use std::path::PathBuf;

use clap::Args;
use zhuyi_batch::diff::diff;

use super::Task;
use crate::answer::Answer;
use crate::error::Error;

/// `zhuyi diff` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi diff results out
  zhuyi diff before after && echo the same

Runs are found by scenario, rates, seed and what is varied, wherever their rows stand. How results were made (plan.json, \
manifest.json, the column replay) is passed over. Exit code 1 where anything changed.")]
pub struct Arguments {
    /// A folder with runs.csv, claims.md or other results
    #[arg(value_name = "A")]
    a: PathBuf,
    /// The folder to compare it with
    #[arg(value_name = "B")]
    b: PathBuf,
}

/// The folders to compare.
#[derive(Debug)]
pub struct Diff {
    a: PathBuf,
    b: PathBuf,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Diff {
        let Self { a, b } = self;
        Diff { a, b }
    }
}

impl Task for Diff {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let (a, b) = (self.a.display(), self.b.display());
        let changes = diff(&self.a, &self.b)?;
        Ok(if changes.is_empty() {
            Answer::new(format!("{a} and {b} have the same results\n"))
        } else {
            let failure = Error::Unmet(format!("{a} and {b} differ"));
            Answer::failing(changes.to_string(), failure)
        })
    }
}
