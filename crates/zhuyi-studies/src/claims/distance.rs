//! Claim 4, a figure only: how far the estimates are from the paper's, beside two baselines that know nothing of any scenario's
//! physics: the constant 5, and the best constant per scenario, which is the median of the paper's own row.

use std::fmt::Write as _;

use super::{Claim, Verdict};
use crate::reproduce::paper;
use crate::reproduce::table::{Row, Table};
use zhuyi_batch::estimators::{PAPER, TABLE, VARIANTS};
use zhuyi_batch::statistics::{mean, mean_absolute_difference, median, rank_correlation};
use zhuyi_batch::text::{cells, markdown_table, spans};

/// [FPR] the first baseline.
const CONSTANT: f64 = 5.0;

/// The cells in common with the paper, by scenario: something of ours and the paper's.
struct Distance {
    scenarios: Vec<Vec<(f64, f64)>>,
}

impl Distance {
    fn of<'a>(
        rows: impl Iterator<Item = &'a Row>,
        ours: impl Fn(&Row, u32) -> Option<f64>,
    ) -> Self {
        let of_row = |row: &Row| {
            let cell = |rate: u32| ours(row, rate).zip(row.paper.as_ref()?.estimate(rate));
            paper::RATES.into_iter().filter_map(cell).collect()
        };
        Self {
            scenarios: rows.map(of_row).collect(),
        }
    }

    fn cells(&self) -> usize {
        self.scenarios.iter().map(Vec::len).sum()
    }

    /// [FPR] over all cells.
    fn mean_difference(&self) -> Option<f64> {
        mean_absolute_difference(&self.scenarios.concat())
    }

    /// Spearman's, over the scenarios, of the mean of each row's common cells.
    fn rank_correlation(&self) -> Option<f64> {
        let mean_of = |row: &Vec<(f64, f64)>| {
            let (ours, paper): (Vec<f64>, Vec<f64>) = row.iter().copied().unzip();
            mean(&ours).zip(mean(&paper))
        };
        rank_correlation(
            &self
                .scenarios
                .iter()
                .filter_map(mean_of)
                .collect::<Vec<_>>(),
        )
    }

    fn line(&self, name: String) -> Vec<String> {
        let correlation = self
            .rank_correlation()
            .map_or("undefined".to_string(), |of| format!("{of:.2}"));
        vec![
            name,
            figure(self.mean_difference()),
            self.cells().to_string(),
            correlation,
        ]
    }
}

/// The best constant of a row: the median of the paper's cells that ours have, too.
fn best_constant(row: &Row) -> Option<f64> {
    let paper = row.paper.as_ref()?;
    let common = |rate: u32| row.estimates(rate, TABLE).and(paper.estimate(rate));
    median(
        &paper::RATES
            .into_iter()
            .filter_map(common)
            .collect::<Vec<_>>(),
    )
}

fn figure(value: Option<f64>) -> String {
    value.map_or("N/A".to_string(), |value| format!("{value:.3}"))
}

pub(super) fn claim(table: &Table) -> Claim {
    let rows = || table.rows.iter().filter(|row| row.paper.is_some());
    let by_variant =
        |place: usize| Distance::of(rows(), |row, rate| Some(row.estimates(rate, place)?.mean));
    let ours = by_variant(TABLE);
    let common = |row: &Row, rate: u32| row.estimates(rate, TABLE).is_some();
    let constant = Distance::of(rows(), |row, rate| common(row, rate).then_some(CONSTANT));
    let best = Distance::of(rows(), |row, rate| {
        common(row, rate).then(|| best_constant(row))?
    });

    let mut lines: Vec<_> = (0..VARIANTS.len())
        .map(|place| {
            let variant = VARIANTS[place];
            by_variant(place).line(format!(
                "solver {}, grid {}",
                variant.solver_name(),
                variant.grid_name()
            ))
        })
        .collect();
    lines.push(constant.line("baseline: 5 everywhere".to_string()));
    lines.push(best.line("baseline: the best constant per scenario".to_string()));
    let header = cells(&[
        "estimate",
        "mean absolute difference [FPR]",
        "cells",
        "rank correlation",
    ]);
    let (difference, first, second) = (
        figure(ours.mean_difference()),
        figure(constant.mean_difference()),
        figure(best.mean_difference()),
    );
    Claim {
        number: "4",
        title: "How far the estimates are from the paper's, cell by cell",
        verdict: Verdict::FigureOnly,
        figures: format!(
            "Mean absolute difference {difference} FPR over {} common cells; baselines {first} and {second}",
            ours.cells()
        ),
        details: format!(
            "{}\nRank correlation: Spearman's over the scenarios, of the means of the rows' common cells, ties by mean ranks; a constant \
             has none.\n\n{}\n{}\n{}",
            markdown_table(&header, &lines),
            by_scenario(table, &ours),
            one_sided(table),
            solvers(table)
        ),
    }
}

