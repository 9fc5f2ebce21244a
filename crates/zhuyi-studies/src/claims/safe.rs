//! Claim 2: the estimates are safe. (a) none is below the MRF; (b) nothing collides at the rates that were asked for.

use std::fmt::Write as _;

use super::{Claim, Verdict};
use crate::reproduce::paper;
use crate::reproduce::plan::Plan;
use crate::reproduce::table::{Estimates, Row, Table};
use crate::reruns::{Reruns, Trial};
use zhuyi_batch::estimators::TABLE;
use zhuyi_batch::mrf::Mrf;
use zhuyi_batch::rates::spelt;
use zhuyi_batch::statistics::bound_without_event;
use zhuyi_batch::text::{cells, markdown_table, spans};

/// A cell of the table that has an estimate.
struct Cell<'a> {
    row: &'a Row,
    rate: u32,
    estimates: &'a Estimates,
}

impl Cell<'_> {
    /// Whether there is a lower estimate than its own that would be below the MRF: not at an MRF of 1.
    fn can_fail(&self) -> bool {
        !matches!(self.row.required.mrf, Mrf::Rate(1) | Mrf::AtMost(_))
    }

    /// [FPR] how far the estimate is above the MRF, where that can fail.
    fn margin(&self) -> Option<f64> {
        match self.row.required.mrf {
            Mrf::Rate(rate) if self.can_fail() => Some(self.estimates.mean - f64::from(rate)),
            _ => None,
        }
    }

    fn is_safe(&self, estimate: f64) -> bool {
        match self.row.required.mrf {
            Mrf::Rate(rate) => estimate >= f64::from(rate),
            Mrf::Above(_) => false,
            Mrf::AtMost(_) => true,
        }
    }
}

fn with_estimates(row: &Row) -> impl Iterator<Item = Cell<'_>> {
    let rates = row.tested.iter().map(|tested| tested.rate);
    rates.filter_map(move |rate| {
        Some(Cell {
            row,
            rate,
            estimates: row.estimates(rate, TABLE)?,
        })
    })
}

/// Claim 2a.
pub(super) fn at_every_rate(table: &Table) -> Claim {
    let all: Vec<Cell<'_>> = table.rows.iter().flat_map(with_estimates).collect();
    let of_the_paper = || all.iter().filter(|cell| paper::RATES.contains(&cell.rate));
    let is_below = |cell: &&Cell<'_>| !cell.is_safe(cell.estimates.mean);
    let below = all.iter().filter(is_below).count();
    let runs_below = |cell: &Cell<'_>| {
        cell.estimates
            .all
            .iter()
            .filter(|estimate| !cell.is_safe(**estimate))
            .count()
    };
    Claim {
        number: "2a",
        title: "The estimate is at least the MRF in every cell",
        verdict: Verdict::holds_if(below == 0),
        figures: format!(
            "{} of {} cells at the paper's rates are below their MRF, {below} of {} at all rates tested",
            of_the_paper().filter(is_below).count(),
            of_the_paper().count(),
            all.len()
        ),
        details: format!(
            "{}Only a cell whose MRF is above 1 can fail: {} of those at the paper's rates. Of single runs, {} of {} are below the \
             MRF of their scenario.{}\n",
            cells_below(table),
            of_the_paper().filter(|cell| cell.can_fail()).count(),
            all.iter().map(runs_below).sum::<usize>(),
            all.iter()
                .map(|cell| cell.estimates.all.len())
                .sum::<usize>(),
            thinnest_margin(&all)
        ),
    }
}

/// The cells below their MRF, a line per scenario that has any.
fn cells_below(table: &Table) -> String {
    let mut text = String::new();
    for row in &table.rows {
        let below: Vec<_> = with_estimates(row)
            .filter(|cell| !cell.is_safe(cell.estimates.mean))
            .collect();
        let rates: Vec<u32> = below.iter().map(|cell| cell.rate).collect();
        let least = below
            .iter()
            .map(|cell| cell.estimates.mean)
            .min_by(f64::total_cmp);
        if let Some(least) = least {
            let (rates, mrf) = (spans(&rates), row.required.mrf);
            let _ = writeln!(
                text,
                "- {} at {rates} FPR: estimates from {least:.3}, MRF {mrf}",
                row.scenario
            );
        }
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

/// The cell that is closest to its MRF, or the farthest below.
fn thinnest_margin(all: &[Cell<'_>]) -> String {
    let thinnest = all
        .iter()
        .filter_map(|cell| Some((cell.margin()?, cell)))
        .min_by(|(a, _), (b, _)| a.total_cmp(b));
    thinnest.map_or(String::new(), |(margin, cell)| {
        format!(
            " The thinnest margin is {margin:.3} FPR: {} at {} FPR.",
            cell.row.scenario, cell.rate
        )
    })
}

/// Claim 2b.
pub(super) fn at_the_rates_asked_for(plan: &Plan, table: &Table, reruns: &Reruns) -> Claim {
    let mut lines = Vec::new();
    let (mut trials, mut free) = (0, 0);
    for (row, rerun) in table.rows.iter().zip(&reruns.scenarios) {
        let Some(rerun) = rerun else {
            lines.push(cells(&[
                &row.scenario,
                "none: a run collided",
                "",
                "",
                "",
                "",
            ]));
            trials += 2;
            continue;
        };
        let both = [&rerun.largest, &rerun.own];
        trials += both.len();
        free += both.iter().filter(|trial| trial.collisions == 0).count();
        let rates = |trial: &Trial| spelt(&plan.system, &trial.rates);
        let collisions = |trial: &Trial| format!("{} of {}", trial.collisions, trial.runs);
        lines.push(vec![
            row.scenario.clone(),
            format!("{:.3}", rerun.asked),
            rates(&rerun.largest),
            collisions(&rerun.largest),
            rates(&rerun.own),
            collisions(&rerun.own),
        ]);
    }
    let header = cells(&[
        "scenario",
        "asked for",
        "all cameras at",
        "collisions",
        "each camera at its own",
        "collisions",
    ]);
    let (seeds, bound) = (plan.seeds, 100.0 * bound_without_event(plan.seeds as u32));
    let highest = plan.rates.last().map_or(String::new(), u32::to_string);
    Claim {
        number: "2b",
        title: "Nothing collides at the rates that the estimate asked for",
        verdict: Verdict::holds_if(free == trials),
        figures: format!("{free} of {trials} trials have no collision in {seeds} seeds"),
        details: format!(
            "{}\nAsked for [FPR]: the largest estimate over the runs at {highest} FPR; each rate is rounded up to a whole number. \
             Each camera at its own: the largest demand on it alone; a camera that is not analysed goes with the analysed one of \
             its name (front_60 with front_120), or keeps its rate. The same {seeds} seeds are run. No collision in {seeds} \
             seeds leaves room for a chance of one of up to {bound:.0} % per run (95 %): it does not say safe.\n",
            markdown_table(&header, &lines)
        ),
    }
}
