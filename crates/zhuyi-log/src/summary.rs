//! An evaluation in figures.

use zhuyi_core::ActorId;
use zhuyi_estimator::{State, Watch};

use crate::evaluation::Evaluation;
use crate::log::Log;

/// An evaluation in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Steps at which the ego is there.
    pub steps: usize,
    /// Steps at which it is not.
    pub skipped: usize,
    /// Other vehicles that are there at one of these steps.
    pub actors: usize,
    /// Those of them that are missing at a step between their first and their last row.
    pub interrupted: usize,
    /// Answers per state, in the order of [`State::ALL`]: one per step and actor that is there.
    pub states: [usize; State::ALL.len()],
    /// Per camera, in the order of the rig.
    pub peaks: Vec<Peak>,
    /// [Hz] the largest demand of an analysed camera.
    pub largest: f64,
    /// [Hz] the largest sum over the analysed cameras at one step.
    pub sum: f64,
    /// [-] share of all actors' horizons that was extrapolated; none without actors.
    pub extrapolated: Option<f64>,
}

/// A camera's largest demand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// [Hz] the demand.
    pub fpr: f64,
    /// Place in the log of the first step at which somebody asks for so much, and who; none where nobody ever asks for
    /// anything.
    pub asked: Option<(usize, ActorId)>,
}

impl Summary {
    /// The figures, with the estimator's horizon.
    pub fn new(log: &Log, evaluation: &Evaluation, rig: &[Watch<'_>], horizon: f64) -> Self {
        let answers = || evaluation.steps.iter().flat_map(|step| &step.actors);
        let mut met = vec![false; log.vehicles().len()];
        let (mut states, mut extrapolated, mut count) = ([0; State::ALL.len()], 0.0, 0_usize);
        for answer in answers() {
            met[answer.actor.index()] = true;
            states[answer.estimate.state as usize] += 1;
            extrapolated += answer.estimate.extrapolated;
            count += 1;
        }
        let met = || log.vehicles().iter().zip(&met).filter(|(_, met)| **met);
        let mut summary = Self {
            steps: evaluation.steps.len(),
            skipped: evaluation.skipped,
            actors: met().count(),
            interrupted: met().filter(|(vehicle, _)| vehicle.missing() > 0).count(),
            states,
            peaks: (0..rig.len())
                .map(|camera| peak(evaluation, camera))
                .collect(),
            largest: 0.0,
            sum: 0.0,
            extrapolated: (count > 0).then(|| extrapolated / (count as f64 * horizon)),
        };
        for step in &evaluation.steps {
            let analysed = rig.iter().zip(&step.demands);
            let analysed = analysed.filter(|(watch, _)| watch.camera.analysed);
            let sum = analysed.map(|(_, demand)| demand.fpr).sum();
            summary.sum = summary.sum.max(sum);
        }
        summary.largest = summary.highest(rig).map_or(0.0, |(_, peak)| peak.fpr);
        summary
    }

    /// The first analysed camera with the largest demand of all, and that; none where no camera is analysed.
    pub fn highest(&self, rig: &[Watch<'_>]) -> Option<(usize, &Peak)> {
        let mut highest: Option<(usize, &Peak)> = None;
        for (camera, peak) in self.peaks.iter().enumerate() {
            let larger = highest.is_none_or(|(_, known)| peak.fpr > known.fpr);
            if rig[camera].camera.analysed && larger {
                highest = Some((camera, peak));
            }
        }
        highest
    }

    /// Answers of a state.
    pub fn of(&self, state: State) -> usize {
        self.states[state as usize]
    }
}

fn peak(evaluation: &Evaluation, camera: usize) -> Peak {
    let mut peak = Peak {
        fpr: 0.0,
        asked: None,
    };
    for step in &evaluation.steps {
        let demand = &step.demands[camera];
        // The first who asks for the least counts before nobody does.
        if demand.fpr > peak.fpr || (demand.fpr == peak.fpr && peak.asked.is_none()) {
            peak.fpr = demand.fpr;
            peak.asked = demand.actor.map(|actor| (step.step, actor));
        }
    }
    peak
}
