//! One ego and one future of one actor: what every candidate latency shares, and what happens to one of them.
//!
//! "No collision during t_n" is read as no pass-through (reading R6): `d(t) <= s(t)` at every conflict time in [0,
//! t_n] at which the bodies overlap sideways.

use super::conflict::{Corridor, Span, Spans, Zone};
use super::recording::AlongBlock;
use super::stretch::{Datum, Margins, Outline, Stretch};
use super::walk::{Bounds, Cell};
use crate::Params;
use crate::constraints::{TOLERANCE, distance_slack, speed_slack};
use crate::ego_motion::{EgoMotion, Phase, braking_decel};
use zhuyi_core::Along;

/// One ego before one future of one actor.
#[derive(Clone, Debug)]
pub(crate) struct Encounter<'a> {
    pub corridor: &'a Corridor<'a>,
    pub margins: Margins,
    /// [m/s2] a_b.
    pub decel: f64,
    pub datum: Datum,
    spans: Spans,
}

impl<'a> Encounter<'a> {
    /// `None` where there is no conflict time.
    #[inline]
    pub fn new(params: &Params, corridor: &'a Corridor<'a>) -> Option<Self> {
        let future = &corridor.view.future;
        if future.along.is_empty() || future.across.is_empty() {
            return None;
        }
        Some(Self {
            spans: Spans::new(corridor)?,
            margins: Margins {
                c1: params.c1,
                c2: params.c2,
            },
            decel: braking_decel(corridor.held.accel, params.c3, params.c4),
            datum: Datum {
                now: future.now,
                origin: corridor.ego + corridor.lines.reach,
            },
            corridor,
        })
    }

    /// The zones of [0, horizon], in order.
    pub fn spans(&self) -> impl Iterator<Item = Span> {
        self.spans.iter(self.corridor)
    }

    /// Whether any kept stay of the actor in the corridor begins with the bodies overlapping lengthwise (reading
    /// R8).
    pub fn abreast(&self) -> bool {
        self.spans().any(|span| span.abreast)
    }

    /// Whether braking is at least as hard as what the ego does anyway, so that to react earlier is never worse.
    pub fn earlier_is_better(&self) -> bool {
        self.decel >= -self.corridor.held.accel
    }

    /// A reaction time with the motion that follows from it.
    pub fn candidate(&self, delay: Delay) -> Candidate {
        let motion = EgoMotion::new(self.corridor.held, delay.reaction_time, self.decel);
        Candidate {
            reaction_time: delay.reaction_time,
            motion: motion.with_head_start(delay.head_start),
        }
    }

    /// The first time in [from, to] at which the ego's front passes the actor's rear while the bodies overlap
    /// sideways.
    pub fn first_contact(&self, candidate: &Candidate, from: f64, to: f64) -> Option<f64> {
        let ask = Ask {
            contact: true,
            met: false,
        };
        for span in self.spans() {
            if span.start > to {
                break;
            }
            if let (Zone::Overlap, Some((a, b))) = (span.zone, overlap(&span, from, to)) {
                let contact = self.first_event(ask, candidate, a, b);
                if contact.is_some() {
                    return contact;
                }
            }
        }
        None
    }

    /// Gap s and the actor's speed v_a at a time.
    pub fn actor(&self, time: f64) -> (f64, f64) {
        let future = &self.corridor.view.future;
        let index = self.corridor.view.along_index(time);
        let (piece, at) = (&future.along[index], time + future.now);
        let rear = piece.s_at(at) - self.corridor.half_along(time);
        (rear - self.datum.origin, piece.v_at(at))
    }

    /// Whether a candidate meets both constraints at the end of the horizon, contact or not.
    pub fn meets_at_end(&self, candidate: &Candidate) -> bool {
        let (future, end) = (&self.corridor.view.future, self.corridor.horizon);
        // As in the walk, the end belongs to the piece that leads up to it.
        let before = |piece: &Along| piece.time - future.now < end;
        let index = future.along.partition_point(before).saturating_sub(1);
        let (piece, at) = (&future.along[index], end + future.now);
        let half = (self.corridor.swing).map_or(0.0, |swing| swing.before(end).along);
        let (gap, actor_speed) = (piece.s_at(at) - half - self.datum.origin, piece.v_at(at));
        let (phase, _) = candidate.motion.phase_and_end(end);
        let Margins { c1, c2 } = self.margins;
        distance_slack(c1, gap, phase.distance_at(end)) >= -TOLERANCE
            && speed_slack(c2, actor_speed, phase.speed_at(end)) >= -TOLERANCE
    }

