//! A piece of the reference line, placed in the world: a line, an arc or a clothoid.
//!
//! Each shape starts in its own frame at the origin along x, at `u = 0`:
//! ```text
//!  line  p = (u, 0)
//!  arc   p = c (cos κu/2, sin κu/2)      chord c = u sin(κu/2) / (κu/2)
//! ```
//! The forms hold for any κ: nothing is divided by a small curvature. The foot of a point (x, y) on an arc lies at
//! `u = atan2(κx, 1 - κy) / κ`. Clothoids: see [`Clothoid`].

use super::clothoid::Clothoid;
use super::segment::turn;
use crate::geometry::wrap_angle;
use crate::{Point, Pose};

/// A shape at its place on the road and in the world, over part of its arc length `u`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    /// [m] `s` of the road at `u = 0`.
    pub(super) start: f64,
    /// In the world at `u = 0`.
    origin: Pose,
    /// Cosine and sine of the heading there.
    cos: f64,
    sin: f64,
    shape: Shape,
    /// [m] the `u` that it covers.
    from: f64,
    to: f64,
}

/// A curve in its own frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Line,
    Arc { curvature: f64 },
    Clothoid(Clothoid),
}

/// A point as seen from a point of the curve.
#[derive(Clone, Copy)]
pub(super) struct Foot {
    /// [m] arc length at that point of the curve.
    pub(super) u: f64,
    /// [m] the point ahead of it; zero where the curve is nearest, but for its ends.
    pub(super) ahead: f64,
    /// [m] the point to the left of it.
    pub(super) left: f64,
}

impl Foot {
    /// A point in the frame of the curve at `u`, given the pose there.
    pub(super) fn new(u: f64, there: Pose, point: Point) -> Self {
        let (ahead, left) = there.local(point);
        Self { u, ahead, left }
    }

    /// [m2] square of the distance.
    pub(super) fn distance2(self) -> f64 {
        self.ahead * self.ahead + self.left * self.left
    }
}

impl Shape {
    /// A shape of that length, curvature at its start and at its end.
    pub(super) fn new(length: f64, start: f64, end: f64) -> Self {
        if start != end {
            Self::Clothoid(Clothoid::new(length, start, end))
        } else if start == 0.0 {
            Self::Line
        } else {
            Self::Arc { curvature: start }
        }
    }

    /// The pose at `u`.
    fn pose(&self, u: f64) -> Pose {
        match self {
            Self::Line => Pose::new(u, 0.0, 0.0),
            Self::Arc { curvature } => {
                let half = curvature * u / 2.0;
                let (sin, cos) = libm::sincos(half);
                let chord = if half == 0.0 { u } else { u * (sin / half) };
                Pose::new(chord * cos, chord * sin, 2.0 * half)
            }
            Self::Clothoid(clothoid) => clothoid.pose(u),
        }
    }

    fn heading(&self, u: f64) -> f64 {
        match self {
            Self::Line => 0.0,
            Self::Arc { curvature } => curvature * u,
            Self::Clothoid(clothoid) => clothoid.heading(u),
        }
    }

    /// [rad] how far it has turned at `u`, to the left and to the right together.
    fn turned(&self, u: f64) -> f64 {
        turn(u, self.curvature(0.0), self.curvature(u))
    }

    #[inline]
    fn curvature(&self, u: f64) -> f64 {
        match self {
            Self::Line => 0.0,
            Self::Arc { curvature } => *curvature,
            Self::Clothoid(clothoid) => clothoid.curvature(u),
        }
    }
}

impl Piece {
    /// A shape that starts at `s` of the road and at `origin` in the world and covers `from..=to` of its `u`.
    pub(super) fn new(start: f64, origin: Pose, shape: Shape, from: f64, to: f64) -> Self {
        let (sin, cos) = libm::sincos(origin.heading);
        Self {
            start,
            origin,
            cos,
            sin,
            shape,
            from,
            to,
        }
    }

    #[inline]
    pub(super) fn is_line(&self) -> bool {
        matches!(self.shape, Shape::Line)
    }

