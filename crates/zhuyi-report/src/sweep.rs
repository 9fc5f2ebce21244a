//! Many runs as the data of a report: outcome by rate and seed, MRF, and the worst runs with their replays.
//!
//! ```text
//!  runs.csv ──[table]──▶ Table ──▶ Sweep ── Document ──▶ page
//!                                    ▲ drives: the worst runs, made again from the commands in the table
//! ```
//!
//! Of each scenario the worst are: the collision at the highest rate, of several the one with the largest impact speed; the
//! collision with the largest impact speed of all; and where nothing collided, the run with the smallest gap.

pub mod table;

use serde::Serialize;
use zhuyi_batch::mrf::{Required, required};

use crate::drive::document::Document as Drive;
use table::{Row, Table};

/// Seeds up to which every run is shown, and not only how many collided.
const MOST_SEEDS: usize = 60;

/// The data of a report on many runs.
#[derive(Debug, Serialize)]
pub struct Document {
    /// What kind of report: `sweep`.
    pub kind: &'static str,
    /// Version of this structure.
    pub schema: u32,
    /// Version of the program.
    pub version: String,
    /// The command that makes this file again.
    pub command: String,
    /// Runs of the table that are shown, and those that are not of the grid.
    pub runs: usize,
    /// The latter.
    pub others: usize,
    /// In the order of the table.
    pub scenarios: Vec<Scenario>,
    /// The worst runs.
    pub drives: Vec<Shown>,
}

/// The runs of one scenario.
#[derive(Debug, Serialize)]
pub struct Scenario {
    /// Its name.
    pub name: String,
    /// The minimum required rate, as text: `6`, `>30`, `<=4`.
    pub mrf: String,
    /// Rates below it at which nothing collided.
    pub safe_below: Vec<u32>,
    /// Number of seeds.
    pub seeds: usize,
    /// By rising rate.
    pub rates: Vec<Rate>,
}

/// The runs at one rate.
#[derive(Debug, Serialize)]
pub struct Rate {
    /// [Hz] the rate.
    pub fpr: u32,
    /// How many runs there are.
    pub runs: usize,
    /// How many collided.
    pub collided: usize,
    /// [FPR] mean of the largest demands, where no run collided.
    pub estimate_fpr: Option<f64>,
    /// [m] smallest gap of those that did not collide.
    pub smallest_gap_m: Option<f64>,
    /// [m/s] largest impact speed.
    pub largest_impact_mps: Option<f64>,
    /// Every run, by seed; empty where there are too many to show.
    pub cells: Vec<Cell>,
}

/// One run.
#[derive(Debug, Serialize)]
pub struct Cell {
    /// Which of the random drives.
    pub seed: u64,
    /// What happened.
    pub told: String,
    /// Whether it collided.
    pub collided: bool,
    /// [m/s] impact speed.
    pub impact_mps: Option<f64>,
    /// The place among the replays.
    pub drive: Option<usize>,
}

/// A run with its replay.
#[derive(Debug, Serialize)]
pub struct Shown {
    /// Its scenario.
    pub scenario: String,
    /// [Hz] its rate.
    pub fpr: u32,
    /// Its seed.
    pub seed: u64,
    /// Why it is shown.
    pub why: &'static str,
    /// What happened.
    pub told: String,
    /// The command that makes it again.
    pub command: String,
    /// Its replay; none where the command could not be run.
    pub document: Option<Drive>,
    /// Why there is none, or what differs from the table.
    pub note: Option<String>,
}

/// A run that is worth its replay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst<'a> {
    /// The run.
    pub row: &'a Row,
    /// Why.
    pub why: &'static str,
}

impl Worst<'_> {
    /// The run with its replay, or with what is to be said of it.
    pub fn shown(&self, document: Option<Drive>, note: Option<String>) -> Shown {
        Shown {
            scenario: self.row.scenario.clone(),
            fpr: self.row.fpr,
            seed: self.row.seed,
            why: self.why,
            told: told(self.row),
            command: self.row.replay.clone(),
            document,
            note,
        }
    }
}

