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
    /// Creates a camera at the centre of the ego that looks `yaw` [rad] to the left, with a field of view `fov` [rad] and a `range` [m].
    pub fn new(name: &str, yaw: f64, fov: f64, range: f64) -> Self {
        Self {
            name: name.to_string(),
            forward: 0.0,
            left: 0.0,
            yaw,
            fov,
            range,
            analysed: false,
        }
    }

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

    /// Whether some of the box of `body` lies in the field of view and range (reading R14).
    pub fn covers_body(&self, ego: Pose, body: &Body) -> bool {
        self.covers_box(ego, body.footprint, body.pose)
    }

    /// The same of a box at `pose`.
    pub fn covers_box(&self, ego: Pose, footprint: Footprint, pose: Pose) -> bool {
        Sector::new(self, self.pose(ego)).meets_box(footprint, pose)
    }
}

/// [Hz] the full frame rate of a camera: none delivers more frames, and no demand or policy asks for more (reading R4).
pub const FULL_RATE: f64 = 30.0;

/// Returns the least frame rate [Hz] of a camera, one of so many that share a budget [Hz]: 1 (reading R14), or an equal part where
/// there is not that much.
///
/// ```
/// use zhuyi_core::camera::least_rate;
/// assert_eq!(least_rate(60.0, 5), 1.0);
/// assert_eq!(least_rate(2.0, 5), 0.4);
/// ```
pub fn least_rate(budget: f64, cameras: usize) -> f64 {
    if cameras == 0 {
        1.0
    } else {
        (budget / cameras as f64).min(1.0)
    }
}

/// [m] what is nearer than this to a border is not plain.
const CLEARANCE: f64 = 1e-3;

/// What a camera covers, ready to be asked for many points: a sector of a circle.
///
/// ```text
/// |p| <= range,   p · axis >= |p| cos(fov/2)
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sector {
    eye: Point,
    /// Where it looks.
    axis: (f64, f64),
    /// [-] cos(fov/2).
    edge: f64,
    /// Directions of its right and its left border.
    borders: [(f64, f64); 2],
    /// Whether it is at most half a turn, so that the borders tell what lies between them.
    narrow: bool,
    /// [m]
    range: f64,
}

impl Sector {
    /// The sector of a camera at `pose` (from [`Camera::pose`]).
    pub fn new(camera: &Camera, pose: Pose) -> Self {
        let (eye, half) = (Axes::new(pose), libm::sincos(camera.fov / 2.0));
        Self {
            eye: pose.point(),
            axis: (eye.cos, eye.sin),
            edge: half.1,
            borders: eye.borders(half),
            narrow: half.1 >= 0.0,
            range: camera.range,
        }
    }

    /// Whether a point lies in it.
    pub fn holds(&self, point: Point) -> bool {
        self.holds_seen(self.seen(point))
    }

    /// Whether some of a box at `pose` does (reading R14), for a field of view of any width up to a whole turn.
    ///
    /// A truck of 25 m beside the camera has no corner in a field of 120 degrees that its flank fills:
    /// ```
    /// use std::f64::consts::{FRAC_PI_2, PI};
    /// use zhuyi_core::{Camera, Footprint, Pose, camera::Sector};
    /// let camera = Camera {
    ///     name: "left".into(), forward: 0.0, left: 0.0, yaw: FRAC_PI_2, fov: 2.0 * PI / 3.0, range: 80.0, analysed: true,
    /// };
    /// let sector = Sector::new(&camera, camera.pose(Pose::default()));
    /// assert!(sector.meets_box(Footprint { length: 25.0, width: 2.5 }, Pose::new(6.0, 3.0, 0.0)));
    /// ```
    pub fn meets_box(&self, footprint: Footprint, pose: Pose) -> bool {
        let (length, width) = (footprint.length, footprint.width);
        if let Some((meets, _)) = self.holds_plainly(pose.point(), 0.5 * (length + width)) {
            return meets;
        }
        let axes = Axes::new(pose);
        let (forward, left) = axes.local(self.eye);
        if forward.abs() <= length / 2.0 && left.abs() <= width / 2.0 {
            return true;
        }
        let corners = footprint.corners_on(&axes);
        let corners = corners.map(|corner| self.seen(corner));
        corners.iter().any(|corner| self.holds_seen(*corner))
            || (0..4).any(|i| self.meets_edge(corners[i], corners[(i + 1) % 4]))
    }

