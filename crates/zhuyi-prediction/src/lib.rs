//! What others may do: constant velocity, constant acceleration, lane change.
//!
//! ```text
//!  Track ──▶ [predictor] ──▶ Forecast, times counted from the track's own time
//! ```
//!
//! Nothing is learned and nobody reacts to anybody: the three are the kinematic predictors of the field (survey: Lefèvre,
//! Vasquez, Laugier, ROBOMECH Journal 1:1, 2014). Each gives one trajectory, which has the whole probability; several
//! with probabilities come from [`Manoeuvres`].

mod constant;
mod lane_change;
mod manoeuvres;
mod ways;

pub use manoeuvres::Manoeuvres;

use ways::Ways;
use zhuyi_core::{Forecast, Road, Track};

/// Which predictor the ego uses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Predictor {
    /// Speeds along and across the road stay as they are.
    ConstantVelocity,
    /// The acceleration along the road stays as it is, until standstill; the lateral speed stays.
    ConstantAcceleration,
    /// Constant acceleration along the road; a lateral speed above `threshold` is a change to the next lane on that
    /// side, at that speed and then held; below it the actor keeps its offset.
    LaneChange {
        /// [m/s] lateral speed that counts as the beginning of a lane change.
        threshold: f64,
    },
    /// Several of the above with probabilities.
    Manoeuvres(Manoeuvres),
}

impl Predictor {
    /// The forecast for one track. Times of its pieces count from the track's `time`.
    pub fn forecast(self, track: &Track, road: &Road) -> Forecast {
        let mut forecast = Forecast {
            actor: track.actor,
            footprint: track.footprint,
            trajectories: Vec::new(),
        };
        self.forecast_into(track, road, &mut forecast);
        forecast
    }

    /// The same in place of another forecast, whose lists it takes over: where there are as many trajectories as before,
    /// it allocates nothing.
    pub fn forecast_into(self, track: &Track, road: &Road, forecast: &mut Forecast) {
        (forecast.actor, forecast.footprint) = (track.actor, track.footprint);
        let mut ways = Ways::new(&mut forecast.trajectories);
        match self {
            Self::ConstantVelocity => constant::trajectory(track, 0.0, ways.add(1.0)),
            Self::ConstantAcceleration => {
                constant::trajectory(track, track.s_accel, ways.add(1.0));
            }
            Self::LaneChange { threshold } => {
                lane_change::trajectory(track, road, threshold, ways.add(1.0));
            }
            Self::Manoeuvres(manoeuvres) => {
                manoeuvres::trajectories(track, road, &manoeuvres, &mut ways);
            }
        }
        ways.end(track);
    }
}