    /// Adds `length` at its end.
    pub(super) fn extend(&mut self, length: f64) {
        self.to += length;
    }

    pub(super) fn heading(&self, u: f64) -> f64 {
        self.origin.heading + self.shape.heading(u)
    }

    #[inline]
    pub(super) fn curvature(&self, u: f64) -> f64 {
        self.shape.curvature(u)
    }

    /// [rad] how far it has turned at `u`, to the left and to the right together.
    pub(super) fn turned(&self, u: f64) -> f64 {
        if self.is_line() {
            return 0.0; // of any length
        }
        self.shape.turned(u)
    }

    /// World pose at `u` along and `d` to the left of the curve.
    #[inline]
    pub(super) fn pose(&self, u: f64, d: f64) -> Pose {
        match &self.shape {
            Shape::Line => self.beside_line(u, d),
            curve => {
                let pose = curve.pose(u);
                let place = pose.offset(0.0, d);
                self.placed(place.x, place.y, pose.heading)
            }
        }
    }

    /// The same of a piece that is known to be a line.
    #[inline]
    pub(super) fn beside_line(&self, u: f64, d: f64) -> Pose {
        self.placed(u, d, 0.0)
    }

    /// World pose of a place in the frame of the curve.
    #[inline]
    fn placed(&self, x: f64, y: f64, turned: f64) -> Pose {
        Pose::new(
            self.origin.x + (x * self.cos - y * self.sin),
            self.origin.y + (x * self.sin + y * self.cos),
            self.origin.heading + turned,
        )
    }

    /// A point of the world in the frame of the curve.
    fn local(&self, point: Point) -> (f64, f64) {
        let (dx, dy) = (point.x - self.origin.x, point.y - self.origin.y);
        (dx * self.cos + dy * self.sin, dy * self.cos - dx * self.sin)
    }

    /// The nearest point of this piece to a point of the world.
    pub(super) fn nearest(&self, point: Point) -> Foot {
        let (x, y) = self.local(point);
        match &self.shape {
            Shape::Line => {
                let u = x.clamp(self.from, self.to);
                Foot {
                    u,
                    ahead: x - u,
                    left: y,
                }
            }
            Shape::Arc { curvature } => {
                let turned = libm::atan2(curvature * x, 1.0 - curvature * y);
                // Of the turns that look the same, the one nearest to the middle of the arc.
                let middle = curvature * f64::midpoint(self.from, self.to);
                let u = (middle + wrap_angle(turned - middle)) / curvature;
                let u = u.clamp(self.from, self.to);
                Foot::new(u, self.shape.pose(u), Point::new(x, y))
            }
            Shape::Clothoid(clothoid) => clothoid.nearest(Point::new(x, y)),
        }
    }

    /// A point of the world as seen from the curve at `u`.
    pub(super) fn foot(&self, u: f64, point: Point) -> Foot {
        let (x, y) = self.local(point);
        Foot::new(u, self.shape.pose(u), Point::new(x, y))
    }

    /// Where one gets from `u` by going along the curve as long as that comes nearer to a point of the world, the end of the
    /// piece at most.
    pub(super) fn downhill(&self, u: f64, point: Point) -> Foot {
        let (x, y) = self.local(point);
        match &self.shape {
            Shape::Line => self.nearest(point),
            Shape::Arc { curvature } => {
                let from = Foot::new(u, self.shape.pose(u), Point::new(x, y));
                let turns = libm::atan2(curvature * from.ahead, 1.0 - curvature * from.left);
                let u = (u + turns / curvature).clamp(self.from, self.to);
                Foot::new(u, self.shape.pose(u), Point::new(x, y))
            }
            Shape::Clothoid(clothoid) => clothoid.downhill(u, Point::new(x, y)),
        }
    }

    /// [m] the `u` at the end of the piece that lies ahead, or at the one that lies behind.
    pub(super) fn end(&self, forward: bool) -> f64 {
        if forward { self.to } else { self.from }
    }
}
