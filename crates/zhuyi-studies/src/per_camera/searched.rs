//! The search, scenario by scenario: the MRF, the frontier, what was checked, and what it took.

use rayon::prelude::*;

use super::combinations::Combinations;
use super::search::Search;
use super::{Effort, PerCamera, Trial};
use zhuyi_batch::mrf::{Mrf, Required, required};
use zhuyi_batch::progress::Progress;

/// What the search came to in one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Searched {
    /// The MRF with the same rate on all cameras.
    pub mrf: Mrf,
    /// The combinations of the frontier.
    pub frontier: Vec<usize>,
    /// The first of its combinations with the smallest sum of rates; none where the frontier is empty.
    pub cheapest: Option<usize>,
    /// Tried and free, yet below one that collides.
    pub free_but_not_safe: Vec<usize>,
    /// The same rate on all cameras, from the highest down to the first that collides.
    pub uniform: Effort,
    /// What settled the frontier.
    pub settled: Effort,
    /// What checked that a higher rate harms nowhere.
    pub checked: Effort,
    /// How many of the checked were taken to be free and collide.
    pub violations: u64,
    /// Whether each combination is taken to be safe.
    pub safe: Vec<bool>,
}

impl Searched {
    /// What it took in all.
    pub fn effort(&self) -> Effort {
        self.uniform.and(self.settled).and(self.checked)
    }
}

/// A scenario under way.
struct UnderWay<'a> {
    search: Search<'a>,
    mrf: Mrf,
    uniform: Effort,
    settled: Effort,
    checked: Effort,
    violations: u64,
}

/// The search in all scenarios: settled side by side, then what is to be checked of all of them in one go.
pub(super) fn all(plan: &PerCamera, progress: &dyn Progress) -> Vec<Searched> {
    progress.start("scenarios searched", plan.scenarios.len() as u64);
    let mut under_way: Vec<UnderWay<'_>> = (0..plan.scenarios.len())
        .into_par_iter()
        .map(|scenario| {
            let begun = UnderWay::begin(plan, scenario);
            progress.step();
            begun
        })
        .collect();
    loop {
        let to_check: Vec<(usize, usize)> = under_way
            .iter()
            .enumerate()
            .flat_map(|(scenario, one)| {
                one.search
                    .to_check()
                    .into_iter()
                    .map(move |c| (scenario, c))
            })
            .collect();
        if to_check.is_empty() {
            break;
        }
        progress.start("combinations checked", to_check.len() as u64);
        let trials: Vec<Trial> = to_check
            .par_iter()
            .map(|(scenario, combination)| {
                let trial = plan.attempt(*scenario, *combination);
                progress.step();
                trial
            })
            .collect();
        for ((scenario, combination), trial) in to_check.into_iter().zip(trials) {
            under_way[scenario].check(combination, trial);
        }
        under_way
            .par_iter_mut()
            .enumerate()
            .for_each(|(scenario, one)| one.settle(plan, scenario));
    }
    under_way.into_iter().map(|one| one.done(plan)).collect()
}

impl<'a> UnderWay<'a> {
    /// The MRF and the first frontier.
    fn begin(plan: &'a PerCamera, scenario: usize) -> Self {
        let all = &plan.combinations;
        let mut search = Search::new(all);
        let mut uniform = Effort::default();
        let collides = search.uniform(&mut |combination| {
            let trial = plan.attempt(scenario, combination);
            uniform.add(trial);
            trial.collides
        });
        let of_level = |(level, rate): (usize, &u32)| {
            let below = collides.is_some_and(|highest| level <= highest);
            (*rate, u32::from(below))
        };
        let verdicts: Vec<_> = all.tested().iter().enumerate().map(of_level).collect();
        let Required { mrf, .. } = required(&verdicts);
        let mut begun = Self {
            search,
            mrf,
            uniform,
            settled: Effort::default(),
            checked: Effort::default(),
            violations: 0,
        };
        begun.settle(plan, scenario);
        begun
    }

    fn settle(&mut self, plan: &PerCamera, scenario: usize) {
        let settled = &mut self.settled;
        self.search.settle(&mut |combination| {
            let trial = plan.attempt(scenario, combination);
            settled.add(trial);
            trial.collides
        });
    }

    fn check(&mut self, combination: usize, trial: Trial) {
        self.checked.add(trial);
        self.violations += u64::from(self.search.note(combination, trial.collides));
    }

    fn done(self, plan: &PerCamera) -> Searched {
        let all = &plan.combinations;
        let frontier = self.search.frontier();
        Searched {
            mrf: self.mrf,
            cheapest: cheapest(all, &frontier),
            frontier,
            free_but_not_safe: self.search.free_but_not_safe(),
            uniform: self.uniform,
            settled: self.settled,
            checked: self.checked,
            violations: self.violations,
            safe: (0..all.count())
                .map(|place| !self.search.is_ruled_out(place))
                .collect(),
        }
    }
}

/// The first with the smallest sum of rates.
fn cheapest(all: &Combinations, frontier: &[usize]) -> Option<usize> {
    frontier.iter().copied().min_by_key(|place| all.sum(*place))
}
