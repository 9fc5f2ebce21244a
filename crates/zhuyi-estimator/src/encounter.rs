//! One ego and one future of one actor: what every candidate latency shares, and the walk along it in time.
//!
//! "No collision during t_n" is read as no pass-through (reading R6): `d(t) <= s(t)` at every conflict time in [0,
//! t_n] at which the bodies overlap sideways.

use crate::conflict::{Corridor, Span, Spans, Zone};
use crate::constraints::TOLERANCE;
use crate::ego_motion::{EgoMotion, Phase, braking_decel};
use crate::quadratic::Quadratic;
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

    /// [s] about the longest tolerable reaction time, told by how the actor starts and how it ends: only to look first
    /// where the answer may be.
    ///
    /// Behind an actor that comes to stand, d(t_r) with the braking must fit into C1 s at the end; behind one that goes
    /// on, the speeds must agree before the gap is gone, with the mean acceleration of the actor. Either is a quadratic
    /// in t_r: `(a_0 (1 + a_0/b) / 2) t_r^2 + v (1 + a_0/b) t_r + v^2 / 2b = room`, in the frame of the actor for the
    /// latter.
    pub fn guess(&self) -> f64 {
        let (future, horizon) = (&self.corridor.view.future, self.corridor.horizon);
        let end = {
            let last = future.along[future.along.len() - 1].time - future.now;
            if last > 0.0 && last < horizon {
                last
            } else {
                horizon
            }
        };
        let ((gap, speed), (last_gap, last_speed)) = (self.actor(0.0), self.actor(end));
        let mean_accel = (last_speed - speed) / end;
        let held = self.corridor.held;
        let reaction = |room: f64, speed: f64, accel: f64, decel: f64| {
            let share = 1.0 + accel / decel;
            Quadratic {
                c0: room - speed * speed / (2.0 * decel),
                c1: -speed * share,
                c2: -accel * share / 2.0,
            }
            .first_below(horizon)
            .unwrap_or(horizon)
        };
        let stopping = reaction(
            self.margins.c1 * last_gap,
            held.speed,
            held.accel,
            self.decel,
        );
        let closing = held.speed - speed;
        let following = if closing > 0.0 && self.decel + mean_accel > 0.0 {
            reaction(
                gap,
                closing,
                held.accel - mean_accel,
                self.decel + mean_accel,
            )
        } else {
            horizon
        };
        if last_speed > 1.0 {
            following
        } else if stopping < following {
            stopping
        } else {
            following
        }
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

    /// A reaction time with the motion that follows from it.
    pub fn candidate(&self, reaction_time: f64) -> Candidate {
        Candidate {
            reaction_time,
            motion: EgoMotion::new(self.corridor.held, reaction_time, self.decel),
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

    /// When in [from, to] a candidate first comes to what is asked for.
    pub fn first_event(&self, ask: Ask, candidate: &Candidate, from: f64, to: f64) -> Option<f64> {
        let mut single = Single {
            encounter: self,
            ask,
            candidate,
        };
        self.visit(from, to, &mut single)
    }

    /// Gap s and the actor's speed v_a at a time.
    pub fn actor(&self, time: f64) -> (f64, f64) {
        let future = &self.corridor.view.future;
        let (piece, at) = (&future.along[future.along_index(time)], time + future.now);
        (piece.s_at(at) - self.datum.origin, piece.v_at(at))
    }

    /// Takes a visitor along the pieces of [from, to] in order until it finds something.
    #[inline]
    pub fn visit<V: Visitor>(&self, from: f64, to: f64, visitor: &mut V) -> Option<V::Found> {
        let future = &self.corridor.view.future;
        let (mut time, mut index) = (from, future.along_index(from));
        // Before this piece no block is to be tried again.
        let (mut tried, mut stride) = (0, 8);
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
            (time, index) = self.hasten(time, index, to, &visitor.leash(time), stride);
            stride = 2;
            let next = future.along.get(index + 1);
            let end = next.map_or(f64::INFINITY, |next| next.time - future.now);
            if end > time || time >= to {
                let cell = Cell {
                    start: time,
                    end: if end < to { end } else { to },
                    piece: &future.along[index],
                };
                let mut envelope = Envelope::NOTHING;
                envelope.add(cell.piece, time + future.now, cell.end + future.now);
                let bounds = envelope.bounds(self.datum.origin, self.margins);
                if let Some(found) = visitor.visit(&cell, &bounds) {
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

    /// Passes over whole pieces on which the leash tells that nothing happens: the time and the piece at which it does
    /// not. Several pieces are tried together, `stride` at first, more after a success and fewer after a failure.
    #[inline]
    fn hasten(
        &self,
        mut time: f64,
        mut index: usize,
        to: f64,
        leash: &Leash,
        mut stride: usize,
    ) -> (f64, usize) {
        let Datum { now, origin } = self.datum;
        let pieces = self.corridor.view.future.along;
        let until = now + if leash.until < to { leash.until } else { to };
        'run: while stride > 1 {
            let mut envelope = Envelope::NOTHING;
            let (mut end, mut x) = (0.0, time + now);
            for place in index..index + stride {
                let (Some(piece), Some(next)) = (pieces.get(place), pieces.get(place + 1)) else {
                    stride /= 4;
                    continue 'run;
                };
                end = next.time;
                envelope.add(piece, x, end);
                x = end;
            }
            let bounds = envelope.bounds(origin, self.margins);
            let clear = leash.contact.at(end - now) <= bounds.nearest;
            let fast = leash.met.c1 + 2.0 * leash.met.c2 * (end - now) > bounds.fastest;
            if end > until || !clear || !(fast || leash.met.at(time) > bounds.furthest) {
                stride /= 4;
                continue;
            }
            if end > time + now {
                time = end - now;
            }
            index += stride;
            if stride < 16 {
                stride *= 2;
            }
        }
        (time, index)
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
            if a > b {
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
        parts(&candidate.motion, block.start, block.end).all(|(phase, a, b)| {
            let outline = Outline::new(a, b, block.piece, self.datum, phase);
            let reacted = ask.met && phase.start >= candidate.reaction_time;
            (!ask.contact || outline.is_clear()) && (!reacted || outline.is_unmet(self.margins))
        })
    }

    /// Whether the ego is ever slow enough (Eq. 2) in [from, to] before it stands.
    pub fn ever_slow_enough(&self, candidate: &Candidate, from: f64, to: f64) -> bool {
        let mut slow = Slow {
            encounter: self,
            candidate,
        };
        self.visit(from, to, &mut slow).is_some()
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

/// How far the ego is at most, and how far and fast at least, while it keeps to its phases: as polynomials in t that
/// hold up to a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leash {
    until: f64,
    /// Of the candidate that goes furthest.
    contact: Quadratic,
    /// Of the candidate that goes least far.
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
}

/// Who is taken along the pieces of a future.
pub(crate) trait Visitor {
    /// What ends the visit.
    type Found;

    /// Whether nothing on this block can matter.
    fn passes_over(&self, block: &Cell<'_, AlongBlock>) -> bool;

    /// What tells at once that nothing happens, from `time` on.
    fn leash(&self, time: f64) -> Leash;

    /// Looks at a piece.
    fn visit(&mut self, cell: &Cell<'_, Along>, bounds: &Bounds) -> Option<Self::Found>;
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

    fn leash(&self, time: f64) -> Leash {
        Leash {
            until: time,
            ..Leash::SLACK
        }
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

/// Between what the centre of an actor and its speed lie on some pieces.
#[derive(Clone, Copy, Debug)]
struct Envelope {
    s_min: f64,
    s_max: f64,
    v_max: f64,
}

impl Envelope {
    const NOTHING: Self = Self {
        s_min: f64::INFINITY,
        s_max: f64::NEG_INFINITY,
        v_max: 0.0,
    };

    /// Widens it by a piece from `start` to `end` on the clock of the lists.
    #[inline]
    fn add(&mut self, piece: &Along, start: f64, end: f64) {
        let (x, y) = (start - piece.time, end - piece.time);
        let at = |x: f64| {
            let s = piece.s + x * (piece.s_rate + x * piece.s_half_accel);
            (s, piece.v + x * piece.v_rate)
        };
        let (here, there) = (if x == 0.0 { (piece.s, piece.v) } else { at(x) }, at(y));
        let (mut low, mut high) = if here.0 < there.0 {
            (here.0, there.0)
        } else {
            (there.0, here.0)
        };
        if piece.s_half_accel != 0.0 {
            // How far a parabola strays from its chord at most.
            let bulge = piece.s_half_accel.abs() * ((y - x) * (y - x) / 4.0);
            (low, high) = (low - bulge, high + bulge);
        }
        if low < self.s_min {
            self.s_min = low;
        }
        if high > self.s_max {
            self.s_max = high;
        }
        let fastest = if here.1 > there.1 { here.1 } else { there.1 };
        if fastest > self.v_max {
            self.v_max = fastest;
        }
    }

    #[inline]
    fn bounds(&self, origin: f64, margins: Margins) -> Bounds {
        Bounds {
            nearest: self.s_min - origin,
            furthest: margins.c1 * (self.s_max - origin) + 2.0 * TOLERANCE,
            fastest: margins.c2 * self.v_max + 2.0 * TOLERANCE,
        }
    }
}

/// Bounds for the ego on a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// [m] least gap s: an ego that has gone no further is clear.
    nearest: f64,
    /// [m] C1 times the largest gap: beyond it Eq. 1 is unmet.
    furthest: f64,
    /// [m/s] C2 times the actor's largest speed: above it Eq. 2 is unmet.
    fastest: f64,
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
