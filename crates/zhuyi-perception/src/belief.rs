//! What the ego believes about one actor: a filter along the road, one across it and one of its heading.
//!
//! Between measurements the state is carried on with constant acceleration along, never through standstill, and with
//! constant speed across:
//!
//! ```text
//! s(t) = s + v t + a t²/2,  t at most v / (-a) when a < 0;    d(t) = d + ḋ t;    ψ(t) = ψ
//!
//! ψ' = ψ + P⁻ / (P⁻ + σ_ψ²) (measured - ψ),   P⁻ = P + q t        (Kalman filter of a heading that wanders)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s, v, a | along the road: position, speed, acceleration | m, m/s, m/s2 |
//! | d, ḋ | across: offset, speed | m, m/s |
//! | ψ, P | heading against the road, its variance | rad, rad2 |
//! | q | variance that a heading gains per second | rad2/s |
//!
//! No one reverses on this road, so a negative speed counts as standstill. The covariances follow the linear model
//! of [`crate::axis`] throughout. A measurement older than the newest one taken is left out of the filter: another
//! camera with less latency has already told more.

use wide::f64x2;
use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{ActorId, Detection, Footprint, Frenet, Road, SimTime, Track};

use crate::axis::{Axis, LEAST_DEVIATION, Measurement};
use crate::{Errors, Perception};

/// [rad2/s] q: the square of what a lane change turns a car by (0.1 rad/s) from one frame at 30 FPR to the next, per second.
const HEADING_DENSITY: f64 = 0.1 * 0.1 / 30.0;

/// The state of one actor as of the exposure that measured it last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belief {
    seen: SimTime,
    footprint: Footprint,
    /// Along the road and across it.
    axes: Axis<f64x2>,
    heading: Heading,
    /// The box as it stands on the road.
    extent: Footprint,
}

/// A filtered heading.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Heading {
    /// [rad] against the road.
    mean: f64,
    /// [rad2]
    variance: f64,
}

impl Heading {
    /// After a first measurement.
    fn start(measured: f64, errors: &Errors) -> Self {
        Self {
            mean: measured,
            variance: heading_variance(errors),
        }
    }

    /// Takes a further measurement `elapsed` seconds later.
    fn measure(&mut self, measured: f64, elapsed: f64, errors: &Errors) {
        let predicted = self.variance + HEADING_DENSITY * elapsed;
        let gain = predicted / (predicted + heading_variance(errors));
        self.mean += gain * wrap_angle(measured - self.mean);
        self.variance = predicted * (1.0 - gain);
    }
}

/// [rad2] variance of a measured heading.
fn heading_variance(errors: &Errors) -> f64 {
    errors.noise_heading.max(LEAST_DEVIATION).powi(2)
}

impl Belief {
    /// After a first detection, exposed at `exposed`.
    pub fn start(detection: &Detection, exposed: SimTime, errors: &Errors) -> Self {
        Self {
            seen: exposed,
            footprint: detection.footprint,
            axes: Axis::start(&measurement(detection, errors)),
            heading: Heading::start(detection.turn, errors),
            extent: detection.footprint.turned(detection.turn),
        }
    }

    /// Takes a further detection, unless it is older than the newest.
    #[inline]
    pub fn measure(
        &mut self,
        detection: &Detection,
        exposed: SimTime,
        errors: &Errors,
        params: &Perception,
    ) {
        if exposed < self.seen {
            return;
        }
        let elapsed = self.elapsed(exposed);
        let along = carry_forward(self.along(), elapsed);
        self.axes = self.axes.predict(elapsed, jerk_densities(params));
        for (predicted, along) in self.axes.mean.iter_mut().zip(along) {
            let [_, across] = predicted.to_array();
            *predicted = f64x2::new([along, across]);
        }
        self.seen = exposed;
        self.footprint = detection.footprint;
        self.axes.measure(&measurement(detection, errors));
        self.heading.measure(detection.turn, elapsed, errors);
        self.extent = self.footprint.turned(self.heading.mean);
    }

