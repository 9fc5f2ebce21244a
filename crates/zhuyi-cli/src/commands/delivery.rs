//! What `reproduce` and `robustness` have in common: rates and seeds, and results that are written or compared. The latter,
//! a [`Place`], `compare` has as well.

use std::path::PathBuf;

use clap::Args;
use zhuyi_batch::{Progress, Results, prepare};
use zhuyi_studies::Plan;

use super::grid::seed_count;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::interrupt;
use crate::problems::{Problem, Problems};
use crate::progress::Bar;
use crate::ranges::frame_rates;

/// Where to and how much, as typed.
#[derive(Args, Debug)]
#[group(skip)]
pub struct Arguments {
    /// Folder for the results; made if it is missing, and the files in it replaced
    #[arg(short, long, value_name = "DIR", default_value = "results")]
    out: PathBuf,
    /// Write nothing: compare with the files in the folder, byte for byte, and exit with 1 where one differs
    #[arg(long)]
    check: bool,
    /// Frame rates in frames per second, the same on all cameras: from:to[:step] with both ends, single
    /// rates, or several of these [default: 1:30, as in the paper]
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    fpr: Option<String>,
    /// How many random drives per rate [default: 10, as in the paper]
    #[arg(long, value_name = "COUNT", allow_hyphen_values = true)]
    seeds: Option<String>,
}

/// A plan and what to do with its results.
#[derive(Debug)]
pub struct Delivery {
    plan: Plan,
    place: Place,
}

/// Where results go, or lie to be compared.
#[derive(Debug)]
pub struct Place {
    /// The folder.
    pub out: PathBuf,
    /// Whether to compare and write nothing.
    pub check: bool,
}

impl Arguments {
    /// What was typed, as meant. The folder is tried before the runs are made.
    pub fn meant(self) -> Result<Delivery, Error> {
        let mut problems = Problems::default();
        let plan = problems.take(Plan::embedded());
        let rates = self
            .fpr
            .as_deref()
            .map(|typed| frame_rates(Argument::new("--fpr", typed), &mut problems));
        let seeds = self
            .seeds
            .as_deref()
            .map(|typed| seed_count(Argument::new("--seeds", typed), &mut problems));
        let place = Place {
            out: self.out,
            check: self.check,
        };
        place.look(&mut problems);
        let mut plan = problems.finish(plan)?;
        plan.rates = rates.flatten().unwrap_or(plan.rates);
        plan.seeds = seeds.flatten().unwrap_or(plan.seeds);
        place.prepare()?;
        Ok(Delivery { plan, place })
    }
}

impl Delivery {
    /// Makes the results and writes or compares them.
    pub fn run(&self, make: impl Fn(&Plan, &dyn Progress) -> Results) -> Result<Answer, Error> {
        interrupt::listen()?;
        self.place.deliver(&make(&self.plan, &Bar::new()))
    }
}

impl Place {
    /// Notes it where there is nothing to compare with.
    pub fn look(&self, problems: &mut Problems) {
        if self.check
            && let Err(source) = self.out.read_dir()
        {
            problems.push(Problem::Read {
                path: self.out.clone(),
                source,
            });
        }
    }

    /// Proves before a long run that files can be written here, if they will be.
    pub fn prepare(&self) -> Result<(), Error> {
        if !self.check {
            prepare(&self.out)?;
        }
        Ok(())
    }

    /// Writes or compares.
    pub fn deliver(&self, results: &Results) -> Result<Answer, Error> {
        if self.check {
            self.compare(results)
        } else {
            self.write(results)
        }
    }

    fn write(&self, results: &Results) -> Result<Answer, Error> {
        let written = {
            let _whole = interrupt::writing();
            results.write(&self.out)
        };
        written?;
        let files = results.files.iter().map(|(name, _)| self.out.join(name));
        let files: Vec<String> = files.map(|path| path.display().to_string()).collect();
        Ok(Answer::new(told(
            results,
            &format!("Wrote {}", files.join(", ")),
        )))
    }

    fn compare(&self, results: &Results) -> Result<Answer, Error> {
        let differences = results.check(&self.out)?;
        let out = self.out.display();
        if differences.is_empty() {
            let count = results.files.len();
            let verdict = format!("All {count} files in {out} are reproduced.");
            return Ok(Answer::new(told(results, &verdict)));
        }
        let lines: Vec<String> = differences.iter().map(|one| format!("\n  {one}")).collect();
        let unmet = format!("not reproduced in {out}:{}", lines.concat());
        let verdict = format!("{} files in {out} are not reproduced.", differences.len());
        Ok(Answer::failing(
            told(results, &verdict),
            Error::Unmet(unmet),
        ))
    }
}

/// What a command says that leaves no files.
pub fn said(results: &Results) -> String {
    format!("{}\n", results.summary.trim_end())
}

/// What a command says, and what became of its files.
fn told(results: &Results, verdict: &str) -> String {
    format!("{}\n{verdict}\n", said(results))
}
