//! Half extents of a recorded box as it stands: as few lines as meet all rows to within [`TOLERANCE`].
//!
//! A line begins at a row with the extents there. Every further row leaves it a range of slopes that pass within the
//! tolerance; the line ends before the row that leaves none. Source: the swinging door of Bristol, *Swinging door
//! trending*, ISA National Conference 1990.

use zhuyi_core::{Body, Extent};

/// [m] how closely a line must meet the rows: 0.05 ms of driving at 20 m/s.
const TOLERANCE: f64 = 1e-3;

/// Half extents along and across the road, and when.
#[derive(Clone, Copy)]
struct Row {
    time: f64,
    along: f64,
    across: f64,
}

/// A range of slopes [m/s].
#[derive(Clone, Copy)]
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

    /// One of them: level where that is one of them.
    fn middle(self) -> f64 {
        if self.least <= 0.0 && self.most >= 0.0 {
            0.0
        } else {
            f64::midpoint(self.least, self.most)
        }
    }
}

/// The lines through the rows of a body; empty where it never turns.
pub(super) fn extents<'a>(bodies: impl Iterator<Item = (f64, &'a Body)> + Clone) -> Vec<Extent> {
    if bodies
        .clone()
        .all(|(_, body)| body.extent == body.footprint)
    {
        return Vec::new();
    }
    let mut rows = bodies.map(|(time, body)| Row {
        time,
        along: body.extent.length / 2.0,
        across: body.extent.width / 2.0,
    });
    let mut lines: Vec<Extent> = Vec::new();
    let Some(mut start) = rows.next() else {
        return lines;
    };
    let (mut before, mut along, mut across) = (start, Slopes::ALL, Slopes::ALL);
    let line = |start: Row, along: Slopes, across: Slopes| Extent {
        time: start.time,
        along: start.along,
        along_rate: along.middle(),
        across: start.across,
        across_rate: across.middle(),
    };
    for row in rows {
        let pass = |along: Slopes, across: Slopes, start: Row| {
            let run = row.time - start.time;
            Some((
                along.within(row.along - start.along, run)?,
                across.within(row.across - start.across, run)?,
            ))
        };
        (along, across) = pass(along, across, start).unwrap_or_else(|| {
            lines.push(line(start, along, across));
            start = before;
            pass(Slopes::ALL, Slopes::ALL, start).unwrap_or((Slopes::ALL, Slopes::ALL))
        });
        before = row;
    }
    lines.push(line(start, along, across));
    // Behind the last row the box stands as it does there.
    if !lines.last().is_some_and(Extent::is_at_rest) {
        lines.push(Extent {
            time: before.time,
            along: before.along,
            along_rate: 0.0,
            across: before.across,
            across_rate: 0.0,
        });
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
    fn hand_a_box_that_keeps_aligned_has_none_and_one_that_stands_askew_has_one() {
        assert_eq!(lines(|_| 0.0).0, []);
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
    }
}
