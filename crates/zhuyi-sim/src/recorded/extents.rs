//! Half extents of a recorded box as it stands: as few lines as meet all rows to within [`TOLERANCE`].
//!
//! While a box stands alike from row to row its extents are those of the rows. While it turns, a line begins at a row; every
//! further row leaves it a range of slopes that pass within the tolerance, and it ends before the row that leaves none. The
//! next line begins where it ends, so that the box does not jump. Source: the swinging door of Bristol, *Swinging door
//! trending*, ISA National Conference 1990.

use zhuyi_core::{Body, Extent};

/// [m] how closely a line must meet the rows: 0.05 ms of driving at 20 m/s.
const TOLERANCE: f64 = 1e-3;

/// Half extents along and across the road, and when.
#[derive(Clone, Copy, Debug)]
struct Row {
    time: f64,
    along: f64,
    across: f64,
}

impl Row {
    fn stands_as(&self, other: &Self) -> bool {
        self.along == other.along && self.across == other.across
    }

    /// The box stands so from then on.
    fn at_rest(&self) -> Extent {
        self.towards([0.0; 2])
    }

    /// The line from here with these slopes along and across.
    fn towards(&self, [along_rate, across_rate]: [f64; 2]) -> Extent {
        Extent {
            time: self.time,
            along: self.along,
            along_rate,
            across: self.across,
            across_rate,
        }
    }
}

/// A range of slopes [m/s].
#[derive(Clone, Copy, Debug)]
struct Slopes {
    least: f64,
    most: f64,
}

impl Slopes {
    const ALL: Self = Self {
        least: f64::NEG_INFINITY,
        most: f64::INFINITY,
    };

    /// Those that also pass within the tolerance of a point `rise` [m] further up `run` [s] later; none where there are none.
    fn within(self, rise: f64, run: f64) -> Option<Self> {
        let least = self.least.max((rise - TOLERANCE) / run);
        let most = self.most.min((rise + TOLERANCE) / run);
        (least <= most).then_some(Self { least, most })
    }

    fn middle(self) -> f64 {
        f64::midpoint(self.least, self.most)
    }

    fn holds(self, slope: f64) -> bool {
        self.least <= slope && slope <= self.most
    }
}

/// A line under way: where it begins, and the slopes that are left to it, along and across.
#[derive(Clone, Copy, Debug)]
struct Line {
    start: Row,
    slopes: [Slopes; 2],
}

impl Line {
    fn from(start: Row) -> Self {
        Self {
            start,
            slopes: [Slopes::ALL; 2],
        }
    }

    /// The same with a further row; none where it cannot meet that.
    fn with(self, row: Row) -> Option<Self> {
        let (start, [along, across]) = (self.start, self.slopes);
        let run = row.time - start.time;
        let slopes = [
            along.within(row.along - start.along, run)?,
            across.within(row.across - start.across, run)?,
        ];
        Some(Self { start, slopes })
    }

    /// It as it is up to `time`, and where it is then.
    fn until(self, time: f64) -> (Extent, Row) {
        let line = self.start.towards(self.slopes.map(Slopes::middle));
        let (along, across) = line.at(time);
        let end = Row {
            time,
            along,
            across,
        };
        (line, end)
    }

    /// The lines by which it comes to a row exactly, which is behind the row at `before` [s].
    fn to(self, row: Row, before: f64, lines: &mut Vec<Extent>) {
        let slopes_from = |start: Row| {
            let run = row.time - start.time;
            [
                (row.along - start.along) / run,
                (row.across - start.across) / run,
            ]
        };
        let exact = slopes_from(self.start);
        if self.start.time >= before || (0..2).all(|axis| self.slopes[axis].holds(exact[axis])) {
            lines.push(self.start.towards(exact));
        } else {
            let (line, end) = self.until(before);
            lines.extend([line, end.towards(slopes_from(end))]);
        }
    }
}

