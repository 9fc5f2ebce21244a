//! `zhuyi mrf --json`: minimum required rates with what they rest on.
//!
//! The document is stable: fields are added, never renamed. Units stand in the names; what there is not is `null`.

use serde::Serialize;
use zhuyi_lab::shares::{Confident, Share, Stop};
use zhuyi_lab::sweep::{Cell, uniform};

use super::uniform::Search;
use crate::shell;

/// The document.
#[derive(Debug, Serialize)]
pub struct Document {
    /// Root of all randomness.
    root_seed: u64,
    /// Over how many parts of their period the phases of the cameras are spread; 1 where they are left to chance.
    phases: u64,
    /// The most drives that a rate got.
    drives_per_rate: u64,
    /// Whether a rate that was decided got no more drives.
    early_stop: bool,
    /// `wilson`, or `robbins` where drives were stopped early; 95 %.
    interval: &'static str,
    /// [-] chance of a collision that is allowed.
    at_most: f64,
    /// In the order of being named.
    scenarios: Vec<OfScenario>,
}

/// The minimum required rate of a scenario.
#[derive(Debug, Serialize)]
struct OfScenario {
    /// Its name.
    scenario: String,
    /// As the table has it: `6`, `>30`, or `<=2`.
    mrf: String,
    /// [FPR] the same as a number; `null` where the highest tested rate collides.
    mrf_fpr: Option<u32>,
    /// [FPR] rates below it without a collision.
    safe_below_fpr: Vec<u32>,
    /// [FPR] pairs of which the higher rate is shown to collide more often.
    rising_fpr: Vec<(u32, u32)>,
    /// [FPR] the lowest rate from which on none is shown to be worse than allowed; `null` where the highest is.
    not_excluded_fpr: Option<u32>,
    /// [FPR] the lowest rate from which on all are shown to be as good as allowed; `null` where the highest is not.
    shown_fpr: Option<u32>,
    /// All that were tested.
    rates: Vec<AtRate>,
}

/// The drives at a rate.
#[derive(Debug, Serialize)]
struct AtRate {
    /// [FPR] the rate.
    rate_fpr: u32,
    /// How many drives collided ...
    collided: u32,
    /// ... of how many.
    drives: u32,
    /// [-] their share.
    share: f64,
    /// [-] lower end of its interval ...
    low: f64,
    /// [-] ... and upper end.
    high: f64,
    /// The command that makes the first drive that collided.
    replay: Option<String>,
}

impl Document {
    /// Of the shares that a search came to.
    pub fn of(search: &Search, shares: &[Vec<Share>]) -> Self {
        let grid = &search.grid;
        let scenario = |place: usize| {
            let found = search.confident(&shares[place]);
            let Confident {
                required,
                not_excluded,
                shown,
                rising,
            } = found;
            let rate = |share: &Share| AtRate {
                rate_fpr: share.rate,
                collided: share.collided,
                drives: share.drives,
                share: share.share(),
                low: share.interval.0,
                high: share.interval.1,
                replay: share
                    .first
                    .map(|seed| replay(search, place, share.rate, seed)),
            };
            OfScenario {
                scenario: grid.scenarios[place].name.clone(),
                mrf: required.mrf.to_string(),
                mrf_fpr: required.mrf.safe_from(),
                safe_below_fpr: required.safe_below,
                rising_fpr: rising,
                not_excluded_fpr: not_excluded,
                shown_fpr: shown,
                rates: shares[place].iter().map(rate).collect(),
            }
        };
        let early_stop = search.trials.stop != Stop::Never;
        Self {
            root_seed: grid.root_seed,
            phases: search.trials.strata,
            drives_per_rate: search.trials.drives,
            early_stop,
            interval: if early_stop { "robbins" } else { "wilson" },
            at_most: search.at_most,
            scenarios: (0..grid.scenarios.len()).map(scenario).collect(),
        }
    }

    /// As text.
    pub fn json(&self) -> String {
        // Numbers, texts and lists under fixed names: nothing that JSON cannot say.
        let document = serde_json::to_string_pretty(self)
            .unwrap_or_else(|error| unreachable!("minimum required rates are JSON: {error}"));
        document + "\n"
    }
}

/// The command that makes a drive again, its phases set where they were stratified.
fn replay(search: &Search, place: usize, rate: u32, seed: u64) -> String {
    let grid = &search.grid;
    let experiment = grid.experiment();
    let cell = Cell {
        scenario: place,
        rates: uniform(&grid.system, rate),
        seed,
    };
    let phases = search.trials.phases(&experiment, place, seed);
    let eyes = grid.system.perception.eyes.iter();
    let mut line = grid.typed.replay(&experiment, &cell);
    for (eye, phase) in eyes.zip(phases.unwrap_or_default()) {
        let setting = format!("perception.cameras.{}.phase_share={phase}", eye.camera.name);
        line = format!("{line} {}", shell::line(["--set", &setting]));
    }
    line
}
