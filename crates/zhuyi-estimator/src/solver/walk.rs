//! The walk along the pieces of a future, with everything that lets it pass over what cannot matter.
//!
//! A visitor is shown one piece after the other. Before that, two cheap looks: at a block of a recording as a whole
//! (its coarse view), and at the ends of a piece, where a [`Leash`] on the ego and [`Bounds`] on the actor mostly tell
//! that neither contact nor a time that meets the constraints lies between them. What they cannot rule out is looked
//! at, so the answer is that of the plain list.

use super::encounter::{Ask, Candidate, Encounter, Verdict, parts};
use super::recording::{ALONG_BLOCKS, AlongBlock};
use super::stretch::{Datum, Stretch};
use crate::constraints::TOLERANCE;
use crate::ego_motion::Phase;
use zhuyi_core::Along;
use zhuyi_core::quadratic::Quadratic;

/// Pieces in the finest blocks.
const FINEST: usize = ALONG_BLOCKS[ALONG_BLOCKS.len() - 1];

/// A time in which the actor keeps to one piece, or to one block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell<'a, P> {
    pub start: f64,
    pub end: f64,
    pub piece: &'a P,
}

/// Bounds on a cell, from its ends: of the gap, and of what the ego may have gone and drive to meet the constraints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// [m] least gap s: an ego that has gone no further is clear.
    pub nearest: f64,
    /// [m] C1 times the largest gap: beyond it Eq. 1 is unmet.
    pub furthest: f64,
    /// [m/s] C2 times the actor's largest speed: above it Eq. 2 is unmet.
    pub fastest: f64,
}

/// How far the ego has gone at most, and how far and how fast at least, while it keeps to its phases: polynomials in t
/// that hold up to a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leash {
    until: f64,
    /// Of the candidate that goes furthest.
    contact: Quadratic,
    /// Of the candidate that goes least far, once it has reacted.
    met: Quadratic,
}

impl Leash {
    /// Nobody may touch, and nobody has reacted.
    const SLACK: Self = Self {
        until: f64::INFINITY,
        contact: Quadratic {
            c0: f64::NEG_INFINITY,
            c1: 0.0,
            c2: 0.0,
        },
        met: Quadratic {
            c0: 0.0,
            c1: f64::INFINITY,
            c2: 0.0,
        },
    };

    /// Tells nothing.
    const NONE: Self = Self {
        until: f64::NEG_INFINITY,
        ..Self::SLACK
    };

    /// From `time` on, of the candidate that touches first and the one that meets the constraints first.
    #[inline]
    pub fn new(ask: Ask, touches: &Candidate, meets: &Candidate, time: f64) -> Self {
        let mut leash = Self::SLACK;
        if ask.contact {
            let (phase, end) = touches.motion.phase_and_end(time);
            (leash.contact, leash.until) = (phase.in_time(), end);
        }
        if ask.met {
            let (phase, end) = meets.motion.phase_and_end(time);
            if phase.start >= meets.reaction_time {
                leash.met = phase.in_time();
            }
            if end < leash.until {
                leash.until = end;
            }
        }
        leash
    }

    /// Whether it tells that nothing happens on a cell: the ego never goes back, and never gets faster once it has
    /// reacted.
    #[inline]
    fn rules_out(&self, cell: &Cell<'_, Along>, bounds: &Bounds) -> bool {
        cell.end < self.until
            && self.contact.at(cell.end) <= bounds.nearest
            && (self.met.c1 + 2.0 * self.met.c2 * cell.end > bounds.fastest
                || self.met.at(cell.start) > bounds.furthest)
    }
}

/// Who is taken along the pieces of a future.
pub(crate) trait Visitor {
    /// What ends the visit.
    type Found;

    /// Whether nothing on this block can matter.
    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool;

