//! What a run is: scenario, system, seed, rates and stages, in one value.
//!
//! ```text
//!  RunSpec ──▶ Simulation ──▶ RunRecord
//! ```
//!
//! The same specification gives the same record, to the last bit, whatever else runs beside it.

use std::sync::Arc;

use zhuyi_core::CameraId;
use zhuyi_core::FrameRates;
use zhuyi_core::camera::FULL_RATE;
use zhuyi_core::stages::{Observer, Planner, Predictor, Sensor, Tracker};
use zhuyi_estimator::SafetyModel;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::{MakePolicy, UnknownPolicy, policy_maker};

use crate::draws::Draws;
use crate::stages::{Setup, Stages};

/// Specification of a run.
///
/// A cut-in with every camera at 5 FPR, and with 20 frames per second over all cameras, given where the demand is:
/// ```
/// use zhuyi_core::FrameRates;
/// use zhuyi_scenario::{Source, embedded, load};
/// use zhuyi_sim::RunSpec;
///
/// let scenario = Source::new("cut-in.ron", embedded::scenario("cut-in").unwrap());
/// let (scenario, system) = load(&scenario, &Source::new("system.ron", embedded::system()), &[])?;
/// let spec = RunSpec::new(scenario, system).with_seed(3);
/// let fixed = spec.clone().at_rates(FrameRates::new(vec![5.0; 5])).run()?;
/// let shared = spec.under_policy("demand-first", 20.0)?.run()?;
/// assert!(!fixed.collided() && !shared.collided());
/// assert_eq!(shared.decisions.len(), 300);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RunSpec {
    pub(crate) scenario: Arc<Scenario>,
    pub(crate) system: Arc<System>,
    pub(crate) root_seed: u64,
    pub(crate) seed: u64,
    pub(crate) rates: Rates,
    pub(crate) witnessed: bool,
    pub(crate) traced: bool,
    pub(crate) stages: Stages,
    /// Ids of the demand models that are computed for the caller.
    pub(crate) demand_models: Vec<String>,
    /// [Hz] demands of every decision and camera that follow from the true future; empty where they are not known.
    pub(crate) future: Arc<Vec<Vec<f64>>>,
}

/// Who sets the rates.
#[derive(Clone)]
pub(crate) enum Rates {
    /// Nobody: they stay. Whether the estimate is made beside the run.
    Fixed { rates: FrameRates, estimated: bool },
    /// A policy, with a budget [Hz].
    Policy { policy: MakePolicy, budget: f64 },
    /// The caller, by [`Simulation::act`](crate::Simulation::act), with a budget [Hz].
    Caller { budget: f64 },
}

/// Error of a specification: a budget or a policy that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpecError {
    /// Budget that is not positive and finite.
    #[error("the budget must be positive and finite, got {got} frames per second")]
    Budget {
        /// [Hz] the budget.
        got: f64,
    },
    /// Policy that does not exist.
    #[error(transparent)]
    Policy(#[from] UnknownPolicy),
}

impl RunSpec {
    /// Creates the specification of a run with seed 0, root seed 0, the rates of the system, and the built-in stages.
    pub fn new(scenario: impl Into<Arc<Scenario>>, system: impl Into<Arc<System>>) -> Self {
        let system = system.into();
        Self {
            scenario: scenario.into(),
            root_seed: 0,
            seed: 0,
            rates: Rates::Fixed {
                rates: system.default_rates.clone(),
                estimated: false,
            },
            system,
            witnessed: false,
            traced: true,
            stages: Stages::default(),
            demand_models: Vec::new(),
            future: Arc::default(),
        }
    }

    /// Sets the seed of the run: starts, phases, noise, misses and losses are drawn by it.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Sets the root seed of the experiment, of which the run is one.
    #[must_use]
    pub fn with_root_seed(self, root_seed: u64) -> Self {
        Self { root_seed, ..self }
    }

