//! The estimator's parameters, with the paper's values as [`Params::default`] (paper, "Zhuyi model parameters"; readings R1-R14).
//! What goes beyond the paper is an option, and off.

use crate::{Evasion, Uncertainty};

/// How candidate latencies are spaced (reading R4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Grid {
    /// 1 s down in steps of 33 ms to 43 ms, then 33 ms; at most 30 FPR.
    #[default]
    Ms33,
    /// k/30 s for k = 30..1.
    Thirtieths,
    /// 1/f s for f = 1..30.
    Fps,
}

/// How the time t_n is searched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// First t_n in continuous time, in closed form per piece.
    #[default]
    Exact,
    /// The paper's jumps by Eq. 3, at most M per latency (reading R11).
    Paper,
}

/// What counts as safe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Criterion {
    /// Both constraints at one t_n, no pass-through up to it (readings R5, R6).
    #[default]
    Paper,
    /// No contact at any conflict time in the horizon, with the braking kept up.
    Standstill,
}

/// How several trajectories of one actor become one latency (reading R13).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aggregation {
    /// The largest latency that trajectories with at least this share of the probability tolerate; in (0, 1].
    Percentile(f64),
    /// The smallest latency of all.
    Worst,
    /// The probability-weighted mean.
    Mean,
}

/// Everything the model can be told.
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// [-] C1, share of the gap that may be used.
    pub c1: f64,
    /// [-] C2, share of the actor's speed that the ego may have.
    pub c2: f64,
    /// [m/s2] C3, least braking of the safety procedure.
    pub c3: f64,
    /// [-] C4, factor on a braking already under way.
    pub c4: f64,
    /// [-] K, frames that confirm an actor.
    pub confirm_frames: u32,
    /// M, steps of the paper's search for t_n.
    pub max_steps: u32,
    /// [s] how far ahead conflicts count (20 s, reading R8).
    pub horizon: f64,
    /// [m] lateral margin of the corridor (0.2 m, reading R7).
    pub lateral_margin: f64,
    /// The latencies tried.
    pub grid: Grid,
    /// The search for t_n.
    pub solver: Solver,
    /// What counts as safe.
    pub criterion: Criterion,
    /// Several trajectories into one.
    pub aggregation: Aggregation,
    /// Whether a latency counts as tolerable only if all smaller ones of the grid are tolerable too. It makes a
    /// difference where a larger latency may be tolerable while a smaller one is not: with the jumps of
    /// [`Solver::Paper`], and where C4 < 1 lets the procedure brake less than the ego does already.
    pub cautious: bool,
    /// Beyond the paper: how uncertain actors are; none: what is perceived is taken as exact.
    pub uncertainty: Option<Uncertainty>,
    /// Beyond the paper: how the ego may evade, for [`Estimator::evading`](crate::Estimator::evading) alone; none: it brakes.
    pub evasion: Option<Evasion>,
}

impl Params {
    /// Whether t_n is searched by jumps, which may miss it.
    pub(crate) fn jumps(&self) -> bool {
        self.criterion == Criterion::Paper && self.solver == Solver::Paper
    }
}

impl Default for Params {
    fn default() -> Self {
        Self {
            c1: 0.9,
            c2: 0.9,
            c3: 4.9,
            c4: 1.1,
            confirm_frames: 5,
            max_steps: 10,
            horizon: 20.0,
            lateral_margin: 0.2,
            grid: Grid::default(),
            solver: Solver::default(),
            criterion: Criterion::default(),
            aggregation: Aggregation::Percentile(0.99),
            cautious: false,
            uncertainty: None,
            evasion: None,
        }
    }
}
