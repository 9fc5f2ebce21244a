//! The estimate in the loop beside the one with hindsight, of one camera over a run (claim 8).

use plotters::prelude::*;
use zhuyi_studies::claims::run::foresight::{Decision, Foresight};

use super::File;
use super::sheet::{Area, Axes, Failure, Style, TITLE, axes, csv, font, line, sample, svg, whole};
use crate::palette::{BLACK, BLUE, GREEN, VERMILION};

/// A line: its name, how it is drawn, and what of.
type Series = (&'static str, Style, fn(&Decision) -> f64);

const SERIES: [Series; 3] = [
    (
        "offline: truth, recorded future",
        Style {
            colour: BLACK,
            width: 2,
            dashes: None,
        },
        |decision| decision.offline,
    ),
    (
        "truth, predicted futures",
        Style {
            colour: BLUE,
            width: 7,
            dashes: None,
        },
        |decision| decision.predicted,
    ),
    (
        "online: belief, predicted futures",
        Style {
            colour: VERMILION,
            width: 3,
            dashes: Some((8, 5)),
        },
        |decision| decision.online,
    ),
];

/// How the last line is drawn: online with one predicted future.
const ONE: (&str, Style) = (
    "online, one future (the planner's)",
    Style {
        colour: GREEN,
        width: 4,
        dashes: Some((4, 6)),
    },
);

/// The figure and its CSV: a run, and the same one with one predicted future in the loop.
pub fn files(run: &Foresight, one: &Foresight) -> [File; 2] {
    let header = [
        "time_s",
        "offline_ms",
        "predicted_ms",
        "online_ms",
        "online_one_future_ms",
    ];
    let row = |(decision, one): (&Decision, &Decision)| {
        let mut row = vec![format!("{:.1}", decision.time)];
        row.extend(SERIES.map(|(_, _, of)| format!("{:.0}", 1e3 * of(decision))));
        row.push(format!("{:.0}", 1e3 * one.online));
        row
    };
    let rows = run.decisions.iter().zip(&one.decisions).map(row);
    [
        (
            "figures/online-cut-in.svg",
            svg((900, 560), |area| draw(run, one, area)),
        ),
        ("figures/online-cut-in.csv", csv(&header, rows)),
    ]
}

fn draw(run: &Foresight, one: &Foresight, area: &Area<'_>) -> Result<(), Failure> {
    let last = run.decisions.last().map_or(1.0, |decision| decision.time);
    let title = format!(
        "{}: what {} tolerates, estimated while driving and afterwards",
        run.scenario, run.camera
    );
    let mut chart = ChartBuilder::on(area)
        .caption(title, font(TITLE))
        .margin(14)
        .margin_right(24)
        .margin_bottom(66)
        .x_label_area_size(56)
        .y_label_area_size(80)
        .build_cartesian_2d(0.0..last, 0.0..1100.0)?;
    axes(
        &mut chart,
        &Axes {
            x: "time [s]",
            y: "tolerable latency [ms]",
            x_tick: &whole,
            y_tick: &whole,
            ticks: (10, 6),
        },
    )?;
    // The wide one beneath.
    for place in [1, 0, 2] {
        let (_, style, of) = SERIES[place];
        let points = run
            .decisions
            .iter()
            .map(|decision| (decision.time, 1e3 * of(decision)));
        line(&mut chart, points, style)?;
    }
    for ((name, style, _), at) in SERIES.into_iter().zip([(90, 508), (90, 534), (460, 508)]) {
        sample(area, at, name, (Some(style), None))?;
    }
    let (name, style) = ONE;
    let points = one
        .decisions
        .iter()
        .map(|decision| (decision.time, 1e3 * decision.online));
    line(&mut chart, points, style)?;
    sample(area, (460, 534), name, (Some(style), None))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_the_csv_has_every_decision() {
        let run = Foresight {
            scenario: "cut-in".into(),
            rate: 30,
            seed: 0,
            camera: "front_120".into(),
            decisions: vec![Decision {
                time: 0.1,
                offline: 1.0,
                predicted: 0.472,
                online: 0.439,
            }],
            largest: vec![2.3],
            out_of_reach: 0,
        };
        let [(_, svg), (_, csv)] = files(&run, &run);
        assert_eq!(
            csv,
            "time_s,offline_ms,predicted_ms,online_ms,online_one_future_ms\n0.1,1000,472,439,439\n"
        );
        assert!(
            svg.contains("online: belief, predicted futures")
                && svg.contains("tolerable latency [ms]")
        );
    }
}
