//! A box as an eye sees it, and how much of it is hidden (reading R17).
//!
//! ```text
//!  share = (width - |hidden|) / min(width, fov)
//! ```
//!
//! Hidden is what lies outside the field of view or behind a nearer body; of two that overlap in angle the nearer is the
//! one that a ray through the middle of the overlap enters first. The rule is that of zhuyi-perception, written down
//! again without a list, so that nothing is allocated. Left out: heights; the ego does not hide its own view.

use std::f64::consts::{FRAC_PI_2, TAU};

use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{Body, Camera, Footprint, Point, Pose};

use super::EXACT;

/// A box as an eye outside of it sees it. Bearings are counted counter-clockwise from the eye's heading.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outline {
    /// [rad] of its centre.
    pub bearing: f64,
    /// [rad] from there to its rightmost corner, negative ...
    pub right: f64,
    /// [rad] ... and to its leftmost one.
    pub left: f64,
    /// [m] to its nearest point.
    pub distance: f64,
    /// The eye in the frame of the box, and half of its sides.
    eye: (f64, f64),
    half: (f64, f64),
    /// [m] its centre from the eye, in the world's directions.
    from_eye: (f64, f64),
    /// [rad] the eye's heading in the frame of the box.
    heading: f64,
}

impl Outline {
    pub fn new(eye: Pose, footprint: Footprint, pose: Pose) -> Self {
        let bearing_of = |point: Point| libm::atan2(point.y - eye.y, point.x - eye.x) - eye.heading;
        let bearing = wrap_angle(bearing_of(pose.point()));
        let half = (footprint.length / 2.0, footprint.width / 2.0);
        let place = pose.local(eye.point());
        let beyond = (
            (place.0.abs() - half.0).max(0.0),
            (place.1.abs() - half.1).max(0.0),
        );
        let distance = libm::hypot(beyond.0, beyond.1);
        let (mut right, mut left) = (0.0, 0.0);
        if distance == 0.0 {
            // From inside it is all around.
            (right, left) = (-TAU / 2.0, TAU / 2.0);
        } else {
            for corner in footprint.corners(pose) {
                let turn = wrap_angle(bearing_of(corner) - bearing);
                if turn < right {
                    right = turn;
                }
                if turn > left {
                    left = turn;
                }
            }
        }
        Self {
            bearing,
            right,
            left,
            distance,
            eye: place,
            half,
            from_eye: (pose.x - eye.x, pose.y - eye.y),
            heading: eye.heading - pose.heading,
        }
    }

    /// Whether some of it lies in a field of view around the eye's heading, hidden or not.
    pub fn in_view(&self, fov: f64) -> bool {
        [-TAU, 0.0, TAU].into_iter().any(|turn| {
            let bearing = self.bearing + turn;
            bearing + self.right < fov / 2.0 && bearing + self.left > -fov / 2.0
        })
    }

    /// [-] the share of its angular width that the eye sees, with `bodies` around.
    pub fn visible_share(&self, eye: Pose, fov: f64, bodies: &[Body]) -> f64 {
        let width = self.left - self.right;
        let mut visible = 0.0;
        let mut from = self.right;
        // From the right to the left: over what is hidden at once, up to where something hidden begins.
        while from < self.left {
            let (mut hidden_to, mut clear_to) = (from, self.left);
            self.each_hidden(eye, fov, bodies, |begin, end| {
                if begin <= from && end > hidden_to {
                    hidden_to = end;
                } else if begin > from && begin < clear_to {
                    clear_to = begin;
                }
            });
            if hidden_to > from {
                from = hidden_to;
            } else {
                visible += clear_to - from;
                from = clear_to;
            }
        }
        visible / width.min(fov)
    }

