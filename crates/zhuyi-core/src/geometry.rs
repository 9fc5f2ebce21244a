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
        Axes::new(self).offset(forward, left)
    }

    /// The point in this pose's own frame: (forward, left) in metres; the inverse of [`Pose::offset`].
    pub fn local(self, point: Point) -> (f64, f64) {
        Axes::new(self).local(point)
    }
}

impl Default for Axes {
    fn default() -> Self {
        Self::new(Pose::default())
    }
}

/// A pose with the sine and cosine of its heading, for many points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The pose.
    pub pose: Pose,
    /// [-] cosine of its heading.
    pub cos: f64,
    /// [-] sine of its heading.
    pub sin: f64,
}

impl Axes {
    /// The axes of a pose.
    #[inline]
    pub fn new(pose: Pose) -> Self {
        let (sin, cos) = sin_cos(pose.heading);
        Self { pose, cos, sin }
    }

    /// As [`Pose::offset`].
    pub fn offset(&self, forward: f64, left: f64) -> Point {
        let Self { pose, cos, sin } = self;
        Point::new(
            pose.x + forward * cos - left * sin,
            pose.y + forward * sin + left * cos,
        )
    }

    /// Unit vectors turned by an angle to the right and to the left of the heading, given its sine and cosine: the borders of a
    /// field of view of twice that angle.
    #[inline]
    pub fn borders(&self, (sin, cos): (f64, f64)) -> [(f64, f64); 2] {
        [
            (
                self.cos * cos + self.sin * sin,
                self.sin * cos - self.cos * sin,
            ),
            (
                self.cos * cos - self.sin * sin,
                self.sin * cos + self.cos * sin,
            ),
        ]
    }

    /// As [`Pose::local`].
    pub fn local(&self, point: Point) -> (f64, f64) {
        let Self { pose, cos, sin } = self;
        let (dx, dy) = (point.x - pose.x, point.y - pose.y);
        (dx * cos + dy * sin, dy * cos - dx * sin)
    }
}

/// The box of a vehicle seen from above, centred on its reference point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// [m] bumper to bumper.
    pub length: f64,
    /// [m] side to side.
    pub width: f64,
}

impl Footprint {
    /// The extents along and across a path of a box turned by `turn` [rad] against it: the smallest box aligned with
    /// the path that holds this one.
    ///
    /// ```text
    ///  length' = l |cos| + w |sin|      width' = l |sin| + w |cos|
    /// ```
    ///
    /// By hand, 12 m x 2.5 m turned by 30 degrees: 12 x 0.866 + 2.5 x 0.5 = 11.642 m along, 12 x 0.5 + 2.5 x 0.866 =
    /// 8.165 m across. This is where a turned box becomes a length and a width; source: the support function of a
    /// rectangle.
    /// ```
    /// use zhuyi_core::Footprint;
    /// let lorry = Footprint { length: 12.0, width: 2.5 };
    /// let turned = lorry.turned(30f64.to_radians());
    /// assert!((turned.length - 11.642).abs() < 1e-3 && (turned.width - 8.165).abs() < 1e-3);
    /// assert_eq!(lorry.turned(0.0), lorry);
    /// ```
    #[inline]
    #[must_use]
    pub fn turned(self, turn: f64) -> Self {
        if turn == 0.0 {
            return self;
        }
        let (sin, cos) = sin_cos(turn);
        let (sin, cos) = (sin.abs(), cos.abs());
        Self {
            length: self.length * cos + self.width * sin,
            width: self.length * sin + self.width * cos,
        }
    }

    /// [m] half of both lengths: the distance along the path of two centres below which the boxes overlap lengthwise.
    #[inline]
    pub fn half_lengths(self, other: Self) -> f64 {
        f64::midpoint(self.length, other.length)
    }

    /// [m] half of both widths: the distance across the path of two centres below which the boxes overlap sideways.
    #[inline]
    pub fn half_widths(self, other: Self) -> f64 {
        f64::midpoint(self.width, other.width)
    }

    /// The four corners of the box at `pose`: front left, front right, rear right, rear left.
    pub fn corners(self, pose: Pose) -> [Point; 4] {
        self.corners_on(&Axes::new(pose))
    }

    /// The same, given the axes of that pose.
    pub fn corners_on(self, axes: &Axes) -> [Point; 4] {
        let (l, w) = (self.length / 2.0, self.width / 2.0);
        [(l, w), (l, -w), (-l, -w), (-l, w)].map(|(ahead, left)| axes.offset(ahead, left))
    }

    /// [m] radius of the circle around the box.
    pub fn radius(self) -> f64 {
        libm::hypot(self.length, self.width) / 2.0
    }
}

/// Sine and cosine; of no angle at all, which is that of most bodies to a straight road, without a series.
///
/// ```
/// use zhuyi_core::geometry::sin_cos;
/// assert_eq!([sin_cos(0.0), sin_cos(0.3)], [libm::sincos(0.0), libm::sincos(0.3)]);
/// ```
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if angle == 0.0 {
        (angle, 1.0)
    } else {
        libm::sincos(angle)
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
