//! Maps of the frame rate and another factor: a panel per scenario, in each cell how many drives collided.
//!
//! The darker, the more; a white cell had no collision. The line is the border of what is required: from it on upwards in the rate
//! no tested rate collides.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use zhuyi_batch::shares::Share;
use zhuyi_studies::maps::{Map, Row};

use super::sheet::{AXIS, Area, Failure, NOTE, TITLE, font, letters, svg};
use crate::palette::{BLACK, RAMP, VERMILION};

/// [px] a cell.
const CELL: (i32, i32) = (40, 24);
/// [px] what stands left of and above the cells of a panel.
const MARGIN: (i32, i32) = (96, 44);
/// [px] below them.
const BELOW: i32 = 58;
/// Panels beside each other.
const COLUMNS: usize = 3;

/// [px] what so many of a size take.
fn px(size: i32, count: usize) -> i32 {
    i32::try_from(count).map_or(i32::MAX, |count| size * count)
}

/// The picture of the maps of one choice.
pub fn figure(maps: &[Map]) -> String {
    let cells = |map: &Map| {
        (
            map.rows.first().map_or(0, |row| row.shares.len()),
            map.rows.len(),
        )
    };
    let (across, along) = maps.first().map_or((0, 0), cells);
    let panel = (
        MARGIN.0 + px(CELL.0, across) + 24,
        MARGIN.1 + px(CELL.1, along) + BELOW,
    );
    let columns = maps.len().min(COLUMNS);
    let lines = maps.len().div_ceil(COLUMNS);
    let size = (px(panel.0, columns), px(panel.1, lines) + 40);
    svg((size.0.cast_unsigned(), size.1.cast_unsigned()), |area| {
        for (place, map) in maps.iter().enumerate() {
            let corner = (px(panel.0, place % COLUMNS), px(panel.1, place / COLUMNS));
            draw(map, area, corner)?;
        }
        let cell = maps
            .first()
            .and_then(|map| map.rows.first()?.shares.first());
        let drives = cell.map_or(0, |share| share.drives);
        let note = format!(
            "number in a cell: of {drives} drives so many collided; white: none; line: the MRF"
        );
        let at = (16, px(panel.1, lines) + 18);
        area.draw(&Text::new(
            note,
            at,
            letters(NOTE, BLACK, HPos::Left, VPos::Center),
        ))
    })
}

fn draw(map: &Map, area: &Area<'_>, (left, top): (i32, i32)) -> Result<(), Failure> {
    let (x, y) = (left + MARGIN.0, top + MARGIN.1);
    let text = |text: &str, at: (i32, i32), (size, across): (u32, HPos)| {
        area.draw(&Text::new(
            text.to_string(),
            at,
            letters(size, BLACK, across, VPos::Center),
        ))
    };
    text(&map.scenario, (x, top + 22), (TITLE, HPos::Left))?;
    let cells = map.rows.first().map_or(0, |row| row.shares.len());
    draw_grid(area, (x, y), (cells, map.rows.len()))?;
    // The first value below, as on an axis.
    for (line, row) in (0..).zip(map.rows.iter().rev()) {
        let middle = y + CELL.1 * line + CELL.1 / 2;
        text(&row.value, (x - 8, middle), (NOTE, HPos::Right))?;
        for (column, share) in (0..).zip(&row.shares) {
            draw_cell(share, area, (x + CELL.0 * column, y + CELL.1 * line))?;
        }
        draw_border(map, row, area, (x, y + CELL.1 * line))?;
    }
    let bottom = y + px(CELL.1, map.rows.len());
    if let Some(row) = map.rows.first() {
        for (column, share) in (0..).zip(&row.shares) {
            let middle = x + CELL.0 * column + CELL.0 / 2;
            text(
                &share.rate.to_string(),
                (middle, bottom + 14),
                (NOTE, HPos::Center),
            )?;
        }
        let middle = x + px(CELL.0, row.shares.len()) / 2;
        text(
            "FPR of all cameras",
            (middle, bottom + 36),
            (AXIS, HPos::Center),
        )?;
    }
    let leaf = map.path.rsplit('.').next().unwrap_or(&map.path);
    let turned = font(AXIS).transform(FontTransform::Rotate270);
    let along = i32::midpoint(y, bottom);
    let style = turned
        .color(&BLACK)
        .pos(plotters::style::text_anchor::Pos::new(
            HPos::Center,
            VPos::Center,
        ));
    area.draw(&Text::new(leaf.to_string(), (left + 18, along), style))
}

