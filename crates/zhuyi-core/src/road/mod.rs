//! The road: a reference line of lines, arcs and clothoids with parallel lanes.
//!
//! ```text
//!  x(s, d) = p(s) + d n(s)      p' = t = (cos θ, sin θ)      n = (-sin θ, cos θ)      θ' = κ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s, d | [`Frenet`] place: arc length along the reference line, offset to the left of it | m |
//! | p, t, n | point of the reference line, unit vectors along and to the left of it | m, -, - |
//! | θ, κ | heading and curvature of the reference line | rad, 1/m |
//!
//! The reference line is the middle of the road. Position and heading are continuous over the segments, curvature is
//! as the segments say. Before its start and behind its end an open road goes straight on; a closed one, a ring, goes
//! round, and `s` counts on over its laps. Left out: elevation, superelevation, lanes that begin, end or change their
//! width.

mod clothoid;
mod itself;
mod locate;
mod piece;
mod ring;
mod segment;
#[cfg(test)]
mod tests;

use crate::Pose;
use piece::{Piece, Shape};
use ring::Ring;
pub use segment::{RoadError, Segment};

/// A place on the road.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frenet {
    /// [m] arc length along the reference line.
    pub s: f64,
    /// [m] offset from the reference line, positive to the left.
    pub d: f64,
}

/// A lane, counted from 1 at the right edge of the road.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Lane(pub u8);

/// A multi-lane road.
///
/// ```
/// use zhuyi_core::{Frenet, Lane, Point, Pose, Road, Segment};
/// use std::f64::consts::FRAC_PI_2;
/// // 100 m east, then a quarter circle of 50 m radius to the left; two lanes of 3.5 m.
/// let turn = Segment::Arc { length: 50.0 * FRAC_PI_2, curvature: 1.0 / 50.0 };
/// let road = Road::new(Pose::default(), &[Segment::Line { length: 100.0 }, turn], 2, 3.5)?;
/// let left_lane = Frenet { s: road.length(), d: road.lane_center(Lane(2)) };
/// let end = road.world_from_road(left_lane);
/// assert!((end.x - 148.25).abs() < 1e-9 && (end.y - 50.0).abs() < 1e-9);
/// assert!((end.heading - FRAC_PI_2).abs() < 1e-12);
/// let back = road.road_from_world(Point::new(148.25, 50.0));
/// assert!((back.s - left_lane.s).abs() < 1e-9 && (back.d - 1.75).abs() < 1e-9);
/// # Ok::<(), zhuyi_core::RoadError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Road {
    lanes: u8,
    lane_width: f64,
    length: f64,
    /// Sorted by start. On an open road they cover all s, the first and the last without end; on a ring one lap.
    pieces: Vec<Piece>,
    /// Present on a closed road.
    ring: Option<Ring>,
}

impl Road {
    /// Most lanes of a road.
    pub const MAX_LANES: u8 = 12;
    /// [m] widest lane.
    pub const MAX_LANE_WIDTH: f64 = 10.0;
    /// [m] longest segment: up to there `f64` resolves 1e-10 m.
    pub const MAX_SEGMENT_LENGTH: f64 = 1e6;
    /// [-] least 1 - κ d by which a speed beside the road is divided: a place with less lies near the centre of a bend or behind
    /// it, where no speed along the road means anything.
    pub const LEAST_LANE_RATE: f64 = 0.2;

    /// An open road whose reference line, the middle of the road, starts at `start`.
    ///
    /// # Errors
    /// The first of [`RoadError`]'s rules that does not hold.
    pub fn new(
        start: Pose,
        segments: &[Segment],
        lanes: u8,
        lane_width: f64,
    ) -> Result<Self, RoadError> {
        Self::laid_out(start, segments, (lanes, lane_width), false)
    }

