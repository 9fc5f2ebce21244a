//! The second loop: demands ─▶ policy ─▶ rates of the cameras, while driving.
//!
//! ```text
//!  every period:  beliefs ──▶ [online] ──Asked──▶ [policy under a budget] ──rates──▶ cameras (reading R15)
//!  every tick:    the first loop, as without it
//! ```

use zhuyi_core::{FrameRates, SimTime};
use zhuyi_estimator::{Estimator, PhantomParams};
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::{CameraState, Demands, Policy, PolicyError, Situation};

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

/// A run with the estimate, and if wanted the rates, in the loop.
pub struct Scheduled<'a> {
    simulation: Simulation<'a>,
    system: &'a System,
    online: Online<'a>,
    allocation: Option<Allocation>,
    due: SimTime,
    asked: Vec<Asked>,
    /// [Hz] of every decision and camera, where the future is known.
    offline: Vec<Vec<f64>>,
}

/// [Hz] what a finished run of `system` asked of every camera with hindsight, at every decision: the future that the
/// policy `clairvoyant` knows. l_0 is that of the estimate in the loop.
pub fn known_future(trace: &Trace, system: &System, rates: &FrameRates) -> Vec<Vec<f64>> {
    let mut same = system.clone();
    same.current_latency = system.online.current_latency;
    let hindsight = Hindsight::new(trace, &same, rates);
    let estimator = Estimator::new(system.estimator.clone());
    let every = (system.online.period.nanos() / STEP.nanos()).max(1) as usize;
    let rows = trace.rows().step_by(every);
    let demands = rows.map(|row| hindsight.demands(&estimator, &row));
    demands
        .map(|demands| demands.iter().map(|demand| demand.fpr).collect())
        .collect()
}

impl<'a> Scheduled<'a> {
    /// Adds the second loop to a run at its start. Without an allocation the estimate is recorded and rates stay.
    pub fn new(
        simulation: Simulation<'a>,
        scenario: &'a Scenario,
        system: &'a System,
        allocation: Option<Allocation>,
    ) -> Self {
        Self {
            simulation,
            system,
            online: Online::new(system, &scenario.road),
            allocation,
            due: SimTime::ZERO,
            asked: Vec::new(),
            offline: Vec::new(),
        }
    }

    /// Beside the tracks count phantoms; see [`Online::with_phantoms`].
    #[must_use]
    pub fn with_phantoms(mut self, params: PhantomParams) -> Self {
        self.online = self.online.with_phantoms(params);
        self
    }

    /// Tells policies the [`known_future`] of another run; behind its end its last demands stay.
    #[must_use]
    pub fn with_known_future(mut self, offline: Vec<Vec<f64>>) -> Self {
        self.offline = offline;
        self
    }

    /// The run and what was asked for at every decision.
    ///
    /// # Errors
    /// If the policy fails, which only a program of the user's can.
    pub fn run(mut self) -> Result<(Run, Vec<Asked>), PolicyError> {
        let mut contact = None;
        while contact.is_none() && !self.simulation.is_over() {
            self.decide()?;
            contact = self.simulation.tick();
        }
        Ok((self.simulation.finish(contact), self.asked))
    }

    fn decide(&mut self) -> Result<(), PolicyError> {
        let rates = self.simulation.rates();
        let (time, ego, tracks) = self.simulation.beliefs();
        if time < self.due {
            return Ok(());
        }
        self.due += self.system.online.period;
        let speed = ego.speed;
        let asked = self.online.ask(time, ego, tracks, rates);
        if let Some(Allocation { policy, budget }) = &mut self.allocation {
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
                time: time.seconds(),
                budget: *budget,
                ego_speed: speed,
                cameras: &cameras,
            };
            let mut rates = asked.rates.clone();
            policy.decide(&situation, &mut rates)?;
            self.simulation.set_rates(&rates);
        }
        self.asked.push(asked);
        Ok(())
    }
}