    /// Sets the frame rate of each camera, in the order of the rig; they stay.
    #[must_use]
    pub fn at_rates(self, rates: FrameRates) -> Self {
        let estimated = matches!(
            self.rates,
            Rates::Fixed {
                estimated: true,
                ..
            }
        );
        Self {
            rates: Rates::Fixed { rates, estimated },
            ..self
        }
    }

    /// Sets one frame rate [Hz] for all cameras, which stays.
    ///
    /// # Panics
    /// If it is not positive and finite.
    #[must_use]
    pub fn at_rate(self, rate: f64) -> Self {
        let cameras = self.system.perception.eyes.len();
        self.at_rates(FrameRates::new(vec![rate; cameras]))
    }

    /// Makes the estimate beside a run at rates that stay (under a policy or a caller it is made anyway), with the alarms and the response of the system's safety check.
    #[must_use]
    pub fn estimated(mut self) -> Self {
        if let Rates::Fixed { estimated, .. } = &mut self.rates {
            *estimated = true;
        }
        self
    }

    /// Lets the policy of this name set the rates under a budget [Hz] of frames per second over all cameras.
    ///
    /// # Errors
    /// If there is no such policy, or the budget is not positive and finite.
    pub fn under_policy(self, name: &str, budget: f64) -> Result<Self, SpecError> {
        self.under(policy_maker(name)?, budget)
    }

    /// Lets a policy set the rates under a budget [Hz]; `make` makes one for each run.
    ///
    /// # Errors
    /// If the budget is not positive and finite.
    pub fn under(self, make: MakePolicy, budget: f64) -> Result<Self, SpecError> {
        let rates = Rates::Policy {
            policy: make,
            budget: checked(budget)?,
        };
        Ok(Self { rates, ..self })
    }

    /// Leaves the rates to the caller, who sets them by [`Simulation::act`](crate::Simulation::act), under a budget [Hz].
    ///
    /// # Errors
    /// If the budget is not positive and finite.
    pub fn under_caller(self, budget: f64) -> Result<Self, SpecError> {
        let budget = checked(budget)?;
        Ok(Self {
            rates: Rates::Caller { budget },
            ..self
        })
    }

    /// Tells the run the [`known_future`](crate::known_future) of another one, from which the demands `offline` are taken; behind its
    /// end its last demands stay.
    #[must_use]
    pub fn with_known_future(self, demands: impl Into<Arc<Vec<Vec<f64>>>>) -> Self {
        Self {
            future: demands.into(),
            ..self
        }
    }

    /// Records what was known at every step: [`RunRecord::witness`](crate::RunRecord::witness).
    #[must_use]
    pub fn witnessed(self) -> Self {
        Self {
            witnessed: true,
            ..self
        }
    }

    /// Leaves the trace out of the record. What is computed from a trace, such as [`Hindsight`](crate::Hindsight), needs one.
    #[must_use]
    pub fn untraced(self) -> Self {
        Self {
            traced: false,
            ..self
        }
    }

    /// Puts another planner in place of the built-in one.
    #[must_use]
    pub fn with_planner<T: Planner + 'static>(
        mut self,
        make: impl Fn(&Setup<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        self.stages.planner = Some(Arc::new(move |setup| Box::new(make(setup))));
        self
    }

    /// Puts another predictor in place of the one that the planner uses.
    #[must_use]
    pub fn with_predictor<T: Predictor + 'static>(
        mut self,
        make: impl Fn(&Setup<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        self.stages.predictor = Some(Arc::new(move |setup| Box::new(make(setup))));
        self
    }

    /// Puts another tracker in place of the built-in one.
    #[must_use]
    pub fn with_tracker<T: Tracker + 'static>(
        mut self,
        make: impl Fn(&Setup<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        self.stages.tracker = Some(Arc::new(move |setup| Box::new(make(setup))));
        self
    }

