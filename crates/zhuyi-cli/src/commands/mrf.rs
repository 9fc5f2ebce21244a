//! `zhuyi mrf`: the minimum required frame rate (reading R20).

use clap::Args;

use super::{Task, grid};
use crate::answer::Answer;
use crate::error::Error;

/// `zhuyi mrf` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi mrf cut-out-fast
  zhuyi mrf cut-out cut-out-fast --seeds 50
  zhuyi mrf my-scenario.ron --fpr 1:60:2 --system my-car.ron
  zhuyi mrf cut-out-fast --set planner.time_headway_s=1.5

A rate is safe when none of its seeds collides. The MRF is the lowest tested rate from which on all are safe; >30 says that \
the highest tested one, 30, is not.")]
pub struct Arguments {
    #[command(flatten)]
    grid: grid::Arguments,
}

/// The drives that show it.
#[derive(Debug)]
pub struct Mrf(grid::Grid);

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Mrf, Error> {
        Ok(Mrf(self.grid.meant()?))
    }
}

impl Task for Mrf {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let records = self.0.run(&[])?;
        Ok(Answer::new(format!(
            "{}\n{}",
            self.0.table(&records),
            self.0.legend()
        )))
    }
}
