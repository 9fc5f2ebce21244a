//! The second loop, where rates change while driving: demands ─▶ policy ─▶ rates of the cameras; and the check on them.
//!
//! ```text
//!  every period:  beliefs ──▶ [online] ──Asked──▶ [policy under a budget] ──rates──▶ cameras (reading R15)
//!                                          │                                  │
//!                                          └────────▶ [safety check] ◀────────┘
//!                                                          └─ alarm ─▶ response: brake, limit functions, raise rates
//!  every step:    the first loop, as without it
//! ```
//!
//! An alarm is raised by a camera whose rate, as the policy has just set it, is below its demand (the paper, section on a
//! Zhuyi-based system, "Safety check"). The response goes on for `hold` after the last alarm, so that what it mends does
//! not end it at once.

use zhuyi_core::stages::policy;
use zhuyi_core::{Body, FrameRates, Road, SimTime, Track};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::System;
use zhuyi_scheduler::safety::{Measures, falls_short};
use zhuyi_scheduler::{CameraState, DemandSeries, Discipline, Policy, PolicyError, Situation};

use crate::offline::Hindsight;
use crate::online::{Asked, Online};
use crate::spec::{Rates, RunSpec};
use crate::trace::Trace;

/// Decides the rates of a run, once every period.
pub(crate) struct Decider {
    online: Online,
    policy: Option<Box<dyn Policy>>,
    /// [Hz] frames per second over all cameras, where they are limited.
    budget: Option<f64>,
    due: SimTime,
    /// The decision that is due, estimated and not concluded.
    open: Option<Asked>,
    /// Whether the caller has set its rates.
    by_caller: bool,
    decisions: Vec<Asked>,
    /// When the last alarm was raised.
    alarm: Option<SimTime>,
    measures: Measures,
}

/// A decision that a policy did not make: when, in which run, and why.
#[derive(Debug, thiserror::Error)]
#[error("{scenario}, seed {seed}, at {time:.3} s: {error}")]
pub struct DecisionError {
    /// The scenario's name.
    pub scenario: String,
    /// The seed of the run.
    pub seed: u64,
    /// [s] time of the decision.
    pub time: f64,
    /// What is wrong; it names the policy.
    #[source]
    pub error: PolicyError,
}

/// What the ego knows when a decision is made.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    pub spec: &'a RunSpec,
    pub time: SimTime,
    pub ego: &'a Body,
    pub tracks: &'a [Track],
}

impl Decider {
    /// Creates the decider of a run; none where rates stay and nothing is estimated.
    pub fn new(spec: &RunSpec) -> Option<Self> {
        let (policy, budget) = match &spec.rates {
            Rates::Fixed {
                estimated: false, ..
            } => return None,
            Rates::Fixed { .. } => (None, None),
            Rates::Policy { policy, budget } => (Some(policy()), Some(*budget)),
            Rates::Caller { budget } => (None, Some(*budget)),
        };
        let mut online = Online::new(spec.system.clone(), spec.scenario.road.clone());
        for model in spec.stages.safety_models(&spec.setup()) {
            online.add(model);
        }
        let asked: Vec<&str> = spec.demand_models.iter().map(String::as_str).collect();
        online = online.by_models(&asked);
        if let Some(policy) = &policy {
            online = online.by_models(policy.demand_models());
        }
        Some(Self {
            online,
            policy,
            budget,
            due: SimTime::ZERO,
            open: None,
            by_caller: false,
            decisions: Vec::new(),
            alarm: None,
            measures: Measures::default(),
        })
    }

    /// Returns the order in which frames queue for an accelerator under the policy, if there is one.
    pub fn discipline(&self) -> Option<Discipline> {
        let policy = self.policy.as_ref()?;
        Some(Discipline::for_policy(policy.name()))
    }

    /// Returns what may be spent now [Hz], if that is limited.
    pub fn budget(&self) -> Option<f64> {
        Some(self.budget? + self.measures.extra_budget)
    }

    /// Returns the demands of the last estimate, by model.
    pub fn demands(&self) -> &[DemandSeries] {
        let last = self.open.as_ref().or(self.decisions.last());
        last.map_or(&[], |asked| &asked.by_model)
    }

    /// Returns whether a backup system brakes.
    pub fn brakes(&self) -> bool {
        self.measures.brake
    }

    /// Returns whether a decision is due at `now`.
    pub fn is_due(&self, now: SimTime) -> bool {
        self.open.is_some() || now >= self.due
    }

    /// Returns whether a decision is estimated and not concluded.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Makes the estimate of the decision that is due.
    pub fn estimate(
        &mut self,
        known: &Known<'_>,
        rates: &[f64],
        processed: impl Iterator<Item = u64>,
    ) {
        self.due += known.spec.system.online.period;
        let future = &known.spec.future;
        let future = future.get(self.decisions.len()).or(future.last());
        let asked = self.online.ask(
            known.time,
            known.ego,
            known.tracks,
            rates.to_vec(),
            &processed.collect::<Vec<_>>(),
            future.map(Vec::as_slice),
        );
        self.measures = self.measures_at(known.time, &known.spec.system);
        self.open = Some(asked);
    }

