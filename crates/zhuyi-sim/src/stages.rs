//! The stages of a run: built in, or others in their place.
//!
//! | stage | trait | built in |
//! |---|---|---|
//! | sensor of a mount | [`Sensor`] | [`CameraSensor`](zhuyi_perception::CameraSensor) |
//! | tracker | [`Tracker`] | [`KalmanTracker`] |
//! | predictor | [`Predictor`] | [`KinematicPredictor`](zhuyi_prediction::KinematicPredictor) |
//! | planner | [`Planner`] | [`RuleBasedPlanner`] |
//! | safety models | [`SafetyModel`] | those of the estimator |
//! | observers | [`Observer`] | - |
//!
//! A [`RunSpec`](crate::RunSpec) keeps a function per stage, which makes a new one for each run: runs share nothing.

use std::sync::Arc;

use rand_chacha::ChaCha8Rng;
use zhuyi_core::CameraId;
use zhuyi_core::stages::{Observer, Planner, Predictor, Sensor, Tracker};
use zhuyi_estimator::SafetyModel;
use zhuyi_perception::KalmanTracker;
use zhuyi_planner::RuleBasedPlanner;
use zhuyi_scenario::{Scenario, System};

use crate::draws::Draws;

/// Function that makes a stage for one run.
pub type Make<T> = Arc<dyn Fn(&Setup<'_>) -> Box<T> + Send + Sync>;

/// What a stage is made from.
#[derive(Clone, Copy, Debug)]
pub struct Setup<'a> {
    /// The scenario, without its truth while driving.
    pub scenario: &'a Scenario,
    /// The system.
    pub system: &'a System,
    /// Names the random streams of the run.
    pub draws: Draws<'a>,
}

impl Setup<'_> {
    /// Returns the run's own random stream of this name, such as `noise of radar`; the same at every frame rate (reading R18).
    pub fn stream(&self, purpose: &str) -> ChaCha8Rng {
        self.draws.stream(purpose)
    }
}

/// The stages that are not the built-in ones.
#[derive(Clone, Default)]
pub(crate) struct Stages {
    pub sensors: Vec<(CameraId, Make<dyn Sensor>)>,
    pub tracker: Option<Make<dyn Tracker>>,
    pub predictor: Option<Make<dyn Predictor>>,
    pub planner: Option<Make<dyn Planner>>,
    pub observers: Vec<Make<dyn Observer>>,
    pub safety_models: Vec<Make<dyn SafetyModel + Send>>,
}

impl Stages {
    pub fn tracker(&self, setup: &Setup<'_>) -> Box<dyn Tracker> {
        if let Some(make) = &self.tracker {
            return make(setup);
        }
        let (perception, actors) = (&setup.system.perception, setup.scenario.actors.len());
        Box::new(KalmanTracker::new(perception, actors))
    }

    pub fn predictor(&self, setup: &Setup<'_>) -> Box<dyn Predictor> {
        match &self.predictor {
            Some(make) => make(setup),
            None => Box::new(setup.system.predictor),
        }
    }

    pub fn planner(&self, setup: &Setup<'_>) -> Box<dyn Planner> {
        if let Some(make) = &self.planner {
            return make(setup);
        }
        let Scenario { road, ego, .. } = setup.scenario;
        let params = &setup.system.planner;
        let planner = RuleBasedPlanner::new(params, road.clone(), ego.lane, ego.speed);
        Box::new(planner)
    }

    pub fn safety_models(&self, setup: &Setup<'_>) -> Vec<Box<dyn SafetyModel + Send>> {
        self.safety_models.iter().map(|make| make(setup)).collect()
    }

    pub fn observers(&self, setup: &Setup<'_>) -> Vec<Box<dyn Observer>> {
        self.observers.iter().map(|make| make(setup)).collect()
    }
}

impl std::fmt::Debug for Stages {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stages")
            .field("sensors", &self.sensors.len())
            .field("tracker", &self.tracker.is_some())
            .field("predictor", &self.predictor.is_some())
            .field("planner", &self.planner.is_some())
            .field("safety_models", &self.safety_models.len())
            .field("observers", &self.observers.len())
            .finish()
    }
}
