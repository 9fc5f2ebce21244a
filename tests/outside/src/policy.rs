//! Policy that looks at tracks, not at demands.

use zhuyi::prelude::*;
use zhuyi::stages::{Policy, PolicyError, Situation};

/// Gives all that there is to spare, up to 30 FPR, to the first camera of the rig that has the nearest track before it.
pub struct Nearest;

impl Policy for Nearest {
    fn name(&self) -> &'static str {
        "nearest"
    }

    fn demand_models(&self) -> &[&str] {
        &[]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        let ego = situation.ego;
        let away = |track: &Track| (track.road.s - ego.road.s).hypot(track.road.d - ego.road.d);
        let nearest = situation.tracks.iter();
        let nearest = nearest.min_by(|a, b| away(a).total_cmp(&away(b)));
        rates.fill(situation.floor());
        if let Some(track) = nearest {
            // On a straight road the reference line is the x axis.
            let place = Pose::new(track.road.s, track.road.d, track.turn);
            let covers = |state: &CameraState<'_>| {
                let camera = state.camera;
                camera.covers_box(ego.pose, track.footprint, place)
            };
            if let Some(camera) = situation.cameras.iter().position(covers) {
                let spare = situation.budget - rates.iter().sum::<f64>();
                rates[camera] = (rates[camera] + spare).min(30.0);
            }
        }
        Ok(())
    }
}
