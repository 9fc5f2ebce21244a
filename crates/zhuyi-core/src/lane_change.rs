//! The lateral move of a lane change: the curve of least jerk between two offsets, at rest at its end.
//!
//! ```text
//!  d(x) = d_0 + (d_1 - d_0) (10 x^3 - 15 x^4 + 6 x^5)
//!             + T v_0 (x - 6 x^3 + 8 x^4 - 3 x^5)
//!             + T^2 a_0 / 2 (x^2 - 3 x^3 + 3 x^4 - x^5),   x = (t - t_0) / T in [0, 1]
//! ```
//!
//! Source: Flash & Hogan, J. Neurosci. 5, 1688 (1985), whose curve is that from rest: v_0 = a_0 = 0. Its largest acceleration is
//! 10 / sqrt(3) (d_1 - d_0) / T^2. The quintic that meets offset, speed and acceleration at both ends is the one of least jerk
//! between them (the Euler-Lagrange equation of jerk squared is d^(6) = 0); a move that interrupts another begins with the speed
//! and acceleration of that one.
//!
//! From rest an offset stays between d_0 and d_1. With a speed at the start it may go beyond both: a move that turns back half-way
//! first goes on a little the old way, and one that takes over a fast move may pass its end and come back.

/// A lane change, planned, under way or done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneChange {
    /// [s] t_0, its start.
    pub start: f64,
    /// [s] T, its duration, positive.
    pub duration: f64,
    /// [m] d_0, offset at its start.
    pub from: f64,
    /// [m/s] v_0, rate of change of the offset at its start.
    pub rate: f64,
    /// [m/s2] a_0, rate of change of that at its start.
    pub accel: f64,
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
        Self::from_rest(start, 1.0, d, d)
    }

    /// The change from rest at the offset `from` to the offset `to` within `duration` [s].
    pub const fn from_rest(start: f64, duration: f64, from: f64, to: f64) -> Self {
        Self {
            start,
            duration,
            from,
            rate: 0.0,
            accel: 0.0,
            to,
        }
    }

    /// The change to the offset `to` within `duration` [s] that goes on from `now`: offset, rate and acceleration are continuous.
    ///
    /// By hand: 3.28125 m/s to the left at offset 0, and back to 0 in 2 s: after 1 s T v_0 (x - 6 x^3 + 8 x^4 - 3 x^5) at x = 1/2 is
    /// 2 x 3.28125 x 5/32 = 1.025390625 m.
    /// ```
    /// use zhuyi_core::lane_change::{LaneChange, Lateral};
    /// let now = Lateral { d: 0.0, rate: 3.28125, accel: 0.0 };
    /// let back = LaneChange::going_on(5.0, 2.0, now, 0.0);
    /// assert_eq!(back.at(5.0), now);
    /// assert_eq!(back.at(6.0).d, 1.025390625);
    /// assert_eq!(back.at(7.0), Lateral { d: 0.0, rate: 0.0, accel: 0.0 });
    /// ```
    pub const fn going_on(start: f64, duration: f64, now: Lateral, to: f64) -> Self {
        Self {
            start,
            duration,
            from: now.d,
            rate: now.rate,
            accel: now.accel,
            to,
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
        Self::from_rest(start, duration, from, to)
    }

    /// Where it is at `time`: before its start as at its start, behind its end at rest.
    ///
    /// By hand: half-way through 2 s from 0 to 3.5 m: 1.75 m at 15/8 x 3.5 / 2 = 3.28125 m/s, not accelerating.
    /// ```
    /// use zhuyi_core::lane_change::LaneChange;
    /// let half = LaneChange::from_rest(1.0, 2.0, 0.0, 3.5).at(2.0);
    /// assert_eq!((half.d, half.rate, half.accel), (1.75, 3.28125, 0.0));
    /// ```
    #[inline]
    pub fn at(&self, time: f64) -> Lateral {
        if self.stays() {
            return Lateral {
                d: self.to,
                rate: 0.0,
                accel: 0.0,
            };
        }
        let x = ((time - self.start) / self.duration).clamp(0.0, 1.0);
        let way = self.to - self.from;
        let from_rest = Lateral {
            d: self.from + way * x * x * x * (10.0 + x * (6.0 * x - 15.0)),
            rate: way * 30.0 * x * x * (x * (x - 2.0) + 1.0) / self.duration,
            accel: way * 60.0 * x * (x * (2.0 * x - 3.0) + 1.0) / (self.duration * self.duration),
        };
        if self.begins_at_rest() {
            from_rest
        } else {
            self.with_start(x, from_rest)
        }
    }

    /// The move from rest at `x`, with what speed and acceleration at the start add to it.
    fn with_start(&self, x: f64, from_rest: Lateral) -> Lateral {
        let t = self.duration;
        let (v, a) = (self.rate, self.accel);
        let d_v = x * (1.0 + x * x * (x * (8.0 - 3.0 * x) - 6.0));
        let d_a = 0.5 * x * x * (1.0 + x * (x * (3.0 - x) - 3.0));
        let rate_v = 1.0 + x * x * (x * (32.0 - 15.0 * x) - 18.0);
        let rate_a = x * (1.0 + x * (x * (6.0 - 2.5 * x) - 4.5));
        let accel_v = x * (x * (96.0 - 60.0 * x) - 36.0);
        let accel_a = 1.0 + x * (x * (18.0 - 10.0 * x) - 9.0);
        Lateral {
            d: from_rest.d + t * (v * d_v + t * a * d_a),
            rate: from_rest.rate + v * rate_v + t * a * rate_a,
            accel: from_rest.accel + v / t * accel_v + a * accel_a,
        }
    }

    fn begins_at_rest(&self) -> bool {
        self.rate == 0.0 && self.accel == 0.0
    }

    /// Whether nothing moves at all.
    fn stays(&self) -> bool {
        self.from == self.to && self.begins_at_rest()
    }

    /// Where it is at `time`, if it stays there from then on.
    pub fn settled(&self, time: f64) -> Option<Lateral> {
        let over = self.stays() || (time - self.start) / self.duration >= 1.0;
        over.then(|| self.at(time))
    }

    /// [s] its end.
    pub fn end(&self) -> f64 {
        self.start + self.duration
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in 0..1 that look random: Weyl's sequence of the golden ratio.
    fn numbers() -> impl Iterator<Item = f64> {
        (1..).map(|i| f64::from(i) * 0.618_033_988_749_894_9 % 1.0)
    }

    #[test]
    fn law_both_ends_are_met_and_the_derivatives_are_those_of_the_offset() {
        let mut drawn = numbers();
        let mut draw = |low: f64, high: f64| low + (high - low) * drawn.next().unwrap_or(0.5);
        for _ in 0..500 {
            let now = Lateral {
                d: draw(-5.0, 5.0),
                rate: draw(-5.0, 5.0),
                accel: draw(-8.0, 8.0),
            };
            let (start, duration, to) = (draw(0.0, 20.0), draw(0.5, 8.0), draw(-5.0, 5.0));
            let change = LaneChange::going_on(start, duration, now, to);
            assert_eq!(change.at(start), now);
            let end = change.at(start + duration + 1e-9);
            assert!((end.d - to).abs() < 1e-12, "{end:?}");
            assert_eq!((end.rate, end.accel), (0.0, 0.0));
            let h = 1e-5 * duration;
            for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let t = start + share * duration;
                let (before, here, after) = (change.at(t - h), change.at(t), change.at(t + h));
                let slope = (after.d - before.d) / (2.0 * h);
                assert!((slope - here.rate).abs() < 1e-6, "{slope} {here:?}");
                let slope = (after.rate - before.rate) / (2.0 * h);
                assert!((slope - here.accel).abs() < 1e-5, "{slope} {here:?}");
            }
        }
    }

    /// Speed and acceleration of zero add nothing, not even a rounding.
    #[test]
    fn law_going_on_from_rest_is_the_curve_from_rest() {
        let rest = Lateral {
            d: -3.5,
            rate: 0.0,
            accel: 0.0,
        };
        let (one, other) = (
            LaneChange::going_on(2.0, 3.0, rest, 0.0),
            LaneChange::from_rest(2.0, 3.0, -3.5, 0.0),
        );
        assert_eq!(one, other);
    }
}
