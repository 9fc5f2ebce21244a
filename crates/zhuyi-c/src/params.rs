//! The estimator's parameters as C sees them. Choices are plain integers, because C may put any number into an enum.

use crate::Status;
use crate::limits::{above, within};

/// How candidate latencies are spaced.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grid {
    /// 1 s down in steps of 33 ms to 43 ms, then 33 ms.
    Ms33 = 0,
    /// k/30 s for k = 30..1.
    Thirtieths = 1,
    /// 1/f s for f = 1..30.
    Fps = 2,
}

/// How the time t_n is searched.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// First t_n in continuous time, in closed form per piece.
    Exact = 0,
    /// The paper's jumps, at most max_steps per latency.
    Paper = 1,
}

/// What counts as safe.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Behind the actor and slower than it at one time t_n, no pass-through up to it.
    Paper = 0,
    /// No contact in the whole horizon, with the braking kept up.
    Standstill = 1,
}

/// How several trajectories of one actor become one latency.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aggregation {
    /// The largest latency that trajectories with at least the share `percentile` of the probability tolerate.
    Percentile = 0,
    /// The smallest latency of all.
    Worst = 1,
    /// The probability-weighted mean.
    Mean = 2,
}

/// Everything the model can be told. Take zhuyi_params_default() and change what you must.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Params {
    /// [-] C1, share of the gap that may be used; in (0, 1].
    pub c1: f64,
    /// [-] C2, share of the actor's speed that the ego may have; in (0, 1].
    pub c2: f64,
    /// [m/s2] C3, least braking of the safety procedure; in (0, 20].
    pub c3: f64,
    /// [-] C4, factor on a braking already under way; in (0, 10].
    pub c4: f64,
    /// [s] how far ahead conflicts count; in [1, 100].
    pub horizon: f64,
    /// [m] lateral margin of the corridor; in [0, 3].
    pub lateral_margin: f64,
    /// [-] share of the probability for ZHUYI_AGGREGATION_PERCENTILE, not looked at otherwise; in (0, 1].
    pub percentile: f64,
    /// K, frames that confirm an actor; in [1, 1000].
    pub confirm_frames: u32,
    /// M, steps of the paper's search for t_n; in [1, 1000].
    pub max_steps: u32,
    /// The latencies tried, a zhuyi_grid.
    pub grid: u32,
    /// The search for t_n, a zhuyi_solver.
    pub solver: u32,
    /// What counts as safe, a zhuyi_criterion.
    pub criterion: u32,
    /// Several trajectories into one, a zhuyi_aggregation.
    pub aggregation: u32,
    /// 1 if a latency is to count as tolerable only where all smaller ones are too, else 0.
    pub cautious: u32,
}

impl Params {
    /// The paper's values.
    pub(crate) fn paper() -> Self {
        let paper = zhuyi_estimator::Params::default();
        let (aggregation, percentile) = match paper.aggregation {
            zhuyi_estimator::Aggregation::Percentile(share) => (Aggregation::Percentile, share),
            zhuyi_estimator::Aggregation::Worst => (Aggregation::Worst, 1.0),
            zhuyi_estimator::Aggregation::Mean => (Aggregation::Mean, 1.0),
        };
        let grid = match paper.grid {
            zhuyi_estimator::Grid::Ms33 => Grid::Ms33,
            zhuyi_estimator::Grid::Thirtieths => Grid::Thirtieths,
            zhuyi_estimator::Grid::Fps => Grid::Fps,
        };
        let solver = match paper.solver {
            zhuyi_estimator::Solver::Exact => Solver::Exact,
            zhuyi_estimator::Solver::Paper => Solver::Paper,
        };
        let criterion = match paper.criterion {
            zhuyi_estimator::Criterion::Paper => Criterion::Paper,
            zhuyi_estimator::Criterion::Standstill => Criterion::Standstill,
        };
        Self {
            c1: paper.c1,
            c2: paper.c2,
            c3: paper.c3,
            c4: paper.c4,
            horizon: paper.horizon,
            lateral_margin: paper.lateral_margin,
            percentile,
            confirm_frames: paper.confirm_frames,
            max_steps: paper.max_steps,
            grid: grid as u32,
            solver: solver as u32,
            criterion: criterion as u32,
            aggregation: aggregation as u32,
            cautious: u32::from(paper.cautious),
        }
    }