    /// Takes the rates [Hz] of a caller for the open decision.
    pub fn grant(&mut self, rates: &[f64]) {
        if let Some(asked) = &mut self.open {
            asked.granted.clear();
            asked.granted.extend_from_slice(rates);
            self.by_caller = true;
        }
    }

    /// Lets the policy set the rates of the open decision, if there is a policy and the caller has not set them.
    pub fn decide(&mut self, known: &Known<'_>) -> Result<(), PolicyError> {
        if std::mem::take(&mut self.by_caller) {
            return Ok(());
        }
        let (Some(budget), Some(policy)) = (self.budget(), &mut self.policy) else {
            return Ok(());
        };
        let Some(asked) = &mut self.open else {
            return Ok(());
        };
        let Known { spec, ego, .. } = *known;
        let eyes = spec.system.perception.eyes.iter().zip(&asked.rates);
        let cameras: Vec<CameraState<'_>> = eyes
            .map(|(eye, rate)| CameraState {
                camera: &eye.camera,
                rate: *rate,
            })
            .collect();
        let situation = Situation {
            scenario: &spec.scenario.name,
            seed: spec.seed,
            time: asked.time.seconds(),
            budget,
            ego,
            tracks: known.tracks,
            cameras: &cameras,
            demands: &asked.by_model,
        };
        situation.decided_by(&mut **policy, &mut asked.granted)
    }

    /// Concludes the open decision: raises the alarms, and the rates where that is the response. Returns it with the measures
    /// that are in force from now on.
    ///
    /// # Panics
    /// If none is open.
    pub fn conclude(&mut self, system: &System) -> (&Asked, Measures) {
        let Some(mut asked) = self.open.take() else {
            unreachable!("a decision that is concluded has been estimated")
        };
        let demands: Vec<f64> = asked.demands.iter().map(|demand| demand.fpr).collect();
        let pairs = asked.granted.iter().zip(&demands);
        asked.alarms.clear();
        let alarms = pairs.map(|(rate, demand)| falls_short(*rate, *demand));
        asked.alarms.extend(alarms);
        if asked.alarms.contains(&true) {
            self.alarm = Some(asked.time);
        }
        if let Some(budget) = self.budget {
            let response = system.online.response;
            asked.granted = response.rates(&asked.granted, &demands, budget);
        }
        self.measures = self.measures_at(asked.time, system);
        self.decisions.push(asked);
        let Some(last) = self.decisions.last() else {
            unreachable!("it has just been added")
        };
        (last, self.measures)
    }

    /// Takes all decisions away.
    pub fn take(&mut self) -> Vec<Asked> {
        std::mem::take(&mut self.decisions)
    }

    /// What the response to alarms up to now changes at `time`.
    fn measures_at(&self, time: SimTime, system: &System) -> Measures {
        let online = &system.online;
        let stands = |raised: SimTime| (time - raised).nanos() as f64 <= online.hold * 1e9;
        let budget = self.budget.unwrap_or(0.0);
        online
            .response
            .measures(self.alarm.is_some_and(stands), budget)
    }
}

/// Checks rates of a caller against the limits of a policy, and a budget [Hz] where there is one.
pub(crate) fn check_rates(
    known: &Known<'_>,
    rates: &[f64],
    budget: Option<f64>,
) -> Result<(), PolicyError> {
    let budget = budget.unwrap_or(f64::INFINITY);
    let eyes = &known.spec.system.perception.eyes;
    if rates.len() != eyes.len() {
        return Err(PolicyError::Places {
            cameras: eyes.len(),
            places: rates.len(),
        });
    }
    let names = eyes.iter().map(|eye| eye.camera.name.as_str());
    policy::check_rates(names, rates, budget, policy::ROUNDING).map_err(|limit| {
        PolicyError::Rates {
            policy: "the caller".to_string(),
            limit,
        }
    })
}

/// Returns the demands [Hz] that a finished run of `system` made on every camera with hindsight, at every decision: the future that the
/// policy `clairvoyant` knows. l_0 is that of the estimate in the loop.
///
/// # Panics
/// If the trace is empty.
pub fn known_future(
    trace: &Trace,
    road: &Road,
    system: &System,
    rates: &FrameRates,
) -> Vec<Vec<f64>> {
    let mut same = system.clone();
    same.current_latency = system.online.current_latency;
    let hindsight = Hindsight::new(trace, road, &same, rates);
    let estimator = Estimator::new(system.estimator.clone());
    let mut due = SimTime::ZERO;
    let rows = trace.rows().filter(|row| {
        let decides = row.time >= due;
        if decides {
            due += system.online.period;
        }
        decides
    });
    let demands = rows.map(|row| hindsight.demands(&estimator, &row));
    demands
        .map(|demands| demands.iter().map(|demand| demand.fpr).collect())
        .collect()
}
