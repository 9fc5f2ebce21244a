//! TTC in two dimensions: the first contact of two boxes that keep their velocities and headings.
//!
//! Two boxes overlap while their shadows overlap on every axis that is normal to a side of either (separating axes).
//! On one axis the shadows' centres are D + r t apart and reach R = R_1 + R_2 far, so they overlap on an open interval
//! (a slab); the boxes overlap on the intersection of all of them.
//!
//! ```text
//!   |D + r t| < R     <=>     t between (-R - D)/r and (R - D)/r
//!   TTC = max(0, latest begin)   if that lies before the earliest end, and the earliest end after now
//! ```
//!
//! On the road a box counts with its extents along and across it, as it stands now (reading R7), and two axes do. A future
//! on the road knows no headings, so a box turned by neither 0 nor 90 degrees fills its corners there: contact is found
//! early, never late. [`first_contact`] takes any headings, in the world, and is exact.
//!
//! Sources: Kay & Kajiya (1986) for slabs; Ericson, "Real-Time Collision Detection" (2005), 4.4 and 5.5, for separating
//! axes of moving boxes. Left out: accelerations, turning, the curvature of the road.

use zhuyi_core::approach::LEAST_CLOSING_SPEED;
use zhuyi_core::{Footprint, Pose};
use zhuyi_estimator::ego_motion::Start;
use zhuyi_estimator::{Ego, Future};

/// A box in the plane that keeps its velocity and its heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingBox {
    /// Its size.
    pub footprint: Footprint,
    /// Its centre and heading.
    pub pose: Pose,
    /// [m/s] velocity along x.
    pub vx: f64,
    /// [m/s] velocity along y.
    pub vy: f64,
}

impl MovingBox {
    /// A box that moves where it points.
    pub fn ahead(footprint: Footprint, pose: Pose, speed: f64) -> Self {
        let (sin, cos) = libm::sincos(pose.heading);
        Self {
            footprint,
            pose,
            vx: speed * cos,
            vy: speed * sin,
        }
    }

    /// Half the length of its shadow on the unit vector (x, y).
    fn reach(&self, (x, y): (f64, f64)) -> f64 {
        let (sin, cos) = libm::sincos(self.pose.heading);
        let (along, across) = (x * cos + y * sin, y * cos - x * sin);
        let Footprint { length, width } = self.footprint;
        f64::midpoint(along.abs() * length, across.abs() * width)
    }
}

/// [s] the first contact of two boxes, 0 if they overlap now; None if they never do, or where their shadows close by less
/// than 1 mm/s.
///
/// A car of 4 m x 2 m at 10 m/s, and a second one that crosses from the right at 5 m/s, 20 m ahead and 14 m to the
/// side. Along: 20 - 3 = 17 m to its side take 1.7 s, 20 + 3 = 23 m take 2.3 s. Across: 14 - 3 = 11 m take 2.2 s. So
/// they meet after 2.2 s; 15 m to the side would need 2.4 s, and the first is through.
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// use zhuyi_core::{Footprint, Pose};
/// use zhuyi_metrics::criticality::boxes::{MovingBox, first_contact};
/// let car = Footprint { length: 4.0, width: 2.0 };
/// let first = MovingBox::ahead(car, Pose::new(0.0, 0.0, 0.0), 10.0);
/// let crossing = |y: f64| MovingBox::ahead(car, Pose::new(20.0, y, FRAC_PI_2), 5.0);
/// assert!((first_contact(&first, &crossing(-14.0)).unwrap() - 2.2).abs() < 1e-12);
/// assert_eq!(first_contact(&first, &crossing(-15.0)), None);
/// ```
pub fn first_contact(one: &MovingBox, other: &MovingBox) -> Option<f64> {
    let (dx, dy) = (other.pose.x - one.pose.x, other.pose.y - one.pose.y);
    let (vx, vy) = (other.vx - one.vx, other.vy - one.vy);
    let mut overlap = Some(ALWAYS);
    for heading in [one.pose.heading, other.pose.heading] {
        let (sin, cos) = libm::sincos(heading);
        for axis in [(cos, sin), (-sin, cos)] {
            let reach = one.reach(axis) + other.reach(axis);
            let shadow = shadow(dx * axis.0 + dy * axis.1, vx * axis.0 + vy * axis.1, reach);
            overlap = both(overlap, shadow);
        }
    }
    first_from_now(overlap?)
}

/// [s] the first contact on the road of both boxes as they stand on it now, the ego at its offset; as [`first_contact`].
pub fn on_the_road(ego: &Ego, actor: Footprint, future: &Future<'_>) -> Option<f64> {
    let (present, actor) = (future.start()?, future.box_at(actor, 0.0));
    let (length, width) = (
        ego.footprint.half_lengths(actor),
        ego.footprint.half_widths(actor),
    );
    let speed = Start::new(ego.speed, ego.accel).speed;
    let along = shadow(present.s - ego.s, present.speed - speed, length);
    let across = shadow(present.d - ego.d, present.d_rate, width);
    first_from_now(both(along, across)?)
}

/// As [`slab`], where shadows that move by less than [`LEAST_CLOSING_SPEED`] against each other do not move.
fn shadow(distance: f64, rate: f64, reach: f64) -> Option<Interval> {
    let moves = rate.abs() >= LEAST_CLOSING_SPEED;
    let rate = if moves { rate } else { 0.0 };
    slab(distance, rate, reach)
}

/// From when until when.
type Interval = (f64, f64);

const ALWAYS: Interval = (f64::NEG_INFINITY, f64::INFINITY);

/// When |`distance` + `rate` t| < `reach`.
fn slab(distance: f64, rate: f64, reach: f64) -> Option<Interval> {
    if rate == 0.0 {
        return (distance.abs() < reach).then_some(ALWAYS);
    }
    let (one, other) = ((-reach - distance) / rate, (reach - distance) / rate);
    Some(if rate > 0.0 {
        (one, other)
    } else {
        (other, one)
    })
}

/// When both hold.
fn both(one: Option<Interval>, other: Option<Interval>) -> Option<Interval> {
    let ((a, b), (c, d)) = (one?, other?);
    let (begin, end) = (a.max(c), b.min(d));
    (begin < end).then_some((begin, end))
}

fn first_from_now((begin, end): Interval) -> Option<f64> {
    (end > 0.0).then(|| begin.max(0.0))
}
