//! The Kalman filter of one coordinate, along the road or across it.
//!
//! ```text
//! x = (p, v, a),   a jumps by a step of variance q t when a frame interval t begins, then holds
//!
//!     ⎡1  t  t²/2⎤       ⎡t²/2⎤
//! F = ⎢0  1   t  ⎥,   g = ⎢ t  ⎥,   Q = q t · g gᵀ,   P ← F P Fᵀ + Q
//!     ⎣0  0   1  ⎦       ⎣ 1  ⎦
//!
//! per measured entry i:  k = P e_i / (P_ii + r_i),  x ← x + k (z_i - x_i),
//!                        P ← (I - k e_iᵀ) P (I - k e_iᵀ)ᵀ + r_i k kᵀ
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | p, v, a | position, speed, acceleration | m, m/s, m/s2 |
//! | P | covariance of x | |
//! | q | variance that the acceleration gains per second | m2/s5 |
//! | z, r | measured position and speed, and their variances | m, m/s; squared |
//!
//! Source: Bar-Shalom, Li, Kirubarajan, *Estimation with Applications to Tracking and Navigation*, 2001, 6.3.3 (discrete
//! Wiener process acceleration); Joseph's form of the update, 3.4.2. A driver who begins to brake makes a step, not a
//! ramp: under white jerk (6.2.3) the estimate after a step overshoots by half at 1 Hz and then swings. The two errors
//! of a measurement are independent, so its entries may be taken one after the other and nothing has to be inverted.
//! Leaves out any coupling between along and across.

use nalgebra::{Matrix3, Vector3};

/// [m/s2] standard deviation of the acceleration of an actor that has been seen once.
pub const FIRST_ACCEL_DEVIATION: f64 = 3.0;

/// [m], [m/s] the least standard deviation that a measurement is credited with. It keeps the filter regular where a
/// user switches the noise off.
pub const LEAST_DEVIATION: f64 = 1e-3;

/// A measured position and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// [m] position.
    pub position: f64,
    /// [m/s] speed.
    pub speed: f64,
    /// [m] standard deviation of the position.
    pub position_deviation: f64,
    /// [m/s] standard deviation of the speed.
    pub speed_deviation: f64,
}

impl Measurement {
    /// The measured entries with their variances: place in the state, value, variance.
    fn entries(&self) -> [(usize, f64, f64); 2] {
        let variance = |deviation: f64| deviation.max(LEAST_DEVIATION).powi(2);
        [
            (0, self.position, variance(self.position_deviation)),
            (1, self.speed, variance(self.speed_deviation)),
        ]
    }
}

/// What is believed about one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// [m, m/s, m/s2] expected position, speed and acceleration.
    pub mean: Vector3<f64>,
    /// Its covariance.
    pub covariance: Matrix3<f64>,
}

impl Axis {
    /// After the first measurement: no acceleration, within [`FIRST_ACCEL_DEVIATION`].
    pub fn start(measured: &Measurement) -> Self {
        let [(_, position, position_variance), (_, speed, speed_variance)] = measured.entries();
        Self {
            mean: Vector3::new(position, speed, 0.0),
            covariance: Matrix3::from_diagonal(&Vector3::new(
                position_variance,
                speed_variance,
                FIRST_ACCEL_DEVIATION.powi(2),
            )),
        }
    }

    /// After `time` [s] without a measurement, for an acceleration whose variance grows by `jerk_density` [m2/s5].
    ///
    /// ```
    /// use zhuyi_perception::axis::{Axis, Measurement};
    /// let seen = Measurement { position: 5.0, speed: 10.0, position_deviation: 0.1, speed_deviation: 0.2 };
    /// let later = Axis::start(&seen).predict(2.0, 0.0);
    /// assert_eq!(later.mean[0], 25.0);
    /// // 0.1² + (2 · 0.2)² + (2²/2 · 3)²
    /// assert!((later.covariance[(0, 0)] - 36.17).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn predict(&self, time: f64, jerk_density: f64) -> Self {
        let t = time;
        #[rustfmt::skip]
        let f = Matrix3::new(
            1.0, t,   t * t / 2.0,
            0.0, 1.0, t,
            0.0, 0.0, 1.0,
        );
        let g = Vector3::new(t * t / 2.0, t, 1.0);
        let q = g * g.transpose() * (jerk_density * t);
        Self {
            mean: f * self.mean,
            covariance: f * self.covariance * f.transpose() + q,
        }
    }

    /// Takes a measurement of the present instant.
    pub fn measure(&mut self, measured: &Measurement) {
        for (entry, value, variance) in measured.entries() {
            let gain = self.covariance.column(entry) / (self.covariance[(entry, entry)] + variance);
            self.mean += gain * (value - self.mean[entry]);
            let mut keep = Matrix3::identity();
            let mut column = keep.column_mut(entry);
            column -= gain;
            self.covariance =
                keep * self.covariance * keep.transpose() + gain * gain.transpose() * variance;
        }
    }

    /// [m] standard deviation of the position.
    pub fn deviation(&self) -> f64 {
        self.covariance[(0, 0)].sqrt()
    }
}
