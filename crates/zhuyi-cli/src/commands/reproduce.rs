//! `zhuyi reproduce`: the paper's table, ours beside the published one.

use clap::Args;
use zhuyi_studies::reproduce;

use super::{Task, delivery};
use crate::answer::Answer;
use crate::error::Error;

/// `zhuyi reproduce` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi reproduce                                    9 x 30 x 10 drives, into results/
  zhuyi reproduce --check                            does it make what results/ holds?
  zhuyi reproduce --fpr 1,6,30 --seeds 2 --out out   a quick look

Writes table1.md and table1.csv (ours beside the paper's), claims.md (which claims of the paper hold), runs.csv (one row per \
drive) and a manifest. What does not come out as in the paper is told, not hidden: the exit code is 0 whatever the claims say.")]
pub struct Arguments {
    #[command(flatten)]
    delivery: delivery::Arguments,
}

/// The table to make.
#[derive(Debug)]
pub struct Reproduce(delivery::Delivery);

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Reproduce, Error> {
        Ok(Reproduce(self.delivery.meant()?))
    }
}

impl Task for Reproduce {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        self.0.run(reproduce)
    }
}
