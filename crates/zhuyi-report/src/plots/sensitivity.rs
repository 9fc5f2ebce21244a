//! What is asked for by the ego's speed and the actor's end speed, with the distance held (claim 6).

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_estimator::State;
use zhuyi_studies::claims::run::sensitivity::{Cell, FASTEST, Map, STEP, speeds};

use super::File;
use super::sheet::{AXIS, Area, Axes, Failure, NOTE, axes, csv, font, letters, svg, whole};
use crate::palette::{BLACK, GREY, RAMP};

/// [FPR] up to where the classes of the ramp go.
const CLASSES: [f64; 6] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0];

/// The figure and its CSV.
pub fn files(maps: &[Map]) -> [File; 2] {
    let header = [
        "s_n_m",
        "confirm_frames",
        "v_e0_mph",
        "v_an_mph",
        "fpr",
        "state",
    ];
    let row = |map: &Map, cell: &Cell| {
        vec![
            format!("{:.0}", map.distance),
            map.confirm_frames.to_string(),
            cell.ego.to_string(),
            cell.actor.to_string(),
            cell.fpr.map_or(String::new(), |fpr| format!("{fpr:.4}")),
            cell.state.name().to_string(),
        ]
    };
    let rows = maps
        .iter()
        .flat_map(|map| map.cells.iter().map(|cell| row(map, cell)));
    [
        (
            "figures/sensitivity.svg",
            svg((1000, 1010), |area| draw(maps, area)),
        ),
        ("figures/sensitivity.csv", csv(&header, rows)),
    ]
}

/// The colour of a cell: white where nothing helps, grey where the grid ends.
fn colour(cell: &Cell) -> RGBColor {
    match (cell.state, cell.fpr) {
        (State::Unavoidable, _) => WHITE,
        (_, Some(fpr)) => {
            let class = CLASSES.iter().position(|most| fpr <= *most + 1e-9);
            RAMP[class.unwrap_or(RAMP.len() - 1)]
        }
        (_, None) => GREY,
    }
}

fn draw(maps: &[Map], area: &Area<'_>) -> Result<(), Failure> {
    let (panels, legend) = area.split_vertically(920);
    for (panel, map) in panels.split_evenly((2, 2)).iter().zip(maps) {
        draw_map(map, panel)?;
    }
    draw_legend(&legend)
}

fn draw_map(map: &Map, area: &Area<'_>) -> Result<(), Failure> {
    let delay = match map.confirm_frames {
        0 => "without confirmation delay".to_string(),
        frames => format!("with confirmation delay, K = {frames}"),
    };
    let half = STEP / 2.0;
    let range = -half..FASTEST + half;
    let mut chart = ChartBuilder::on(area)
        .caption(format!("s_n = {:.0} m, {delay}", map.distance), font(AXIS))
        .margin(10)
        .margin_right(20)
        .x_label_area_size(56)
        .y_label_area_size(70)
        .build_cartesian_2d(range.clone(), range)?;
    axes(
        &mut chart,
        &Axes {
            x: "ego's speed v_e0 [mph]",
            y: "actor's end speed v_an [mph]",
            x_tick: &whole,
            y_tick: &whole,
            ticks: (8, 8),
        },
    )?;
    let columns = map.cells.chunks(speeds().len());
    // Neighbours of one colour as one rectangle: no seams, and a small file.
    let runs = columns.flat_map(|column| column.chunk_by(|a, b| colour(a) == colour(b)));
    chart.draw_series(runs.filter_map(|run| {
        let (first, last) = (run.first()?, run.last()?);
        let corners = [
            (first.ego - half, first.actor - half),
            (first.ego + half, last.actor + half),
        ];
        Some(Rectangle::new(corners, colour(first).filled()))
    }))?;
    let unavoidable = |cell: &&Cell| cell.state == State::Unavoidable && cell.actor == 0.0;
    if let Some(from) = map.cells.iter().find(unavoidable) {
        let middle = f64::midpoint(from.ego, FASTEST);
        if FASTEST - from.ego > 20.0 {
            let style = letters(NOTE, BLACK, HPos::Center, VPos::Center);
            chart.draw_series([Text::new(
                "unavoidable".to_string(),
                (middle + 3.0, 8.0),
                style,
            )])?;
        }
    }
    Ok(())
}

fn draw_legend(area: &Area<'_>) -> Result<(), Failure> {
    let mut from = 0.0;
    let mut names = Vec::new();
    for most in CLASSES {
        names.push(if from == 0.0 {
            format!("{most:.0}")
        } else {
            format!("to {most:.0}")
        });
        from = most;
    }
    names.extend(["> 30".to_string(), "unavoidable".to_string()]);
    let colours = RAMP.into_iter().chain([GREY, WHITE]);
    area.draw(&Text::new(
        "FPR asked for:",
        (30, 30),
        letters(AXIS, BLACK, HPos::Left, VPos::Center),
    ))?;
    for (place, (name, colour)) in (0..).zip(names.into_iter().zip(colours)) {
        let x = 175 + 98 * place;
        let frame = [(x, 18), (x + 28, 42)];
        area.draw(&Rectangle::new(frame, colour.filled()))?;
        area.draw(&Rectangle::new(frame, BLACK.stroke_width(1)))?;
        area.draw(&Text::new(
            name,
            (x + 36, 30),
            letters(NOTE, BLACK, HPos::Left, VPos::Center),
        ))?;
    }
    let note = "confirmation delay K (l - l_0) with l_0 = 1/30 s; C1 = C2 = 0.9, C3 = 4.9 m/s²; cells 2.5 mph apart";
    area.draw(&Text::new(
        note.to_string(),
        (30, 66),
        letters(NOTE, BLACK, HPos::Left, VPos::Center),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use zhuyi_estimator::{Estimator, Params};
    use zhuyi_studies::claims::run::sensitivity::maps;

    /// Without the delay 65 mph towards a standing car at 100 m need 9.2 FPR (0.109 s), with it 23.3 (0.043 s).
    #[test]
    fn hand_the_csv_has_every_cell() {
        let [(_, svg), (_, csv)] = files(&maps(&Estimator::new(Params::default())));
        assert_eq!(csv.lines().count(), 1 + 4 * 29 * 29);
        for line in [
            "100,0,65,0,9.1743,tolerable",
            "100,5,65,0,23.2558,tolerable",
            "100,5,70,0,,unavoidable",
            "30,5,25,0,4.8077,tolerable",
        ] {
            assert!(csv.lines().any(|row| row == line), "{line}");
        }
        assert!(
            svg.contains("s_n = 30 m, with confirmation delay, K = 5")
                && svg.contains("v_e0 [mph]")
        );
    }
}
