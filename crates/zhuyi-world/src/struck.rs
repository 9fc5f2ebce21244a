//! Contacts from behind: those that an ego cannot prevent by braking sooner.
//!
//! An ego is struck from behind when the place of the touch lies in the rear half of its box and the actor is the one that closes
//! in: along the contact normal its velocity towards the ego is the larger of the two. So a follower that does not stop strikes
//! from behind, and one that swerves into the ego's rear flank; an ego that swerves its own rear flank into a car beside it is not
//! struck.

use zhuyi_core::Point;

use crate::contact::boxes::{Placed, into_frame, normal};

/// [m] corners no farther from the other box lie at it: a cast is good to millimetres.
const AT: f64 = 0.01;

/// Whether a touch of the ego with another body is one from behind, from their boxes and velocities [m/s] in the world.
pub(crate) fn from_behind(
    ego: Placed,
    ego_velocity: (f64, f64),
    other: Placed,
    other_velocity: (f64, f64),
) -> bool {
    if forward_of_touch(ego, other) >= 0.0 {
        return false;
    }
    let approach = (
        other_velocity.0 - ego_velocity.0,
        other_velocity.1 - ego_velocity.1,
    );
    let normal = normal(ego, other, approach);
    let along = |velocity| {
        let (forward, left) = into_frame(ego.1.heading, velocity);
        normal.0 * forward + normal.1 * left
    };
    // The normal points from the ego to the other.
    -along(other_velocity) > along(ego_velocity).max(0.0)
}

/// [m] the place of a touch ahead of the ego's centre: the middle of the corners of each box that lie at the other.
fn forward_of_touch(ego: Placed, other: Placed) -> f64 {
    let corners = |of: Placed| of.0.corners(of.1).into_iter();
    let own = corners(ego).filter(|corner| is_at(other, *corner));
    let others = corners(other).filter(|corner| is_at(ego, *corner));
    let (mut sum, mut count) = (0.0, 0);
    for corner in own.chain(others) {
        sum += ego.1.local(corner).0;
        count += 1;
    }
    if count == 0 {
        // Boxes that cross with no corner in the other.
        return ego.1.local(other.1.point()).0;
    }
    sum / f64::from(count)
}

fn is_at((footprint, pose): Placed, corner: Point) -> bool {
    let (forward, left) = pose.local(corner);
    forward.abs() <= footprint.length / 2.0 + AT && left.abs() <= footprint.width / 2.0 + AT
}

#[cfg(test)]
mod tests {
    use super::from_behind;
    use zhuyi_core::{Footprint, Pose};

    const CAR: Footprint = Footprint {
        length: 4.0,
        width: 2.0,
    };

    /// Whether an ego at the origin, heading along x, is struck from behind.
    fn struck(ego: (f64, f64), pose: Pose, other: (f64, f64)) -> bool {
        from_behind((CAR, Pose::default()), ego, (CAR, pose), other)
    }

    #[test]
    fn hand_who_closes_in_on_the_rear_half_strikes_from_behind() {
        let at = Pose::new;
        // A follower runs into the rear bumper, straight, with an offset, and askew.
        assert!(struck((15.0, 0.0), at(-4.0, 0.0, 0.0), (20.0, 0.0)));
        assert!(struck((15.0, 0.0), at(-4.0, 1.5, 0.0), (20.0, 0.0)));
        assert!(struck((15.0, 0.0), at(-3.9, 1.9, -0.3), (20.0, -3.0)));
        // The ego runs into the one ahead.
        assert!(!struck((20.0, 0.0), at(4.0, 0.0, 0.0), (15.0, 0.0)));
        // A car beside it swerves into its rear flank, into its front flank; the ego swerves into the car.
        assert!(struck((20.0, 0.0), at(-2.5, 2.0, 0.0), (20.0, -1.0)));
        assert!(!struck((20.0, 0.0), at(2.5, 2.0, 0.0), (20.0, -1.0)));
        assert!(!struck((20.0, 1.0), at(-2.5, 2.0, 0.0), (20.0, 0.0)));
        // Both move towards each other: whoever is faster closes in.
        assert!(struck((20.0, 0.5), at(-2.5, 2.0, 0.0), (20.0, -1.0)));
        assert!(!struck((20.0, 1.0), at(-2.5, 2.0, 0.0), (20.0, -0.5)));
        // A crossing car runs into the rear flank of an ego that stands.
        let crosses = at(-1.5, -3.0, std::f64::consts::FRAC_PI_2);
        assert!(struck((0.0, 0.0), crosses, (0.0, 5.0)));
    }

    /// A world turned as a whole changes nothing.
    #[test]
    fn law_the_heading_of_the_world_does_not_matter() {
        for step in 0..16 {
            let turn = 0.4 * f64::from(step);
            let (sin, cos) = turn.sin_cos();
            let turned = |(x, y): (f64, f64)| (x * cos - y * sin, x * sin + y * cos);
            let place = turned((-4.0, 1.0));
            let behind = from_behind(
                (CAR, Pose::new(0.0, 0.0, turn)),
                turned((15.0, 0.0)),
                (CAR, Pose::new(place.0, place.1, turn)),
                turned((20.0, 0.0)),
            );
            assert!(behind, "{turn}");
        }
    }
}
