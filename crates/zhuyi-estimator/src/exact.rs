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
//! | after, outside the corridor | there is no contact in the whole of [0, horizon] | no |
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
//! constraints on it, or if `alive` comes into contact. Only then are the candidates between looked through, by
//! bisection. The walk ends when the borders meet.

use zhuyi_core::Along;

use crate::Criterion;
use crate::conflict::{Span, Zone};
use crate::constraints::TOLERANCE;
use crate::ego_motion::EgoMotion;
use crate::encounter::{Cell, Encounter, Visitor, overlap, parts};
use crate::recording::AlongBlock;

/// A reaction time, and the ego's motion at it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub reaction_time: f64,
    pub motion: EgoMotion,
}

/// The candidate that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    /// Its place in the list.
    pub index: usize,
    /// [s] its t_n; the criterion `standstill` has none.
    pub t_n: Option<f64>,
}

/// What a piece means for a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    Nothing,
    Met(f64),
    Contact,
}

/// The first of `count` candidates, given in order of falling reaction time, that is tolerable; `None` if none is.
/// What follows a tolerable one must be tolerable. `guess` is where the answer is looked for first.
pub(crate) fn first_tolerable<F: Fn(usize) -> Candidate>(
    encounter: &Encounter<'_>,
    criterion: Criterion,
    count: usize,
    candidate: F,
    guess: usize,
) -> Option<Found> {
    let mut search = Search {
        encounter,
        criterion,
        touching: false,
        alive: 0,
        best: count,
        t_n: None,
        back: candidate(0),
        front: candidate(count.checked_sub(1)?),
        candidate,
        guess,
    };
    let mut outside_until = None;
    for span in encounter.spans() {
        search.touching = span.zone == Zone::Overlap;
        if span.zone == Zone::After {
            outside_until = Some(span.end);
        } else if search.touching || criterion == Criterion::Paper {
            let settled = encounter.visit(span.start, span.end, &mut search);
            if settled.is_some() {
                break;
            }
        }
    }
    match criterion {
        Criterion::Standstill => (search.alive < count).then_some(Found {
            index: search.alive,
            t_n: None,
        }),
        Criterion::Paper => search
            .outside(outside_until)
            .or_else(|| search.inside(count)),
    }
}

/// The search under way: the borders, and the candidates on their sides that may move them.
struct Search<'e, 'a, F> {
    encounter: &'e Encounter<'a>,
    criterion: Criterion,
    candidate: F,
    guess: usize,
    /// The bodies overlap sideways.
    touching: bool,
    alive: usize,
    best: usize,
    /// Of candidate `best`.
    t_n: Option<f64>,
    /// Candidate `alive`.
    back: Candidate,
    /// Candidate `best - 1`.
    front: Candidate,
}

/// The borders have met.
struct Settled;

impl<F: Fn(usize) -> Candidate> Visitor for Search<'_, '_, F> {
    type Found = Settled;

    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool {
        let unmet = || {
            self.criterion == Criterion::Standstill
                || parts(&self.front.motion, block.start, block.end).all(|(phase, a, b)| {
                    phase.start < self.front.reaction_time
                        || self
                            .encounter
                            .outline(block, phase, a, b)
                            .is_unmet(self.encounter.margins)
                })
        };
        let clear = || {
            !self.touching
                || parts(&self.back.motion, block.start, block.end)
                    .all(|(phase, a, b)| self.encounter.outline(block, phase, a, b).is_clear())
        };
        unmet() && clear()
    }

    #[inline]
    fn visit(&mut self, cell: &Cell<'_, Along>) -> Option<Settled> {
        if self.is_idle(cell) {
            return None;
        }
        let front = match self.verdict(&self.front, cell) {
            Verdict::Met(time) => self.lower_best(cell, time),
            verdict => verdict,
        };
        if front == Verdict::Contact {
            self.alive = self.best;
        } else if self.touching
            // With one candidate left between the borders, the front is the back.
            && self.alive + 1 < self.best
            && self.verdict(&self.back, cell) == Verdict::Contact
        {
            self.raise_alive(cell);
        }
        (self.alive == self.best).then_some(Settled)
    }
}

