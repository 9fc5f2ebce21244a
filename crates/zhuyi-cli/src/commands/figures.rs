//! `zhuyi figures`: pictures of the results, each with the numbers that it draws as CSV beside it.

use clap::Args;
use std::path::PathBuf;

use zhuyi_batch::Results;
use zhuyi_estimator::Estimator;
use zhuyi_report::plots::{self, File};
use zhuyi_studies::Plan;
use zhuyi_studies::claims::run::course::SHOWN;
use zhuyi_studies::claims::run::foresight::Foresight;
use zhuyi_studies::claims::run::{course, foresight, sensitivity};
use zhuyi_studies::committed::{CommittedError, Slowest, Spent, TableRow, slowest, spent, table};

use super::Task;
use super::delivery::Place;
use crate::answer::Answer;
use crate::error::Error;
use crate::interrupt;
use crate::problems::{Problem, Problems};

/// `zhuyi figures` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi figures             into results/figures/, an SVG and a CSV each
  zhuyi figures --check     does it draw what results/figures/ holds?

Drawn from results in the folder: estimates (table1.csv), budget (allocation.csv) and frontier (mrf_per_camera.csv). Calculated, or \
from the drive with seed 0 at 30 FPR: throughput, sensitivity, latency-cut-out-fast and its neighbours, online-cut-in.")]
pub struct Arguments {
    /// Folder with the results; the figures go into its folder figures, and the files in it are replaced
    #[arg(short, long, value_name = "DIR", default_value = "results")]
    out: PathBuf,
    /// Write nothing: compare with the files in the folder, byte for byte, and exit with 1 where one differs
    #[arg(long)]
    check: bool,
}

/// What to draw.
#[derive(Debug)]
pub struct Figures {
    plan: Plan,
    table: Vec<TableRow>,
    spent: Vec<Spent>,
    slowest: Vec<Slowest>,
    place: Place,
}

impl Arguments {
    /// What was typed, as meant. All results that are missing are told at once.
    pub fn meant(self) -> Result<Figures, Error> {
        let mut problems = Problems::default();
        let plan = problems.take(Plan::embedded());
        let table = found(table(&self.out), &mut problems);
        let spent = found(spent(&self.out), &mut problems);
        let slowest = found(slowest(&self.out), &mut problems);
        let place = Place {
            out: self.out,
            check: self.check,
        };
        let figures = || {
            Some(Figures {
                plan: plan?,
                table: table?,
                spent: spent?,
                slowest: slowest?,
                place,
            })
        };
        let figures = problems.finish(figures())?;
        figures.place.prepare()?;
        Ok(figures)
    }
}

/// The result, or what is wrong with it noted.
fn found<T>(read: Result<T, CommittedError>, problems: &mut Problems) -> Option<T> {
    read.map_err(|error| problems.push(Problem::Result(error)))
        .ok()
}

impl Task for Figures {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let files = self.files();
        let results = Results {
            summary: format!("{} figures, each with its CSV", files.len() / 2),
            files,
            claims: Vec::new(),
        };
        self.place.deliver(&results)
    }
}

impl Figures {
    fn files(&self) -> Vec<File> {
        let plan = &self.plan;
        let estimator = Estimator::new(plan.system.estimator.clone());
        let mut files = Vec::new();
        files.extend(plots::throughput::files());
        let courses = SHOWN
            .into_iter()
            .filter_map(|name| course::course(plan, plan.place(name)?, 0));
        let latencies = courses.filter_map(|course| plots::latencies::files(&course));
        files.extend(latencies.flatten());
        if let Some((run, one_future)) = online(plan) {
            files.extend(plots::online::files(&run, &one_future));
        }
        files.extend(plots::sensitivity::files(&sensitivity::maps(&estimator)));
        files.extend(plots::estimates::files(&self.table));
        files.extend(plots::budget::files(&self.spent));
        files.extend(plots::per_camera::files(&self.slowest));
        files
    }
}

/// The run with the estimate beside it, and the same with one future for each actor; none where they collide.
fn online(plan: &Plan) -> Option<(Foresight, Foresight)> {
    let place = plan.place(foresight::SHOWN)?;
    let one_future = foresight::of_one_future(plan);
    let of = |plan| foresight::foresight(plan, place, 0);
    of(plan).zip(of(&one_future))
}
