//! `zhuyi mrf --per-camera`: a rate of its own for each camera.

use std::path::PathBuf;

use clap::Args;
use zhuyi_scenario::{did_you_mean, embedded};
use zhuyi_studies::per_camera::{Combinations, PerCamera, analysed, per_camera};

use crate::answer::Answer;
use crate::argument::Argument;
use crate::commands::delivery::{self, Place};
use crate::commands::grid;
use crate::error::Error;
use crate::fault::Fault;
use crate::interrupt;
use crate::problems::Problems;
use crate::progress::Bar;
use crate::shell;

/// What concerns a rate of its own for each camera, as typed.
#[derive(Args, Debug)]
#[group(skip)]
pub struct Arguments {
    /// Let the cameras differ: which combinations of rates are enough, and can no camera be slowed any more? Without a
    /// SCENARIO: all that come with the program
    #[arg(long)]
    per_camera: bool,
    /// Try every combination of this scenario as well, and tell whether the search agrees
    #[arg(long, value_name = "SCENARIO", requires = "per_camera")]
    brute_force: Option<String>,
    /// Folder for mrf_per_camera.md and mrf_per_camera.csv; made if it is missing, and the files in it replaced; without it
    /// nothing is written
    #[arg(short, long, value_name = "DIR", requires = "per_camera")]
    out: Option<PathBuf>,
    /// Write nothing: compare with the files in the folder, byte for byte, and exit with 1 where one differs
    #[arg(long, requires = "out")]
    check: bool,
}

/// What to search and what to do with the results.
#[derive(Debug)]
pub struct Search {
    plan: PerCamera,
    place: Option<Place>,
}

impl Arguments {
    /// Whether the cameras may differ.
    pub fn is_asked_for(&self) -> bool {
        self.per_camera
    }

    /// What was typed, as meant. The folder is tried before the drives are made.
    pub fn meant(self, mut grid: grid::Arguments) -> Result<Search, Error> {
        let command = self.command(&grid);
        if grid.scenarios.is_empty() {
            grid.scenarios = embedded::names().map(String::from).collect();
        }
        let mut problems = Problems::default();
        let read = grid.read(&mut problems);
        if let Some(read) = &read {
            read.look_at_starts(read.seeds, &mut problems);
        }
        let brute_force = self.brute_force(&grid.scenarios, &mut problems);
        let combinations = read
            .as_ref()
            .and_then(|read| combinations(&grid, read, &mut problems));
        let place = self.out.map(|out| Place {
            out,
            check: self.check,
        });
        if let Some(place) = &place {
            place.look(&mut problems);
        }
        let plan = || {
            let read = read?;
            Some(PerCamera {
                combinations: combinations?,
                seeds: read.seeds,
                root_seed: read.root_seed,
                brute_force,
                typed: read.typed,
                command,
                scenarios: read.scenarios,
                system: read.system,
            })
        };
        let plan = problems.finish(plan())?;
        if let Some(place) = &place {
            place.prepare()?;
        }
        Ok(Search { plan, place })
    }

    /// The place of the scenario of which every combination is wanted, if one is and it is among those searched.
    fn brute_force(&self, scenarios: &[String], problems: &mut Problems) -> Option<usize> {
        let typed = self.brute_force.as_ref()?;
        let place = scenarios.iter().position(|scenario| scenario == typed);
        if place.is_none() {
            let names = || scenarios.iter().map(String::as_str);
            let nearest = did_you_mean(typed, names())
                .map_or(String::new(), |name| format!("did you mean `{name}`? "));
            let searched: Vec<&str> = names().collect();
            let fault = Fault::Unknown {
                what: "scenario among those searched",
                got: typed.clone(),
                hint: format!("{nearest}searched: {}", searched.join(", ")),
            };
            let argument = Argument::new("--brute-force", typed);
            argument.refuse(&argument.all(), fault, problems);
        }
        place
    }

    /// The command that does the same, but for where the files go.
    fn command(&self, grid: &grid::Arguments) -> String {
        let mut words = vec!["zhuyi", "mrf", "--per-camera"];
        words.extend(grid.scenarios.iter().map(String::as_str));
        if let Some(scenario) = &self.brute_force {
            words.extend(["--brute-force", scenario]);
        }
        words.extend(grid.words());
        shell::line(words)
    }
}

/// All combinations, if there are not too many.
fn combinations(
    typed: &grid::Arguments,
    read: &grid::Grid,
    problems: &mut Problems,
) -> Option<Combinations> {
    let cameras = analysed(&read.system).count();
    let all = Combinations::new(&read.rates, cameras);
    if all.is_none() {
        let fault = Fault::ManyCombinations {
            rates: read.rates.len(),
            cameras,
            most: Combinations::MOST,
        };
        let argument = typed.fpr();
        argument.refuse(&argument.all(), fault, problems);
    }
    all
}

impl Search {
    /// Makes the drives, and writes, compares or tells what came out; Ctrl-C ends it.
    pub fn run(&self) -> Result<Answer, Error> {
        interrupt::listen()?;
        let results = per_camera(&self.plan, &Bar::new());
        match &self.place {
            Some(place) => place.deliver(&results),
            None => Ok(Answer::new(delivery::said(&results))),
        }
    }
}
