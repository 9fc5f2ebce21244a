//! Demand first, with demands that rise at once and fall late, so that rates do not flutter.
//!
//! ```text
//! d >= (1 - b) h:                  h' = max(h, d), and the waiting starts anew
//! d <  (1 - b) h for H seconds:    h' = the largest d seen while waiting
//! f_i = demand_first(h, B)_i
//! ```
//!
//! | symbol | meaning | unit | here |
//! |---|---|---|---|
//! | d, h | demand of the paper's model, demand held | Hz | |
//! | b | band: a demand within it below h counts as h | - | 0.2 |
//! | H | how long a demand stays below before h falls | s | 1 |
//!
//! A rate that rises late can cost a collision, one that falls late costs frames: only the second is delayed. The
//! floor of 1 FPR per camera is that of all policies. Source: our own; a change of rate costs a frame that is thrown
//! away or waits (reading R15). Left out: changes of the budget, which act at once.

use crate::demands;
use crate::policies::entry::Entry;
use crate::sharing;
use crate::{Policy, PolicyError, Situation};

/// Its entry among the [policies](super::POLICIES).
pub(super) const ENTRY: Entry = Entry {
    id: "demand-hysteresis",
    meaning: "demand first; a demand that falls is kept for a second",
    source: "our own",
    make: |_| Ok(Box::new(Hysteresis::default())),
};

/// Demand first, falling late.
#[derive(Clone, Debug, PartialEq)]
pub struct Hysteresis {
    /// [-] b, the share by which a demand must fall to count as lower (0.2).
    pub band: f64,
    /// [s] H, how long it must have done so (1).
    pub hold: f64,
    held: Vec<Held>,
}

/// What is remembered of one camera.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Held {
    demand: f64,
    waiting: Option<Waiting>,
}

/// A demand that has been lower for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Waiting {
    since: f64,
    largest: f64,
}

impl Default for Hysteresis {
    fn default() -> Self {
        Self::new(0.2, 1.0)
    }
}

impl Hysteresis {
    /// With another band [-] and holding time [s].
    pub const fn new(band: f64, hold: f64) -> Self {
        Self {
            band,
            hold,
            held: Vec::new(),
        }
    }
}

impl Held {
    fn follow(&mut self, demand: f64, time: f64, band: f64, hold: f64) {
        if demand >= (1.0 - band) * self.demand {
            self.demand = self.demand.max(demand);
            self.waiting = None;
            return;
        }
        let waiting = self.waiting.get_or_insert(Waiting {
            since: time,
            largest: demand,
        });
        waiting.largest = waiting.largest.max(demand);
        if time - waiting.since >= hold {
            self.demand = waiting.largest;
            self.waiting = None;
        }
    }
}

impl Policy for Hysteresis {
    fn name(&self) -> &'static str {
        "demand-hysteresis"
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        situation.check(rates)?;
        let demands = situation.demands(demands::ZHUYI)?;
        if self.held.len() != demands.len() {
            // The first decision, or another rig: nothing to remember.
            let fresh = demands.iter().map(|&demand| Held {
                demand,
                waiting: None,
            });
            self.held = fresh.collect();
        }
        for (held, demand) in self.held.iter_mut().zip(demands.iter().copied()) {
            held.follow(demand, situation.time, self.band, self.hold);
        }
        let held: Vec<f64> = self.held.iter().map(|held| held.demand).collect();
        rates.copy_from_slice(&sharing::demand_first(&held, situation.budget));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Hz] the demand held after each of `(time, demand)`.
    fn held(steps: &[(f64, f64)]) -> Vec<f64> {
        let mut held = Held {
            demand: steps[0].1,
            waiting: None,
        };
        let follow = |&(time, demand): &(f64, f64)| {
            held.follow(demand, time, 0.2, 1.0);
            held.demand
        };
        steps.iter().map(follow).collect()
    }

    #[test]
    fn hand_a_demand_rises_at_once_and_falls_after_a_second() {
        let steps = [(0.0, 4.0), (0.1, 10.0), (0.2, 2.0), (1.1, 3.0), (1.2, 2.0)];
        // Lower since 0.2 s; at 1.2 s it falls to the largest of 2, 3, 2.
        assert_eq!(held(&steps), [4.0, 10.0, 10.0, 10.0, 3.0]);
    }

    #[test]
    fn hand_a_flutter_inside_the_band_changes_nothing_and_ends_the_waiting() {
        // 8 is 0.8 x 10 and counts as 10, so the second of waiting starts anew at 1.0 s.
        let steps = [
            (0.0, 10.0),
            (0.1, 8.0),
            (0.2, 7.0),
            (0.9, 8.0),
            (1.0, 7.0),
            (1.9, 7.0),
            (2.0, 7.0),
        ];
        assert_eq!(held(&steps), [10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 7.0]);
    }
}
