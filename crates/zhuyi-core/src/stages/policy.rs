//! Policy: from demands and a budget to the frame rates of the cameras.
//!
//! ```text
//! floor <= f_i <= 30 for every camera i,   f_1 + .. + f_n <= B,   floor = min(1, B/n)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f_i | frame rate of camera i, the answer | Hz |
//! | B | budget: frames per second that all cameras together may process | Hz |
//! | n | number of cameras | - |
//!
//! The floor is the rate of a camera without any demand (reading R14); below n frames per second not even that is there, and
//! all get the same. Source: the block "Work prioritization" of the paper's section on a Zhuyi-based system, which leaves
//! budget and limits open. Left out: what a change of rates costs.

use std::error::Error;

use crate::camera::{FULL_RATE, least_rate};
use crate::{Body, Camera, Track};

/// [Hz] largest error of rounding in each rate of a policy or a caller.
pub const ROUNDING: f64 = 1e-9;

/// Id of the demand by the paper's model, from what is perceived and predicted.
pub const ZHUYI: &str = "zhuyi";

/// Shares the budget. One object serves one run: it may remember what was.
///
/// A policy that gives all that there is to spare to the camera that has the nearest track before it:
/// ```
/// use zhuyi_core::stages::{Policy, PolicyError, Situation};
///
/// struct Nearest;
/// impl Policy for Nearest {
///     fn name(&self) -> &str {
///         "nearest"
///     }
///     fn demand_models(&self) -> &[&str] {
///         &[]
///     }
///     fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
///         rates.fill(situation.floor());
///         let gap = |track: &zhuyi_core::Track| (track.road.s - situation.ego.road.s).abs();
///         let nearest = situation.tracks.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
///         let looks_there = |ahead: bool| situation.cameras.iter().position(|c| (c.camera.yaw.abs() < 1.0) == ahead);
///         let spare = situation.budget - rates.iter().sum::<f64>();
///         if let Some(camera) = nearest.and_then(|track| looks_there(track.road.s > situation.ego.road.s)) {
///             rates[camera] = (rates[camera] + spare).min(30.0);
///         }
///         Ok(())
///     }
/// }
/// ```
pub trait Policy: Send {
    /// Returns its name, for files and messages.
    fn name(&self) -> &str;

    /// Returns the ids of the demand models that it looks at, which the simulation computes: the paper's unless it says otherwise.
    fn demand_models(&self) -> &[&str] {
        &[ZHUYI]
    }

    /// Fills `rates` [Hz], one per camera in the order of the rig. After `Ok` every rate is in [floor, 30] and their sum at most
    /// the budget, which [`Situation::decided_by`] checks.
    ///
    /// # Errors
    /// If the situation makes no sense, or the policy has no answer to it.
    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError>;
}

impl std::fmt::Debug for dyn Policy + '_ {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Policy({})", self.name())
    }
}

/// Knowledge of a policy when it decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Situation<'a> {
    /// Name of the scenario.
    pub scenario: &'a str,
    /// Seed of the run.
    pub seed: u64,
    /// [s] time of the decision.
    pub time: f64,
    /// [Hz] frames per second that all cameras together may process.
    pub budget: f64,
    /// The ego, by its own localisation.
    pub ego: &'a Body,
    /// The confirmed actors, extrapolated to now, in the order of their ids.
    pub tracks: &'a [Track],
    /// The cameras, in the order of the rig.
    pub cameras: &'a [CameraState<'a>],
    /// Demands on the cameras, by model.
    pub demands: &'a [DemandSeries],
}

/// One camera at the time of the decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraState<'a> {
    /// Its place in the rig, its field of view and its name.
    pub camera: &'a Camera,
    /// [Hz] the rate it has now.
    pub rate: f64,
}

/// Demands on all cameras by one model.
#[derive(Clone, Debug, PartialEq)]
pub struct DemandSeries {
    /// Id of the model.
    pub model: String,
    /// [Hz] demand on each camera, in the order of the rig; 1 where nothing is demanded.
    pub of_cameras: Vec<f64>,
}

impl DemandSeries {
    /// Creates the demands [Hz] of a model on all cameras, in the order of the rig.
    pub fn new(model: &str, of_cameras: impl Into<Vec<f64>>) -> Self {
        Self {
            model: model.to_string(),
            of_cameras: of_cameras.into(),
        }
    }
}

