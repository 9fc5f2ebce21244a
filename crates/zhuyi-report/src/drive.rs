//! One drive as the data of a report.
//!
//! ```text
//!  Scenario, System, RunRecord with its Witness ──[columns]──▶ Document ──▶ page
//! ```
//!
//! Demands are those of the offline estimate (readings R14, R21) at every row. With fixed rates l_0 is what it is for
//! `zhuyi run`: each camera's own period, unless the system sets another. Where a policy changed the rates it is that of the
//! estimate in the loop. An actor's tolerable latency is the most demanding answer over the cameras that have it in view.

pub mod column;
pub(crate) mod columns;
pub mod document;
pub mod moments;

use serde_json::Value;
use zhuyi_core::Frenet;
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::{Outcome, RunRecord, STEP, Witness};

use columns::Columns;
use document::{Document, Provenance, Road};
use moments::Moment;

/// What was rounded, in words.
pub(crate) const ROUNDING: &str = "Times of rows are exact (those of recordings to 1 µs), as are those of contact and stages (1 ns). Rounded: positions and \
gaps to 1 mm, headings to 0.00001 rad, speeds and accelerations to 0.001 m/s and m/s², ages, latencies and TTC to 1 ms, rates and \
demands to 0.001 FPR. TTC above 30 s is left out.";

/// What is in the file besides data.
pub(crate) const CONTAINS: &str =
    "uPlot 1.6.32 (MIT, © 2022 Leon Sorokin), its licence in the source of this page";

/// [m] from point to point of a lane's line, where the road is not straight.
const LINE_STEP: f64 = 4.0;
/// [m] road drawn behind the first and beyond the last place of the ego.
const LINE_MARGIN: f64 = 250.0;

/// A finished drive with all that its report tells.
pub struct Drive<'a> {
    /// Road and actors.
    pub scenario: &'a Scenario,
    /// The ego.
    pub system: &'a System,
    /// The run.
    pub run: &'a RunRecord,
    /// What it knew.
    pub witness: &'a Witness,
    /// Whether a policy changed the rates.
    pub by_policy: bool,
    /// Version and command.
    pub version: &'a str,
    /// The command that makes the report again.
    pub command: String,
    /// What `zhuyi run --json` prints.
    pub summary: Value,
    /// What `zhuyi explain --json` prints.
    pub explanation: Option<Value>,
}

impl Drive<'_> {
    /// The data of its report.
    pub fn document(&self) -> Document {
        let columns = Columns::of(self);
        let rows = self.run.trace.rows();
        let places: Vec<f64> = rows.map(|row| row.ego.road.s).collect();
        let mut moments = columns.moments;
        moments.extend(self.contact());
        Document {
            kind: "drive",
            schema: 1,
            provenance: self.provenance(),
            summary: self.summary.clone(),
            step_s: Some(STEP.seconds()),
            times_s: None,
            believes: true,
            rows: self.run.trace.len(),
            road: Road::along(&self.scenario.road, &places),
            bodies: columns.bodies,
            actors: columns.actors,
            cameras: columns.cameras,
            models: columns.models,
            manoeuvre: columns.manoeuvre,
            asked_mps2: columns.asked,
            moments,
            explanation: self.explanation.clone(),
        }
    }

    fn contact(&self) -> Option<Moment> {
        let Outcome::Collision(collision) = &self.run.outcome else {
            return None;
        };
        let crash = collision.crash.as_ref().ok();
        Some(Moment {
            time_s: collision.time.seconds(),
            what: "contact".to_string(),
            who: self.scenario.actors[collision.actor.index()].name.clone(),
            figure: crash.map_or(String::new(), |crash| {
                format!("{:.2} m/s closing speed", crash.impact_speed)
            }),
        })
    }

    fn provenance(&self) -> Provenance {
        let hash = |text: &str| {
            let hash = blake3::hash(text.as_bytes()).to_hex();
            format!("BLAKE3 {hash} of what zhuyi show prints of it, without drawings")
        };
        let l_0 = if self.by_policy {
            self.system.online.current_latency
        } else {
            self.system.current_latency
        };
        let l_0 = match l_0 {
            Some(latency) => format!("{:.1} ms", 1e3 * latency),
            None => "each camera's own frame period".to_string(),
        };
        Provenance {
            version: self.version.to_string(),
            command: self.command.clone(),
            sources: vec![
                ("Scenario", hash(&self.scenario.to_ron())),
                ("System", hash(&self.system.to_ron())),
            ],
            rounding: ROUNDING,
            demand: format!(
                "Demand: what the drive, once recorded, asked of each camera at each 10 ms step by the paper's estimator, \
                 with l_0 = {l_0}. After a collision it covers the time up to the contact."
            ),
            contains: CONTAINS,
        }
    }
}

impl Road {
    /// The lines between lanes, as far as an ego came that was at these places [m] along the road.
    pub(crate) fn along(road: &zhuyi_core::Road, places: &[f64]) -> Self {
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for place in places {
            (from, to) = (from.min(*place - LINE_MARGIN), to.max(*place + LINE_MARGIN));
        }
        if let Some(lap) = road.lap()
            && to - from > lap
        {
            (from, to) = (0.0, lap); // all round, once
        }
        let mut points = vec![from];
        let count = ((to - from) / LINE_STEP).ceil() as usize;
        // On a straight road two points make the line.
        let inner = (1..count).map(|place| from + place as f64 * LINE_STEP);
        let turns = |s: &f64| road.heading(s - LINE_STEP) != road.heading(s + LINE_STEP);
        points.extend(inner.filter(turns));
        points.push(to);
        let half = f64::from(road.lanes()) / 2.0;
        let rounded = |metres: f64| (metres * 1e3).round() / 1e3;
        let line = |border: u8| {
            let d = (f64::from(border) - half) * road.lane_width();
            let poses = points
                .iter()
                .map(|s| road.world_from_road(Frenet { s: *s, d }));
            let (x, y) = poses.map(|pose| (rounded(pose.x), rounded(pose.y))).unzip();
            [x, y]
        };
        Self {
            lane_width_m: road.lane_width(),
            lines: (0..=road.lanes()).map(line).collect(),
        }
    }
}