/// Returns the lines through the rows of a body.
pub(super) fn extents<'a>(bodies: impl Iterator<Item = (f64, &'a Body)>) -> Vec<Extent> {
    let mut rows = bodies.map(|(time, body)| Row {
        time,
        along: body.extent.length / 2.0,
        across: body.extent.width / 2.0,
    });
    // Room for some lane changes, so that what a run allocates does not hang on when they are.
    let mut lines: Vec<Extent> = Vec::with_capacity(64);
    let Some(mut last) = rows.next() else {
        return lines;
    };
    let (mut before, mut turning) = (last.time, None::<Line>);
    lines.push(last.at_rest());
    for row in rows {
        match turning {
            None if row.stands_as(&last) => {}
            None => {
                // The piece at rest ends where the first line begins.
                if lines.last().is_some_and(|line| line.time == last.time) {
                    lines.pop();
                }
                turning = Line::from(last).with(row);
            }
            Some(line) if row.stands_as(&last) => {
                line.to(last, before, &mut lines);
                lines.push(last.at_rest());
                turning = None;
            }
            Some(line) => {
                turning = line.with(row).or_else(|| {
                    let (over, end) = line.until(last.time);
                    lines.push(over);
                    Line::from(end).with(row)
                });
            }
        }
        (before, last) = (last.time, row);
    }
    // Behind the last row the box stands as it does there.
    if let Some(line) = turning {
        line.to(last, before, &mut lines);
        lines.push(last.at_rest());
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use zhuyi_core::{Footprint, Frenet, Pose};

    const LORRY: Footprint = Footprint {
        length: 12.0,
        width: 2.5,
    };

    fn body(turn: f64) -> Body {
        Body {
            footprint: LORRY,
            road: Frenet::default(),
            pose: Pose::default(),
            turn,
            extent: LORRY.turned(turn),
            speed: 0.0,
            accel: 0.0,
            s_rate: 0.0,
            d_rate: 0.0,
        }
    }

    fn lines(turn: impl Fn(f64) -> f64) -> (Vec<Extent>, Vec<(f64, Body)>) {
        let row = |step: i32| {
            let time = f64::from(step) / 100.0;
            (time, body(turn(time)))
        };
        let rows: Vec<_> = (0..1000).map(row).collect();
        (extents(rows.iter().map(|(time, body)| (*time, body))), rows)
    }

    #[test]
    fn hand_a_box_that_stands_as_it_does_has_one_line() {
        assert_eq!(lines(|_| 0.0).0, [Extent::held(LORRY)]);
        assert_eq!(lines(|_| 0.5).0, [Extent::held(LORRY.turned(0.5))]);
    }

    #[test]
    fn law_every_row_is_met_and_the_lines_are_few() {
        // A lane change from 3 to 6 s, by 0.2 rad at most.
        let turn = |time: f64| {
            let share = ((time - 3.0) / 3.0).clamp(0.0, 1.0);
            0.2 * 16.0 * (share * (1.0 - share)).powi(2)
        };
        let (lines, rows) = lines(turn);
        assert!(lines.len() > 10 && lines.len() < 60, "{}", lines.len());
        for (time, body) in rows {
            let place = lines.iter().rposition(|line| line.time <= time).unwrap();
            let (along, across) = lines[place].at(time);
            assert!((along - body.extent.length / 2.0).abs() < 1.01 * TOLERANCE);
            assert!((across - body.extent.width / 2.0).abs() < 1.01 * TOLERANCE);
        }
        let last = lines.last().unwrap();
        assert!(last.is_at_rest() && last.along == 6.0, "{last:?}");
        // It stands exactly as it is before and behind, and nowhere jumps.
        assert_eq!(lines[0], Extent::held(LORRY));
        for pair in lines.windows(2) {
            let (along, across) = pair[0].at(pair[1].time);
            let jump = (along - pair[1].along).abs() + (across - pair[1].across).abs();
            assert!(jump < 1e-12, "{pair:?}");
        }
    }
}
