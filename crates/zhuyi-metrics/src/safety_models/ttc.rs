//! Time to collision against a threshold: the ego may wait until the threshold is reached.
//!
//! ```text
//!   t_r = TTC - theta,   TTC = gap / (v_e - v_a)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | theta | threshold, below which a situation is critical | s |
//!
//! No danger where the gap does not close, or the actor is neither in the ego's lane nor enters it before the gap is
//! closed ([`Lane`]). One that crosses leaves the lane again: for it TTC is that of the two boxes with both velocities held
//! ([`on_the_road`]), and it is no danger where they do not meet.
//!
//! Source: TTC: Hayward (1972). 2 s is the TTC from which the competent careful driver of UN R157 takes a cut-in for a
//! risk; studies of conflicts use 1.5 s as well. Left out: everything but the two speeds, so how hard the ego can
//! brake, and that a standing obstacle at 30 m/s needs more than 2 s.

use super::cut_in_rule::within;
use super::{Approach, Direction, Lane, at_start};
use crate::criticality::boxes::on_the_road;
use zhuyi_core::Footprint;
use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};

/// A threshold on TTC.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TtcThreshold {
    /// [s] theta (2).
    pub threshold: f64,
    /// When an actor is in the lane.
    pub lane: Lane,
}

impl Default for TtcThreshold {
    fn default() -> Self {
        Self {
            threshold: 2.0,
            lane: Lane::default(),
        }
    }
}

impl SafetyModel for TtcThreshold {
    fn name(&self) -> &'static str {
        "ttc"
    }

    /// 30 m ahead and 10 m/s slower: 3 - 2 = 1 s.
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint};
    /// # use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};
    /// use zhuyi_metrics::safety_models::TtcThreshold;
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let ego = Ego { s: 0.0, d: 0.0, speed: 20.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 34.0, 10.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// assert_eq!(TtcThreshold::default().reaction(&ego, car, &future), Reaction::Within(1.0));
    /// ```
    fn reaction(&self, ego: &Ego, actor: Footprint, future: &Future<'_>) -> Reaction {
        at_start(future, |start| {
            let approach = Approach::new(ego, future.box_at(actor, 0.0), start);
            if approach.behind {
                return None;
            }
            let collision = if Direction::of(start) == Direction::Crossing {
                on_the_road(ego, actor, future)?
            } else {
                self.lane
                    .time_to_collision(&approach, ego.footprint.width)?
            };
            Some(within(collision - self.threshold))
        })
    }
}