    /// Whether a line between two points outside, as seen from the eye, has a point inside: it comes in over a border, or
    /// else over the arc and its point nearest to the eye is inside.
    fn meets_edge(&self, from: (f64, f64), to: (f64, f64)) -> bool {
        let along = (to.0 - from.0, to.1 - from.1);
        let at = |share: f64| (from.0 + share * along.0, from.1 + share * along.1);
        let nearest =
            -(from.0 * along.0 + from.1 * along.1) / (along.0 * along.0 + along.1 * along.1);
        let over_border = |border: &(f64, f64)| {
            let side = |point: (f64, f64)| border.0 * point.1 - border.1 * point.0;
            let (before, after) = (side(from), side(to));
            let point = at(before / (before - after));
            (before < 0.0) != (after < 0.0)
                && (0.0..=self.range).contains(&(border.0 * point.0 + border.1 * point.1))
        };
        self.holds_seen(at(nearest.clamp(0.0, 1.0))) || self.borders.iter().any(over_border)
    }

    /// The same where it is plain by the `centre` of the box and the distance `reach` [m] from there beyond which no point of
    /// it is; and how far [m] the centre may surely go before it changes.
    ///
    /// ```
    /// use zhuyi_core::{Camera, Point, Pose, camera::Sector};
    /// let camera = Camera {
    ///     name: "front".into(), forward: 0.0, left: 0.0, yaw: 0.0, fov: 1.0, range: 100.0, analysed: true,
    /// };
    /// let sector = Sector::new(&camera, Pose::default());
    /// let told = |x: f64, y: f64| sector.holds_plainly(Point::new(x, y), 3.0);
    /// assert!(told(90.0, 0.0).is_some_and(|(held, margin)| held && (9.9..10.0).contains(&margin)));
    /// assert!(told(-10.0, 0.0).is_some_and(|(held, margin)| !held && margin > 1.0));
    /// assert_eq!(told(101.0, 0.0), None);
    /// ```
    pub fn holds_plainly(&self, centre: Point, reach: f64) -> Option<(bool, f64)> {
        if !self.narrow {
            return None;
        }
        let (x, y) = self.seen(centre);
        let [right, left] = self.borders;
        let inside = (right.0 * y - right.1 * x).min(x * left.1 - y * left.0);
        let within = inside.min(self.range - (x * x + y * y).sqrt());
        if within > CLEARANCE {
            Some((true, within - CLEARANCE))
        } else if within < -reach - CLEARANCE {
            Some((false, -within - reach - CLEARANCE))
        } else {
            None
        }
    }

    /// A point as seen from the eye.
    fn seen(&self, point: Point) -> (f64, f64) {
        (point.x - self.eye.x, point.y - self.eye.y)
    }

    fn holds_seen(&self, (x, y): (f64, f64)) -> bool {
        let squared = x * x + y * y;
        squared <= self.range * self.range
            && x * self.axis.0 + y * self.axis.1 >= squared.sqrt() * self.edge
    }
}

/// A camera with the sector that it covers in the frame of the ego, ready to be asked from many places of the ego.
#[derive(Clone, Copy, Debug)]
pub struct Mounted<'a> {
    camera: &'a Camera,
    sector: Sector,
}

impl<'a> Mounted<'a> {
    /// A camera of the rig.
    pub fn new(camera: &'a Camera) -> Self {
        let sector = Sector::new(camera, camera.pose(Pose::default()));
        Self { camera, sector }
    }

    /// As [`Camera::covers_body`], given the ego's axes.
    pub fn covers_body(&self, ego: &Axes, body: &Body) -> bool {
        let Footprint { length, width } = body.footprint;
        let (x, y) = ego.local(body.pose.point());
        let plain = (self.sector).holds_plainly(Point::new(x, y), 0.5 * (length + width));
        plain.map_or_else(|| self.camera.covers_body(ego.pose, body), |(held, _)| held)
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
