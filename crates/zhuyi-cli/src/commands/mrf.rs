//! `zhuyi mrf`: the minimum required frame rate (reading R20), of all cameras together or of each by itself.

mod per_camera;

use clap::Args;

use super::{Task, grid};
use crate::answer::Answer;
use crate::error::Error;

/// `zhuyi mrf` as typed.
#[derive(Args, Debug)]
#[command(
    mut_arg("scenarios", |arg| arg.required(false).required_unless_present("per_camera")),
    mut_arg("fpr", |arg| arg.help("\
Frame rates in frames per second, the same on all cameras, or with --per-camera those that each may have: from:to[:step] with \
both ends, single rates, or several of these, as 1:10,15,30 [default: 1:30]")),
    after_help = "\
Examples:
  zhuyi mrf cut-out-fast
  zhuyi mrf cut-out cut-out-fast --seeds 50
  zhuyi mrf my-scenario.ron --fpr 1:60:2 --system my-car.ron
  zhuyi mrf cut-out-fast --set planner.time_headway_s=1.5
  zhuyi mrf --per-camera cut-out-fast    a rate of its own for each camera
  zhuyi mrf --per-camera --out out       in all nine, into out/mrf_per_camera.md and .csv
  zhuyi mrf --per-camera cut-in --fpr 1:6 --brute-force cut-in

A rate is safe when none of its seeds collides. The MRF is the lowest tested rate from which on all are safe; >30 says that \
the highest tested one, 30, is not.

With --per-camera, front_120 (and front_60 with it), left and right have a rate each; rear keeps that of the system file. A \
combination of rates is safe when it and all in which no camera is slower are free of collisions; found are the slowest safe ones. \
The search takes it that a higher rate does not harm, and checks that on some hundred combinations; --brute-force trusts nothing \
and tries all of them (30 x 30 x 30 take a quarter of an hour or more)."
)]
pub struct Arguments {
    #[command(flatten)]
    grid: grid::Arguments,
    #[command(flatten)]
    per_camera: per_camera::Arguments,
}

/// The drives that show it.
#[derive(Debug)]
pub enum Mrf {
    /// The same rate on all cameras.
    Uniform(Box<grid::Grid>),
    /// A rate of its own for each.
    PerCamera(Box<per_camera::Search>),
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Mrf, Error> {
        Ok(if self.per_camera.is_asked_for() {
            Mrf::PerCamera(Box::new(self.per_camera.meant(self.grid)?))
        } else {
            Mrf::Uniform(Box::new(self.grid.meant()?))
        })
    }
}

impl Task for Mrf {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let grid = match *self {
            Self::Uniform(grid) => grid,
            Self::PerCamera(search) => return search.run(),
        };
        let records = grid.run(&[])?;
        let (table, legend) = (grid.table(&records), grid.legend());
        Ok(Answer::new(format!("{table}\n{legend}")))
    }
}
