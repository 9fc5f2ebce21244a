//! One body ahead of another on a path: the gap, which of them is in the way, and the time to collision.
//!
//! ```text
//!   gap      = (s_a - s_e) - (l_e + l_a)/2                  bumper to bumper, negative side by side
//!   edge gap = |d_a - d_e| - (w_e + w_a)/2                  side to side, negative where they overlap sideways
//!   TTC      = gap / (v_e - v_a)                            both speeds held
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | s, d | centres of the ego e and the actor a, along and across the path | m |
//! | l, w | extents of the boxes as they stand on the path, [`Footprint::turned`] by their headings (reading R7) | m |
//! | v | speeds along the path | m/s |
//!
//! Which actor is in the way is one rule: the boxes as they stand overlap sideways (the edge gap is negative), or come
//! nearer than a margin where the caller gives one. What is measured (the smallest gap and TTC of a run, reports) has no
//! margin. What stands beside the estimate (the metrics of `zhuyi_metrics::criticality`) has that of the estimator's
//! corridor, so that both speak of the same actors.
//!
//! Source: TTC: Hayward, "Near miss determination through use of a scale of danger" (1972).

use crate::Footprint;

/// [m/s] a gap that closes more slowly than this counts as one that does not close: no sensor or record tells such a
/// speed from none, and times of days mean nothing.
pub const LEAST_CLOSING_SPEED: f64 = 1e-3;

/// Returns the gap [m] between two boxes as they stand on a path, the centre of the second `ahead` metres further along it;
/// negative while they overlap lengthwise or the second is behind.
///
/// A bus of 12 m x 2.5 m stands across the path 50 m ahead of a car of 4.5 m: 50 - 1.25 - 2.25 = 46.5 m.
/// ```
/// use zhuyi_core::Footprint;
/// use zhuyi_core::approach::gap;
/// let (car, bus) = (Footprint { length: 4.5, width: 1.8 }, Footprint { length: 12.0, width: 2.5 });
/// let across = bus.turned(std::f64::consts::FRAC_PI_2);
/// assert!((gap(50.0, car, across) - 46.5).abs() < 1e-12);
/// ```
#[inline]
pub fn gap(ahead: f64, one: Footprint, other: Footprint) -> f64 {
    ahead - one.half_lengths(other)
}

/// Returns the gap [m] between the sides of two boxes as they stand on a path that face each other, their centres `aside`
/// metres apart across it to either side; negative while they overlap sideways.
///
/// ```
/// use zhuyi_core::Footprint;
/// use zhuyi_core::approach::edge_gap;
/// let car = Footprint { length: 4.0, width: 2.0 };
/// assert_eq!((edge_gap(-3.5, car, car), edge_gap(1.5, car, car)), (1.5, -0.5));
/// ```
#[inline]
pub fn edge_gap(aside: f64, one: Footprint, other: Footprint) -> f64 {
    aside.abs() - one.half_widths(other)
}

/// Returns whether two boxes as they stand on a path, their centres `aside` metres apart across it, overlap sideways or
/// come nearer than `margin` metres to it.
///
/// ```
/// use zhuyi_core::Footprint;
/// use zhuyi_core::approach::in_the_way;
/// let car = Footprint { length: 4.0, width: 2.0 };
/// assert!(in_the_way(-1.9, car, car, 0.0) && !in_the_way(2.0, car, car, 0.0) && in_the_way(2.1, car, car, 0.2));
/// ```
#[inline]
pub fn in_the_way(aside: f64, one: Footprint, other: Footprint, margin: f64) -> bool {
    aside.abs() < one.half_widths(other) + margin
}

/// Returns whether a gap closes: by [`LEAST_CLOSING_SPEED`] or more.
#[inline]
pub fn closes(closing_speed: f64) -> bool {
    closing_speed >= LEAST_CLOSING_SPEED
}

/// Returns the time to collision [s] over a gap [m] that closes at a speed [m/s] that is held, at least 0. None where the
/// gap does not [close](closes), and where there is none, side by side.
///
/// 46.5 m at 10 m/s: 4.65 s.
/// ```
/// use zhuyi_core::approach::time_to_collision;
/// assert!((time_to_collision(46.5, 10.0).unwrap() - 4.65).abs() < 1e-12);
/// assert_eq!(time_to_collision(0.0, 10.0), Some(0.0));
/// assert_eq!([time_to_collision(-0.1, 10.0), time_to_collision(46.5, 1e-7)], [None, None]);
/// ```
#[inline]
pub fn time_to_collision(gap: f64, closing_speed: f64) -> Option<f64> {
    (gap >= 0.0 && closes(closing_speed)).then(|| gap / closing_speed)
}
