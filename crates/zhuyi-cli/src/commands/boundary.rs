//! `zhuyi boundary`: the minimum required rate over a free choice.

use clap::Args;
use zhuyi_studies::boundary::{Boundary as Plan, boundary};

use super::choices::{self, Meant};
use super::{Task, delivery};
use crate::answer::Answer;
use crate::error::Error;
use crate::interrupt;
use crate::progress::Bar;

/// What was chosen and could have been otherwise: distances, braking, sight, the frames that confirm, the second front camera.
const DEFAULT: [&str; 5] = [
    "distances=0.7:1.3:0.02",
    "planner.max_decel_mps2=4:6:0.05",
    "perception.visible_share=0.05:0.95:0.05",
    "perception.confirm_frames=1:10",
    "second_front_camera=[true,false]",
];

/// How many cells of each curve are audited.
const AUDITS: usize = 20;

/// `zhuyi boundary` as typed.
#[derive(Args, Debug)]
#[command(
    mut_arg("scenarios", |arg| arg.required(false).help("\
Scenarios' names (see zhuyi list) or paths of .ron files [default: all that come with the program]")),
    mut_arg("seeds", |arg| arg.help("\
How many random drives a cell without a collision has: seeds 0, 1, .. of zhuyi run [default: 10]")),
    after_help = "\
Examples:
  zhuyi boundary cut-out-fast --vary distances=0.8:1.2:0.01      printed alone: the MRF over a factor on all distances
  zhuyi boundary cut-in --vary actors.cutter.speed_mps=10:28:0.5 --vary planner.time_headway_s=0.6:1.6:0.05
  zhuyi boundary --out results             all nine: distances, braking, visible share, K, second front camera; some minutes
  zhuyi boundary --out results --check     does it make what results/ holds?

For each scenario and each --vary the MRF (see zhuyi help mrf) at every value, with drives on both sides of the border of safe and \
unsafe and few elsewhere: five values are scanned through all rates, then values between two of different MRFs are looked at until \
neighbours are left. Between two values of one MRF it is taken to be the same; 20 cells per curve, drawn at random from all that were \
not driven, audit that, and those that contradict are told. Beside a step few drives collide, and the MRF of so many seeds may go back and forth from value to value: \
`zhuyi map` drives every cell and shows how frayed it is.

boundary.md tells the MRFs, boundary.csv has one per value (how: driven, or between), boundary_samples.csv every cell that was driven: \
scenario, parameter, value, fpr, collided, drives (a cell gets no more after its first collision), why."
)]
pub struct Arguments {
    #[command(flatten)]
    choices: choices::Arguments,
}

/// The curves to find.
#[derive(Debug)]
pub struct Boundary(Meant);

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Boundary, Error> {
        Ok(Boundary(self.choices.meant("boundary", &DEFAULT)?))
    }
}

impl Task for Boundary {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let meant = self.0;
        let plan = Plan {
            bench: meant.bench,
            choices: meant.choices,
            rates: meant.rates,
            seeds: meant.seeds,
            root_seed: meant.root_seed,
            audits: AUDITS,
            command: meant.command,
        };
        let results = boundary(&plan, &meant.chosen, &Bar::new());
        match meant.place {
            Some(place) => place.deliver(&results),
            None => Ok(Answer::new(delivery::said(&results))),
        }
    }
}
