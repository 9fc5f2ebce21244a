//! The Kalman filter of one coordinate, along the road or across it, or of both side by side.
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
//! Leaves out any coupling between along and across: both are one filter of [`f64x2`], each in a lane of its own, and
//! each lane is to the last bit what a filter of `f64` makes of it.

use std::ops::{Add, Div, Mul, Sub};

use nalgebra::{Matrix3, Scalar, Vector3};
use wide::f64x2;

/// [m/s2] standard deviation of the acceleration of an actor that has been seen once.
pub const FIRST_ACCEL_DEVIATION: f64 = 3.0;

/// [m], [m/s] the least standard deviation that a measurement is credited with. It keeps the filter regular where a
/// user switches the noise off.
pub const LEAST_DEVIATION: f64 = 1e-3;

/// What a filter reckons in: a number, or two side by side.
pub trait Number:
    Scalar + Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// The same in every lane.
    fn all(value: f64) -> Self;
    /// The larger in every lane.
    #[must_use]
    fn at_least(self, least: f64) -> Self;
    /// The square root in every lane.
    #[must_use]
    fn root(self) -> Self;
}

impl Number for f64 {
    fn all(value: f64) -> Self {
        value
    }
    fn at_least(self, least: f64) -> Self {
        self.max(least)
    }
    fn root(self) -> Self {
        self.sqrt()
    }
}

impl Number for f64x2 {
    #[inline]
    fn all(value: f64) -> Self {
        Self::splat(value)
    }
    #[inline]
    fn at_least(self, least: f64) -> Self {
        self.max(Self::splat(least))
    }
    #[inline]
    fn root(self) -> Self {
        self.sqrt()
    }
}

/// A measured position and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement<N = f64> {
    /// [m] position.
    pub position: N,
    /// [m/s] speed.
    pub speed: N,
    /// [m] standard deviation of the position.
    pub position_deviation: N,
    /// [m/s] standard deviation of the speed.
    pub speed_deviation: N,
}

impl<N: Number> Measurement<N> {
    /// The measured entries, position and speed, with their variances.
    fn entries(&self) -> [(N, N); 2] {
        let variance = |deviation: N| {
            let deviation = deviation.at_least(LEAST_DEVIATION);
            deviation * deviation
        };
        [
            (self.position, variance(self.position_deviation)),
            (self.speed, variance(self.speed_deviation)),
        ]
    }
}

/// What is believed about one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<N: Scalar = f64> {
    /// [m, m/s, m/s2] expected position, speed and acceleration.
    pub mean: Vector3<N>,
    /// Its covariance.
    pub covariance: Matrix3<N>,
}

