//! Cells and runs: every scenario at every rate with every seed, in parallel, in an order of their own.
//!
//! A run is named by (scenario, rates, seed) and draws by name, so neither the number of threads nor the order of the cells can
//! change a bit of it: the map is parallel, its result ordered, every reduction serial.

use std::ops::Range;

use rayon::prelude::*;
use zhuyi_core::camera::Mounted;
use zhuyi_core::{ActorId, Axes, FrameRates, SimTime};
use zhuyi_estimator::Estimator;
use zhuyi_perception::Eye;
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::starts::{Crowded, starts};
use zhuyi_sim::trace::{Row, Trace};
use zhuyi_sim::{Draws, Extremes, Frames, Hindsight, Outcome, Peaks, RunRecord, RunSpec};
use zhuyi_world::{Progress, Side, Start};

pub use crate::estimators::estimator;
use crate::manoeuvres::began;
use crate::parallel::one_by_one;
pub use crate::rates::uniform;

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
    /// When it ended.
    pub end: SimTime,
    /// How close it was.
    pub extremes: Extremes,
    /// How far each manoeuvre came: actor after actor, in the order of their scripts.
    pub manoeuvres: Vec<Progress>,
    /// Frames of each camera, in the order of the rig.
    pub frames: Vec<Frames>,
    /// Whether each camera ever had an actor in view, looked at every [`GLANCE`].
    pub active: Vec<bool>,
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
    /// Whether it was struck from behind: by an actor that closed in on the rear half of its box.
    pub from_behind: bool,
    /// Whether the ego had confirmed the actor by then.
    pub confirmed: bool,
    /// What it did to both; none where the crash solver has refused the state of a body.
    pub impact: Option<Impact>,
}

/// The kind of a contact, as far as frames go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contact {
    /// Whether the ego was struck from behind.
    pub from_behind: bool,
    /// Whether it had confirmed the actor by then.
    pub confirmed: bool,
}

/// A crash, in figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// [m/s] closing speed at the contact.
    pub speed: f64,
    /// [m/s] change of the ego's velocity by the impact.
    pub ego_delta_v: f64,
    /// [m/s] change of the other's velocity by the impact.
    pub other_delta_v: f64,
}

/// How many rows of a trace apart cameras are asked whether they are active: 0.1 s.
pub const GLANCE: usize = 10;

/// Every scenario of `scenarios` at every one of `rates` with every one of `seeds`; scenarios outermost, seeds innermost.
pub fn grid(scenarios: usize, rates: &[FrameRates], seeds: Range<u64>) -> Vec<Cell> {
    let mut cells = Vec::new();
    for scenario in 0..scenarios {
        for rates in rates {
            cells.extend(seeds.clone().map(|seed| Cell {
                scenario,
                rates: rates.clone(),
                seed,
            }));
        }
    }
    cells
}

impl Experiment<'_> {
    /// Runs every cell, in parallel; the records stand in the order of the cells. `estimators` gives those that a cell's run is
    /// put to. `done` is called after each run, from any thread.
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
        one_by_one(cells).map(one).collect()
    }

    /// Whether the run of a cell collides, and nothing else about it.
    pub fn collides(&self, cell: &Cell) -> bool {
        self.drive(cell).collided()
    }

    /// The contact of the run of a cell, if there is one, and which of its manoeuvres began.
    pub fn contact(&self, cell: &Cell) -> (Option<Contact>, Vec<bool>) {
        let run = self.drive(cell);
        let contact = match &run.outcome {
            Outcome::Completed => None,
            Outcome::Collision(collision) => Some(Contact {
                from_behind: collision.from_behind,
                confirmed: collision.confirmed,
            }),
        };
        (contact, began(&run))
    }

    fn drive(&self, cell: &Cell) -> RunRecord {
        RunSpec::new(self.scenarios[cell.scenario].clone(), self.system.clone())
            .with_root_seed(self.root_seed)
            .with_seed(cell.seed)
            .at_rates(cell.rates.clone())
            .run_fixed()
    }

    fn draws(&self, cell: &Cell) -> (&Scenario, Draws<'_>) {
        let scenario = &self.scenarios[cell.scenario];
        let draws = Draws {
            root: self.root_seed,
            scenario: &scenario.name,
            seed: cell.seed,
        };
        (scenario, draws)
    }

    /// Where the actors of a cell start.
    ///
    /// # Errors
    /// When they would start inside each other however their jitter is drawn.
    pub fn starts(&self, cell: &Cell) -> Result<Vec<Start>, Crowded> {
        let (scenario, draws) = self.draws(cell);
        starts(scenario, self.system, draws)
    }

    /// Runs one cell.
    pub fn record(&self, cell: &Cell, estimators: &[Estimator]) -> Record {
        let scenario = &self.scenarios[cell.scenario];
        let run = self.drive(cell);
        let collision = match &run.outcome {
            Outcome::Completed => None,
            Outcome::Collision(collision) => Some(Collision::from(collision)),
        };
        let peaks = if collision.is_some() || estimators.is_empty() {
            Vec::new()
        } else {
            let hindsight = Hindsight::new(&run.trace, &scenario.road, self.system, &cell.rates);
            estimators
                .iter()
                .map(|estimator| hindsight.peaks(estimator))
                .collect()
        };
        Record {
            cell: cell.clone(),
            end: collision
                .as_ref()
                .map_or(scenario.duration, |collision| collision.time),
            collision,
            extremes: run.extremes(&scenario.road),
            manoeuvres: run.manoeuvres.iter().flatten().copied().collect(),
            active: self.active(&run.trace),
            frames: run.frames,
            peaks,
        }
    }

    fn active(&self, trace: &Trace) -> Vec<bool> {
        let sees = |eye: &Eye| {
            let camera = Mounted::new(&eye.camera);
            let covers = |row: Row<'_>| {
                let ego = Axes::new(row.ego.pose);
                row.actors.iter().any(|body| camera.covers_body(&ego, body))
            };
            trace.rows().step_by(GLANCE).any(covers)
        };
        self.system.perception.eyes.iter().map(sees).collect()
    }
}

impl From<&zhuyi_sim::Collision> for Collision {
    fn from(collision: &zhuyi_sim::Collision) -> Self {
        let impact = collision.crash.as_ref().ok().map(|crash| Impact {
            speed: crash.impact_speed,
            ego_delta_v: crash.ego.delta_v,
            other_delta_v: crash.other.delta_v,
        });
        Self {
            time: collision.time,
            actor: collision.actor,
            side: collision.side,
            from_behind: collision.from_behind,
            confirmed: collision.confirmed,
            impact,
        }
    }
}
