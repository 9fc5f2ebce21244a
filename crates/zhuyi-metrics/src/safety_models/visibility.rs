//! The visibility budget of RoboRun: the time in which the ego covers what it sees beyond its stopping distance.
//!
//! ```text
//!   t_r = (D - d_stop(v_e)) / v_e,   d_stop(v) = v^2 / (2 b)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | D | visible distance: the gap to the actor | m |
//! | d_stop | stopping distance | m |
//! | b | braking | m/s2 |
//!
//! The actor bounds what is visible if it is ahead and in the ego's lane, or enters it before the gap is closed
//! ([`Lane`]; for one that is not slower, before the ego has covered the gap). Others, and an ego that stands, are no
//! danger.
//!
//! Source: Boroujerdian et al., "RoboRun: A Robot Runtime to Exploit Spatial Heterogeneity" (DAC 2021, arXiv
//! 2108.13354): the deadline of a decision is the longest latency without a collision, and follows from speed and
//! visibility. Its robot is a drone with a stopping distance of its own; here it is a car's, v^2/(2 b). Left out by
//! the model: that the actor moves, so it is strict behind one that drives on and lenient before one that comes closer.

use super::cut_in_rule::within;
use super::{Approach, Lane, at_start};
use zhuyi_core::Footprint;
use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};

/// A budget of time from the distance seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisibilityBudget {
    /// [m/s2] b, braking (6).
    pub decel: f64,
    /// When an actor is in the lane.
    pub lane: Lane,
}

impl Default for VisibilityBudget {
    fn default() -> Self {
        Self {
            decel: 6.0,
            lane: Lane::default(),
        }
    }
}

impl VisibilityBudget {
    /// [s] the budget at `speed` m/s > 0 with `visible` metres in sight; negative when it is spent.
    ///
    /// 18 m/s, 81 m: (81 - 324/12) / 18 = 3 s.
    /// ```
    /// use zhuyi_metrics::safety_models::VisibilityBudget;
    /// assert_eq!(VisibilityBudget::default().at(18.0, 81.0), 3.0);
    /// ```
    pub fn at(&self, speed: f64, visible: f64) -> f64 {
        (visible - speed * speed / (2.0 * self.decel)) / speed
    }
}

impl SafetyModel for VisibilityBudget {
    fn name(&self) -> &'static str {
        "visibility"
    }

    fn reaction(&self, ego: &Ego, actor: Footprint, future: &Future<'_>) -> Reaction {
        at_start(future, |start| {
            let approach = Approach::new(ego, future.box_at(actor, 0.0), start);
            if ego.speed <= 0.0 || approach.gap < 0.0 {
                return None;
            }
            let limit = self.lane.edge_gap(ego.footprint.width);
            let covered = approach.gap / ego.speed;
            let until = approach
                .time_to_collision()
                .map_or(covered, |ttc| ttc.max(covered));
            let entry = approach.time_to_edge_gap(limit)?;
            (entry <= until).then(|| within(self.at(ego.speed, approach.gap)))
        })
    }
}
