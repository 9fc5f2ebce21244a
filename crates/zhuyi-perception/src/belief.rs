//! What the ego believes about one actor: a filter along the road and one across it.
//!
//! Between measurements the state is carried on with constant acceleration along, never through standstill, and with
//! constant speed across:
//!
//! ```text
//! s(t) = s + v t + a t²/2,  t at most v / (-a) when a < 0;    d(t) = d + ḋ t
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s, v, a | along the road: position, speed, acceleration | m, m/s, m/s2 |
//! | d, ḋ | across: offset, speed | m, m/s |
//!
//! No one reverses on this road, so a negative speed counts as standstill. The covariances follow the linear model
//! of [`crate::axis`] throughout. A measurement older than the newest one taken is left out of the filter: another
//! camera with less latency has already told more.

use zhuyi_core::{ActorId, Detection, Footprint, Frenet, SimTime, Track};

use crate::Perception;
use crate::axis::{Axis, Measurement};

/// The state of one actor as of the exposure that measured it last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belief {
    seen: SimTime,
    footprint: Footprint,
    along: Axis,
    across: Axis,
}

impl Belief {
    /// After a first detection, exposed at `exposed`.
    pub fn start(detection: &Detection, exposed: SimTime, params: &Perception) -> Self {
        let (along, across) = measurements(detection, params);
        Self {
            seen: exposed,
            footprint: detection.footprint,
            along: Axis::start(&along),
            across: Axis::start(&across),
        }
    }

    /// Takes a further detection, unless it is older than the newest.
    pub fn measure(&mut self, detection: &Detection, exposed: SimTime, params: &Perception) {
        if exposed < self.seen {
            return;
        }
        (self.along, self.across) = self.predict(exposed, params);
        self.seen = exposed;
        self.footprint = detection.footprint;
        let (along, across) = measurements(detection, params);
        self.along.measure(&along);
        self.across.measure(&across);
    }

    /// The actor as believed to be at `time`; as last seen, where that is later.
    pub fn track(&self, actor: ActorId, time: SimTime, params: &Perception) -> Track {
        let elapsed = self.elapsed(time);
        let ([s, s_rate, s_accel], d) = self.carried(elapsed);
        Track {
            actor,
            time: time.max(self.seen),
            seen: self.seen,
            footprint: self.footprint,
            road: Frenet { s, d },
            s_rate,
            s_accel,
            d_rate: self.across.mean.y,
            s_deviation: self
                .along
                .deviation_after(elapsed, params.jerk_density_along),
            d_deviation: self
                .across
                .deviation_after(elapsed, params.jerk_density_across),
        }
    }

    /// The place of its centre then.
    pub fn place(&self, time: SimTime) -> Frenet {
        let ([s, ..], d) = self.carried(self.elapsed(time));
        Frenet { s, d }
    }

    /// The state along the road and the offset, `elapsed` seconds after the exposure.
    fn carried(&self, elapsed: f64) -> ([f64; 3], f64) {
        let along = carry_forward(self.along.mean.into(), elapsed);
        (along, self.across.mean.x + self.across.mean.y * elapsed)
    }

    /// Its box, as last seen.
    pub fn footprint(&self) -> Footprint {
        self.footprint
    }

    fn predict(&self, time: SimTime, params: &Perception) -> (Axis, Axis) {
        let elapsed = self.elapsed(time);
        let mut along = self.along.predict(elapsed, params.jerk_density_along);
        along.mean = carry_forward(self.along.mean.into(), elapsed).into();
        (
            along,
            self.across.predict(elapsed, params.jerk_density_across),
        )
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
        [position + f64::midpoint(speed, later) * time, later, accel]
    } else if accel < 0.0 {
        [position + speed * speed / (-2.0 * accel), 0.0, 0.0]
    } else {
        [position, 0.0, accel]
    }
}

fn measurements(detection: &Detection, params: &Perception) -> (Measurement, Measurement) {
    let measurement = |position, speed, position_deviation| Measurement {
        position,
        speed,
        position_deviation,
        speed_deviation: params.noise_speed,
    };
    (
        measurement(detection.road.s, detection.s_rate, params.noise_along),
        measurement(detection.road.d, detection.d_rate, params.noise_across),
    )
}