impl<F: Fn(usize) -> Candidate> Search<'_, '_, F> {
    /// Whether what ego and actor are at the ends of a cell tells that no border moves on it: the ego never goes
    /// back, and brakes from its reaction on.
    #[inline]
    fn is_idle(&self, cell: &Cell<'_, Along>) -> bool {
        let bounds = self.encounter.bounds(cell);
        if self.touching && self.back.motion.distance(cell.end) > bounds.nearest {
            return false;
        }
        if self.criterion == Criterion::Standstill || cell.end < self.front.reaction_time {
            return true;
        }
        let (motion, margins) = (&self.front.motion, self.encounter.margins);
        motion.speed(cell.end) > margins.c2 * bounds.fastest + 2.0 * TOLERANCE
            || motion.distance(cell.start) > margins.c1 * bounds.furthest + 2.0 * TOLERANCE
    }

    /// What happens first to a candidate on a cell.
    #[inline]
    fn verdict(&self, candidate: &Candidate, cell: &Cell<'_, Along>) -> Verdict {
        for (phase, end) in candidate.motion.phases() {
            let (a, b) = (later(phase.start, cell.start), sooner(end, cell.end));
            if a > b {
                continue;
            }
            let reacted =
                phase.start >= candidate.reaction_time && self.criterion == Criterion::Paper;
            if !reacted && !self.touching {
                continue;
            }
            let stretch = self.encounter.stretch(cell, phase, a, b);
            let contact = if self.touching {
                stretch.first_contact()
            } else {
                None
            };
            let met = if reacted {
                stretch.first_met(self.encounter.margins, contact.unwrap_or(stretch.length))
            } else {
                None
            };
            match (met, contact) {
                (Some(x), _) => return Verdict::Met(a + x),
                (None, Some(_)) => return Verdict::Contact,
                (None, None) => {}
            }
        }
        Verdict::Nothing
    }

    /// The front meets the constraints on this cell at `time`: so may others behind it. What happens to the new front.
    fn lower_best(&mut self, cell: &Cell<'_, Along>, time: f64) -> Verdict {
        let (mut low, mut front) = (self.alive, Verdict::Nothing);
        (self.best, self.t_n) = (self.best - 1, Some(time));
        while low < self.best {
            let middle = self.between(low, self.best);
            let candidate = (self.candidate)(middle);
            match self.verdict(&candidate, cell) {
                Verdict::Met(time) => (self.best, self.t_n) = (middle, Some(time)),
                verdict => {
                    (self.front, front) = (candidate, verdict);
                    low = middle + 1;
                }
            }
        }
        front
    }

    /// The back comes into contact on this cell: so may others before it.
    fn raise_alive(&mut self, cell: &Cell<'_, Along>) {
        self.alive += 1;
        let mut high = self.best;
        while self.alive < high {
            let middle = self.between(self.alive, high);
            if self.verdict(&(self.candidate)(middle), cell) == Verdict::Contact {
                self.alive = middle + 1;
            } else {
                high = middle;
            }
        }
        if self.alive < self.best {
            self.back = (self.candidate)(self.alive);
        }
    }

    /// Where to look next in [low, high): at the guess, just before it, or half-way.
    fn between(&self, low: usize, high: usize) -> usize {
        let range = low..high;
        if range.contains(&self.guess) {
            self.guess
        } else if self.guess == high {
            high - 1
        } else {
            usize::midpoint(low, high)
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
        })
    }

    /// The candidate `best`, if there is one.
    fn inside(&self, count: usize) -> Option<Found> {
        let (index, met) = (self.best, self.t_n?);
        if index == count {
            return None;
        }
        let Candidate {
            reaction_time,
            motion,
        } = (self.candidate)(index);
        // A time outside the corridor before that counts if no contact comes later either.
        let earlier = self.first_outside(reaction_time).filter(|time| *time < met);
        let horizon = self.encounter.corridor.horizon;
        let clear = || {
            self.encounter
                .first_contact(&motion, met, horizon)
                .is_none()
        };
        let t_n = earlier.filter(|_| clear()).unwrap_or(met);
        Some(Found {
            index,
            t_n: Some(t_n),
        })
    }

    /// The first time from `from` on at which the actor is outside the corridor after a conflict.
    fn first_outside(&self, from: f64) -> Option<f64> {
        let horizon = self.encounter.corridor.horizon;
        let after =
            |span: Span| (span.zone == Zone::After).then(|| overlap(&span, from, horizon))?;
        self.encounter.spans().find_map(after).map(|(time, _)| time)
    }
}

/// The larger of two numbers, neither of which is NaN.
#[inline]
fn later(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers, neither of which is NaN.
#[inline]
fn sooner(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
