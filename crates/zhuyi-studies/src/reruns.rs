//! The scenarios run again at the rates that the estimate asked for (claim 2b).
//!
//! The rates are the largest demands over all runs at the highest rate of the plan, rounded up to whole frames per second; the
//! same seeds are run again, once with all cameras at the largest, once with each camera at its own.

use zhuyi_core::FrameRates;
use zhuyi_sim::Peaks;

use crate::reproduce::plan::Plan;
use zhuyi_batch::estimators::TABLE;
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::{own, round_up};
use zhuyi_batch::sweep::{Cell, Experiment, Record, grid};

/// All runs done again.
#[derive(Clone, Debug, PartialEq)]
pub struct Reruns {
    /// What came of each scenario, in the order of the plan; none where a run at the highest rate collided, so that nothing was
    /// asked for.
    pub scenarios: Vec<Option<Rerun>>,
    /// The runs with all cameras at the largest rate.
    pub largest: Vec<Record>,
    /// The runs with each camera at its own.
    pub own: Vec<Record>,
}

/// One scenario run again.
#[derive(Clone, Debug, PartialEq)]
pub struct Rerun {
    /// [FPR] the largest demand on an analysed camera.
    pub asked: f64,
    /// All cameras at the largest rate.
    pub largest: Trial,
    /// Each camera at its own.
    pub own: Trial,
}

/// Some rates, tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The rates.
    pub rates: FrameRates,
    /// How many seeds were run.
    pub runs: u32,
    /// How many of them collided.
    pub collisions: u32,
}

/// What was asked for in some runs.
pub(crate) struct Asked {
    /// [FPR] the largest demand on an analysed camera.
    pub largest: f64,
    /// [FPR] the largest demand on each camera, in the order of the rig.
    pub cameras: Vec<f64>,
}

impl Reruns {
    /// Runs again what the records of a plan's sweep ask for.
    pub fn new(plan: &Plan, records: &[Record], progress: &dyn Progress) -> Self {
        let seeds = plan.seeds as usize;
        let per_scenario = records.chunks(plan.rates.len() * seeds);
        let asked: Vec<_> = per_scenario
            .map(|records| Asked::in_runs(&records[records.len() - seeds..]))
            .collect();
        let rates_of = |rates: &dyn Fn(&Asked) -> FrameRates| -> Vec<_> {
            asked
                .iter()
                .map(|asked| asked.as_ref().map(rates))
                .collect()
        };
        let cameras = plan.system.perception.eyes.len();
        let largest = rates_of(&|asked| FrameRates::new(vec![round_up(asked.largest); cameras]));
        let own = rates_of(&|asked| own(&plan.system, &asked.cameras));

        let total = 2 * seeds * asked.iter().flatten().count();
        progress.start("runs again at the rates asked for", total as u64);
        let (experiment, seeds) = (plan.experiment(), plan.seeds);
        let (largest, largest_records) = again(&experiment, &largest, seeds, progress);
        let (own, own_records) = again(&experiment, &own, seeds, progress);
        let together = asked
            .into_iter()
            .zip(largest)
            .zip(own)
            .map(|((asked, largest), own)| {
                Some(Rerun {
                    asked: asked?.largest,
                    largest: largest?,
                    own: own?,
                })
            });
        Self {
            scenarios: together.collect(),
            largest: largest_records,
            own: own_records,
        }
    }
}

/// Runs each scenario that has rates at these, with the first `seeds` seeds.
pub(crate) fn again(
    experiment: &Experiment<'_>,
    rates: &[Option<FrameRates>],
    seeds: u64,
    progress: &dyn Progress,
) -> (Vec<Option<Trial>>, Vec<Record>) {
    let of_scenario = |(scenario, rates): (usize, &Option<FrameRates>)| -> Vec<Cell> {
        let cells = grid(1, rates.as_slice(), 0..seeds).into_iter();
        cells.map(|cell| Cell { scenario, ..cell }).collect()
    };
    let cells: Vec<Cell> = rates.iter().enumerate().flat_map(of_scenario).collect();
    let records = experiment.run(&cells, |_| &[], || progress.step());
    let trial = |(scenario, rates): (usize, &Option<FrameRates>)| {
        let of_scenario = || {
            records
                .iter()
                .filter(|record| record.cell.scenario == scenario)
        };
        Some(Trial {
            rates: rates.clone()?,
            runs: of_scenario().count() as u32,
            collisions: of_scenario()
                .filter(|record| record.collision.is_some())
                .count() as u32,
        })
    };
    (rates.iter().enumerate().map(trial).collect(), records)
}

impl Asked {
    /// None where a run collided and so asked for nothing.
    fn in_runs(records: &[Record]) -> Option<Self> {
        let all: Vec<&Peaks> = records
            .iter()
            .map(|record| record.peaks.get(TABLE))
            .collect::<Option<_>>()?;
        Self::at_most(&all)
    }

    /// None of no runs.
    pub(crate) fn at_most(all: &[&Peaks]) -> Option<Self> {
        let camera = |place: usize| largest(all.iter().map(|peaks| peaks.cameras[place].fpr));
        Some(Self {
            largest: largest(all.iter().map(|peaks| peaks.largest))?,
            cameras: (0..all.first()?.cameras.len())
                .map(camera)
                .collect::<Option<_>>()?,
        })
    }
}

fn largest(values: impl Iterator<Item = f64>) -> Option<f64> {
    values.max_by(f64::total_cmp)
}
