//! `zhuyi show`: a scenario or a system with nothing left to defaults; above a scenario its start and what it asks for.

use clap::Args;
use zhuyi_scenario::{Kind, Scenario, Source, System};
use zhuyi_sim::RunSpec;

use super::Task;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::inputs::{Inputs, Setup, any_source};
use crate::problems::Problems;
use crate::sparkline;
use crate::top_view::top_view;

/// Columns of the top view.
const WIDTH: usize = 100;

/// `zhuyi show` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi show cut-in
  zhuyi show cut-out-fast --set planner.time_headway_s=1.5   (the lead's steady gap follows)
  zhuyi show default                                         (the built-in system)
  zhuyi show my-scenario.ron > resolved.ron")]
pub struct Arguments {
    /// A scenario's name (see zhuyi list), `default` for the built-in system, or the path of a .ron file
    #[arg(value_name = "SCENARIO")]
    shown: String,
    #[command(flatten)]
    setup: Setup,
}

/// What to show.
#[derive(Debug)]
pub enum Show {
    /// A scenario and the system that gives it the ego's box and steady gap.
    Scenario(Box<Scenario>, Box<System>),
    /// A system.
    System(Box<System>),
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Show, Error> {
        let mut problems = Problems::default();
        let source = any_source(Argument::new("SCENARIO", &self.shown), &mut problems);
        let show = source.and_then(|source| match Kind::of(&source) {
            Kind::System => self.system(&source, &mut problems),
            Kind::Scenario => self.scenario(&mut problems),
            Kind::Plan => {
                let argument = Argument::new("SCENARIO", &self.shown);
                let fault = Fault::IsPlan(self.shown.clone());
                argument.refuse(&argument.all(), fault, &mut problems);
                None
            }
        });
        problems.finish(show)
    }

    fn system(&self, source: &Source, problems: &mut Problems) -> Option<Show> {
        let settings = self.setup.settings(problems);
        let system = problems.take(System::read(source, &settings))?;
        Some(Show::System(Box::new(system)))
    }

    fn scenario(&self, problems: &mut Problems) -> Option<Show> {
        let read = Inputs::read(std::slice::from_ref(&self.shown), &self.setup, problems);
        let scenario = read.scenarios?.pop()?;
        Some(Show::Scenario(Box::new(scenario), Box::new(read.system?)))
    }
}

impl Task for Show {
    /// The file, with the drawing as a comment above it: what is printed is a scenario file again.
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let text = match *self {
            Self::System(system) => system.to_ron(),
            Self::Scenario(scenario, system) => {
                let view = top_view(&scenario, &system, WIDTH) + "\n" + &asked(&scenario, &system);
                let comment: String = view
                    .lines()
                    .map(|line| format!("// {line}").trim_end().to_string() + "\n")
                    .collect();
                format!("{comment}{}", scenario.to_ron())
            }
        };
        Ok(Answer::new(text))
    }
}

/// What the drive of seed 0 asks of every camera, at the rates of the system file.
fn asked(scenario: &Scenario, system: &System) -> String {
    let rates = &system.default_rates;
    let run = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates.clone())
        .run_fixed();
    let ends = if run.collided() {
        ", up to its collision"
    } else {
        ""
    };
    let drawn = sparkline::demands(&run.trace, &scenario.road, system, rates, WIDTH - 20);
    format!("Demand on each camera in the drive of zhuyi run, seed 0{ends}:\n{drawn}")
}
