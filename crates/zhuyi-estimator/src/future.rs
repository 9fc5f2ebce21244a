//! One future of an actor as the estimator reads it: borrowed pieces on their own clock, seen from t_0 = `now`.
//!
//! A recorded run is one long list; every t_0 of the run borrows the same list with another `now`. Times in this
//! crate count from t_0. Before the first piece it is extended backwards, after the last one it goes on for ever.
//! Lists should be as short as exactness allows: a long stretch of one acceleration is one piece.

use zhuyi_core::{Across, Along, Trajectory};

/// A trajectory of an actor, seen from one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Future<'a> {
    /// Motion along the road, sorted by time, not empty.
    pub along: &'a [Along],
    /// Motion across the road, sorted by time, not empty.
    pub across: &'a [Across],
    /// [s] time on the lists' clock from which on the future is extrapolated.
    pub known_until: f64,
    /// [s] time on the lists' clock that is t_0.
    pub now: f64,
}

impl<'a> Future<'a> {
    /// The future that `trajectory` describes, seen from `now` on its clock.
    pub fn new(trajectory: &'a Trajectory, now: f64) -> Self {
        Self {
            along: &trajectory.along,
            across: &trajectory.across,
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
    /// let future = Future { along: &along, across: &across, known_until: 12.0, now: 5.0 };
    /// assert_eq!(future.extrapolated(20.0), 13.0);
    /// ```
    pub fn extrapolated(&self, horizon: f64) -> f64 {
        (self.now + horizon - self.known_until).clamp(0.0, horizon.max(0.0))
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
