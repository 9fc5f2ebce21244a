//! Maps of two factors: the frame rate and another choice, and in each cell the share of drives that collide.
//!
//! Every cell has the same seeds, so that cells compare in pairs: what differs is the rate and the choice alone. Intervals are
//! Wilson's at 95 %, each cell's by itself. Left out: combinations of two choices, which `zhuyi sweep` makes.

use std::fmt::Write as _;

use zhuyi_scenario::Source;

use zhuyi_batch::choice::{Bench, Choice, Chosen};
use zhuyi_batch::manoeuvres::{self, never};
use zhuyi_batch::progress::Progress;
use zhuyi_batch::shares::{Confident, Share, Trials, began};
use zhuyi_batch::sweep::Experiment;
use zhuyi_batch::text::{cells, csv_row, markdown_table};

/// What is mapped.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// The scenarios and the system.
    pub bench: Bench,
    /// One map of each scenario for each.
    pub choices: Vec<Choice>,
    /// [Hz] rates of all cameras, ascending.
    pub rates: Vec<u32>,
    /// The drives of each cell.
    pub trials: Trials,
    /// The root of all randomness.
    pub root_seed: u64,
    /// The command that makes the maps.
    pub command: String,
}

/// A scenario at every value of a choice and every rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The scenario's name.
    pub scenario: String,
    /// The manoeuvres that began in no drive of it, as [`manoeuvres::names`].
    pub never: Vec<String>,
    /// The choice.
    pub path: String,
    /// In the order of its values.
    pub rows: Vec<Row>,
}

/// A row of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The value, as typed.
    pub value: String,
    /// A cell for each rate.
    pub shares: Vec<Share>,
}

impl Row {
    /// The minimum required rate there, and what is odd about it.
    pub fn confident(&self, at_most: f64) -> Confident {
        Confident::of(&self.shares, at_most)
    }
}

impl Mapping {
    /// How many drives there are.
    pub fn drives(&self) -> u64 {
        let values = self.choices.iter().map(|choice| choice.values.len());
        let rows = values.sum::<usize>() * self.bench.scenarios.len();
        (rows * self.rates.len()) as u64 * self.trials.drives
    }
}

/// Drives through all cells of what [`Bench::choose_all`] gave; the maps of a choice stand together.
pub fn maps(mapping: &Mapping, chosen: &[Vec<Chosen>], progress: &dyn Progress) -> Vec<Map> {
    let places = mapping.choices.iter().flat_map(|choice| {
        mapping
            .bench
            .scenarios
            .iter()
            .map(move |source| (choice, source))
    });
    let map = |((choice, source), chosen): ((&Choice, &Source), &Vec<Chosen>)| {
        let row = |(value, (scenario, system)): (&String, &Chosen)| {
            let experiment = Experiment {
                scenarios: std::slice::from_ref(scenario),
                system,
                root_seed: mapping.root_seed,
            };
            let shares = mapping.trials.shares(&experiment, &mapping.rates, progress);
            Row {
                value: value.clone(),
                shares: shares.into_iter().next().unwrap_or_default(),
            }
        };
        let rows: Vec<Row> = choice.values.iter().zip(chosen).map(row).collect();
        let began = began(rows.iter().flat_map(|row| &row.shares));
        let never = chosen.first().map(|(scenario, _)| never(scenario, &began));
        Map {
            scenario: source.stem().to_string(),
            never: never.unwrap_or_default(),
            path: choice.path.clone(),
            rows,
        }
    };
    places.zip(chosen).map(map).collect()
}

/// All cells of all maps, as CSV.
pub fn csv(maps: &[Map]) -> String {
    let header = "scenario,parameter,value,fpr,collided,drives,share,low,high\n".to_string();
    let rows = maps.iter().flat_map(|map| {
        map.rows.iter().flat_map(move |row| {
            row.shares.iter().map(move |share| {
                let (low, high) = share.interval;
                csv_row([
                    map.scenario.as_str(),
                    &map.path,
                    &row.value,
                    &share.rate.to_string(),
                    &share.collided.to_string(),
                    &share.drives.to_string(),
                    &format!("{:.4}", share.share()),
                    &format!("{low:.4}"),
                    &format!("{high:.4}"),
                ])
            })
        })
    });
    header + &rows.collect::<String>()
}

/// The page: for each choice a table of MRFs, a row per scenario. `figures` names the picture of each choice.
pub fn page(mapping: &Mapping, maps: &[Map], figures: &[String]) -> String {
    let Mapping {
        trials,
        root_seed,
        command,
        ..
    } = mapping;
    let phases = match trials.strata {
        1 => String::new(),
        strata => format!(", phases of the cameras spread over {strata} parts of their period"),
    };
    let mut text = format!(
        "# The frame rate and another factor\n\n\
         Written by `{command}`: {} drives per cell, root seed {root_seed}{phases}. All cells: map.csv.\n\n\
         MRF by the value of the factor: the smallest rate at which, and at every higher tested one, no drive collides. Behind it, \
         where it is not the same, its 95 % range: where it may lie when a chance of a collision of {:.3} is allowed, which is what so \
         many drives can show. †: some rate below it has no collision either. ‡: a higher rate is shown to collide more often than a \
         lower one.\n",
        trials.drives,
        trials.resolution(),
    );
    let of_choices = maps.chunks(mapping.bench.scenarios.len().max(1));
    for ((choice, maps), figure) in mapping.choices.iter().zip(of_choices).zip(figures) {
        let path = &choice.path;
        let _ = write!(
            text,
            "\n## {path}\n\n![collisions by rate and {path}]({figure})\n\n"
        );
        let mut header = cells(&["scenario"]);
        header.extend(choice.values.iter().cloned());
        let rows: Vec<Vec<String>> = maps.iter().map(|map| line(mapping, map)).collect();
        text += &markdown_table(&header, &rows);
        for map in maps {
            let never = map.never.iter().map(String::as_str);
            if let Some(note) = manoeuvres::note(&map.scenario, never) {
                let _ = writeln!(text, "\n{note}");
            }
        }
    }
    text
}

fn line(mapping: &Mapping, map: &Map) -> Vec<String> {
    let cell = |row: &Row| {
        let found = row.confident(mapping.trials.resolution());
        let mrf = found.required.mrf.to_string();
        let range = found.range(&mapping.rates);
        let range = if range == mrf {
            String::new()
        } else {
            format!(" ({range})")
        };
        let dagger = if found.required.safe_below.is_empty() {
            ""
        } else {
            "†"
        };
        let rising = if found.rising.is_empty() { "" } else { "‡" };
        format!("{mrf}{dagger}{rising}{range}")
    };
    let name = map.scenario.clone();
    [name]
        .into_iter()
        .chain(map.rows.iter().map(cell))
        .collect()
}
