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

use super::lines::{Lines, Side};
use super::recording::{AcrossBlock, View};
use super::swing::{Swing, stand};
use crate::ego_motion::Start;
use crate::{Ego, Params};
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
    pub view: &'a View<'a>,
    /// The ego, whose acceleration is held.
    pub held: Start,
    /// [m] `s` of the ego's centre at t_0.
    pub ego: f64,
    pub lines: Lines,
    /// How the actor's box turns; none where it keeps the extents that the lines count.
    pub swing: Option<Swing<'a>>,
    /// The extents that the lines count and the blocks of a recording too, as it turned earlier.
    pub kept_of_blocks: Footprint,
    pub horizon: f64,
}

impl<'a> Corridor<'a> {
    #[inline]
    pub fn new(params: &Params, ego: &Ego, actor: Footprint, view: &'a View<'a>) -> Self {
        let (box_kept, swing) = stand(actor, view.future.extents, view.future.now);
        Self {
            view,
            held: Start::new(ego.speed, ego.accel),
            ego: ego.s,
            lines: Lines::new(params, ego, box_kept),
            swing,
            kept_of_blocks: match (view.coarse, swing) {
                (Some(coarse), None) if coarse.turning => box_kept,
                _ => Footprint::default(),
            },
            horizon: params.horizon,
        }
    }

    /// The one relation of an actor that has no other from t_0 on; none where more than its last piece is to be looked at.
    #[inline]
    fn only_side(&self) -> Option<Side> {
        let (across, [_, first]) = (self.view.future.across, self.view.first);
        if let Some((side, next)) = self.view.side_of(first) {
            return (next == across.len()).then_some(side);
        }
        match &across[first..] {
            [piece] if piece.d_rate == 0.0 && self.swing.is_none() => {
                Some(self.lines.side_at(self.lines.edges(piece.d, 0.0)))
            }
            _ => None,
        }
    }

    /// Until when, and up to which piece, the offset from the ego's is such as `holds` wants it on all pieces from
    /// `index` on, which starts at `end`, or up to a block, which tells more. What holds at both ends of a piece must hold
    /// on it.
    #[inline]
    fn lasting_from(
        &self,
        mut index: usize,
        mut end: f64,
        holds: impl Fn(f64) -> bool,
    ) -> (f64, usize) {
        let (pieces, now) = (self.view.future.across, self.view.future.now);
        while let Some(piece) = pieces.get(index)
            && end < self.horizon
            && !self.view.begins_across_block(index)
        {
            let next = pieces
                .get(index + 1)
                .map_or(f64::INFINITY, |next| next.time - now);
            let next = if next < self.horizon {
                next
            } else {
                self.horizon
            };
            let d = piece.d - self.lines.ego;
            if !holds(d) || !holds(d + (next - end) * piece.d_rate) {
                break;
            }
            (end, index) = (next, index + 1);
        }
        (end, index.min(pieces.len() - 1))
    }

    /// Actor's centre ahead of the ego's with the acceleration held.
    fn ahead(&self, time: f64) -> f64 {
        self.actor_at(time) - self.ego - self.held.distance(time)
    }

    /// The one relation on all of a block; none where it may change.
    #[inline]
    fn side_over(&self, block: &AcrossBlock) -> Option<Side> {
        self.lines.side_over(block, self.kept_of_blocks.width / 2.0)
    }

    /// [m] half extent of the actor along the path, beyond what the lines count.
    pub fn half_along(&self, time: f64) -> f64 {
        self.swing.map_or(0.0, |swing| swing.at(time).along)
    }

    /// [m] `s` of the actor's centre.
    pub fn actor_at(&self, time: f64) -> f64 {
        let future = &self.view.future;
        let piece = &future.along[self.view.along_index(time)];
        piece.s_at(time + future.now)
    }
}

/// A walk over the spans of a corridor.
#[derive(Clone, Copy, Debug)]
struct Walk {
    time: f64,
    index: usize,
    /// The piece of the half extents.
    extent: usize,
    /// The stay under way: whether it counts.
    stay: Option<bool>,
    conflict_seen: bool,
    pending: Option<Span>,
}

