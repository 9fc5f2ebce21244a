//! What all figures have in common: the paper they are drawn on, sizes of letters, and CSV.
//!
//! Sizes are such that letters can be read when a figure is shrunk to half its width.

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, FontStyle};

use crate::palette::GREY;

/// [px] letters of titles.
pub(super) const TITLE: u32 = 22;
/// [px] letters of axes.
pub(super) const AXIS: u32 = 19;
/// [px] letters of ticks, legends and notes.
pub(super) const NOTE: u32 = 17;

pub(super) type Failure = DrawingAreaErrorKind<std::io::Error>;
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// What is drawn on white of this size in pixels, as the text of an SVG file.
pub(super) fn svg(size: (u32, u32), draw: impl FnOnce(&Area<'_>) -> Result<(), Failure>) -> String {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        let drawn = area
            .fill(&WHITE)
            .and_then(|()| draw(&area))
            .and_then(|()| area.present());
        drawn.unwrap_or_else(|error| unreachable!("a text takes every shape: {error}"));
    }
    text
}

/// Letters of a size.
pub(super) fn font<'a>(size: u32) -> FontDesc<'a> {
    FontDesc::new(FontFamily::SansSerif, f64::from(size), FontStyle::Normal)
}

/// Letters of a size and colour that stand on, or around, their point.
pub(super) fn letters<'a>(size: u32, colour: RGBColor, across: HPos, along: VPos) -> TextStyle<'a> {
    font(size).color(&colour).pos(Pos::new(across, along))
}

/// A chart's axes: what they are of, and how their ticks are spelt.
pub(super) struct Axes<'t> {
    /// Below.
    pub x: &'t str,
    /// At the side.
    pub y: &'t str,
    /// How a tick below is spelt.
    pub x_tick: &'t dyn Fn(&f64) -> String,
    /// How a tick at the side is spelt.
    pub y_tick: &'t dyn Fn(&f64) -> String,
    /// About how many ticks.
    pub ticks: (usize, usize),
}

/// Draws axes and a light grid.
pub(super) fn axes(chart: &mut Chart<'_, '_>, axes: &Axes<'_>) -> Result<(), Failure> {
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GREY.mix(0.25))
        .x_desc(axes.x)
        .y_desc(axes.y)
        .x_labels(axes.ticks.0)
        .y_labels(axes.ticks.1)
        .x_label_formatter(axes.x_tick)
        .y_label_formatter(axes.y_tick)
        .label_style(font(NOTE))
        .axis_desc_style(font(AXIS))
        .draw()
}

/// A whole number.
#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "as the axes of a chart ask for it"
)]
pub(super) fn whole(number: &f64) -> String {
    format!("{number:.0}")
}

/// A form to mark points with, one per series.
#[derive(Clone, Copy)]
pub(super) enum Mark {
    Disc,
    Ring,
    Square,
    Triangle,
    Diamond,
    Cross,
}

/// Draws marks at points of a chart.
pub(super) fn marks(
    chart: &mut Chart<'_, '_>,
    points: &[(f64, f64)],
    mark: Mark,
    (size, colour): (i32, RGBColor),
) -> Result<(), Failure> {
    let place = |point: &(f64, f64)| chart.backend_coord(point);
    let places: Vec<(i32, i32)> = points.iter().map(place).collect();
    let area = chart.plotting_area().strip_coord_spec();
    let (left, top) = area.get_base_pixel();
    for (x, y) in places {
        draw_mark(&area, (x - left, y - top), mark, (size, colour))?;
    }
    Ok(())
}

