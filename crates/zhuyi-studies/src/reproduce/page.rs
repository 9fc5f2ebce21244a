//! `table1.md` and `table1.csv`.
//!
//! The CSV is long: `scenario,quantity,solver,ours,paper`, one row per figure. Quantities are `mrf`, `est_1` .. `est_30` and
//! `est_median_1` .. (the mean and the median over the runs at that rate), `max_sum` and `fraction`. The solver of an
//! estimate, and of what is made of estimates, is `exact` or `paper`; an MRF has none. An MRF of ours is a number or, where
//! the highest rate collides, `>30`; the paper's `<1` stands as 1. Where there is no figure the field is empty.

use std::fmt::Write as _;

use crate::reproduce::paper;
use crate::reproduce::plan::Plan;
use crate::reproduce::table::{Estimates, Row, Table, Tested};
use zhuyi_batch::estimators::{TABLE, VARIANTS};
use zhuyi_batch::text::{cells, csv_row, decimals, markdown_table, spans};

/// [m/s] one mile per hour.
const MPH: f64 = 0.447_04;

/// `table1.csv`.
pub fn csv(table: &Table) -> String {
    let mut text = csv_row(["scenario", "quantity", "solver", "ours", "paper"]);
    for row in &table.rows {
        let mut add = |quantity: &str, solver: &str, ours: String, paper: Option<f64>| {
            let paper = paper.map_or(String::new(), |paper| paper.to_string());
            text += &csv_row([&row.scenario, quantity, solver, &ours, &paper]);
        };
        let paper = row.paper.as_ref();
        add(
            "mrf",
            "",
            row.required.mrf.to_string(),
            paper.map(|paper| f64::from(paper.mrf)),
        );
        for (place, variant) in VARIANTS
            .iter()
            .enumerate()
            .filter(|(_, variant)| variant.grid == VARIANTS[TABLE].grid)
        {
            for tested in row
                .tested
                .iter()
                .filter(|tested| place == TABLE || paper::RATES.contains(&tested.rate))
            {
                let (rate, estimates) = (tested.rate, tested.estimates.get(place));
                let published = paper.and_then(|paper| paper.estimate(rate));
                let (mean, median) = (estimates.map(|of| of.mean), estimates.map(|of| of.median));
                add(
                    &format!("est_{rate}"),
                    variant.solver_name(),
                    decimals(mean, 4),
                    published,
                );
                add(
                    &format!("est_median_{rate}"),
                    variant.solver_name(),
                    decimals(median, 4),
                    published,
                );
            }
        }
        let solver = VARIANTS[TABLE].solver_name();
        add(
            "max_sum",
            solver,
            decimals(row.largest_sum, 4),
            paper.map(|paper| paper.max_sum),
        );
        add(
            "fraction",
            solver,
            decimals(row.fraction, 4),
            paper.map(|paper| paper.fraction),
        );
    }
    text
}

/// `table1.md`.
pub fn markdown(plan: &Plan, table: &Table) -> String {
    let mut text = format!(
        "# Table 1, ours beside the paper's\n\n\
         Written by `{}`: {}.\n\n",
        plan.command(),
        plan.spelt()
    );
    text += &beside(table);
    text += "\nMRF: the smallest tested rate at which, and at every higher one, no seed collides; 1 stands for the paper's <1. \
             Columns by rate [FPR]: the mean over the seeds of a run's largest estimate, any analysed camera, any step; N/A where a \
             run collided. Sum: the largest over the analysed cameras at one step of any run at a rate from the MRF on. Activity: \
             whether an actor is in the camera's view at the highest rate.\n";
    text += "\n## Behind the estimates\n\n";
    text += &behind(table);
    text += "\nThe median over the seeds; b: runs that asked for more than the grid of latencies offers; u: runs in which even \
             braking at once came too late. Both count as 30 FPR.";
    text += &unhelped(table);
    text += "\n\n## Collisions\n\n";
    text += &collisions(table);
    let _ = write!(
        text,
        "\nRuns out of {} that collide, by rate [FPR]; a dot is none. ",
        plan.seeds
    );
    text += &not_monotone(table);
    text
}

/// The rates of the paper's table that were tested.
fn columns(table: &Table) -> Vec<u32> {
    let tested = |rate: &u32| {
        table
            .rows
            .iter()
            .any(|row| row.tested.iter().any(|tested| tested.rate == *rate))
    };
    paper::RATES.into_iter().filter(tested).collect()
}

