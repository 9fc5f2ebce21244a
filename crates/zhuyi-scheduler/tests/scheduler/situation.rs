//! Situations for the tests.

use proptest::prelude::*;
use zhuyi_core::{Body, Camera, Footprint};
use zhuyi_scheduler::demands::{IMPORTANCE, OFFLINE, PHANTOM, PYLOT, RSS, TTC, ZHUYI};
use zhuyi_scheduler::{CameraState, DemandSeries, Policy, PolicyError, Situation};

/// Every demand model of the built-in policies.
pub const MODELS: [&str; 7] = [ZHUYI, PHANTOM, RSS, TTC, PYLOT, IMPORTANCE, OFFLINE];

/// A situation that owns its cameras and demands.
#[derive(Clone, Debug)]
pub struct Scene {
    pub time: f64,
    pub budget: f64,
    pub ego_speed: f64,
    /// [Hz] of each camera.
    pub rates: Vec<f64>,
    pub demands: Vec<DemandSeries>,
}

/// Names of up to eight cameras.
pub const RIG: [&str; 8] = [
    "front_120",
    "front_60",
    "left",
    "right",
    "rear",
    "left_rear",
    "right_rear",
    "roof",
];

impl Scene {
    /// Cameras with these demands by every model.
    pub fn asking(demands: &[f64], budget: f64) -> Self {
        Self {
            time: 0.0,
            budget,
            ego_speed: 20.0,
            rates: vec![10.0; demands.len()],
            demands: MODELS
                .map(|model| DemandSeries::new(model, demands))
                .to_vec(),
        }
    }

    /// The demand of a model on a camera.
    pub fn demand(&mut self, model: &str, camera: usize) -> &mut f64 {
        let series = self.demands.iter_mut().find(|of| of.model == model);
        &mut series.expect("one of the models").of_cameras[camera]
    }

    /// Asks a policy, with room for the rates of so many cameras.
    pub fn decided(&self, policy: &mut dyn Policy, places: usize) -> Result<Vec<f64>, PolicyError> {
        let rig = RIG.map(|name| Camera::new(name, 0.0, 2.0, 80.0));
        let cameras = rig.iter().zip(&self.rates);
        let cameras: Vec<CameraState<'_>> = cameras
            .map(|(camera, rate)| CameraState {
                camera,
                rate: *rate,
            })
            .collect();
        let car = Footprint {
            length: 4.5,
            width: 1.8,
        };
        let situation = Situation {
            scenario: "by hand",
            seed: 0,
            time: self.time,
            budget: self.budget,
            ego: &Body::aligned(car, 0.0, 0.0, self.ego_speed),
            tracks: &[],
            cameras: &cameras,
            demands: &self.demands,
        };
        let mut rates = vec![0.0; places];
        situation.decided_by(policy, &mut rates).map(|()| rates)
    }

    pub fn rates(&self, policy: &mut dyn Policy) -> Result<Vec<f64>, PolicyError> {
        self.decided(policy, self.rates.len())
    }
}

/// Demands as they come: nothing asked for, something, more than there can be; and what should not come but may.
pub fn any_demand() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => Just(1.0),
        4 => 1.0..30.0_f64,
        2 => Just(30.0),
        1 => 0.0..100.0_f64,
        1 => prop_oneof![Just(0.0), Just(1e-300), Just(1e12)],
    ]
}

pub fn any_budget() -> impl Strategy<Value = f64> {
    prop_oneof![6 => 1.0..240.0_f64, 1 => 1e-3..1.0_f64, 1 => 240.0..1e6_f64]
}

prop_compose! {
    pub fn any_scene()(
        time in 0.0..60.0_f64,
        budget in any_budget(),
        ego_speed in 0.0..40.0_f64,
        cameras in prop::collection::vec((0.0..30.0_f64, prop::array::uniform7(any_demand())), 1..=RIG.len()),
    ) -> Scene {
        let of_model = |(place, model): (usize, &str)| {
            let demands: Vec<f64> = cameras.iter().map(|(_, demands)| demands[place]).collect();
            DemandSeries::new(model, demands)
        };
        Scene {
            time,
            budget,
            ego_speed,
            rates: cameras.iter().map(|(rate, _)| *rate).collect(),
            demands: MODELS.into_iter().enumerate().map(of_model).collect(),
        }
    }
}
