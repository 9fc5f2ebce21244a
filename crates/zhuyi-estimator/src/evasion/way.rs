//! One way to evade, judged in continuous time along the pieces of the actor's future.
//!
//! On every piece of both lists, within one phase of the ego, the gap and the ego's distance are quadratics and the
//! actor's offset is a line; so the times at which the actor overlaps the strip and the first contact or the first t_n
//! in them are roots. Written plainly: every reaction time is judged by itself.

use zhuyi_core::{Along, Footprint, LaneChange};

use super::Evasion;
use crate::ego_motion::{EgoMotion, Start};
use crate::encounter::Delay;
use crate::stretch::{Datum, Stretch};
use crate::{Ego, Future, Params};

/// The least offsets of the ego to the left and to the right of an actor, wherever that goes in the horizon; its own
/// where it is clear already.
pub(super) fn targets(
    params: &Params,
    ego: &Ego,
    actor: Footprint,
    future: &Future<'_>,
) -> (f64, f64) {
    let extent = Extent::of(future, params.horizon);
    let lane = f64::midpoint(ego.footprint.width, actor.width) + params.lateral_margin;
    (
        (extent.most + lane).max(ego.d),
        (extent.least - lane).min(ego.d),
    )
}

/// The lateral extent of an actor's centre over the horizon.
#[derive(Clone, Copy, Debug)]
struct Extent {
    least: f64,
    most: f64,
}

impl Extent {
    fn of(future: &Future<'_>, horizon: f64) -> Self {
        let first = future.across_index(0.0);
        let mut extent = Self {
            least: f64::INFINITY,
            most: f64::NEG_INFINITY,
        };
        for (place, piece) in future.across.iter().enumerate().skip(first) {
            let (start, end) = piece_times(future, place, horizon);
            if start > horizon {
                break;
            }
            for time in [start, end] {
                let d = piece.d + (time + future.now - piece.time) * piece.d_rate;
                if d < extent.least {
                    extent.least = d;
                }
                if d > extent.most {
                    extent.most = d;
                }
            }
        }
        extent
    }
}

/// [s] from when to when a piece across holds within [0, horizon], from t_0.
fn piece_times(future: &Future<'_>, place: usize, horizon: f64) -> (f64, f64) {
    let next = future.across.get(place + 1);
    let start = if place == 0 {
        0.0
    } else {
        (future.across[place].time - future.now).max(0.0)
    };
    (
        start,
        next.map_or(horizon, |next| (next.time - future.now).min(horizon)),
    )
}

/// An evasion to one side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way<'a> {
    future: Future<'a>,
    datum: Datum,
    held: Start,
    /// [m] offsets of the actor's centre between which it overlaps the strip sideways.
    strip: (f64, f64),
    /// [s] T.
    duration: f64,
    c1: f64,
    horizon: f64,
}

impl<'a> Way<'a> {
    pub fn new(
        params: &Params,
        evasion: &Evasion,
        ego: &Ego,
        actor: Footprint,
        future: Future<'a>,
        target: f64,
    ) -> Self {
        let body = f64::midpoint(ego.footprint.width, actor.width);
        let reach = f64::midpoint(ego.footprint.length, actor.length);
        let duration = if target == ego.d {
            0.0
        } else {
            LaneChange::within(0.0, ego.d, target, evasion.lateral_accel).duration
        };
        Self {
            future,
            datum: Datum {
                now: future.now,
                origin: ego.s + reach,
            },
            held: Start::new(ego.speed, ego.accel),
            strip: (target.min(ego.d) - body, target.max(ego.d) + body),
            duration,
            c1: params.c1,
            horizon: params.horizon,
        }
    }

    /// [s] the first t_n; none where the reaction is too late for this way.
    pub fn t_n(&self, delay: Delay) -> Option<f64> {
        let clear_from = delay.reaction_time + self.duration;
        if clear_from > self.horizon {
            return None;
        }
        let motion =
            EgoMotion::coasting(self.held, delay.reaction_time).with_head_start(delay.head_start);
        if self.passes_through(&motion, clear_from) {
            return None;
        }
        let behind = |stretch: &Stretch| stretch.first_within(self.c1);
        self.first(&motion, clear_from, self.horizon, behind)
    }

    /// Whether the ego's front passes the actor's rear in [0, until] while the actor overlaps the strip sideways.
    fn passes_through(&self, motion: &EgoMotion, until: f64) -> bool {
        let future = &self.future;
        let first = future.across_index(0.0);
        (first..future.across.len())
            .map(|place| (place, piece_times(future, place, until)))
            .take_while(|(_, (start, _))| *start < until)
            .filter_map(|(place, (start, end))| {
                let piece = &future.across[place];
                let d = piece.d + (start + future.now - piece.time) * piece.d_rate;
                let (from, to) = inside(self.strip, d, piece.d_rate, end - start)?;
                Some((start + from, start + to))
            })
            .any(|(from, to)| {
                self.first(motion, from, to, Stretch::first_contact)
                    .is_some()
            })
    }

    /// The first time in [from, to] that `find` finds on a stretch.
    fn first(
        &self,
        motion: &EgoMotion,
        from: f64,
        to: f64,
        find: impl Fn(&Stretch) -> Option<f64>,
    ) -> Option<f64> {
        let (future, now) = (&self.future, self.future.now);
        let mut index = future.along_index(from);
        let mut time = from;
        loop {
            let next = future.along.get(index + 1);
            let end = next.map_or(to, |next| (next.time - now).min(to));
            let piece: &Along = &future.along[index];
            for (phase, phase_end) in motion.phases() {
                let (a, b): (f64, f64) = (phase.start.max(time), phase_end.min(end));
                if a <= b {
                    let found = find(&Stretch::new(a, b, piece, self.datum, phase));
                    if let Some(x) = found {
                        return Some(a + x);
                    }
                }
            }
            if end >= to {
                return None;
            }
            (time, index) = (end.max(time), index + 1);
        }
    }
}

/// The part of [0, length] in which a line `d + rate x` lies between two borders; none where that is an instant or less.
fn inside((low, high): (f64, f64), d: f64, rate: f64, length: f64) -> Option<(f64, f64)> {
    let (from, to) = if rate == 0.0 {
        (low < d && d < high).then_some((0.0, length))?
    } else {
        let (a, b) = ((low - d) / rate, (high - d) / rate);
        (a.min(b).max(0.0), a.max(b).min(length))
    };
    (from < to).then_some((from, to))
}
