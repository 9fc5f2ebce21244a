//! Beyond the paper: what is not known exactly of an actor shrinks the gap (option [`Params::uncertainty`]).
//!
//! ```text
//!  var_s(l) = P_ss + 2 P_sv l + (P_vv + P_sa) l² + P_va l³ + P_aa l⁴/4 + q l⁵/4
//!  m(l) = k sqrt(var_s(l)),   d(t) + m(l) takes the place of d(t) in Eq. 1 and in reading R6
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | P | covariance of the track's position s, speed v and acceleration a as of its newest frame | |
//! | q | variance that the acceleration gains per second, by a step when a frame interval begins | m2/s5 |
//! | l | candidate latency: how old the newest frame is when the next one is processed | s |
//! | k | standard deviations that count | - |
//! | m | head start of the ego | m |
//!
//! This is the covariance of a track that is carried on over one frame interval without a measurement, the corner
//! e_s' (F P F' + q l g g') e_s with F = [1 l l²/2; 0 1 l; 0 0 1] and g = (l²/2, l, 1): discrete Wiener process
//! acceleration, the model that zhuyi-perception tracks by. Source: Bar-Shalom, Li, Kirubarajan, *Estimation with
//! Applications to Tracking and Navigation*, 2001, 6.3.3.
//!
//! **m(l) never falls.** A negative covariance would let it; the terms of l in which it outweighs the rest count as
//! zero, which errs to the cautious side. So a smaller latency means that the ego reacts earlier and has the smaller
//! head start: it is at no time further, which is all that the one walk of the exact solver asks for.
//!
//! **Where m counts.** It stands beside d, undiminished: d + m <= C1 s and d + m <= s. The other reading,
//! d <= C1 (s - m), would count 0.9 m of it. To react at once has l = 0: what is uncertain in the newest frame remains.
//! When an actor enters the corridor (R7, R8) and how fast it is (Eq. 2) are taken as believed. Left out:
//! uncertainty across the path, and of where the actor will go, which is what several trajectories are for.

use zhuyi_core::Track;

use crate::{Estimator, Params};

/// The covariance of a track along the path: of position s, speed v and acceleration a.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Covariance {
    /// [m2] variance of the position.
    pub ss: f64,
    /// [m2/s] covariance of position and speed.
    pub sv: f64,
    /// [m2/s2] covariance of position and acceleration.
    pub sa: f64,
    /// [m2/s2] variance of the speed.
    pub vv: f64,
    /// [m2/s3] covariance of speed and acceleration.
    pub va: f64,
    /// [m2/s4] variance of the acceleration.
    pub aa: f64,
}

impl Covariance {
    /// Of independent errors with these standard deviations: position [m], speed [m/s], acceleration [m/s2].
    pub fn independent(position: f64, speed: f64, accel: f64) -> Self {
        Self {
            ss: position * position,
            vv: speed * speed,
            aa: accel * accel,
            ..Self::default()
        }
    }
}

/// How uncertain an actor's motion along the path is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertainty {
    /// [-] k, standard deviations by which the gap shrinks, not negative.
    pub sigmas: f64,
    /// P, of the newest frame.
    pub covariance: Covariance,
    /// [m2/s5] q, variance that the acceleration gains per second, not negative.
    pub jerk_density: f64,
}

impl Uncertainty {
    /// An example: the steady state of zhuyi-perception's filter with its default noise (0.1 m, 0.05 m/s, q = 3 m2/s5)
    /// at 30 FPR, and the one-sided 99 % of the normal distribution, as reading R13 takes 99 % of the futures.
    ///
    /// After 0.5 s the position is uncertain by 0.17 m and the gap shrinks by 0.39 m; after 1 s by 2.10 m.
    /// ```
    /// use zhuyi_estimator::Uncertainty;
    /// let example = Uncertainty::example();
    /// assert!((example.head_start(0.5) - 0.394).abs() < 1e-3);
    /// assert!((example.head_start(1.0) - 2.102).abs() < 1e-3);
    /// ```
    pub fn example() -> Self {
        Self {
            sigmas: 2.326,
            covariance: Covariance {
                ss: 1.64e-4,
                sv: 6.3e-5,
                sa: -1.50e-4,
                vv: 1.20e-3,
                va: 1.14e-2,
                aa: 0.216,
            },
            jerk_density: 3.0,
        }
    }

