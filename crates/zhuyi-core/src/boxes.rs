//! Distances between two turned boxes, exactly.
//!
//! | quantity | meaning |
//! |---|---|
//! | [`distance`] | least distance of the boxes in any direction |
//! | [`swept_gap`] | how far one may go along the path, the other standing, until they touch |
//!
//! Both are gaps of the boxes themselves, for what is measured in a run; the model's gap is that of their half extents
//! ([`Footprint::turned`]), which is never larger. Of aligned boxes that overlap sideways all three are bumper to bumper.

use crate::{Axes, Body, Footprint, Point, Pose};

/// [m] least distance of two boxes in the plane; 0 where they overlap.
///
/// Both are 4 m x 2 m. Bumper to bumper 1 m apart; and one that stands across, 3 m further on: 5 - 1 - 2 = 2 m.
/// ```
/// use zhuyi_core::boxes::distance;
/// use zhuyi_core::{Footprint, Pose};
/// let car = Footprint { length: 4.0, width: 2.0 };
/// let here = (car, Pose::default());
/// assert_eq!(distance(here, (car, Pose::new(5.0, 0.5, 0.0))), 1.0);
/// let across = Pose::new(5.0, 0.0, std::f64::consts::FRAC_PI_2);
/// assert!((distance(here, (car, across)) - 2.0).abs() < 1e-12);
/// assert_eq!(distance(here, (car, Pose::new(1.0, 1.0, 0.3))), 0.0);
/// ```
pub fn distance(one: (Footprint, Pose), other: (Footprint, Pose)) -> f64 {
    if overlap(one, other) && overlap(other, one) {
        return 0.0;
    }
    // Of convex bodies apart a corner of one is nearest to the other.
    let from_corners = |a: (Footprint, Pose), b: (Footprint, Pose)| {
        let (corners, axes) = (a.0.corners(a.1), Axes::new(b.1));
        let to_point = move |corner: Point| distance_to_point(b.0, axes.local(corner));
        corners.into_iter().map(to_point)
    };
    from_corners(one, other)
        .chain(from_corners(other, one))
        .fold(f64::INFINITY, f64::min)
}

/// Returns whether no axis of the first box parts the two.
fn overlap(one: (Footprint, Pose), other: (Footprint, Pose)) -> bool {
    let (ahead, left) = one.1.local(other.1.point());
    let turned = other.0.turned(other.1.heading - one.1.heading);
    ahead.abs() < one.0.half_lengths(turned) && left.abs() < one.0.half_widths(turned)
}

/// [m] distance from a box of a point that is so far ahead and to the left of its centre.
fn distance_to_point(footprint: Footprint, (ahead, left): (f64, f64)) -> f64 {
    let beyond = |distance: f64, extent: f64| (distance.abs() - extent / 2.0).max(0.0);
    let (x, y) = (
        beyond(ahead, footprint.length),
        beyond(left, footprint.width),
    );
    (x * x + y * y).sqrt()
}

/// [m] how far `ego` may go along its path until it touches `other`, which stands; none where it passes beside it or is
/// beyond it. Places are those on the road, or [along a lane](crate::LaneFrame::body).
///
/// A lorry of 12 m x 2.5 m stands askew by 45 degrees, its middle 20 m ahead and 6 m to the left of a car of 4 m x 2 m. Its rear
/// edge runs from (14.874, 2.641) to (16.641, 0.873) and crosses the car's left side, 1 m from its middle, 16.514 m ahead: the
/// car may go 14.514 m. The half extents reach back to 14.873 m.
/// ```
/// # use zhuyi_core::{Body, Footprint, Frenet, Pose};
/// use zhuyi_core::boxes::swept_gap;
/// # let body = |footprint: Footprint, s: f64, d: f64, turn: f64| Body {
/// #     footprint, road: Frenet { s, d }, pose: Pose::new(s, d, turn), turn, extent: footprint.turned(turn),
/// #     speed: 0.0, accel: 0.0, s_rate: 0.0, d_rate: 0.0,
/// # };
/// let car = Footprint { length: 4.0, width: 2.0 };
/// let ego = body(car, 0.0, 0.0, 0.0);
/// assert_eq!(swept_gap(&ego, &body(car, 10.0, 1.5, 0.0)), Some(6.0));
/// assert_eq!(swept_gap(&ego, &body(car, 10.0, 2.5, 0.0)), None);
/// assert_eq!(swept_gap(&ego, &body(car, -10.0, 0.0, 0.0)), None);
/// let lorry = body(Footprint { length: 12.0, width: 2.5 }, 20.0, 6.0, std::f64::consts::FRAC_PI_4);
/// assert!((swept_gap(&ego, &lorry).unwrap() - 14.514).abs() < 1e-3);
/// assert!((lorry.rear() - ego.front() - 12.873).abs() < 1e-3);
/// ```
pub fn swept_gap(ego: &Body, other: &Body) -> Option<f64> {
    if !other.overlaps_sideways(ego) || other.road.s < ego.road.s {
        return None;
    }
    if ego.turn == 0.0 && other.turn == 0.0 {
        let gap = other.rear() - ego.front();
        return (gap >= 0.0).then_some(gap);
    }
    let (front, rear) = (outline(ego), outline(other));
    // The gap over an offset is a convex function, of lines between the offsets of corners.
    let low = (ego.road.d - ego.extent.width / 2.0).max(other.road.d - other.extent.width / 2.0);
    let high = (ego.road.d + ego.extent.width / 2.0).min(other.road.d + other.extent.width / 2.0);
    let corners = front.iter().chain(&rear).map(|corner| corner.y);
    let offsets = corners.filter(|y| *y > low && *y < high).chain([low, high]);
    let gap = offsets
        .map(|y| {
            let foremost = edges_at(&front, y).fold(f64::NEG_INFINITY, f64::max);
            let rearmost = edges_at(&rear, y).fold(f64::INFINITY, f64::min);
            rearmost - foremost
        })
        .fold(f64::INFINITY, f64::min);
    (gap >= 0.0).then_some(gap)
}

