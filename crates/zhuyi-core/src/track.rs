//! What the ego believes about one actor.

use crate::{ActorId, Body, Footprint, Frenet, SimTime};

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
    /// [rad] estimated heading against the road.
    pub turn: f64,
    /// Its box as it stands on the road: [`Footprint::turned`] by `turn`.
    pub extent: Footprint,
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
    /// The truth about an actor as a track: known exactly and at once.
    pub fn exact(actor: ActorId, time: SimTime, body: &Body) -> Self {
        Self {
            actor,
            time,
            seen: time,
            footprint: body.footprint,
            road: body.road,
            turn: body.turn,
            extent: body.extent,
            s_rate: body.s_rate,
            s_accel: body.accel,
            d_rate: body.d_rate,
            s_deviation: 0.0,
            d_deviation: 0.0,
        }
    }

    /// [m] `s` of its rearmost edge.
    pub fn rear(&self) -> f64 {
        self.road.s - self.extent.length / 2.0
    }

    /// [m] `s` of its foremost edge.
    pub fn front(&self) -> f64 {
        self.road.s + self.extent.length / 2.0
    }
}
