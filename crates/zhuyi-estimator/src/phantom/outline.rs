//! Whether a camera has a box in sight, and how much of it is hidden (reading R17): the rule of
//! [`zhuyi_core::occlusion`], asked without a list, so that nothing is allocated.

use std::f64::consts::FRAC_PI_2;

use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::occlusion::Outline;
use zhuyi_core::{Body, Camera, Footprint, Pose};

use super::EXACT;

/// [-] the share of the angular width of a box at `pose`, whose outline this is, that an eye sees with `bodies` around.
pub(super) fn visible_share(
    outline: &Outline,
    (footprint, pose): (Footprint, Pose),
    (eye, fov): (Pose, f64),
    bodies: &[Body],
) -> f64 {
    let circle =
        |footprint: Footprint, pose: Pose| ((pose.x - eye.x, pose.y - eye.y), footprint.radius());
    let around = circle(footprint, pose);
    let may_hide = |body: &&Body| !apart(around, circle(body.footprint, body.pose));
    outline.visible_share(fov, || {
        let others = bodies.iter().filter(may_hide);
        others.map(|body| Outline::new(eye, body.footprint, body.pose))
    })
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
