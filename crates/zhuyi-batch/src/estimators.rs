//! The estimators of the table: the one of reading R21, the other grids of reading R4, and the paper's own solver.

use zhuyi_estimator::{Criterion, Estimator, Grid, Params, Solver};
use zhuyi_scenario::System;

/// A solver on a grid of latencies, under the criterion of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// How t_n is searched.
    pub solver: Solver,
    /// How the latencies are spaced.
    pub grid: Grid,
}

/// The variant that the table's cells, sums and fractions are of (reading R21), the first of [`VARIANTS`].
pub const TABLE: usize = 0;

/// The variant that solves as the paper does on the table's grid, the last of [`VARIANTS`].
pub const PAPER: usize = 3;

/// All of them.
pub const VARIANTS: [Variant; 4] = [
    Variant {
        solver: Solver::Exact,
        grid: Grid::Ms33,
    },
    Variant {
        solver: Solver::Exact,
        grid: Grid::Thirtieths,
    },
    Variant {
        solver: Solver::Exact,
        grid: Grid::Fps,
    },
    Variant {
        solver: Solver::Paper,
        grid: Grid::Ms33,
    },
];

impl Variant {
    /// Its solver as files spell it.
    pub fn solver_name(self) -> &'static str {
        match self.solver {
            Solver::Exact => "exact",
            Solver::Paper => "paper",
        }
    }

    /// Its grid as the reading spells it.
    pub fn grid_name(self) -> &'static str {
        match self.grid {
            Grid::Ms33 => "33ms",
            Grid::Thirtieths => "30ths",
            Grid::Fps => "fps",
        }
    }

    /// The estimator of a system, solving on this grid in this way.
    pub fn estimator(self, system: &System) -> Estimator {
        let Self { solver, grid } = self;
        estimator(system, |params| {
            (params.solver, params.grid, params.criterion) = (solver, grid, Criterion::Paper);
        })
    }
}

/// The estimator of a system with other parameters.
pub fn estimator(system: &System, change: impl FnOnce(&mut Params)) -> Estimator {
    let mut params = system.estimator.clone();
    change(&mut params);
    Estimator::new(params)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_the_places_are_what_they_say() {
        let names = |place: usize| (VARIANTS[place].solver_name(), VARIANTS[place].grid_name());
        assert_eq!(
            (names(TABLE), names(PAPER)),
            (("exact", "33ms"), ("paper", "33ms"))
        );
    }
}
