//! What a policy knows when it decides, and what it owes.
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
//! The floor is the rate of a camera that nobody asks anything of (reading R14); below n frames per second not even
//! that is there, and all get the same. Source: the block "Work prioritization" of the paper's section on a
//! Zhuyi-based system, which leaves budget and limits open. Left out: what a change of rates costs.

use crate::error::{PolicyError, RateLimit};
use crate::sharing;
use zhuyi_core::camera::FULL_RATE;

/// [Hz] what rounding may add to each rate.
const ROUNDING: f64 = 1e-9;

/// What a policy knows when it decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Situation<'a> {
    /// [s] time of the decision.
    pub time: f64,
    /// [Hz] frames per second that all cameras together may process.
    pub budget: f64,
    /// [m/s] speed of the ego.
    pub ego_speed: f64,
    /// The cameras, in the order of the rig.
    pub cameras: &'a [CameraState<'a>],
}

/// One camera at the time of the decision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraState<'a> {
    /// Its name in the rig.
    pub name: &'a str,
    /// [Hz] the rate it has now.
    pub rate: f64,
    /// [Hz] what each model asks of it; 1 where nothing is asked for.
    pub demands: Demands,
    /// [Hz] sum of 1/l over the actors that it covers (importance).
    pub importance: f64,
}

/// [Hz] demands by model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demands {
    /// [Hz] the paper's model, from what is perceived and predicted.
    pub zhuyi: f64,
    /// [Hz] the same, or what an actor would ask that stands where no camera looks, whichever is more.
    pub phantom: f64,
    /// [Hz] Responsibility-Sensitive Safety.
    pub rss: f64,
    /// [Hz] time to collision against a threshold.
    pub ttc: f64,
    /// [Hz] Pylot's deadline.
    pub pylot: f64,
    /// [Hz] clairvoyant: the paper's model with the true future, where that is known.
    pub offline: Option<f64>,
}

impl Demands {
    /// The same demand by every model.
    ///
    /// ```
    /// use zhuyi_scheduler::Demands;
    /// assert_eq!(Demands::all(7.0).rss, 7.0);
    /// assert_eq!(Demands::all(7.0).offline, Some(7.0));
    /// ```
    pub const fn all(demand: f64) -> Self {
        Self {
            zhuyi: demand,
            phantom: demand,
            rss: demand,
            ttc: demand,
            pylot: demand,
            offline: Some(demand),
        }
    }
}

impl Situation<'_> {
    /// [Hz] the least that every camera gets, `min(1, budget / cameras)`.
    pub fn floor(&self) -> f64 {
        sharing::floor(self.budget, self.cameras.len())
    }

    /// Lets `policy` decide and checks its answer: the one way by which rates come from a policy into a run.
    ///
    /// A policy that gives more than there is, no number, or no rate to some camera is refused:
    /// ```
    /// use zhuyi_scheduler::{CameraState, Demands, Policy, PolicyError, Situation};
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
    /// let camera = |name| CameraState { name, rate: 5.0, demands: Demands::all(1.0), importance: 0.0 };
    /// let situation = Situation { time: 0.0, budget: 10.0, ego_speed: 20.0, cameras: &[camera("left"), camera("right")] };
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

    /// Checks rates, one per camera in the order of the rig, against the limits, with a slack [Hz] for each camera.
    ///
    /// # Errors
    /// If a rate is not in [floor, 30], or their sum is above the budget.
    pub fn check_rates(&self, rates: &[f64], slack: f64) -> Result<(), RateLimit> {
        let (floor, cap) = (self.floor(), FULL_RATE);
        for (camera, got) in self.cameras.iter().zip(rates) {
            if !(floor - slack..=cap + slack).contains(got) {
                return Err(RateLimit::Range {
                    camera: camera.name.to_string(),
                    got: *got,
                    floor,
                    cap,
                });
            }
        }
        let (sum, budget) = (rates.iter().map(|rate| rate.max(floor)).sum(), self.budget);
        if sum > budget + slack * rates.len() as f64 {
            return Err(RateLimit::Budget { sum, budget });
        }
        Ok(())
    }

    /// Whether a policy can decide at all: every policy asks this first.
    ///
    /// # Errors
    /// If the budget is not positive, a number is not finite, a demand or an importance is negative, or `rates` has
    /// not one place per camera.
    pub fn check(&self, rates: &[f64]) -> Result<(), PolicyError> {
        if rates.len() != self.cameras.len() {
            return Err(PolicyError::Places {
                cameras: self.cameras.len(),
                places: rates.len(),
            });
        }
        if !(self.budget.is_finite() && self.budget > 0.0) {
            return Err(PolicyError::Budget { got: self.budget });
        }
        for (what, got) in [("time", self.time), ("ego's speed", self.ego_speed)] {
            if !got.is_finite() {
                return Err(PolicyError::NotFinite { what, got });
            }
        }
        self.cameras.iter().try_for_each(CameraState::check)
    }

    /// Shares the budget by one demand of every camera, chosen by `of`, as `rule` has it.
    pub(crate) fn share(
        &self,
        rates: &mut [f64],
        of: impl Fn(&Demands) -> f64,
        rule: impl Fn(&[f64], f64) -> Vec<f64>,
    ) -> Result<(), PolicyError> {
        self.check(rates)?;
        rates.copy_from_slice(&rule(&self.demands(of), self.budget));
        Ok(())
    }

    /// [Hz] one demand of every camera, chosen by `of`.
    pub(crate) fn demands(&self, of: impl Fn(&Demands) -> f64) -> Vec<f64> {
        self.cameras.iter().map(|c| of(&c.demands)).collect()
    }
}

impl CameraState<'_> {
    fn check(&self) -> Result<(), PolicyError> {
        let Demands {
            zhuyi,
            phantom,
            rss,
            ttc,
            pylot,
            offline,
        } = self.demands;
        let numbers = [
            ("rate", self.rate),
            ("demand", zhuyi),
            ("demand with phantoms", phantom),
            ("RSS demand", rss),
            ("TTC demand", ttc),
            ("Pylot demand", pylot),
            ("offline demand", offline.unwrap_or(0.0)),
            ("importance", self.importance),
        ];
        match numbers
            .into_iter()
            .find(|(_, got)| !(got.is_finite() && *got >= 0.0))
        {
            None => Ok(()),
            Some((what, got)) => Err(PolicyError::Camera {
                camera: self.name.to_string(),
                what,
                got,
            }),
        }
    }
}

/// Which demands a policy looks at beside the paper's, so that others need not be worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LooksAt {
    /// [`Demands::phantom`].
    pub phantoms: bool,
    /// [`Demands::rss`], [`Demands::ttc`] and [`Demands::pylot`].
    pub rivals: bool,
}

impl LooksAt {
    /// At all of them.
    pub const ALL: Self = Self {
        phantoms: true,
        rivals: true,
    };
    /// At the paper's alone, or at none.
    pub const PAPER: Self = Self {
        phantoms: false,
        rivals: false,
    };
}

/// A way of sharing the budget. One object serves one run: it may remember what was.
pub trait Policy: Send {
    /// The name under which [`crate::policy`] makes it.
    fn name(&self) -> &str;

    /// Which demands it looks at beside the paper's. Those of models that it does not look at may be told as the paper's.
    fn looks_at(&self) -> LooksAt {
        LooksAt::ALL
    }

    /// Fills `rates`, one per camera in the order of the rig. After `Ok` every rate is in [floor, 30] and their sum at most the
    /// budget, which [`Situation::decided_by`] checks.
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
