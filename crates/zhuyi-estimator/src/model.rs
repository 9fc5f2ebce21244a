//! The face that other safety models share with this one: how late may the ego react to this actor?
//!
//! ```text
//!  ego, actor, future ──▶ SafetyModel::reaction ──▶ t_r ──▶ the same confirmation model, the same grid ──▶ Estimate
//!
//!  l = (t_r + K l_0) / (1 + K)   where that is above l_0
//!  l = t_r                       else
//! ```
//!
//! The first is t_r = l + K (l - l_0) (reading R1) solved for l. A model that knows no latencies, such as RSS, is put
//! to the same use as Zhuyi in this way, and what differs between two answers is the model alone. Where a model sees
//! danger for an ego that stands, the answer is [`State::Standing`] (reading R8b), whatever the model.

use crate::ego_motion::{Start, latency_within, reaction_time};
use crate::{Ego, Estimate, Estimator, Future, State};
use zhuyi_core::Footprint;

/// How late the ego may react to one actor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reaction {
    /// The model sees no danger: any time will do.
    NoDanger,
    /// [s] the largest reaction time that it accepts, t_r >= 0, counted from t_0.
    Within(f64),
    /// Even to react at once is too late.
    TooLate,
    /// The model's source does not speak of such an actor: it has no answer, which is neither that there is danger nor that
    /// there is none.
    NotDefined,
}

impl Reaction {
    /// [s] the largest latency with which a camera that runs at `current_latency` (l_0) reacts in time, if K =
    /// `confirm_frames` confirm an actor; not rounded to a grid. None without danger, when it is too late and where the model is not defined.
    ///
    /// t_r = 0.7 s, l_0 = 0.1 s, K = 5: (0.7 + 0.5) / 6 = 0.2 s. At t_r = 0.05 s nothing is left for confirmation.
    /// ```
    /// use zhuyi_estimator::model::Reaction;
    /// assert!((Reaction::Within(0.7).latency(0.1, 5).unwrap() - 0.2).abs() < 1e-15);
    /// assert_eq!(Reaction::Within(0.05).latency(0.1, 5), Some(0.05));
    /// assert_eq!(Reaction::TooLate.latency(0.1, 5), None);
    /// ```
    pub fn latency(self, current_latency: f64, confirm_frames: u32) -> Option<f64> {
        let Self::Within(reaction) = self else {
            return None;
        };
        Some(latency_within(reaction, current_latency, confirm_frames))
    }
}

/// A model of safe driving that says how late the ego may react. Implementations look at nothing but their
/// arguments and their own parameters, and allocate nothing.
pub trait SafetyModel {
    /// Its short name in tables and files, such as `rss`.
    fn name(&self) -> &'static str;

    /// How late the ego may react to an actor of this footprint on this future, which is seen from t_0.
    fn reaction(&self, ego: &Ego, actor: Footprint, future: &Future<'_>) -> Reaction;
}

impl Estimator {
    /// What another `model` asks for, in the terms of this one: the largest latency of the grid that reacts in time. None
    /// where the model is [not defined](Reaction::NotDefined) for such an actor.
    ///
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint};
    /// use zhuyi_estimator::model::{Reaction, SafetyModel};
    /// use zhuyi_estimator::{Ego, Estimator, Future, Params, State};
    ///
    /// /// Half a second, whatever comes.
    /// struct HalfSecond;
    /// impl SafetyModel for HalfSecond {
    ///     fn name(&self) -> &'static str {
    ///         "half-second"
    ///     }
    ///     fn reaction(&self, _: &Ego, _: Footprint, _: &Future<'_>) -> Reaction {
    ///         Reaction::Within(0.5)
    ///     }
    /// }
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let ego = Ego { s: 0.0, d: 0.0, speed: 10.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 54.0, 0.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// // (0.5 + 5 x 0.1) / 6 = 0.1667 s; the grid has 0.142 s below it.
    /// let estimate = Estimator::new(Params::default()).by_model(&HalfSecond, &ego, car, &future, 0.1).unwrap();
    /// assert_eq!((estimate.state, estimate.latency), (State::Tolerable, Some(0.142)));
    /// ```
    pub fn by_model(
        &self,
        model: &(impl SafetyModel + ?Sized),
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        current_latency: f64,
    ) -> Option<Estimate> {
        let (state, latency) = match model.reaction(ego, actor, future) {
            Reaction::NotDefined => return None,
            Reaction::NoDanger => (State::None, Some(self.largest())),
            _ if Start::new(ego.speed, ego.accel).stands() => {
                (State::Standing, Some(self.largest()))
            }
            Reaction::TooLate => (State::Unavoidable, None),
            Reaction::Within(reaction) => {
                let frames = self.params().confirm_frames;
                let in_time = |latency: &&f64| {
                    reaction_time(**latency, current_latency, frames) <= reaction + ROUNDING
                };
                match self.latencies().iter().find(in_time) {
                    Some(latency) => (State::Tolerable, Some(*latency)),
                    None => (State::BeyondGrid, None),
                }
            }
        };
        Some(Estimate {
            state,
            latency,
            t_n: None,
            binding: None,
            extrapolated: future.extrapolated(self.params().horizon),
        })
    }
}

/// [s] a latency that is in time but for the rounding of t_r is in time.
const ROUNDING: f64 = 1e-12;
