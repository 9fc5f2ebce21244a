//! Post-encroachment time: how narrowly two vehicles miss each other at the places that both use.
//!
//! Each point x of the ego's path is used by the ego from its front bumper to its rear bumper, and by the actor while
//! its body covers x and the bodies overlap sideways, each body with its extents as it stands (reading R7). PET is the least time, over all points, from when the first has
//! left to when the second arrives:
//!
//! ```text
//!   the actor first:   T(x_rear(t)) - t      T: when the ego's front arrives        minimum over the times t at which
//!   the ego first:     t - T(x_front(t))     T: when the ego's rear has left        the bodies overlap sideways
//! ```
//!
//! With the ego's acceleration held, T is the root of a quadratic. Within one piece of the actor's motion the minimum
//! lies at an end, or where both pass the point at one speed, `v_a(t)^2 = v_e^2 + 2 a_e x`, a quadratic in t.
//!
//! Sources: Allen, Shin & Cooper, "Analysis of Traffic Conflicts and Collisions" (1978); taken point by point, with the
//! minimum and 0 for a collision, as in the FHWA's SSAM (FHWA-HRT-08-051, 2008). So car following has a PET as well: a
//! lead of the same speed has its time headway. The actor's part is its recorded or predicted future; the ego's is its
//! acceleration held, so this is what Westhofen et al. (2023) call a predictive one. A point counts if both leave and
//! arrive from `now` on, and the actor within the horizon. It says nothing of fault: a follower has one too. The
//! lateral margin of the corridor plays no part: what never overlaps shares nothing.

use zhuyi_core::approach::LEAST_CLOSING_SPEED;
use zhuyi_core::quadratic::Quadratic;
use zhuyi_core::room::{Room, with_room};
use zhuyi_core::{Extent, Footprint};
use zhuyi_estimator::ego_motion::{EgoMotion, Start};
use zhuyi_estimator::{Ego, Future};

/// [s] the post-encroachment time; 0 for a collision, None if no place is shared.
///
/// Cars of 4 m x 2 m, the ego at 10 m/s. One crosses at 3 m/s, 34 m ahead: from d = -6 m it has left the ego's path at
/// d = 2 m, after 8/3 s; the ego's front has 34 - 4 = 30 m to go, 3 s: PET 1/3 s. One that crosses 10 m ahead from d =
/// -12 m enters at d = -2 m, after 10/3 s, when the ego's rear has left it 10 + 4 = 14 m behind, 1.4 s: 1.93 s.
/// ```
/// use zhuyi_core::{Across, Along, Footprint};
/// use zhuyi_metrics::criticality::encroachment::pet;
/// use zhuyi_estimator::{Ego, Future};
/// let car = Footprint { length: 4.0, width: 2.0 };
/// let ego = Ego { s: 0.0, d: 0.0, speed: 10.0, accel: 0.0, footprint: car };
/// let crossing = |s: f64, d: f64| {
///     let along = [Along::constant_accel(0.0, s, 0.0, 0.0)];
///     let across = [Across { time: 0.0, d, d_rate: 3.0 }];
///     pet(&ego, car, &Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 }, 20.0).unwrap()
/// };
/// assert!((crossing(34.0, -6.0) - 1.0 / 3.0).abs() < 1e-12);
/// assert!((crossing(10.0, -12.0) - (10.0 / 3.0 - 1.4)).abs() < 1e-12);
/// ```
pub fn pet(ego: &Ego, actor: Footprint, future: &Future<'_>, horizon: f64) -> Option<f64> {
    let start = Start::new(ego.speed, ego.accel);
    let mut pair = Pair {
        ego: start,
        held: EgoMotion::held(start),
        ego_box: ego.footprint,
        least: None,
    };
    let first = future.across_index(0.0);
    for (index, piece) in future.across.iter().enumerate().skip(first) {
        let begin = piece.time - future.now;
        let next = future.across.get(index + 1);
        let end = next.map_or(horizon, |next| (next.time - future.now).min(horizon));
        for (from, to, extent) in future.extents_within(actor, begin.max(0.0), end) {
            let aside = piece.d - ego.d + (from - begin) * piece.d_rate;
            let reach = pair.half_widths(&extent, from);
            let to_side = |side: f64| Room {
                at_start: reach + side * aside,
                rate: extent.across_rate + side * piece.d_rate,
            };
            let stay = with_room([to_side(-1.0), to_side(1.0)], to - from);
            if let Some((enters, leaves)) = stay
                && pair.stay(ego.s, future, &extent, (from + enters, from + leaves))
                    == Outcome::Collision
            {
                return Some(0.0);
            }
        }
        if end >= horizon {
            break;
        }
    }
    pair.least
}

/// What a stay on the ego's path leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Miss,
    Collision,
}

/// The two vehicles, and the least time found so far.
struct Pair {
    ego: Start,
    held: EgoMotion,
    ego_box: Footprint,
    least: Option<f64>,
}

impl Pair {
    /// [m] half of both widths.
    fn half_widths(&self, extent: &Extent, time: f64) -> f64 {
        extent.at(time).1 + self.ego_box.width / 2.0
    }