    /// What happens first to a candidate on a cell.
    #[inline]
    pub fn verdict(
        &self,
        ask: Ask,
        candidate: &Candidate,
        cell: &Cell<'_, Along>,
        bounds: &Bounds,
    ) -> Verdict {
        let motion = &candidate.motion;
        let mut place = motion.place(cell.start);
        while let Some((phase, end)) = motion.phase_at(place) {
            let a = if phase.start > cell.start {
                phase.start
            } else {
                cell.start
            };
            let b = if end < cell.end { end } else { cell.end };
            // The end of a cell belongs to the next one, if there is one.
            let over = a >= cell.end && cell.start < cell.end && cell.end < self.corridor.horizon;
            if a > b || over {
                break;
            }
            place += 1;
            // The ego never goes back, and never gets faster once it has reacted.
            let near = ask.contact && phase.distance_at(b) > bounds.nearest;
            let apt = ask.met
                && phase.start >= candidate.reaction_time
                && phase.speed_at(b) <= bounds.fastest
                && phase.distance_at(a) <= bounds.furthest;
            if !near && !apt {
                continue;
            }
            let stretch = Stretch::new(a, b, cell.piece, self.datum, phase);
            let contact = if near { stretch.first_contact() } else { None };
            let met = if apt {
                stretch.first_met(self.margins, contact.unwrap_or(stretch.length))
            } else {
                None
            };
            match (met, contact) {
                (Some(x), _) => return Verdict::Met(a + x),
                (None, Some(x)) => return Verdict::Contact(a + x),
                (None, None) => {}
            }
        }
        Verdict::Nothing
    }

    /// Whether for sure nothing happens to a candidate on a block.
    pub fn is_idle(&self, ask: Ask, candidate: &Candidate, block: &Cell<'_, AlongBlock>) -> bool {
        self.outlines(ask, candidate, block)
            .all(|(_, outline, reacted)| {
                (!ask.contact || outline.first_contact().is_none())
                    && (!reacted || outline.first_met(self.margins).is_none())
            })
    }

    /// Until when [s] for sure nothing happens to a candidate on a block, at most its end.
    pub fn idle_until(&self, ask: Ask, candidate: &Candidate, block: &Cell<'_, AlongBlock>) -> f64 {
        for (start, outline, reacted) in self.outlines(ask, candidate, block) {
            let contact = ask.contact.then(|| outline.first_contact()).flatten();
            let met = reacted.then(|| outline.first_met(self.margins)).flatten();
            if contact.is_some() || met.is_some() {
                let first = |event: Option<f64>| event.unwrap_or(f64::INFINITY);
                return start + first(contact).min(first(met));
            }
        }
        block.end
    }

    /// A block as each phase of a candidate meets it: from when on, its outline, and whether the candidate has reacted and is asked for
    /// the constraints.
    #[inline]
    fn outlines(
        &self,
        ask: Ask,
        candidate: &Candidate,
        block: &Cell<'_, AlongBlock>,
    ) -> impl Iterator<Item = (f64, Outline, bool)> {
        let kept = self.corridor.kept_of_blocks.length / 2.0;
        let datum = Datum {
            origin: self.datum.origin - kept,
            ..self.datum
        };
        parts(&candidate.motion, block.start, block.end).map(move |(phase, a, b)| {
            let reacted = ask.met && phase.start >= candidate.reaction_time;
            (a, Outline::new(a, b, block.piece, datum, phase), reacted)
        })
    }
}

/// What a latency costs: the more the larger it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Delay {
    /// [s] t_r.
    pub reaction_time: f64,
    /// [m] by which the ego counts as further than it is.
    pub head_start: f64,
}

/// A reaction time, and the ego's motion at it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub reaction_time: f64,
    pub motion: EgoMotion,
}

/// What is asked of a candidate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ask {
    /// When its front passes the actor's rear.
    pub contact: bool,
    /// When it meets both constraints, having reacted.
    pub met: bool,
}

/// What a piece means for a candidate, and when.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    Nothing,
    Met(f64),
    Contact(f64),
}

/// The parts of [from, to] in which the ego keeps to one phase, in order.
#[inline]
pub(crate) fn parts(
    motion: &EgoMotion,
    from: f64,
    to: f64,
) -> impl Iterator<Item = (&Phase, f64, f64)> {
    motion.phases().into_iter().filter_map(move |(phase, end)| {
        let (a, b) = (phase.start.max(from), end.min(to));
        (a <= b).then_some((phase, a, b))
    })
}

/// The part of a span within [from, to].
pub(crate) fn overlap(span: &Span, from: f64, to: f64) -> Option<(f64, f64)> {
    let (a, b) = (span.start.max(from), span.end.min(to));
    (a <= b).then_some((a, b))
}
