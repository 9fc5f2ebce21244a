//! The true state of everything at one instant. Only the simulation loop and the offline evaluation hold one.

use crate::approach::in_the_way;
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
    /// [rad] heading of the box against the road at `road.s`, counter-clockwise.
    pub turn: f64,
    /// The box as it stands on the road: its extents along and across it, [`Footprint::turned`] by `turn`.
    pub extent: Footprint,
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
    /// Creates a body that stands along a straight road whose reference line is the x axis, and moves along it at `speed` [m/s].
    pub fn aligned(footprint: Footprint, s: f64, d: f64, speed: f64) -> Self {
        Self {
            footprint,
            road: Frenet { s, d },
            pose: Pose::new(s, d, 0.0),
            turn: 0.0,
            extent: footprint,
            speed,
            accel: 0.0,
            s_rate: speed,
            d_rate: 0.0,
        }
    }

    /// [m] the `s` of its foremost edge.
    #[inline]
    pub fn front(&self) -> f64 {
        self.road.s + self.extent.length / 2.0
    }

    /// [m] the `s` of its rearmost edge.
    #[inline]
    pub fn rear(&self) -> f64 {
        self.road.s - self.extent.length / 2.0
    }

    /// Returns whether it and `other` overlap side to side.
    ///
    /// A lorry of 12 m x 2.5 m that stands across the road reaches 6 m to each side of its centre.
    /// ```
    /// # use zhuyi_core::{Body, Footprint, Frenet, Pose};
    /// let car = Footprint { length: 4.0, width: 2.0 };
    /// let body = |footprint: Footprint, s: f64, d: f64, turn: f64| Body {
    ///     footprint, road: Frenet { s, d }, pose: Pose::new(s, d, turn), turn, extent: footprint.turned(turn),
    ///     speed: 0.0, accel: 0.0, s_rate: 0.0, d_rate: 0.0,
    /// };
    /// let (ego, lorry) = (body(car, 0.0, 0.0, 0.0), Footprint { length: 12.0, width: 2.5 });
    /// let across = body(lorry, 50.0, 6.0, std::f64::consts::FRAC_PI_2);
    /// assert!(across.overlaps_sideways(&ego) && !body(lorry, 50.0, 6.0, 0.0).overlaps_sideways(&ego));
    /// assert!((across.rear() - ego.front() - 46.75).abs() < 1e-9);
    /// ```
    #[inline]
    pub fn overlaps_sideways(&self, other: &Self) -> bool {
        in_the_way(self.road.d - other.road.d, self.extent, other.extent, 0.0)
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
