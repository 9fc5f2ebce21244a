//! The closed road: laps, and the way round.

use super::{Road, RoadError};
use crate::Pose;
use crate::geometry::wrap_angle;
use std::f64::consts::TAU;

/// What makes a road go round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ring {
    /// [rad] heading gained in a lap: one full turn to the left or to the right.
    pub(super) turn: f64,
}

impl Road {
    /// [m] largest distance between the end of a closed road and its start. What there is of it stands as a step where laps
    /// meet.
    pub const MAX_MISS: f64 = 0.01;
    /// [rad] largest angle between the end of a closed road and its start.
    pub const MAX_MISS_HEADING: f64 = 0.001;

    /// [m] length of a lap of a closed road, none of an open one.
    #[inline]
    pub fn lap(&self) -> Option<f64> {
        self.ring.map(|_| self.length)
    }

    /// [m] signed way along the reference line from one arc length to another, positive ahead; on a ring the shorter way
    /// round, at most half a lap.
    ///
    /// ```
    /// use zhuyi_core::{Pose, Road, Segment};
    /// use std::f64::consts::TAU;
    /// let line = Road::straight(500.0, 1, 3.5)?;
    /// assert_eq!(line.ahead(490.0, 20.0), -470.0);
    /// let circle = [Segment::Arc { length: 500.0, curvature: TAU / 500.0 }];
    /// let ring = Road::closed(Pose::default(), &circle, 1, 3.5)?;
    /// assert_eq!(ring.ahead(490.0, 20.0), 30.0);
    /// assert_eq!(ring.ahead(20.0, 1_490.0), -30.0);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    #[inline]
    pub fn ahead(&self, from_s: f64, to_s: f64) -> f64 {
        let way = to_s - from_s;
        match self.ring {
            None => way,
            Some(_) => way - (way / self.length).round() * self.length,
        }
    }

    /// [m] the place `s` expressed in the lap in which it is nearest to `near_s`, within half a lap; on an open road `s`.
    ///
    /// ```
    /// use zhuyi_core::{Pose, Road, Segment};
    /// use std::f64::consts::TAU;
    /// let circle = [Segment::Arc { length: 500.0, curvature: TAU / 500.0 }];
    /// let ring = Road::closed(Pose::default(), &circle, 1, 3.5)?;
    /// assert_eq!([20.0, 480.0, 1_020.0].map(|s| ring.nearest_lap(s, 990.0)), [1_020.0, 980.0, 1_020.0]);
    /// # Ok::<(), zhuyi_core::RoadError>(())
    /// ```
    #[inline]
    pub fn nearest_lap(&self, s: f64, near_s: f64) -> f64 {
        match self.ring {
            None => s,
            Some(_) => s + ((near_s - s) / self.length).round() * self.length,
        }
    }

    /// [m] the place in the first lap that `s` is on, and how many laps before it are done; on an open road `s` and none.
    #[inline]
    pub(super) fn in_first_lap(&self, s: f64) -> (f64, f64) {
        if self.ring.is_none() {
            return (s, 0.0);
        }
        let laps = (s / self.length).floor();
        (s - laps * self.length, laps)
    }

    /// The ring that this lap makes, unless its end misses its start.
    pub(super) fn close(&self, start: Pose) -> Result<Ring, RoadError> {
        let last = &self.pieces[self.pieces.len() - 1];
        let end = last.pose(self.length - last.start, 0.0);
        let (ahead, left) = start.local(end.point());
        let turn = end.heading - start.heading;
        let turned = wrap_angle(turn);
        if ahead * ahead + left * left > Self::MAX_MISS * Self::MAX_MISS
            || turned.abs() > Self::MAX_MISS_HEADING
        {
            return Err(RoadError::Open {
                ahead,
                left,
                turned,
            });
        }
        Ok(Ring {
            turn: (turn / TAU).round() * TAU,
        })
    }
}
