//! What was told of every actor, row after row.

use zhuyi_core::{ActorId, Lane};
use zhuyi_estimator::{Estimator, Playback, Tolerance, Watch};

use super::Hindsight;
use super::covered::Covered;
use crate::trace::Row;

/// The answers at one row after the other, each asked for once per actor and current latency.
pub(super) struct Told<'a> {
    hindsight: &'a Hindsight<'a>,
    estimator: &'a Estimator,
    /// [s] those of the rig, each once.
    latencies: Vec<f64>,
    /// The lane along which the playbacks are.
    lane: Lane,
    /// Actor by actor, for each latency.
    answers: Vec<(Playback<'a>, Option<Tolerance>)>,
}

impl<'a> Told<'a> {
    /// As nobody has been asked yet.
    pub fn by(hindsight: &'a Hindsight<'a>, estimator: &'a Estimator) -> Self {
        let mut latencies: Vec<f64> = Vec::new();
        for watch in &hindsight.rig {
            if !latencies.contains(&watch.current_latency) {
                latencies.push(watch.current_latency);
            }
        }
        let first = hindsight.trace.row(0);
        let lane = hindsight.lane(&first);
        let mut answers = Vec::with_capacity(hindsight.actors() * latencies.len());
        for (recording, body) in hindsight.futures(lane).iter().zip(first.actors) {
            answers.extend(
                latencies
                    .iter()
                    .map(|_| (estimator.playback(recording, body.footprint), None)),
            );
        }
        Self {
            hindsight,
            estimator,
            latencies,
            lane,
            answers,
        }
    }

    /// Goes on along another lane.
    fn change_lane(&mut self, row: &Row<'_>, lane: Lane) {
        self.lane = lane;
        let futures = self.hindsight.futures(lane).iter().zip(row.actors);
        let playbacks = self.answers.chunks_exact_mut(self.latencies.len().max(1));
        for ((recording, body), playbacks) in futures.zip(playbacks) {
            for (playback, _) in playbacks {
                *playback = self.estimator.playback(recording, body.footprint);
            }
        }
    }

    /// Asks about every actor that a camera covers at a row. Returns whether an answer is another one than it was.
    pub fn ask(&mut self, row: &Row<'_>, covered: &Covered) -> bool {
        let (hindsight, evades) = (self.hindsight, self.hindsight.evades(self.estimator));
        let lane = hindsight.lane(row);
        if lane != self.lane {
            self.change_lane(row, lane);
        }
        let (ego, now) = (hindsight.ego_along(row, lane), row.time.seconds());
        let actors = self.answers.chunks_exact_mut(self.latencies.len().max(1));
        let mut changed = false;
        for (actor, answers) in (0..).map(ActorId).zip(actors) {
            let ego = hindsight.ego_before(ego, row, lane, actor);
            for (l_0, (playback, answer)) in self.latencies.iter().zip(answers) {
                let mut rig = hindsight.rig.iter().enumerate();
                let asks = |(place, watch): (usize, &Watch<'_>)| {
                    watch.current_latency == *l_0 && covered.holds(place, actor)
                };
                if !rig.any(asks) {
                    continue;
                }
                let told = if evades {
                    hindsight.estimate(self.estimator, row, actor, *l_0).into()
                } else {
                    playback.tolerance(&ego, now, *l_0)
                };
                changed |= *answer != Some(told);
                *answer = Some(told);
            }
        }
        changed
    }

    /// What was last told of an actor at a current latency of the rig.
    pub fn of(&self, actor: ActorId, current_latency: f64) -> Tolerance {
        let place = self
            .latencies
            .iter()
            .position(|l_0| *l_0 == current_latency);
        let told =
            place.and_then(|place| self.answers[actor.index() * self.latencies.len() + place].1);
        told.unwrap_or_else(|| {
            unreachable!("nobody has asked about {actor:?} at {current_latency} s")
        })
    }
}
