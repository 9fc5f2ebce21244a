//! Two boxes in the plane: how far apart, and along which direction.
//!
//! Boxes are apart exactly when a line parallel to a side of one of them parts them; with `p` from the ego's centre to
//! the other's, when the gap along one of their four axes `n` is positive:
//! ```text
//!  gap(n) = |p · n| - h(ego, n) - h(other, n)        h(box, n) = length/2 |n · forward| + width/2 |n · left|
//! ```
//! The widest of the four gaps is never more than the distance of the boxes, and zero when they touch.
//! Source: Gottschalk, Lin, Manocha, `OBBTree` (SIGGRAPH 1996).

use zhuyi_core::{Footprint, Pose};

/// [m] two axes are both the contact normal when the gaps along them differ by no more.
const CORNER: f64 = 1e-3;

/// A box and its pose.
pub(crate) type Placed = (Footprint, Pose);

/// A direction along which two boxes may be apart, in the ego's frame.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    forward: f64,
    left: f64,
    /// [m] half extents of both boxes along it.
    pub(super) reach: f64,
}

impl Axis {
    pub(super) fn along(&self, (forward, left): (f64, f64)) -> f64 {
        forward * self.forward + left * self.left
    }

    /// [m] the gap along it, for a centre of the other box there.
    pub(super) fn gap(&self, centre: (f64, f64)) -> f64 {
        self.along(centre).abs() - self.reach
    }

    /// The direction of it that leads away from the ego, for a centre of the other box there.
    fn outward(&self, centre: (f64, f64)) -> (f64, f64) {
        let sign = if self.along(centre) < 0.0 { -1.0 } else { 1.0 };
        (sign * self.forward, sign * self.left)
    }
}

/// The axes of the ego's box, then those of one that is turned by `askew` against it.
pub(super) fn axes(ego: Footprint, other: Footprint, askew: f64) -> [Axis; 4] {
    let (sin, cos) = libm::sincos(askew);
    let (c, s) = (cos.abs(), sin.abs());
    let axis = |(forward, left), own: f64, length: f64, width: f64| Axis {
        forward,
        left,
        reach: (own + length + width) / 2.0,
    };
    [
        axis((1.0, 0.0), ego.length, c * other.length, s * other.width),
        axis((0.0, 1.0), ego.width, s * other.length, c * other.width),
        axis((cos, sin), other.length, c * ego.length, s * ego.width),
        axis((-sin, cos), other.width, s * ego.length, c * ego.width),
    ]
}

/// A vector of the world in a frame of that heading: (forward, left).
pub(crate) fn into_frame(heading: f64, (x, y): (f64, f64)) -> (f64, f64) {
    let (sin, cos) = libm::sincos(heading);
    (x * cos + y * sin, y * cos - x * sin)
}

/// The contact normal of two boxes that touch, from the ego to the other, in the ego's frame (forward, left).
///
/// It is the axis with the widest gap. Corner on corner there are two, within a millimetre: then it is the one along
/// which the boxes approach faster; `approach` is the velocity of the other relative to the ego in the world.
pub(crate) fn normal(ego: Placed, other: Placed, approach: (f64, f64)) -> (f64, f64) {
    let centre = ego.1.local(other.1.point());
    let approach = into_frame(ego.1.heading, approach);
    let axes = axes(ego.0, other.0, other.1.heading - ego.1.heading);
    let mut widest = f64::NEG_INFINITY;
    for axis in &axes {
        if axis.gap(centre) > widest {
            widest = axis.gap(centre);
        }
    }
    let (mut fastest, mut normal) = (f64::NEG_INFINITY, (1.0, 0.0));
    for axis in axes
        .iter()
        .filter(|axis| axis.gap(centre) >= widest - CORNER)
    {
        let outward = axis.outward(centre);
        let closing = -(outward.0 * approach.0 + outward.1 * approach.1);
        if closing > fastest {
            (fastest, normal) = (closing, outward);
        }
    }
    normal
}
