//! `zhuyi allocate`: policies under budgets, on the same drives.

use std::path::PathBuf;

use clap::Args;
use zhuyi_report::feedback;
use zhuyi_scenario::{System, embedded};
use zhuyi_studies::allocate::{BEST_STATIC, all_policies};
use zhuyi_studies::{Allocating, Budgets, allocate};

use super::delivery::{self, Place};
use super::grid::seed_count;
use super::run::seed;
use super::{Task, policies};
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::inputs::{Inputs, Setup};
use crate::interrupt;
use crate::problems::Problems;
use crate::progress::Bar;
use crate::ranges::amounts;
use crate::shell;

/// `zhuyi allocate` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi allocate cut-out-fast --budget-fps 10:30:5 --seeds 3      a quick look, printed alone
  zhuyi allocate cut-in --policy uniform --policy \"exec:python3 -u mine.py\"
  zhuyi allocate --budget-tops 4:26:2 --out out                   frames queue for an accelerator
  zhuyi allocate --out results                                    all nine, several minutes on two cores
  zhuyi allocate --out results --check                            does it make what results/ holds?

A budget is shared between the cameras every 100 ms; all policies drive the same seeds, so that they are compared in pairs. \
`zhuyi help run` tells what each policy does; best-static is the one allocation of fixed rates that collides least in these \
very drives at a budget, found by driving many. Without --out nothing is written: what came out is printed, in short. The same \
command gives the same bytes.")]
pub struct Arguments {
    /// Scenarios' names (see zhuyi list) or paths of .ron files [default: all that come with the program]
    #[arg(value_name = "SCENARIO")]
    scenarios: Vec<String>,
    /// Budgets in frames per second over all cameras: from:to[:step], single ones, or several of these
    /// [default: 5:150:5; 150 are 30 on each of five cameras]
    #[arg(
        long,
        value_name = "BUDGETS",
        group = "budget",
        allow_hyphen_values = true
    )]
    budget_fps: Option<String>,
    /// Budgets in TOPS of an accelerator for which frames queue
    #[arg(
        long,
        value_name = "BUDGETS",
        group = "budget",
        allow_hyphen_values = true
    )]
    budget_tops: Option<String>,
    /// A policy (see zhuyi help run), best-static, or all; may be given more than once [default: all]
    #[arg(long = "policy", value_name = "POLICY")]
    policies: Vec<String>,
    /// How many random drives: seeds 0, 1, .. of zhuyi run
    #[arg(
        long,
        value_name = "COUNT",
        default_value = "10",
        allow_hyphen_values = true
    )]
    seeds: String,
    /// Root of all randomness: another one makes all seeds other drives
    #[arg(
        long,
        value_name = "N",
        default_value = "0",
        allow_hyphen_values = true
    )]
    root_seed: String,
    /// Folder for allocation.md, allocation.csv and a figure (for TOPS: allocation_tops.md and .csv); made if it is missing, and the
    /// files in it replaced; without it nothing is written
    #[arg(short, long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write nothing: compare with the files in the folder, byte for byte, and exit with 1 where one differs
    #[arg(long, requires = "out")]
    check: bool,
    #[command(flatten)]
    setup: Setup,
}

/// What to drive and what to do with the results.
#[derive(Debug)]
pub struct Allocate {
    plan: Allocating,
    place: Option<Place>,
}

impl Arguments {
    /// What was typed, as meant. The folder is tried before the drives are made.
    pub fn meant(self) -> Result<Allocate, Error> {
        let mut problems = Problems::default();
        let all: Vec<String> = embedded::names().map(String::from).collect();
        let named = if self.scenarios.is_empty() {
            &all
        } else {
            &self.scenarios
        };
        let read = Inputs::read(named, &self.setup, &mut problems);
        let budgets = self.budgets(&mut problems);
        let seeds = seed_count(Argument::new("--seeds", &self.seeds), &mut problems);
        let root_seed = seed(Argument::new("--root-seed", &self.root_seed), &mut problems);
        let policies = self.policies(read.system.as_ref(), budgets.as_ref(), &mut problems);
        let place = self.out.clone().map(|out| Place {
            out,
            check: self.check,
        });
        if let Some(place) = &place {
            place.look(&mut problems);
        }
        let command = self.command();
        let plan = || {
            Some(Allocating {
                scenarios: read.scenarios?,
                system: read.system?,
                root_seed: root_seed?,
                seeds: seeds?,
                budgets: budgets?,
                policies,
                command,
            })
        };
        let plan = plan();
        if let Some(asked) = &plan {
            let (root, seeds) = (asked.root_seed, 0..asked.seeds);
            problems.look_at_starts(&asked.scenarios, &asked.system, root, &seeds);
        }
        let plan = problems.finish(plan)?;
        if let Some(place) = &place {
            place.prepare()?;
        }
        Ok(Allocate { plan, place })
    }

    fn budgets(&self, problems: &mut Problems) -> Option<Budgets> {
        let read = |name, typed, problems: &mut Problems| {
            amounts(
                Argument::new(name, typed),
                "a budget",
                &(0.1..=1e4),
                problems,
            )
        };
        match (&self.budget_fps, &self.budget_tops) {
            (_, Some(tops)) => read("--budget-tops", tops, problems).map(Budgets::Tops),
            (fps, None) => {
                let typed = fps.as_deref().unwrap_or("5:150:5");
                read("--budget-fps", typed, problems).map(Budgets::Fps)
            }
        }
    }

    /// The policies, each once, in the order of being named.
    fn policies(
        &self,
        system: Option<&System>,
        budgets: Option<&Budgets>,
        problems: &mut Problems,
    ) -> Vec<String> {
        let mut policies: Vec<String> = Vec::new();
        let typed = self.policies.iter().map(String::as_str);
        let none = self.policies.is_empty().then_some("all");
        for name in typed.chain(none) {
            let names = if name == "all" {
                all_policies()
            } else {
                vec![name.to_string()]
            };
            for name in names {
                if policies.contains(&name) {
                    continue;
                }
                let known = name == BEST_STATIC || policies::named(&name, problems).is_some();
                if let (true, Some(system), Some(Budgets::Fps(budgets))) = (known, system, budgets)
                {
                    // Who fits the smallest fits all.
                    let smallest = budgets.first().copied().unwrap_or(1.0);
                    policies::look_at(&name, smallest, system, problems);
                }
                policies.push(name);
            }
        }
        policies
    }

    /// The command that does the same, but for where the files go.
    fn command(&self) -> String {
        let mut words = vec!["zhuyi", "allocate"];
        words.extend(self.scenarios.iter().map(String::as_str));
        for (flag, typed) in [
            ("--budget-fps", &self.budget_fps),
            ("--budget-tops", &self.budget_tops),
        ] {
            words.extend(typed.iter().flat_map(|typed| [flag, typed]));
        }
        for policy in &self.policies {
            words.extend(["--policy", policy]);
        }
        for (flag, typed, default) in [
            ("--seeds", &self.seeds, "10"),
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

impl Task for Allocate {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let allocated = allocate(&self.plan, &Bar::new())?;
        let figures = allocated.feedback.iter().map(feedback).collect();
        let results = allocated.results(&self.plan, figures);
        match &self.place {
            Some(place) => place.deliver(&results),
            None => Ok(Answer::new(delivery::said(&results))),
        }
    }
}
