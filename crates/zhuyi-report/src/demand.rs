//! The demand on a camera over a run, with and without an option of the estimator.

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use zhuyi_studies::allocate::Feedback;
use zhuyi_studies::beyond::{Comparison, Line};

use crate::palette::{GREY, LINES};

/// Width and height in pixels.
const SIZE: (u32, u32) = (900, 480);

/// [s] how much is shown before the first and after the last demand above the least.
const BORDER: f64 = 1.5;

/// The figures of the comparisons, each with the name of its file.
pub fn figures(comparisons: &[Comparison]) -> Vec<(&'static str, String)> {
    let name = |option: &str| match option {
        "uncertainty" => "figures/beyond-uncertainty.svg",
        "phantom" => "figures/beyond-phantom.svg",
        _ => "figures/beyond-evasion.svg",
    };
    comparisons
        .iter()
        .map(|comparison| (name(comparison.option), figure(comparison)))
        .collect()
}

/// The figure of the literal l_0, with the name of its file.
pub fn feedback(feedback: &Feedback) -> (&'static str, String) {
    (
        "figures/allocation-feedback.svg",
        figure(&feedback.comparison),
    )
}

/// One figure as the text of an SVG file.
pub fn figure(comparison: &Comparison) -> String {
    let mut text = String::new();
    draw(comparison, &mut text)
        .unwrap_or_else(|error| unreachable!("a text takes every shape: {error}"));
    text
}

type Failure = DrawingAreaErrorKind<std::io::Error>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

fn draw(comparison: &Comparison, text: &mut String) -> Result<(), Failure> {
    let Comparison {
        option,
        scenario,
        camera,
        lines,
        marks,
    } = comparison;
    let root = SVGBackend::with_string(text, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (from, to) = window(lines);
    let highest = lines
        .iter()
        .flat_map(|line| &line.points)
        .map(|(_, fpr)| *fpr)
        .fold(4.0, f64::max);
    // Room for the legend above the lines.
    let top = highest * 1.3;
    let of = match *option {
        "feedback" => "l_0 fixed and literal".to_string(),
        option => format!("option {option}"),
    };
    let title = format!("{scenario}: demand on {camera}, {of}");
    let mut chart = ChartBuilder::on(&root)
        .caption(title, ("sans-serif", 20))
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(58)
        .build_cartesian_2d(from..to, 0.0..top)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GREY.mix(0.25))
        .x_desc("time [s]")
        .y_desc("demand [FPR]")
        .x_label_formatter(&|time| format!("{time:.0}"))
        .y_label_formatter(&|fpr| format!("{fpr:.0}"))
        .label_style(("sans-serif", 15))
        .axis_desc_style(("sans-serif", 16))
        .draw()?;
    for (time, what) in marks {
        mark(&mut chart, *time, what, (from, to, top))?;
    }
    for (place, line) in lines.iter().enumerate() {
        add(&mut chart, place, line)?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE)
        .border_style(GREY.mix(0.5))
        .label_font(("sans-serif", 15))
        .draw()?;
    root.present()
}

/// A line, later ones thinner, so that equal parts show both colours.
fn add(chart: &mut Chart<'_, '_>, place: usize, line: &Line) -> Result<(), Failure> {
    let colour = LINES[place % LINES.len()];
    let style = colour.stroke_width(4 - (place as u32).min(3));
    chart
        .draw_series(LineSeries::new(corners(&line.points), style))?
        .label(line.name)
        .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], style));
    Ok(())
}

/// An instant, as a line from top to bottom with its name at the upper end.
fn mark(
    chart: &mut Chart<'_, '_>,
    time: f64,
    what: &str,
    (from, to, top): (f64, f64, f64),
) -> Result<(), Failure> {
    let dashes = DashedLineSeries::new([(time, 0.0), (time, top)], 6, 4, GREY.stroke_width(2));
    chart.draw_series(dashes)?;
    let at = (time + (to - from) * 0.008, top * 0.985);
    let style = ("sans-serif", 15).into_font().color(&GREY);
    chart.draw_series([Text::new(what.to_string(), at, style)])?;
    Ok(())
}

/// From when to when any line is above the least demand, with a border.
fn window(lines: &[Line]) -> (f64, f64) {
    let all = || lines.iter().flat_map(|line| &line.points);
    let times = |above: f64| {
        let times = all().filter(move |(_, fpr)| *fpr > above);
        times.map(|(time, _)| *time)
    };
    let (first, last) = (
        times(0.0).fold(f64::INFINITY, f64::min),
        times(0.0).fold(0.0, f64::max),
    );
    let begin = times(1.01).fold(f64::INFINITY, f64::min) - BORDER;
    let end = times(1.01).fold(0.0, f64::max) + BORDER;
    if begin < end {
        (begin.max(first), end.min(last))
    } else {
        (first.min(last), last)
    }
}

/// The points at which a line turns: of a stretch of one value the first and the last.
fn corners(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let turns = |place: usize| {
        let value = |place: usize| points.get(place).map(|(_, fpr)| *fpr);
        let here = value(place);
        place == 0 || value(place - 1) != here || value(place + 1) != here
    };
    let places = (0..points.len()).filter(|place| turns(*place));
    places.map(|place| points[place]).collect()
}

#[cfg(test)]
mod tests {
    use super::{corners, figure, window};
    use zhuyi_studies::beyond::{Comparison, Line};

    fn line(fpr: &[f64]) -> Line {
        let points = fpr.iter().enumerate();
        Line {
            name: "paper",
            points: points.map(|(i, fpr)| (i as f64, *fpr)).collect(),
        }
    }

    #[test]
    fn hand_a_stretch_of_one_value_is_its_ends() {
        let line = line(&[1.0, 1.0, 1.0, 4.0, 4.0, 2.0]);
        let kept: Vec<f64> = corners(&line.points)
            .iter()
            .map(|(time, _)| *time)
            .collect();
        assert_eq!(kept, [0.0, 2.0, 3.0, 4.0, 5.0]);
    }

    #[test]
    fn hand_only_what_is_asked_for_is_shown() {
        let mut quiet = vec![1.0; 20];
        assert_eq!(window(&[line(&quiet)]), (0.0, 19.0));
        quiet[8] = 3.0;
        assert_eq!(window(&[line(&quiet)]), (6.5, 9.5));
    }

    #[test]
    fn hand_a_figure_has_its_axes_and_its_legend() {
        let text = figure(&Comparison {
            option: "phantom",
            scenario: "cut-out".into(),
            camera: "front_120".into(),
            lines: vec![line(&[1.0, 5.0, 1.0])],
            marks: vec![(1.0, "obstacle in sight")],
        });
        for words in [
            "time [s]",
            "demand [FPR]",
            "cut-out: demand on front_120",
            "paper",
            "obstacle in sight",
        ] {
            assert!(text.contains(words), "{words}");
        }
        assert!(text.trim_end().ends_with("</svg>"));
    }
}
