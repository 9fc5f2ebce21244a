//! Boxes as an eye sees them, and how much of one is hidden (reading R17).
//!
//! ```text
//! share = (width - |hidden|) / min(width, fov)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | width | angle under which the eye sees the box, corner to corner | rad |
//! | hidden | the part of that angle that lies outside the field of view or behind a nearer box; overlaps count once | rad |
//! | fov | full field of view; a box wider than that and cut by nothing else is seen whole | rad |
//!
//! Of two boxes that overlap in angle the nearer is the one that a ray through the middle of the overlap enters first:
//! disjoint convex bodies have the same order on every ray that meets both, since a line separates them. An eye inside a
//! box sees that box alone. Left out: heights (nothing is seen over or under another box), the vertical field of view; the
//! vehicle that carries the eye does not hide its view.

use std::f64::consts::{PI, TAU};

use crate::geometry::wrap_angle;
use crate::{Footprint, Pose};

/// A box as an eye sees it. Angles are counted counter-clockwise, bearings from the eye's heading.
#[derive(Clone, Copy, Debug)]
pub struct Outline {
    /// [rad] bearing of its centre.
    pub bearing: f64,
    /// [rad] from the bearing to its rightmost corner, negative.
    pub right: f64,
    /// [rad] from the bearing to its leftmost corner, positive.
    pub left: f64,
    /// [m] distance of its nearest point.
    pub distance: f64,
    /// [m] the eye in the frame of the box.
    eye: (f64, f64),
    /// [rad] the heading of the eye there.
    heading: f64,
    /// [m] half of its length and of its width.
    half: (f64, f64),
}

impl Outline {
    /// The box `footprint` at `pose` as seen by an eye.
    pub fn new(eye: Pose, footprint: Footprint, pose: Pose) -> Self {
        let (x, y) = pose.local(eye.point());
        let heading = eye.heading - pose.heading;
        let (l, w) = (footprint.length / 2.0, footprint.width / 2.0);
        let distance = libm::hypot((x.abs() - l).max(0.0), (y.abs() - w).max(0.0));
        let (bearing, right, left) = if distance > 0.0 {
            // The box spans less than half a turn: of two of its points the one to the right is told by a product.
            let centre = (-x, -y);
            let (mut rightmost, mut leftmost) = (centre, centre);
            for (a, b) in [(l, w), (l, -w), (-l, -w), (-l, w)] {
                let corner = (a - x, b - y);
                if cross(rightmost, corner) < 0.0 {
                    rightmost = corner;
                }
                if cross(leftmost, corner) > 0.0 {
                    leftmost = corner;
                }
            }
            let bearing = wrap_angle(libm::atan2(centre.1, centre.0) - heading);
            (bearing, turn(centre, rightmost), turn(centre, leftmost))
        } else {
            (0.0, -PI, PI)
        };
        Self {
            bearing,
            right,
            left,
            distance,
            eye: (x, y),
            heading,
            half: (l, w),
        }
    }

    /// Whether some of it lies in a field of view of `fov` [rad] around the eye's heading, hidden or not.
    ///
    /// A box behind an eye that sees all but 45 degrees there comes into view over the back:
    /// ```
    /// use zhuyi_core::{Footprint, Pose, occlusion::Outline};
    /// let fov = 315_f64.to_radians();
    /// let car = Footprint { length: 4.0, width: 2.0 };
    /// let seen = |y: f64| Outline::new(Pose::default(), car, Pose::new(-12.0, y, 0.0)).in_view(fov);
    /// // Its side is 10 to 14 m behind: 10 tan(22.5 degrees) = 4.1 m.
    /// assert_eq!([3.0, 3.2, -3.0, -3.2].map(seen), [false, true, false, true]);
    /// ```
    pub fn in_view(&self, fov: f64) -> bool {
        [-TAU, 0.0, TAU].into_iter().any(|turn| {
            let bearing = self.bearing + turn;
            bearing + self.right < fov / 2.0 && bearing + self.left > -fov / 2.0
        })
    }