    /// Until when [s] nothing on this block can matter, at most its end.
    fn idle_until(&self, block: &Cell<'_, AlongBlock>) -> f64;

    /// What tells at once that nothing happens, from `time` on.
    fn leash(&self, time: f64) -> Leash;

    /// Looks at a piece.
    fn visit(&mut self, cell: &Cell<'_, Along>, bounds: &Bounds) -> Option<Self::Found>;
}

impl Encounter<'_> {
    /// Takes a visitor along the pieces of [from, to] in order until it finds something.
    #[inline]
    pub fn visit<V: Visitor>(&self, from: f64, to: f64, visitor: &mut V) -> Option<V::Found> {
        let future = &self.corridor.view.future;
        let (mut time, mut index) = (from, self.corridor.view.along_index(from));
        // Of a box that turns, the piece of its half extents.
        let swing = self.corridor.swing;
        let mut extent = swing.map_or(0, |swing| swing.index(from));
        let mut leash = visitor.leash(time);
        // Before this piece no block is to be tried again, and this one not as a whole.
        let (mut tried, mut whole) = (0, None);
        loop {
            if index >= tried {
                if let Some((end, behind)) = self.pass_over(index, time, to, visitor) {
                    if end >= to {
                        return None;
                    }
                    (time, index) = (end, behind);
                    extent = swing.map_or(0, |swing| swing.index(end));
                    continue;
                }
                tried = (index / FINEST + 1) * FINEST;
            }
            if let Some(swing) = swing
                && whole != Some(index)
                && let Some((until, end)) = self.pass_over_piece(index, time, to, visitor)
            {
                if until >= end {
                    if end >= to {
                        return None;
                    }
                    (time, index, extent) = (end, index + 1, swing.index(end));
                    continue;
                }
                // On with the piece of the half extents on which something may matter.
                extent = swing.index(until);
                time = time.max(swing.start(extent));
            }
            whole = Some(index);
            let next = future.along.get(index + 1);
            let piece_end = next.map_or(f64::INFINITY, |next| next.time - future.now);
            let (mut end, turning) = (
                piece_end,
                swing.map(|swing| swing.rear(extent, &future.along[index])),
            );
            if let Some(swing) = swing
                && swing.end(extent) < end
            {
                (end, extent) = (swing.end(extent), extent + 1);
            }
            if end > time || time >= to {
                let cell = Cell {
                    start: time,
                    end: if end < to { end } else { to },
                    piece: turning.as_ref().unwrap_or(&future.along[index]),
                };
                let bounds = self.bounds(&cell);
                let may_matter = !leash.rules_out(&cell, &bounds);
                if may_matter && let Some(found) = visitor.visit(&cell, &bounds) {
                    return Some(found);
                }
                if end >= to {
                    return None;
                }
                if may_matter {
                    leash = visitor.leash(end);
                }
                time = end;
            }
            if end >= piece_end {
                index += 1;
            }
        }
    }

    /// What the ends of a cell tell of all of it.
    #[inline]
    fn bounds(&self, cell: &Cell<'_, Along>) -> Bounds {
        let (piece, Datum { now, origin }) = (cell.piece, self.datum);
        let (x, y) = (cell.start + now - piece.time, cell.end + now - piece.time);
        let at = |x: f64| {
            let s = piece.s + x * (piece.s_rate + x * piece.s_half_accel);
            (s, piece.v + x * piece.v_rate)
        };
        let (here, there) = (at(x), at(y));
        let (mut low, mut high) = if here.0 < there.0 {
            (here.0, there.0)
        } else {
            (there.0, here.0)
        };
        // A parabola strays from its chord by at most this: to below if it opens upwards, else to above.
        let bulge = || piece.s_half_accel * ((y - x) * (y - x) / 4.0);
        if piece.s_half_accel > 0.0 {
            low -= bulge();
        } else if piece.s_half_accel < 0.0 {
            high -= bulge();
        }
        let fastest = if here.1 > there.1 { here.1 } else { there.1 };
        let forward = if fastest > 0.0 { fastest } else { 0.0 };
        Bounds {
            nearest: low - origin,
            furthest: self.margins.c1 * (high - origin) + 2.0 * TOLERANCE,
            fastest: self.margins.c2 * forward + 2.0 * TOLERANCE,
        }
    }

    /// Until when nothing matters on a piece from `start` on, however the box turns on it, and the end of the piece; none where
    /// it has no block.
    fn pass_over_piece(
        &self,
        index: usize,
        start: f64,
        to: f64,
        visitor: &impl Visitor,
    ) -> Option<(f64, f64)> {
        let coarse = self.corridor.view.coarse?;
        let block = coarse.turning_pieces.get(index)?.as_ref()?;
        let end = (block.end - self.datum.now).min(to);
        let cell = Cell {
            start,
            end,
            piece: block,
        };
        let begun = block.fit.time <= start + self.datum.now;
        begun.then(|| (visitor.idle_until(&cell), end))
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
        let (now, coarse) = (self.datum.now, self.corridor.view.coarse?);
        for (blocks, size) in coarse.along.iter().zip(ALONG_BLOCKS) {
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

    /// When in [from, to] a candidate first comes to what is asked for.
    pub fn first_event(&self, ask: Ask, candidate: &Candidate, from: f64, to: f64) -> Option<f64> {
        let mut single = Single {
            encounter: self,
            ask,
            candidate,
        };
        self.visit(from, to, &mut single)
    }

    /// Whether a candidate is ever slow enough (Eq. 2) in [from, to].
    pub fn ever_slow_enough(&self, candidate: &Candidate, from: f64, to: f64) -> bool {
        let mut slow = Slow {
            encounter: self,
            candidate,
        };
        self.visit(from, to, &mut slow).is_some()
    }
}

/// Looks for the first event of one candidate.
struct Single<'e, 'a> {
    encounter: &'e Encounter<'a>,
    ask: Ask,
    candidate: &'e Candidate,
}

impl Visitor for Single<'_, '_> {
    type Found = f64;

    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool {
        self.encounter.is_idle(self.ask, self.candidate, block)
    }

    fn idle_until(&self, block: &Cell<'_, AlongBlock>) -> f64 {
        self.encounter.idle_until(self.ask, self.candidate, block)
    }

    fn leash(&self, time: f64) -> Leash {
        Leash::new(self.ask, self.candidate, self.candidate, time)
    }

    fn visit(&mut self, cell: &Cell<'_, Along>, bounds: &Bounds) -> Option<f64> {
        match self
            .encounter
            .verdict(self.ask, self.candidate, cell, bounds)
        {
            Verdict::Nothing => None,
            Verdict::Met(time) | Verdict::Contact(time) => Some(time),
        }
    }
}

/// Looks for a time at which one candidate is slow enough.
struct Slow<'e, 'a> {
    encounter: &'e Encounter<'a>,
    candidate: &'e Candidate,
}

impl Visitor for Slow<'_, '_> {
    type Found = ();

    fn passes_over(&self, _: &Cell<'_, AlongBlock>) -> bool {
        false
    }

    fn idle_until(&self, block: &Cell<'_, AlongBlock>) -> f64 {
        block.start
    }

    fn leash(&self, _: f64) -> Leash {
        Leash::NONE
    }

    fn visit(&mut self, cell: &Cell<'_, Along>, _: &Bounds) -> Option<()> {
        let Encounter { datum, margins, .. } = self.encounter;
        let slow = |(phase, a, b): (&Phase, f64, f64)| {
            Stretch::new(a, b, cell.piece, *datum, phase).ever_slow_enough(*margins)
        };
        parts(&self.candidate.motion, cell.start, cell.end)
            .any(slow)
            .then_some(())
    }
}
