//! The solver `exact`: the largest candidate with a t_n, in continuous time, in one walk (readings R5, R6, R8, R9).
//!
//! It walks along the pieces of the actor's future once, for all candidates together. On each piece the first
//! instant that meets both constraints and the first of contact are roots of quadratics, and whichever comes first
//! decides. What a piece asks for depends on its zone:
//!
//! | zone | t_n may lie here if | contact ends the search |
//! |---|---|---|
//! | before the first conflict | Eq. 1 and 2 hold | no |
//! | conflict, not yet overlapping sideways | Eq. 1 and 2 hold | no |
//! | conflict, overlapping sideways | Eq. 1 and 2 hold | yes |
//! | after, outside the corridor or in a stay that is dropped | there is no contact in the whole of [0, horizon] | no |
//!
//! Law: with `a_b >= -a_0` (always so for C4 >= 1) an ego that reacts earlier is at no time further or faster. So of
//! candidates in order of falling reaction time, at any moment of the walk
//!
//! ```text
//!   0 .. alive    alive .. best       best ..
//!   in contact    neither as yet      have their t_n
//! ```
//!
//! and a piece is of interest only if it moves one of the two borders: if the candidate just before `best` meets the
//! constraints on it, or if `alive` comes into contact. Only then are the candidates between looked through,
//! with growing strides from the border. The walk ends when the borders meet.

use std::ops::Range;

use zhuyi_core::Along;

use super::conflict::{Span, Zone};
use super::encounter::{Ask, Candidate, Encounter, Verdict, overlap};
use super::recording::AlongBlock;
use super::walk::{Bounds, Cell, Leash, Visitor};
use crate::Criterion;

/// The candidate that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    /// Its place in the list, behind all where none will do.
    pub index: usize,
    /// [s] its t_n; the criterion `standstill` has none.
    pub t_n: Option<f64>,
    /// [s] until when the one before it is known not to meet the constraints, contact or not.
    pub unmet_until: f64,
    /// How often a candidate was looked at on a piece.
    pub evaluations: u32,
}

impl Found {
    /// One of which no more is known than that it is the first.
    pub fn known(index: usize) -> Self {
        Self {
            index,
            t_n: None,
            unmet_until: 0.0,
            evaluations: 0,
        }
    }
}

/// The first candidate of a range (not empty), of candidates in order of falling reaction time, that is tolerable; the
/// end of the range if none is. What follows a tolerable one must be tolerable.
pub(crate) fn first_tolerable<F: Fn(usize) -> Candidate>(
    encounter: &Encounter<'_>,
    criterion: Criterion,
    range: Range<usize>,
    candidate: F,
) -> Found {
    let mut search = Search {
        encounter,
        ask: Ask {
            contact: false,
            met: criterion == Criterion::Paper,
        },
        alive: range.start,
        best: range.end,
        t_n: None,
        back: candidate(range.start),
        front: candidate(range.end - 1),
        candidate,
        evaluations: 0,
    };
    let (mut outside_until, mut settled) = (None, None);
    for span in encounter.spans() {
        search.ask.contact = span.zone == Zone::Overlap;
        if span.zone == Zone::After {
            outside_until = Some(span.end);
        } else if search.ask.contact || search.ask.met {
            settled = encounter.visit(span.start, span.end, &mut search);
            if settled.is_some() {
                break;
            }
        }
    }
    let inside = Found {
        index: search.best,
        t_n: None,
        unmet_until: settled.unwrap_or(encounter.corridor.horizon),
        evaluations: search.evaluations,
    };
    if criterion == Criterion::Standstill {
        return Found {
            index: search.alive,
            ..inside
        };
    }
    search.outside(outside_until).unwrap_or_else(|| Found {
        t_n: search.first_time(outside_until),
        ..inside
    })
}

