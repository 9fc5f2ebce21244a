//! What the cameras of a car ask of its chip, by their rate, against what chips offer (claim 9).

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_core::camera::FULL_RATE;
use zhuyi_studies::claims::run::throughput::{
    CAMERAS, CHIPS, FRAME, FURTHER_MODELS, affordable, demand,
};

use super::File;
use super::sheet::{
    Area, Axes, Failure, Mark, NOTE, Style, TITLE, axes, csv, font, letters, line, marks, svg,
    whole,
};
use crate::palette::{BLACK, BLUE, GREEN, VERMILION};

/// The figure and its CSV.
pub fn files() -> [File; 2] {
    let rates = (0..=FULL_RATE as u32).map(f64::from);
    let row = |rate: f64| {
        let mut row = vec![format!("{rate:.0}")];
        row.extend([true, false].map(|further| format!("{:.3}", demand(rate, further))));
        row.extend(CHIPS.map(|(_, tops)| format!("{tops:.0}")));
        row
    };
    let header = [
        "rate_fps",
        "all_models_tops",
        "detector_alone_tops",
        "xavier_tops",
        "orin_tops",
    ];
    [
        ("figures/throughput.svg", svg((900, 560), draw)),
        ("figures/throughput.csv", csv(&header, rates.map(row))),
    ]
}

fn draw(area: &Area<'_>) -> Result<(), Failure> {
    let top = 300.0;
    let mut chart = ChartBuilder::on(area)
        .caption(
            format!("Detection on {CAMERAS} cameras against one chip"),
            font(TITLE),
        )
        .margin(14)
        .margin_right(24)
        .margin_bottom(64)
        .x_label_area_size(56)
        .y_label_area_size(74)
        .build_cartesian_2d(0.0..FULL_RATE, 0.0..top)?;
    axes(
        &mut chart,
        &Axes {
            x: "frame processing rate of every camera [FPR]",
            y: "throughput [TOPS]",
            x_tick: &whole,
            y_tick: &whole,
            ticks: (7, 7),
        },
    )?;
    let colours = [VERMILION, BLUE];
    for ((name, tops), colour) in CHIPS.into_iter().zip(colours) {
        let style = Style {
            colour,
            width: 3,
            dashes: Some((12, 6)),
        };
        line(&mut chart, [(0.0, tops), (FULL_RATE, tops)], style)?;
        let spent = affordable(tops);
        let note = if spent < FULL_RATE {
            marks(&mut chart, &[(spent, tops)], Mark::Disc, (6, colour))?;
            format!("one {name} offers {tops:.0}: spent at {spent:.1} FPR")
        } else {
            format!("one {name} offers {tops:.0}")
        };
        // Above the line of the demand on the left, below it on the right.
        let (x, across, y, along) = if spent < FULL_RATE {
            (FULL_RATE * 0.99, HPos::Right, tops - 4.0, VPos::Top)
        } else {
            (FULL_RATE * 0.01, HPos::Left, tops - 4.0, VPos::Top)
        };
        let text = Text::new(note, (x, y), letters(NOTE, colour, across, along));
        chart.draw_series([text])?;
    }
    for (further, style) in [
        (
            true,
            Style {
                colour: BLACK,
                width: 3,
                dashes: None,
            },
        ),
        (
            false,
            Style {
                colour: GREEN,
                width: 3,
                dashes: Some((4, 4)),
            },
        ),
    ] {
        line(
            &mut chart,
            [0.0, FULL_RATE].map(|rate| (rate, demand(rate, further))),
            style,
        )?;
    }
    let full = demand(FULL_RATE, true);
    marks(&mut chart, &[(FULL_RATE, full)], Mark::Disc, (6, BLACK))?;
    let above = format!("with further models: {full:.0} TOPS at {FULL_RATE:.0} FPR");
    let below = format!("the detector alone: {:.0}", demand(FULL_RATE, false));
    let style = letters(NOTE, BLACK, HPos::Right, VPos::Bottom);
    chart.draw_series([Text::new(above, (27.5, demand(27.5, true) + 16.0), style)])?;
    let style = letters(NOTE, GREEN, HPos::Left, VPos::Top);
    chart.draw_series([Text::new(below, (21.2, demand(21.0, false) - 8.0), style)])?;
    let assumed = format!(
        "{:.0} GOP a frame (SSD-Large, 1200 x 1200, MLPerf) x {:.1} for further models x {CAMERAS} cameras x FPR;",
        FRAME / 1e9,
        1.0 + FURTHER_MODELS
    );
    let shown = CHIPS.map(|(name, tops)| format!("{:.1} times one {name}", full / tops));
    let shown = format!(
        "at {FULL_RATE:.0} FPR {} (nominal figures of the maker)",
        shown.join(", ")
    );
    for (text, y) in [(assumed, 510), (shown, 533)] {
        area.draw(&Text::new(
            text,
            (88, y),
            letters(NOTE, BLACK, HPos::Left, VPos::Top),
        ))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #[test]
    fn paper_the_last_row_is_187_tops() {
        let [(_, svg), (_, csv)] = super::files();
        assert!(csv.ends_with("30,187.056,155.880,30,275\n"), "{csv}");
        assert!(svg.contains("187 TOPS at 30 FPR") && svg.contains("throughput [TOPS]"));
    }
}
