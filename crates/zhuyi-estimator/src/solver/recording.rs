//! A long trajectory that is asked from many instants, with a coarse view of it.
//!
//! A recorded run has a piece every 10 ms, and every step of the run asks about the 20 s that follow. So a block of
//! pieces is also kept as one piece with an error: a quadratic for s and a line for v, and how far the true ones
//! stray from them. Where even with the error neither contact nor a time that meets the constraints is possible,
//! the search passes over the block at once. This only ever saves work: what a block cannot rule out is looked at
//! piece by piece, and the answer is that of the plain list.

use std::sync::OnceLock;

use super::lines::{Lines, Side};
use super::playback::Run;
use super::swing::Swing;
use crate::Future;
use zhuyi_core::{Across, Along, Trajectory};

/// Pieces per block along the road, from coarse to fine; each is a multiple of the next.
pub(crate) const ALONG_BLOCKS: [usize; 2] = [64, 8];

/// Pieces per block across the road, from coarse to fine.
const ACROSS_BLOCKS: [usize; 3] = [64, 16, 4];

/// [m, m/s] added to errors for the rounding of the comparison itself.
const ROUNDING: f64 = 1e-9;

/// Many pieces as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AlongBlock {
    pub fit: Along,
    pub s_error: f64,
    pub v_error: f64,
    /// Time on the list's clock at which it ends, the start of the piece behind it.
    pub end: f64,
}

/// Offsets over many pieces of the edges of the box, counted as in [`Edges`](super::lines::Edges).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AcrossBlock {
    pub start: f64,
    pub end: f64,
    pub right_min: f64,
    pub right_max: f64,
    pub left_min: f64,
    pub left_max: f64,
}

/// A trajectory with its coarse view.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    trajectory: Trajectory,
    /// None before it is first wanted: who is always beside or behind the ego is not looked at so closely.
    coarse: OnceLock<Coarse>,
}

/// The coarse view of a trajectory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coarse {
    /// Whether blocks are of edges, since the box turns at some time, and not of its centre.
    pub turning: bool,
    pub along: [Vec<AlongBlock>; ALONG_BLOCKS.len()],
    /// Of a box that turns, the pieces along the road in which its half extents change more than once; none for the others.
    pub turning_pieces: Vec<Option<AlongBlock>>,
    across: [Vec<AcrossBlock>; ACROSS_BLOCKS.len()],
}

impl Recording {
    /// Takes a trajectory, which is looked through once when it is first asked about.
    pub fn new(trajectory: Trajectory) -> Self {
        Self {
            trajectory,
            coarse: OnceLock::new(),
        }
    }

    /// Its coarse view.
    pub(crate) fn coarse(&self) -> &Coarse {
        let swing = Swing::of_all(&self.trajectory.extents);
        self.coarse.get_or_init(|| Coarse {
            turning: swing.is_some(),
            turning_pieces: swing.map_or_else(Vec::new, |swing| {
                let pieces = self.trajectory.along.windows(2);
                pieces.map(|pair| turning_piece(pair, swing)).collect()
            }),
            along: ALONG_BLOCKS.map(|size| {
                let blocks = blocks(&self.trajectory.along, size);
                let block = |(pieces, behind): (&[Along], &Along)| match swing {
                    None => along_block(pieces, behind.time),
                    Some(swing) => along_block(&rears(pieces, behind.time, swing), behind.time),
                };
                blocks.map(block).collect()
            }),
            across: ACROSS_BLOCKS.map(|size| {
                let blocks = blocks(&self.trajectory.across, size);
                blocks
                    .map(|(pieces, behind)| across_block(pieces, behind.time, swing))
                    .collect()
            }),
        })
    }

    /// The trajectory as given.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    pub(crate) fn view(&self, now: f64) -> View<'_> {
        let future = Future::new(&self.trajectory, now);
        let first = [future.along_index(0.0), future.across_index(0.0)];
        View {
            future,
            first,
            runs: &[],
            coarse: Some(self.coarse()),
        }
    }
}

/// The only stay of an actor in the corridor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum OnlyStay {
    /// The bodies overlap sideways until this time [s] on the clock of the lists.
    UnderWay(f64),
    /// It is still to begin, if ever.
    ToCome,
}

