//! `zhuyi robustness`: how the minimum required rates move with what was chosen.

use clap::Args;
use zhuyi_studies::robustness;

use super::{Task, delivery};
use crate::answer::Answer;
use crate::error::Error;

/// `zhuyi robustness` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi robustness                       into results/robustness.md
  zhuyi robustness --seeds 2 --out out   a quick look

The paper gives no distances, braking or lag; they were chosen. This tells how far the table hangs on the choice: it is made \
again with each of them moved, and with fresh blocks of seeds.")]
pub struct Arguments {
    #[command(flatten)]
    delivery: delivery::Arguments,
}

/// The variations to run.
#[derive(Debug)]
pub struct Robustness(delivery::Delivery);

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Robustness, Error> {
        Ok(Robustness(self.delivery.meant()?))
    }
}

impl Task for Robustness {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        self.0.run(robustness)
    }
}
