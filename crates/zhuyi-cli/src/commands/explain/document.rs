//! The explanation of a drive: the one source of its text, its JSON document and its part of a report.
//!
//! The document is stable: fields are added, never renamed. Units stand in the names; what there is not is `null`.

use schemars::JsonSchema;
use serde::Serialize;
use zhuyi_core::SimTime;
use zhuyi_sim::{Cause, Outcome};

use super::changes::{Change, changes};
use crate::commands::run::Run;
use crate::commands::run::summary::{Collision, collision};
use crate::shell;

/// Why a drive ended as it did.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Explanation {
    /// Name of the scenario.
    pub scenario: String,
    /// Which of the random drives.
    pub seed: u64,
    /// Root of all randomness.
    pub root_seed: u64,
    /// The command that makes the drive.
    pub command: String,
    /// The first contact of the ego.
    pub collision: Option<Collision>,
    /// [m] smallest gap to an actor ahead in the ego's way.
    pub smallest_gap_m: Option<f64>,
    /// [s] smallest time to collision with such an actor.
    pub smallest_ttc_s: Option<f64>,
    /// [m/s2] hardest braking of the ego.
    pub hardest_braking_mps2: f64,
    /// The collision in words; `null` without one.
    pub told: Option<String>,
    /// The stages on the way to it.
    pub waterfall: Option<Waterfall>,
    /// What would have saved the drive; empty without a collision.
    pub changes: Vec<Change>,
}

/// The stages on the way to a collision.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Waterfall {
    /// `came_into_sight`, `became_dangerous` or `never_dangerous`.
    pub cause: &'static str,
    /// Who was touched.
    pub actor: String,
    /// [m] from bumper to bumper when it was exposed.
    pub gap_m: Option<f64>,
    /// [m] that the actor drove from then on.
    pub actor_metres_m: Option<f64>,
    /// [m] that the ego drove from then on.
    pub metres_m: f64,
    /// [s] when the planner first left its lane to evade.
    pub evading_from_s: Option<f64>,
    /// All seven, in order.
    pub stages: Vec<Reached>,
}

/// A stage, reached or not.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Reached {
    /// Its name.
    pub stage: &'static str,
    /// [s] when it was reached.
    pub time_s: Option<f64>,
    /// [s] since the last one that was.
    pub took_s: Option<f64>,
    /// [m] that the ego drove in that time.
    pub metres_m: f64,
    /// [m/s] its speed when the stage was reached.
    pub speed_mps: Option<f64>,
}

impl Explanation {
    /// Of a drive that has kept what it knew; drives again to find what would have saved it.
    pub fn of(asked: &Run, run: &zhuyi_sim::RunRecord) -> Self {
        let extremes = run.extremes(&asked.scenario.road);
        let waterfall = zhuyi_sim::Waterfall::of(&asked.scenario, &asked.system, run);
        let collision = collision(&asked.scenario, run);
        let told = match (&waterfall, &run.outcome) {
            (Some(waterfall), Outcome::Collision(_)) => Some(told(asked, waterfall)),
            _ => None,
        };
        Self {
            scenario: asked.scenario.name.clone(),
            seed: asked.seed,
            root_seed: asked.root_seed,
            command: shell::line(asked.typed.words(None)),
            smallest_gap_m: extremes.gap,
            smallest_ttc_s: extremes.time_to_collision,
            hardest_braking_mps2: extremes.decel,
            changes: match &collision {
                Some(_) => changes(asked),
                None => Vec::new(),
            },
            collision,
            told,
            waterfall: waterfall.map(|waterfall| staged(asked, &waterfall)),
        }
    }

    /// The document as a part of another.
    pub fn value(&self) -> serde_json::Value {
        // Numbers, texts and lists under fixed names: nothing that JSON cannot say.
        serde_json::to_value(self)
            .unwrap_or_else(|error| unreachable!("an explanation is JSON: {error}"))
    }

    /// The document.
    pub fn json(&self) -> String {
        let document = serde_json::to_string_pretty(self)
            .unwrap_or_else(|error| unreachable!("an explanation is JSON: {error}"));
        document + "\n"
    }
}

fn staged(asked: &Run, waterfall: &zhuyi_sim::Waterfall) -> Waterfall {
    let mut before: Option<SimTime> = None;
    let stages = waterfall.steps.iter().map(|step| {
        let took = step.time.zip(before).map(|(time, before)| time - before);
        before = step.time.or(before);
        Reached {
            stage: step.stage.name(),
            time_s: step.time.map(seconds),
            took_s: took.map(seconds),
            metres_m: step.metres,
            speed_mps: step.speed,
        }
    });
    Waterfall {
        stages: stages.collect(),
        cause: waterfall.cause.name(),
        actor: name(asked, waterfall).to_string(),
        evading_from_s: waterfall.evading_from.map(seconds),
        gap_m: waterfall.gap,
        actor_metres_m: waterfall.actor_metres,
        metres_m: waterfall.metres(),
    }
}

/// The collision in words.
fn told(asked: &Run, waterfall: &zhuyi_sim::Waterfall) -> String {
    let actor = name(asked, waterfall);
    let exposed = waterfall.steps[0].time.map(seconds);
    let (Some(exposed), Some(gap), Some(moved)) = (exposed, waterfall.gap, waterfall.actor_metres)
    else {
        return match waterfall.cause {
            Cause::Never => format!(
                "`{actor}` was known, and the planner would not have braked hard for it even with exact and instant knowledge."
            ),
            _ => format!("`{actor}` was never in sight before the contact."),
        };
    };
    let began = match waterfall.cause {
        Cause::Sight => "came into sight",
        Cause::Danger | Cause::Never => "was known and became dangerous",
    };
    let wherein = if gap >= 0.0 {
        format!("{gap:.1} m ahead of the ego's bumper")
    } else {
        "beside or behind the ego's bumper".to_string()
    };
    let moved = if moved.abs() < 0.05 {
        "stood".to_string()
    } else {
        format!("drove {moved:.1} m")
    };
    let evades = waterfall.evading_from.map(seconds);
    let evades = evades.map_or(String::new(), |from| {
        format!(" From {from:.2} s on the ego left its lane to evade, for which it need not brake.")
    });
    format!(
        "`{actor}` {began} at {exposed:.2} s, {wherein}; until the contact the ego drove {:.1} m and `{actor}` {moved}.{evades}",
        waterfall.metres()
    )
}

fn name<'a>(asked: &'a Run, waterfall: &zhuyi_sim::Waterfall) -> &'a str {
    &asked.scenario.actors[waterfall.actor.index()].name
}

/// [s] a time as the nearest number.
fn seconds(time: SimTime) -> f64 {
    time.nanos() as f64 / 1e9
}
