//! The best static allocation, found by search: what a designer does who knows the scenarios and no estimate.
//!
//! ```text
//! candidates: one choice per group, sum of n_g f_g <= B, and no group could have its next choice
//! best:       the first candidate of least cost
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | f_g, n_g | rate and number of cameras of group g | Hz, - |
//! | B | budget | Hz |
//!
//! A candidate that leaves room for a higher choice is not tried, as a higher rate is taken not to harm; where it does
//! (non-monotone scenarios), this search does not see it. Costs come from the caller: collisions over scenarios and
//! seeds. Source: Suraksha (ISSRE 2021), which sweeps perception parameters over driving scenarios. Left out: anything
//! faster than trying all; m choices and g groups make about m^(g-1) candidates.

/// [Hz] the candidates, one rate per group each, the rate of the first group falling slowest. `group_sizes` says how
/// many cameras share a rate; `choices` is tried in ascending order.
///
/// Two fronts together and two sides together, 40 frames, choices 1, 5, 15: 2 x 15 leaves 10 for 2 x 5; 2 x 5 leaves 30.
/// With 1 for the fronts the sides could have 15 and the fronts still 5: no candidate.
/// ```
/// use zhuyi_scheduler::search::allocations;
/// assert_eq!(allocations(&[2, 2], &[1.0, 5.0, 15.0], 40.0), [[15.0, 5.0], [5.0, 15.0]]);
/// ```
pub fn allocations(group_sizes: &[usize], choices: &[f64], budget: f64) -> Vec<Vec<f64>> {
    let mut choices = choices.to_vec();
    choices.sort_by(f64::total_cmp);
    choices.dedup();
    let mut search = Search {
        sizes: group_sizes,
        choices: &choices,
        found: Vec::new(),
    };
    if !choices.is_empty() && !group_sizes.is_empty() {
        search.descend(&mut Vec::new(), budget + ROUNDING);
    }
    search.found
}

/// The first of least cost, and its cost. None where there is no candidate, or every cost is incomparable (NaN).
///
/// ```
/// use zhuyi_scheduler::search::best;
/// let candidates = vec![vec![15.0, 5.0], vec![5.0, 15.0]];
/// // Each run at fewer than 10 frames in front collides.
/// let collisions = |rates: &[f64]| if rates[0] < 10.0 { 7 } else { 0 };
/// assert_eq!(best(candidates, collisions), Some((vec![15.0, 5.0], 0)));
/// ```
pub fn best<C: PartialOrd>(
    candidates: impl IntoIterator<Item = Vec<f64>>,
    mut cost: impl FnMut(&[f64]) -> C,
) -> Option<(Vec<f64>, C)> {
    let mut best: Option<(Vec<f64>, C)> = None;
    for rates in candidates {
        let new = cost(&rates);
        let better = best.as_ref().map_or_else(
            || new.partial_cmp(&new).is_some(),
            |(_, least)| new < *least,
        );
        if better {
            best = Some((rates, new));
        }
    }
    best
}

/// [Hz] the rounding of a sum.
const ROUNDING: f64 = 1e-9;

struct Search<'a> {
    sizes: &'a [usize],
    choices: &'a [f64],
    found: Vec<Vec<f64>>,
}

impl Search<'_> {
    fn descend(&mut self, chosen: &mut Vec<usize>, left: f64) {
        let group = chosen.len();
        if group == self.sizes.len() {
            if chosen
                .iter()
                .zip(self.sizes)
                .all(|(c, size)| self.is_stuck(*c, *size, left))
            {
                self.found
                    .push(chosen.iter().map(|c| self.choices[*c]).collect());
            }
            return;
        }
        for choice in (0..self.choices.len()).rev() {
            let rest = left - self.choices[choice] * self.sizes[group] as f64;
            if rest >= 0.0 {
                chosen.push(choice);
                self.descend(chosen, rest);
                chosen.pop();
            }
        }
    }

    /// Whether the group's next choice does not fit into what is left.
    fn is_stuck(&self, choice: usize, size: usize, left: f64) -> bool {
        self.choices
            .get(choice + 1)
            .is_none_or(|next| (next - self.choices[choice]) * size as f64 > left)
    }
}
