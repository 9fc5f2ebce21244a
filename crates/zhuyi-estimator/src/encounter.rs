//! One ego and one future of one actor: what every candidate latency shares, and the walk along it in time.
//!
//! "No collision during t_n" is read as no pass-through (reading R6): `d(t) <= s(t)` at every conflict time in [0,
//! t_n] at which the bodies overlap sideways. While a_0 is held the ego's motion is the same for every latency, so
//! contact before t_r is looked for once, up to the longest reaction.

use crate::conflict::{Corridor, Span, Spans, Zone};
use crate::ego_motion::{EgoMotion, Phase, Start, braking_decel};
use crate::recording::{ALONG_BLOCKS, View};
use crate::stretch::{Datum, Margins, Outline, Stretch};
use crate::{Ego, Params};
use zhuyi_core::Footprint;

/// Pieces in the finest blocks.
const FINEST: usize = ALONG_BLOCKS[ALONG_BLOCKS.len() - 1];

/// One ego before one future of one actor.
#[derive(Clone, Debug)]
pub(crate) struct Encounter<'a> {
    pub start: Start,
    pub decel: f64,
    pub horizon: f64,
    pub margins: Margins,
    pub spans: Spans<'a>,
    view: View<'a>,
    datum: Datum,
    held_contact: Option<f64>,
}

impl<'a> Encounter<'a> {
    /// `None` where there is no conflict time; contact while holding is looked for up to `longest_reaction`.
    pub fn new(
        params: &Params,
        ego: &Ego,
        actor: Footprint,
        view: View<'a>,
        longest_reaction: f64,
    ) -> Option<Self> {
        if view.future.along.is_empty() || view.future.across.is_empty() {
            return None;
        }
        let start = Start::new(ego.speed, ego.accel);
        let held = EgoMotion::held(start);
        let boxes = (ego.footprint, actor);
        let corridor = Corridor::new(
            view,
            held,
            (ego.s, ego.d),
            boxes,
            params.lateral_margin,
            params.horizon,
        );
        let spans = Spans::new(corridor);
        if !spans.any() {
            return None;
        }
        let mut encounter = Self {
            start,
            decel: braking_decel(start.accel, params.c3, params.c4),
            horizon: params.horizon,
            margins: Margins {
                c1: params.c1,
                c2: params.c2,
            },
            spans,
            view,
            datum: Datum {
                now: view.future.now,
                origin: ego.s + corridor.half.0,
            },
            held_contact: None,
        };
        encounter.held_contact =
            encounter.first_contact(&held, 0.0, longest_reaction.min(params.horizon));
        Some(encounter)
    }

    /// The ego's motion at a reaction time; `None` when it touches the actor before it reacts.
    pub fn reaction(&self, reaction_time: f64) -> Option<EgoMotion> {
        let touches = self
            .held_contact
            .is_some_and(|contact| contact < reaction_time);
        (!touches).then(|| self.motion(reaction_time))
    }

    /// The same, whatever it touches.
    pub fn motion(&self, reaction_time: f64) -> EgoMotion {
        EgoMotion::new(self.start, reaction_time, self.decel)
    }

    /// Whether any kept stay of the actor in the corridor begins with the bodies overlapping lengthwise (reading
    /// R8).
    pub fn abreast(&self) -> bool {
        self.spans.iter().any(|span| span.abreast)
    }

    /// Whether braking is at least as hard as what the ego does anyway, so that to react earlier is never worse.
    pub fn earlier_is_better(&self) -> bool {
        self.decel >= -self.start.accel
    }

    /// The first time in [from, to] at which the ego's front passes the actor's rear while the bodies overlap
    /// sideways.
    pub fn first_contact(&self, motion: &EgoMotion, from: f64, to: f64) -> Option<f64> {
        for span in self.spans.iter() {
            if span.start > to {
                break;
            }
            if let (Zone::Overlap, Some((a, b))) = (span.zone, overlap(&span, from, to)) {
                let visit = |stretch: &Stretch| stretch.first_contact().map(|x| stretch.start + x);
                let contact = self.walk(motion, a, b, Outline::is_clear, visit);
                if contact.is_some() {
                    return contact;
                }
            }
        }
        None
    }

    /// Gap s and the actor's speed v_a at a time.
    pub fn actor(&self, time: f64) -> (f64, f64) {
        let future = &self.view.future;
        let (piece, at) = (&future.along[future.along_index(time)], time + future.now);
        (piece.s_at(at) - self.datum.origin, piece.v_at(at))
    }

    /// Visits the stretches of [from, to] in order until `visit` finds something; passes over what `skip` says
    /// cannot matter.
    #[inline]
    pub fn walk<T>(
        &self,
        motion: &EgoMotion,
        from: f64,
        to: f64,
        skip: impl Fn(&Outline) -> bool,
        visit: impl Fn(&Stretch) -> Option<T>,
    ) -> Option<T> {
        let future = &self.view.future;
        let mut index = future.along_index(from);
        if from >= to {
            return visit(&self.stretch(index, motion.phase(from), from, from));
        }
        let mut time = from;
        for (phase, phase_end) in motion.phases() {
            let until = phase_end.min(to);
            // Before this piece no block is to be tried again.
            let mut tried = 0;
            while time < until {
                if index >= tried {
                    if let Some((end, next)) = self.pass_over(index, phase, (time, until), &skip) {
                        (time, index) = (end, next);
                        continue;
                    }
                    tried = (index / FINEST + 1) * FINEST;
                }
                let piece_end = future
                    .along
                    .get(index + 1)
                    .map_or(f64::INFINITY, |next| next.time - future.now);
                let end = piece_end.min(until);
                if end > time {
                    if let Some(found) = visit(&self.stretch(index, phase, time, end)) {
                        return Some(found);
                    }
                    time = end;
                }
                if piece_end <= until {
                    index += 1;
                }
            }
        }
        None
    }

    /// Where the search may go on if all that is left of a block in [start, until] cannot matter: a time and a
    /// piece.
    #[inline]
    fn pass_over(
        &self,
        index: usize,
        phase: &Phase,
        (start, until): (f64, f64),
        skip: impl Fn(&Outline) -> bool,
    ) -> Option<(f64, usize)> {
        let now = self.datum.now;
        for (blocks, size) in self.view.along.iter().zip(ALONG_BLOCKS) {
            let Some(block) = blocks.get(index / size) else {
                continue;
            };
            // Before the list begins its first piece is extended backwards, the block is not.
            let begun = block.fit.time <= start + now;
            let end = (block.end - now).min(until);
            if begun && skip(&Outline::new(start, end, block, self.datum, phase)) {
                let behind = (index / size + 1) * size;
                let next = if end < until {
                    behind
                } else {
                    self.view.future.along_index(end)
                };
                return Some((end, next));
            }
        }
        None
    }

    #[inline]
    fn stretch(&self, index: usize, phase: &Phase, start: f64, end: f64) -> Stretch {
        Stretch::new(
            start,
            end,
            &self.view.future.along[index],
            self.datum,
            phase,
        )
    }
}

/// The part of a span within [from, to].
pub(crate) fn overlap(span: &Span, from: f64, to: f64) -> Option<(f64, f64)> {
    let (a, b) = (span.start.max(from), span.end.min(to));
    (a <= b).then_some((a, b))
}