/// A future, with its coarse view where it has one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'a> {
    pub future: Future<'a>,
    /// Its pieces at t_0, along and across, or earlier ones.
    pub first: [usize; 2],
    /// How the pieces across are to the ego; empty where nobody has looked.
    pub runs: &'a [Run],
    pub coarse: Option<&'a Coarse>,
}

impl<'a> View<'a> {
    pub fn plain(future: Future<'a>) -> Self {
        Self {
            first: [future.along_index(0.0), future.across_index(0.0)],
            runs: &[],
            future,
            coarse: None,
        }
    }

    /// As [`Future::along_index`].
    #[inline]
    pub fn along_index(&self, time: f64) -> usize {
        let (at, [first, _]) = (time + self.future.now, self.first);
        let behind = self.future.along.get(first + 1..).unwrap_or_default();
        if behind.first().is_none_or(|next| next.time > at) {
            return first;
        }
        first + behind.partition_point(|piece| piece.time <= at)
    }

    /// The sideways relation that all of a piece across has, and the first piece behind it that may have another; none
    /// where nobody has looked, or it changes within the piece.
    #[inline]
    pub fn side_of(&self, index: usize) -> Option<(Side, usize)> {
        if self.runs.is_empty() {
            return None;
        }
        let behind = self.runs.partition_point(|run| run.first <= index);
        let side = self.runs.get(behind.checked_sub(1)?)?.side?;
        let next = self.runs.get(behind).map(|run| run.first);
        Some((side, next.unwrap_or(self.future.across.len())))
    }

    /// The one stay in the corridor that is under way, with the bodies overlapping sideways, or still to come; none where there
    /// are more, or nobody has looked. From then on the actor stays for ever, or leaves for ever.
    pub fn only_stay(&self, lines: &Lines) -> Option<OnlyStay> {
        let behind = self.runs.partition_point(|run| run.first <= self.first[1]);
        let (now, later) = self.runs.get(behind.checked_sub(1)?..)?.split_first()?;
        let begins = match now.side? {
            Side::Overlap => true,
            Side::Apart => false,
            Side::Close => return None,
        };
        // How often it has entered or left.
        let (mut inside, mut changes) = (begins, 0);
        for run in later {
            for ends_inside in self.ends_inside(run, lines)? {
                changes += u32::from(ends_inside != inside);
                inside = ends_inside;
            }
        }
        match (begins, changes) {
            (true, 0 | 1) => {
                let next = later.first().map(|run| self.future.across[run.first].time);
                Some(OnlyStay::UnderWay(next.unwrap_or(f64::INFINITY)))
            }
            (false, 0..=2) => Some(OnlyStay::ToCome),
            _ => None,
        }
    }

    /// Whether the actor is in the corridor at the start and at the end of a run; none where that does not tell of all between.
    fn ends_inside(&self, run: &Run, lines: &Lines) -> Option<[bool; 2]> {
        if let Some(side) = run.side {
            return Some([side != Side::Apart; 2]);
        }
        let (piece, next) = (
            &self.future.across[run.first],
            self.future.across.get(run.first + 1)?,
        );
        // On the clock of the lists, so that pieces of both that begin together do.
        let swing = Swing::of(&self.future).map(Swing::on_its_clock);
        let (start, end) = (piece.time, next.time);
        if swing.is_some_and(|swing| swing.changes_between(start, end)) {
            return None;
        }
        // The end belongs to the piece before it, should the box jump there.
        let half_at_start = swing.map_or(0.0, |swing| swing.at(start).across);
        let half_at_end = swing.map_or(0.0, |swing| swing.before(end).across);
        let edges = [
            lines.edges(piece.d, half_at_start),
            lines.edges(piece.d + (end - start) * piece.d_rate, half_at_end),
        ];
        let inside = edges.map(|edges| lines.holds(edges));
        // On its way from one side to the other it passes through.
        let passes = inside == [false; 2] && edges[0].is_to_the_left() != edges[1].is_to_the_left();
        (!passes).then_some(inside)
    }

    /// Whether a block across the road begins with this piece.
    #[inline]
    pub fn begins_across_block(&self, index: usize) -> bool {
        let [.., size] = ACROSS_BLOCKS;
        let holds = |coarse: &Coarse| index / size < coarse.across[ACROSS_BLOCKS.len() - 1].len();
        index.is_multiple_of(size) && self.coarse.is_some_and(holds)
    }

