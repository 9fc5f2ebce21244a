//! The commands. Each file has the arguments as typed, what they mean, and the run.

mod allocate;
mod beyond;
mod boundary;
mod check;
mod choices;
mod compare;
mod delivery;
mod diff;
mod estimate;
mod explain;
mod figures;
mod grid;
mod list;
mod map;
mod merge;
mod mrf;
mod new;
mod policies;
mod report;
mod reproduce;
mod robustness;
mod run;
mod schema;
mod show;
mod sweep;

use clap::{Parser, Subcommand};

use crate::answer::Answer;
use crate::error::Error;

/// Something to do, checked and ready to run.
pub trait Task {
    /// Does it.
    fn run(self: Box<Self>) -> Result<Answer, Error>;
}

/// How often must a self-driving car look? Zhuyi drives a car with simulated cameras through traffic at chosen frame rates,
/// and estimates from each drive how many frames per second every camera needed.
#[derive(Debug, Parser)]
#[command(
    name = "zhuyi",
    version,
    arg_required_else_help = true,
    max_term_width = 100,
    after_help = "\
Start here:
  zhuyi list                       what comes with the program
  zhuyi run cut-out-fast --fpr 5   one drive, told in figures
  zhuyi reproduce                  the table of the paper (DAC 2022), ours beside the published one

Frame rates are in frames per second and named FPR, frame processing rate, as in the paper.
Exit codes: 0 done, 1 --check or diff found a difference, 2 bad input, 3 incomplete sweep,
            4 reading or writing failed, 130 interrupted."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands as typed.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List the scenarios that come with the program
    List,
    /// Show a scenario: its file with nothing left to defaults, and its start from above
    Show(show::Arguments),
    /// Check scenario and system files, and show everything that is wrong with any of them
    Check(check::Arguments),
    /// Write a commented scenario file to start from
    New(new::Arguments),
    /// Drive once through a scenario and tell what happened
    Run(run::Arguments),
    /// Tell why a drive ended in a collision, and the smallest change that would have saved it
    Explain(explain::Arguments),
    /// Estimate what a recorded trace, of a run or of real traffic, asks of every camera at every step
    Estimate(estimate::Arguments),
    /// Write one HTML file to open in a browser: of a sweep's folder, or of a recorded trace
    Report(report::Arguments),
    /// Drive through scenarios at many frame rates and write one row per run
    Sweep(Box<sweep::Arguments>),
    /// Merge the shards of one sweep, made on one machine or many, into one table
    Merge(merge::Arguments),
    /// Tell what changed between two folders of results: MRFs, runs, claims
    Diff(diff::Arguments),
    /// Find the minimum required frame rate: from it on no seed collides
    Mrf(mrf::Arguments),
    /// Map the share of collisions over the frame rate and another factor
    Map(map::Arguments),
    /// Find the minimum required rate over a free choice, with drives on the border of safe and unsafe
    Boundary(boundary::Arguments),
    /// Make the paper's table, ours beside the published one
    Reproduce(reproduce::Arguments),
    /// See how the minimum required rates move with what was chosen
    Robustness(robustness::Arguments),
    /// Put what other safety models ask for beside what was needed, on the same drives
    Compare(compare::Arguments),
    /// Share compute budgets between the cameras by many policies, and count the collisions
    Allocate(allocate::Arguments),
    /// See what the estimator's options beyond the paper change
    Beyond(beyond::Arguments),
    /// Tell what the JSON documents and the tables that commands write are made of
    Schema(schema::Arguments),
    /// Draw the results, each figure with its numbers as CSV beside it
    Figures(figures::Arguments),
}

impl Command {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Box<dyn Task>, Error> {
        Ok(match self {
            Self::List => Box::new(list::List::meant()?),
            Self::Show(typed) => Box::new(typed.meant()?),
            Self::Check(typed) => Box::new(typed.meant()),
            Self::New(typed) => Box::new(typed.meant()?),
            Self::Run(typed) => Box::new(typed.meant()?),
            Self::Explain(typed) => Box::new(typed.meant()?),
            Self::Estimate(typed) => Box::new(typed.meant()?),
            Self::Report(typed) => Box::new(typed.meant()?),
            Self::Sweep(typed) => Box::new(typed.meant()?),
            Self::Merge(typed) => Box::new(typed.meant()?),
            Self::Diff(typed) => Box::new(typed.meant()),
            Self::Mrf(typed) => Box::new(typed.meant()?),
            Self::Map(typed) => Box::new(typed.meant()?),
            Self::Boundary(typed) => Box::new(typed.meant()?),
            Self::Reproduce(typed) => Box::new(typed.meant()?),
            Self::Robustness(typed) => Box::new(typed.meant()?),
            Self::Compare(typed) => Box::new(typed.meant()?),
            Self::Allocate(typed) => Box::new(typed.meant()?),
            Self::Beyond(typed) => Box::new(typed.meant()?),
            Self::Schema(typed) => Box::new(typed.meant()?),
            Self::Figures(typed) => Box::new(typed.meant()?),
        })
    }
}
