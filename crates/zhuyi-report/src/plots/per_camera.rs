//! The slowest safe rates of each camera beside the MRF of all cameras at the same rate: the Pareto frontier of the rates.
//!
//! A frontier of one point is one mark per camera. One of several is all of them, joined by a line: the rates between which one
//! camera trades with another.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_studies::committed::Slowest;

use super::File;
use super::sheet::{
    AXIS, Area, Chart, Failure, Mark, NOTE, Style, TITLE, csv, font, letters, line, marks, sample,
    svg, whole,
};
use crate::palette::{BLACK, BLUE, GREY, VERMILION};

const LOOKS: [(RGBColor, Mark); 3] = [
    (BLACK, Mark::Disc),
    (VERMILION, Mark::Triangle),
    (BLUE, Mark::Square),
];

/// The figure and its CSV.
pub fn files(all: &[Slowest]) -> [File; 2] {
    let header = [
        "scenario",
        "mrf_fps",
        "combination",
        "camera",
        "rate_fps",
        "sum_fps",
        "sum_at_mrf_fps",
    ];
    let rows = |one: &Slowest| -> Vec<Vec<String>> {
        let mrf = |factor: u32| {
            one.mrf
                .map_or(String::new(), |mrf| (factor * mrf).to_string())
        };
        let cameras = one.cameras.len() as u32;
        let of = |(place, rates): (usize, &Vec<u32>)| -> Vec<Vec<String>> {
            let sum: u32 = rates.iter().sum();
            let row = |(camera, rate): (&String, &u32)| {
                let place = (place + 1).to_string();
                let (rate, sum) = (rate.to_string(), sum.to_string());
                vec![
                    one.scenario.clone(),
                    mrf(1),
                    place,
                    camera.clone(),
                    rate,
                    sum,
                    mrf(cameras),
                ]
            };
            one.cameras.iter().zip(rates).map(row).collect()
        };
        one.frontier.iter().enumerate().flat_map(of).collect()
    };
    [
        (
            "figures/frontier.svg",
            svg((1000, 700), |area| draw(all, area)),
        ),
        (
            "figures/frontier.csv",
            csv(&header, all.iter().flat_map(rows)),
        ),
    ]
}

fn draw(all: &[Slowest], area: &Area<'_>) -> Result<(), Failure> {
    let rates = all
        .iter()
        .flat_map(|one| one.frontier.iter().flatten().copied().chain(one.mrf));
    let most = f64::from(rates.max().unwrap_or(1));
    let rows = all.len() as f64;
    let mut chart = ChartBuilder::on(area)
        .caption(
            "How slow each camera may be: the slowest safe rates",
            font(TITLE),
        )
        .margin(14)
        .margin_left(240)
        .margin_right(230)
        .margin_bottom(62)
        .x_label_area_size(56)
        .y_label_area_size(6)
        .build_cartesian_2d(0.0..most + 0.5, 0.0..rows)?;
    chart
        .configure_mesh()
        .disable_y_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GREY.mix(0.25))
        .x_desc("frame processing rate [FPR]")
        .x_labels(most as usize + 2)
        .y_labels(0)
        .x_label_formatter(&whole)
        .label_style(font(NOTE))
        .axis_desc_style(font(AXIS))
        .draw()?;
    for (place, one) in all.iter().enumerate() {
        let middle = rows - place as f64 - 0.5;
        draw_row(one, middle, &mut chart)?;
        let (_, y) = chart.backend_coord(&(0.0, middle));
        let style = |across| letters(NOTE, BLACK, across, VPos::Center);
        area.draw(&Text::new(
            one.scenario.clone(),
            (232, y),
            style(HPos::Right),
        ))?;
        area.draw(&Text::new(cost(one), (786, y), style(HPos::Left)))?;
    }
    let style = letters(NOTE, BLACK, HPos::Left, VPos::Center);
    area.draw(&Text::new(
        "sum of the rates [FPR]".to_string(),
        (786, 598),
        style,
    ))?;
    let cameras = all.first().map_or(&[][..], |one| &one.cameras);
    for (place, (camera, (colour, mark))) in (0..).zip(cameras.iter().zip(LOOKS)) {
        let style = Style {
            colour,
            width: 0,
            dashes: None,
        };
        sample(
            area,
            (150 + 170 * place, 664),
            camera,
            (Some(style), Some((mark, 7))),
        )?;
    }
    let grey = Style {
        colour: GREY,
        width: 3,
        dashes: None,
    };
    sample(
        area,
        (660, 664),
        "MRF, the same rate on all",
        (Some(grey), None),
    )
}

/// The marks of one scenario: cameras one above the other, the MRF behind them.
fn draw_row(one: &Slowest, middle: f64, chart: &mut Chart<'_, '_>) -> Result<(), Failure> {
    if let Some(mrf) = one.mrf.map(f64::from) {
        let style = Style {
            colour: GREY,
            width: 3,
            dashes: None,
        };
        line(chart, [(mrf, middle - 0.42), (mrf, middle + 0.42)], style)?;
    }
    for (camera, (colour, mark)) in LOOKS.into_iter().enumerate().take(one.cameras.len()) {
        let y = middle + 0.25 * (1.0 - camera as f64);
        let points: Vec<(f64, f64)> = one
            .frontier
            .iter()
            .map(|rates| (f64::from(rates[camera]), y))
            .collect();
        line(
            chart,
            points.iter().copied(),
            Style {
                colour,
                width: 1,
                dashes: None,
            },
        )?;
        marks(chart, &points, mark, (6, colour))?;
    }
    Ok(())
}

/// The cheapest combination, and what the MRF on all cameras takes.
fn cost(one: &Slowest) -> String {
    let sums = one.frontier.iter().map(|rates| rates.iter().sum::<u32>());
    match (sums.min(), one.mrf) {
        (Some(sum), Some(mrf)) => {
            let same = mrf * one.cameras.len() as u32;
            let less = if sum < same { "instead of" } else { "as with" };
            format!("{sum}, {less} {same}")
        }
        _ => "no safe rate".to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_each_camera_of_each_combination_is_a_row() {
        let one = Slowest {
            scenario: "cut-out-fast".into(),
            cameras: ["front_120", "left", "right"].map(String::from).to_vec(),
            mrf: Some(6),
            frontier: vec![vec![6, 1, 1]],
        };
        let none = Slowest {
            scenario: "cut-in".into(),
            mrf: None,
            frontier: Vec::new(),
            ..one.clone()
        };
        let [(_, svg), (_, csv)] = files(&[one, none]);
        assert_eq!(csv.lines().count(), 4);
        assert!(csv.contains("cut-out-fast,6,1,front_120,6,8,18\n"), "{csv}");
        assert!(
            svg.contains("8, instead of 18")
                && svg.contains("no safe rate")
                && svg.contains("[FPR]")
        );
    }
}
