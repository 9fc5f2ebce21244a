//! `zhuyi mrf --json`: minimum required rates with what they rest on.
//!
//! The document is stable: fields are added, never renamed. Units stand in the names; what there is not is `null`.

use schemars::JsonSchema;
use serde::Serialize;
use zhuyi_batch::manoeuvres::never;
use zhuyi_batch::shares::{Confident, MoreFrames, Share, Stop, began};
use zhuyi_batch::sweep::{Cell, uniform};

use super::uniform::Search;
use crate::shell;

/// The document.
#[derive(Debug, Serialize, JsonSchema)]
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
#[derive(Debug, Serialize, JsonSchema)]
struct OfScenario {
    /// Its name.
    scenario: String,
    /// As the table has it: `6`, `>30`, or `<=2`.
    mrf: String,
    /// [FPR] the same as a number; `null` where the highest tested rate collides.
    mrf_fpr: Option<u32>,
    /// [FPR] rates below it without a collision.
    safe_below_fpr: Vec<u32>,
    /// Pairs of rates of which the higher one is shown to collide more often.
    rising: Vec<Rising>,
    /// [FPR] the lowest rate from which on none is shown to be worse than allowed; `null` where the highest is.
    not_excluded_fpr: Option<u32>,
    /// [FPR] the lowest rate from which on all are shown to be as good as allowed; `null` where the highest is not.
    shown_fpr: Option<u32>,
    /// [FPR] the MRF where contacts from behind do not count, as the table has it; `null` where none were, or where drives that
    /// would tell were not made.
    mrf_without_struck_from_behind: Option<String>,
    /// Where the highest tested rate collides, whether more frames could help: `could` (some actors were not confirmed yet), `may`
    /// (all were, but for those from behind: only if they are confirmed sooner) or `cannot` (all contacts were from behind).
    more_frames: Option<&'static str>,
    /// Manoeuvres that began in no drive, as `cutter.2 Brake`: actor, place in its script from 1, action.
    never_began: Vec<String>,
    /// All that were tested.
    rates: Vec<AtRate>,
}

/// Two rates.
#[derive(Debug, Serialize, JsonSchema)]
struct Rising {
    /// [FPR] the lower one.
    lower_fpr: u32,
    /// [FPR] the higher one.
    higher_fpr: u32,
}

/// The drives at a rate.
#[derive(Debug, Serialize, JsonSchema)]
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
    /// Number of drives that were struck from behind: by an actor that closed in on the rear half of the ego.
    struck_from_behind: u32,
    /// Number of the other collisions whose actor was not confirmed by then.
    with_unconfirmed: u32,
    /// Number of the other collisions whose actor was.
    with_confirmed: u32,
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
                struck_from_behind: share.contacts.from_behind,
                with_unconfirmed: share.contacts.unconfirmed,
                with_confirmed: share.contacts.confirmed,
                replay: share
                    .first
                    .map(|seed| replay(search, place, share.rate, seed)),
            };
            OfScenario {
                scenario: grid.scenarios[place].name.clone(),
                mrf: required.mrf.to_string(),
                mrf_fpr: required.mrf.safe_from(),
                safe_below_fpr: required.safe_below,
                rising: rising
                    .into_iter()
                    .map(|(lower_fpr, higher_fpr)| Rising {
                        lower_fpr,
                        higher_fpr,
                    })
                    .collect(),
                not_excluded_fpr: not_excluded,
                shown_fpr: shown,
                mrf_without_struck_from_behind: search
                    .required_ahead(&shares[place])
                    .map(|mrf| mrf.to_string()),
                more_frames: shares[place].last().and_then(more_frames),
                never_began: never(&grid.scenarios[place], &began(shares[place].iter())),
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

/// Whether more frames than those of a rate could help.
fn more_frames(share: &Share) -> Option<&'static str> {
    Some(match share.contacts.more_frames()? {
        MoreFrames::CouldHelp => "could",
        MoreFrames::MayHelp => "may",
        MoreFrames::CannotHelp => "cannot",
    })
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
