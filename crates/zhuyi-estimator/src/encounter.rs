//! One ego and one future of one actor: what every candidate latency shares, and the walk along it in time.
//!
//! "No collision during t_n" is read as no pass-through (reading R6): `d(t) <= s(t)` at every conflict time in [0,
//! t_n] at which the bodies overlap sideways.

use crate::conflict::{Corridor, Span, Spans, Zone};
use crate::ego_motion::{EgoMotion, Phase, braking_decel};
use crate::recording::{ALONG_BLOCKS, AlongBlock, View};
use crate::stretch::{Datum, Margins, Outline, Stretch};
use crate::{Ego, Params};
use zhuyi_core::{Along, Footprint};

/// Pieces in the finest blocks.
const FINEST: usize = ALONG_BLOCKS[ALONG_BLOCKS.len() - 1];

/// One ego before one future of one actor.
#[derive(Clone, Debug)]
pub(crate) struct Encounter<'a> {
    pub corridor: Corridor<'a>,
    pub margins: Margins,
    spans: Spans,
    decel: f64,
    datum: Datum,
}

impl<'a> Encounter<'a> {
    /// `None` where there is no conflict time.
    #[inline]
    pub fn new(params: &Params, ego: &Ego, actor: Footprint, view: View<'a>) -> Option<Self> {
        if view.future.along.is_empty() || view.future.across.is_empty() {
            return None;
        }
        let corridor = Corridor::new(params, ego, actor, view);
        Some(Self {
            spans: Spans::new(&corridor)?,
            margins: Margins {
                c1: params.c1,
                c2: params.c2,
            },
            decel: braking_decel(corridor.held.accel, params.c3, params.c4),
            datum: Datum {
                now: view.future.now,
                origin: ego.s + corridor.reach,
            },
            corridor,
        })
    }

    /// The ego's motion at a reaction time.
    pub fn motion(&self, reaction_time: f64) -> EgoMotion {
        EgoMotion::new(self.corridor.held, reaction_time, self.decel)
    }

    /// The zones of [0, horizon], in order.
    pub fn spans(&self) -> impl Iterator<Item = Span> {
        self.spans.iter(&self.corridor)
    }

