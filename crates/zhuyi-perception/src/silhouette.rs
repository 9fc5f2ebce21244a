//! What is plain at a look: who is wholly in view with nobody before it, who is out of view, who is hidden altogether.
//!
//! Seen from the eye a box fills the angle between two of its corners, its rightmost and its leftmost. Whether that angle
//! lies in the field of view, or apart from that of another box, is told by the signs of cross products, without an angle:
//! ```text
//! p in the angle from r to l (less than half a turn)   <=>   r × p >= 0  and  p × l >= 0
//! ```
//! Most boxes are far from every border. Where one is not, within [`MARGIN`], or is hidden in part, the answer is left to
//! the angles of [`crate::sight`], whose answer this one always is.

use zhuyi_core::{Axes, Footprint, Point, Pose};

/// [m2] cross products nearer to zero leave the question open: far more than rounding, less than a hand's breadth.
const MARGIN: f64 = 1e-3;

/// [-] shares nearer to the one asked for leave it open which is larger.
const SHARE_MARGIN: f64 = 1e-6;

/// [-] relative difference of squared distances below which it is open which is larger.
const RELATIVE_MARGIN: f64 = 1e-9;

type Vector = (f64, f64);

/// The field of view of a camera as it stands at an instant; its borders are unit vectors of the world.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Field {
    eye: Point,
    right: Vector,
    left: Vector,
    /// Whether it is less than half a turn, so that two borders can tell what lies in it.
    narrow: bool,
}

impl Field {
    /// A field whose half has this sine and cosine, for an eye with these axes.
    pub fn new(eye: &Axes, half: (f64, f64)) -> Self {
        let [right, left] = eye.borders(half);
        Self {
            eye: eye.pose.point(),
            right,
            left,
            narrow: half.1 > MARGIN,
        }
    }

    /// Whether the field surely holds all of an angle.
    fn holds(&self, (right, left): (Vector, Vector)) -> bool {
        [right, left]
            .iter()
            .all(|&border| cross(self.right, border) > MARGIN && cross(border, self.left) > MARGIN)
    }

    /// Whether all of a box whose centre is at most `slack` [m] from a point surely lies outside.
    #[inline]
    pub fn misses_box(&self, footprint: Footprint, point: Point, slack: f64) -> bool {
        let reach = footprint.length / 2.0 + footprint.width / 2.0 + slack;
        self.narrow && self.misses((point.x - self.eye.x, point.y - self.eye.y), reach)
    }

    /// Whether all of what lies within `reach` of a point lies on the far side of one border.
    #[inline]
    fn misses(&self, centre: Vector, reach: f64) -> bool {
        let clear = reach + MARGIN;
        cross(self.right, centre) < -clear || cross(centre, self.left) < -clear
    }

    /// Whether the same is so of an angle.
    fn misses_angle(&self, (right, left): (Vector, Vector)) -> bool {
        (cross(self.right, right) < -MARGIN && cross(self.right, left) < -MARGIN)
            || (cross(right, self.left) < -MARGIN && cross(left, self.left) < -MARGIN)
    }

    /// A box as this eye sees it.
    #[inline]
    pub fn silhouette(&self, footprint: Footprint, pose: Pose) -> Silhouette {
        if !self.narrow {
            Silhouette::Open
        } else if self.misses_box(footprint, pose.point(), 0.0) {
            Silhouette::OutOfView
        } else {
            self.silhouette_near(footprint, pose)
        }
    }

    /// The same of a box that may be in a narrow field.
    fn silhouette_near(&self, footprint: Footprint, pose: Pose) -> Silhouette {
        let centre = (pose.x - self.eye.x, pose.y - self.eye.y);
        let half = (footprint.length / 2.0, footprint.width / 2.0);
        let axes = Axes::new(pose);
        let (along, across) = (
            (half.0 * axes.cos, half.0 * axes.sin),
            (-half.1 * axes.sin, half.1 * axes.cos),
        );
        // The eye in the frame of the box.
        let (x, y) = axes.local(self.eye);
        let beyond = |distance: f64, half: f64| (distance.abs() - half).max(0.0);
        let nearest = beyond(x, half.0).powi(2) + beyond(y, half.1).powi(2);
        if nearest < MARGIN {
            return Silhouette::Open;
        }
        let corner = |(a, b): (f64, f64)| {
            (
                centre.0 + a * along.0 + b * across.0,
                centre.1 + a * along.1 + b * across.1,
            )
        };
        let (right, left) = outermost((x, y), half);
        let (right, left) = (corner(right), corner(left));
        if self.misses_angle((right, left)) {
            return Silhouette::OutOfView;
        }
        Silhouette::Before(Angle {
            borders: (right, left),
            whole: self.holds((right, left)),
            nearest,
            furthest: (x.abs() + half.0).powi(2) + (y.abs() + half.1).powi(2),
        })
    }
}

