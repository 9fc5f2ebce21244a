//! `zhuyi sweep`: many drives, one row each.

use std::path::PathBuf;

use clap::Args;
use zhuyi_lab::runs::csv_typed;
use zhuyi_lab::sweep::estimator;
use zhuyi_lab::{Results, prepare};

use super::{Task, grid};
use crate::answer::Answer;
use crate::error::Error;
use crate::interrupt;

/// The file with one row per drive.
const FILE: &str = "runs.csv";

/// `zhuyi sweep` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi sweep cut-in --out out
  zhuyi sweep cut-out cut-out-fast --fpr 1:10,15,30 --seeds 50 --out out
  zhuyi sweep my-scenario.ron --fpr 2:30:2 --set planner.min_gap_m=2 --out out

Writes DIR/runs.csv: one row per drive with its outcome, closeness, frames per camera, the offline estimate (drives without a \
collision) and the command that makes the drive again. The same command gives the same bytes.")]
pub struct Arguments {
    #[command(flatten)]
    grid: grid::Arguments,
    /// Folder for runs.csv; made if it is missing, and the file in it replaced
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
}

/// The drives to make and where to write them.
#[derive(Debug)]
pub struct Sweep {
    grid: grid::Grid,
    out: PathBuf,
}

impl Arguments {
    /// What was typed, as meant. The folder is tried before the drives are made.
    pub fn meant(self) -> Result<Sweep, Error> {
        let grid = self.grid.meant()?;
        prepare(&self.out)?;
        Ok(Sweep {
            grid,
            out: self.out,
        })
    }
}

impl Task for Sweep {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let estimators = [estimator(&self.grid.system, |_| {})];
        let records = self.grid.run(&estimators)?;
        let experiment = self.grid.experiment();
        let parts = [("sweep", records.as_slice())];
        let results = Results {
            files: vec![(FILE, csv_typed(&experiment, &self.grid.typed, &parts))],
            claims: Vec::new(),
            summary: self.grid.table(&records),
        };
        let written = {
            let _whole = interrupt::writing();
            results.write(&self.out)
        };
        written?;
        Ok(Answer::new(format!(
            "{}\n{}\n{} drives in {}\n",
            results.summary,
            self.grid.legend(),
            records.len(),
            self.out.join(FILE).display()
        )))
    }
}
