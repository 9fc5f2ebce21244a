//! The table's numbers, reduced from the records of a sweep (readings R20 and R21).
//!
//! ```text
//!  records ──▶ per scenario and rate: collisions, estimates (mean, median, flags) ──▶ MRF, largest sum, fraction
//! ```
//! A cell has no estimate where a run of it collided. The largest sum is that of all runs at rates from the MRF on.

use zhuyi_core::camera::FULL_RATE;
use zhuyi_scenario::System;
use zhuyi_sim::Peaks;

use crate::reproduce::paper;
use crate::reproduce::plan::Plan;
use zhuyi_batch::estimators::{TABLE, VARIANTS};
use zhuyi_batch::mrf::{Mrf, Required, required};
use zhuyi_batch::rates::group;
use zhuyi_batch::statistics::{mean, median};
use zhuyi_batch::sweep::Record;

/// All rows, in the order of the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The rows.
    pub rows: Vec<Row>,
}

/// What the sweep tells of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scenario.
    pub scenario: String,
    /// [m/s] the ego's speed at the start.
    pub ego_speed: f64,
    /// Activity of each analysed camera at the highest rate, by the direction it looks to.
    pub active: Vec<(String, bool)>,
    /// The MRF.
    pub required: Required,
    /// What came of each rate, ascending.
    pub tested: Vec<Tested>,
    /// [FPR] the largest sum over the analysed cameras at one step of a run at a rate from the MRF on; none when there is no such
    /// rate.
    pub largest_sum: Option<f64>,
    /// [-] that sum as a share of all analysed cameras at their highest rate.
    pub fraction: Option<f64>,
    /// The paper's row, if it has one.
    pub paper: Option<paper::Row>,
}

/// What came of one rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Tested {
    /// [Hz] the rate.
    pub rate: u32,
    /// How many seeds were run.
    pub runs: u32,
    /// How many of them collided.
    pub collisions: u32,
    /// The estimates, one per variant that the runs were put to, in the order of [`VARIANTS`]; empty where a run collided.
    pub estimates: Vec<Estimates>,
}

/// The largest estimates of the runs of one cell, by one variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimates {
    /// [FPR] of each run, in the order of seeds.
    pub all: Vec<f64>,
    /// [FPR] their mean.
    pub mean: f64,
    /// [FPR] their median.
    pub median: f64,
    /// Runs that asked for more than the grid offers.
    pub beyond_grid: u32,
    /// Runs in which braking at once came too late.
    pub unavoidable: u32,
    /// Runs in which an actor in view was alongside in the corridor.
    pub alongside: u32,
    /// Runs in which the ego stood in conflict with an actor in view.
    pub standing: u32,
}

impl Table {
    /// The table of a plan's records, which stand in the order of its cells.
    pub fn new(plan: &Plan, records: &[Record]) -> Self {
        let seeds = plan.seeds as usize;
        let scenarios = plan
            .scenarios
            .iter()
            .zip(records.chunks(plan.rates.len() * seeds));
        let row = |(scenario, records): (&zhuyi_scenario::Scenario, &[Record])| {
            let rates = plan.rates.iter().zip(records.chunks(seeds));
            let tested: Vec<_> = rates
                .map(|(rate, records)| Tested::new(*rate, records))
                .collect();
            let collisions: Vec<_> = tested
                .iter()
                .map(|tested| (tested.rate, tested.collisions))
                .collect();
            let required = required(&collisions);
            let largest_sum = largest_sum(&required, records);
            Row {
                scenario: scenario.name.clone(),
                ego_speed: scenario.ego.speed,
                active: active(&plan.system, &records[records.len() - seeds..]),
                tested,
                largest_sum,
                fraction: largest_sum.map(|sum| sum / highest_sum(&plan.system)),
                paper: paper::Row::of(&scenario.name),
                required,
            }
        };
        Self {
            rows: scenarios.map(row).collect(),
        }
    }
}

impl Row {
    /// The estimates at a rate by a variant; none where a run collided or the rate was not tested.
    pub fn estimates(&self, rate: u32, variant: usize) -> Option<&Estimates> {
        self.tested
            .iter()
            .find(|tested| tested.rate == rate)?
            .estimates
            .get(variant)
    }

    /// Whether the MRF is the paper's; none where the paper has no such row.
    pub fn mrf_is_the_papers(&self) -> Option<bool> {
        Some(self.required.mrf == Mrf::Rate(self.paper.as_ref()?.mrf))
    }
}

impl Tested {
    fn new(rate: u32, records: &[Record]) -> Self {
        let collisions = records
            .iter()
            .filter(|record| record.collision.is_some())
            .count() as u32;
        let of_variant = |variant: usize| {
            let peaks = records.iter().map(|record| record.peaks.get(variant));
            Estimates::new(&peaks.collect::<Option<Vec<_>>>()?)
        };
        Self {
            rate,
            runs: records.len() as u32,
            collisions,
            estimates: (0..VARIANTS.len()).map_while(of_variant).collect(),
        }
    }
}

impl Estimates {
    fn new(peaks: &[&Peaks]) -> Option<Self> {
        let all: Vec<f64> = peaks.iter().map(|peaks| peaks.largest).collect();
        let runs =
            |flag: fn(&Peaks) -> bool| peaks.iter().filter(|peaks| flag(peaks)).count() as u32;
        Some(Self {
            mean: mean(&all)?,
            median: median(&all)?,
            beyond_grid: runs(|peaks| peaks.beyond_grid),
            unavoidable: runs(|peaks| peaks.unavoidable),
            alongside: runs(|peaks| peaks.alongside),
            standing: runs(|peaks| peaks.standing),
            all,
        })
    }
}

/// [FPR] over the runs at rates from the MRF on, none of which has collided.
fn largest_sum(required: &Required, records: &[Record]) -> Option<f64> {
    let least = required.mrf.safe_from()?;
    let mut largest = None;
    for record in records
        .iter()
        .filter(|record| record.cell.rates.all()[0] >= f64::from(least))
    {
        let sum = record.peaks.get(TABLE)?.sum;
        if largest.is_none_or(|largest| sum > largest) {
            largest = Some(sum);
        }
    }
    largest
}

/// [FPR] all analysed cameras at their highest rate: the paper's 90 for three.
fn highest_sum(system: &System) -> f64 {
    FULL_RATE
        * system
            .perception
            .eyes
            .iter()
            .filter(|eye| eye.camera.analysed)
            .count() as f64
}

fn active(system: &System, records: &[Record]) -> Vec<(String, bool)> {
    let analysed = system
        .perception
        .eyes
        .iter()
        .enumerate()
        .filter(|(_, eye)| eye.camera.analysed);
    let active = |place: usize| records.iter().any(|record| record.active[place]);
    analysed
        .map(|(place, eye)| (group(&eye.camera.name).to_string(), active(place)))
        .collect()
}
