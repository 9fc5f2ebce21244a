//! `zhuyi check`: everything that is wrong with any of many files.

use std::fmt::Write;

use clap::Args;
use zhuyi_scenario::{Invalid, Kind, Source, System, load};

use super::Task;
use super::sweep::plan;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::inputs::{Setup, any_source};
use crate::problems::Problems;

/// `zhuyi check` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi check my-scenario.ron
  zhuyi check scenarios/*.ron scenarios/system/*.ron scenarios/plans/*.ron
  zhuyi check --system my-car.ron my-scenario.ron   (does a longer car still fit?)")]
pub struct Arguments {
    /// Scenario files, system files and plans of sweeps
    #[arg(value_name = "FILE", required = true)]
    files: Vec<String>,
    /// The system that the scenarios are checked with [default: the built-in `default`]
    #[arg(long, value_name = "FILE")]
    system: Option<String>,
}

/// Files to check.
#[derive(Debug)]
pub struct Check {
    files: Vec<String>,
    setup: Setup,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Check {
        Check {
            files: self.files,
            setup: Setup {
                system: self.system,
                ..Setup::default()
            },
        }
    }
}

impl Task for Check {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let mut problems = Problems::default();
        let mut text = String::new();
        let system = self.setup.system_source(&mut problems);
        for file in &self.files {
            let source = any_source(Argument::new("FILE", file), &mut problems);
            let passes =
                source.is_some_and(|source| passes(&source, system.as_ref(), &mut problems));
            let verdict = if passes { "ok" } else { "not ok" };
            let _infallible = writeln!(text, "{file}: {verdict}");
        }
        Ok(match problems.finish(Some(())) {
            Ok(()) => Answer::new(text),
            Err(error) => Answer::failing(text, error),
        })
    }
}

/// Whether a file breaks no rule. What is wrong with the system is noted, but not held against a scenario.
fn passes(source: &Source, system: Option<&Source>, problems: &mut Problems) -> bool {
    match (Kind::of(source), system) {
        (Kind::System, _) => problems.take(System::read(source, &[])).is_some(),
        (Kind::Scenario, Some(system)) => {
            let read = load(source, system, &[]);
            let is_own = |invalid: &Invalid| {
                let mut violations = invalid.violations().iter();
                violations.any(|violation| violation.source_name() == source.name())
            };
            let passes = !read.as_ref().is_err_and(is_own);
            problems.take(read);
            passes
        }
        (Kind::Plan, _) => plan::passes(source, problems),
        (Kind::Scenario, None) => false,
    }
}