    /// Puts another sensor in place of a camera. Clock, latency, losses, confirmation, and the field of view and the noise by which the
    /// tracker judges its frames stay that camera's. Detections of one frame are put in the order of the actors; a second one of an
    /// actor, and those of actors that there are not, are dropped.
    ///
    /// # Panics
    /// If the rig has no such camera.
    #[must_use]
    pub fn with_sensor<T: Sensor + 'static>(
        mut self,
        camera: CameraId,
        make: impl Fn(&Setup<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        assert!(
            camera.index() < self.system.perception.eyes.len(),
            "no such camera"
        );
        let make = Arc::new(move |setup: &Setup<'_>| Box::new(make(setup)) as Box<dyn Sensor>);
        self.stages.sensors.push((camera, make));
        self
    }

    /// Adds a safety model as one more demand model, under its own name, for policies and observers that look at it.
    #[must_use]
    pub fn with_safety_model<T: SafetyModel + Send + 'static>(
        mut self,
        make: impl Fn(&Setup<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        let make =
            Arc::new(move |setup: &Setup<'_>| Box::new(make(setup)) as Box<dyn SafetyModel + Send>);
        self.stages.safety_models.push(make);
        self
    }

    /// Computes demands by these [models](crate::demand_models) too, where a policy sets the rates, the caller does, or the estimate is made
    /// beside the run.
    #[must_use]
    pub fn with_demand_models(mut self, models: &[&str]) -> Self {
        let models = models.iter().map(ToString::to_string);
        self.demand_models.extend(models);
        self
    }

    /// Adds an observer.
    #[must_use]
    pub fn with_observer<T: Observer + 'static>(
        mut self,
        make: impl Fn(&Setup<'_>) -> T + Send + Sync + 'static,
    ) -> Self {
        let make = Arc::new(move |setup: &Setup<'_>| Box::new(make(setup)) as Box<dyn Observer>);
        self.stages.observers.push(make);
        self
    }

    /// Returns the scenario.
    pub fn scenario(&self) -> &Arc<Scenario> {
        &self.scenario
    }

    /// Returns the system.
    pub fn system(&self) -> &Arc<System> {
        &self.system
    }

    /// Returns the seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Returns the names of the random streams.
    pub(crate) fn draws(&self) -> Draws<'_> {
        Draws {
            root: self.root_seed,
            scenario: &self.scenario.name,
            seed: self.seed,
        }
    }

    /// Returns what a stage is made from.
    pub(crate) fn setup(&self) -> Setup<'_> {
        Setup {
            scenario: &self.scenario,
            system: &self.system,
            draws: self.draws(),
        }
    }

    /// Returns the rates with which the run begins: those that stay, or a budget in equal parts.
    pub fn first_rates(&self) -> FrameRates {
        match &self.rates {
            Rates::Fixed { rates, .. } => rates.clone(),
            Rates::Policy { budget, .. } | Rates::Caller { budget } => {
                equal_parts(&self.system, *budget)
            }
        }
    }
}

impl std::fmt::Debug for Rates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fixed { rates, estimated } => f
                .debug_struct("Fixed")
                .field("rates", rates)
                .field("estimated", estimated)
                .finish(),
            Self::Policy { policy, budget, .. } => f
                .debug_struct("Policy")
                .field("policy", &policy().name())
                .field("budget", budget)
                .finish(),
            Self::Caller { budget } => f.debug_struct("Caller").field("budget", budget).finish(),
        }
    }
}

fn checked(budget: f64) -> Result<f64, SpecError> {
    if budget.is_finite() && budget > 0.0 {
        Ok(budget)
    } else {
        Err(SpecError::Budget { got: budget })
    }
}

/// Returns a budget [Hz] in equal parts, at most 30 each: the rates before the first decision, which falls before the first step.
pub fn equal_parts(system: &System, budget: f64) -> FrameRates {
    let cameras = system.perception.eyes.len();
    FrameRates::new(vec![(budget / cameras as f64).min(FULL_RATE); cameras])
}
