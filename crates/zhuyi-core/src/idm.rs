//! The Intelligent Driver Model and its improved form: acceleration of a driver behind a leader.
//!
//! ```text
//!  s* = s0 + max(0, v T + v (v - v_l) / (2 sqrt(a b)))
//!  IDM   dv/dt = a [1 - (v/v0)^δ - (s*/s)^2]
//! ```
//!
//! | symbol | field | unit |
//! |---|---|---|
//! | v0 | `desired_speed` | m/s |
//! | T | `time_headway` | s |
//! | s0 | `min_gap` | m |
//! | a | `max_accel` | m/s2 |
//! | b | `comfortable_decel` | m/s2 |
//! | δ | `exponent` | - |
//!
//! The improved model (IIDM) keeps the gap `s0 + v T` at every speed up to v0, where the plain one lets it grow without
//! bound as v approaches v0. Sources: Treiber, Hennecke, Helbing, Phys. Rev. E 62, 1805 (2000); Treiber & Kesting,
//! Traffic Flow Dynamics (2013), sections 11.3 and 11.3.7. Left out: reaction time and estimation errors, which here come
//! from the cameras.

/// A driver's parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Idm {
    /// [m/s] v0, desired speed.
    pub desired_speed: f64,
    /// [s] T, time headway.
    pub time_headway: f64,
    /// [m] s0, gap at standstill.
    pub min_gap: f64,
    /// [m/s2] a, hardest acceleration.
    pub max_accel: f64,
    /// [m/s2] b, comfortable deceleration.
    pub comfortable_decel: f64,
    /// [-] δ, how fast the acceleration falls off towards v0.
    pub exponent: f64,
}

/// The vehicle ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// [m] gap, its rear bumper to the driver's front bumper.
    pub gap: f64,
    /// [m/s] its speed.
    pub speed: f64,
}

impl Idm {
    /// [m] s*, the gap wanted at speed `v` behind a leader at `v_l`. The dynamic part never shrinks it below s0.
    pub fn wanted_gap(&self, v: f64, v_l: f64) -> f64 {
        let dynamic = v * self.time_headway
            + v * (v - v_l) / (2.0 * (self.max_accel * self.comfortable_decel).sqrt());
        self.min_gap + dynamic.max(0.0)
    }

    /// [m/s2] the plain model. With no leader, the free-road acceleration.
    ///
    /// By hand, v = 20 of v0 = 30 m/s, T = 1.5, s0 = 2, a = 1, b = 2, δ = 4, no closing, gap 32 m = s*:
    /// 1 - (2/3)^4 - 1 = -0.19753.
    /// ```
    /// use zhuyi_core::idm::{Idm, Leader};
    /// let driver = Idm { desired_speed: 30.0, time_headway: 1.5, min_gap: 2.0, max_accel: 1.0,
    ///                    comfortable_decel: 2.0, exponent: 4.0 };
    /// let a = driver.accel(20.0, Some(Leader { gap: 32.0, speed: 20.0 }));
    /// assert!((a + 16.0 / 81.0).abs() < 1e-12);
    /// ```
    pub fn accel(&self, v: f64, leader: Option<Leader>) -> f64 {
        let free = 1.0 - power(self.share_of_desired(v), self.exponent);
        let interaction = leader.map_or(0.0, |l| {
            (self.wanted_gap(v, l.speed) / l.gap.max(f64::MIN_POSITIVE)).powi(2)
        });
        self.max_accel * (free - interaction)
    }

    /// [m/s2] the improved model.
    ///
    /// At the steady gap `s0 + v T` behind a leader of the same speed it is 0 at every speed up to v0:
    /// ```
    /// use zhuyi_core::idm::{Idm, Leader};
    /// let driver = Idm { desired_speed: 20.0, time_headway: 1.5, min_gap: 2.0, max_accel: 1.0,
    ///                    comfortable_decel: 2.0, exponent: 4.0 };
    /// for v in [5.0, 19.0, 20.0] {
    ///     let gap = driver.steady_gap(v);
    ///     assert!(driver.improved_accel(v, Some(Leader { gap, speed: v })).abs() < 1e-12);
    /// }
    /// ```
    pub fn improved_accel(&self, v: f64, leader: Option<Leader>) -> f64 {
        let free = self.improved_free_accel(v);
        leader.map_or(free, |leader| self.improved_accel_behind(v, leader, free))
    }

    /// [m/s2] the improved model with no leader.
    pub fn improved_free_accel(&self, v: f64) -> f64 {
        let (a, b, v0) = (self.max_accel, self.comfortable_decel, self.desired_speed);
        if v <= v0 {
            a * (1.0 - power(self.share_of_desired(v), self.exponent))
        } else {
            -b * (1.0 - libm::pow(v0 / v, a * self.exponent / b))
        }
    }

    /// [m/s2] the improved model behind a leader, given its `free` acceleration at the same speed.
    pub fn improved_accel_behind(&self, v: f64, leader: Leader, free: f64) -> f64 {
        let (a, v0) = (self.max_accel, self.desired_speed);
        let z = self.wanted_gap(v, leader.speed) / leader.gap.max(f64::MIN_POSITIVE);
        match (v <= v0, z >= 1.0) {
            (true, true) => a * (1.0 - z * z),
            (true, false) if free <= 0.0 => free,
            (true, false) => free * (1.0 - libm::pow(z, 2.0 * a / free)),
            (false, true) => free + a * (1.0 - z * z),
            (false, false) => free,
        }
    }

    /// [-] v/v0; a driver who wants to stand and stands has all that he wants.
    fn share_of_desired(&self, v: f64) -> f64 {
        if v == self.desired_speed {
            1.0
        } else {
            v / self.desired_speed
        }
    }

    /// [m] s0 + v T, the improved model's gap behind a leader of the same speed `v`, at most v0.
    pub fn steady_gap(&self, v: f64) -> f64 {
        self.min_gap + v * self.time_headway
    }

    /// [m] the plain model's gap behind a leader of the same speed `v` below v0: (s0 + v T) / sqrt(1 - (v/v0)^δ).
    ///
    /// ```
    /// use zhuyi_core::idm::Idm;
    /// let driver = Idm { desired_speed: 33.33, time_headway: 1.6, min_gap: 2.0, max_accel: 0.73,
    ///                    comfortable_decel: 1.67, exponent: 4.0 };
    /// assert!((driver.plain_steady_gap(20.0) - 36.443).abs() < 0.02); // Treiber et al. 2000
    /// ```
    pub fn plain_steady_gap(&self, v: f64) -> f64 {
        self.steady_gap(v) / (1.0 - power(v / self.desired_speed, self.exponent)).sqrt()
    }
}

/// Returns `base` to the power of `exponent`; the usual exponent of 4 by two squarings.
#[inline]
fn power(base: f64, exponent: f64) -> f64 {
    if exponent == 4.0 {
        let square = base * base;
        square * square
    } else {
        libm::pow(base, exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regress_a_driver_who_wants_to_stand_stands() {
        let driver = Idm {
            desired_speed: 0.0,
            time_headway: 1.5,
            min_gap: 2.0,
            max_accel: 1.0,
            comfortable_decel: 2.0,
            exponent: 4.0,
        };
        let far = Some(Leader {
            gap: 50.0,
            speed: 10.0,
        });
        for leader in [None, far] {
            assert_eq!(driver.improved_accel(0.0, leader), 0.0);
        }
        assert_eq!(driver.accel(0.0, None), 0.0);
        assert_eq!(driver.improved_accel(5.0, None), -2.0);
    }
}
