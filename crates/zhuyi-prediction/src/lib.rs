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
use zhuyi_core::stages::Predictor;
use zhuyi_core::{Forecast, Road, Track};

/// Kinematic predictor: motion goes on as it is, in one of several ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum KinematicPredictor {
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

impl KinematicPredictor {
    /// The forecast for one track. Times of its pieces count from the track's `time`.
    pub fn forecast(self, track: &Track, road: &Road) -> Forecast {
        let mut forecast = Forecast {
            actor: track.actor,
            footprint: track.footprint,
            trajectories: Vec::new(),
        };
        self.predict(track, road, &mut forecast);
        forecast
    }
}

impl Predictor for KinematicPredictor {
    /// Takes over the lists of the forecast: where there are as many trajectories as before, it allocates nothing.
    fn predict(&self, track: &Track, road: &Road, forecast: &mut Forecast) {
        let mut ways = Ways::new(&mut forecast.trajectories);
        match self {
            Self::ConstantVelocity => constant::trajectory(track, 0.0, ways.add(1.0)),
            Self::ConstantAcceleration => {
                constant::trajectory(track, track.s_accel, ways.add(1.0));
            }
            Self::LaneChange { threshold } => {
                lane_change::trajectory(track, road, *threshold, ways.add(1.0));
            }
            Self::Manoeuvres(manoeuvres) => {
                manoeuvres::trajectories(track, road, manoeuvres, &mut ways);
            }
        }
        ways.end(track);
    }
}