    /// [-] the share of its angular width that an eye with a field of view of `fov` [rad] sees, with other boxes around as
    /// the same eye sees them. `others` is asked for them several times; the box itself may be among them.
    ///
    /// ```
    /// use zhuyi_core::{Footprint, Pose, occlusion::Outline};
    /// let at = |x, y| Outline::new(Pose::default(), Footprint { length: 2.0, width: 2.0 }, Pose::new(x, y, 0.0));
    /// // Before the left half of one of 2 atan(1/9) stands another, from straight ahead to 63 degrees on the left.
    /// let share = at(10.0, 0.0).visible_share(3.0, || [at(2.0, 1.0)].into_iter());
    /// assert!((share - 0.5).abs() < 1e-12);
    /// ```
    pub fn visible_share<I>(&self, fov: f64, others: impl Fn() -> I) -> f64
    where
        I: Iterator<Item = Self>,
    {
        let width = self.left - self.right;
        let mut visible = 0.0;
        let mut from = self.right;
        // From the right to the left: over what is hidden at once, up to where something hidden begins.
        while from < self.left {
            let mut sweep = Sweep {
                from,
                hidden_to: from,
                clear_to: self.left,
            };
            let beyond = (fov / 2.0 - self.bearing, TAU - fov / 2.0 - self.bearing);
            sweep.pass(self.overlaps(beyond), |_| true);
            if sweep.hidden_to < self.left {
                for other in others() {
                    let offset = other.bearing - self.bearing;
                    let overlaps = self.overlaps((offset + other.right, offset + other.left));
                    sweep.pass(overlaps, |middle| {
                        let ray = self.bearing + middle;
                        other.entry(ray) < self.entry(ray)
                    });
                }
            }
            if sweep.hidden_to > from {
                from = sweep.hidden_to;
            } else {
                visible += sweep.clear_to - from;
                from = sweep.clear_to;
            }
        }
        visible / width.min(fov)
    }

    /// The parts of the angle `(from, to)` that fall on this box, all counted from its bearing. `from` and `to` may be
    /// off by whole turns, and what reaches around the back may fall on it twice.
    fn overlaps(&self, (from, to): (f64, f64)) -> impl Iterator<Item = (f64, f64)> {
        let (right, left) = (self.right, self.left);
        [-TAU, 0.0, TAU]
            .into_iter()
            .map(move |turn| ((from + turn).max(right), (to + turn).min(left)))
            .filter(|(from, to)| from < to)
    }

    /// [m] distance at which a ray at a bearing enters the box, for a ray that meets it (slab test).
    fn entry(&self, bearing: f64) -> f64 {
        let (sin, cos) = libm::sincos(self.heading + bearing);
        let lengthwise = (-self.half.0.copysign(cos) - self.eye.0) / cos;
        let sideways = (-self.half.1.copysign(sin) - self.eye.1) / sin;
        lengthwise.max(sideways).max(0.0)
    }
}

/// A look to the left from an angle on: how far everything is hidden, and if nothing is, up to where.
struct Sweep {
    /// [rad]
    from: f64,
    /// [rad]
    hidden_to: f64,
    /// [rad]
    clear_to: f64,
}

impl Sweep {
    /// Passes over some angles, of which those are hidden that `hides` says so of, by their middle. It is asked where it
    /// matters alone.
    fn pass(&mut self, angles: impl Iterator<Item = (f64, f64)>, hides: impl Fn(f64) -> bool) {
        for (begin, end) in angles {
            let (reaches, begins) = (
                begin <= self.from && end > self.hidden_to,
                begin > self.from && begin < self.clear_to,
            );
            if (reaches || begins) && hides(f64::midpoint(begin, end)) {
                if reaches {
                    self.hidden_to = end;
                } else {
                    self.clear_to = begin;
                }
            }
        }
    }
}

fn cross(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

/// The angle from one direction to another, counter-clockwise.
fn turn(from: (f64, f64), to: (f64, f64)) -> f64 {
    libm::atan2(cross(from, to), from.0 * to.0 + from.1 * to.1)
}
