//! Distances and speeds along one lane.
//!
//! Beside the reference line a lane is shorter on the inside of a bend and longer on the outside. Gaps, speeds and
//! braking belong together only along one curve, that of the lane:
//! ```text
//!  x = s - d (θ(s) - θ(0))      dx/dt = (1 - κ d) ds/dt
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s, θ, κ | place along the reference line, its heading and curvature there | m, rad, 1/m |
//! | d | offset of the lane's centre | m |
//! | x | place along the lane | m |
//!
//! Source: the arc length of a parallel curve (do Carmo, Differential Geometry of Curves and Surfaces, 1976, section
//! 1-5). Left out: the ego's own distance from the centre of its lane.

use crate::{Body, Lane, Road, Track};

/// A lane as the curve along which everything is measured. Offsets `d` stay those of the road.
#[derive(Clone, Copy, Debug)]
pub struct LaneFrame<'a> {
    road: &'a Road,
    /// [m] offset of its centre; 0 where all lanes are equally long.
    d: f64,
}

impl<'a> LaneFrame<'a> {
    /// The frame of the lane at an offset [m]; beside the road that of the outermost one.
    ///
    /// A quarter circle of 20 m radius to the left, three lanes of 3.5 m: 31.4 m of the reference line are 36.9 m of the right
    /// lane, at 23.5 m from the centre.
    /// ```
    /// use std::f64::consts::FRAC_PI_2;
    /// use zhuyi_core::{LaneFrame, Pose, Road, Segment};
    /// let bend = Segment::Arc { length: 20.0 * FRAC_PI_2, curvature: 1.0 / 20.0 };
    /// let road = Road::new(Pose::default(), &[bend], 3, 3.5)?;
    /// let right = LaneFrame::at(&road, -3.0);
    /// assert!((right.place(road.length()) - 23.5 * FRAC_PI_2).abs() < 1e-12);
    /// assert!((right.rate(10.0) - 23.5 / 20.0).abs() < 1e-15);
    /// assert!(LaneFrame::at(&road, 0.5).is_reference_line());
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    #[inline]
    pub fn at(road: &'a Road, d: f64) -> Self {
        if road.is_straight() {
            return Self { road, d: 0.0 };
        }
        Self::of(road, Self::lane(road, d))
    }

    /// The frame of a lane.
    pub fn of(road: &'a Road, lane: Lane) -> Self {
        let d = if road.is_straight() {
            0.0
        } else {
            road.lane_center(lane)
        };
        Self { road, d }
    }

    /// The lane whose frame [`LaneFrame::at`] is.
    #[inline]
    pub fn lane(road: &Road, d: f64) -> Lane {
        let outermost = || Lane(if d < 0.0 { 1 } else { road.lanes() });
        road.lane_at(d).unwrap_or_else(outermost)
    }

    /// Returns whether its distances are those of the reference line.
    #[inline]
    pub fn is_reference_line(&self) -> bool {
        self.d == 0.0
    }

    /// [m] place along the lane of a place `s` [m] along the reference line.
    #[inline]
    pub fn place(&self, s: f64) -> f64 {
        self.road.lane_length(0.0, s, self.d)
    }

    /// [-] metres of the lane per metre of the reference line.
    #[inline]
    pub fn rate(&self, s: f64) -> f64 {
        self.road.lane_rate(s, self.d)
    }

    /// A body with its place and speed along the lane in place of those along the reference line.
    #[must_use]
    pub fn body(&self, body: &Body) -> Body {
        let mut along = *body;
        along.road.s = self.place(body.road.s);
        along.s_rate *= self.rate(body.road.s);
        along
    }

    /// The same of a track; the deviations stay.
    #[must_use]
    pub fn track(&self, track: &Track) -> Track {
        let (mut along, rate) = (*track, self.rate(track.road.s));
        along.road.s = self.place(track.road.s);
        along.s_rate *= rate;
        along.s_accel *= rate;
        along
    }
}