/// Corners of a box on the road, (s, d).
fn outline(body: &Body) -> [Point; 4] {
    let place = Pose::new(body.road.s, body.road.d, body.turn);
    body.footprint.corners(place)
}

/// [m] the s at which the edges of a box cross an offset `d`, which it reaches; both ends of an edge that lies along it.
fn edges_at(corners: &[Point; 4], d: f64) -> impl Iterator<Item = f64> {
    (0..4)
        .flat_map(move |place| {
            let (from, to) = (corners[place], corners[(place + 1) % 4]);
            let (before, behind) = (from.y - d, to.y - d);
            // Rounding may leave the outermost corner just outside.
            let misses = (before > ROUNDING && behind > ROUNDING)
                || (before < -ROUNDING && behind < -ROUNDING);
            if misses {
                return [None, None];
            }
            let rise = to.y - from.y;
            if rise.abs() <= ROUNDING {
                return [Some(from.x), Some(to.x)];
            }
            let share = (-before / rise).clamp(0.0, 1.0);
            [Some(from.x + share * (to.x - from.x)), None]
        })
        .flatten()
}

/// [m] slack for the rounding of corners.
const ROUNDING: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Frenet;
    use rand::{RngExt, SeedableRng};

    fn body(footprint: Footprint, s: f64, d: f64, turn: f64) -> Body {
        Body {
            footprint,
            road: Frenet { s, d },
            pose: Pose::new(s, d, turn),
            turn,
            extent: footprint.turned(turn),
            speed: 0.0,
            accel: 0.0,
            s_rate: 0.0,
            d_rate: 0.0,
        }
    }

    fn moved(body: &Body, by: f64) -> (Footprint, Pose) {
        let Pose { x, y, heading } = body.pose;
        (body.footprint, Pose::new(x + by, y, heading))
    }

    /// An ego that goes by the swept gap touches, one that goes by less does not, and one without a gap never does.
    #[test]
    fn law_who_goes_by_the_swept_gap_touches() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
        let (mut touched, mut passed) = (0, 0);
        for _ in 0..20_000 {
            let mut any = |s: f64| {
                let footprint = Footprint {
                    length: rng.random_range(1.0..16.0),
                    width: rng.random_range(0.5..2.6),
                };
                let turn = [0.0, rng.random_range(-3.2..3.2)][rng.random_range(0..2)];
                body(footprint, s, rng.random_range(-5.0..5.0), turn)
            };
            let (ego, other) = (any(0.0), any(40.0));
            let there = (other.footprint, other.pose);
            if let Some(gap) = swept_gap(&ego, &other) {
                touched += 1;
                assert!(
                    distance(moved(&ego, gap), there) < 1e-6,
                    "{ego:?} {other:?}"
                );
                assert!(distance(moved(&ego, gap - 0.01), there) > 0.0);
                // The model's gap is never larger.
                assert!(other.rear() - ego.front() <= gap + 1e-9);
            } else {
                passed += 1;
                let least =
                    (0..800).map(|step| distance(moved(&ego, 0.1 * f64::from(step)), there));
                assert!(
                    least.fold(f64::INFINITY, f64::min) > 0.0,
                    "{ego:?} {other:?}"
                );
            }
        }
        assert!(touched > 5_000 && passed > 5_000, "{touched} {passed}");
    }
}
