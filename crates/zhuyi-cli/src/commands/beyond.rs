//! `zhuyi beyond`: what the estimator's options beyond the paper change.

use clap::Args;
use zhuyi_batch::{Progress, Results};
use zhuyi_report::figures;
use zhuyi_studies::{Plan, beyond};

use super::{Task, delivery};
use crate::answer::Answer;
use crate::error::Error;

/// `zhuyi beyond` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi beyond                       into results/beyond.md and results/figures/
  zhuyi beyond --seeds 2 --out out   a quick look

Three things that the paper leaves out, each by itself: what is not known exactly of an actor shrinks the gap; an actor is \
assumed where no camera looks; the ego may evade where that tolerates more than braking. Estimates are made of the runs at the \
highest of the rates; the others are there to find the minimum rates.")]
pub struct Arguments {
    #[command(flatten)]
    delivery: delivery::Arguments,
}

/// The runs to put to the options.
#[derive(Debug)]
pub struct Beyond(delivery::Delivery);

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Beyond, Error> {
        Ok(Beyond(self.delivery.meant()?))
    }
}

impl Task for Beyond {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        self.0.run(results)
    }
}

fn results(plan: &Plan, progress: &dyn Progress) -> Results {
    let found = beyond(plan, progress);
    let drawn = figures(&found.comparisons);
    found.results(drawn)
}
