//! The offline estimate of a recording: at every step of the ego the answer for every actor that is there, and the
//! demand on every camera (readings R12 and R14).
//!
//! An actor counts for every camera that has some of its box in field of view and range at t_0, from the ego's
//! recorded centre and heading; occlusion is ignored. l_0 is that camera's own, so an actor in view of several cameras
//! may have several answers: the most demanding one is told. Actors that no camera covers are told too, at the l_0 of
//! the fastest camera, and ask nothing of any camera.
//!
//! What others call critical is computed on the way where it is wanted: the future of an actor behind the ego is made
//! for one t_0, and not twice.

use zhuyi_core::ActorId;
use zhuyi_estimator::{Demand, Estimate, Estimator, Future, Watch};
use zhuyi_metrics::criticality::{Criticality, Limits, criticality};

use crate::replay::{Actor, Moment, Replay};

/// What an ego's recording asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// The ego.
    pub ego: ActorId,
    /// Every step at which it is there, in the order of time.
    pub steps: Vec<Answers>,
    /// Steps at which it is not.
    pub skipped: usize,
}

/// The answers of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// Place of the step in the log.
    pub step: usize,
    /// Every other vehicle that is there, in the order of the log.
    pub actors: Vec<Answer>,
    /// One per camera, in the order of the rig.
    pub demands: Vec<Demand>,
}

/// The answer for one actor at one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Which.
    pub actor: ActorId,
    /// Its most demanding answer.
    pub estimate: Estimate,
    /// Places in the rig of the cameras that cover it.
    pub cameras: Vec<usize>,
    /// What others call critical, where it was asked for.
    pub criticality: Option<Criticality>,
}

/// Evaluates all steps of a replay for a rig, which has a camera.
pub fn evaluate(replay: &Replay<'_>, estimator: &Estimator, rig: &[Watch<'_>]) -> Evaluation {
    all_steps(replay, estimator, rig, None)
}

/// The same with every actor's criticality.
pub fn evaluate_with_criticality(
    replay: &Replay<'_>,
    estimator: &Estimator,
    rig: &[Watch<'_>],
    limits: &Limits,
) -> Evaluation {
    all_steps(replay, estimator, rig, Some(limits))
}

fn all_steps(
    replay: &Replay<'_>,
    estimator: &Estimator,
    rig: &[Watch<'_>],
    limits: Option<&Limits>,
) -> Evaluation {
    let steps: Vec<Answers> = replay
        .moments()
        .map(|moment| answers(&moment, estimator, rig, limits))
        .collect();
    Evaluation {
        ego: replay.ego(),
        skipped: replay.log().steps().len() - steps.len(),
        steps,
    }
}

fn answers(
    moment: &Moment<'_>,
    estimator: &Estimator,
    rig: &[Watch<'_>],
    limits: Option<&Limits>,
) -> Answers {
    let mut actors = Vec::with_capacity(moment.actors.len());
    // Per actor the answers at the current latencies of its cameras, for the demands.
    let mut all: Vec<(ActorId, f64, Estimate)> = Vec::new();
    for actor in &moment.actors {
        let cameras: Vec<usize> = (0..rig.len())
            .filter(|place| rig[*place].camera.covers_body(moment.pose, &actor.body))
            .collect();
        let from = all.len();
        for latency in latencies(rig, &cameras) {
            if !all[from..].iter().any(|(_, known, _)| *known == latency) {
                let estimate = estimate(moment, actor, estimator, latency);
                all.push((actor.id, latency, estimate));
            }
        }
        let own = all[from..].iter().map(|(_, _, estimate)| *estimate);
        if let Some(estimate) = own.min_by(Estimate::by_importance) {
            let future = Future::new(actor.future.trajectory(), moment.time);
            actors.push(Answer {
                actor: actor.id,
                estimate,
                cameras,
                criticality: limits
                    .map(|limits| criticality(&moment.ego, actor.body.footprint, &future, limits)),
            });
        }
    }
    let bodies = moment.actors.iter().map(|actor| (actor.id, &actor.body));
    let demands = estimator.demands(rig, moment.pose, bodies, |actor, latency| {
        let of_this =
            |(id, known, _): &&(ActorId, f64, Estimate)| *id == actor && *known == latency;
        match all.iter().find(of_this) {
            Some((_, _, estimate)) => *estimate,
            None => unreachable!("every covering camera has been asked"),
        }
    });
    Answers {
        step: moment.step,
        actors,
        demands,
    }
}

/// [s] the current latencies at which an actor in view of these cameras is asked about.
fn latencies(rig: &[Watch<'_>], cameras: &[usize]) -> Vec<f64> {
    if cameras.is_empty() {
        let all = rig.iter().map(|watch| watch.current_latency);
        return all.reduce(f64::min).into_iter().collect();
    }
    cameras
        .iter()
        .map(|place| rig[*place].current_latency)
        .collect()
}

fn estimate(
    moment: &Moment<'_>,
    actor: &Actor<'_>,
    estimator: &Estimator,
    current_latency: f64,
) -> Estimate {
    estimator.recorded(
        &moment.ego,
        actor.body.footprint,
        &actor.future,
        moment.time,
        current_latency,
    )
}