/// The worst runs of a table, scenario by scenario.
pub fn worst(table: &Table) -> Vec<Worst<'_>> {
    let mut all = Vec::new();
    for name in names(table) {
        let rows: Vec<&Row> = table
            .rows
            .iter()
            .filter(|row| row.scenario == name)
            .collect();
        let impact = |row: &Row| {
            let contact = row.collision.as_ref();
            contact.and_then(|contact| contact.impact).unwrap_or(0.0)
        };
        let collisions = || rows.iter().copied().filter(|row| row.collision.is_some());
        // Of equals the first: `max_by` takes the last.
        let highest = collisions().rev().max_by(|one, other| {
            let rates = one.fpr.cmp(&other.fpr);
            rates.then(impact(one).total_cmp(&impact(other)))
        });
        let hardest = collisions()
            .rev()
            .max_by(|one, other| impact(one).total_cmp(&impact(other)));
        let nearest = rows.iter().copied().filter(|row| row.gap.is_some());
        let nearest = nearest.min_by(|one, other| {
            let gap = |row: &Row| row.gap.unwrap_or(f64::INFINITY);
            gap(one).total_cmp(&gap(other))
        });
        let found = match (highest, hardest) {
            (Some(highest), hardest) => {
                let hardest = hardest.filter(|row| *row != highest);
                [
                    Some((highest, "the collision at the highest rate")),
                    hardest.map(|row| (row, "the hardest impact")),
                ]
            }
            (None, _) => [nearest.map(|row| (row, "the smallest gap")), None],
        };
        let found = found.into_iter().flatten();
        all.extend(found.map(|(row, why)| Worst { row, why }));
    }
    all
}

/// The data of a report on a table, with the worst runs as they were made again.
pub fn document(table: &Table, drives: Vec<Shown>, version: &str, command: String) -> Document {
    Document {
        kind: "sweep",
        schema: 1,
        version: version.to_string(),
        command,
        runs: table.rows.len(),
        others: table.others,
        scenarios: names(table)
            .into_iter()
            .map(|name| scenario(table, name, &drives))
            .collect(),
        drives,
    }
}

fn scenario(table: &Table, name: &str, drives: &[Shown]) -> Scenario {
    let rows: Vec<&Row> = table
        .rows
        .iter()
        .filter(|row| row.scenario == name)
        .collect();
    let mut fprs: Vec<u32> = rows.iter().map(|row| row.fpr).collect();
    fprs.sort_unstable();
    fprs.dedup();
    let mut seeds: Vec<u64> = rows.iter().map(|row| row.seed).collect();
    seeds.sort_unstable();
    seeds.dedup();
    let rates: Vec<Rate> = fprs
        .iter()
        .map(|fpr| {
            let rows = rows.iter().copied().filter(|row| row.fpr == *fpr);
            rate(*fpr, rows.collect(), drives, seeds.len() <= MOST_SEEDS)
        })
        .collect();
    let collisions: Vec<(u32, u32)> = rates
        .iter()
        .map(|rate| (rate.fpr, rate.collided as u32))
        .collect();
    let Required { mrf, safe_below } = required(&collisions);
    Scenario {
        name: name.to_string(),
        mrf: mrf.to_string(),
        safe_below,
        seeds: seeds.len(),
        rates,
    }
}