/// The same of `count` candidates (at least one), sooner where the answer is `guess`.
pub(crate) fn first_tolerable_near<F: Fn(usize) -> Candidate>(
    encounter: &Encounter<'_>,
    criterion: Criterion,
    count: usize,
    candidate: F,
    guess: usize,
) -> Found {
    let search = |range| first_tolerable(encounter, criterion, range, &candidate);
    let (start, end) = (
        guess.saturating_sub(1).min(count - 1),
        (guess + 1).min(count),
    );
    let near = search(start..end);
    let (further, unmet_until) = if near.index == start && start > 0 {
        let before = search(0..start);
        (before, before.unmet_until)
    } else if near.index == end && end < count {
        (search(end..count), near.unmet_until)
    } else {
        return near;
    };
    let evaluations = near.evaluations + further.evaluations;
    // Where there is nothing further on, the answer lies at the border between both ranges.
    if further.index == near.index {
        let t_n = near.t_n.or(further.t_n);
        return Found {
            t_n,
            unmet_until,
            evaluations,
            ..near
        };
    }
    Found {
        evaluations,
        ..further
    }
}

/// The search under way: the borders, and the candidates on their sides that may move them.
struct Search<'e, 'a, F> {
    encounter: &'e Encounter<'a>,
    /// What matters in this zone.
    ask: Ask,
    candidate: F,
    alive: usize,
    best: usize,
    /// Of candidate `best`.
    t_n: Option<f64>,
    /// Candidate `alive`.
    back: Candidate,
    /// Candidate `best - 1`.
    front: Candidate,
    evaluations: u32,
}

/// [1/s] about how many candidates a border passes in a second of a walk: only to look first where it may be.
const PASSED_PER_SECOND: f64 = 8.0;

impl<F: Fn(usize) -> Candidate> Visitor for Search<'_, '_, F> {
    /// [s] until when the front did not meet the constraints when the borders met.
    type Found = f64;

    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool {
        // Where the back is clear, so is the front.
        let (met, contact) = (self.asks_met(), self.asks_contact());
        (!self.ask.met || self.encounter.is_idle(met, &self.front, block))
            && (!self.ask.contact || self.encounter.is_idle(contact, &self.back, block))
    }

    fn idle_until(&self, block: &Cell<'_, AlongBlock>) -> f64 {
        // Where the back is clear, so is the front.
        let mut until = block.end;
        if self.ask.met {
            let met = self.asks_met();
            until = self.encounter.idle_until(met, &self.front, block);
        }
        if self.ask.contact && until > block.start {
            let (contact, rest) = (
                self.asks_contact(),
                Cell {
                    end: until,
                    ..*block
                },
            );
            until = self.encounter.idle_until(contact, &self.back, &rest);
        }
        until
    }

    fn leash(&self, time: f64) -> Leash {
        Leash::new(self.ask, &self.back, &self.front, time)
    }

    #[inline]
    fn visit(&mut self, cell: &Cell<'_, Along>, bounds: &Bounds) -> Option<f64> {
        self.evaluations += 1;
        let front = match self.encounter.verdict(self.ask, &self.front, cell, bounds) {
            Verdict::Met(time) => self.lower_best(cell, bounds, time),
            verdict => verdict,
        };
        if self.alive == self.best {
            // When the candidate before these came into contact is not kept.
            return Some(0.0);
        }
        if let Verdict::Contact(time) = front {
            self.alive = self.best;
            return Some(time);
        }
        // With one candidate left between the borders, the back is the front.
        let (back, more) = (self.back, self.alive + 1 < self.best);
        if self.ask.contact && more && self.touches(&back, cell, bounds) {
            self.raise_alive(cell, bounds);
        }
        (self.alive == self.best).then_some(cell.start)
    }
}

impl<F: Fn(usize) -> Candidate> Search<'_, '_, F> {
    fn asks_met(&self) -> Ask {
        Ask {
            contact: false,
            ..self.ask
        }
    }

