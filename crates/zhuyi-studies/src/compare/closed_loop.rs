//! The closed loop: the MRF of each scenario, and the scenario run again at the rates that each model asked for (as in claim 2b).
//!
//! All cameras at a model's largest demand is a run of the MRF's own sweep, as demands are rounded up to a whole 1 to 30 FPR and
//! runs that differ in nothing share their draws; with each camera at its own largest the runs are made anew.

use zhuyi_core::FrameRates;
use zhuyi_sim::Peaks;

use super::Comparison;
use super::audit::Audited;
use crate::reruns::{Asked, Rerun, Trial, again};
use zhuyi_batch::mrf::{Mrf, Required, required};
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::{own, round_up, uniform};
use zhuyi_batch::sweep::grid;

/// [Hz] the rates at which the MRF is looked for (reading R20).
pub const RATES: std::ops::RangeInclusive<u32> = 1..=30;

/// What came of all scenarios.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedLoop {
    /// The MRF of each.
    pub required: Vec<Required>,
    /// What came of each model's rates, by scenario (outer) and model (inner); none where nothing was asked for, as a run
    /// has collided.
    pub trials: Vec<Vec<Option<Rerun>>>,
}

impl ClosedLoop {
    /// Runs the sweep, and again at what the audited runs ask for.
    pub fn new(comparison: &Comparison, audited: &[Audited], progress: &dyn Progress) -> Self {
        let collisions = sweep(comparison, progress);
        let models = audited.first().map_or(0, |scenario| scenario.peaks.len());
        progress.start(
            "runs again at the rates asked for",
            models as u64 * audited.len() as u64 * comparison.seeds,
        );
        let mut trials: Vec<Vec<Option<Rerun>>> = vec![Vec::new(); audited.len()];
        for model in 0..models {
            let asked: Vec<Option<Asked>> = audited
                .iter()
                .map(|scenario| asked(scenario, model))
                .collect();
            let rates: Vec<Option<FrameRates>> = asked
                .iter()
                .map(|asked| Some(own(&comparison.system, &asked.as_ref()?.cameras)))
                .collect();
            let (own, _) = again(&comparison.experiment(), &rates, comparison.seeds, progress);
            for (scenario, (asked, own)) in asked.into_iter().zip(own).enumerate() {
                let rerun = asked.zip(own).map(|(asked, own)| Rerun {
                    asked: asked.largest,
                    largest: at_the_largest(comparison, &collisions[scenario], asked.largest),
                    own,
                });
                trials[scenario].push(rerun);
            }
        }
        let required = collisions.iter().map(|collisions| required(collisions));
        Self {
            required: required.collect(),
            trials,
        }
    }
}

/// Rates with the number of seeds that collided, by scenario.
fn sweep(comparison: &Comparison, progress: &dyn Progress) -> Vec<Vec<(u32, u32)>> {
    let seeds = comparison.seeds as usize;
    let rates: Vec<FrameRates> = RATES
        .map(|rate| uniform(&comparison.system, rate))
        .collect();
    let cells = grid(comparison.scenarios.len(), &rates, 0..comparison.seeds);
    progress.start("runs for the MRF", cells.len() as u64);
    let records = comparison
        .experiment()
        .run(&cells, |_| &[], || progress.step());
    let of_rate = |(rate, records): (u32, &[zhuyi_batch::sweep::Record])| {
        let collided = records.iter().filter(|record| record.collision.is_some());
        (rate, collided.count() as u32)
    };
    records
        .chunks(rates.len() * seeds)
        .map(|records| RATES.zip(records.chunks(seeds)).map(of_rate).collect())
        .collect()
}

/// The largest demands of a model over all runs; none where a run collided.
fn asked(scenario: &Audited, model: usize) -> Option<Asked> {
    let (_, collided) = scenario.runs;
    let all: Vec<&Peaks> = scenario.peaks[model].iter().collect();
    if collided > 0 {
        return None;
    }
    Asked::at_most(&all)
}

/// All cameras at the demand, rounded up, from the sweep.
fn at_the_largest(comparison: &Comparison, collisions: &[(u32, u32)], asked: f64) -> Trial {
    let rate = round_up(asked) as u32;
    let found = collisions.iter().find(|(tested, _)| *tested == rate);
    let (_, collisions) =
        found.unwrap_or_else(|| unreachable!("demands are 1 to 30 FPR, got {asked}"));
    Trial {
        rates: uniform(&comparison.system, rate),
        runs: comparison.seeds as u32,
        collisions: *collisions,
    }
}

impl ClosedLoop {
    /// Whether a demand, rounded up as it is run again, is below the MRF of a scenario.
    pub fn is_below(&self, scenario: usize, asked: f64) -> bool {
        match self.required[scenario].mrf {
            Mrf::Rate(rate) => round_up(asked) < f64::from(rate),
            Mrf::Above(_) => true,
            Mrf::AtMost(_) => false,
        }
    }

    /// [FPR] by how much a demand, rounded up as it is run again, is above the MRF of a scenario; none where the MRF is 1, which
    /// no demand can miss, or is not known.
    pub fn above(&self, scenario: usize, asked: f64) -> Option<f64> {
        match self.required[scenario].mrf {
            Mrf::Rate(rate) if rate > 1 => Some(round_up(asked) - f64::from(rate)),
            _ => None,
        }
    }
}
