//! Where nobody looks on a road: around the bodies as they are, or as the ego believes them to be.
//!
//! ```text
//!  Trace row ───────────────┐
//!                           ├─▶ bodies ──▶ Surroundings ──▶ phantoms along the ego's offset (readings R7, R17)
//!  Track ──[believed]───────┘
//! ```
//!
//! Left out: who is not confirmed yet hides nothing from what the ego believes, so that the place behind counts as seen,
//! as it would to a stack that knows no more.

use zhuyi_core::{Body, Frenet, Pose, Road, Track};
use zhuyi_estimator::Surroundings;

/// What decides where nobody looks, with the ego's path along its own offset on the road.
pub fn surroundings<'a>(
    road: &'a Road,
    ego: &'a Body,
    bodies: &'a [Body],
) -> Surroundings<'a, impl Fn(f64) -> Pose + 'a> {
    let d = ego.road.d;
    let path = move |s: f64| road.world_from_road(Frenet { s, d });
    Surroundings {
        ego,
        bodies,
        path,
        straight_until: road.straight_until(ego.road.s),
    }
}

/// The body that a track speaks of.
///
/// 3 m/s forward and 4 m/s to the left are 5 m/s.
/// ```
/// # use zhuyi_core::{ActorId, Footprint, Frenet, Road, SimTime, Track};
/// # let road = Road::straight(1000.0, 3, 3.5).unwrap();
/// # let track = Track {
/// #     actor: ActorId(0), time: SimTime::ZERO, seen: SimTime::ZERO,
/// #     footprint: Footprint { length: 4.0, width: 1.9 }, road: Frenet { s: 20.0, d: 1.0 },
/// #     turn: 0.0,
/// #     extent: Footprint { length: 4.0, width: 1.9 },
/// #     s_rate: 3.0, s_accel: 0.0, d_rate: 4.0, s_deviation: 0.1, d_deviation: 0.1,
/// # };
/// let body = zhuyi_sim::believed(&track, &road);
/// assert_eq!((body.speed, body.s_rate, body.road), (5.0, 3.0, track.road));
/// ```
pub fn believed(track: &Track, road: &Road) -> Body {
    let aligned = road.world_from_road(track.road);
    Body {
        footprint: track.footprint,
        road: track.road,
        pose: Pose::new(aligned.x, aligned.y, aligned.heading + track.turn),
        turn: track.turn,
        extent: track.extent,
        speed: libm::hypot(track.s_rate, track.d_rate),
        accel: track.s_accel,
        s_rate: track.s_rate,
        d_rate: track.d_rate,
    }
}