    /// [m/s2] a_b.
    pub fn decel(&self) -> f64 {
        self.decel
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

    /// The first time in [from, to] at which the ego's front passes the actor's rear while the bodies overlap
    /// sideways.
    pub fn first_contact(&self, motion: &EgoMotion, from: f64, to: f64) -> Option<f64> {
        for span in self.spans() {
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
        let future = &self.corridor.view.future;
        let (piece, at) = (&future.along[future.along_index(time)], time + future.now);
        (piece.s_at(at) - self.datum.origin, piece.v_at(at))
    }

    /// Visits the stretches of [from, to] in order until `visit` finds something; passes over what `skip` says
    /// cannot matter.
    pub fn walk<T>(
        &self,
        motion: &EgoMotion,
        from: f64,
        to: f64,
        skip: impl Fn(&Outline) -> bool,
        visit: impl Fn(&Stretch) -> Option<T>,
    ) -> Option<T> {
        let mut walk = Walk {
            encounter: self,
            motion,
            skip,
            visit,
        };
        self.visit(from, to, &mut walk)
    }

    /// Takes a visitor along the pieces of [from, to] in order until it finds something.
    #[inline]
    pub fn visit<V: Visitor>(&self, from: f64, to: f64, visitor: &mut V) -> Option<V::Found> {
        let future = &self.corridor.view.future;
        let (mut time, mut index) = (from, future.along_index(from));
        // Before this piece no block is to be tried again.
        let mut tried = 0;
        loop {
            if index >= tried {
                if let Some((end, behind)) = self.pass_over(index, time, to, visitor) {
                    if end >= to {
                        return None;
                    }
                    (time, index) = (end, behind);
                    continue;
                }
                tried = (index / FINEST + 1) * FINEST;
            }
            let next = future.along.get(index + 1);
            let end = next.map_or(f64::INFINITY, |next| next.time - future.now);
            if end > time || time >= to {
                let cell = Cell {
                    start: time,
                    end: end.min(to),
                    piece: &future.along[index],
                };
                if let Some(found) = visitor.visit(&cell) {
                    return Some(found);
                }
                if end >= to {
                    return None;
                }
                time = end;
            }
            index += 1;
        }
    }

    /// The end of a block of which nothing matters from `start` on, and the piece behind it.
    #[inline]
    fn pass_over(
        &self,
        index: usize,
        start: f64,
        to: f64,
        visitor: &impl Visitor,
    ) -> Option<(f64, usize)> {
        let now = self.datum.now;
        for (blocks, size) in self.corridor.view.along.iter().zip(ALONG_BLOCKS) {
            let Some(block) = blocks.get(index / size) else {
                continue;
            };
            // Before the list begins its first piece is extended backwards, the block is not.
            let begun = block.fit.time <= start + now;
            let cell = Cell {
                start,
                end: (block.end - now).min(to),
                piece: block,
            };
            if begun && visitor.passes_over(&cell) {
                return Some((block.end - now, (index / size + 1) * size));
            }
        }
        None
    }

    /// A part of a cell in one phase of the ego.
    #[inline]
    pub fn stretch(&self, cell: &Cell<'_, Along>, phase: &Phase, start: f64, end: f64) -> Stretch {
        Stretch::new(start, end, cell.piece, self.datum, phase)
    }

    /// What the ends of a cell tell of the actor on all of it.
    #[inline]
    pub fn bounds(&self, cell: &Cell<'_, Along>) -> Bounds {
        let (piece, now) = (cell.piece, self.datum.now);
        let length = cell.end - cell.start;
        let at = |time: f64| {
            (
                piece.s_at(time + now) - self.datum.origin,
                piece.v_at(time + now),
            )
        };
        let ((s, v), (next_s, next_v)) = (at(cell.start), at(cell.end));
        // How far a parabola strays from its chord at most.
        let bulge = piece.s_half_accel.abs() * length * length / 4.0;
        let (low, high) = if s < next_s { (s, next_s) } else { (next_s, s) };
        let fastest = if v > next_v { v } else { next_v };
        Bounds {
            nearest: low - bulge,
            furthest: high + bulge,
            fastest: if fastest > 0.0 { fastest } else { 0.0 },
        }
    }

    /// A part of a block in one phase of the ego.
    #[inline]
    pub fn outline(
        &self,
        cell: &Cell<'_, AlongBlock>,
        phase: &Phase,
        start: f64,
        end: f64,
    ) -> Outline {
        Outline::new(start, end, cell.piece, self.datum, phase)
    }
}

/// Who is taken along the pieces of a future.
pub(crate) trait Visitor {
    /// What ends the visit.
    type Found;

    /// Whether nothing on this block can matter.
    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool;

    /// Looks at a piece.
    fn visit(&mut self, cell: &Cell<'_, Along>) -> Option<Self::Found>;
}

/// A visitor with one motion of the ego, who looks at each stretch.
struct Walk<'e, 'a, S, V> {
    encounter: &'e Encounter<'a>,
    motion: &'e EgoMotion,
    skip: S,
    visit: V,
}

impl<T, S, V> Visitor for Walk<'_, '_, S, V>
where
    S: Fn(&Outline) -> bool,
    V: Fn(&Stretch) -> Option<T>,
{
    type Found = T;

    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool {
        parts(self.motion, block.start, block.end)
            .all(|(phase, a, b)| (self.skip)(&self.encounter.outline(block, phase, a, b)))
    }

    fn visit(&mut self, cell: &Cell<'_, Along>) -> Option<T> {
        parts(self.motion, cell.start, cell.end)
            .find_map(|(phase, a, b)| (self.visit)(&self.encounter.stretch(cell, phase, a, b)))
    }
}

/// Bounds of an actor's motion on a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// [m] least gap s.
    pub nearest: f64,
    /// [m] largest gap s.
    pub furthest: f64,
    /// [m/s] largest speed, at least zero.
    pub fastest: f64,
}

/// A time in which the actor keeps to one piece, or to one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell<'a, P> {
    pub start: f64,
    pub end: f64,
    pub piece: &'a P,
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
