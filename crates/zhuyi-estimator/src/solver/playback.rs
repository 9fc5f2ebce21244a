//! A recording asked step after step, which remembers what one step tells of the next.
//!
//! | remembered | used while |
//! |---|---|
//! | the place of the last answer, to be looked at first | always: it need not be right |
//! | the pieces at t_0 | t_0 does not go back |
//! | how the bodies are to each other sideways, piece by piece | the ego keeps its offset within 3 mm |
//! | a proof that the answer stays (module `proof`) | the ego's motion keeps within limits |
//!
//! It only ever saves work: the answers are those of [`Estimator::recorded`].

use zhuyi_core::{Across, Along, Footprint, Trajectory};

use super::conflict::Corridor;
use super::encounter::Encounter;
use super::lines::{Lines, Side};
use super::proof::Proof;
use super::recording::{Recording, View, for_each_edge};
use super::swing::{Swing, stand};
use crate::ego_motion::Start;
use crate::estimate::{State, Tolerance};
use crate::{Ego, Estimator, Future};

/// After how many questions a proof is tried again where there was none.
const PAUSE: u32 = 4;

/// A recording of an actor with what its last answer told.
#[derive(Clone, Debug)]
pub struct Playback<'a> {
    estimator: &'a Estimator,
    recording: &'a Recording,
    actor: Footprint,
    /// The place of the last answer among the candidates.
    last: Option<usize>,
    proof: Option<Proof>,
    /// How many questions are answered without trying for a proof.
    pause: u32,
    now: Now,
    /// What the runs are for, and all lines near them.
    lines: Option<Lines>,
    /// None where the ego is on its way sideways.
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

impl Estimator {
    /// A recording of an actor of this box, to be asked step after step.
    ///
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint, Trajectory};
    /// # use zhuyi_estimator::{Ego, Estimator, Params, Recording};
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// let recording = Recording::new(Trajectory {
    ///     along: vec![Along::constant_accel(0.0, 54.0, 8.0, -1.0), Along::constant_accel(8.0, 86.0, 0.0, 0.0)],
    ///     across: vec![Across { time: 0.0, d: 0.0, d_rate: 0.0 }],
    ///     extents: Vec::new(),
    ///     known_until: 20.0,
    /// });
    /// let estimator = Estimator::new(Params::default());
    /// let mut playback = estimator.playback(&recording, car);
    /// for step in 0..100 {
    ///     let now = 0.01 * f64::from(step);
    ///     let ego = Ego { s: 10.0 * now, d: 0.0, speed: 10.0, accel: 0.0, footprint: car };
    ///     let tolerance = playback.tolerance(&ego, now, 1.0 / 30.0);
    ///     assert_eq!(tolerance, estimator.recorded(&ego, car, &recording, now, 1.0 / 30.0).into());
    /// }
    /// ```
    pub fn playback<'a>(&'a self, recording: &'a Recording, actor: Footprint) -> Playback<'a> {
        Playback {
            estimator: self,
            recording,
            actor,
            last: None,
            proof: None,
            pause: 0,
            now: Now {
                time: f64::NEG_INFINITY,
                first: [0; 2],
            },
            lines: None,
            // Room for a few lane changes, each with some pieces near the lines of the corridor.
            runs: Vec::with_capacity(64),
        }
    }
}

