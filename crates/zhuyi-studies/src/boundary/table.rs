//! The files of a search: the curves in words, as numbers, and every cell that was driven.

use std::fmt::Write as _;

use super::{Boundary, Curve, Point};
use zhuyi_batch::results::Results;
use zhuyi_batch::text::{cells, csv_row, listed, markdown_table, spans};

/// All files and what the command says.
pub(super) fn results(plan: &Boundary, curves: &[Curve]) -> Results {
    let page = page(plan, curves);
    Results {
        files: vec![
            ("boundary.md", page.clone()),
            ("boundary.csv", csv(curves)),
            ("boundary_samples.csv", samples(curves)),
        ],
        claims: Vec::new(),
        summary: page,
    }
}

fn page(plan: &Boundary, curves: &[Curve]) -> String {
    let Boundary {
        rates,
        seeds,
        root_seed,
        command,
        ..
    } = plan;
    let mut text = format!(
        "# The minimum required rate over a free choice\n\n\
         Written by `{command}`: rates {} FPR, {seeds} drives without a collision make a cell safe, root seed {root_seed}.\n\n\
         MRF: the smallest rate at which, and at every higher tested one, no drive collides. Behind each the values of the choice that \
         have it. {}\n",
        spans(rates),
        effort(plan, curves),
    );
    for (choice, of_choice) in plan
        .choices
        .iter()
        .zip(curves.chunks(plan.bench.scenarios.len()))
    {
        let (first, last) = (choice.values.first(), choice.values.last());
        let over = first.zip(last).map_or(String::new(), |(first, last)| {
            format!(" over {} values, {first} to {last}", choice.values.len())
        });
        let rows: Vec<Vec<String>> = of_choice
            .iter()
            .map(|curve| vec![curve.scenario.clone(), told(&curve.points), audited(curve)])
            .collect();
        let _ = write!(
            text,
            "\n## {}{over}\n\n{}",
            choice.path,
            markdown_table(&cells(&["scenario", "MRF", "contradicted"]), &rows)
        );
    }
    text
}

/// How many drives were made, in place of how many, and how many audits contradict.
fn effort(plan: &Boundary, curves: &[Curve]) -> String {
    let made: u64 = curves.iter().map(Curve::drives).sum();
    let cells: usize = curves.iter().map(|curve| curve.cells.len()).sum();
    let all: usize = curves
        .iter()
        .map(|curve| curve.points.len() * plan.rates.len())
        .sum();
    let audits = || {
        curves
            .iter()
            .flat_map(|curve| curve.cells.values())
            .filter_map(|cell| cell.audit)
    };
    format!(
        "Driven were {cells} of {all} cells in {made} drives; of {} cells that were drawn from all the others to audit them, {} contradict \
         what was concluded (last column).",
        audits().count(),
        audits().filter(|contradicts| *contradicts).count()
    )
}

/// Values with the same MRF drawn together: `8 at 0.9 to 0.94, 6 at 0.96 to 1.1`.
fn told(points: &[Point]) -> String {
    let runs = points.chunk_by(|one, two| one.mrf == two.mrf);
    let told: Vec<String> = runs
        .map(|run| match run {
            [only] => format!("{} at {}", only.mrf, only.value),
            [first, .., last] => format!("{} at {} to {}", first.mrf, first.value, last.value),
            [] => String::new(),
        })
        .collect();
    told.join(", ")
}

/// The cells of a curve that contradict it.
fn audited(curve: &Curve) -> String {
    let contradicting = curve
        .cells
        .iter()
        .filter(|(_, cell)| cell.audit == Some(true));
    let told: Vec<String> = contradicting
        .map(|((value, _), cell)| {
            let what = match cell.share.collided {
                0 => "safe",
                _ => "unsafe",
            };
            format!(
                "{what} at {}, {} FPR",
                curve.points[*value].value, cell.share.rate
            )
        })
        .collect();
    listed(&told)
}

fn csv(curves: &[Curve]) -> String {
    let rows = curves.iter().flat_map(|curve| {
        curve.points.iter().map(move |point| {
            let how = if point.driven { "driven" } else { "between" };
            let mrf = point.mrf.to_string();
            csv_row([
                curve.scenario.as_str(),
                &curve.path,
                &point.value,
                &mrf,
                how,
            ])
        })
    });
    "scenario,parameter,value,mrf,how\n".to_string() + &rows.collect::<String>()
}

fn samples(curves: &[Curve]) -> String {
    let rows = curves.iter().flat_map(|curve| {
        curve.cells.iter().map(move |((value, _), cell)| {
            let why = match cell.audit {
                None => "search",
                Some(false) => "audit",
                Some(true) => "audit contradicts",
            };
            csv_row([
                curve.scenario.as_str(),
                &curve.path,
                &curve.points[*value].value,
                &cell.share.rate.to_string(),
                &cell.share.collided.to_string(),
                &cell.share.drives.to_string(),
                why,
            ])
        })
    });
    "scenario,parameter,value,fpr,collided,drives,why\n".to_string() + &rows.collect::<String>()
}