fn by_scenario(table: &Table, ours: &Distance) -> String {
    let rows = table
        .rows
        .iter()
        .filter(|row| row.paper.is_some())
        .zip(&ours.scenarios);
    let line = |(row, pairs): (&Row, &Vec<(f64, f64)>)| {
        let (ours, papers): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
        vec![
            row.scenario.clone(),
            figure(mean(&ours)),
            figure(mean(&papers)),
            figure(mean_absolute_difference(pairs)),
            pairs.len().to_string(),
        ]
    };
    let header = cells(&[
        "scenario",
        "mean, ours",
        "mean, paper",
        "mean absolute difference",
        "cells",
    ]);
    markdown_table(&header, &rows.map(line).collect::<Vec<_>>())
}

/// The cells that have an estimate on one side only.
fn one_sided(table: &Table) -> String {
    let mut text = String::new();
    for row in &table.rows {
        let Some(paper) = &row.paper else { continue };
        let tested = |rate: &u32| row.tested.iter().any(|tested| tested.rate == *rate);
        let rates = || paper::RATES.into_iter().filter(tested);
        let ours_only: Vec<u32> = rates()
            .filter(|rate| row.estimates(*rate, TABLE).is_some() && paper.estimate(*rate).is_none())
            .collect();
        let papers_only: Vec<u32> = rates()
            .filter(|rate| row.estimates(*rate, TABLE).is_none() && paper.estimate(*rate).is_some())
            .collect();
        for (rates, side) in [(ours_only, "ours only"), (papers_only, "the paper only")] {
            if !rates.is_empty() {
                let _ = writeln!(text, "- {}, {} FPR: {side}", row.scenario, spans(&rates));
            }
        }
    }
    if text.is_empty() {
        "No cell has an estimate on one side only.\n".to_string()
    } else {
        format!("Cells with an estimate on one side only:\n\n{text}")
    }
}

/// How often and by how much the paper's own search finds another largest estimate.
fn solvers(table: &Table) -> String {
    let mut pairs = Vec::new();
    for row in &table.rows {
        for rate in paper::RATES {
            if let (Some(exact), Some(paper)) =
                (row.estimates(rate, TABLE), row.estimates(rate, PAPER))
            {
                pairs.extend(exact.all.iter().copied().zip(paper.all.iter().copied()));
            }
        }
    }
    let differing: Vec<_> = pairs
        .iter()
        .copied()
        .filter(|(exact, paper)| exact != paper)
        .collect();
    let higher = differing
        .iter()
        .filter(|(exact, paper)| paper > exact)
        .count();
    let mut most = 0.0;
    for (exact, paper) in &differing {
        if (exact - paper).abs() > most {
            most = (exact - paper).abs();
        }
    }
    format!(
        "The solver `paper` gives another largest estimate than `exact` in {} of {} runs, a higher one in {higher} of them; by {} FPR \
         in the mean of those and {most:.3} at most.\n",
        differing.len(),
        pairs.len(),
        figure(mean_absolute_difference(&differing))
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The baselines of the whole published table, as if every cell of ours had an estimate.
    #[test]
    fn paper_the_baselines_come_out_of_its_table() {
        let mut differences = (Vec::new(), Vec::new());
        for row in paper::rows() {
            let cells: Vec<f64> = row.estimates.iter().flatten().copied().collect();
            let best = median(&cells).unwrap();
            differences
                .0
                .extend(cells.iter().map(|cell| (CONSTANT, *cell)));
            differences.1.extend(cells.iter().map(|cell| (best, *cell)));
        }
        let rounded = |pairs: &[(f64, f64)]| {
            (mean_absolute_difference(pairs).unwrap() * 100.0).round() / 100.0
        };
        assert_eq!(rounded(&differences.0), 1.65);
        assert_eq!(rounded(&differences.1), 0.66);
    }
}
