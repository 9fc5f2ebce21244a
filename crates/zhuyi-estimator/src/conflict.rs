//! When an actor is the ego's business (readings R7 and R8).
//!
//! The ego keeps its offset d_e. The actor is in the corridor while `|d_a - d_e| < (w_e + w_a)/2 + margin`, and the
//! bodies overlap sideways while `|d_a - d_e| < (w_e + w_a)/2`. The stays in the corridor within [0, horizon] are
//! cut out of the pieces in closed form. A stay that begins with the actor's front bumper behind the ego's rear
//! bumper (the ego holding its acceleration) is dropped; the others are the conflict times.
//!
//! ```text
//!   |d_a - d_e|  \                                /
//!     corridor ---\------------------------------/-----
//!       bodies ----\----------------------------/------
//!                   \__________________________/
//!         zone   Before |Close|  Overlap   |Close| After
//! ```
//!
//! A list may flicker without end, so spans are derived one after the other and never collected; a few are kept
//! because every candidate latency walks over them again.

use crate::ego_motion::EgoMotion;
use crate::recording::View;
use zhuyi_core::Footprint;

/// What a stretch of time means for the constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Zone {
    /// Before the first conflict time.
    Before,
    /// Conflict: in the corridor, but the bodies do not overlap sideways.
    Close,
    /// Conflict: the bodies overlap sideways.
    Overlap,
    /// After the first conflict time, and no conflict.
    After,
}

/// A stretch of time of one zone, in seconds from t_0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    pub start: f64,
    pub end: f64,
    pub zone: Zone,
    /// A stay begins here with the bodies overlapping lengthwise.
    pub abreast: bool,
}

/// All that conflict times depend on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corridor<'a> {
    pub view: View<'a>,
    pub held: EgoMotion,
    /// [m] `s` and `d` of the ego's centre at t_0.
    pub ego: (f64, f64),
    /// [m] half of both lengths, half of both widths.
    pub half: (f64, f64),
    pub lateral_margin: f64,
    pub horizon: f64,
}

impl<'a> Corridor<'a> {
    pub fn new(
        view: View<'a>,
        held: EgoMotion,
        ego: (f64, f64),
        boxes: (Footprint, Footprint),
        lateral_margin: f64,
        horizon: f64,
    ) -> Self {
        let half = (
            f64::midpoint(boxes.0.length, boxes.1.length),
            f64::midpoint(boxes.0.width, boxes.1.width),
        );
        Self {
            view,
            held,
            ego,
            half,
            lateral_margin,
            horizon,
        }
    }

    /// Actor's centre ahead of the ego's with the acceleration held.
    fn ahead(&self, time: f64) -> f64 {
        let future = &self.view.future;
        let piece = &future.along[future.along_index(time)];
        piece.s_at(time + future.now) - self.ego.0 - self.held.distance(time)
    }
}

/// Sideways relation of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Apart,
    Close,
    Overlap,
}

/// Walks over the spans of a corridor.
#[derive(Clone, Debug)]
struct Walk<'a> {
    corridor: Corridor<'a>,
    time: f64,
    index: usize,
    /// The stay under way: whether it counts.
    stay: Option<bool>,
    conflict_seen: bool,
    pending: Option<Span>,
}

impl<'a> Walk<'a> {
    fn new(corridor: Corridor<'a>) -> Self {
        let index = corridor.view.future.across_index(0.0);
        Self {
            corridor,
            time: 0.0,
            index,
            stay: None,
            conflict_seen: false,
            pending: None,
        }
    }