    /// The offsets from `time` to the end of each block of a piece, the longest first, and the piece behind that block.
    /// Later than at t_0 only the blocks that begin with the piece: the others have been offered. None where the runs tell more.
    #[inline]
    pub fn across_blocks(
        &self,
        index: usize,
        time: f64,
    ) -> impl Iterator<Item = (&'a AcrossBlock, usize)> {
        let at = time + self.future.now;
        let levels: &[Vec<AcrossBlock>] = match self.coarse {
            Some(coarse) if self.runs.is_empty() => &coarse.across,
            _ => &[],
        };
        levels
            .iter()
            .zip(ACROSS_BLOCKS)
            .filter_map(move |(blocks, size)| {
                if !index.is_multiple_of(size) && time > 0.0 {
                    return None;
                }
                let block = blocks.get(index / size)?;
                // Before the list begins its first piece is extended backwards, the block is not.
                (block.start <= at).then_some((block, (index / size + 1) * size))
            })
    }
}

/// Whole blocks of a list, each with the piece behind it; the pieces after them go on for ever.
fn blocks<P>(pieces: &[P], size: usize) -> impl Iterator<Item = (&[P], &P)> {
    pieces
        .chunks(size)
        .zip(pieces.iter().skip(size).step_by(size))
}

/// Pieces up to `end`, cut where the half extents change, as the rear of a box that turns makes them.
fn rears(pieces: &[Along], end: f64, swing: Swing<'_>) -> Vec<Along> {
    let ends = pieces.iter().skip(1).map(|piece| piece.time).chain([end]);
    let mut cut = Vec::with_capacity(64);
    for (piece, end) in pieces.iter().zip(ends) {
        let (mut time, mut extent) = (piece.time, swing.index(piece.time));
        loop {
            let rear = swing.rear(extent, piece);
            let x = time - piece.time;
            cut.push(Along {
                time,
                s: rear.s_at(time),
                s_rate: rear.s_rate + 2.0 * x * rear.s_half_accel,
                v: rear.v_at(time),
                ..rear
            });
            time = swing.end(extent);
            extent += 1;
            if time >= end {
                break;
            }
        }
    }
    cut
}

/// A piece with the one behind it as a block, where that is cut in more than two.
fn turning_piece(pair: &[Along], swing: Swing<'_>) -> Option<AlongBlock> {
    let end = pair[1].time;
    if !swing.changes_between(pair[0].time, end) {
        return None;
    }
    let cut = rears(&pair[..1], end, swing);
    (cut.len() > 2).then(|| along_block(&cut, end))
}

fn along_block(pieces: &[Along], end: f64) -> AlongBlock {
    let ends = pieces.iter().skip(1).map(|piece| piece.time).chain([end]);
    let timed = || pieces.iter().zip(ends.clone());
    let fit = fit(pieces, end);
    let (mut s_error, mut v_error) = (0.0, 0.0);
    for (piece, end) in timed() {
        // Both are quadratics: they are furthest apart at an end of the piece or where their rates agree.
        let (accel, rate) = (
            piece.s_half_accel - fit.s_half_accel,
            rate_at(piece, piece.time) - rate_at(&fit, piece.time),
        );
        let turn = (piece.time - rate / (2.0 * accel)).max(piece.time).min(end);
        for time in [piece.time, turn, end] {
            widen(&mut s_error, piece.s_at(time) - fit.s_at(time));
            widen(&mut v_error, piece.v_at(time) - fit.v_at(time));
        }
    }
    if ![fit.s, fit.s_rate, fit.s_half_accel, fit.v, fit.v_rate]
        .iter()
        .all(|number| number.is_finite())
    {
        // Pieces without duration: rules nothing out.
        let fit = Along::constant_accel(fit.time, 0.0, 0.0, 0.0);
        return AlongBlock {
            fit,
            s_error: f64::INFINITY,
            v_error: f64::INFINITY,
            end,
        };
    }
    AlongBlock {
        fit,
        s_error: s_error + ROUNDING,
        v_error: v_error + ROUNDING,
        end,
    }
}

fn widen(error: &mut f64, difference: f64) {
    if difference.abs() > *error {
        *error = difference.abs();
    }
}

