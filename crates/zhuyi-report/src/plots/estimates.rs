//! The whole table in one picture: estimates and MRFs of every scenario, ours beside the paper's.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_studies::committed::TableRow;
use zhuyi_studies::reproduce::paper::RATES;

use super::File;
use super::sheet::{
    AXIS, Area, Axes, Chart, Failure, Mark, NOTE, Style, TITLE, axes, csv, letters, line, marks,
    sample, svg, whole,
};
use crate::palette::{BLACK, BLUE, GREY, VERMILION};

/// [px] the figure.
const SIZE: (u32, u32) = (1200, 1130);

const OURS: Style = Style {
    colour: BLUE,
    width: 3,
    dashes: None,
};
const PAPERS: Style = Style {
    colour: VERMILION,
    width: 2,
    dashes: Some((6, 4)),
};

/// One panel.
struct Panel<'a> {
    scenario: &'a str,
    rows: Vec<&'a TableRow>,
}

impl<'a> Panel<'a> {
    /// The panels, in the order of the rows.
    fn all(rows: &'a [TableRow]) -> Vec<Self> {
        let panels = rows
            .chunk_by(|a, b| a.scenario == b.scenario)
            .map(|rows| Self {
                scenario: &rows[0].scenario,
                rows: rows.iter().filter(|row| row.solver != "paper").collect(),
            });
        panels.collect()
    }

    /// Ours and the paper's, as they stand in the file.
    fn find(&self, quantity: &str) -> (&'a str, &'a str) {
        let row = self.rows.iter().find(|row| row.quantity == quantity);
        row.map_or(("", ""), |row| (&row.ours, &row.paper))
    }

    /// Place along the axis and estimate [FPR].
    fn estimates(&self, pick: fn((&'a str, &'a str)) -> &'a str) -> Vec<(f64, f64)> {
        let point = |(place, rate): (usize, &u32)| {
            let estimate = pick(self.find(&format!("est_{rate}"))).parse().ok()?;
            Some((place as f64, estimate))
        };
        RATES.iter().enumerate().filter_map(point).collect()
    }
}

/// The figure and its CSV.
pub fn files(rows: &[TableRow]) -> [File; 2] {
    let panels = Panel::all(rows);
    let header = ["scenario", "quantity", "rate_fps", "ours", "paper"];
    let of = |panel: &Panel<'_>| -> Vec<Vec<String>> {
        let row = |quantity: &str, rate: String, of: &str| {
            let (ours, paper) = panel.find(of);
            [panel.scenario, quantity, &rate, ours, paper]
                .map(String::from)
                .to_vec()
        };
        let mut all = vec![row("mrf_fps", String::new(), "mrf")];
        all.extend(RATES.map(|rate| row("estimate_fps", rate.to_string(), &format!("est_{rate}"))));
        all.push(row("largest_sum_fps", String::new(), "max_sum"));
        all
    };
    [
        (
            "figures/estimates.svg",
            svg(SIZE, |area| draw(&panels, area)),
        ),
        (
            "figures/estimates.csv",
            csv(&header, panels.iter().flat_map(of)),
        ),
    ]
}

fn draw(panels: &[Panel<'_>], area: &Area<'_>) -> Result<(), Failure> {
    let title = "Estimate and MRF by the rate of all cameras, ours and (in brackets) the paper's";
    area.draw(&Text::new(
        title.to_string(),
        (600, 26),
        letters(TITLE, BLACK, HPos::Center, VPos::Center),
    ))?;
    let (_, rest) = area.split_vertically(46);
    let (grid, legend) = rest.split_vertically(1020);
    let both = |panel: &Panel<'_>| {
        [
            panel.estimates(|(ours, _)| ours),
            panel.estimates(|(_, paper)| paper),
        ]
        .concat()
    };
    let all = panels.iter().flat_map(both);
    // One scale, with room above the largest.
    let top = all.map(|(_, estimate)| estimate).fold(1.0, f64::max) + 1.2;
    let columns = 3;
    let lines = panels.len().div_ceil(columns).max(1);
    for (panel, area) in panels.iter().zip(grid.split_evenly((lines, columns))) {
        draw_panel(panel, top, &area)?;
    }
    let mrf = |colour| Style {
        colour,
        width: 2,
        dashes: Some((3, 3)),
    };
    sample(
        &legend,
        (40, 28),
        "estimate, ours",
        (Some(OURS), Some((Mark::Disc, 5))),
    )?;
    sample(
        &legend,
        (260, 28),
        "estimate, the paper's",
        (Some(PAPERS), Some((Mark::Triangle, 6))),
    )?;
    sample(
        &legend,
        (530, 28),
        "MRF, where ours is the paper's",
        (Some(mrf(BLACK)), None),
    )?;
    sample(
        &legend,
        (860, 28),
        "as large as the rate",
        (
            Some(Style {
                colour: GREY,
                width: 2,
                dashes: None,
            }),
            None,
        ),
    )
}

