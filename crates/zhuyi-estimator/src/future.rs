//! One future of an actor as the estimator reads it: borrowed pieces on their own clock, seen from t_0 = `now`.
//!
//! A recorded run is one long list; every t_0 of the run borrows the same list with another `now`. Times in this
//! crate count from t_0. Before the first piece it is extended backwards, after the last one it goes on for ever.
//! Lists should be as short as exactness allows: a long stretch of one acceleration is one piece.

use zhuyi_core::{Across, Along, Extent, Trajectory};

/// A trajectory of an actor, seen from one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Future<'a> {
    /// Motion along the road, sorted by time, not empty.
    pub along: &'a [Along],
    /// Motion across the road, sorted by time, not empty.
    pub across: &'a [Across],
    /// Half extents of the box as it stands, sorted by time; empty where it keeps aligned with the path.
    pub extents: &'a [Extent],
    /// [s] time on the lists' clock from which on the future is extrapolated.
    pub known_until: f64,
    /// [s] time on the lists' clock that is t_0.
    pub now: f64,
}

/// An actor at t_0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActorStart {
    /// [m] centre of its box along the road.
    pub s: f64,
    /// [m/s] speed along the road.
    pub speed: f64,
    /// [m/s2] its rate of change.
    pub accel: f64,
    /// [m] centre of its box across the road.
    pub d: f64,
    /// [m/s] its rate of change.
    pub d_rate: f64,
}

impl<'a> Future<'a> {
    /// The future that `trajectory` describes, seen from `now` on its clock.
    pub fn new(trajectory: &'a Trajectory, now: f64) -> Self {
        Self {
            along: &trajectory.along,
            across: &trajectory.across,
            extents: &trajectory.extents,
            known_until: trajectory.known_until,
            now,
        }
    }

    /// [s] how much of the `horizon` lies beyond what is known (reading R10).
    ///
    /// ```
    /// use zhuyi_core::{Across, Along};
    /// use zhuyi_estimator::Future;
    /// let along = [Along::constant_accel(0.0, 50.0, 10.0, 0.0)];
    /// let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// let future = Future { along: &along, across: &across, extents: &[], known_until: 12.0, now: 5.0 };
    /// assert_eq!(future.extrapolated(20.0), 13.0);
    /// ```
    pub fn extrapolated(&self, horizon: f64) -> f64 {
        (self.now + horizon - self.known_until).clamp(0.0, horizon.max(0.0))
    }

    /// Where the actor is at t_0 and how it moves there, for models that look no further; none of a future without pieces.
    ///
    /// Two seconds into braking by 3 m/s2 from 10 m/s it has gone 20 - 6 = 14 m and drives 4 m/s.
    /// ```
    /// use zhuyi_core::{Across, Along};
    /// use zhuyi_estimator::Future;
    /// let along = [Along::constant_accel(0.0, 50.0, 10.0, -3.0)];
    /// let across = [Across { time: 0.0, d: 3.5, d_rate: -0.5 }];
    /// let start = Future { along: &along, across: &across, extents: &[], known_until: 12.0, now: 2.0 }.start().unwrap();
    /// assert_eq!((start.s, start.speed, start.accel), (64.0, 4.0, -3.0));
    /// assert_eq!((start.d, start.d_rate), (2.5, -0.5));
    /// ```
    pub fn start(&self) -> Option<ActorStart> {
        let along = self.along.get(self.along_index(0.0))?;
        let across = self.across.get(self.across_index(0.0))?;
        Some(ActorStart {
            s: along.s_at(self.now),
            speed: along.v_at(self.now),
            accel: along.v_rate,
            d: across.d + (self.now - across.time) * across.d_rate,
            d_rate: across.d_rate,
        })
    }

    /// The place in the list of the piece that holds at `time` from t_0.
    pub(crate) fn along_index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.along
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }

    /// The same across the road.
    pub(crate) fn across_index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.across
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }
}
