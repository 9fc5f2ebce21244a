//! A recording asked step after step, which remembers what one step tells of the next.
//!
//! | remembered | used while |
//! |---|---|
//! | the last answer, to be looked at first | always: it need not be right |
//! | the piece at t_0 | t_0 does not go back |
//! | how the bodies are to each other sideways, piece by piece | the ego keeps its offset, from the second question on |
//!
//! It only ever saves work: the answers are those of [`crate::Estimator::recorded`].

use zhuyi_core::Across;

use crate::Future;
use crate::conflict::{Lines, Side};
use crate::recording::{Recording, View};

/// A recording with what its last answer told.
#[derive(Clone, Debug)]
pub struct Playback<'a> {
    recording: &'a Recording,
    /// The place of the last answer among the candidates.
    pub(crate) last: Option<usize>,
    /// [s] the last t_0, and the pieces that held then, along and across.
    at: (f64, [usize; 2]),
    /// What the runs are for.
    lines: Option<Lines>,
    /// None before it has been asked twice for the same lines.
    runs: Vec<Run>,
}

/// Pieces across the road that follow each other and have one sideways relation to the ego; ends where the next run begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    /// Its first piece.
    pub first: usize,
    /// None where it changes within the piece.
    pub side: Option<Side>,
}

impl<'a> Playback<'a> {
    /// From its start; nothing is remembered as yet.
    pub fn new(recording: &'a Recording) -> Self {
        Self {
            recording,
            last: None,
            at: (f64::NEG_INFINITY, [0; 2]),
            lines: None,
            runs: Vec::new(),
        }
    }

    /// The recording as seen from `now` by an ego with these lines beside it.
    #[inline]
    pub(crate) fn view(&mut self, now: f64, lines: Lines) -> View<'_> {
        let trajectory = self.recording.trajectory();
        let (before, [mut along, mut across]) = self.at;
        if now < before {
            (along, across) = (0, 0);
        }
        while trajectory
            .along
            .get(along + 1)
            .is_some_and(|next| next.time <= now)
        {
            along += 1;
        }
        while trajectory
            .across
            .get(across + 1)
            .is_some_and(|next| next.time <= now)
        {
            across += 1;
        }
        self.at = (now, [along, across]);
        if self.lines != Some(lines) {
            self.lines = Some(lines);
            self.runs.clear();
        } else if self.runs.is_empty() {
            derive(&trajectory.across, &lines, &mut self.runs);
        }
        let future = Future::new(trajectory, now);
        View {
            future,
            first: [along, across],
            runs: &self.runs,
            recording: Some(self.recording),
        }
    }
}

/// Sorts the pieces into runs.
fn derive(pieces: &[Across], lines: &Lines, runs: &mut Vec<Run>) {
    for (first, piece) in pieces.iter().enumerate() {
        let next = pieces.get(first + 1);
        let end = match next {
            // The first piece reaches back and the last on for ever.
            Some(next) if first > 0 => piece.d + (next.time - piece.time) * piece.d_rate,
            _ if piece.d_rate == 0.0 => piece.d,
            _ => f64::NAN,
        };
        let side = lines.side_between(piece.d, end);
        if side.is_none() || runs.last().is_none_or(|run| run.side != side) {
            runs.push(Run { first, side });
        }
    }
}