impl Walk {
    fn new(corridor: &Corridor<'_>) -> Self {
        Self {
            time: 0.0,
            index: corridor.view.first[1],
            extent: corridor.swing.map_or(0, |swing| swing.index(0.0)),
            stay: None,
            conflict_seen: false,
            pending: None,
        }
    }

    /// The relation just after the current time, until when it surely lasts, and the piece that follows then.
    fn side(&self, corridor: &Corridor<'_>) -> (Side, f64, usize) {
        let (view, horizon) = (corridor.view, corridor.horizon);
        if let Some((side, next)) = view.side_of(self.index) {
            let across = view.future.across;
            let end = across
                .get(next)
                .map_or(f64::INFINITY, |piece| piece.time - view.future.now);
            return (side, end.min(horizon), next.min(across.len() - 1));
        }
        let Lines {
            ego, body, lane, ..
        } = corridor.lines;
        for (block, next) in view.across_blocks(self.index, self.time) {
            if let Some(side) = corridor.side_over(block) {
                let end = (block.end - view.future.now).min(horizon);
                return (side, end, next);
            }
        }
        let (piece, now) = (&view.future.across[self.index], view.future.now);
        let begin = piece.time - now;
        let next = view.future.across.get(self.index + 1);
        let end = next.map_or(horizon, |next| (next.time - now).min(horizon));
        let offset = |time: f64| piece.d - ego + (time - begin) * piece.d_rate;
        let (here, there) = (offset(self.time), offset(end));
        let following = if next.is_some() {
            self.index + 1
        } else {
            self.index
        };
        if here >= lane && there >= lane {
            let (end, following) = corridor.lasting_from(self.index + 1, end, |d| d >= lane);
            return (Side::Apart, end, following);
        }
        if here <= -lane && there <= -lane {
            let (end, following) = corridor.lasting_from(self.index + 1, end, |d| d <= -lane);
            return (Side::Apart, end, following);
        }
        if here.abs() < body && there.abs() < body {
            let (end, following) = corridor.lasting_from(self.index + 1, end, |d| d.abs() < body);
            return (Side::Overlap, end, following);
        }
        if piece.d_rate == 0.0 || here == there {
            let edges = corridor.lines.edges(piece.d, 0.0);
            return (corridor.lines.side_at(edges), end, following);
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

    /// The same of an actor whose box turns; goes on to the next piece of its half extents where one ends first.
    fn side_of_turning(&mut self, corridor: &Corridor<'_>, swing: Swing<'_>) -> (Side, f64, usize) {
        let (view, horizon, lines) = (corridor.view, corridor.horizon, &corridor.lines);
        let (across, now) = (view.future.across, view.future.now);
        let run = view.side_of(self.index).map(|(side, next)| {
            let end = across
                .get(next)
                .map_or(f64::INFINITY, |next| next.time - now);
            (side, end, next.min(across.len() - 1))
        });
        let block = || {
            let mut blocks = view.across_blocks(self.index, self.time);
            blocks
                .find_map(|(block, next)| Some((corridor.side_over(block)?, block.end - now, next)))
        };
        if let Some((side, end, next)) = run.or_else(block) {
            let end = end.min(horizon);
            self.extent = self.extent.max(swing.index(end));
            return (side, end, next);
        }
        let (piece, extent_end) = (&across[self.index], swing.end(self.extent));
        let next = across.get(self.index + 1);
        let piece_end = next.map_or(horizon, |next| (next.time - now).min(horizon));
        let end = piece_end.min(extent_end);
        let edges = |time: f64| {
            let d = piece.d + (time + now - piece.time) * piece.d_rate;
            lines.edges(d, swing.on(self.extent, time).across)
        };
        // Each edge goes straight from where both pieces have begun: the relation changes where one of them crosses a line. The
        // crossings do not hang on how far the walk has come, so it passes each once.
        let begun = |index: usize, time: f64| if index == 0 { 0.0 } else { time.max(0.0) };
        let start =
            begun(self.index, piece.time - now).max(begun(self.extent, swing.start(self.extent)));
        let (here, there) = (edges(start), edges(end));
        let mut crossing = end;
        for (from, to, sign) in [
            (here.right, there.right, 1.0),
            (here.left, there.left, -1.0),
        ] {
            for line in [lines.body, lines.lane] {
                let line = sign * line;
                if (from < line) != (to < line) {
                    let time = start + (end - start) * ((line - from) / (to - from));
                    if time > self.time && time < crossing {
                        crossing = time;
                    }
                }
            }
        }
        let side = lines.side_at(edges(f64::midpoint(self.time, crossing)));
        if crossing < end {
            return (side, crossing, self.index);
        }
        if extent_end <= end {
            self.extent += 1;
        }
        let following = if next.is_some() && piece_end <= end {
            self.index + 1
        } else {
            self.index
        };
        (side, end, following)
    }

    /// The next stretch of one relation within one piece or block.
    fn step(&mut self, corridor: &Corridor<'_>) -> Option<Span> {
        while self.time < corridor.horizon {
            let (start, (side, end, next)) = match &corridor.swing {
                None => (self.time, self.side(corridor)),
                Some(swing) => (self.time, self.side_of_turning(corridor, *swing)),
            };
            self.index = next;
            if end > start {
                self.time = end;
                return Some(self.judge(corridor, start, end, side));
            }
        }
        None
    }

    #[inline]
    fn judge(&mut self, corridor: &Corridor<'_>, start: f64, end: f64, side: Side) -> Span {
        let mut abreast = false;
        if side == Side::Apart {
            self.stay = None;
        } else if self.stay.is_none() {
            let (ahead, reach) = (corridor.ahead(start), corridor.lines.reach);
            let reach = reach + corridor.half_along(start);
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

    /// The next span.
    fn next(&mut self, corridor: &Corridor<'_>) -> Option<Span> {
        let mut span = self.pending.take().or_else(|| self.step(corridor))?;
        while let Some(next) = self.step(corridor) {
            if next.zone != span.zone {
                self.pending = Some(next);
                break;
            }
            span.end = next.end;
        }
        Some(span)
    }
}

/// A lead has one span, a cut-in three: most futures have no more.
const KEPT: usize = 3;

/// The spans of [0, horizon], from the first to the last: the first few as found, the rest derived again on each
/// pass.
#[derive(Clone, Debug)]
pub(crate) struct Spans {
    first: [Span; KEPT],
    len: usize,
    rest: Option<Walk>,
}

impl Spans {
    /// `None` where there is no conflict time.
    pub fn new(corridor: &Corridor<'_>) -> Option<Self> {
        let mut walk = Walk::new(corridor);
        if corridor.horizon > 0.0
            && let Some(side) = corridor.only_side()
        {
            return Self::of_one(walk.judge(corridor, 0.0, corridor.horizon, side));
        }
        let span = walk.next(corridor)?;
        if walk.pending.is_none() {
            return Self::of_one(span);
        }
        let mut spans = Self {
            first: [span; KEPT],
            len: 1,
            rest: None,
        };
        while let Some(next) = walk.next(corridor) {
            spans.first[spans.len] = next;
            spans.len += 1;
            if spans.len == KEPT {
                spans.rest = Some(walk);
                break;
            }
        }
        Some(spans)
    }

    /// What comes before the first conflict is one span, so a future without conflict has no second one.
    fn of_one(span: Span) -> Option<Self> {
        (span.zone != Zone::Before).then_some(Self {
            first: [span; KEPT],
            len: 1,
            rest: None,
        })
    }

    pub fn iter<'a>(&'a self, corridor: &'a Corridor<'a>) -> Iter<'a> {
        Iter {
            spans: self,
            corridor,
            place: 0,
            rest: None,
        }
    }
}

/// One pass over all spans.
pub(crate) struct Iter<'a> {
    spans: &'a Spans,
    corridor: &'a Corridor<'a>,
    place: usize,
    /// Behind those that are kept.
    rest: Option<Walk>,
}

impl Iterator for Iter<'_> {
    type Item = Span;

    #[inline]
    fn next(&mut self) -> Option<Span> {
        let Self { spans, place, .. } = self;
        if *place < spans.len {
            *place += 1;
            return Some(spans.first[*place - 1]);
        }
        if *place == spans.len {
            *place += 1;
            self.rest = spans.rest;
        }
        self.rest.as_mut()?.next(self.corridor)
    }
}