fn rate(fpr: u32, mut rows: Vec<&Row>, drives: &[Shown], every: bool) -> Rate {
    rows.sort_by_key(|row| row.seed);
    let collided = rows.iter().filter(|row| row.collision.is_some()).count();
    let estimates: Vec<f64> = rows.iter().filter_map(|row| row.estimate).collect();
    let whole = collided == 0 && estimates.len() == rows.len();
    let gaps = rows.iter().filter(|row| row.collision.is_none());
    let impacts = rows.iter().filter_map(|row| row.collision.as_ref());
    let cell = |row: &&Row| Cell {
        seed: row.seed,
        told: told(row),
        collided: row.collision.is_some(),
        impact_mps: row.collision.as_ref().and_then(|contact| contact.impact),
        drive: drives.iter().position(|shown| {
            shown.document.is_some()
                && (shown.scenario.as_str(), shown.fpr, shown.seed)
                    == (row.scenario.as_str(), row.fpr, row.seed)
        }),
    };
    Rate {
        fpr,
        runs: rows.len(),
        collided,
        estimate_fpr: whole.then(|| estimates.iter().sum::<f64>() / estimates.len() as f64),
        smallest_gap_m: gaps.filter_map(|row| row.gap).min_by(f64::total_cmp),
        largest_impact_mps: impacts
            .filter_map(|contact| contact.impact)
            .max_by(f64::total_cmp),
        cells: if every {
            rows.iter().map(cell).collect()
        } else {
            Vec::new()
        },
    }
}

/// What happened in a run, in words.
fn told(row: &Row) -> String {
    match &row.collision {
        Some(contact) => {
            let impact = match contact.impact {
                Some(impact) => format!(" at {impact:.1} m/s"),
                None => String::new(),
            };
            format!(
                "touched {} after {:.2} s{impact}",
                contact.actor, contact.time
            )
        }
        None => match row.gap {
            Some(gap) => format!("no collision, smallest gap {gap:.2} m"),
            None => "no collision, nobody ahead".to_string(),
        },
    }
}

/// The scenarios, in the order of the table.
fn names(table: &Table) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for row in &table.rows {
        if !names.contains(&row.scenario.as_str()) {
            names.push(&row.scenario);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::table::{Contact, Row, Table};
    use super::{document, worst};

    fn row(fpr: u32, seed: u64, impact: Option<f64>, gap: f64) -> Row {
        Row {
            scenario: "cut-in".into(),
            fpr,
            seed,
            collision: impact.map(|impact| Contact {
                time: 5.0,
                actor: "cutter".into(),
                impact: Some(impact),
            }),
            gap: Some(gap),
            ttc: None,
            estimate: Some(4.0 + seed as f64),
            replay: format!("zhuyi run cut-in --fpr {fpr} --seed {seed}"),
        }
    }

    #[test]
    fn hand_the_worst_are_the_highest_rate_and_the_hardest_impact_or_else_the_nearest() {
        let mut table = Table {
            rows: vec![
                row(1, 0, Some(9.0), 0.0),
                row(1, 1, Some(8.0), 0.0),
                row(2, 0, Some(2.0), 0.0),
                row(2, 1, Some(3.0), 0.0),
                row(3, 0, None, 1.5),
                row(3, 1, None, 0.5),
            ],
            others: 0,
        };
        let found = |table: &Table| -> Vec<(u32, u64, &str)> {
            let worst = worst(table).into_iter();
            worst
                .map(|worst| (worst.row.fpr, worst.row.seed, worst.why))
                .collect()
        };
        let wanted = [
            (2, 1, "the collision at the highest rate"),
            (1, 0, "the hardest impact"),
        ];
        assert_eq!(found(&table), wanted);
        let shown = document(&table, Vec::new(), "1", String::new());
        let scenario = &shown.scenarios[0];
        assert_eq!((scenario.mrf.as_str(), scenario.seeds), ("3", 2));
        let collided: Vec<usize> = scenario.rates.iter().map(|rate| rate.collided).collect();
        assert_eq!(collided, [2, 2, 0]);
        assert_eq!(scenario.rates[2].estimate_fpr, Some(4.5));
        assert_eq!(scenario.rates[2].smallest_gap_m, Some(0.5));
        assert_eq!(scenario.rates[0].estimate_fpr, None);
        table.rows.drain(..4);
        assert_eq!(found(&table), [(3, 1, "the smallest gap")]);
    }
}