fn draw_cell(share: &Share, area: &Area<'_>, (x, y): (i32, i32)) -> Result<(), Failure> {
    if share.collided == 0 {
        return Ok(());
    }
    let corners = [(x + 1, y + 1), (x + CELL.0, y + CELL.1)];
    area.draw(&Rectangle::new(corners, colour(share).filled()))?;
    let ink = if share.share() > 0.45 { WHITE } else { BLACK };
    let middle = (x + CELL.0 / 2, y + CELL.1 / 2);
    area.draw(&Text::new(
        share.collided.to_string(),
        middle,
        letters(NOTE, ink, HPos::Center, VPos::Center),
    ))
}

/// The lines between cells.
fn draw_grid(
    area: &Area<'_>,
    (x, y): (i32, i32),
    (across, along): (usize, usize),
) -> Result<(), Failure> {
    let (right, bottom) = (x + px(CELL.0, across), y + px(CELL.1, along));
    let line = |from: (i32, i32), to: (i32, i32)| {
        area.draw(&PathElement::new(
            [from, to],
            BLACK.mix(0.25).stroke_width(1),
        ))
    };
    (0..=across).try_for_each(|place| {
        let x = x + px(CELL.0, place);
        line((x, y), (x, bottom))
    })?;
    (0..=along).try_for_each(|place| {
        let y = y + px(CELL.1, place);
        line((x, y), (right, y))
    })
}

/// The ramp in equal steps.
fn colour(share: &Share) -> RGBColor {
    let step = (share.share() * RAMP.len() as f64).ceil() as usize;
    RAMP[step.clamp(1, RAMP.len()) - 1]
}

/// Before the first rate from which on nothing collides, and to the row above it.
fn draw_border(map: &Map, row: &Row, area: &Area<'_>, (x, y): (i32, i32)) -> Result<(), Failure> {
    let at = |row: &Row| x + px(CELL.0, safe_from(row));
    let here = at(row);
    let mut points = vec![(here, y + CELL.1), (here, y)];
    let place = map.rows.iter().position(|other| std::ptr::eq(other, row));
    let above = place.and_then(|place| map.rows.get(place + 1));
    points.extend(above.map(|above| (at(above), y)));
    area.draw(&PathElement::new(points, VERMILION.stroke_width(3)))
}

/// How many of the lowest rates are below the MRF.
fn safe_from(row: &Row) -> usize {
    let last = row.shares.iter().rposition(|share| share.collided > 0);
    last.map_or(0, |last| last + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map() -> Map {
        let share = |rate, collided| Share {
            rate,
            collided,
            drives: 10,
            interval: (0.0, 1.0),
            ..Share::default()
        };
        let row = |value: &str, counts: [u32; 3]| Row {
            value: value.to_string(),
            shares: (1..)
                .zip(counts)
                .map(|(rate, count)| share(rate, count))
                .collect(),
        };
        Map {
            never: Vec::new(),
            scenario: "cut-in".into(),
            path: "perception.drop_rate".into(),
            rows: vec![row("0", [7, 0, 0]), row("0.5", [10, 0, 1])],
        }
    }

    #[test]
    fn hand_cells_tell_their_counts_and_the_line_is_the_mrf() {
        let map = map();
        assert_eq!(safe_from(&map.rows[0]), 1);
        assert_eq!(safe_from(&map.rows[1]), 3);
        let svg = figure(&[map]);
        for told in [
            "cut-in",
            "drop_rate",
            "\n7\n",
            "\n10\n",
            "FPR of all cameras",
        ] {
            assert!(svg.contains(told), "{told}: {svg}");
        }
        assert!(!svg.contains("\n0.0\n"));
    }
}
