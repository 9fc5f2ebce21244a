//! Cameras as geometry: where each looks, and how often. What it makes of what it sees is perception's business.

use crate::geometry::sin_cos;
use crate::{Axes, Body, Footprint, Point, Pose};

/// A camera of the rig: its place in the rig's list, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CameraId(pub u8);

impl CameraId {
    /// Its place in lists with one entry per camera.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Where a camera is mounted on the ego and what it covers.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Its name, unique in the rig.
    pub name: String,
    /// [m] mount ahead of the centre of the ego's box.
    pub forward: f64,
    /// [m] mount to the left of the centre of the ego's box.
    pub left: f64,
    /// [rad] where it looks, counter-clockwise from straight ahead.
    pub yaw: f64,
    /// [rad] full horizontal field of view, at most 2π.
    pub fov: f64,
    /// [m] how far it sees.
    pub range: f64,
    /// Whether its demand is analysed (reading R19: `front_120`, `left`, `right`).
    pub analysed: bool,
}

impl Camera {
    /// The camera's own pose in the world, given the ego's.
    pub fn pose(&self, ego: Pose) -> Pose {
        self.pose_on(&Axes::new(ego))
    }

    /// The same, given the ego's axes.
    pub fn pose_on(&self, ego: &Axes) -> Pose {
        let at = ego.offset(self.forward, self.left);
        Pose::new(at.x, at.y, ego.pose.heading + self.yaw)
    }

    /// Whether `point` lies in its field of view and range, for a camera at `pose` (from [`Camera::pose`]).
    pub fn covers(&self, pose: Pose, point: Point) -> bool {
        Sector::new(self, pose).holds(point)
    }

    /// Whether the centre or one of the four corners of `body` lies in the field of view and range (reading R14).
    pub fn covers_body(&self, ego: Pose, body: &Body) -> bool {
        self.covers_box(ego, body.footprint, body.pose)
    }

    /// The same of a box at `pose`.
    pub fn covers_box(&self, ego: Pose, footprint: Footprint, pose: Pose) -> bool {
        Sector::new(self, self.pose(ego)).holds_box(footprint, pose)
    }
}

/// [m] nearer than this to the border of what is surely out of view, the corners of a box are looked at one by one.
const CLEARANCE: f64 = 1e-3;

/// What a camera covers, ready to be asked for many points: a sector of a circle.
///
/// ```text
/// |p| <= range,   p · axis >= |p| cos(fov/2)
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sector {
    eye: Point,
    /// [rad] where it looks ...
    heading: f64,
    /// ... as a direction.
    axis: (f64, f64),
    /// [-] cos(fov/2) and sin(fov/2).
    edge: (f64, f64),
    /// Directions of its right and its left border.
    borders: [(f64, f64); 2],
    /// [m]
    range: f64,
}

impl Sector {
    /// The sector of a camera at `pose` (from [`Camera::pose`]).
    pub fn new(camera: &Camera, pose: Pose) -> Self {
        let (sin, cos) = (camera.fov / 2.0).sin_cos();
        let mut sector = Self {
            eye: pose.point(),
            heading: f64::NAN,
            axis: (1.0, 0.0),
            edge: (cos, sin),
            borders: [(1.0, 0.0); 2],
            range: camera.range,
        };
        sector.move_to(pose);
        sector
    }

    /// Moves it on to where the camera is now.
    pub fn move_to(&mut self, pose: Pose) {
        self.eye = pose.point();
        if pose.heading != self.heading {
            let (sin, cos) = sin_cos(pose.heading);
            (self.heading, self.axis) = (pose.heading, (cos, sin));
            let (c, s) = self.edge;
            self.borders = [
                (cos * c + sin * s, sin * c - cos * s),
                (cos * c - sin * s, sin * c + cos * s),
            ];
        }
    }

    /// Whether a point lies in it.
    pub fn holds(&self, point: Point) -> bool {
        self.holds_seen(self.seen(point))
    }

    /// Whether the centre or one of the corners of a box at `pose` does (reading R14).
    #[inline]
    pub fn holds_box(&self, footprint: Footprint, pose: Pose) -> bool {
        let centre = self.seen(pose.point());
        if self.holds_seen(centre) {
            return true;
        }
        // No corner is farther from the centre than this.
        let reach = f64::midpoint(footprint.length, footprint.width);
        let corners = || footprint.corners(pose).into_iter();
        !self.misses(centre, reach) && corners().any(|corner| self.holds(corner))
    }

    /// Whether all of what lies within `reach` of a point surely lies outside, beyond the range or one of the borders.
    #[inline]
    fn misses(&self, (x, y): (f64, f64), reach: f64) -> bool {
        let clear = reach + CLEARANCE;
        let far = self.range + clear;
        let [right, left] = self.borders;
        let narrow = self.edge.0 >= 0.0;
        let beside = right.0 * y - right.1 * x < -clear || x * left.1 - y * left.0 < -clear;
        (narrow && beside) || x * x + y * y > far * far
    }

    /// A point as seen from the eye.
    fn seen(&self, point: Point) -> (f64, f64) {
        (point.x - self.eye.x, point.y - self.eye.y)
    }

    fn holds_seen(&self, (x, y): (f64, f64)) -> bool {
        let squared = x * x + y * y;
        squared <= self.range * self.range
            && x * self.axis.0 + y * self.axis.1 >= squared.sqrt() * self.edge.0
    }
}

/// Frames per second of each camera, in the order of the rig; each is positive and finite.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRates(Vec<f64>);

impl FrameRates {
    /// One rate per camera, in the order of the rig.
    ///
    /// # Panics
    /// If a rate is not positive and finite: callers check what users typed.
    pub fn new(hz: Vec<f64>) -> Self {
        assert!(
            hz.iter().all(|f| f.is_finite() && *f > 0.0),
            "frame rates must be positive, got {hz:?}"
        );
        Self(hz)
    }

    /// [Hz] the rate of a camera.
    pub fn of(&self, camera: CameraId) -> f64 {
        self.0[camera.index()]
    }

    /// [Hz] all of them, in the order of the rig.
    pub fn all(&self) -> &[f64] {
        &self.0
    }
}