    /// The parameters as meant; the ranges are those of scenario files.
    pub(crate) fn meant(&self) -> Result<zhuyi_estimator::Params, Status> {
        Ok(zhuyi_estimator::Params {
            c1: above(self.c1, 0.0, 1.0)?,
            c2: above(self.c2, 0.0, 1.0)?,
            c3: above(self.c3, 0.0, 20.0)?,
            c4: above(self.c4, 0.0, 10.0)?,
            confirm_frames: count(self.confirm_frames)?,
            max_steps: count(self.max_steps)?,
            horizon: within(self.horizon, 1.0, 100.0)?,
            lateral_margin: within(self.lateral_margin, 0.0, 3.0)?,
            grid: match self.grid {
                grid if grid == Grid::Ms33 as u32 => zhuyi_estimator::Grid::Ms33,
                grid if grid == Grid::Thirtieths as u32 => zhuyi_estimator::Grid::Thirtieths,
                grid if grid == Grid::Fps as u32 => zhuyi_estimator::Grid::Fps,
                _ => return Err(Status::OutOfRange),
            },
            solver: match self.solver {
                solver if solver == Solver::Exact as u32 => zhuyi_estimator::Solver::Exact,
                solver if solver == Solver::Paper as u32 => zhuyi_estimator::Solver::Paper,
                _ => return Err(Status::OutOfRange),
            },
            criterion: match self.criterion {
                criterion if criterion == Criterion::Paper as u32 => {
                    zhuyi_estimator::Criterion::Paper
                }
                criterion if criterion == Criterion::Standstill as u32 => {
                    zhuyi_estimator::Criterion::Standstill
                }
                _ => return Err(Status::OutOfRange),
            },
            aggregation: self.aggregation()?,
            cautious: match self.cautious {
                0 => false,
                1 => true,
                _ => return Err(Status::OutOfRange),
            },
            // What goes beyond the paper is off.
            ..zhuyi_estimator::Params::default()
        })
    }

    fn aggregation(&self) -> Result<zhuyi_estimator::Aggregation, Status> {
        match self.aggregation {
            way if way == Aggregation::Percentile as u32 => Ok(
                zhuyi_estimator::Aggregation::Percentile(above(self.percentile, 0.0, 1.0)?),
            ),
            way if way == Aggregation::Worst as u32 => Ok(zhuyi_estimator::Aggregation::Worst),
            way if way == Aggregation::Mean as u32 => Ok(zhuyi_estimator::Aggregation::Mean),
            _ => Err(Status::OutOfRange),
        }
    }
}

fn count(value: u32) -> Result<u32, Status> {
    if (1..=1000).contains(&value) {
        Ok(value)
    } else {
        Err(Status::OutOfRange)
    }
}

#[cfg(test)]
mod tests {
    use super::Params;
    use crate::Status;

    #[test]
    fn law_the_default_there_and_back_is_the_estimators() {
        assert_eq!(
            Params::paper().meant(),
            Ok(zhuyi_estimator::Params::default())
        );
    }

    #[test]
    fn hand_each_parameter_has_its_range() {
        let changed = |change: fn(&mut Params)| {
            let mut params = Params::paper();
            change(&mut params);
            params.meant().err()
        };
        let out = Some(Status::OutOfRange);
        assert_eq!(changed(|p| p.c1 = 0.0), out);
        assert_eq!(changed(|p| p.c2 = 1.1), out);
        assert_eq!(changed(|p| p.c3 = -4.9), out);
        assert_eq!(changed(|p| p.c4 = 0.0), out);
        assert_eq!(changed(|p| p.horizon = 0.5), out);
        assert_eq!(changed(|p| p.lateral_margin = -0.1), out);
        assert_eq!(changed(|p| p.percentile = 0.0), out);
        assert_eq!(changed(|p| p.confirm_frames = 0), out);
        assert_eq!(changed(|p| p.max_steps = u32::MAX), out);
        assert_eq!(changed(|p| p.cautious = 2), out);
        assert_eq!(changed(|p| p.grid = 3), out);
        assert_eq!(changed(|p| p.solver = 2), out);
        assert_eq!(changed(|p| p.criterion = 2), out);
        assert_eq!(changed(|p| p.aggregation = 3), out);
        assert_eq!(changed(|p| p.c1 = f64::NAN), Some(Status::NotFinite));
        // Not looked at when nobody asks for a percentile.
        assert_eq!(changed(|p| (p.aggregation, p.percentile) = (1, 0.0)), None);
    }
}
