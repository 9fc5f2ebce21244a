//! What the ego believes about one actor.

use crate::{ActorId, Footprint, Frenet, SimTime};

/// A confirmed actor as the ego believes it to be at `time`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Track {
    /// Which actor.
    pub actor: ActorId,
    /// The instant that the state below speaks of.
    pub time: SimTime,
    /// The exposure of the newest frame that measured it.
    pub seen: SimTime,
    /// Its box.
    pub footprint: Footprint,
    /// Estimated centre on the road.
    pub road: Frenet,
    /// [m/s] estimated rate of change of `s`.
    pub s_rate: f64,
    /// [m/s2] estimated rate of change of `s_rate`.
    pub s_accel: f64,
    /// [m/s] estimated rate of change of `d`.
    pub d_rate: f64,
    /// [m] standard deviation of the estimated `s`.
    pub s_deviation: f64,
    /// [m] standard deviation of the estimated `d`.
    pub d_deviation: f64,
}

impl Track {
    /// [m] `s` of its rear bumper.
    pub fn rear(&self) -> f64 {
        self.road.s - self.footprint.length / 2.0
    }

    /// [m] `s` of its front bumper.
    pub fn front(&self) -> f64 {
        self.road.s + self.footprint.length / 2.0
    }
}