    /// Tells the hidden parts of its angle, counted from its bearing.
    fn each_hidden(&self, eye: Pose, fov: f64, bodies: &[Body], mut hidden: impl FnMut(f64, f64)) {
        let mut within = |begin: f64, end: f64, hides: &dyn Fn(f64) -> bool| {
            for turn in [-TAU, 0.0, TAU] {
                let (begin, end) = ((begin + turn).max(self.right), (end + turn).min(self.left));
                if begin < end && hides(f64::midpoint(begin, end)) {
                    hidden(begin, end);
                }
            }
        };
        within(
            fov / 2.0 - self.bearing,
            TAU - fov / 2.0 - self.bearing,
            &|_| true,
        );
        let around = (self.from_eye, libm::hypot(self.half.0, self.half.1));
        for body in bodies {
            let place = body.pose.point();
            let other = ((place.x - eye.x, place.y - eye.y), body.footprint.radius());
            if apart(around, other) {
                continue;
            }
            let other = Self::new(eye, body.footprint, body.pose);
            let offset = other.bearing - self.bearing;
            let nearer =
                |ray: f64| other.entry(self.bearing + ray) < self.entry(self.bearing + ray);
            within(offset + other.right, offset + other.left, &nearer);
        }
    }

    /// [m] where a ray at a bearing enters the box, for a ray that meets it: behind the last of the four lines.
    fn entry(&self, bearing: f64) -> f64 {
        let (sin, cos) = libm::sincos(self.heading + bearing);
        let lengthwise = (-self.half.0.copysign(cos) - self.eye.0) / cos;
        let sideways = (-self.half.1.copysign(sin) - self.eye.1) / sin;
        lengthwise.max(sideways).max(0.0)
    }
}

/// Whether two circles, given by their centres from the eye and their radii, surely have no ray in common, or the second
/// lies behind the first. Most bodies are told from a box by this alone, without an angle.
fn apart(first: ((f64, f64), f64), second: ((f64, f64), f64)) -> bool {
    let (((x, y), radius), ((other_x, other_y), other_radius)) = (first, second);
    let (distance, other_distance) = (libm::hypot(x, y), libm::hypot(other_x, other_y));
    if other_distance - other_radius > distance + radius {
        return true;
    }
    // A circle fills at most asin(r / d) <= (pi / 2) (r / d) to either side, and an angle is no less than its sine.
    let (cross, dot) = (x * other_y - y * other_x, x * other_x + y * other_y);
    let filled = FRAC_PI_2 * (radius * other_distance + other_radius * distance);
    cross.abs() > filled || (dot < 0.0 && filled < distance * other_distance)
}

/// Whether a camera at `eye` has some of a box in view, hidden or not, no further than at the limit of its range.
pub(super) fn concerns(camera: &Camera, eye: Pose, footprint: Footprint, pose: Pose) -> bool {
    let (distance, bearing) = polar(eye, pose);
    let range = camera.range + 2.0 * EXACT;
    // The centre decides for most places.
    if distance <= range && bearing.abs() < camera.fov / 2.0 {
        return true;
    }
    if out_of_reach(camera, (distance, bearing), footprint.radius()) {
        return false;
    }
    let outline = Outline::new(eye, footprint, pose);
    outline.distance <= range && outline.in_view(camera.fov)
}

/// The box as a camera at `eye` sees it; none if it is out of its range or its field of view.
pub(super) fn in_sight(
    camera: &Camera,
    eye: Pose,
    footprint: Footprint,
    pose: Pose,
) -> Option<Outline> {
    if out_of_reach(camera, polar(eye, pose), footprint.radius()) {
        return None;
    }
    let outline = Outline::new(eye, footprint, pose);
    (outline.distance <= camera.range && outline.in_view(camera.fov)).then_some(outline)
}

/// Whether a circle around a box lies out of a camera's range, or its field of view, for sure.
fn out_of_reach(camera: &Camera, (distance, bearing): (f64, f64), radius: f64) -> bool {
    let fills = FRAC_PI_2 * radius / distance;
    distance - radius > camera.range + 2.0 * EXACT || bearing.abs() - fills > camera.fov / 2.0
}

/// [m] how far the centre of a box is, and [rad] its bearing.
fn polar(eye: Pose, pose: Pose) -> (f64, f64) {
    let (x, y) = (pose.x - eye.x, pose.y - eye.y);
    (
        libm::hypot(x, y),
        wrap_angle(libm::atan2(y, x) - eye.heading),
    )
}