    fn asks_contact(&self) -> Ask {
        Ask {
            met: false,
            ..self.ask
        }
    }

    /// Whether a candidate comes into contact on a cell on which it does not meet the constraints.
    #[inline]
    fn touches(&mut self, candidate: &Candidate, cell: &Cell<'_, Along>, bounds: &Bounds) -> bool {
        self.evaluations += 1;
        let contact = self.asks_contact();
        self.encounter.verdict(contact, candidate, cell, bounds) != Verdict::Nothing
    }

    /// The front meets the constraints on this cell at `time`: so may others behind it. What happens to the new front.
    fn lower_best(&mut self, cell: &Cell<'_, Along>, bounds: &Bounds, time: f64) -> Verdict {
        let (mut low, mut front) = (self.alive, Verdict::Nothing);
        let mut stride = stride(cell);
        (self.best, self.t_n) = (self.best - 1, Some(time));
        while low < self.best {
            let next = self.best - 1 - (stride - 1).min((self.best - low) / 2);
            let candidate = if next == self.alive {
                self.back
            } else {
                (self.candidate)(next)
            };
            self.evaluations += 1;
            match self.encounter.verdict(self.ask, &candidate, cell, bounds) {
                Verdict::Met(time) => {
                    (self.best, self.t_n) = (next, Some(time));
                    stride *= 2;
                }
                verdict => {
                    (self.front, front) = (candidate, verdict);
                    low = next + 1;
                }
            }
        }
        front
    }

    /// The back comes into contact on this cell: so may others before it.
    fn raise_alive(&mut self, cell: &Cell<'_, Along>, bounds: &Bounds) {
        self.alive += 1;
        let (mut high, mut stride) = (self.best, stride(cell));
        while self.alive < high {
            let next = self.alive + (stride - 1).min((high - self.alive) / 2);
            let candidate = (self.candidate)(next);
            if self.touches(&candidate, cell, bounds) {
                self.alive = next + 1;
                stride *= 2;
            } else {
                high = next;
                self.back = candidate;
            }
        }
    }

    /// The first candidate that touches nobody in the whole horizon and has reacted while the actor is outside the
    /// corridor after a conflict, which it is for the last time until `outside_until`.
    fn outside(&self, outside_until: Option<f64>) -> Option<Found> {
        let until = outside_until?;
        let index = (self.alive..self.best)
            .find(|index| (self.candidate)(*index).reaction_time <= until)?;
        Some(Found {
            index,
            t_n: self.first_outside((self.candidate)(index).reaction_time),
            unmet_until: 0.0,
            evaluations: self.evaluations,
        })
    }

    /// The t_n of candidate `best`, if there is one; `outside_until` as above.
    fn first_time(&self, outside_until: Option<f64>) -> Option<f64> {
        let met = self.t_n?;
        if outside_until.is_none() {
            return Some(met);
        }
        let candidate = (self.candidate)(self.best);
        // A time outside the corridor before that counts if no contact comes later either.
        let earlier = self
            .first_outside(candidate.reaction_time)
            .filter(|time| *time < met);
        let horizon = self.encounter.corridor.horizon;
        let clear = || {
            self.encounter
                .first_contact(&candidate, met, horizon)
                .is_none()
        };
        Some(earlier.filter(|_| clear()).unwrap_or(met))
    }

    /// The first time from `from` on at which the actor is outside the corridor after a conflict.
    fn first_outside(&self, from: f64) -> Option<f64> {
        let horizon = self.encounter.corridor.horizon;
        let after =
            |span: Span| (span.zone == Zone::After).then(|| overlap(&span, from, horizon))?;
        self.encounter.spans().find_map(after).map(|(time, _)| time)
    }
}

/// How many candidates a border may pass on a cell.
fn stride(cell: &Cell<'_, Along>) -> usize {
    1 + ((cell.end - cell.start) * PASSED_PER_SECOND) as usize
}