impl<N: Number> Axis<N> {
    /// After the first measurement: no acceleration, within [`FIRST_ACCEL_DEVIATION`].
    pub fn start(measured: &Measurement<N>) -> Self {
        let [(position, position_variance), (speed, speed_variance)] = measured.entries();
        let (zero, accel_variance) = (N::all(0.0), N::all(FIRST_ACCEL_DEVIATION.powi(2)));
        let variances = [position_variance, speed_variance, accel_variance];
        Self {
            mean: Vector3::new(position, speed, zero),
            covariance: Matrix3::from_fn(|r, c| if r == c { variances[r] } else { zero }),
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
    #[inline]
    pub fn predict(&self, time: f64, jerk_density: N) -> Self {
        // The products of the matrices above, without their zeros.
        let (x, p) = (&self.mean, &self.covariance);
        let top = top_row(time);
        let (t, h) = (N::all(time), N::all(time * time / 2.0));
        let middle = |p1: N, p2: N| p1 + t * p2;
        let rows = [
            [
                top(p.m11, p.m21, p.m31),
                top(p.m12, p.m22, p.m32),
                top(p.m13, p.m23, p.m33),
            ],
            [
                middle(p.m21, p.m31),
                middle(p.m22, p.m32),
                middle(p.m23, p.m33),
            ],
            [p.m31, p.m32, p.m33],
        ];
        let [[a11, a12, a13], [a21, a22, a23], [a31, a32, a33]] =
            rows.map(|[a1, a2, a3]| [top(a1, a2, a3), middle(a2, a3), a3]);
        let q = jerk_density * t;
        Self {
            mean: Vector3::new(top(x.x, x.y, x.z), middle(x.y, x.z), x.z),
            #[rustfmt::skip]
            covariance: Matrix3::new(
                a11 + h * h * q, a12 + h * t * q, a13 + h * q,
                a21 + t * h * q, a22 + t * t * q, a23 + t * q,
                a31 + h * q,     a32 + t * q,     a33 + q,
            ),
        }
    }

    /// Takes a measurement of the present instant.
    #[inline]
    pub fn measure(&mut self, measured: &Measurement<N>) {
        let [position, speed] = measured.entries();
        self.take::<0>(position);
        self.take::<1>(speed);
    }

    /// Takes one measured entry and its variance.
    #[inline]
    fn take<const ENTRY: usize>(&mut self, (value, variance): (N, N)) {
        let p = &self.covariance;
        let innovation_variance = p[(ENTRY, ENTRY)] + variance;
        let gain: [N; 3] = [0, 1, 2].map(|r| p[(r, ENTRY)] / innovation_variance);
        let innovation = value - self.mean[ENTRY];
        self.mean = Vector3::from_fn(|r, _| self.mean[r] + gain[r] * innovation);
        // I - k e_iᵀ differs from I in one column alone.
        let one = N::all(1.0);
        let kept = |whole: N, place: usize, measured: N| {
            if place == ENTRY {
                measured * (one - gain[ENTRY])
            } else {
                whole - measured * gain[place]
            }
        };
        let left = Matrix3::from_fn(|r, c| kept(p[(r, c)], r, p[(ENTRY, c)]));
        self.covariance = Matrix3::from_fn(|r, c| {
            kept(left[(r, c)], c, left[(r, ENTRY)]) + gain[r] * gain[c] * variance
        });
    }

    /// [m] standard deviation of the position after `time` [s] without a measurement, as [`Axis::predict`] has it.
    #[inline]
    pub fn deviation_after(&self, time: f64, jerk_density: N) -> N {
        let (p, top) = (&self.covariance, top_row(time));
        let (t, h) = (N::all(time), N::all(time * time / 2.0));
        let first_row = (
            top(p.m11, p.m21, p.m31),
            top(p.m12, p.m22, p.m32),
            top(p.m13, p.m23, p.m33),
        );
        let variance = top(first_row.0, first_row.1, first_row.2) + h * h * (jerk_density * t);
        variance.root()
    }
}

/// The first row of F, to be multiplied by a column.
#[inline]
fn top_row<N: Number>(time: f64) -> impl Fn(N, N, N) -> N {
    let (t, h) = (N::all(time), N::all(time * time / 2.0));
    move |p0, p1, p2| p0 + t * p1 + h * p2
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The equations of the head of this file, as they stand there.
    fn plainly(axis: &Axis, time: f64, jerk_density: f64, measured: &Measurement) -> Axis {
        let t = time;
        #[rustfmt::skip]
        let f = Matrix3::new(
            1.0, t,   t * t / 2.0,
            0.0, 1.0, t,
            0.0, 0.0, 1.0,
        );
        let g = Vector3::new(t * t / 2.0, t, 1.0);
        let mut x = f * axis.mean;
        let mut p = f * axis.covariance * f.transpose() + g * g.transpose() * (jerk_density * t);
        for (entry, (value, variance)) in measured.entries().into_iter().enumerate() {
            let k = p.column(entry) / (p[(entry, entry)] + variance);
            x += k * (value - x[entry]);
            let mut keep = Matrix3::identity();
            let mut column = keep.column_mut(entry);
            column -= k;
            p = keep * p * keep.transpose() + k * k.transpose() * variance;
        }
        Axis {
            mean: x,
            covariance: p,
        }
    }

    #[test]
    fn law_the_filter_is_its_equations_to_the_last_bit() {
        let measured = |k: f64| Measurement {
            position: 20.0 * k + libm::sin(k),
            speed: 20.0 + libm::cos(3.0 * k),
            position_deviation: 0.3,
            speed_deviation: 0.4,
        };
        let mut axis = Axis::start(&measured(0.0));
        for step in 1..200 {
            let k = f64::from(step);
            let (time, jerk_density) = (0.01 * (1.0 + k % 97.0), 0.1 * (k % 5.0));
            let plain = plainly(&axis, time, jerk_density, &measured(k));
            let deviation = axis.deviation_after(time, jerk_density);
            axis = axis.predict(time, jerk_density);
            assert_eq!(deviation, axis.covariance[(0, 0)].sqrt(), "step {step}");
            axis.measure(&measured(k));
            assert_eq!(axis, plain, "step {step}");
        }
    }

    #[test]
    fn law_two_lanes_are_two_filters_to_the_last_bit() {
        let measured = |k: f64| {
            [0.0, 1.0].map(|lane| Measurement {
                position: 20.0 * k + libm::sin(k + lane),
                speed: 20.0 + libm::cos(3.0 * k + lane),
                position_deviation: 0.3 * lane,
                speed_deviation: 0.4,
            })
        };
        let beside = |[along, across]: [Measurement; 2]| Measurement {
            position: f64x2::new([along.position, across.position]),
            speed: f64x2::new([along.speed, across.speed]),
            position_deviation: f64x2::new([along.position_deviation, across.position_deviation]),
            speed_deviation: f64x2::new([along.speed_deviation, across.speed_deviation]),
        };
        let mut both = Axis::start(&beside(measured(0.0)));
        let mut each = measured(0.0).map(|measured| Axis::start(&measured));
        for step in 1..200 {
            let k = f64::from(step);
            let (time, density) = (0.01 * (1.0 + k % 97.0), [0.1 * (k % 5.0), 0.3]);
            let deviations = both.deviation_after(time, f64x2::new(density)).to_array();
            both = both.predict(time, f64x2::new(density));
            both.measure(&beside(measured(k)));
            for lane in 0..2 {
                let axis = &mut each[lane];
                assert_eq!(deviations[lane], axis.deviation_after(time, density[lane]));
                *axis = axis.predict(time, density[lane]);
                axis.measure(&measured(k)[lane]);
                assert_eq!(
                    both.mean.map(|x| x.to_array()[lane]),
                    axis.mean,
                    "step {step}"
                );
                let covariance = both.covariance.map(|x| x.to_array()[lane]);
                assert_eq!(covariance, axis.covariance, "step {step}");
            }
        }
    }
}
