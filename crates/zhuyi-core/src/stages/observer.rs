//! Observer: whatever watches a run, step by step, and changes nothing.

use crate::stages::DemandSeries;
use crate::{Body, Command, Forecast, Scene, SimTime, Track};

/// Watches a run.
///
/// An observer that counts the steps in which the ego knows nobody:
/// ```
/// use zhuyi_core::stages::{Observation, Observer};
/// use zhuyi_core::{Command, Scene};
///
/// #[derive(Default)]
/// struct Alone(u32);
/// impl Observer for Alone {
///     fn step(&mut self, _: &Scene, observation: &Observation<'_>, _: Command) {
///         self.0 += u32::from(observation.tracks.is_empty());
///     }
/// }
/// ```
pub trait Observer: Send {
    /// Called once per step, when its command is decided and before the world moves. `truth` is the true scene, `observation` what
    /// the ego knows of it.
    fn step(&mut self, truth: &Scene, observation: &Observation<'_>, command: Command);
}

/// Knowledge of the ego at one instant, with rates and budget.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation<'a> {
    /// Time of the run.
    pub time: SimTime,
    /// The ego, by its own localisation.
    pub ego: &'a Body,
    /// The confirmed actors, extrapolated to now, in the order of their ids.
    pub tracks: &'a [Track],
    /// Their forecasts, in the same order: those that the planner is given.
    pub forecasts: &'a [Forecast],
    /// Demands on the cameras at the last decision, by model: the paper's (`zhuyi`) first. Empty before the first decision and where
    /// none is estimated.
    pub demands: &'a [DemandSeries],
    /// [Hz] present frame rate of every camera, in the order of the rig.
    pub rates: &'a [f64],
    /// [Hz] frames per second that all cameras together may process; none without a budget.
    pub budget: Option<f64>,
}

impl Observation<'_> {
    /// Returns what of the budget [Hz] the present rates leave; none without a budget.
    pub fn budget_left(&self) -> Option<f64> {
        Some(self.budget? - self.rates.iter().sum::<f64>())
    }

    /// Returns the demand [Hz] on each camera by the paper's model at the last decision, in the order of the rig; empty as
    /// [`Observation::demands`].
    pub fn demand(&self) -> &[f64] {
        self.demands
            .first()
            .map_or(&[], |series| &series.of_cameras)
    }
}
