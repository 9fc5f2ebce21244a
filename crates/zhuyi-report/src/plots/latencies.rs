//! What each analysed camera may take over a run, above the ego's acceleration (claim 5).

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_core::camera::FULL_RATE;
use zhuyi_studies::claims::run::course::{Course, SHOWN};

use super::File;
use super::sheet::{
    Area, Axes, Failure, Mark, NOTE, Style, TITLE, axes, corners, csv, font, letters, line, marks,
    sample, svg, whole,
};
use crate::palette::{BLACK, BLUE, GREY, VERMILION};

/// [s] how much is shown before the first and after the last step with something to see.
const BORDER: f64 = 2.0;

const STYLES: [Style; 3] = [
    Style {
        colour: BLACK,
        width: 3,
        dashes: None,
    },
    Style {
        colour: VERMILION,
        width: 3,
        dashes: Some((12, 6)),
    },
    Style {
        colour: BLUE,
        width: 3,
        dashes: Some((3, 5)),
    },
];

/// The figure of a scenario and its CSV; none of a scenario that has no such figure.
pub fn files(course: &Course) -> Option<[File; 2]> {
    let names = [
        (
            "figures/latency-cut-out-fast.svg",
            "figures/latency-cut-out-fast.csv",
        ),
        (
            "figures/latency-challenging-cut-in-curved.svg",
            "figures/latency-challenging-cut-in-curved.csv",
        ),
        ("figures/latency-cut-in.svg", "figures/latency-cut-in.csv"),
    ];
    let place = SHOWN.iter().position(|shown| *shown == course.scenario)?;
    let (svg_name, csv_name) = names[place];
    let drawn = svg((900, 700), |area| draw(course, area));
    Some([(svg_name, drawn), (csv_name, table(course))])
}

fn table(course: &Course) -> String {
    let mut header = vec!["time_s".to_string(), "ego_accel_mps2".to_string()];
    header.extend(
        course
            .cameras
            .iter()
            .map(|camera| format!("{camera}_latency_ms")),
    );
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let row = |step: &zhuyi_studies::claims::run::course::Step| {
        let mut row = vec![format!("{:.2}", step.time), format!("{:.4}", step.accel)];
        row.extend(
            step.latencies
                .iter()
                .map(|latency| format!("{:.0}", 1e3 * latency)),
        );
        row
    };
    csv(&header, course.steps.iter().map(row))
}

/// From when to when there is something to see.
fn window(course: &Course) -> (f64, f64) {
    let busy = course.steps.iter().filter(|step| {
        step.accel.abs() > 0.2 || step.latencies.iter().any(|latency| *latency < 1.0)
    });
    let mut times = busy.map(|step| step.time);
    let last = course.steps.last().map_or(1.0, |step| step.time);
    match (times.next(), times.next_back()) {
        (Some(from), Some(to)) => ((from - BORDER).max(0.0), (to + BORDER).min(last)),
        _ => (0.0, last),
    }
}

fn draw(course: &Course, area: &Area<'_>) -> Result<(), Failure> {
    let (from, to) = window(course);
    let (above, below) = area.split_vertically(420);
    let title = format!(
        "{}: what each camera tolerates, at {} FPR",
        course.scenario, course.rate
    );
    let mut chart = ChartBuilder::on(&above)
        .caption(title, font(TITLE))
        .margin(14)
        .margin_right(24)
        .margin_bottom(36)
        .x_label_area_size(30)
        .y_label_area_size(80)
        .build_cartesian_2d(from..to, 0.0..1100.0)?;
    axes(
        &mut chart,
        &Axes {
            x: "",
            y: "tolerable latency [ms]",
            x_tick: &whole,
            y_tick: &whole,
            ticks: (10, 6),
        },
    )?;
    // Later ones are drawn beneath the first, so that none hides the front camera.
    for (camera, style) in STYLES.iter().enumerate().take(course.cameras.len()).rev() {
        let points = course
            .steps
            .iter()
            .map(|step| (step.time, 1e3 * step.latencies[camera]));
        let shown: Vec<_> = points
            .filter(|(time, _)| (from..=to).contains(time))
            .collect();
        line(&mut chart, corners(&shown), *style)?;
    }
    for ((place, camera), style) in (0..).zip(&course.cameras).zip(STYLES) {
        let at = (110 + 190 * place, 402);
        sample(area, at, camera, (Some(style), None))?;
    }
    let mut accel = ChartBuilder::on(&below)
        .margin(14)
        .margin_right(24)
        .x_label_area_size(56)
        .y_label_area_size(80)
        .build_cartesian_2d(from..to, lowest(course)..2.0)?;
    axes(
        &mut accel,
        &Axes {
            x: "time [s]",
            y: "ego accel. [m/s²]",
            x_tick: &whole,
            y_tick: &whole,
            ticks: (10, 5),
        },
    )?;
    let points = course.steps.iter().map(|step| (step.time, step.accel));
    let shown = points.filter(|(time, _)| (from..=to).contains(time));
    line(&mut accel, shown, STYLES[0])?;
    told(course, &mut chart, &mut accel, (from, to))
}

