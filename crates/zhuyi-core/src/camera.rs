//! Cameras as geometry: where each looks, and how often. What it makes of what it sees is perception's business.

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
        Sector::new(self, self.pose(ego)).holds_any(&footprint.landmarks(pose))
    }
}

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
    /// [-] cos(fov/2).
    edge: f64,
    /// [m2]
    range_squared: f64,
}

impl Sector {
    /// The sector of a camera at `pose` (from [`Camera::pose`]).
    pub fn new(camera: &Camera, pose: Pose) -> Self {
        let (sin, cos) = pose.heading.sin_cos();
        Self {
            eye: pose.point(),
            heading: pose.heading,
            axis: (cos, sin),
            edge: (camera.fov / 2.0).cos(),
            range_squared: camera.range * camera.range,
        }
    }

    /// Moves it on to where the camera is now.
    pub fn move_to(&mut self, pose: Pose) {
        self.eye = pose.point();
        if pose.heading != self.heading {
            let (sin, cos) = pose.heading.sin_cos();
            (self.heading, self.axis) = (pose.heading, (cos, sin));
        }
    }

    /// Whether a point lies in it.
    pub fn holds(&self, point: Point) -> bool {
        self.holds_seen(self.seen(point))
    }

    /// Whether one of the [`Footprint::landmarks`] of a box does.
    pub fn holds_any(&self, [centre, corners @ ..]: &[Point; 5]) -> bool {
        let (x, y) = self.seen(*centre);
        if self.holds_seen((x, y)) {
            return true;
        }
        // All of a box that lies behind an eye with at most half a turn in view is out of view.
        let corner = self.seen(corners[0]);
        let reach = (corner.0 - x).abs() + (corner.1 - y).abs();
        let behind = self.edge >= 0.0 && x * self.axis.0 + y * self.axis.1 < -reach;
        !behind && corners.iter().any(|corner| self.holds(*corner))
    }

    /// A point as seen from the eye.
    fn seen(&self, point: Point) -> (f64, f64) {
        (point.x - self.eye.x, point.y - self.eye.y)
    }

    fn holds_seen(&self, (x, y): (f64, f64)) -> bool {
        let squared = x * x + y * y;
        squared <= self.range_squared
            && x * self.axis.0 + y * self.axis.1 >= squared.sqrt() * self.edge
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
