//! Predictor: from a track to the possible futures of its actor.

use crate::{Forecast, Road, Track};

/// Predicts where an actor may go.
///
/// A predictor that takes every actor to stop at once:
/// ```
/// use zhuyi_core::stages::Predictor;
/// use zhuyi_core::{Across, Along, Forecast, Road, Track, Trajectory};
///
/// struct Frozen;
/// impl Predictor for Frozen {
///     fn predict(&self, track: &Track, _: &Road, forecast: &mut Forecast) {
///         forecast.trajectories.clear();
///         forecast.trajectories.push((1.0, Trajectory {
///             along: vec![Along::constant_accel(0.0, track.road.s, 0.0, 0.0)],
///             across: vec![Across { time: 0.0, d: track.road.d, d_rate: 0.0 }],
///             extents: Vec::new(),
///             known_until: 0.0,
///         }));
///     }
/// }
/// ```
pub trait Predictor: Send + Sync {
    /// Writes the futures of a track over those in `forecast`, whose lists may be reused; actor and footprint are set by
    /// [`Predictor::predict_all`]. Times count from the track's own time. At least one trajectory, each as
    /// [`Trajectory`](crate::Trajectory) demands.
    fn predict(&self, track: &Track, road: &Road, forecast: &mut Forecast);

    /// Writes the forecasts of all tracks, in their order, over the first of `forecasts`; the rest of that list is room for more.
    fn predict_all(&self, tracks: &[Track], road: &Road, forecasts: &mut Vec<Forecast>) {
        for (place, track) in tracks.iter().enumerate() {
            if forecasts.len() == place {
                forecasts.push(Forecast {
                    actor: track.actor,
                    footprint: track.footprint,
                    trajectories: Vec::new(),
                });
            }
            let forecast = &mut forecasts[place];
            (forecast.actor, forecast.footprint) = (track.actor, track.footprint);
            self.predict(track, road, forecast);
        }
    }
}