    /// A ring: a road whose end meets its start, in position to within [`Road::MAX_MISS`] and in heading to within
    /// [`Road::MAX_MISS_HEADING`].
    ///
    /// Its `s` goes on counting from lap to lap, backwards too; its [`length`](Road::length) is that of one lap.
    /// ```
    /// use zhuyi_core::{Frenet, Pose, Road, Segment};
    /// use std::f64::consts::{PI, TAU};
    /// // A stadium: two straights of 200 m, two half circles of 50 m radius.
    /// let (straight, bend) = (Segment::Line { length: 200.0 }, Segment::Arc { length: 50.0 * PI, curvature: 0.02 });
    /// let road = Road::closed(Pose::default(), &[straight, bend, straight, bend], 2, 3.5)?;
    /// let lap = 400.0 + 100.0 * PI;
    /// assert!((road.length() - lap).abs() < 1e-12);
    /// let there = road.world_from_road(Frenet { s: 2.0 * lap + 30.0, d: 1.0 });
    /// assert!((there.x - 30.0).abs() < 1e-9 && (there.y - 1.0).abs() < 1e-9);
    /// assert!((there.heading - 2.0 * TAU).abs() < 1e-9);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    ///
    /// # Errors
    /// The first of [`RoadError`]'s rules that does not hold.
    pub fn closed(
        start: Pose,
        segments: &[Segment],
        lanes: u8,
        lane_width: f64,
    ) -> Result<Self, RoadError> {
        Self::laid_out(start, segments, (lanes, lane_width), true)
    }

    fn laid_out(
        start: Pose,
        segments: &[Segment],
        (lanes, lane_width): (u8, f64),
        closed: bool,
    ) -> Result<Self, RoadError> {
        segment::check_cross_section(lanes, lane_width)?;
        if segments.is_empty() {
            return Err(RoadError::NoSegments);
        }
        if !(start.x.is_finite() && start.y.is_finite() && start.heading.is_finite()) {
            return Err(RoadError::Start { got: start });
        }
        let sharpest = 2.0 / (f64::from(lanes) * lane_width);
        for (index, segment) in segments.iter().enumerate() {
            segment::check_segment(index, *segment, sharpest)?;
        }
        let mut road = Self {
            lanes,
            lane_width,
            length: segments.iter().map(|segment| segment.parts().0).sum(),
            pieces: lay_out(start, segments, closed),
            ring: None,
        };
        if closed {
            road.ring = Some(road.close(start)?);
        }
        road.check_apart_from_itself(segments)?;
        Ok(road)
    }

