//! A plan of a sweep: a file in place of the flags.

//!
//! It says what is driven and nothing else, so that a plan and the equal flags are one sweep: the same `plan.json`, the same bytes. A
//! plan that is taken over by flags would be another one than its file says, so flags that say what is driven are refused.

use std::path::Path;

use zhuyi_scenario::{Kind, Piece, Plan, Source, embedded};

use super::Asked;
use crate::argument::Argument;
use crate::commands::grid::{self, Grid, seed_count};
use crate::commands::run::seed;
use crate::inputs::{DEFAULT_SYSTEM, Inputs, Setup, is_path, scenario_source};
use crate::problems::Problems;
use crate::ranges::frame_rates;
use crate::vary;

/// The plan, if one of these names one.
pub fn named(typed: &[String]) -> Option<Source> {
    let is_scenario = |typed: &str| embedded::scenario(typed).is_some();
    let paths = typed.iter().filter(|typed| !is_scenario(typed));
    let source = |path: &String| Some(Source::new(path, std::fs::read_to_string(path).ok()?));
    paths
        .filter_map(source)
        .find(|source| Kind::of(source) == Kind::Plan)
}

/// Whether nothing is wrong with a plan, its scenarios, its system and its values; what is, is noted.
pub fn passes(source: &Source, problems: &mut Problems) -> bool {
    let before = problems.len();
    if let Some(asked) = read(source, problems) {
        asked.refuse_paths(problems);
    }
    problems.len() == before
}

/// What a plan asks for, with all that is wrong noted.
pub fn read(source: &Source, problems: &mut Problems) -> Option<Asked> {
    let (plan, sound) = zhuyi_scenario::Plan::read(source);
    let sound = problems.take(sound);
    let names: Vec<String> = plan
        .scenarios
        .iter()
        .map(|name| from_folder(source, name.text()))
        .collect();
    let inputs = inputs(source, &plan, &names, problems);
    let rates = frame_rates(or(plan.rates.as_ref(), grid::RATES), problems);
    let seeds = seed_count(or(plan.seeds.as_ref(), grid::SEEDS), problems);
    let root_seed = seed(or(plan.root_seed.as_ref(), grid::ROOT_SEED), problems);
    let varied = vary::of_plan(&plan, root_seed.unwrap_or(0), problems);
    sound?;
    let of_drives = (rates?, seeds?, root_seed?);
    let grid = Grid::new(inputs, of_drives, names.iter().map(String::as_str))?;
    let varies = plan.varied.into_iter().map(|varied| varied.first);
    Some(Asked {
        at: plan.settings.into_iter().chain(varies).collect(),
        grid,
        varied: varied?,
    })
}

/// What stands in a plan, or the default of the flag.
fn or<'a>(piece: Option<&'a Piece>, default: &'a str) -> Argument<'a> {
    piece.map_or(Argument::new("default", default), Argument::of)
}

/// The scenarios and the system of a plan; `names` call the scenarios on a command line.
fn inputs(source: &Source, plan: &Plan, names: &[String], problems: &mut Problems) -> Inputs {
    let arguments: Vec<Argument<'_>> = plan.scenarios.iter().map(Argument::of).collect();
    let named = arguments.iter().zip(names);
    let scenarios = named.map(|(argument, name)| scenario_source(*argument, name, problems));
    let scenarios = scenarios.collect();
    let system = plan.system.as_ref().map(|system| match system.text() {
        DEFAULT_SYSTEM => DEFAULT_SYSTEM.to_string(),
        path => in_folder(source, path),
    });
    let of_system = Setup {
        system: system.clone(),
        settings: Vec::new(),
    };
    let of_system = of_system.system_source(problems);
    let settings = plan.settings.clone();
    Inputs::from_texts(
        &arguments,
        scenarios,
        (system, of_system),
        settings,
        problems,
    )
}

/// A scenario as it is called from here: paths begin at the folder of the plan.
fn from_folder(plan: &Source, name: &str) -> String {
    let path = in_folder(plan, name);
    let is_path =
        embedded::scenario(name).is_none() && (is_path(name) || Path::new(&path).exists());
    if is_path { path } else { name.to_string() }
}

fn in_folder(plan: &Source, path: &str) -> String {
    let folder = Path::new(plan.name()).parent().unwrap_or(Path::new(""));
    folder.join(path).to_string_lossy().into_owned()
}
