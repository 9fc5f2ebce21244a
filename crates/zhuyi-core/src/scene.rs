//! The true state of everything at one instant. Only the simulation loop and the offline evaluation hold one.

use crate::{Footprint, Frenet, Pose, SimTime};

/// An actor of the scenario: its place in the scenario's list, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ActorId(pub u32);

impl ActorId {
    /// Its place in lists with one entry per actor.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// One vehicle or obstacle at one instant, on the road and in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// The box.
    pub footprint: Footprint,
    /// Centre of the box on the road.
    pub road: Frenet,
    /// Centre and heading of the box in the world.
    pub pose: Pose,
    /// [m/s] speed, never negative.
    pub speed: f64,
    /// [m/s2] rate of change of the speed.
    pub accel: f64,
    /// [m/s] rate of change of `road.s`.
    pub s_rate: f64,
    /// [m/s] rate of change of `road.d`.
    pub d_rate: f64,
}

impl Body {
    /// [m] the `s` of the front bumper of a body that is aligned with the road.
    pub fn front(&self) -> f64 {
        self.road.s + self.footprint.length / 2.0
    }

    /// [m] the `s` of the rear bumper of a body that is aligned with the road.
    pub fn rear(&self) -> f64 {
        self.road.s - self.footprint.length / 2.0
    }
}

/// Everything on the road at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// When.
    pub time: SimTime,
    /// The ego.
    pub ego: Body,
    /// The actors, in the order of their [`ActorId`].
    pub actors: Vec<Body>,
}