fn draw_panel(panel: &Panel<'_>, top: f64, area: &Area<'_>) -> Result<(), Failure> {
    let last = (RATES.len() - 1) as f64;
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .margin_right(16)
        .margin_top(62)
        .x_label_area_size(54)
        .y_label_area_size(62)
        .build_cartesian_2d(-0.4..last + 0.4, 0.0..top)?;
    let rate = |place: &f64| {
        let whole = (place - place.round()).abs() < 1e-6;
        let rate = RATES.get(place.round() as usize).filter(|_| whole);
        rate.map_or(String::new(), u32::to_string)
    };
    axes(
        &mut chart,
        &Axes {
            x: "rate [FPR]",
            y: "estimate [FPR]",
            x_tick: &rate,
            y_tick: &whole,
            ticks: (12, 5),
        },
    )?;
    let (mrf, papers_mrf) = panel.find("mrf");
    let (sum, papers_sum) = panel.find("max_sum");
    let sum = sum
        .parse::<f64>()
        .map_or("N/A".to_string(), |sum| format!("{sum:.1}"));
    let style = |size| letters(size, BLACK, HPos::Center, VPos::Center);
    area.draw(&Text::new(
        panel.scenario.to_string(),
        (220, 18),
        style(AXIS),
    ))?;
    let told = format!("MRF {mrf} ({papers_mrf}), largest sum {sum} ({papers_sum})");
    area.draw(&Text::new(told, (220, 44), style(NOTE)))?;
    required(&mut chart, top, (mrf, papers_mrf))?;
    let same = RATES
        .iter()
        .enumerate()
        .map(|(place, rate)| (place as f64, f64::from(*rate)));
    let grey = Style {
        colour: GREY,
        width: 2,
        dashes: None,
    };
    line(&mut chart, same.filter(|(_, rate)| *rate <= top), grey)?;
    let papers = panel.estimates(|(_, paper)| paper);
    line(&mut chart, papers.iter().copied(), PAPERS)?;
    marks(&mut chart, &papers, Mark::Triangle, (6, VERMILION))?;
    let ours = panel.estimates(|(ours, _)| ours);
    line(&mut chart, ours.iter().copied(), OURS)?;
    marks(&mut chart, &ours, Mark::Disc, (5, BLUE))
}

/// The MRFs as lines from top to bottom: one in black where both are the same.
fn required(
    chart: &mut Chart<'_, '_>,
    top: f64,
    (ours, papers): (&str, &str),
) -> Result<(), Failure> {
    let place = |mrf: &str| {
        let mrf: u32 = mrf.parse().ok()?;
        RATES
            .iter()
            .position(|rate| *rate == mrf)
            .map(|place| place as f64)
    };
    let mut upright = |place: Option<f64>, colour: RGBColor| match place {
        Some(x) => line(
            chart,
            [(x, 0.0), (x, top)],
            Style {
                colour,
                width: 2,
                dashes: Some((3, 3)),
            },
        ),
        None => Ok(()),
    };
    if ours == papers {
        upright(place(ours), BLACK)
    } else {
        upright(place(ours), BLUE)?;
        upright(place(papers), VERMILION)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(quantity: &str, solver: &str, ours: &str, paper: &str) -> TableRow {
        TableRow {
            scenario: "cut-in".into(),
            quantity: quantity.into(),
            solver: solver.into(),
            ours: ours.into(),
            paper: paper.into(),
        }
    }

    #[test]
    fn hand_the_csv_has_the_cells_of_the_table_by_the_exact_solver() {
        let rows = [
            row("mrf", "", "1", "1"),
            row("est_2", "exact", "1.8952", "3.9"),
            row("est_2", "paper", "9.9", "3.9"),
            row("max_sum", "exact", "9.0423", "11"),
        ];
        let [(_, svg), (_, csv)] = files(&rows);
        assert_eq!(csv.lines().count(), 1 + 1 + 12 + 1);
        assert!(
            csv.contains("cut-in,estimate_fps,2,1.8952,3.9\n") && !csv.contains("9.9"),
            "{csv}"
        );
        assert!(
            csv.contains("cut-in,mrf_fps,,1,1\n")
                && csv.contains("cut-in,largest_sum_fps,,9.0423,11\n")
        );
        assert!(svg.contains("MRF 1 (1), largest sum 9.0 (11)"));
    }
}
