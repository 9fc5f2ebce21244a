//! One future of an actor as the estimator reads it: borrowed pieces on their own clock, seen from t_0 = `now`.
//!
//! A recorded run is one long list; every t_0 of the run borrows the same list with another `now`. Times in this
//! crate count from t_0. Before the first piece it is extended backwards, after the last one it goes on for ever.
//! Lists should be as short as exactness allows: a long stretch of one acceleration is one piece.

use zhuyi_core::{Across, Along, Extent, Footprint, Trajectory};

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

    /// Returns the box of `actor` as it stands on the path at `time` [s] from t_0: its extents along and across it, the box
    /// itself where the future keeps it aligned with the path.
    ///
    /// A lorry that turns from along to across the path in 4 s, its half extents taken as lines: half way.
    /// ```
    /// use zhuyi_core::{Across, Along, Extent, Footprint};
    /// use zhuyi_estimator::Future;
    /// let lorry = Footprint { length: 12.0, width: 2.5 };
    /// let along = [Along::constant_accel(0.0, 50.0, 0.0, 0.0)];
    /// let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// let turns = [Extent { time: 0.0, along: 6.0, along_rate: -4.75 / 4.0, across: 1.25, across_rate: 4.75 / 4.0 }];
    /// let mut future = Future { along: &along, across: &across, extents: &turns, known_until: 9.0, now: 1.0 };
    /// assert_eq!(future.box_at(lorry, 1.0), Footprint { length: 7.25, width: 7.25 });
    /// future.extents = &[];
    /// assert_eq!(future.box_at(lorry, 1.0), lorry);
    /// ```
    pub fn box_at(&self, actor: Footprint, time: f64) -> Footprint {
        let at = time + self.now;
        let Some(piece) = self.extents.get(self.extent_index(time)) else {
            return actor;
        };
        let (along, across) = piece.at(at);
        Footprint {
            length: 2.0 * along,
            width: 2.0 * across,
        }
    }

    /// The half extents of `actor` between two times from t_0, piece by piece: from when, until when, and the piece on this
    /// clock.
    pub fn extents_within(
        &self,
        actor: Footprint,
        from: f64,
        to: f64,
    ) -> impl Iterator<Item = (f64, f64, Extent)> {
        let held = self.extents.is_empty().then(|| Extent::held(actor));
        let first = self.extent_index(from);
        let pieces = self.extents.iter().enumerate().skip(first);
        let pieces = pieces.map(move |(index, piece)| {
            let next = self.extents.get(index + 1);
            let begin = if index == first {
                from
            } else {
                piece.time - self.now
            };
            let end = next.map_or(to, |next| (next.time - self.now).min(to));
            let time = piece.time - self.now;
            (begin, end, Extent { time, ..*piece })
        });
        held.map(|held| (from, to, held))
            .into_iter()
            .chain(pieces)
            .take_while(move |(begin, ..)| *begin < to)
    }

    /// The same in the list of half extents.
    fn extent_index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.extents
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }

    /// The place in the list of the piece that holds at `time` from t_0.
    pub fn along_index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.along
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }

    /// The same across the road.
    pub fn across_index(&self, time: f64) -> usize {
        let at = time + self.now;
        self.across
            .partition_point(|piece| piece.time <= at)
            .saturating_sub(1)
    }
}