impl Situation<'_> {
    /// Returns the least [Hz] that every camera gets, `min(1, budget / cameras)`.
    pub fn floor(&self) -> f64 {
        least_rate(self.budget, self.cameras.len())
    }

    /// Returns the demands [Hz] of a model on the cameras, in the order of the rig.
    ///
    /// # Errors
    /// If the run does not compute them: a policy names the models that it looks at.
    pub fn demands(&self, model: &str) -> Result<&[f64], PolicyError> {
        let series = self.demands.iter().find(|series| series.model == model);
        let of_cameras = series.map(|series| series.of_cameras.as_slice());
        of_cameras.ok_or_else(|| PolicyError::NoDemand {
            model: model.to_string(),
            known: self.demands.iter().map(|of| of.model.clone()).collect(),
        })
    }

    /// Lets `policy` decide and checks its answer: the one way by which rates come from a policy into a run.
    ///
    /// A policy that gives more than there is, no number, or no rate to some camera is refused:
    /// ```
    /// use zhuyi_core::stages::{CameraState, Policy, PolicyError, Situation};
    /// use zhuyi_core::{Body, Camera, Footprint};
    ///
    /// struct Greedy;
    /// impl Policy for Greedy {
    ///     fn name(&self) -> &str {
    ///         "greedy"
    ///     }
    ///     fn decide(&mut self, _: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
    ///         rates.fill(30.0);
    ///         Ok(())
    ///     }
    /// }
    /// let (left, right) = (Camera::new("left", 1.6, 2.0, 80.0), Camera::new("right", -1.6, 2.0, 80.0));
    /// let cameras = [&left, &right].map(|camera| CameraState { camera, rate: 5.0 });
    /// let ego = Body::aligned(Footprint { length: 4.5, width: 1.8 }, 0.0, 0.0, 20.0);
    /// let situation = Situation {
    ///     scenario: "cut-in", seed: 0, time: 0.0, budget: 10.0, ego: &ego, tracks: &[], cameras: &cameras, demands: &[],
    /// };
    /// let refused = situation.decided_by(&mut Greedy, &mut [0.0; 2]).unwrap_err();
    /// assert_eq!(refused.to_string(), "`greedy` gives 60 frames per second altogether, with a budget of 10");
    /// ```
    ///
    /// # Errors
    /// If the situation makes no sense, the policy has no answer, or its rates break [`Situation::check_rates`].
    pub fn decided_by(
        &self,
        policy: &mut dyn Policy,
        rates: &mut [f64],
    ) -> Result<(), PolicyError> {
        self.check(rates)?;
        rates.fill(f64::NAN);
        policy.decide(self, rates)?;
        self.check_rates(rates, ROUNDING)
            .map_err(|limit| PolicyError::Rates {
                policy: policy.name().to_string(),
                limit,
            })
    }

    /// Checks rates [Hz], one per camera in the order of the rig, against the limits, with a slack [Hz] for each camera.
    ///
    /// # Errors
    /// If a rate is not in [floor, 30], or their sum is above the budget.
    pub fn check_rates(&self, rates: &[f64], slack: f64) -> Result<(), RateLimit> {
        let cameras = self.cameras.iter().map(|state| state.camera.name.as_str());
        check_rates(cameras, rates, self.budget, slack)
    }

    /// Checks whether a policy can decide at all: every policy does this first.
    ///
    /// # Errors
    /// If the budget is not positive, a number is not finite, a rate or a demand is negative, or `rates` or some demands have not
    /// one place per camera.
    pub fn check(&self, rates: &[f64]) -> Result<(), PolicyError> {
        let cameras = self.cameras.len();
        let lists = self.demands.iter().map(|series| series.of_cameras.len());
        if let Some(places) = std::iter::once(rates.len())
            .chain(lists)
            .find(|places| *places != cameras)
        {
            return Err(PolicyError::Places { cameras, places });
        }
        if !(self.budget.is_finite() && self.budget > 0.0) {
            return Err(PolicyError::Budget { got: self.budget });
        }
        for (what, got) in [("time", self.time), ("ego's speed", self.ego.speed)] {
            if !got.is_finite() {
                return Err(PolicyError::NotFinite { what, got });
            }
        }
        for (place, state) in self.cameras.iter().enumerate() {
            let rate = std::iter::once(("rate", state.rate));
            let series = self.demands.iter();
            let demands = series.map(|series| (series.model.as_str(), series.of_cameras[place]));
            let is_none = |(_, got): &(&str, f64)| !(got.is_finite() && *got >= 0.0);
            if let Some((what, got)) = rate.chain(demands).find(is_none) {
                return Err(PolicyError::Camera {
                    camera: state.camera.name.clone(),
                    what: match what {
                        "rate" => what.to_string(),
                        model => format!("demand by `{model}`"),
                    },
                    got,
                });
            }
        }
        Ok(())
    }
}

