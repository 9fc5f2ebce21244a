//! `zhuyi mrf`: the minimum required frame rate (reading R20), of all cameras together or of each by itself.

pub mod document;
mod per_camera;
mod uniform;

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
  zhuyi mrf cut-out-fast --phases 10     100 drives per rate, ten of them in each tenth of the frame period
  zhuyi mrf cut-out-fast --seeds 1000 --early-stop                  the same MRF, in fewer drives
  zhuyi mrf cut-out-fast --seeds 1000 --early-stop --at-most 0.05   rates below and above a chance of 5 %
  zhuyi mrf cut-out --by-rate
  zhuyi mrf cut-out --json | jq '.scenarios[0].rates[] | {rate_fpr, collided, low, high}'
  zhuyi mrf --per-camera cut-out-fast    a rate of its own for each camera
  zhuyi mrf --per-camera --out out       in all nine, into out/mrf_per_camera.md and .csv
  zhuyi mrf --per-camera cut-in --fpr 1:6 --brute-force cut-in

A rate is safe when none of its seeds collides. The MRF is the lowest tested rate from which on all are safe; >30 says that \
the highest tested one, 30, is not. Rates below the MRF that are safe all the same are told, and rates that are shown to collide \
more often than a lower one: then more frames are not simply safer.

The 95 % range says between which rates the MRF may lie when a chance of a collision of at most P is allowed: P is what --at-most \
says, or else what so many drives without a collision can show. It goes from the lowest rate from which on none is shown to \
be worse than P, to the lowest from which on all are shown to be better (>30: the highest tested one is not). Intervals are \
Wilson's; each rate's holds with 95 %, not all of them together.

--phases N: in each N drives every camera first exposes once in each Nth of its period; all else is drawn as ever. --seeds counts \
such blocks.
--early-stop: a rate gets no more drives once it is decided; --seeds is then the most. Without --at-most that is its first \
collision: MRF and safe rates below it come out as without. With --at-most it is decided once its chance of a collision is shown \
to be at most P or above it. Intervals are then those of Robbins (1970), which hold at whatever number one stops: a rate is \
called wrongly with a chance of 5 % at most, however often it is looked at. For P = 0.05 that takes 158 drives without a collision.

--json is stable: fields are added, never renamed; what there is not is null. Per scenario: mrf, mrf_fpr, safe_below_fpr, \
rising (pairs: the higher rate is shown to collide more often), not_excluded_fpr and shown_fpr (the 95 % range), \
mrf_without_struck_from_behind, more_frames (could, may or cannot help where the highest rate collides), never_began (manoeuvres) \
and rates, each with collided, drives, share, low and high (its interval), struck_from_behind, with_unconfirmed and with_confirmed \
(contacts by kind) and replay, the command of its first collision.

Where the highest rate collides its contacts are told by kind. Struck from behind is an ego whose rear half an actor closes in on: \
that no frame rate prevents. With an actor not yet confirmed: more frames confirm it sooner. With a confirmed actor: the ego knew of \
it, and the rest was up to its brakes. MRF itself counts any contact, as the paper does.

With --per-camera, front_120 (and front_60 with it), left and right have a rate each; rear keeps that of the system file. A \
combination of rates is safe when it and all in which no camera is slower are free of collisions; found are the slowest safe ones. \
The search takes it that a higher rate does not harm, and checks that on some hundred combinations; --brute-force trusts nothing \
and tries all of them (30 x 30 x 30 take a quarter of an hour or more)."
)]
pub struct Arguments {
    #[command(flatten)]
    grid: grid::Arguments,
    #[command(flatten)]
    uniform: uniform::Arguments,
    #[command(flatten)]
    per_camera: per_camera::Arguments,
}

/// The drives that show it.
#[derive(Debug)]
pub enum Mrf {
    /// The same rate on all cameras.
    Uniform(Box<uniform::Search>),
    /// A rate of its own for each.
    PerCamera(Box<per_camera::Search>),
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Mrf, Error> {
        Ok(if self.per_camera.is_asked_for() {
            Mrf::PerCamera(Box::new(self.per_camera.meant(self.grid)?))
        } else {
            Mrf::Uniform(Box::new(self.uniform.meant(&self.grid)?))
        })
    }
}

impl Task for Mrf {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        match *self {
            Self::Uniform(search) => search.run(),
            Self::PerCamera(search) => search.run(),
        }
    }
}
