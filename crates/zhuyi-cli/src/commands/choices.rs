//! What `map` and `boundary` have in common: scenarios, choices of which one is made at a time, and where results go.

use std::path::PathBuf;

use clap::Args;
use zhuyi_batch::choice::{Bench, Choice, Chosen, Refusal, Refused};
use zhuyi_scenario::embedded;

use super::delivery::Place;
use super::grid;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::problems::Problems;
use crate::shell;
use crate::vary::choices;

/// Scenarios, choices and a place, as typed.
#[derive(Args, Clone, Debug)]
#[group(skip)]
pub struct Arguments {
    #[command(flatten)]
    pub grid: grid::Arguments,
    /// A value of the scenario or the system file with those that it is to have: from:to[:step] with both ends or [a,b,..]; or
    /// distances=from:to[:step] (a factor), or second_front_camera=[true,false]; may be given more than once: one at a time
    #[arg(long, value_name = "PATH=VALUES", allow_hyphen_values = true)]
    vary: Vec<String>,
    /// Folder for the files; made if it is missing, and those in it replaced; without it nothing is written
    #[arg(short, long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write nothing: compare with the files in the folder, byte for byte, and exit with 1 where one differs
    #[arg(long, requires = "out")]
    check: bool,
}

/// Scenarios, choices and a place, as meant.
#[derive(Debug)]
pub struct Meant {
    pub bench: Bench,
    pub choices: Vec<Choice>,
    /// For each choice, of each scenario, each value.
    pub chosen: Vec<Vec<Chosen>>,
    /// [Hz] ascending.
    pub rates: Vec<u32>,
    pub seeds: u64,
    pub root_seed: u64,
    /// The command that does the same, but for where the files go.
    pub command: String,
    pub place: Option<Place>,
}

impl Arguments {
    /// What was typed, as meant; `default` are the choices where none is typed. The folder is tried before the drives are made.
    pub fn meant(mut self, command: &'static str, default: &[&str]) -> Result<Meant, Error> {
        let command = self.command(command);
        if self.grid.scenarios.is_empty() {
            self.grid.scenarios = embedded::names().map(String::from).collect();
        }
        if self.vary.is_empty() {
            self.vary = default.iter().map(ToString::to_string).collect();
        }
        let mut problems = Problems::default();
        let read = self.grid.read(&mut problems);
        let choices = choices(&self.vary, &mut problems);
        let place = self.out.clone().map(|out| Place {
            out,
            check: self.check,
        });
        if let Some(place) = &place {
            place.look(&mut problems);
        }
        let read = problems.finish(read.zip(choices))?;
        let (grid, choices) = read;
        let bench = Bench {
            scenarios: grid.texts.scenarios,
            system: grid.texts.system,
            settings: grid.texts.settings,
        };
        let mut problems = Problems::default();
        let chosen = match bench.choose_all(&choices) {
            Ok(chosen) => Some(chosen),
            Err(refused) => {
                for one in refused {
                    self.refuse(one, &mut problems);
                }
                None
            }
        };
        for (scenario, system) in chosen.iter().flatten().flatten() {
            let scenario = std::slice::from_ref(scenario);
            problems.look_at_starts(scenario, system, grid.root_seed, &(0..grid.seeds));
        }
        let chosen = problems.finish(chosen)?;
        if let Some(place) = &place {
            place.prepare()?;
        }
        Ok(Meant {
            bench,
            choices,
            chosen,
            rates: grid.rates,
            seeds: grid.seeds,
            root_seed: grid.root_seed,
            command,
            place,
        })
    }

    /// Notes why a value cannot be chosen.
    fn refuse(&self, Refusal { path, value, why }: Refusal, problems: &mut Problems) {
        let wanted = match why {
            Refused::Value(wanted) => wanted,
            Refused::Reader(invalid) => {
                problems.take::<()>(Err(invalid));
                return;
            }
        };
        let typed = self.vary.iter().find(|typed| typed.starts_with(&path));
        let argument = Argument::new("--vary", typed.map_or("", String::as_str));
        let fault = Fault::Choice {
            path,
            wanted,
            got: value,
        };
        argument.refuse(&argument.all(), fault, problems);
    }

    fn command(&self, command: &'static str) -> String {
        let mut words = vec!["zhuyi", command];
        words.extend(self.grid.scenarios.iter().map(String::as_str));
        words.extend(self.vary.iter().flat_map(|typed| ["--vary", typed]));
        words.extend(self.grid.words());
        shell::line(words)
    }
}
