//! The lateral move of a lane change: the minimum-jerk curve between two offsets, at rest at both ends.
//!
//! ```text
//!  d(x) = d_0 + (d_1 - d_0) (10 x^3 - 15 x^4 + 6 x^5),   x = (t - t_0) / T in [0, 1]
//! ```
//!
//! Source: Flash & Hogan, J. Neurosci. 5, 1688 (1985). Its largest acceleration is 10 / sqrt(3) (d_1 - d_0) / T^2.

/// A lane change, planned, under way or done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneChange {
    /// [s] t_0, its start.
    pub start: f64,
    /// [s] T, its duration, positive.
    pub duration: f64,
    /// [m] d_0, offset at its start.
    pub from: f64,
    /// [m] d_1, offset at its end.
    pub to: f64,
}

/// Offset and its first two derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lateral {
    /// [m] offset.
    pub d: f64,
    /// [m/s] its rate of change.
    pub rate: f64,
    /// [m/s2] the rate of change of that.
    pub accel: f64,
}

impl LaneChange {
    /// No change: the offset `d` held from `start` on.
    pub const fn none(start: f64, d: f64) -> Self {
        Self {
            start,
            duration: 1.0,
            from: d,
            to: d,
        }
    }

    /// The change from `from` to `to` whose largest lateral acceleration is `accel` [m/s2].
    ///
    /// By hand: 3.5 m at 5 m/s2 takes sqrt(10 / sqrt(3) x 3.5 / 5) = 2.0104 s.
    /// ```
    /// use zhuyi_core::lane_change::LaneChange;
    /// assert!((LaneChange::within(0.0, 0.0, 3.5, 5.0).duration - 2.0104).abs() < 1e-4);
    /// ```
    pub fn within(start: f64, from: f64, to: f64, accel: f64) -> Self {
        let duration = (10.0 / 3f64.sqrt() * (to - from).abs() / accel)
            .sqrt()
            .max(0.1);
        Self {
            start,
            duration,
            from,
            to,
        }
    }

    /// Where it is at `time`; before its start and behind its end at rest.
    ///
    /// By hand: half-way through 2 s from 0 to 3.5 m: 1.75 m at 15/8 x 3.5 / 2 = 3.28125 m/s, not accelerating.
    /// ```
    /// use zhuyi_core::lane_change::LaneChange;
    /// let half = LaneChange { start: 1.0, duration: 2.0, from: 0.0, to: 3.5 }.at(2.0);
    /// assert_eq!((half.d, half.rate, half.accel), (1.75, 3.28125, 0.0));
    /// ```
    #[inline]
    pub fn at(&self, time: f64) -> Lateral {
        if self.from == self.to {
            return Lateral {
                d: self.to,
                rate: 0.0,
                accel: 0.0,
            };
        }
        let x = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        let way = self.to - self.from;
        Lateral {
            d: self.from + way * x * x * x * (10.0 + x * (6.0 * x - 15.0)),
            rate: way * 30.0 * x * x * (x * (x - 2.0) + 1.0) / self.duration,
            accel: way * 60.0 * x * (x * (2.0 * x - 3.0) + 1.0) / (self.duration * self.duration),
        }
    }

    /// Where it is at `time`, if it stays there from then on.
    pub fn settled(&self, time: f64) -> Option<Lateral> {
        let over = self.from == self.to || (time - self.start) / self.duration >= 1.0;
        over.then(|| self.at(time))
    }

    /// [s] its end.
    pub fn end(&self) -> f64 {
        self.start + self.duration
    }
}