/// Draws one mark at a pixel of an area.
pub(super) fn draw_mark(
    area: &Area<'_>,
    (x, y): (i32, i32),
    mark: Mark,
    (size, colour): (i32, RGBColor),
) -> Result<(), Failure> {
    let full = colour.filled();
    let corners = |corners: &[(i32, i32)]| {
        let at = corners
            .iter()
            .map(|(dx, dy)| (x + dx * size / 4, y + dy * size / 4));
        at.collect::<Vec<_>>()
    };
    match mark {
        Mark::Disc => area.draw(&Circle::new((x, y), size, full)),
        Mark::Ring => {
            area.draw(&Circle::new((x, y), size, WHITE.filled()))?;
            area.draw(&Circle::new((x, y), size, colour.stroke_width(2)))
        }
        Mark::Square => area.draw(&Polygon::new(
            corners(&[(-4, -4), (4, -4), (4, 4), (-4, 4)]),
            full,
        )),
        Mark::Triangle => area.draw(&Polygon::new(corners(&[(-5, 4), (5, 4), (0, -5)]), full)),
        Mark::Diamond => area.draw(&Polygon::new(
            corners(&[(-5, 0), (0, -6), (5, 0), (0, 6)]),
            full,
        )),
        Mark::Cross => {
            let stroke = colour.stroke_width(2);
            area.draw(&PathElement::new(corners(&[(-4, -4), (4, 4)]), stroke))?;
            area.draw(&PathElement::new(corners(&[(-4, 4), (4, -4)]), stroke))
        }
    }
}

/// How a series is drawn.
#[derive(Clone, Copy)]
pub(super) struct Style {
    pub colour: RGBColor,
    pub width: u32,
    /// [px] dash and gap; none: drawn through.
    pub dashes: Option<(u32, u32)>,
}

/// Draws a line through points of a chart.
pub(super) fn line(
    chart: &mut Chart<'_, '_>,
    points: impl IntoIterator<Item = (f64, f64)>,
    style: Style,
) -> Result<(), Failure> {
    let points: Vec<(f64, f64)> = points.into_iter().collect();
    let stroke = style.colour.stroke_width(style.width);
    match style.dashes {
        Some((dash, gap)) => {
            chart.draw_series(DashedLineSeries::new(points, dash, gap, stroke))?;
        }
        None => {
            chart.draw_series(LineSeries::new(points, stroke))?;
        }
    }
    Ok(())
}

/// An entry of a legend: a sample of a line, of a mark or of both, from a pixel of an area on, and the name behind it.
pub(super) fn sample(
    area: &Area<'_>,
    (x, y): (i32, i32),
    name: &str,
    (style, mark): (Option<Style>, Option<(Mark, i32)>),
) -> Result<(), Failure> {
    let colour = style.map_or(GREY, |style| style.colour);
    if let Some(style) = style.filter(|style| style.width > 0) {
        let stroke = colour.stroke_width(style.width);
        let (dash, gap) = style.dashes.map_or((34, 0), |(dash, gap)| {
            (dash.cast_signed(), gap.cast_signed())
        });
        let mut from = 0;
        while from < 34 {
            let to = (from + dash).min(34);
            area.draw(&PathElement::new([(x + from, y), (x + to, y)], stroke))?;
            from = to + gap;
        }
    }
    if let Some((mark, size)) = mark {
        draw_mark(area, (x + 17, y), mark, (size, colour))?;
    }
    let at = (x + 42, y);
    area.draw(&Text::new(
        name.to_string(),
        at,
        letters(NOTE, BLACK, HPos::Left, VPos::Center),
    ))
}

/// Rows of CSV below a header.
pub(super) fn csv(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut written = writer.write_record(header);
    for row in rows {
        written = written.and_then(|()| writer.write_record(&row));
    }
    let bytes = written.ok().and_then(|()| writer.into_inner().ok());
    let text = bytes.and_then(|bytes| String::from_utf8(bytes).ok());
    text.unwrap_or_else(|| unreachable!("a list of bytes takes every row as long as the header"))
}

/// The points at which a line of steps turns: of a stretch of one value the first and the last.
pub(super) fn corners(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let value = |place: usize| points.get(place).map(|(_, value)| *value);
    let turns = |place: &usize| {
        *place == 0 || value(place - 1) != value(*place) || value(place + 1) != value(*place)
    };
    (0..points.len())
        .filter(turns)
        .map(|place| points[place])
        .collect()
}
