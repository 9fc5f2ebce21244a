//! Boxes and places, of the ego and of others.

use crate::Status;
use crate::limits::{number, positive};

/// The box of a vehicle seen from above, centred on its reference point.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// [m] bumper to bumper; above 0.
    pub length: f64,
    /// [m] side to side; above 0.
    pub width: f64,
}

/// The ego at t_0, on the road or in any straight frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ego {
    /// [m] centre of its box along the path.
    pub s: f64,
    /// [m] centre of its box across the path, positive to the left.
    pub d: f64,
    /// [m/s] speed; below 0 it counts as standing.
    pub speed: f64,
    /// [m/s2] acceleration, signed.
    pub accel: f64,
    /// Its box as it stands: its extents along and across the path, as of a zhuyi_extent twice over where it is turned.
    pub footprint: Footprint,
}

/// A position and heading in the world frame.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// [m] x.
    pub x: f64,
    /// [m] y.
    pub y: f64,
    /// [rad] heading, counter-clockwise from the x axis.
    pub heading: f64,
}

impl Footprint {
    pub(crate) fn meant(self) -> Result<zhuyi_core::Footprint, Status> {
        Ok(zhuyi_core::Footprint {
            length: positive(self.length)?,
            width: positive(self.width)?,
        })
    }
}

impl Ego {
    pub(crate) fn meant(self) -> Result<zhuyi_estimator::Ego, Status> {
        Ok(zhuyi_estimator::Ego {
            s: number(self.s)?,
            d: number(self.d)?,
            speed: number(self.speed)?,
            accel: number(self.accel)?,
            footprint: self.footprint.meant()?,
        })
    }
}

impl Pose {
    pub(crate) fn meant(self) -> Result<zhuyi_core::Pose, Status> {
        Ok(zhuyi_core::Pose::new(
            number(self.x)?,
            number(self.y)?,
            number(self.heading)?,
        ))
    }
}
