//! `zhuyi explain`: why a drive ended in a collision, and the smallest single change that would have saved it.

mod changes;
pub mod document;
mod text;

use clap::Args;

use super::Task;
use super::run::{self, Run};
use crate::answer::Answer;
use crate::error::Error;
use crate::inputs::Setup;
pub use document::Explanation;

/// `zhuyi explain` as typed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Examples:
  zhuyi explain cut-out-fast --fpr 5 --seed 1
  zhuyi explain challenging-cut-in --fpr front=2,left=1 --seed 3 --json
  zhuyi explain cut-out-fast --policy uniform --budget-fps 25 --seed 1

The stages on the way to the contact: exposed (the actor came into sight, or, known already, became dangerous), captured (the \
first picture of it), processed, confirmed (K frames in a row), planned (hard braking decided), brake on (90 % of it reached), \
contact; each with its time and the metres that the ego drove since the stage before.

What would have saved it is found by driving again, with the same random draws and one thing changed: the rate of one camera, or \
of all, up to 30 in whole frames per second; K down to 1; the latency of all cameras in steps of 5 % of what it is; the time \
headway in steps of 5 % up to three times of what it is (with it move the actors that start at the planner's steady gap); under a \
policy the budget in steps of 5 % instead of rates and latency. Of each the change nearest to what is that does not collide is \
told, and the one that is smallest in relation to what it was is marked. For a policy exec:COMMAND nothing is tried.

The JSON document has the names of this text with their units: scenario, seed, root_seed, command, collision (null without one), \
smallest_gap_m, smallest_ttc_s, hardest_braking_mps2, told, waterfall (cause, actor, evading_from_s, gap_m, actor_metres_m, metres_m, stages: \
stage, time_s, took_s, metres_m, speed_mps), changes (what, unit, from, to, relative, limit, tried, best, command).")]
pub struct Arguments {
    /// A scenario's name (see zhuyi list) or the path of a .ron file
    #[arg(value_name = "SCENARIO")]
    scenario: String,
    /// Frame rates, as for zhuyi run
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    fpr: Option<String>,
    /// Which of the random drives
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    seed: String,
    /// Root of all randomness
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    root_seed: String,
    #[command(flatten)]
    setup: Setup,
    /// Let a policy decide the frame rates while driving, as for zhuyi run
    #[arg(
        long,
        value_name = "POLICY",
        requires = "budget",
        conflicts_with = "fpr"
    )]
    policy: Option<String>,
    /// What the policy may spend: frames per second over all cameras
    #[arg(
        long,
        value_name = "N",
        requires = "policy",
        group = "budget",
        allow_hyphen_values = true
    )]
    budget_fps: Option<String>,
    /// The same in TOPS of an accelerator
    #[arg(
        long,
        value_name = "N",
        requires = "policy",
        group = "budget",
        allow_hyphen_values = true
    )]
    budget_tops: Option<String>,
    /// Print one JSON document instead of text
    #[arg(long)]
    json: bool,
}

/// A drive to explain.
pub struct Explain {
    run: Run,
    json: bool,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Explain, Error> {
        let run = run::Arguments {
            scenario: self.scenario,
            fpr: self.fpr,
            seed: self.seed,
            root_seed: self.root_seed,
            setup: self.setup,
            trace: None,
            online: None,
            report: None,
            policy: self.policy,
            budget_fps: self.budget_fps,
            budget_tops: self.budget_tops,
            json: false,
        };
        Ok(Explain {
            run: run.meant()?,
            json: self.json,
        })
    }
}

impl Task for Explain {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let run = self.run.drive(true)?;
        let explanation = Explanation::of(&self.run, &run);
        Ok(Answer::new(if self.json {
            explanation.json()
        } else {
            text::describe(&explanation)
        }))
    }
}
