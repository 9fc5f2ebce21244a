//! Where an actor may go: trajectories in pieces, along and across the road.
//!
//! A trajectory is three independent lists of pieces in the time of the forecast. Along the road each piece is a
//! quadratic in `s` with a speed that is linear in time; across it a line in `d`; the half extents of a box that turns
//! against the road are lines too. A sampled future with linear interpolation (reading R10) and an integrator's own
//! steps of constant acceleration are both exactly that.

use crate::{ActorId, Footprint};

/// Motion along the road from `time` until the next piece starts; with `x = t - time`:
/// `s + s_rate x + s_half_accel x^2`, speed `v + v_rate x`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along {
    /// [s] start of the piece.
    pub time: f64,
    /// [m] centre of the box at its start.
    pub s: f64,
    /// [m/s] linear coefficient of `s`.
    pub s_rate: f64,
    /// [m/s2] quadratic coefficient of `s` (half an acceleration).
    pub s_half_accel: f64,
    /// [m/s] speed along the road at its start.
    pub v: f64,
    /// [m/s2] rate of change of that speed.
    pub v_rate: f64,
}

impl Along {
    /// A piece of constant acceleration: position and speed belong together.
    pub const fn constant_accel(time: f64, s: f64, v: f64, accel: f64) -> Self {
        Self {
            time,
            s,
            s_rate: v,
            s_half_accel: accel / 2.0,
            v,
            v_rate: accel,
        }
    }

    /// [m] centre of the box at `time`.
    pub fn s_at(&self, time: f64) -> f64 {
        let x = time - self.time;
        self.s + x * (self.s_rate + x * self.s_half_accel)
    }

    /// [m/s] speed at `time`.
    pub fn v_at(&self, time: f64) -> f64 {
        self.v + (time - self.time) * self.v_rate
    }
}

/// Motion across the road from `time` until the next piece starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across {
    /// [s] start of the piece.
    pub time: f64,
    /// [m] lateral offset of the centre of the box at its start.
    pub d: f64,
    /// [m/s] its rate of change.
    pub d_rate: f64,
}

/// Half extents along and across the road of a box as it stands, from `time` until the next piece starts (reading R7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// [s] start of the piece.
    pub time: f64,
    /// [m] half extent along the road at its start.
    pub along: f64,
    /// [m/s] rate of change of `along`.
    pub along_rate: f64,
    /// [m] half extent across the road at its start.
    pub across: f64,
    /// [m/s] rate of change of `across`.
    pub across_rate: f64,
}

impl Extent {
    /// The half extents of a box that keeps standing as it does: `footprint` [turned](Footprint::turned) by its heading.
    pub fn held(extent: Footprint) -> Self {
        Self {
            time: 0.0,
            along: extent.length / 2.0,
            along_rate: 0.0,
            across: extent.width / 2.0,
            across_rate: 0.0,
        }
    }

    /// Whether the box stands as it does while the piece lasts.
    pub fn is_at_rest(&self) -> bool {
        self.along_rate == 0.0 && self.across_rate == 0.0
    }

    /// [m] half extents along and across at `time`.
    #[inline]
    pub fn at(&self, time: f64) -> (f64, f64) {
        let x = time - self.time;
        (
            self.along + x * self.along_rate,
            self.across + x * self.across_rate,
        )
    }
}

/// One future of one actor. Each list is sorted by time, its last piece goes on for ever; those of motion are not empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Motion along the road.
    pub along: Vec<Along>,
    /// Motion across the road.
    pub across: Vec<Across>,
    /// Half extents of the box as it stands; empty where it keeps aligned with the road.
    pub extents: Vec<Extent>,
    /// [s] time from which on the future is extrapolated rather than predicted or recorded.
    pub known_until: f64,
}

/// The possible futures of one actor with their probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct Forecast {
    /// Which actor.
    pub actor: ActorId,
    /// Its box.
    pub footprint: Footprint,
    /// Futures with their weights; a weight is positive, the sum need not be one. Not empty.
    pub trajectories: Vec<(f64, Trajectory)>,
}