    /// Looks at a time in which the bodies overlap sideways and one piece of the half extents holds.
    fn stay(
        &mut self,
        ego_s: f64,
        future: &Future<'_>,
        extent: &Extent,
        (from, to): (f64, f64),
    ) -> Outcome {
        let (mut start, mut index) = (from, future.along_index(from));
        while start < to {
            let Some(piece) = future.along.get(index) else {
                break;
            };
            let next = future.along.get(index + 1);
            let end = next.map_or(to, |next| (next.time - future.now).min(to));
            let ahead = Quadratic {
                c0: piece.s - ego_s,
                c1: piece.s_rate,
                c2: piece.s_half_accel,
            };
            let ahead = ahead.from(start + future.now - piece.time);
            let reach = Room {
                at_start: extent.at(start).0 + self.ego_box.length / 2.0,
                rate: extent.along_rate,
            };
            if end > start && self.stretch(start, end - start, &ahead, &reach) == Outcome::Collision
            {
                return Outcome::Collision;
            }
            (start, index) = (start.max(end), index + 1);
        }
        Outcome::Miss
    }

    /// Looks at one piece of it: `ahead` is how far the actor's centre is ahead of where the ego's was at `now`, `reach`
    /// half of both lengths.
    fn stretch(&mut self, start: f64, length: f64, ahead: &Quadratic, reach: &Room) -> Outcome {
        // How far the ego's front has to go to the actor's rear, and its rear to the actor's front.
        let offset = |side: f64| Quadratic {
            c0: ahead.c0 + side * reach.at_start,
            c1: ahead.c1 + side * reach.rate,
            c2: ahead.c2,
        };
        let (to_rear, to_front) = (offset(-1.0), offset(1.0));
        let gone = self.held.distance(start);
        if to_rear.c0 >= gone {
            self.actor_first(start, length, &to_rear)
        } else if to_front.c0 <= gone {
            self.ego_first(start, length, &to_front)
        } else {
            Outcome::Collision
        }
    }

    fn actor_first(&mut self, start: f64, length: f64, to_rear: &Quadratic) -> Outcome {
        let [one, other] = self.same_speed(to_rear);
        for x in [Some(0.0), one, other, Some(length)].into_iter().flatten() {
            let distance = to_rear.at(x);
            if !(0.0..=length).contains(&x) {
                continue;
            }
            if distance < 0.0 {
                return Outcome::Collision;
            }
            let misses_by = self.arrival(distance).map(|arrives| arrives - (start + x));
            if misses_by.is_some_and(|time| self.note(time) == Outcome::Collision) {
                return Outcome::Collision;
            }
        }
        Outcome::Miss
    }

    fn ego_first(&mut self, start: f64, length: f64, to_front: &Quadratic) -> Outcome {
        let [one, other] = self.same_speed(to_front);
        // What the ego had left before `now` does not count.
        let left_from_now = to_front.first_reached(length);
        for x in [Some(0.0), left_from_now, one, other, Some(length)]
            .into_iter()
            .flatten()
        {
            // Rounding may leave the root just short of the point.
            let distance = to_front.at(x);
            let distance = if Some(x) == left_from_now {
                distance.max(0.0)
            } else {
                distance
            };
            if !(0.0..=length).contains(&x) || distance < 0.0 {
                continue;
            }
            let Some(left) = self.arrival(distance) else {
                return Outcome::Collision;
            };
            if self.note(start + x - left) == Outcome::Collision {
                return Outcome::Collision;
            }
        }
        Outcome::Miss
    }

    /// Keeps the least time.
    fn note(&mut self, time: f64) -> Outcome {
        if time < -ROUNDING {
            return Outcome::Collision;
        }
        if self.least.is_none_or(|least| time < least) {
            self.least = Some(time.max(0.0));
        }
        Outcome::Miss
    }

    /// [s] when the ego has gone so far; None if never, or by less than [`LEAST_CLOSING_SPEED`] on average.
    fn arrival(&self, distance: f64) -> Option<f64> {
        let Start { speed, accel } = self.ego;
        if distance == 0.0 {
            return Some(0.0);
        }
        let square = speed * speed + 2.0 * accel * distance;
        let time = 2.0 * distance / (speed + square.sqrt());
        (square >= 0.0 && distance >= LEAST_CLOSING_SPEED * time).then_some(time)
    }

    /// When the actor passes a point as fast as the ego does.
    fn same_speed(&self, distance: &Quadratic) -> [Option<f64>; 2] {
        let Quadratic { c0, c1, c2 } = *distance;
        let relative = 2.0 * c2 - self.ego.accel;
        if relative == 0.0 {
            // The squares of both speeds at a point keep their difference.
            return [None, None];
        }
        let (a, half_b) = (2.0 * c2 * relative, c1 * relative);
        let c = c1 * c1 - self.ego.speed * self.ego.speed - 2.0 * self.ego.accel * c0;
        let root = (half_b * half_b - a * c).sqrt();
        // Without cancellation; a root that does not exist is not finite.
        let sum = -(half_b + root.copysign(half_b));
        [sum / a, c / sum].map(|x| x.is_finite().then_some(x))
    }
}

/// [s] to arrive before the other has left by less than this is rounding, and a miss by nothing.
const ROUNDING: f64 = 1e-9;
