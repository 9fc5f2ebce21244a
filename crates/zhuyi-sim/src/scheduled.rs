//! The second loop: demands ─▶ policy ─▶ rates of the cameras, while driving; and the check on them.
//!
//! ```text
//!  every period:  beliefs ──▶ [online] ──Asked──▶ [policy under a budget] ──rates──▶ cameras (reading R15)
//!                                          │                                  │
//!                                          └────────▶ [safety check] ◀────────┘
//!                                                          └─ alarm ─▶ response: brake, limit functions, raise rates
//!  every tick:    the first loop, as without it
//! ```
//!
//! An alarm is raised by a camera whose rate, as the policy has just set it, is below its demand (the paper, section on a
//! Zhuyi-based system, "Safety check"). The response goes on for `hold` after the last alarm, so that what it mends does
//! not end it at once.

use zhuyi_core::camera::FULL_RATE;
use zhuyi_core::{FrameRates, Road, SimTime};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::safety::{Measures, falls_short};
use zhuyi_scheduler::{CameraState, Demands, Discipline, LooksAt, Policy, PolicyError, Situation};

use crate::draws::Draws;
use crate::offline::Hindsight;
use crate::online::{Asked, Online};
use crate::outcome::Run;
use crate::simulation::{STEP, Simulation};
use crate::trace::Trace;

/// A policy and what it may spend.
pub struct Allocation {
    /// Who decides.
    pub policy: Box<dyn Policy>,
    /// [Hz] frames per second over all cameras.
    pub budget: f64,
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

/// A run with the estimate, and if wanted the rates, in the loop.
pub struct Scheduled<'a> {
    simulation: Simulation<'a>,
    system: &'a System,
    /// Name of the scenario, and the seed.
    run: (&'a str, u64),
    online: Online<'a>,
    allocation: Option<Allocation>,
    due: SimTime,
    asked: Vec<Asked>,
    /// When the last alarm was raised.
    alarm: Option<SimTime>,
    /// [Hz] of every decision and camera, where the future is known.
    offline: Vec<Vec<f64>>,
}

/// [Hz] what a finished run of `system` asked of every camera with hindsight, at every decision: the future that the
/// policy `clairvoyant` knows. l_0 is that of the estimate in the loop.
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
    let every = (system.online.period.nanos() / STEP.nanos()).max(1) as usize;
    let rows = trace.rows().step_by(every);
    let demands = rows.map(|row| hindsight.demands(&estimator, &row));
    demands
        .map(|demands| demands.iter().map(|demand| demand.fpr).collect())
        .collect()
}

/// [Hz] a budget in equal parts, at most 30 each: what policies are told that every camera has before the first
/// decision, which falls before the first tick.
///
/// # Panics
/// If the budget is not positive and finite.
pub fn equal_parts(system: &System, budget: f64) -> FrameRates {
    let cameras = system.perception.eyes.len();
    FrameRates::new(vec![(budget / cameras as f64).min(FULL_RATE); cameras])
}

impl<'a> Scheduled<'a> {
    /// A run in which a policy sets the rates, from its first tick on.
    ///
    /// # Panics
    /// If the budget is not positive and finite, or the system has an accelerator that cannot be.
    pub fn new(
        scenario: &'a Scenario,
        system: &'a System,
        draws: Draws<'_>,
        allocation: Allocation,
    ) -> Self {
        let rates = equal_parts(system, allocation.budget);
        let mut scheduled = Self::watching(scenario, system, &rates, draws);
        let order = Discipline::for_policy(allocation.policy.name());
        scheduled.simulation.set_discipline(order);
        scheduled.online = scheduled.online.looked_at(allocation.policy.looks_at());
        scheduled.allocation = Some(allocation);
        scheduled
    }

    /// A run with the estimate beside it, at rates that stay; alarms and responses as with a policy.
    pub fn watching(
        scenario: &'a Scenario,
        system: &'a System,
        rates: &FrameRates,
        draws: Draws<'_>,
    ) -> Self {
        Self {
            simulation: Simulation::new(scenario, system, rates, draws),
            system,
            run: (&scenario.name, draws.seed),
            online: Online::new(system, &scenario.road).looked_at(LooksAt::PAPER),
            allocation: None,
            due: SimTime::ZERO,
            asked: Vec::new(),
            alarm: None,
            offline: Vec::new(),
        }
    }

