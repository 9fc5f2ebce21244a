//! What a road is made of, and the rules for it.
//!
//! A road is valid where `|κ|` times half its width stays below 1: there every place near the reference line has one
//! nearest point of it.

use super::Road;
use crate::Pose;
use std::f64::consts::TAU;

/// One piece of the reference line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// Straight.
    Line {
        /// [m] length.
        length: f64,
    },
    /// Circular.
    Arc {
        /// [m] length.
        length: f64,
        /// [1/m] curvature, positive to the left.
        curvature: f64,
    },
    /// Curvature linear in arc length.
    Clothoid {
        /// [m] length.
        length: f64,
        /// [1/m] curvature at its start.
        start: f64,
        /// [1/m] curvature at its end.
        end: f64,
    },
}

impl Segment {
    /// [m] length, [1/m] curvature at its start, [1/m] curvature at its end.
    pub(super) const fn parts(self) -> (f64, f64, f64) {
        match self {
            Self::Line { length } => (length, 0.0, 0.0),
            Self::Arc { length, curvature } => (length, curvature, curvature),
            Self::Clothoid { length, start, end } => (length, start, end),
        }
    }
}

/// Why a road cannot be built. Segments are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RoadError {
    /// The list of segments is empty.
    #[error("a road needs at least one segment, got none")]
    NoSegments,
    /// The start pose is not finite.
    #[error("the start of a road must be finite, got x {}, y {}, heading {}", got.x, got.y, got.heading)]
    Start {
        /// The start.
        got: Pose,
    },
    /// Number of lanes out of range.
    #[error("a road has 1 to {} lanes, got {got}", Road::MAX_LANES)]
    Lanes {
        /// The number of lanes.
        got: u8,
    },
    /// Lane width out of range.
    #[error(
        "a lane is wider than 0 and at most {} m wide, got {got}",
        Road::MAX_LANE_WIDTH
    )]
    LaneWidth {
        /// [m] the width.
        got: f64,
    },
    /// Length of a segment out of range.
    #[error(
        "a segment is longer than 0 and at most {} m long, got {got}",
        Road::MAX_SEGMENT_LENGTH
    )]
    Length {
        /// Which segment.
        segment: usize,
        /// [m] the length.
        got: f64,
    },
    /// A curve so sharp that the inner edge of the road passes its centre, or not a number.
    #[error(
        "curvature stays below 1/m {below} in magnitude, where the inner edge of the road meets its centre, got {got}"
    )]
    Curvature {
        /// Which segment.
        segment: usize,
        /// [1/m] the curvature.
        got: f64,
        /// [1/m] one over half the width of the road.
        below: f64,
    },
    /// A segment that comes round to its own heading.
    #[error("a segment turns by at most one full circle, 6.283 rad, got {got}")]
    Turn {
        /// Which segment.
        segment: usize,
        /// [rad] how far it turns, to the left and to the right together.
        got: f64,
    },
    /// A road that comes closer to itself than it is wide.
    #[error(
        "the road lies over itself: {width} m wide, its middle at {:.2} m (segment {}) comes within {apart:.2} m of its middle \
         at {:.2} m (segment {}){}",
        s[1], segments[1] + 1, s[0], segments[0] + 1, back(*lap)
    )]
    Itself {
        /// The segments of the two places, the first one first.
        segments: [usize; 2],
        /// [m] arc lengths of the two places.
        s: [f64; 2],
        /// [m] distance between them.
        apart: f64,
        /// [m] width of the road.
        width: f64,
        /// [m] where the road comes back to its start, if it does.
        lap: Option<f64>,
    },
    /// A closed road whose end does not meet its start.
    #[error(
        "a closed road ends where it starts, to within {} m and {} rad: its end lies {:.4} m {} and {:.4} m to the {} of its \
         start and is turned by {turned:.5} rad",
        Road::MAX_MISS, Road::MAX_MISS_HEADING,
        ahead.abs(), if *ahead < 0.0 { "before" } else { "past" },
        left.abs(), if *left < 0.0 { "right" } else { "left" }
    )]
    Open {
        /// [m] how far the end lies ahead of the start, along its heading.
        ahead: f64,
        /// [m] how far the end lies to the left of the start.
        left: f64,
        /// [rad] heading of the end against that of the start, within half a turn.
        turned: f64,
    },
}

/// What to do about a road that comes back to its start.
fn back(lap: Option<f64>) -> String {
    lap.map_or_else(String::new, |lap| {
        format!("; it comes back to its start at {lap:.3} m: a ring is one lap with `closed: true`")
    })
}

/// [rad] how far a curve turns, to the left and to the right together: the area under |κ|, a trapezium, or two triangles
/// where the curve changes sides.
pub(super) fn turn(length: f64, start: f64, end: f64) -> f64 {
    if start * end >= 0.0 {
        (start + end).abs() / 2.0 * length
    } else {
        (start * start + end * end) / (2.0 * (end - start).abs()) * length
    }
}

pub(super) fn check_cross_section(lanes: u8, lane_width: f64) -> Result<(), RoadError> {
    if !(1..=Road::MAX_LANES).contains(&lanes) {
        return Err(RoadError::Lanes { got: lanes });
    }
    if !(lane_width > 0.0 && lane_width <= Road::MAX_LANE_WIDTH) {
        return Err(RoadError::LaneWidth { got: lane_width });
    }
    Ok(())
}

pub(super) fn check_segment(
    index: usize,
    segment: Segment,
    sharpest: f64,
) -> Result<(), RoadError> {
    let (length, start, end) = segment.parts();
    if !(length > 0.0 && length <= Road::MAX_SEGMENT_LENGTH) {
        return Err(RoadError::Length {
            segment: index,
            got: length,
        });
    }
    for curvature in [start, end] {
        if curvature.is_nan() || curvature.abs() >= sharpest {
            return Err(RoadError::Curvature {
                segment: index,
                got: curvature,
                below: sharpest,
            });
        }
    }
    let turn = turn(length, start, end);
    // A closed circle is given by rounded numbers.
    if turn > TAU + Road::MAX_MISS_HEADING {
        return Err(RoadError::Turn {
            segment: index,
            got: turn,
        });
    }
    Ok(())
}
