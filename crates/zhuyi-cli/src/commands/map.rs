//! `zhuyi map`: the share of collisions over the frame rate and another factor.

use clap::Args;
use zhuyi_batch::shares::{Stop, Trials};
use zhuyi_batch::{Progress, Results};
use zhuyi_report::plots;
use zhuyi_studies::maps::{Map as Mapped, Mapping, csv, maps, page};

use super::choices::{self, Meant};
use super::{Task, delivery};
use crate::answer::Answer;
use crate::error::Error;
use crate::interrupt;
use crate::progress::Bar;

/// What is mapped where nothing is typed: noise, lost frames, late frames, the frames that confirm, the phase.
const DEFAULT: [&str; 5] = [
    "perception.noise_speed_mps=[0,0.05,0.1,0.2,0.5,1,2]",
    "perception.drop_rate=0:0.7:0.1",
    "perception.latency_jitter_ms=[0,50,100,200,300,500,1000]",
    "perception.confirm_frames=1:10",
    "perception.phase_shift=0:0.9:0.1",
];

/// `zhuyi map` as typed.
#[derive(Args, Debug)]
#[command(
    mut_arg("scenarios", |arg| arg.required(false).help("\
Scenarios' names (see zhuyi list) or paths of .ron files [default: all that come with the program]")),
    mut_arg("fpr", |arg| arg.default_value("1:8,10,12,15,20,30").hide_default_value(true).help("\
Frame rates in frames per second, the same on all cameras: from:to[:step] with both ends, single rates, or several of these \
[default: 1:8,10,12,15,20,30]")),
    after_help = "\
Examples:
  zhuyi map cut-out-fast --vary perception.drop_rate=0:0.5:0.1     printed alone: the MRF at each value
  zhuyi map cut-out-fast --vary perception.drop_rate=0:0.5:0.1 --vary perception.confirm_frames=1:10 --out out
  zhuyi map --out results/maps             all nine: noise, lost and late frames, K, phase; some minutes on two cores
  zhuyi map --out results/maps --check     does it make what results/maps holds?

Each --vary makes a map of its own for every scenario: in each cell all seeds are driven at a rate with a value. map.csv has every \
cell with its Wilson interval at 95 %: scenario, parameter, value, fpr, collided, drives, share, low, high. map.md has the MRF at each \
value, and PARAMETER.svg the picture. For combinations of several parameters: zhuyi sweep."
)]
pub struct Arguments {
    #[command(flatten)]
    choices: choices::Arguments,
}

/// The maps to make.
#[derive(Debug)]
pub struct Map(Meant);

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Map, Error> {
        Ok(Map(self.choices.meant("map", &DEFAULT)?))
    }
}

impl Task for Map {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let Meant {
            bench,
            choices,
            chosen,
            rates,
            seeds,
            root_seed,
            command,
            place,
        } = self.0;
        let mapping = Mapping {
            bench,
            choices,
            rates,
            trials: Trials {
                drives: seeds,
                strata: 1,
                stop: Stop::Never,
            },
            root_seed,
            command,
        };
        let maps = {
            let bar = Bar::new();
            bar.start("drives", mapping.drives());
            maps(&mapping, &chosen, &bar)
        };
        let results = results(&mapping, &maps);
        match place {
            Some(place) => place.deliver(&results),
            None => Ok(Answer::new(delivery::said(&results))),
        }
    }
}

fn results(mapping: &Mapping, maps: &[Mapped]) -> Results {
    let figures: Vec<String> = mapping
        .choices
        .iter()
        .map(|choice| format!("{}.svg", choice.path))
        .collect();
    let page = page(mapping, maps, &figures);
    let summary = page.lines().filter(|line| !line.starts_with('!'));
    let summary = summary.collect::<Vec<_>>().join("\n");
    let mut files = vec![("map.md", page), ("map.csv", csv(maps))];
    let of_choices = maps.chunks(mapping.bench.scenarios.len());
    for (name, maps) in figures.into_iter().zip(of_choices) {
        // Names of results live as long as the program; these are made up once in it.
        files.push((name.leak(), plots::maps::figure(maps)));
    }
    Results {
        files,
        claims: Vec::new(),
        summary,
    }
}