fn beside(table: &Table) -> String {
    let rates = columns(table);
    let directions: Vec<&str> = table.rows.first().map_or(Vec::new(), |row| {
        row.active
            .iter()
            .map(|(direction, _)| direction.as_str())
            .collect()
    });
    let mut header = cells(&["scenario", "", "mph"]);
    header.extend(cells(&directions));
    header.push("MRF".to_string());
    header.extend(rates.iter().map(u32::to_string));
    header.extend(cells(&["sum", "fraction"]));
    let mut lines = Vec::new();
    for row in &table.rows {
        lines.push(ours(row, &rates));
        lines.extend(
            row.paper
                .as_ref()
                .map(|paper| papers(paper, &rates, &directions)),
        );
    }
    markdown_table(&header, &lines)
}

fn ours(row: &Row, rates: &[u32]) -> Vec<String> {
    let mut line = cells(&[
        &row.scenario,
        "ours",
        &format!("{:.0}", row.ego_speed / MPH),
    ]);
    line.extend(row.active.iter().map(|(_, active)| yes(*active)));
    line.push(row.required.mrf.to_string());
    line.extend(rates.iter().map(|rate| {
        row.estimates(*rate, TABLE)
            .map_or("N/A".to_string(), |of| format!("{:.1}", of.mean))
    }));
    line.push(
        row.largest_sum
            .map_or("N/A".to_string(), |sum| format!("{sum:.1}")),
    );
    line.push(
        row.fraction
            .map_or("N/A".to_string(), |fraction| format!("{fraction:.3}")),
    );
    line
}

fn papers(paper: &paper::Row, rates: &[u32], directions: &[&str]) -> Vec<String> {
    let mut line = cells(&["", "paper", &paper.ego_speed.to_string()]);
    line.extend(
        directions
            .iter()
            .map(|direction| paper.is_active(direction).map_or(String::new(), yes)),
    );
    line.push(paper.mrf.to_string());
    line.extend(rates.iter().map(|rate| {
        paper
            .estimate(*rate)
            .map_or("N/A".to_string(), |of| of.to_string())
    }));
    line.push(paper.max_sum.to_string());
    line.push(format!("{:.2}", paper.fraction));
    line
}

fn yes(active: bool) -> String {
    if active {
        "yes".to_string()
    } else {
        "no".to_string()
    }
}

fn behind(table: &Table) -> String {
    let rates = columns(table);
    let cell = |row: &Row, rate: u32| {
        row.estimates(rate, TABLE).map_or("N/A".to_string(), |of| {
            let mut cell = format!("{:.1}", of.median);
            for (runs, letter) in [(of.beyond_grid, 'b'), (of.unavoidable, 'u')] {
                if runs > 0 {
                    let _ = write!(cell, " {runs}{letter}");
                }
            }
            cell
        })
    };
    let mut header = cells(&["scenario"]);
    header.extend(rates.iter().map(u32::to_string));
    let line = |row: &Row| {
        let cells = rates.iter().map(|rate| cell(row, *rate));
        std::iter::once(row.scenario.clone()).chain(cells).collect()
    };
    markdown_table(&header, &table.rows.iter().map(line).collect::<Vec<_>>())
}

/// The runs in which no rate helped with an actor in view, by scenario.
fn unhelped(table: &Table) -> String {
    let mut text = String::new();
    for row in &table.rows {
        let runs = |of: fn(&Estimates) -> u32| -> u32 {
            let tested = row.tested.iter();
            tested
                .filter_map(|tested| tested.estimates.get(TABLE))
                .map(of)
                .sum()
        };
        let counts = [
            (
                "Alongside, which no rate helps, was an actor",
                runs(|of| of.alongside),
            ),
            (
                "Standing before an actor, where no rate helps, was the ego",
                runs(|of| of.standing),
            ),
        ];
        for (what, runs) in counts.into_iter().filter(|(_, runs)| *runs > 0) {
            let _ = write!(text, " {what} in {runs} runs of {}.", row.scenario);
        }
    }
    text
}

fn collisions(table: &Table) -> String {
    let tested = table.rows.first().map_or(&[][..], |row| &row.tested);
    let mut header = cells(&["scenario"]);
    header.extend(tested.iter().map(|tested| tested.rate.to_string()));
    let count = |tested: &Tested| match tested.collisions {
        0 => ".".to_string(),
        runs => runs.to_string(),
    };
    let line = |row: &Row| {
        std::iter::once(row.scenario.clone())
            .chain(row.tested.iter().map(count))
            .collect()
    };
    markdown_table(&header, &table.rows.iter().map(line).collect::<Vec<_>>())
}

fn not_monotone(table: &Table) -> String {
    let odd = |row: &Row| {
        let safe = &row.required.safe_below;
        (!safe.is_empty()).then(|| {
            format!(
                "{}: no collision at {} FPR, below its MRF",
                row.scenario,
                spans(safe)
            )
        })
    };
    let odd: Vec<String> = table.rows.iter().filter_map(odd).collect();
    if odd.is_empty() {
        "No scenario is free of collisions at a rate below its MRF.\n".to_string()
    } else {
        format!("Not monotone: {}.\n", odd.join("; "))
    }
}