    /// Another: the same filter after its first frame, which knows nothing of the acceleration but that it is of the
    /// order of 3 m/s2.
    ///
    /// 2.326 sqrt(0.1² + (0.05 x 0.5)² + (0.125 x 3)² + 3 x 0.5⁵/4) = 0.973 m after 0.5 s.
    /// ```
    /// use zhuyi_estimator::Uncertainty;
    /// assert!((Uncertainty::first_sight().head_start(0.5) - 0.973).abs() < 1e-3);
    /// ```
    pub fn first_sight() -> Self {
        Self {
            covariance: Covariance::independent(0.1, 0.05, 3.0),
            ..Self::example()
        }
    }

    /// The same with the position as uncertain as a track says it is; correlations are kept.
    ///
    /// The track tells no more than that. What this uncertainty holds of speed, acceleration and process stays, and so
    /// should be of the tracker that the track comes from.
    #[must_use]
    pub fn of_track(self, track: &Track) -> Self {
        let variance = track.s_deviation * track.s_deviation;
        let Covariance { ss, sv, sa, .. } = self.covariance;
        let scale = if ss > 0.0 {
            (variance / ss).sqrt()
        } else {
            0.0
        };
        Self {
            covariance: Covariance {
                ss: variance,
                sv: scale * sv,
                sa: scale * sa,
                ..self.covariance
            },
            ..self
        }
    }

    /// [m2] variance of the position after `latency` without a frame.
    ///
    /// Deviations of 0.1 m, 0.2 m/s and 3 m/s2: after 2 s 0.1² + (2 x 0.2)² + (2²/2 x 3)² = 36.17 m2; q = 1 m2/s5 adds
    /// 2⁵/4 = 8.
    /// ```
    /// use zhuyi_estimator::uncertainty::{Covariance, Uncertainty};
    /// let covariance = Covariance::independent(0.1, 0.2, 3.0);
    /// let known = Uncertainty { sigmas: 2.0, covariance, jerk_density: 0.0 };
    /// assert!((known.variance(2.0) - 36.17).abs() < 1e-12);
    /// assert!((Uncertainty { jerk_density: 1.0, ..known }.variance(2.0) - 44.17).abs() < 1e-12);
    /// ```
    pub fn variance(&self, latency: f64) -> f64 {
        let Covariance {
            ss,
            sv,
            sa,
            vv,
            va,
            aa,
        } = self.covariance;
        let powers = [ss, 2.0 * sv, vv + sa, va, aa / 4.0, self.jerk_density / 4.0];
        // Horner's rule; a term that would make it fall counts as zero.
        let add = |sum: f64, term: &f64| sum * latency + term.max(0.0);
        powers.iter().rev().fold(0.0, add)
    }

    /// [m] m, by which the gap shrinks when frames are `latency` apart.
    pub fn head_start(&self, latency: f64) -> f64 {
        self.sigmas * self.variance(latency).sqrt()
    }
}

impl Estimator {
    /// This estimator for an actor that is as uncertain as this, such as [`Uncertainty::of_track`] says. It is a copy
    /// of a few hundred bytes and allocates nothing, so each actor of a scene may have its own.
    ///
    /// A car stands 50 m ahead of an ego at 10 m/s: of 45 m, 10.2 m are for braking. A position known to 1 m, at two
    /// standard deviations, takes 2 of the other 34.8 m: 3.28 s of reaction, `l + 5 (l - 1/30) <= 3.28`, and so 0.575 s,
    /// 0.571 s on the grid, where 0.604 s stood without.
    /// ```
    /// use zhuyi_core::{Across, Along, Footprint};
    /// use zhuyi_estimator::uncertainty::{Covariance, Uncertainty};
    /// use zhuyi_estimator::{Ego, Estimator, Future, Params};
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let ego = Ego { s: 0.0, d: 0.0, speed: 10.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 54.0, 0.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// let estimator = Estimator::new(Params::default());
    /// let uncertainty =
    ///     Uncertainty { sigmas: 2.0, covariance: Covariance::independent(1.0, 0.0, 0.0), jerk_density: 0.0 };
    /// let estimate = estimator.uncertain(uncertainty).trajectory(&ego, car, &future, 1.0 / 30.0);
    /// assert_eq!(estimate.latency, Some(0.571));
    /// assert_eq!(estimator.trajectory(&ego, car, &future, 1.0 / 30.0).latency, Some(0.604));
    /// ```
    #[must_use]
    pub fn uncertain(&self, uncertainty: Uncertainty) -> Self {
        self.with_params(Params {
            uncertainty: Some(uncertainty),
            ..self.params().clone()
        })
    }
}
