//! Cells and runs: every scenario at every rate with every seed, in parallel, in an order of their own.
//!
//! A run is named by (scenario, rates, seed) and draws by name, so neither the number of threads nor the order of the cells can
//! change a bit of it: the map is parallel, its result ordered, every reduction serial.

use rayon::prelude::*;
use zhuyi_core::{ActorId, FrameRates, SimTime};
use zhuyi_estimator::{Estimator, Params};
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::{Draws, Extremes, Frames, Hindsight, Outcome, Peaks, Simulation};
use zhuyi_world::Side;

/// What stays the same over a batch of runs.
#[derive(Clone, Copy, Debug)]
pub struct Experiment<'a> {
    /// The scenarios.
    pub scenarios: &'a [Scenario],
    /// The ego.
    pub system: &'a System,
    /// The root of all randomness.
    pub root_seed: u64,
}

/// The name of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Place of the scenario in the experiment.
    pub scenario: usize,
    /// The rates of the cameras.
    pub rates: FrameRates,
    /// The seed.
    pub seed: u64,
}

/// What one run came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Its name.
    pub cell: Cell,
    /// The first contact; none when the run ended without one.
    pub collision: Option<Collision>,
    /// How close it was.
    pub extremes: Extremes,
    /// Frames of each camera, in the order of the rig.
    pub frames: Vec<Frames>,
    /// The demands of the run, one entry per estimator it was put to; empty when none was or the run collided.
    pub peaks: Vec<Peaks>,
}

/// A contact, in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Collision {
    /// When.
    pub time: SimTime,
    /// Whom.
    pub actor: ActorId,
    /// With which side of the ego.
    pub side: Side,
    /// [m/s] closing speed at the contact.
    pub impact_speed: f64,
    /// [m/s] change of the ego's velocity by the impact.
    pub ego_delta_v: f64,
    /// [m/s] change of the other's velocity by the impact.
    pub other_delta_v: f64,
}

impl Experiment<'_> {
    /// Runs every cell; `estimators` gives those that a cell's run is put to. `done` is called after each run, from any thread.
    pub fn run<'e>(
        &self,
        cells: &[Cell],
        estimators: impl Fn(&Cell) -> &'e [Estimator] + Sync,
        done: impl Fn() + Sync,
    ) -> Vec<Record> {
        let one = |cell: &Cell| {
            let record = self.record(cell, estimators(cell));
            done();
            record
        };
        cells.par_iter().map(one).collect()
    }

    /// Runs one cell.
    pub fn record(&self, cell: &Cell, estimators: &[Estimator]) -> Record {
        let scenario = &self.scenarios[cell.scenario];
        let draws = Draws { root: self.root_seed, scenario: &scenario.name, seed: cell.seed };
        let run = Simulation::new(scenario, self.system, &cell.rates, draws).run();
        let collision = match &run.outcome {
            Outcome::Completed => None,
            Outcome::Collision(c) => Some(Collision {
                time: c.time,
                actor: c.actor,
                side: c.side,
                impact_speed: c.crash.as_ref().map_or(f64::NAN, |crash| crash.impact_speed),
                ego_delta_v: c.crash.as_ref().map_or(f64::NAN, |crash| crash.ego.delta_v),
                other_delta_v: c.crash.as_ref().map_or(f64::NAN, |crash| crash.other.delta_v),
            }),
        };
        let peaks = if collision.is_some() || estimators.is_empty() {
            Vec::new()
        } else {
            let hindsight = Hindsight::new(&run.trace, self.system);
            estimators.iter().map(|estimator| hindsight.peaks(estimator)).collect()
        };
        Record { cell: cell.clone(), collision, extremes: run.extremes(), frames: run.frames, peaks }
    }
}

/// The estimator of a system with other parameters.
pub fn estimator(system: &System, change: impl FnOnce(&mut Params)) -> Estimator {
    let mut params = system.estimator.clone();
    change(&mut params);
    Estimator::new(params)
}

/// The same rate on every camera of a system.
pub fn uniform(system: &System, fps: u32) -> FrameRates {
    FrameRates::new(vec![f64::from(fps); system.perception.eyes.len()])
}