/// The rightmost and the leftmost corner of a box, as ahead (1) or behind (-1) and left (1) or right (-1) of its centre, for an eye
/// outside of it that is at (x, y) in its frame.
///
/// Of an eye ahead of the box they are its front corners, the left one to the right; beside a corner they are its two neighbours.
fn outermost((x, y): Vector, half: Vector) -> (Vector, Vector) {
    const AHEAD_LEFT: Vector = (1.0, 1.0);
    const AHEAD_RIGHT: Vector = (1.0, -1.0);
    const BEHIND_LEFT: Vector = (-1.0, 1.0);
    const BEHIND_RIGHT: Vector = (-1.0, -1.0);
    let (ahead, behind, to_left) = (x > half.0, x < -half.0, y > 0.0);
    let beside = y.abs() > half.1;
    match (ahead, behind, beside, to_left) {
        (true, _, false, _) => (AHEAD_LEFT, AHEAD_RIGHT),
        (true, _, true, true) => (BEHIND_LEFT, AHEAD_RIGHT),
        (true, _, true, false) => (AHEAD_LEFT, BEHIND_RIGHT),
        (_, true, false, _) => (BEHIND_RIGHT, BEHIND_LEFT),
        (_, true, true, true) => (BEHIND_RIGHT, AHEAD_LEFT),
        (_, true, true, false) => (AHEAD_RIGHT, BEHIND_LEFT),
        (_, _, _, true) => (BEHIND_LEFT, AHEAD_LEFT),
        (_, _, _, false) => (AHEAD_RIGHT, BEHIND_RIGHT),
    }
}

/// A box as an eye sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Silhouette {
    /// Not told: the eye is in or at the box, or the field is wide.
    Open,
    /// Surely out of view.
    OutOfView,
    /// Surely not around the eye.
    Before(Angle),
}

impl Silhouette {
    /// Whether this box surely hides nothing of another that is in view.
    pub fn spares(&self, body: &Self) -> bool {
        match (self, body) {
            (Self::Before(other), Self::Before(body)) => {
                further(other.nearest, body.furthest) || body.is_apart_from(other)
            }
            // What it hides is out of view already.
            (Self::OutOfView, _) => true,
            _ => false,
        }
    }
}

/// The angle that a box fills, and how far away it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    /// The rightmost and the leftmost corner, from the eye.
    borders: (Vector, Vector),
    /// Surely all of it is in the field of view.
    whole: bool,
    /// [m2] square of the least distance of the box ...
    nearest: f64,
    /// ... and of its greatest.
    furthest: f64,
}

impl Angle {
    /// Whether a direction surely lies outside.
    fn excludes(&self, direction: Vector) -> bool {
        let (right, left) = self.borders;
        cross(right, direction) < -MARGIN || cross(direction, left) < -MARGIN
    }

    /// Whether a direction surely lies inside.
    fn includes(&self, direction: Vector) -> bool {
        let (right, left) = self.borders;
        cross(right, direction) > MARGIN && cross(direction, left) > MARGIN
    }

    /// Of two angles that overlap at least one holds a border of the other.
    fn is_apart_from(&self, other: &Self) -> bool {
        let excludes = |a: &Self, (right, left)| a.excludes(right) && a.excludes(left);
        excludes(self, other.borders) && excludes(other, self.borders)
    }

    /// Whether another body before this one, which is all in the field of view, leaves `least_share` of it in sight on one
    /// side. Of two angles below a quarter turn, `tan a / tan b <= a / b <= sin a / sin b` for `a <= b`.
    fn shows_beside(&self, other: &Self, least_share: f64) -> Option<bool> {
        let ((right, left), (other_right, other_left)) = (self.borders, other.borders);
        let in_sight = if other.includes(right) && other.excludes(left) {
            (other_left, left)
        } else if other.includes(left) && other.excludes(right) {
            (right, other_right)
        } else {
            return None;
        };
        let (part, whole) = (tangent(in_sight)?, tangent((right, left))?);
        let least = part / whole;
        let most = least * (1.0 + whole * whole / 2.0);
        if least > least_share + SHARE_MARGIN {
            Some(true)
        } else if most < least_share - SHARE_MARGIN {
            Some(false)
        } else {
            None
        }
    }

    /// Whether another body surely lies before all of this one.
    fn is_hidden_by(&self, other: &Self) -> bool {
        let (right, left) = self.borders;
        further(self.nearest, other.furthest) && other.includes(right) && other.includes(left)
    }
}

/// Whether the camera sees the box at this place, to `least_share` of it at least, within `range` [m]; none where that
/// is not plain.
pub(crate) fn sees(
    silhouettes: &[Silhouette],
    which: usize,
    range: f64,
    least_share: f64,
) -> Option<bool> {
    let body = match &silhouettes[which] {
        Silhouette::Open => return None,
        Silhouette::OutOfView => return Some(false),
        Silhouette::Before(body) => body,
    };
    if further(body.nearest, range * range) {
        return Some(false);
    }
    if !(body.whole && further(range * range, body.nearest)) {
        return None;
    }
    if least_share <= 0.0 {
        return Some(true);
    }
    let mut hider = None;
    for (place, other) in silhouettes.iter().enumerate() {
        if place == which || other.spares(&silhouettes[which]) {
            continue;
        }
        let Silhouette::Before(other) = other else {
            return None;
        };
        if least_share > MARGIN && body.is_hidden_by(other) {
            return Some(false);
        }
        if !further(body.nearest, other.furthest) || hider.replace(other).is_some() {
            return None;
        }
    }
    match hider {
        Some(hider) => body.shows_beside(hider, least_share),
        None => Some(least_share <= 1.0),
    }
}

/// The tangent of the angle from one direction to another; none from a quarter turn on.
fn tangent((from, to): (Vector, Vector)) -> Option<f64> {
    let dot = from.0 * to.0 + from.1 * to.1;
    (dot > MARGIN).then(|| cross(from, to) / dot)
}

/// Whether one squared distance is surely greater than another.
fn further(one: f64, other: f64) -> bool {
    one > other * (1.0 + RELATIVE_MARGIN)
}

fn cross(a: Vector, b: Vector) -> f64 {
    a.0 * b.1 - a.1 * b.0
}