impl Playback<'_> {
    /// The tolerance of [`Estimator::recorded`], mostly by what has been proven before.
    #[inline]
    pub fn tolerance(&mut self, ego: &Ego, now: f64, current_latency: f64) -> Tolerance {
        let params = self.estimator.params();
        let extents = &self.recording.trajectory().extents;
        let lines = Lines::new(params, ego, stand(self.actor, extents, now).0);
        let held = Start::new(ego.speed, ego.accel);
        let is_near = self.lines.is_none_or(|kept| kept.are_near(&lines));
        if let Some(proof) = &self.proof {
            if !is_near || !proof.holds(params, lines, ego.s, held, now, current_latency) {
                self.proof = None;
            } else if !params.jumps() {
                return self.proven(proof, held);
            }
        }
        let now = self.look(now, lines, is_near);
        if self.is_surely_quiet(ego, lines, now) {
            return self.any_latency(State::None);
        }
        self.looked_for(ego, now, current_latency)
    }

    /// The same where no proof tells all of it, and a new proof.
    fn looked_for(&mut self, ego: &Ego, now: Now, current_latency: f64) -> Tolerance {
        let (estimator, params) = (self.estimator, self.estimator.params());
        let view = now.of(self.recording, &self.runs);
        let corridor = Corridor::new(params, ego, self.actor, &view);
        let Some(encounter) = Encounter::new(params, &corridor) else {
            return self.any_latency(State::None);
        };
        if corridor.held.stands() {
            return self.any_latency(State::Standing);
        }
        let prove = |index: usize| {
            let delay = |index: usize| estimator.delay_of(index, current_latency);
            let is_tolerable = index < estimator.latencies().len();
            is_tolerable
                .then(|| Proof::new(&encounter, params, index, delay, current_latency))
                .flatten()
        };
        // Mostly it is what it was.
        let last = self.last;
        if self.proof.is_none() && self.pause == 0 {
            self.proof = last.and_then(prove);
        }
        if let Some(proof) = &self.proof
            && !params.jumps()
        {
            return self.proven(proof, corridor.held);
        }
        let known = self.proof.map(|proof| proof.index);
        let answer = estimator.conflict(&encounter, current_latency, last, known);
        if self.proof.is_none() && self.pause == 0 {
            let other = answer.place.filter(|place| last != Some(*place));
            self.proof = other.and_then(prove);
            self.pause = if self.proof.is_none() { PAUSE } else { 0 };
        } else {
            self.pause = self.pause.saturating_sub(1);
        }
        self.last = answer.place;
        answer.estimate.into()
    }

    /// The tolerance where no latency is tried.
    fn any_latency(&self, state: State) -> Tolerance {
        Tolerance {
            state,
            latency: Some(self.estimator.largest()),
        }
    }

    /// The tolerance that a proof gives an ego in this motion. A latency can be tolerable in a conflict alone, so an ego
    /// that stands meanwhile stands in one.
    fn proven(&self, proof: &Proof, held: Start) -> Tolerance {
        if held.stands() {
            return self.any_latency(State::Standing);
        }
        Tolerance {
            state: State::Tolerable,
            latency: self.estimator.latencies().get(proof.index).copied(),
        }
    }

    /// Goes on to `now`, and looks how the bodies are to each other unless the ego is on its way sideways: its lines are not
    /// near the ones it had.
    fn look(&mut self, now: f64, lines: Lines, is_near: bool) -> Now {
        let Trajectory {
            along,
            across,
            extents,
            ..
        } = self.recording.trajectory();
        if now < self.now.time {
            self.now.first = [0; 2];
        }
        let [first_along, first_across] = &mut self.now.first;
        while along
            .get(*first_along + 1)
            .is_some_and(|next| next.time <= now)
        {
            *first_along += 1;
        }
        while across
            .get(*first_across + 1)
            .is_some_and(|next| next.time <= now)
        {
            *first_across += 1;
        }
        self.now.time = now;
        if !is_near || self.runs.is_empty() {
            // A proof rests on the runs.
            (self.lines, self.proof) = (Some(lines), None);
            self.runs.clear();
            if is_near {
                let (_, swing) = stand(self.actor, extents, now);
                let swing = swing.map(Swing::on_its_clock);
                derive(across, swing, &lines, &mut self.runs);
            }
        }
        self.now
    }

    /// Whether it is plain that there is no conflict: the actor stays beside the corridor, or it is in it and behind the ego.
    fn is_surely_quiet(&self, ego: &Ego, lines: Lines, now: Now) -> bool {
        let (Some(last), [along, across]) = (self.runs.last(), now.first) else {
            return false;
        };
        let is_behind = |piece: &Along| {
            let (_, swing) = stand(self.actor, &self.recording.trajectory().extents, now.time);
            let reach = lines.reach + swing.map_or(0.0, |swing| swing.at(0.0).along);
            piece.s_at(now.time) - ego.s < -reach
        };
        last.first <= across
            && match last.side {
                Some(Side::Apart) => true,
                Some(_) => {
                    let piece = self.recording.trajectory().along.get(along);
                    piece.is_some_and(is_behind)
                }
                None => false,
            }
    }
}

/// A t_0, and the pieces that hold then, along and across.
#[derive(Clone, Copy, Debug)]
struct Now {
    time: f64,
    first: [usize; 2],
}

impl Now {
    /// A recording as seen from it.
    fn of<'a>(self, recording: &'a Recording, runs: &'a [Run]) -> View<'a> {
        View {
            future: Future::new(recording.trajectory(), self.time),
            first: self.first,
            runs,
            coarse: Some(recording.coarse()),
        }
    }
}

/// Sorts the pieces into runs.
fn derive(pieces: &[Across], swing: Option<Swing<'_>>, lines: &Lines, runs: &mut Vec<Run>) {
    for (first, piece) in pieces.iter().enumerate() {
        let next = pieces.get(first + 1);
        // The first piece reaches back and the last on for ever: only one on which nothing changes there has one relation.
        let rests_before = || swing.is_none_or(|swing| swing.rests_before_it_begins());
        let end = match next {
            Some(next) if first > 0 || (piece.d_rate == 0.0 && rests_before()) => Some(next.time),
            None if piece.d_rate == 0.0 && (first > 0 || rests_before()) => {
                swing.map_or(Some(piece.time), |swing| swing.rests_from())
            }
            _ => None,
        };
        let side = end.and_then(|end| one_side(piece, end.max(piece.time), swing, lines));
        if side.is_none() || runs.last().is_none_or(|run| run.side != side) {
            runs.push(Run { first, side });
        }
    }
}

/// The one relation of an actor on a piece that lasts until `end`.
fn one_side(piece: &Across, end: f64, swing: Option<Swing<'_>>, lines: &Lines) -> Option<Side> {
    let (mut before, mut side, mut one) = (None, None, true);
    for_each_edge(piece, piece.time, end, swing, |d, half| {
        let edges = lines.edges(d, half);
        if let Some(before) = before.replace(edges) {
            let between = lines.side_between(before, edges);
            one &= between.is_some() && side.is_none_or(|side| Some(side) == between);
            side = between;
        }
    });
    side.filter(|_| one)
}

#[cfg(test)]
mod tests;