fn rate_at(piece: &Along, time: f64) -> f64 {
    piece.s_rate + 2.0 * piece.s_half_accel * (time - piece.time)
}

/// The quadratic in s through both ends and the middle, and the line in v through both ends.
fn fit(pieces: &[Along], end: f64) -> Along {
    let (first, last, middle) = (
        &pieces[0],
        &pieces[pieces.len() - 1],
        &pieces[pieces.len() / 2],
    );
    let (half, length) = (middle.time - first.time, end - first.time);
    let (mean_half, mean) = (
        (middle.s - first.s) / half,
        (last.s_at(end) - first.s) / length,
    );
    let s_half_accel = (mean - mean_half) / (length - half);
    let s_rate = mean - s_half_accel * length;
    Along {
        s_rate,
        s_half_accel,
        v_rate: (last.v_at(end) - first.v) / length,
        ..*first
    }
}

fn across_block(pieces: &[Across], end: f64, swing: Option<Swing<'_>>) -> AcrossBlock {
    let mut block = AcrossBlock {
        start: pieces[0].time,
        end,
        right_min: f64::INFINITY,
        right_max: f64::NEG_INFINITY,
        left_min: f64::INFINITY,
        left_max: f64::NEG_INFINITY,
    };
    let ends = pieces.iter().skip(1).map(|piece| piece.time).chain([end]);
    for (piece, end) in pieces.iter().zip(ends) {
        for_each_edge(piece, piece.time, end, swing, |d, half| {
            widen_to(&mut block.right_min, &mut block.right_max, d - half);
            widen_to(&mut block.left_min, &mut block.left_max, d + half);
        });
    }
    block
}

/// Tells offset and half extent across of a box that turns at both ends of a piece that lasts from `start` to `end` and wherever its half
/// extents change in between; from one to the next the edges go straight.
pub(crate) fn for_each_edge(
    piece: &Across,
    start: f64,
    end: f64,
    swing: Option<Swing<'_>>,
    mut tell: impl FnMut(f64, f64),
) {
    let d = |time: f64| piece.d + (time - piece.time) * piece.d_rate;
    let Some(swing) = swing else {
        tell(d(start), 0.0);
        tell(d(end), 0.0);
        return;
    };
    let mut extent = swing.index(start);
    tell(d(start), swing.on(extent, start).across);
    while swing.end(extent) < end {
        let time = swing.end(extent);
        // Both pieces, should they not meet.
        tell(d(time), swing.on(extent, time).across);
        extent += 1;
        tell(d(time), swing.on(extent, time).across);
    }
    tell(d(end), swing.on(extent, end).across);
}

fn widen_to(least: &mut f64, most: &mut f64, value: f64) {
    if value < *least {
        *least = value;
    }
    if value > *most {
        *most = value;
    }
}

#[cfg(test)]
mod tests {
    use super::{along_block, rate_at};
    use zhuyi_core::Along;

    /// Seven short pieces and a long one in which the actor brakes, stands and turns back: the furthest point lies
    /// inside the long one.
    #[test]
    fn hand_the_error_of_a_block_holds_inside_its_pieces() {
        let mut pieces = vec![Along::constant_accel(0.0, 0.0, 10.0, 1.0)];
        for count in 1..8 {
            let (last, time) = (pieces[count - 1], 0.05 * count as f64);
            let accel = if count == 7 { -9.0 } else { 1.0 };
            pieces.push(Along::constant_accel(
                time,
                last.s_at(time),
                rate_at(&last, time),
                accel,
            ));
        }
        let behind = Along::constant_accel(3.0, 0.0, 0.0, 0.0);
        let block = along_block(&pieces, behind.time);
        let mut furthest = 0.0;
        for step in 0..3000 {
            let time = f64::from(step) / 1000.0;
            let place = pieces.iter().rposition(|piece| piece.time <= time).unwrap();
            let s = (pieces[place].s_at(time) - block.fit.s_at(time)).abs();
            let v = (pieces[place].v_at(time) - block.fit.v_at(time)).abs();
            assert!(
                s <= block.s_error && v <= block.v_error,
                "at {time}: {s} m, {v} m/s, {block:?}"
            );
            if s > furthest {
                furthest = s;
            }
        }
        assert!(furthest > 0.99 * block.s_error, "{furthest} {block:?}");
    }
}
