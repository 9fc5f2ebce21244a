//! Planner that brakes for whatever is ahead.

use zhuyi::prelude::*;
use zhuyi::stages::Planner;

/// Brakes at `decel` [m/s2] as soon as anything is tracked ahead, else keeps its speed; never steers.
pub struct Timid {
    /// [m/s2] how hard it brakes.
    pub decel: f64,
}

impl Planner for Timid {
    fn plan(&mut self, _: SimTime, ego: &Body, tracks: &[Track], _: &[Forecast]) -> Command {
        let ahead = tracks.iter().any(|track| track.rear() > ego.front());
        Command {
            accel: if ahead { -self.decel } else { 0.0 },
            curvature: 0.0,
            manoeuvre: if ahead {
                Manoeuvre::Brake
            } else {
                Manoeuvre::Follow
            },
        }
    }
}
