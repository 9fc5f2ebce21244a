//! Other models of safe driving behind the face of [`zhuyi_estimator::model`], each asked how late the ego may react.
//!
//! | model | name | looks at | t_r | source |
//! |---|---|---|---|---|
//! | [`Rss`] | `rss` | gaps and speeds at t_0, both axes | the rho with d_min(rho) = d, the larger of both axes | arXiv 1708.06374 |
//! | [`Rss::capped`] | `rss-capped` | the same | the same, speed capped while responding | ad-rss-lib |
//! | [`SafetyForceField`] | `sff` | both braking to standstill | largest onset with claimed sets apart | NVIDIA 2019 |
//! | [`CutInRule`] | `r157-cut-in` | gap, closing speed, lane | TTC - v_rel/12 | UN R157, 5.2.5.2 |
//! | [`CarefulDriver`] | `r157-driver` | the actor going on as it does | latest onset of braking without contact | UN R157, guidance |
//! | [`TtcThreshold`] | `ttc` | gap, closing speed, lane | TTC - 2 s | Hayward 1972 |
//! | [`PylotDeadline`] | `pylot` | the ego's speed | 400 ms - 10 ms per m/s above 10 m/s | ICRA 2021, EuroSys 2022 |
//! | [`VisibilityBudget`] | `visibility` | gap, the ego's speed, lane | (gap - v^2/(2 b)) / v | arXiv 2108.13354 |
//!
//! [`Reaction::latency`](zhuyi_estimator::Reaction::latency) and [`Estimator::by_model`](zhuyi_estimator::Estimator::by_model) turn t_r into
//! a latency by the one model of confirmation. [`cut_in`] plays whole cut-ins, to check three of them against others.
//!
//! **Who is covered.** A model answers for the actors that its source speaks of, and
//! [`Reaction::NotDefined`] for others; [`Direction`] says when an actor comes towards the ego
//! or crosses. A standing actor is an obstacle to all, however it stands; one behind the ego is no danger to any.
//!
//! | model | comes towards the ego | crosses | because |
//! |---|---|---|---|
//! | `rss`, `rss-capped` | defined | not defined | safe distance in opposite directions; who crosses is judged by routes and right of way, which a path does not tell |
//! | `sff` | not defined | not defined | the source claims sets for any motion, this reading for braking along the ego's path alone |
//! | `r157-cut-in` | not defined | not defined | 5.2.5.2 speaks of a vehicle that cuts in, on roads that keep opposite directions apart (1.1) |
//! | `r157-driver` | not defined | not defined | the guidance speaks of cut-in, cut-out and deceleration |
//! | `ttc` | defined | defined | TTC is defined for any two on collision course |
//! | `pylot`, `visibility` | defined | defined | look at the ego's speed and at how far it sees |
//!
//! All brake by 6 m/s2 unless their source says otherwise. What they share is in [`approach`]; what each leaves out
//! stands in its file. All look at the actor as it is at t_0 and none at the rest of its future, as their sources do.
//! [`SafetyModels`] holds one of each.

pub mod approach;
pub mod careful_driver;
pub mod cut_in;
pub mod cut_in_rule;
pub mod pylot;
pub mod rss;
pub mod sff;
pub mod ttc;
pub mod visibility;

mod braking_profile;

pub use approach::{Approach, Direction, Lane};
pub use careful_driver::CarefulDriver;
pub use cut_in_rule::CutInRule;
pub use pylot::PylotDeadline;
pub use rss::Rss;
pub use sff::SafetyForceField;
pub use ttc::TtcThreshold;
pub use visibility::VisibilityBudget;

use zhuyi_estimator::{ActorStart, Future, Reaction, SafetyModel};

/// One of each, by default with default parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafetyModels {
    /// `rss`.
    pub rss: Rss,
    /// `rss-capped`.
    pub rss_capped: Rss,
    /// `sff`.
    pub sff: SafetyForceField,
    /// `r157-cut-in`.
    pub cut_in: CutInRule,
    /// `r157-driver`.
    pub driver: CarefulDriver,
    /// `ttc`.
    pub ttc: TtcThreshold,
    /// `pylot`.
    pub pylot: PylotDeadline,
    /// `visibility`.
    pub visibility: VisibilityBudget,
}

impl Default for SafetyModels {
    fn default() -> Self {
        Self {
            rss: Rss::default(),
            rss_capped: Rss::capped(),
            sff: SafetyForceField::default(),
            cut_in: CutInRule::default(),
            driver: CarefulDriver::default(),
            ttc: TtcThreshold::default(),
            pylot: PylotDeadline::default(),
            visibility: VisibilityBudget::default(),
        }
    }
}

impl SafetyModels {
    /// All of them, in the order of the table.
    ///
    /// ```
    /// use zhuyi_metrics::safety_models::SafetyModels;
    /// let names = SafetyModels::default().all().map(|model| model.name());
    /// let expected =
    ///     ["rss", "rss-capped", "sff", "r157-cut-in", "r157-driver", "ttc", "pylot", "visibility"];
    /// assert_eq!(names, expected);
    /// ```
    pub fn all(&self) -> [&dyn SafetyModel; 8] {
        [
            &self.rss,
            &self.rss_capped,
            &self.sff,
            &self.cut_in,
            &self.driver,
            &self.ttc,
            &self.pylot,
            &self.visibility,
        ]
    }
}

/// The answer of a model that looks at the actor as it is at t_0: none is no danger, as is a future without pieces.
fn at_start(future: &Future<'_>, answer: impl FnOnce(&ActorStart) -> Option<Reaction>) -> Reaction {
    let answer = future.start().and_then(|start| answer(&start));
    answer.unwrap_or(Reaction::NoDanger)
}