    /// A straight road along the x axis, from the origin.
    ///
    /// ```
    /// use zhuyi_core::{Frenet, Pose, Road};
    /// let road = Road::straight(1_000.0, 3, 3.5)?;
    /// assert_eq!(road.world_from_road(Frenet { s: 20.0, d: -3.5 }), Pose::new(20.0, -3.5, 0.0));
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Road::new`].
    pub fn straight(length: f64, lanes: u8, lane_width: f64) -> Result<Self, RoadError> {
        Self::new(
            Pose::default(),
            &[Segment::Line { length }],
            lanes,
            lane_width,
        )
    }

    /// Number of lanes.
    pub fn lanes(&self) -> u8 {
        self.lanes
    }

    /// [m] width of a lane.
    pub fn lane_width(&self) -> f64 {
        self.lane_width
    }

    /// [m] offset of a lane's centre.
    ///
    /// ```
    /// use zhuyi_core::{Lane, Road};
    /// let road = Road::straight(1_000.0, 3, 3.5)?;
    /// assert_eq!([1, 2, 3].map(|n| road.lane_center(Lane(n))), [-3.5, 0.0, 3.5]);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    pub fn lane_center(&self, lane: Lane) -> f64 {
        (f64::from(lane.0) - f64::midpoint(f64::from(self.lanes), 1.0)) * self.lane_width
    }

    /// The lane at an offset, none beside the road. A line between two lanes belongs to the left one.
    ///
    /// ```
    /// use zhuyi_core::{Lane, Road};
    /// let road = Road::straight(1_000.0, 3, 3.5)?;
    /// assert_eq!(road.lane_at(-1.8), Some(Lane(1)));
    /// assert_eq!(road.lane_at(5.3), None);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    pub fn lane_at(&self, d: f64) -> Option<Lane> {
        let index = (d / self.lane_width + f64::from(self.lanes) / 2.0).floor();
        (index >= 0.0 && index < f64::from(self.lanes)).then_some(Lane(index as u8 + 1))
    }

    /// [m] length of the reference line, of a ring that of one lap.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// [m] width of all lanes together.
    pub fn width(&self) -> f64 {
        f64::from(self.lanes) * self.lane_width
    }

    /// [1/m] curvature of the reference line, positive to the left; where two segments meet, that of the second.
    #[inline]
    pub fn curvature(&self, s: f64) -> f64 {
        if self.is_straight() {
            return 0.0;
        }
        let (s, _) = self.in_first_lap(s);
        let piece = self.piece(s);
        piece.curvature(s - piece.start)
    }

    /// [rad] heading of the reference line; it goes on counting over full turns, on a ring from lap to lap.
    #[inline]
    pub fn heading(&self, s: f64) -> f64 {
        let (s, lap) = self.in_first_lap(s);
        let piece = self.piece(s);
        let heading = piece.heading(s - piece.start);
        match self.ring {
            None => heading,
            Some(ring) => heading + lap * ring.turn,
        }
    }

    /// Whether the road has no bend anywhere, so that lengths along all offsets are equal.
    #[inline]
    pub fn is_straight(&self) -> bool {
        self.pieces.len() == 1 && self.pieces[0].is_line()
    }

    /// [-] length along the lane at offset `d` per length along the reference line: 1 - κ d.
    ///
    /// In a left bend of 100 m radius a lane 4 m to the left is 4 % shorter than the reference line, one 4 m to the right 4 % longer.
    /// ```
    /// use zhuyi_core::{Pose, Road, Segment};
    /// let bend = Segment::Arc { length: 100.0, curvature: 0.01 };
    /// let road = Road::new(Pose::default(), &[bend], 2, 8.0)?;
    /// assert_eq!([4.0, -4.0].map(|d| road.lane_rate(50.0, d)), [0.96, 1.04]);
    /// assert_eq!(road.lane_rate(150.0, 4.0), 1.0); // straight on behind its end
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    #[inline]
    pub fn lane_rate(&self, s: f64, d: f64) -> f64 {
        1.0 - self.curvature(s) * d
    }

    /// [m] length of the lane at offset `d` between two places, negative where `to_s` lies before `from_s`.
    ///
    /// The rate 1 - κ d summed over the way, exact on lines, arcs and clothoids because κ = dθ/ds:
    /// ```text
    ///  length = (to_s - from_s) - d (θ(to_s) - θ(from_s))
    /// ```
    /// 50 m of line, then 157.08 m of arc that turn left by π/2 around a centre 100 m away: 4 m to the left of the reference line
    /// the arc has a radius of 96 m and a length of 48 π.
    /// ```
    /// use zhuyi_core::{Pose, Road, Segment};
    /// use std::f64::consts::PI;
    /// let bend = Segment::Arc { length: 50.0 * PI, curvature: 0.01 };
    /// let road = Road::new(Pose::default(), &[Segment::Line { length: 50.0 }, bend], 2, 8.0)?;
    /// let end = road.length();
    /// assert!((road.lane_length(0.0, end, 4.0) - (50.0 + 48.0 * PI)).abs() < 1e-12);
    /// assert!((road.lane_length(end, 0.0, -4.0) + (50.0 + 52.0 * PI)).abs() < 1e-12);
    /// assert_eq!(road.lane_length(10.0, 40.0, 4.0), 30.0);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    #[inline]
    pub fn lane_length(&self, from_s: f64, to_s: f64, d: f64) -> f64 {
        let along = to_s - from_s;
        if d == 0.0 || self.is_straight() {
            return along; // all offsets are equally long
        }
        along - d * (self.heading(to_s) - self.heading(from_s))
    }

    /// [m] up to where the road goes straight on from `s`, without end on the last line of an open road, up to the end of
    /// the lap on a ring; none in a bend.
    ///
    /// ```
    /// use zhuyi_core::{Pose, Road, Segment};
    /// let bend = Segment::Arc { length: 50.0, curvature: 0.01 };
    /// let road = Road::new(Pose::default(), &[Segment::Line { length: 100.0 }, bend], 2, 3.5)?;
    /// let ends = [20.0, 120.0, 200.0].map(|s| road.straight_until(s));
    /// assert_eq!(ends, [Some(100.0), None, Some(f64::INFINITY)]);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    #[inline]
    pub fn straight_until(&self, s: f64) -> Option<f64> {
        let (s, lap) = self.in_first_lap(s);
        let place = self.place(s);
        if !self.pieces[place].is_line() {
            return None;
        }
        let end = self.pieces.get(place + 1).map(|next| next.start);
        Some(match self.ring {
            None => end.unwrap_or(f64::INFINITY),
            Some(_) => end.unwrap_or(self.length) + lap * self.length,
        })
    }

    /// World position of a place, with the heading of the road there.
    #[inline]
    pub fn world_from_road(&self, place: Frenet) -> Pose {
        self.pose_and_curvature(place).0
    }

    /// The same, with the curvature there [1/m].
    #[inline]
    pub fn pose_and_curvature(&self, place: Frenet) -> (Pose, f64) {
        if self.is_straight() {
            let line = &self.pieces[0];
            return (line.beside_line(place.s - line.start, place.d), 0.0);
        }
        self.pose_and_curvature_of_bends(place)
    }

    /// The same of a road that is not all one line.
    fn pose_and_curvature_of_bends(&self, place: Frenet) -> (Pose, f64) {
        let (s, lap) = self.in_first_lap(place.s);
        let piece = self.piece(s);
        let u = s - piece.start;
        let mut pose = piece.pose(u, place.d);
        if let Some(ring) = self.ring {
            pose.heading += lap * ring.turn;
        }
        (pose, piece.curvature(u))
    }

    /// The piece that holds `s`, on a ring of the first lap.
    #[inline]
    fn piece(&self, s: f64) -> &Piece {
        &self.pieces[self.place(s)]
    }

    /// Its place in the list.
    #[inline]
    fn place(&self, s: f64) -> usize {
        if self.pieces.len() == 1 {
            return 0;
        }
        let behind = self.pieces.partition_point(|piece| piece.start <= s);
        behind.saturating_sub(1)
    }
}

/// Segments end to end, those of an open road between two lines that go on for ever; lines that follow each other are one
/// piece.
fn lay_out(start: Pose, segments: &[Segment], closed: bool) -> Vec<Piece> {
    let before = || Piece::new(0.0, start, Shape::Line, f64::NEG_INFINITY, 0.0);
    let behind = (f64::INFINITY, 0.0, 0.0);
    let mut pieces: Vec<Piece> = (!closed).then(before).into_iter().collect();
    let mut s = 0.0;
    let parts = segments.iter().map(|segment| segment.parts());
    for (length, from, to) in parts.chain((!closed).then_some(behind)) {
        let shape = Shape::new(length, from, to);
        match pieces.last_mut() {
            Some(last) if last.is_line() && shape == Shape::Line => last.extend(length),
            last => {
                let pose = last.map_or(start, |last| last.pose(s - last.start, 0.0));
                pieces.push(Piece::new(s, pose, shape, 0.0, length));
            }
        }
        s += length;
    }
    pieces
}
