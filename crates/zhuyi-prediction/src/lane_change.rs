//! Lane change: who moves sideways faster than a threshold goes on at that speed to the centre of the next lane on that
//! side and stays there; who does not keeps its offset. Along the road the acceleration stays.

use zhuyi_core::{Across, Road, Track, Trajectory};

use crate::constant::along;

/// The forecast's only trajectory, into an empty `way`.
pub(crate) fn trajectory(track: &Track, road: &Road, threshold: f64, way: &mut Trajectory) {
    along(track, track.s_accel, &mut way.along);
    across(track, road, threshold, &mut way.across);
}

pub(crate) fn across(track: &Track, road: &Road, threshold: f64, pieces: &mut Vec<Across>) {
    let (d, rate) = (track.road.d, track.d_rate);
    if rate.abs() < threshold {
        pieces.push(Across {
            time: 0.0,
            d,
            d_rate: 0.0,
        });
        return;
    }
    towards(next_center(road, d, rate), d, rate, pieces);
}

/// From the offset `d` at `rate` until `goal`, and no further.
pub(crate) fn towards(goal: f64, d: f64, rate: f64, pieces: &mut Vec<Across>) {
    pieces.push(Across {
        time: 0.0,
        d,
        d_rate: rate,
    });
    pieces.push(Across {
        time: (goal - d) / rate,
        d: goal,
        d_rate: 0.0,
    });
}

/// [m] the first lane centre at or beyond `d` in the direction of `rate`; beyond the last lane, `d` itself.
fn next_center(road: &Road, d: f64, rate: f64) -> f64 {
    let centers = (1..=road.lanes()).map(|lane| road.lane_center(zhuyi_core::Lane(lane)));
    if rate > 0.0 {
        centers
            .filter(|c| *c >= d)
            .min_by(f64::total_cmp)
            .unwrap_or(d)
    } else {
        centers
            .filter(|c| *c <= d)
            .max_by(f64::total_cmp)
            .unwrap_or(d)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constant::tests::track;
    use zhuyi_core::{Pose, Segment};

    fn road() -> Road {
        Road::new(Pose::default(), &[Segment::Line { length: 500.0 }], 3, 3.5).unwrap()
    }

    fn across(track: &Track, road: &Road, threshold: f64) -> Vec<Across> {
        let mut pieces = Vec::new();
        super::across(track, road, threshold, &mut pieces);
        pieces
    }

    #[test]
    fn hand_a_change_ends_in_the_next_lane() {
        // From the right lane's centre (-3.5) at 1 m/s: 3.5 s to the middle lane's centre.
        let path = across(&track(20.0, 0.0, -3.5 + 0.5, 1.0), &road(), 0.3);
        assert_eq!(
            path[1],
            Across {
                time: 3.0,
                d: 0.0,
                d_rate: 0.0
            }
        );
    }

    #[test]
    fn hand_slow_drift_is_no_change() {
        assert_eq!(
            across(&track(20.0, 0.0, 0.2, 0.1), &road(), 0.3),
            [Across {
                time: 0.0,
                d: 0.2,
                d_rate: 0.0
            }]
        );
    }

    #[test]
    fn hand_beyond_the_last_lane_the_offset_is_kept() {
        let path = across(&track(20.0, 0.0, 4.0, 1.0), &road(), 0.3);
        assert_eq!(
            path.last().map(|p| (p.time, p.d, p.d_rate)),
            Some((0.0, 4.0, 0.0))
        );
    }

    #[test]
    fn law_mirror_symmetry() {
        for (d, rate) in [(-3.0, 1.0), (0.4, -0.7), (3.4, 2.0)] {
            let left = across(&track(20.0, 0.0, d, rate), &road(), 0.3);
            let right = across(&track(20.0, 0.0, -d, -rate), &road(), 0.3);
            for (a, b) in left.iter().zip(&right) {
                assert_eq!((a.time, a.d, a.d_rate), (b.time, -b.d, -b.d_rate));
            }
        }
    }
}