    /// The same belief, told in the lap of a ring in which it is nearest to `s` [m] at `time`.
    pub fn tell_near(&mut self, s: f64, time: SimTime, road: &Road) {
        let there = self.place(time).0.s;
        let laps = road.nearest_lap(there, s) - there;
        if laps != 0.0 {
            let [position, across] = self.axes.mean.x.to_array();
            self.axes.mean.x = f64x2::new([position + laps, across]);
        }
    }

    /// The actor as believed to be at `time`; as last seen, where that is later.
    pub fn track(&self, actor: ActorId, time: SimTime, params: &Perception) -> Track {
        let elapsed = self.elapsed(time);
        let ([s, s_rate, s_accel], d, d_rate) = self.carried(elapsed);
        let deviations = self.axes.deviation_after(elapsed, jerk_densities(params));
        let [s_deviation, d_deviation] = deviations.to_array();
        Track {
            actor,
            time: time.max(self.seen),
            seen: self.seen,
            footprint: self.footprint,
            road: Frenet { s, d },
            turn: self.heading.mean,
            extent: self.extent,
            s_rate,
            s_accel,
            d_rate,
            s_deviation,
            d_deviation,
        }
    }

    /// The place of its centre then, and its heading [rad] against the road.
    pub fn place(&self, time: SimTime) -> (Frenet, f64) {
        let ([s, ..], d, _) = self.carried(self.elapsed(time));
        (Frenet { s, d }, self.heading.mean)
    }

    /// The state along the road, the offset and its rate, `elapsed` seconds after the exposure.
    #[inline]
    fn carried(&self, elapsed: f64) -> ([f64; 3], f64, f64) {
        let [d, d_rate] = [self.axes.mean.x, self.axes.mean.y].map(|both| both.to_array()[1]);
        (
            carry_forward(self.along(), elapsed),
            d + d_rate * elapsed,
            d_rate,
        )
    }

    /// The expected state along the road, as of the exposure.
    #[inline]
    fn along(&self) -> [f64; 3] {
        let mean: [f64x2; 3] = self.axes.mean.into();
        mean.map(|both| both.to_array()[0])
    }

    /// Its box, as last seen.
    pub fn footprint(&self) -> Footprint {
        self.footprint
    }

    fn elapsed(&self, time: SimTime) -> f64 {
        (time - self.seen).max(SimTime::ZERO).seconds()
    }
}

/// Position [m], speed [m/s] and acceleration [m/s2] after `time` [s] of constant acceleration that ends at standstill.
///
/// ```
/// use zhuyi_perception::belief::carry_forward;
/// assert_eq!(carry_forward([0.0, 6.0, -2.0], 1.0), [5.0, 4.0, -2.0]);
/// assert_eq!(carry_forward([0.0, 6.0, -2.0], 9.0), [9.0, 0.0, 0.0]);
/// assert_eq!(carry_forward([0.0, -1.0, 2.0], 1.0), [1.0, 2.0, 2.0]);
/// ```
pub fn carry_forward([position, speed, accel]: [f64; 3], time: f64) -> [f64; 3] {
    let speed = speed.max(0.0);
    let later = speed + accel * time;
    if later > 0.0 {
        [position + 0.5 * (speed + later) * time, later, accel]
    } else if accel < 0.0 {
        [position + speed * speed / (-2.0 * accel), 0.0, 0.0]
    } else {
        [position, 0.0, accel]
    }
}

/// Along and across.
fn measurement(detection: &Detection, errors: &Errors) -> Measurement<f64x2> {
    Measurement {
        position: f64x2::new([detection.road.s, detection.road.d]),
        speed: f64x2::new([detection.s_rate, detection.d_rate]),
        position_deviation: f64x2::new([errors.noise_along, errors.noise_across]),
        speed_deviation: f64x2::splat(errors.noise_speed),
    }
}

/// [m2/s5] along and across.
fn jerk_densities(params: &Perception) -> f64x2 {
    f64x2::new([params.jerk_density_along, params.jerk_density_across])
}
