//! The clothoid: a curve whose curvature grows linearly with its arc length.
//!
//! ```text
//!  κ(u) = κ0 + c u      θ(u) = κ0 u + c u²/2      p(u) = ∫0^u (cos θ, sin θ)
//! ```
//! The integral has no closed form. It is tabulated at knots between which the curve turns by at most half a radian;
//! from the knot before `u` on, five-point Gauss-Legendre quadrature (Abramowitz & Stegun, table 25.4) is exact but
//! for the last bits of `f64`.
//!
//! The point nearest to P minimises `D(u) = |P - p(u)|²/2`. With P seen from the curve as `f` ahead and `d` to the
//! left: `D' = -f` and `D'' = 1 - κd`, `f' = -(1 - κd)`, `d' = -κf`. On an interval around `m` these give bounds on
//! `D'` and `D''`; intervals in which `D'` cannot vanish, or the curve cannot be nearer than what is known, or `D` is
//! concave, are dropped; where `D` is convex, Newton's method finds its minimum; others are cut in two. So no
//! minimum is missed (interval Newton method: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2009).

use super::piece::Foot;
use crate::{Point, Pose};

/// Nodes on [-1, 1] and weights of five-point Gauss-Legendre quadrature.
const QUADRATURE: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// [rad] how far the curve turns between two knots, at most.
const TURN_PER_KNOT: f64 = 0.5;

/// Part of the whole below which an interval is no longer cut: only points within about that of a centre of curvature
/// get there, and nearest points are ill-defined there.
const FINEST: f64 = 1.0 / 65_536.0;

/// Steps downhill after which a point counts as lying at a centre of curvature, where no place is nearer than those around it.
const MOST_STEPS: usize = 1_000;

/// A clothoid in its own frame: it starts at the origin along x.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Clothoid {
    length: f64,
    start: f64,
    /// [1/m2] change of curvature.
    rate: f64,
    /// [m] from knot to knot.
    step: f64,
    /// Points of the curve at `0, step, 2 step ..`, without its end.
    knots: Vec<Point>,
}

impl Clothoid {
    /// A clothoid of that length, curvature at its start and at its end.
    pub(super) fn new(length: f64, start: f64, end: f64) -> Self {
        let count = (start.abs().max(end.abs()) * length / TURN_PER_KNOT)
            .ceil()
            .max(1.0);
        let mut clothoid = Self {
            length,
            start,
            rate: (end - start) / length,
            step: length / count,
            knots: vec![Point::default()],
        };
        for knot in 1..count as usize {
            let next = clothoid.point(knot as f64 * clothoid.step);
            clothoid.knots.push(next);
        }
        clothoid
    }

    pub(super) fn curvature(&self, u: f64) -> f64 {
        self.start + self.rate * u
    }

    pub(super) fn heading(&self, u: f64) -> f64 {
        u * (self.start + u * self.rate / 2.0)
    }

    pub(super) fn pose(&self, u: f64) -> Pose {
        let point = self.point(u);
        Pose::new(point.x, point.y, self.heading(u))
    }

    /// The nearest point of the curve to `point`.
    pub(super) fn nearest(&self, point: Point) -> Foot {
        let (start, end) = (self.foot(0.0, point), self.foot(self.length, point));
        let mut best = if end.distance2() < start.distance2() {
            end
        } else {
            start
        };
        self.search(point, 0.0, self.length, &mut best);
        best
    }

    /// The point at `u`: on from the knot before it, the last one known at most.
    fn point(&self, u: f64) -> Point {
        let knot = ((u / self.step) as usize).min(self.knots.len() - 1);
        let from = knot as f64 * self.step;
        let half = (u - from) / 2.0;
        let Point { mut x, mut y } = self.knots[knot];
        for (node, weight) in QUADRATURE {
            let (sin, cos) = libm::sincos(self.heading(from + half * (1.0 + node)));
            x += half * weight * cos;
            y += half * weight * sin;
        }
        Point::new(x, y)
    }

    fn foot(&self, u: f64, point: Point) -> Foot {
        Foot::new(u, self.pose(u), point)
    }