    /// Tells policies the [`known_future`] of another run; behind its end its last demands stay.
    #[must_use]
    pub fn with_known_future(mut self, offline: Vec<Vec<f64>>) -> Self {
        self.offline = offline;
        self
    }

    /// The same run, with a record of what it knew.
    #[must_use]
    pub fn witnessed(mut self) -> Self {
        self.simulation = self.simulation.witnessed();
        self
    }

    /// The run and what was asked for at every decision.
    ///
    /// # Errors
    /// If the policy has no answer, or its rates break the limits ([`Situation::decided_by`]).
    pub fn run(mut self) -> Result<(Run, Vec<Asked>), DecisionError> {
        let mut contact = None;
        while contact.is_none() && !self.simulation.is_over() {
            let time = self.simulation.time().seconds();
            self.decide().map_err(|error| DecisionError {
                scenario: self.run.0.to_string(),
                seed: self.run.1,
                time,
                error,
            })?;
            contact = self.simulation.tick();
        }
        Ok((self.simulation.finish(contact), self.asked))
    }

    fn decide(&mut self) -> Result<(), PolicyError> {
        if self.simulation.time() < self.due {
            return Ok(());
        }
        self.due += self.system.online.period;
        let (rates, processed) = (self.simulation.rates(), self.simulation.processed());
        let (time, ego, tracks) = self.simulation.beliefs();
        let speed = ego.speed;
        let mut asked = self.online.ask(time, ego, tracks, rates, &processed);
        let measures = self.measures(time);
        self.allocate(&mut asked, speed, measures)?;
        self.check(&mut asked);
        self.simulation.set_rates(&asked.granted);
        self.simulation
            .set_demands(asked.demands.iter().map(|demand| demand.fpr));
        let measures = self.measures(time);
        self.simulation.take(measures);
        self.asked.push(asked);
        Ok(())
    }

    /// What the response to alarms up to now changes at `time`.
    fn measures(&self, time: SimTime) -> Measures {
        let online = &self.system.online;
        let stands = |raised: SimTime| (time - raised).nanos() as f64 <= online.hold * 1e9;
        let budget = self.allocation.as_ref().map_or(0.0, |a| a.budget);
        online
            .response
            .measures(self.alarm.is_some_and(stands), budget)
    }

    /// Lets the policy set the rates, if there is one.
    fn allocate(
        &mut self,
        asked: &mut Asked,
        ego_speed: f64,
        measures: Measures,
    ) -> Result<(), PolicyError> {
        let Some(Allocation { policy, budget }) = &mut self.allocation else {
            return Ok(());
        };
        let offline = self.offline.get(self.asked.len()).or(self.offline.last());
        let eyes = self.system.perception.eyes.iter().enumerate();
        let cameras: Vec<CameraState<'_>> = eyes
            .map(|(place, eye)| CameraState {
                name: &eye.camera.name,
                rate: asked.rates[place],
                demands: Demands {
                    offline: offline.map(|demands| demands[place]),
                    ..asked.by_model[place]
                },
                importance: asked.importance[place],
            })
            .collect();
        let situation = Situation {
            time: asked.time.seconds(),
            budget: *budget + measures.extra_budget,
            ego_speed,
            cameras: &cameras,
        };
        situation.decided_by(&mut **policy, &mut asked.granted)
    }

    /// Raises the alarms, and the rates where that is the response.
    fn check(&mut self, asked: &mut Asked) {
        let demands: Vec<f64> = asked.demands.iter().map(|demand| demand.fpr).collect();
        let pairs = asked.granted.iter().zip(&demands);
        asked.alarms = pairs
            .map(|(rate, demand)| falls_short(*rate, *demand))
            .collect();
        if asked.alarms.contains(&true) {
            self.alarm = Some(asked.time);
        }
        if let Some(Allocation { budget, .. }) = &self.allocation {
            let response = self.system.online.response;
            asked.granted = response.rates(&asked.granted, &demands, *budget);
        }
    }
}
