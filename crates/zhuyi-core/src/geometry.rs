//! Points, poses and boxes in the plane. World frame: x east, y north, headings counter-clockwise from x.

use std::f64::consts::{PI, TAU};

/// A point in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    /// [m] x.
    pub x: f64,
    /// [m] y.
    pub y: f64,
}

impl Point {
    /// A point from its coordinates.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y }
    }
}

/// A position and heading in the world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// [m] x.
    pub x: f64,
    /// [m] y.
    pub y: f64,
    /// [rad] heading, counter-clockwise from the x axis.
    pub heading: f64,
}

impl Pose {
    /// A pose from its parts.
    pub const fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { x, y, heading }
    }

    /// Its position.
    pub const fn point(self) -> Point {
        Point::new(self.x, self.y)
    }

    /// The world point that lies `forward` metres ahead and `left` metres to the left of this pose.
    ///
    /// ```
    /// use zhuyi_core::Pose;
    /// let p = Pose::new(1.0, 2.0, std::f64::consts::FRAC_PI_2).offset(3.0, 0.5);
    /// assert!((p.x - 0.5).abs() < 1e-12 && (p.y - 5.0).abs() < 1e-12);
    /// ```
    pub fn offset(self, forward: f64, left: f64) -> Point {
        let (sin, cos) = self.heading.sin_cos();
        Point::new(
            self.x + forward * cos - left * sin,
            self.y + forward * sin + left * cos,
        )
    }

    /// The point in this pose's own frame: (forward, left) in metres; the inverse of [`Pose::offset`].
    pub fn local(self, point: Point) -> (f64, f64) {
        let (sin, cos) = self.heading.sin_cos();
        let (dx, dy) = (point.x - self.x, point.y - self.y);
        (dx * cos + dy * sin, dy * cos - dx * sin)
    }
}

/// The box of a vehicle seen from above, centred on its reference point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// [m] bumper to bumper.
    pub length: f64,
    /// [m] side to side.
    pub width: f64,
}

impl Footprint {
    /// The four corners of the box at `pose`: front left, front right, rear right, rear left.
    pub fn corners(self, pose: Pose) -> [Point; 4] {
        let (l, w) = (self.length / 2.0, self.width / 2.0);
        [
            pose.offset(l, w),
            pose.offset(l, -w),
            pose.offset(-l, -w),
            pose.offset(-l, w),
        ]
    }

    /// [m] radius of the circle around the box.
    pub fn radius(self) -> f64 {
        self.length.hypot(self.width) / 2.0
    }
}

/// [rad] the same angle in (-π, π].
///
/// ```
/// use zhuyi_core::geometry::wrap_angle;
/// assert!((wrap_angle(7.0) - (7.0 - std::f64::consts::TAU)).abs() < 1e-15);
/// ```
pub fn wrap_angle(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let wrapped = angle.rem_euclid(TAU);
    if wrapped > PI { wrapped - TAU } else { wrapped }
}
