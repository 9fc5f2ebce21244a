//! How often a model asked for one latency of the grid where another was needed: all of the audit in one table of counts.
//!
//! ```text
//!   short:  asked FPR < needed FPR        shortfall = needed - asked     [FPR], as latencies asked - needed [s]
//!   enough: asked FPR >= needed FPR       excess    = asked - needed     [FPR]
//! ```
//! Counts can be added in any grouping without a change, which sums of floats cannot.

use zhuyi_core::camera::FULL_RATE;
use zhuyi_estimator::grid::fpr;

/// Counts by (latency needed, latency asked for), both as places in the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joint {
    /// [s] the grid, descending.
    grid: Vec<f64>,
    counts: Vec<u64>,
}

/// A figure and how often it came.
type Counted = (f64, u64);

impl Joint {
    /// No counts on this grid of latencies, descending.
    pub fn new(grid: &[f64]) -> Self {
        Self {
            grid: grid.to_vec(),
            counts: vec![0; grid.len() * grid.len()],
        }
    }

    /// Counts one step of one camera.
    ///
    /// # Panics
    /// If a latency is not of the grid.
    pub fn count(&mut self, needed: f64, asked: f64) {
        let place = |latency: f64| {
            let place = self.grid.iter().position(|of_grid| *of_grid == latency);
            place.unwrap_or_else(|| panic!("a latency of the grid, got {latency}"))
        };
        let place = place(needed) * self.grid.len() + place(asked);
        self.counts[place] += 1;
    }

    /// Adds the counts of another on the same grid, or becomes it where there is nothing yet.
    pub fn add(&mut self, other: &Self) {
        if self.grid.is_empty() {
            *self = other.clone();
            return;
        }
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count += more;
        }
    }

    /// (latency needed, latency asked for, count), for all that came.
    fn came(&self) -> impl Iterator<Item = (f64, f64, u64)> {
        let pairs = self
            .grid
            .iter()
            .flat_map(|needed| self.grid.iter().map(move |asked| (*needed, *asked)));
        pairs
            .zip(&self.counts)
            .filter(|(_, count)| **count > 0)
            .map(|((needed, asked), count)| (needed, asked, *count))
    }

    fn least(&self, latency: f64) -> bool {
        self.grid.first() == Some(&latency)
    }

    /// All that was counted.
    pub fn steps(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// How often more than the least was needed: only there a model can fall short.
    pub fn in_need(&self) -> u64 {
        let in_need = self.came().filter(|(needed, ..)| !self.least(*needed));
        in_need.map(|(.., count)| count).sum()
    }

    /// How often less was asked for than was needed.
    pub fn short(&self) -> u64 {
        self.shortfalls().iter().map(|(_, count)| count).sum()
    }

    /// [-] that, as a share of the steps in need; none where there was no need.
    pub fn share_short(&self) -> Option<f64> {
        share(self.short(), self.in_need())
    }

    /// [FPR] by how much, where it was short.
    fn shortfalls(&self) -> Vec<Counted> {
        let short = self.came().filter(|(needed, asked, _)| asked > needed);
        short
            .map(|(needed, asked, count)| (fpr(needed) - fpr(asked), count))
            .collect()
    }

    /// [FPR] the mean shortfall where it was short.
    pub fn mean_shortfall(&self) -> Option<f64> {
        mean(&self.shortfalls())
    }

    /// [FPR] the largest shortfall.
    pub fn largest_shortfall(&self) -> Option<f64> {
        let all = self.shortfalls().into_iter().map(|(by, _)| by);
        all.max_by(f64::total_cmp)
    }

    /// [s] by how much too long the latency was at most.
    pub fn longest_over(&self) -> Option<f64> {
        let short = self.came().filter(|(needed, asked, _)| asked > needed);
        short
            .map(|(needed, asked, _)| asked - needed)
            .max_by(f64::total_cmp)
    }

    /// [FPR] the excess where at least what was needed was asked for, in ascending order: at all steps, or at those in
    /// need alone.
    fn excesses(&self, in_need_alone: bool) -> Vec<Counted> {
        let enough = self.came().filter(|(needed, asked, _)| {
            asked <= needed && !(in_need_alone && self.least(*needed))
        });
        let mut all: Vec<Counted> = enough
            .map(|(needed, asked, count)| (fpr(asked) - fpr(needed), count))
            .collect();
        all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        all
    }

    /// [FPR] the mean excess where it asked for enough.
    pub fn mean_excess(&self, in_need_alone: bool) -> Option<f64> {
        mean(&self.excesses(in_need_alone))
    }

    /// [FPR] the median excess where it asked for enough; of an even number the lower middle one.
    pub fn median_excess(&self, in_need_alone: bool) -> Option<f64> {
        let all = self.excesses(in_need_alone);
        let middle = all.iter().map(|(_, count)| count).sum::<u64>().div_ceil(2);
        let mut so_far = 0;
        all.iter().find_map(|(excess, count)| {
            so_far += count;
            (so_far >= middle).then_some(*excess)
        })
    }

    /// [-] share of all steps at which the highest rate was asked for.
    pub fn share_at_most(&self) -> Option<f64> {
        let at_most = self.came().filter(|(_, asked, _)| fpr(*asked) == FULL_RATE);
        share(at_most.map(|(.., count)| count).sum(), self.steps())
    }

    /// [FPR] the mean of what was asked for over all steps.
    pub fn mean_asked(&self) -> Option<f64> {
        let all: Vec<Counted> = self
            .came()
            .map(|(_, asked, count)| (fpr(asked), count))
            .collect();
        mean(&all)
    }
}

fn mean(all: &[Counted]) -> Option<f64> {
    let count: u64 = all.iter().map(|(_, count)| count).sum();
    let sum: f64 = all.iter().map(|(value, count)| value * *count as f64).sum();
    (count > 0).then(|| sum / count as f64)
}

fn share(part: u64, of: u64) -> Option<f64> {
    (of > 0).then(|| part as f64 / of as f64)
}