    /// The relation just after the current time, until when it surely lasts, and the piece that follows then.
    fn side(&self) -> (Side, f64, usize) {
        let Corridor {
            view,
            ego,
            half,
            lateral_margin,
            horizon,
            ..
        } = &self.corridor;
        let (body, lane) = (half.1, half.1 + lateral_margin);
        if let Some((block, next)) = view.across_block(self.index, self.time) {
            let (right, left, end) = (
                block.d_min - ego.1,
                block.d_max - ego.1,
                (block.end - view.future.now).min(*horizon),
            );
            if right >= lane || left <= -lane {
                return (Side::Apart, end, next);
            }
            if right > -body && left < body {
                return (Side::Overlap, end, next);
            }
        }
        let (piece, now) = (&view.future.across[self.index], view.future.now);
        let begin = piece.time - now;
        let next = view.future.across.get(self.index + 1);
        let end = next.map_or(*horizon, |next| (next.time - now).min(*horizon));
        let offset = |time: f64| piece.d - ego.1 + (time - begin) * piece.d_rate;
        let (here, there) = (offset(self.time), offset(end));
        let following = if next.is_some() {
            self.index + 1
        } else {
            self.index
        };
        if (here >= lane && there >= lane) || (here <= -lane && there <= -lane) {
            return (Side::Apart, end, following);
        }
        if here.abs() < body && there.abs() < body {
            return (Side::Overlap, end, following);
        }
        if piece.d_rate == 0.0 || here == there {
            return (
                if here.abs() < lane {
                    Side::Close
                } else {
                    Side::Apart
                },
                end,
                following,
            );
        }
        // Seen in the direction of its motion, the actor crosses these four lines one after the other.
        let lines = [
            (-lane, Side::Apart),
            (-body, Side::Close),
            (body, Side::Overlap),
            (lane, Side::Close),
        ];
        let (towards, rate) = (piece.d_rate.signum(), piece.d_rate.abs());
        for (line, side_before) in lines {
            let crossing = self.time + (line - here * towards) / rate;
            if crossing >= end {
                return (side_before, end, following);
            }
            if crossing > self.time {
                return (side_before, crossing, self.index);
            }
        }
        (Side::Apart, end, following)
    }

    /// The next stretch of one relation within one piece or block.
    fn step(&mut self) -> Option<Span> {
        while self.time < self.corridor.horizon {
            let (start, (side, end, next)) = (self.time, self.side());
            self.index = next;
            if end > start {
                self.time = end;
                return Some(self.judge(start, end, side));
            }
        }
        None
    }

    fn judge(&mut self, start: f64, end: f64, side: Side) -> Span {
        let mut abreast = false;
        if side == Side::Apart {
            self.stay = None;
        } else if self.stay.is_none() {
            let (ahead, reach) = (self.corridor.ahead(start), self.corridor.half.0);
            let counts = ahead >= -reach;
            abreast = counts && ahead < reach;
            self.conflict_seen |= counts;
            self.stay = Some(counts);
        }
        let zone = match (self.stay, side, self.conflict_seen) {
            (Some(true), Side::Overlap, _) => Zone::Overlap,
            (Some(true), _, _) => Zone::Close,
            (_, _, false) => Zone::Before,
            (_, _, true) => Zone::After,
        };
        Span {
            start,
            end,
            zone,
            abreast,
        }
    }
}

impl Iterator for Walk<'_> {
    type Item = Span;

    fn next(&mut self) -> Option<Span> {
        let mut span = self.pending.take().or_else(|| self.step())?;
        while let Some(next) = self.step() {
            if next.zone != span.zone {
                self.pending = Some(next);
                break;
            }
            span.end = next.end;
        }
        Some(span)
    }
}

const KEPT: usize = 8;

/// The spans of [0, horizon], from the first to the last: the first few as found, the rest derived again on each
/// pass.
#[derive(Clone, Debug)]
pub(crate) struct Spans<'a> {
    first: [Span; KEPT],
    len: usize,
    rest: Option<Walk<'a>>,
}

impl<'a> Spans<'a> {
    pub fn new(corridor: Corridor<'a>) -> Self {
        let mut walk = Walk::new(corridor);
        let mut first = [Span {
            start: 0.0,
            end: 0.0,
            zone: Zone::Before,
            abreast: false,
        }; KEPT];
        let mut len = 0;
        while len < KEPT {
            let Some(span) = walk.next() else {
                return Self {
                    first,
                    len,
                    rest: None,
                };
            };
            first[len] = span;
            len += 1;
        }
        Self {
            first,
            len,
            rest: Some(walk),
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = Span> {
        self.first[..self.len]
            .iter()
            .copied()
            .chain(self.rest.iter().cloned().flatten())
    }

    /// Whether there is any conflict time.
    pub fn any(&self) -> bool {
        self.iter().any(|span| span.zone != Zone::Before)
    }
}
