//! `zhuyi compare`: what other safety models ask for on the same runs.

use std::path::PathBuf;

use clap::Args;
use zhuyi_scenario::embedded;
use zhuyi_studies::{Comparison, compare};

use super::Task;
use super::delivery::{self, Place};
use super::grid::seed_count;
use super::run::seed;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::inputs::{Inputs, Setup};
use crate::interrupt;
use crate::problems::Problems;
use crate::progress::Bar;
use crate::shell;

/// [ms] a step of a run.
const STEP: u64 = 10;

/// `zhuyi compare` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi compare cut-in cut-out-fast      two scenarios, printed alone: no file is written
  zhuyi compare --out results            all nine, into results/compare.md and two .csv files
  zhuyi compare --out results --check    does it make what results/ holds?
  zhuyi compare my-scenario.ron --system my-car.ron --seeds 3

Each model is asked at each step of the same drives; beside what it asks for stands what was needed: at that step, to touch nobody \
by holding on and then braking, and in the scenario, its MRF. Then the drives are made again at the rates that each model asked \
for. Without --out nothing is written: what came out is printed, in short. The same command gives the same bytes.")]
pub struct Arguments {
    /// Scenarios' names (see zhuyi list) or paths of .ron files [default: all that come with the program]
    #[arg(value_name = "SCENARIO")]
    scenarios: Vec<String>,
    /// Frame rate of all cameras in the drives that the models are asked about, in frames per second
    #[arg(
        long,
        value_name = "RATE",
        default_value = "30",
        allow_hyphen_values = true
    )]
    fpr: String,
    /// How many random drives: seeds 0, 1, .. of zhuyi run
    #[arg(
        long,
        value_name = "COUNT",
        default_value = "10",
        allow_hyphen_values = true
    )]
    seeds: String,
    /// Ask the models every so many milliseconds, a multiple of 10; more is quicker and may miss peaks
    #[arg(
        long,
        value_name = "MS",
        default_value = "10",
        allow_hyphen_values = true
    )]
    every_ms: String,
    /// Root of all randomness: another one makes all seeds other drives
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    root_seed: String,
    /// Folder for compare.md, compare.csv and compare_demand.csv; made if it is missing, and the files in it replaced;
    /// without it nothing is written
    #[arg(short, long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write nothing: compare with the files in the folder, byte for byte, and exit with 1 where one differs
    #[arg(long, requires = "out")]
    check: bool,
    #[command(flatten)]
    setup: Setup,
}

/// What to compare and what to do with the results.
#[derive(Debug)]
pub struct Compare {
    comparison: Comparison,
    place: Option<Place>,
}

impl Arguments {
    /// What was typed, as meant. The folder is tried before the drives are made.
    pub fn meant(self) -> Result<Compare, Error> {
        let mut problems = Problems::default();
        let all: Vec<String> = embedded::names().map(String::from).collect();
        let named = if self.scenarios.is_empty() {
            &all
        } else {
            &self.scenarios
        };
        let read = Inputs::read(named, &self.setup, &mut problems);
        let fpr = Argument::new("--fpr", &self.fpr);
        let fpr = fpr.whole(&fpr.all(), "a frame rate", 1..=1000, &mut problems);
        let seeds = seed_count(Argument::new("--seeds", &self.seeds), &mut problems);
        let every = steps(&self.every_ms, &mut problems);
        let root_seed = seed(Argument::new("--root-seed", &self.root_seed), &mut problems);
        let place = self.out.clone().map(|out| Place {
            out,
            check: self.check,
        });
        if let Some(place) = &place {
            place.look(&mut problems);
        }
        let command = self.command();
        let comparison = || {
            Some(Comparison {
                scenarios: read.scenarios?,
                system: read.system?,
                root_seed: root_seed?,
                fpr: fpr? as u32,
                seeds: seeds?,
                every: every?,
                command,
            })
        };
        let comparison = comparison();
        if let Some(asked) = &comparison {
            let (root, seeds) = (asked.root_seed, 0..asked.seeds);
            problems.look_at_starts(&asked.scenarios, &asked.system, root, &seeds);
        }
        let comparison = problems.finish(comparison)?;
        if let Some(place) = &place {
            place.prepare()?;
        }
        Ok(Compare { comparison, place })
    }

    /// The command that does the same, but for where the files go.
    fn command(&self) -> String {
        let mut words = vec!["zhuyi", "compare"];
        words.extend(self.scenarios.iter().map(String::as_str));
        for (flag, typed, default) in [
            ("--fpr", &self.fpr, "30"),
            ("--seeds", &self.seeds, "10"),
            ("--every-ms", &self.every_ms, "10"),
            ("--root-seed", &self.root_seed, "0"),
        ] {
            if typed != default {
                words.extend([flag, typed]);
            }
        }
        words.extend(self.setup.words());
        shell::line(words)
    }
}

/// Milliseconds as steps of a run.
fn steps(typed: &str, problems: &mut Problems) -> Option<usize> {
    let argument = Argument::new("--every-ms", typed);
    let ms = argument.whole(
        &argument.all(),
        "the time between two questions",
        STEP..=10_000,
        problems,
    )?;
    if ms % STEP != 0 {
        let fault = crate::fault::Fault::NoMultiple {
            what: "the time between two questions",
            of: STEP,
            got: ms,
        };
        argument.refuse(&argument.all(), fault, problems);
        return None;
    }
    Some((ms / STEP) as usize)
}

impl Task for Compare {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let results = compare(&self.comparison, &Bar::new());
        match &self.place {
            Some(place) => place.deliver(&results),
            None => Ok(Answer::new(delivery::said(&results))),
        }
    }
}