/// Checks rates [Hz] of the cameras of these names against the limits under a budget [Hz], with a slack [Hz] for each camera.
///
/// # Errors
/// If a rate is not in [floor, 30], or their sum is above the budget.
pub fn check_rates<'a>(
    cameras: impl Iterator<Item = &'a str>,
    rates: &[f64],
    budget: f64,
    slack: f64,
) -> Result<(), RateLimit> {
    let (floor, cap) = (least_rate(budget, rates.len()), FULL_RATE);
    for (camera, got) in cameras.zip(rates) {
        if !(*got > 0.0 && (floor - slack..=cap + slack).contains(got)) {
            return Err(RateLimit::Range {
                camera: camera.to_string(),
                got: *got,
                floor,
                cap,
            });
        }
    }
    let sum = rates.iter().map(|rate| rate.max(floor)).sum();
    if sum > budget + slack * rates.len() as f64 {
        return Err(RateLimit::Budget { sum, budget });
    }
    Ok(())
}

/// A limit on the rates that a policy gives, broken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RateLimit {
    /// A rate that no camera may have, or none at all.
    #[error("gives `{camera}` {got} frames per second, outside {floor} to {cap}")]
    Range {
        /// The camera.
        camera: String,
        /// [Hz] its rate.
        got: f64,
        /// [Hz] the least.
        floor: f64,
        /// [Hz] the most.
        cap: f64,
    },
    /// More than there is.
    #[error("gives {sum} frames per second altogether, with a budget of {budget}")]
    Budget {
        /// [Hz] sum of the rates, with the least for every camera.
        sum: f64,
        /// [Hz] the budget.
        budget: f64,
    },
}

/// Error of a policy that gives no rates.
#[derive(Debug, thiserror::Error)]
pub enum PolicyError {
    /// A list does not fit the rig.
    #[error("{places} places for the rates of {cameras} cameras")]
    Places {
        /// Cameras of the rig.
        cameras: usize,
        /// Places in the list.
        places: usize,
    },
    /// No budget to share.
    #[error("the budget must be positive and finite, got {got} frames per second")]
    Budget {
        /// [Hz] the budget.
        got: f64,
    },
    /// A number of the situation is none.
    #[error("the {what} must be finite, got {got}")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// [-] what it is, in its own unit.
        got: f64,
    },
    /// A number of one camera is none, or negative.
    #[error("the {what} of the camera `{camera}` must be finite and not negative, got {got}")]
    Camera {
        /// Which camera.
        camera: String,
        /// Which number.
        what: String,
        /// [Hz] what it is.
        got: f64,
    },
    /// The run does not compute the demands of a model.
    #[error("the run has no demands by `{model}`; it has those by {}", known.join(", "))]
    NoDemand {
        /// The model.
        model: String,
        /// The models that there are.
        known: Vec<String>,
    },
    /// A static allocation names a camera that the rig does not have.
    #[error("`{policy}` names the camera `{named}`; the rig has {}", rig.join(", "))]
    NoSuchCamera {
        /// The policy.
        policy: String,
        /// The name that fits no camera.
        named: String,
        /// The names that there are.
        rig: Vec<String>,
    },
    /// The policy's rates break the limits.
    #[error("`{policy}` {limit}")]
    Rates {
        /// The policy.
        policy: String,
        /// The limit that they break.
        limit: RateLimit,
    },
    /// The policy failed in a way of its own.
    #[error(transparent)]
    Failed(#[from] Box<dyn Error + Send + Sync>),
}
