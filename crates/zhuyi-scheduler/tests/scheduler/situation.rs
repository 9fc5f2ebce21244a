//! Situations for the tests.

use proptest::prelude::*;
use zhuyi_scheduler::{CameraState, Demands, Policy, PolicyError, Situation};

/// A situation that owns its cameras.
#[derive(Clone, Debug)]
pub struct Scene {
    pub time: f64,
    pub budget: f64,
    pub ego_speed: f64,
    pub cameras: Vec<CameraState<'static>>,
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
    /// Cameras with these demands by every model, and an importance equal to it.
    pub fn asking(demands: &[f64], budget: f64) -> Self {
        let camera = |(name, demand): (&&'static str, &f64)| CameraState {
            name,
            rate: 10.0,
            demands: Demands::all(*demand),
            importance: *demand,
        };
        Self {
            time: 0.0,
            budget,
            ego_speed: 20.0,
            cameras: RIG.iter().zip(demands).map(camera).collect(),
        }
    }

    pub fn rates(&self, policy: &mut dyn Policy) -> Result<Vec<f64>, PolicyError> {
        let situation = Situation {
            time: self.time,
            budget: self.budget,
            ego_speed: self.ego_speed,
            cameras: &self.cameras,
        };
        let mut rates = vec![0.0; self.cameras.len()];
        situation.decided_by(policy, &mut rates).map(|()| rates)
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
    fn any_camera()(
        rate in 0.0..30.0_f64,
        zhuyi in any_demand(),
        phantom in any_demand(),
        rss in any_demand(),
        ttc in any_demand(),
        pylot in any_demand(),
        offline in any_demand(),
        importance in any_demand(),
    ) -> CameraState<'static> {
        CameraState {
            name: "",
            rate,
            demands: Demands { zhuyi, phantom, rss, ttc, pylot, offline: Some(offline) },
            importance,
        }
    }
}

prop_compose! {
    pub fn any_scene()(
        time in 0.0..60.0_f64,
        budget in any_budget(),
        ego_speed in 0.0..40.0_f64,
        mut cameras in prop::collection::vec(any_camera(), 1..=RIG.len()),
    ) -> Scene {
        for (camera, name) in cameras.iter_mut().zip(RIG) {
            camera.name = name;
        }
        Scene { time, budget, ego_speed, cameras }
    }
}