    /// Improves `best` by the minima inside `a..b`.
    fn search(&self, point: Point, a: f64, b: f64, best: &mut Foot) {
        let half = (b - a) / 2.0;
        let middle = self.foot(a + half, point);
        let distance = middle.distance2().sqrt();
        let may_be_nearer = distance - half <= best.distance2().sqrt();
        // d moves by at most |κ| |f| per metre, and |f| is at most the distance to the far end.
        let sharpest = self.curvature(a).abs().max(self.curvature(b).abs());
        let drift = sharpest * half * (distance + half);
        let (low, high) = self.bend(a, b, middle.left - drift, middle.left + drift);
        let steepest = (1.0 - low).abs().max((1.0 - high).abs());
        let may_turn = middle.ahead.abs() <= half * steepest;
        if !(may_be_nearer && may_turn) {
            return;
        }
        if high < 1.0 || half < FINEST * self.length {
            let foot = self.descend(point, a, b);
            if foot.distance2() < best.distance2() {
                *best = foot;
            }
        } else if low <= 1.0 {
            self.search(point, a, a + half, best);
            self.search(point, a + half, b, best);
        }
    }

    /// Where one gets from `u` by going along the curve as long as that comes nearer to `point`, an end at most.
    ///
    /// On the way there the distance only falls, so `|f'| = |1 - κd|` stays below 1 plus the sharpest curvature times the
    /// distance now, and a step of `f` over that passes no minimum. Where `D` is convex over twice Newton's step, the minimum
    /// is looked for there at once.
    pub(super) fn downhill(&self, u: f64, point: Point) -> Foot {
        let sharpest = self.start.abs().max(self.curvature(self.length).abs());
        let mut foot = self.foot(u, point);
        for _ in 0..MOST_STEPS {
            let distance = foot.distance2().sqrt();
            let reach = 2.0 * foot.ahead / (1.0 - self.curvature(foot.u) * foot.left);
            let to = (foot.u + reach).clamp(0.0, self.length);
            let (a, b) = (foot.u.min(to), foot.u.max(to));
            let drift = sharpest * (b - a) * (distance + (b - a));
            let (_, high) = self.bend(a, b, foot.left - drift, foot.left + drift);
            if reach * foot.ahead >= 0.0 && high < 1.0 {
                let end = self.foot(to, point);
                if end.ahead * foot.ahead > 0.0 {
                    foot = end; // nearer all the way
                } else {
                    return self.descend(point, a, b);
                }
            } else {
                let step = foot.ahead / (1.0 + sharpest * distance);
                let next = (foot.u + step).clamp(0.0, self.length);
                if next == foot.u {
                    break;
                }
                foot = self.foot(next, point);
            }
            if foot.u == self.end(foot.ahead > 0.0) {
                break;
            }
        }
        foot
    }

    /// [m] the end that lies ahead, or the one that lies behind.
    fn end(&self, forward: bool) -> f64 {
        if forward { self.length } else { 0.0 }
    }

    /// Bounds of κd over `a..b` for offsets between `right` and `left`.
    fn bend(&self, a: f64, b: f64, right: f64, left: f64) -> (f64, f64) {
        let (first, last) = (self.curvature(a), self.curvature(b));
        let (mut low, mut high) = (first * right, first * right);
        for product in [first * left, last * right, last * left] {
            if product < low {
                low = product;
            }
            if product > high {
                high = product;
            }
        }
        (low, high)
    }

    /// The minimum in `a..b`, where D is convex: Newton's method, kept inside a shrinking bracket.
    fn descend(&self, point: Point, a: f64, b: f64) -> Foot {
        let (mut low, mut high) = (a, b);
        let mut foot = self.foot(f64::midpoint(a, b), point);
        let resolution = 2.0 * f64::EPSILON * self.length;
        while high - low > resolution {
            if foot.ahead > 0.0 {
                low = foot.u;
            } else {
                high = foot.u;
            }
            let newton = foot.u + foot.ahead / (1.0 - self.curvature(foot.u) * foot.left);
            let next = if newton > low && newton < high {
                newton
            } else {
                f64::midpoint(low, high)
            };
            let step = (next - foot.u).abs();
            foot = self.foot(next, point);
            if step <= resolution {
                break;
            }
        }
        foot
    }
}
