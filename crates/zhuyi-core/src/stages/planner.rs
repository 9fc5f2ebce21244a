//! Planner: from what the ego knows to a command.

use crate::{Body, Command, Forecast, SimTime, Track};

/// Decides what the ego does in the next step.
///
/// A planner that brakes as soon as anything is tracked ahead:
/// ```
/// use zhuyi_core::stages::Planner;
/// use zhuyi_core::{Body, Command, Forecast, Manoeuvre, SimTime, Track};
///
/// struct Timid;
/// impl Planner for Timid {
///     fn plan(&mut self, _: SimTime, ego: &Body, tracks: &[Track], _: &[Forecast]) -> Command {
///         let ahead = tracks.iter().any(|track| track.rear() > ego.front());
///         let (accel, manoeuvre) = if ahead { (-3.0, Manoeuvre::Brake) } else { (0.0, Manoeuvre::Follow) };
///         Command { accel, curvature: 0.0, manoeuvre }
///     }
/// }
/// ```
pub trait Planner: Send {
    /// Returns the command for the step that begins at `now`. `tracks` are extrapolated to `now`; `forecasts` are theirs, in
    /// the same order, with times counted from `now`.
    fn plan(
        &mut self,
        now: SimTime,
        ego: &Body,
        tracks: &[Track],
        forecasts: &[Forecast],
    ) -> Command;

    /// Limits the planner from now on: drive slower by `slower` [m/s] and keep `longer` [s] more headway than usual; 0 and 0
    /// lift the limits. The safety check calls it (paper, "Zhuyi-based AV system"). A planner without such limits ignores it.
    fn hold_back(&mut self, slower: f64, longer: f64) {
        let _ = (slower, longer);
    }
}
