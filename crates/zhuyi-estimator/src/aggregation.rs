//! Several possible futures of one actor become one answer (Eq. 4, reading R13).
//!
//! | aggregation | latency |
//! |---|---|
//! | percentile n | the largest l such that futures with at least n of the probability tolerate l or more |
//! | worst | the smallest |
//! | mean | weighted by probability |
//!
//! Weights are normalised. Before an ego that stands all futures tolerate the largest latency; those in conflict count
//! as the more demanding ones. Futures beyond the grid lie below every latency of it, the unavoidable ones below these;
//! in the mean both count as 1/30 s. Futures with the actor alongside ask for no rate and are left out; if all are,
//! so is the answer.

use crate::estimate::State;
use crate::grid::MAX_LATENCIES;
use crate::{Aggregation, Ego, Estimate, Estimator, Future};
use zhuyi_core::Forecast;
use zhuyi_core::camera::FULL_RATE;

/// The answer for an actor with several futures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForecastEstimate {
    /// The answer. Under the mean its latency lies between those of the grid, and all else is that of the worst
    /// future.
    pub estimate: Estimate,
    /// The future that decided: the place in the forecast of the first one with this answer, under the mean of the
    /// worst one. None for a forecast without futures.
    pub trajectory: Option<usize>,
}

/// Ranks from the least to the most demanding: no conflict, a standing ego, the latencies of the grid, beyond it,
/// unavoidable.
const RANKS: usize = MAX_LATENCIES + 4;

/// Probability and first future of each rank.
#[derive(Clone, Copy, Debug)]
struct Ranked {
    weight: f64,
    first: Option<(usize, Estimate)>,
}

impl Estimator {
    /// The tolerable latency of one actor over all its futures, with `now` on the forecast's clock as t_0, while
    /// the camera runs at `current_latency` (l_0).
    pub fn forecast(
        &self,
        ego: &Ego,
        forecast: &Forecast,
        now: f64,
        current_latency: f64,
    ) -> ForecastEstimate {
        let answer = |trajectory| {
            let future = Future::new(trajectory, now);
            self.trajectory(ego, forecast.footprint, &future, current_latency)
        };
        if let [(_, only)] = forecast.trajectories.as_slice() {
            return ForecastEstimate {
                estimate: answer(only),
                trajectory: Some(0),
            };
        }
        let mut ranks = [Ranked {
            weight: 0.0,
            first: None,
        }; RANKS];
        let mut alongside = None;
        let (mut total, mut latency_sum) = (0.0, 0.0);
        for (place, (weight, trajectory)) in forecast.trajectories.iter().enumerate() {
            let estimate = answer(trajectory);
            let Some(rank) = self.rank(&estimate) else {
                alongside = alongside.or(Some((place, estimate)));
                continue;
            };
            total += weight;
            latency_sum += weight * estimate.latency.unwrap_or(1.0 / FULL_RATE);
            ranks[rank].weight += weight;
            ranks[rank].first = ranks[rank].first.or(Some((place, estimate)));
        }
        let found = match self.params().aggregation {
            Aggregation::Percentile(share) => percentile(&ranks, share * total),
            Aggregation::Worst | Aggregation::Mean => worst(&ranks),
        };
        let Some((place, mut estimate)) = found.or(alongside) else {
            return self.no_future();
        };
        // Futures that agree keep their answer, and so do those of which none tolerates anything.
        let held = |ranks: &[Ranked]| ranks.iter().filter(|ranked| ranked.first.is_some()).count();
        let mixed = held(&ranks[2..]) > 0
            && held(&ranks) > 1
            && held(&ranks[..self.latencies().len() + 2]) > 0;
        if self.params().aggregation == Aggregation::Mean && mixed && total > 0.0 {
            (estimate.state, estimate.latency) = (State::Tolerable, Some(latency_sum / total));
        }
        ForecastEstimate {
            estimate,
            trajectory: Some(place),
        }
    }

    fn rank(&self, estimate: &Estimate) -> Option<usize> {
        let below = self.latencies().len() + 2;
        match (estimate.state, estimate.latency) {
            (State::None, _) => Some(0),
            (State::Standing, _) => Some(1),
            (State::Tolerable, Some(latency)) => Some(
                self.latencies()
                    .iter()
                    .take_while(|l| **l > latency)
                    .count()
                    + 2,
            ),
            (State::Tolerable, None) | (State::BeyondGrid, _) => Some(below),
            (State::Unavoidable, _) => Some(below + 1),
            (State::Alongside, _) => None,
        }
    }

    fn no_future(&self) -> ForecastEstimate {
        let latency = Some(self.largest());
        let estimate = Estimate {
            state: State::None,
            latency,
            t_n: None,
            binding: None,
            extrapolated: 0.0,
        };
        ForecastEstimate {
            estimate,
            trajectory: None,
        }
    }
}

/// The first rank, from the least demanding on, by which `needed` of the probability is reached.
fn percentile(ranks: &[Ranked], needed: f64) -> Option<(usize, Estimate)> {
    let mut reached = 0.0;
    for ranked in ranks {
        reached += ranked.weight;
        // Weights such as 0.99 and 0.01 do not sum to 1 exactly.
        if ranked.first.is_some() && reached >= needed * (1.0 - 1e-12) {
            return ranked.first;
        }
    }
    worst(ranks)
}

fn worst(ranks: &[Ranked]) -> Option<(usize, Estimate)> {
    ranks.iter().rev().find_map(|ranked| ranked.first)
}