/// [m/s2] where the axis of the acceleration begins.
fn lowest(course: &Course) -> f64 {
    let accels = course.steps.iter().map(|step| step.accel);
    accels.fold(-2.0, f64::min).floor() - 1.0
}

/// Marks the peak of the first camera and the hardest braking.
fn told(
    course: &Course,
    chart: &mut super::sheet::Chart<'_, '_>,
    accel: &mut super::sheet::Chart<'_, '_>,
    (from, to): (f64, f64),
) -> Result<(), Failure> {
    let (Some(peak), Some((time, hardest))) = (course.peak(0), course.hardest_braking()) else {
        return Ok(());
    };
    // Beside the mark, on the side with more room.
    let beside = |time: f64| {
        let aside = (to - from) * 0.015;
        if time - from < to - time {
            (time + aside, HPos::Left)
        } else {
            (time - aside, HPos::Right)
        }
    };
    let point = (peak.last, 1e3 * peak.latency);
    marks(chart, &[point], Mark::Disc, (6, BLACK))?;
    let text = format!(
        "{:.0} ms, {:.1} FPR at {:.1} s",
        point.1,
        (1.0 / peak.latency).min(FULL_RATE),
        peak.last
    );
    let (x, across) = beside(peak.last);
    chart.draw_series([Text::new(
        text,
        (x, 40.0),
        letters(NOTE, BLACK, across, VPos::Center),
    )])?;
    marks(accel, &[(time, hardest)], Mark::Diamond, (6, VERMILION))?;
    let text = format!("hardest: {hardest:.1} m/s² at {time:.1} s");
    let (x, across) = beside(time);
    let at = (x, hardest - 0.5);
    accel.draw_series([Text::new(
        text,
        at,
        letters(NOTE, BLACK, across, VPos::Center),
    )])?;
    let dashes = Style {
        colour: GREY,
        width: 2,
        dashes: Some((4, 4)),
    };
    line(
        accel,
        [(peak.last, lowest(course)), (peak.last, 2.0)],
        dashes,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use zhuyi_studies::claims::run::course::Step;

    #[test]
    fn hand_the_csv_has_every_step() {
        let step = |i: i32, front: f64| Step {
            time: f64::from(i) / 100.0,
            accel: -0.5,
            latencies: vec![front, 1.0, 1.0],
        };
        let course = Course {
            scenario: "cut-in".into(),
            rate: 30,
            seed: 0,
            cameras: ["front_120", "left", "right"].map(String::from).to_vec(),
            steps: vec![step(0, 1.0), step(1, 0.175)],
            evaluations: 1,
            actors: 1,
        };
        let [(_, svg), (name, csv)] = files(&course).unwrap();
        assert_eq!(name, "figures/latency-cut-in.csv");
        assert_eq!(
            csv,
            "time_s,ego_accel_mps2,front_120_latency_ms,left_latency_ms,right_latency_ms\n\
             0.00,-0.5000,1000,1000,1000\n0.01,-0.5000,175,1000,1000\n"
        );
        for words in [
            "tolerable latency [ms]",
            "time [s]",
            "175 ms, 5.7 FPR at 0.0 s",
            "right",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(
            files(&Course {
                scenario: "cut-out".into(),
                ..course
            })
            .is_none()
        );
    }
}
