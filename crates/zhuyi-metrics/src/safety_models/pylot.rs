//! Pylot's dynamic deadline: the faster the ego, the sooner the whole pipeline must have answered.
//!
//! ```text
//!   t_r = 0.400 s - 0.010 s x (v_e - 10)   for v_e in m/s, between 0 and 0.400 s
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | v_e | speed of the ego | m/s |
//!
//! Source: Gog et al., "Pylot: A Modular Platform for Exploring Latency-Accuracy Tradeoffs in Autonomous Vehicles"
//! (ICRA 2021) and "D3: A Dynamic Deadline-Driven Approach for Building Autonomous Vehicles" (EuroSys 2022). Below
//! 10 m/s the straight line would grant more than the 400 ms of which it takes off; here it does not. It reaches
//! zero at 50 m/s and stays there: to react at once is always accepted. Left out by the model: the actors. The
//! deadline is the same for every actor, even one that is no danger, so `no danger` is never its answer. Left out
//! here: Pylot's other policies, one of which sets the deadline by the distance to the next obstacle.

use zhuyi_core::Footprint;
use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};

/// A deadline that falls with the ego's speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PylotDeadline {
    /// [s] deadline up to `slow` (0.4).
    pub longest: f64,
    /// [m/s] speed from which on it falls (10).
    pub slow: f64,
    /// [s2/m] by how much per m/s (0.01).
    pub rate: f64,
}

impl Default for PylotDeadline {
    fn default() -> Self {
        Self {
            longest: 0.4,
            slow: 10.0,
            rate: 0.01,
        }
    }
}

impl PylotDeadline {
    /// [s] the deadline at `speed` m/s.
    ///
    /// 25 m/s: 400 - 150 = 250 ms.
    /// ```
    /// use zhuyi_metrics::safety_models::PylotDeadline;
    /// assert_eq!(PylotDeadline::default().at(25.0), 0.25);
    /// assert_eq!(PylotDeadline::default().at(5.0), 0.4);
    /// assert_eq!(PylotDeadline::default().at(60.0), 0.0);
    /// ```
    pub fn at(&self, speed: f64) -> f64 {
        (self.longest - self.rate * (speed - self.slow).max(0.0)).max(0.0)
    }
}

impl SafetyModel for PylotDeadline {
    fn name(&self) -> &'static str {
        "pylot"
    }

    fn reaction(&self, ego: &Ego, _actor: Footprint, _future: &Future<'_>) -> Reaction {
        Reaction::Within(self.at(ego.speed))
    }
}
