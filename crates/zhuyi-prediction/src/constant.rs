//! Constant velocity and constant acceleration: `s(t) = s + v t + a t^2 / 2` up to standstill, `d(t) = d + d' t`.

use zhuyi_core::{Across, Along, Track, Trajectory};

/// The way along the road at acceleration `accel`; a braking vehicle stands once its speed is gone.
///
/// By hand: 10 m/s braking at 2 m/s2 from s = 0 stands after 5 s at 25 m (tested below).
pub(crate) fn along(track: &Track, accel: f64, pieces: &mut Vec<Along>) {
    let speed = track.s_rate.max(0.0);
    if accel < 0.0 {
        let stop = speed / -accel;
        let end = track.road.s + speed * stop / 2.0;
        if stop > 0.0 {
            pieces.push(Along::constant_accel(0.0, track.road.s, speed, accel));
            pieces.push(Along::constant_accel(stop, end, 0.0, 0.0));
        } else {
            pieces.push(Along::constant_accel(0.0, track.road.s, 0.0, 0.0));
        }
    } else {
        pieces.push(Along::constant_accel(0.0, track.road.s, speed, accel));
    }
}

/// Constant `accel` along the road and the track's lateral speed across it, into an empty `way`.
pub(crate) fn trajectory(track: &Track, accel: f64, way: &mut Trajectory) {
    along(track, accel, &mut way.along);
    way.across.push(Across {
        time: 0.0,
        d: track.road.d,
        d_rate: track.d_rate,
    });
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use zhuyi_core::{ActorId, Footprint, Frenet, SimTime};

    pub(crate) fn track(s_rate: f64, s_accel: f64, d: f64, d_rate: f64) -> Track {
        Track {
            actor: ActorId(0),
            time: SimTime::ZERO,
            seen: SimTime::ZERO,
            footprint: Footprint {
                length: 4.6,
                width: 1.8,
            },
            road: Frenet { s: 0.0, d },
            turn: 0.0,
            extent: Footprint {
                length: 4.6,
                width: 1.8,
            },
            s_rate,
            s_accel,
            d_rate,
            s_deviation: 0.0,
            d_deviation: 0.0,
        }
    }

    fn trajectory(track: &Track, accel: f64) -> Trajectory {
        let mut list = Vec::new();
        super::trajectory(track, accel, crate::Ways::new(&mut list).add(1.0));
        list.remove(0).1
    }

    #[test]
    fn hand_a_braking_vehicle_stands_after_v_over_a() {
        let path = trajectory(&track(10.0, -2.0, 0.0, 0.0), -2.0);
        let last = path.along[1];
        assert_eq!((last.time, last.s, last.v_at(9.0)), (5.0, 25.0, 0.0));
        assert_eq!(path.along[0].s_at(5.0), 25.0);
    }

    #[test]
    fn hand_constant_velocity_ignores_the_acceleration() {
        let path = trajectory(&track(10.0, -2.0, 1.0, 0.5), 0.0);
        assert_eq!(path.along[0].s_at(3.0), 30.0);
        assert_eq!((path.across[0].d, path.across[0].d_rate), (1.0, 0.5));
    }

    #[test]
    fn hand_a_standing_vehicle_does_not_reverse() {
        let path = trajectory(&track(0.0, -2.0, 0.0, 0.0), -2.0);
        assert_eq!(path.along.len(), 1);
        assert_eq!(path.along[0].s_at(4.0), 0.0);
    }
}
