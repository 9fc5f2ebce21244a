//! One way to evade, judged in continuous time along the pieces of the actor's future.
//!
//! On every piece of all lists, within one phase of the ego, the gap and the ego's distance are quadratics and the
//! offsets of the actor's sides are lines; so the times at which the actor overlaps the strip and the first contact or the first t_n
//! in them are roots. Written plainly: every reaction time is judged by itself.

use zhuyi_core::room::{Room, with_room};
use zhuyi_core::{Extent, Footprint, LaneChange};

use super::Evasion;
use crate::ego_motion::{EgoMotion, Start};
use crate::solver::encounter::Delay;
use crate::solver::stretch::{Datum, Stretch};
use crate::solver::swing::{Swing, stand};
use crate::{Ego, Future, Params};

/// The least offsets of the ego to the left and to the right of an actor, wherever that goes in the horizon and however it
/// turns; its own where it is clear already.
pub(super) fn targets(
    params: &Params,
    ego: &Ego,
    actor: Footprint,
    future: &Future<'_>,
) -> (f64, f64) {
    let (mut left, mut right) = (ego.d, ego.d);
    let first = future.across_index(0.0);
    for (place, piece) in future.across.iter().enumerate().skip(first) {
        let (start, end) = piece_times(future, place, params.horizon);
        if start > params.horizon {
            break;
        }
        for (from, to, extent) in future.extents_within(actor, start, end) {
            for time in [from, to] {
                let d = piece.d + (time + future.now - piece.time) * piece.d_rate;
                let lane = half_widths(ego, &extent, time) + params.lateral_margin;
                left = left.max(d + lane);
                right = right.min(d - lane);
            }
        }
    }
    (left, right)
}

/// [m] half of both widths, the actor's as it stands at a time.
fn half_widths(ego: &Ego, extent: &Extent, time: f64) -> f64 {
    extent.at(time).1 + ego.footprint.width / 2.0
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
    ego: Ego,
    actor: Footprint,
    /// How the actor's box turns; none where it keeps its extents.
    swing: Option<Swing<'a>>,
    datum: Datum,
    held: Start,
    /// [m] offsets of the ego's centre that it comes through.
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
        let (box_kept, swing) = stand(actor, future.extents, future.now);
        let duration = if target == ego.d {
            0.0
        } else {
            LaneChange::within(0.0, ego.d, target, evasion.lateral_accel).duration
        };
        Self {
            future,
            ego: *ego,
            actor,
            swing,
            datum: Datum {
                now: future.now,
                origin: ego.s + ego.footprint.half_lengths(box_kept),
            },
            held: Start::new(ego.speed, ego.accel),
            strip: (target.min(ego.d), target.max(ego.d)),
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
            .flat_map(|(place, (start, end))| {
                let pieces = future.extents_within(self.actor, start, end);
                pieces.filter_map(move |piece| self.beside(place, piece))
            })
            .any(|(from, to)| {
                self.first(motion, from, to, Stretch::first_contact)
                    .is_some()
            })
    }

    /// From when until when the actor overlaps the strip sideways while a piece across and one of its half extents hold.
    fn beside(&self, place: usize, (start, end, extent): (f64, f64, Extent)) -> Option<(f64, f64)> {
        let piece = &self.future.across[place];
        let d = piece.d + (start + self.future.now - piece.time) * piece.d_rate;
        let reach = half_widths(&self.ego, &extent, start);
        let from_right = Room {
            at_start: d - (self.strip.0 - reach),
            rate: piece.d_rate + extent.across_rate,
        };
        let from_left = Room {
            at_start: self.strip.1 + reach - d,
            rate: extent.across_rate - piece.d_rate,
        };
        let (from, to) = with_room([from_right, from_left], end - start)?;
        Some((start + from, start + to))
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
        let mut turn = self.swing.map_or(0, |swing| swing.index(from));
        let mut time = from;
        loop {
            let next = future.along.get(index + 1);
            let piece_end = next.map_or(f64::INFINITY, |next| next.time - now);
            let turn_end = self.swing.map_or(f64::INFINITY, |swing| swing.end(turn));
            let end = piece_end.min(turn_end).min(to);
            let centre = &future.along[index];
            let piece = self.swing.map_or(*centre, |swing| swing.rear(turn, centre));
            for (phase, phase_end) in motion.phases() {
                let (a, b): (f64, f64) = (phase.start.max(time), phase_end.min(end));
                if a <= b {
                    let found = find(&Stretch::new(a, b, &piece, self.datum, phase));
                    if let Some(x) = found {
                        return Some(a + x);
                    }
                }
            }
            if end >= to {
                return None;
            }
            index += usize::from(piece_end <= end);
            turn += usize::from(turn_end <= end);
            time = end.max(time);
        }
    }
}
