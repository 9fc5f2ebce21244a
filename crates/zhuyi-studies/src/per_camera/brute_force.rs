//! Every combination of one scenario, trusting nothing.

use rayon::prelude::*;

use super::combinations::Combinations;
use super::searched::Searched;
use super::{Effort, PerCamera, Trial};
use zhuyi_batch::progress::Progress;

/// Every combination of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct BruteForce {
    /// The place of the scenario.
    pub scenario: usize,
    /// Whether each combination collides.
    pub collides: Vec<bool>,
    /// Whether each is safe.
    pub safe: Vec<bool>,
    /// The combinations of the frontier.
    pub frontier: Vec<usize>,
    /// What it took.
    pub effort: Effort,
}

impl BruteForce {
    /// Tries every combination of the scenario at this place.
    pub fn of(plan: &PerCamera, scenario: usize, progress: &dyn Progress) -> Self {
        let all = &plan.combinations;
        progress.start("of all combinations", all.count() as u64);
        let trials: Vec<Trial> = (0..all.count())
            .into_par_iter()
            .map(|combination| {
                let trial = plan.attempt(scenario, combination);
                progress.step();
                trial
            })
            .collect();
        let mut effort = Effort::default();
        for trial in &trials {
            effort.add(*trial);
        }
        let collides: Vec<bool> = trials.iter().map(|trial| trial.collides).collect();
        let safe = all.safe(&collides);
        Self {
            scenario,
            frontier: all.minimal(&safe),
            collides,
            safe,
            effort,
        }
    }

    /// Free, yet below one that collides: what is not monotone.
    pub fn free_but_not_safe(&self) -> Vec<usize> {
        let pairs = self.collides.iter().zip(&self.safe).enumerate();
        pairs
            .filter(|(_, (collides, safe))| !**collides && !**safe)
            .map(|(place, _)| place)
            .collect()
    }

    /// Of how many combinations the search says that they are safe and they are not, or the other way round.
    pub fn differences(&self, searched: &Searched) -> u64 {
        let pairs = self.safe.iter().zip(&searched.safe);
        pairs.filter(|(ours, theirs)| ours != theirs).count() as u64
    }

    /// The rates, and how many combinations collide with a camera at each of them.
    pub fn collisions_by_rate(&self, all: &Combinations, camera: usize) -> Vec<(u32, u32)> {
        let mut counts: Vec<(u32, u32)> = all.tested().iter().map(|rate| (*rate, 0)).collect();
        for (place, collides) in self.collides.iter().enumerate() {
            counts[all.level(place, camera)].1 += u32::from(*collides);
        }
        counts
    }

    /// How many steps of a camera to the next higher rate end all collisions of a combination, and how many begin them.
    pub fn steps(&self, all: &Combinations, camera: usize) -> (u64, u64) {
        let (mut ended, mut begun) = (0, 0);
        for (place, collides) in self.collides.iter().enumerate() {
            if let Some(faster) = all.raised(place, camera) {
                ended += u64::from(*collides && !self.collides[faster]);
                begun += u64::from(!*collides && self.collides[faster]);
            }
        }
        (ended, begun)
    }
}
