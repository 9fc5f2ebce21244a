//! A recorded trace as the data of a report, seen by one of its vehicles.
//!
//! ```text
//!  Log, road or none ──[Replay]──▶ Moments ──▶ columns ──▶ Document ──▶ page
//! ```
//!
//! As with a drive, but for what nobody recorded: beliefs, the planner, a contact. Rows are the steps at which the ego is there,
//! whatever lies between them. Vehicles that never come within [`REACH`] of the ego are left out.

use std::collections::BTreeMap;

use serde_json::{Value, json};
use zhuyi_core::{ActorId, Body as Truth, Footprint, FrameRates, Pose};
use zhuyi_estimator::{Demand, Estimator, Future, Watch};
use zhuyi_log::{Log, Moment, Replay, evaluate};
use zhuyi_metrics::criticality::Approach;
use zhuyi_perception::View;
use zhuyi_scenario::System;
use zhuyi_studies::compare::models::Panel;

use crate::drive::column::{Steps, Track};
use crate::drive::columns::{LONGEST_TTC, most_demanding};
use crate::drive::document::{Actor, Body, Camera, Document, Provenance, Road};
use crate::drive::moments::Worst;
use crate::drive::{CONTAINS, ROUNDING};

/// [m] within which of the ego a vehicle must come to be shown.
pub const REACH: f64 = 150.0;

/// A recording with all that its report tells.
pub struct Recording<'a> {
    /// Its name.
    pub name: String,
    /// Who was where.
    pub log: &'a Log,
    /// Who is the ego.
    pub ego: ActorId,
    /// On which road, if one is known.
    pub road: Option<&'a zhuyi_core::Road>,
    /// Cameras and estimator.
    pub system: &'a System,
    /// [Hz] the rates of the cameras.
    pub rates: &'a FrameRates,
    /// Version of the program.
    pub version: &'a str,
    /// The command that makes the report again.
    pub command: String,
    /// What the recording is made of, to tell its hash.
    pub text: &'a str,
}

/// A vehicle at one row.
struct Seen {
    pose: Pose,
    speed: f64,
    accel: f64,
    footprint: Footprint,
    visible: bool,
    /// [m] to the ego.
    distance: f64,
    gap: Option<f64>,
    ttc: Option<f64>,
    /// [s] by every model.
    latencies: Vec<Option<f64>>,
}

impl Recording<'_> {
    /// The data of its report.
    pub fn document(&self) -> Document {
        let horizon = self.system.estimator.horizon;
        let replay = Replay::new(self.log, self.ego, self.road, horizon);
        let rig = self.rig();
        let estimator = Estimator::new(self.system.estimator.clone());
        let demands = evaluate(&replay, &estimator, &rig).steps;
        let panel = Panel::new(self.system);
        let moments: Vec<Moment<'_>> = replay.moments().collect();
        let mut seen: BTreeMap<usize, Vec<Option<Seen>>> = BTreeMap::new();
        for (row, moment) in moments.iter().enumerate() {
            for (id, actor) in self.seen(moment, &rig, &panel) {
                let column = seen.entry(id).or_default();
                column.resize_with(row, || None);
                column.push(Some(actor));
            }
        }
        let near = |column: &Vec<Option<Seen>>| {
            let mut distances = column.iter().flatten().map(|seen| seen.distance);
            distances.any(|distance| distance <= REACH)
        };
        seen.retain(|_, column| near(column));
        for column in seen.values_mut() {
            column.resize_with(moments.len(), || None);
        }
        let places: Vec<usize> = seen.keys().copied().collect();
        let columns: Vec<Vec<Option<Seen>>> = seen.into_values().collect();
        let id = |place: usize| self.log.vehicles()[place].id.clone();
        let names: Vec<String> = std::iter::once(self.ego.index())
            .chain(places.iter().copied())
            .map(id)
            .collect();
        let by = |demand: &Demand| {
            let actor = demand.actor?;
            places.iter().position(|place| *place == actor.index())
        };
        let worst = self.worst(&names, &moments, &columns, |row, camera| {
            let demand = &demands[row].demands[camera];
            (demand.fpr, by(demand))
        });
        let actors = columns
            .iter()
            .map(|column| actor(column, panel.models.len()));
        let bodies = columns.iter().zip(&names[1..]);
        let bodies = bodies.map(|(column, name)| body(name, column));
        let eyes = self.system.perception.eyes.iter().enumerate();
        let cameras = eyes.map(|(place, eye)| {
            let demands = || demands.iter().map(|step| &step.demands[place]);
            let asking = demands().map(|demand| by(demand).map(|place| place as f64));
            Camera {
                name: eye.camera.name.clone(),
                analysed: eye.camera.analysed,
                forward_m: eye.camera.forward,
                left_m: eye.camera.left,
                yaw_rad: eye.camera.yaw,
                fov_rad: eye.camera.fov,
                range_m: eye.camera.range,
                rate_fpr: Steps::new(demands().map(|_| Some(self.rates.all()[place]))),
                demand_fpr: Steps::new(demands().map(|demand| Some(demand.fpr))),
                demand_actor: Steps::new(asking),
                online_fpr: None,
            }
        });
        let mut largest = 0.0;
        for step in &demands {
            for (watch, demand) in rig.iter().zip(&step.demands) {
                if watch.camera.analysed && demand.fpr > largest {
                    largest = demand.fpr;
                }
            }
        }
        let along: Vec<f64> = moments.iter().map(|moment| moment.ego.s).collect();
        Document {
            kind: "drive",
            schema: 1,
            provenance: self.provenance(),
            summary: self.summary(&moments, &columns, largest),
            step_s: None,
            times_s: Some(Track::new(
                1e6,
                moments.iter().map(|moment| Some(moment.time)),
            )),
            rows: moments.len(),
            road: match self.road {
                Some(road) => Road::along(road, &along),
                None => Road {
                    lane_width_m: 0.0,
                    lines: Vec::new(),
                },
            },
            bodies: std::iter::once(ego(&names[0], &moments))
                .chain(bodies)
                .collect(),
            actors: actors.collect(),
            cameras: cameras.collect(),
            models: panel.names(),
            believes: false,
            manoeuvre: None,
            asked_mps2: None,
            moments: worst.moments(),
            explanation: None,
        }
    }

    fn rig(&self) -> Vec<Watch<'_>> {
        let eyes = self.system.perception.eyes.iter().zip(self.rates.all());
        let fixed = self.system.current_latency;
        eyes.map(|(eye, hz)| Watch {
            camera: &eye.camera,
            current_latency: fixed.unwrap_or(1.0 / hz),
        })
        .collect()
    }

    /// All others at a moment, with their places in the log.
    fn seen(&self, moment: &Moment<'_>, rig: &[Watch<'_>], panel: &Panel) -> Vec<(usize, Seen)> {
        let mut view = View::default();
        let mut visible = vec![false; moment.actors.len()];
        for watch in rig {
            let bodies = moment.actors.iter().map(|actor| &actor.body);
            let boxes = bodies.map(|body| (body.footprint, body.pose));
            view.look_at_boxes(watch.camera, moment.pose, boxes);
            for (place, visible) in visible.iter_mut().enumerate() {
                *visible = *visible || view.sees(place, self.system.perception.visible_share);
            }
        }
        let actors = moment.actors.iter().zip(visible);
        let seen = actors.map(|(actor, visible)| {
            let body: &Truth = &actor.body;
            let covering = rig
                .iter()
                .filter(|watch| watch.camera.covers_body(moment.pose, body));
            let future = Future::new(actor.future.trajectory(), moment.time);
            // No margin: this is measured, and no corridor of a model.
            let approach = Approach::of(&moment.ego, body.footprint, &future, 0.0);
            let latencies = most_demanding(
                panel.models.len(),
                covering.map(|watch| watch.current_latency),
                |l_0| panel.answers(&moment.ego, body.footprint, &future, l_0),
            );
            let (dx, dy) = (body.pose.x - moment.pose.x, body.pose.y - moment.pose.y);
            let seen = Seen {
                pose: body.pose,
                speed: body.speed,
                accel: body.accel,
                footprint: body.footprint,
                visible,
                distance: libm::hypot(dx, dy),
                gap: approach.map(|approach| approach.gap),
                ttc: approach.and_then(|approach| approach.ttc()),
                latencies,
            };
            (actor.id.index(), seen)
        });
        seen.collect()
    }

    fn worst<'w>(
        &'w self,
        names: &'w [String],
        moments: &[Moment<'_>],
        columns: &[Vec<Option<Seen>>],
        demand: impl Fn(usize, usize) -> (f64, Option<usize>),
    ) -> Worst<'w> {
        let eyes = &self.system.perception.eyes;
        let cameras = eyes.iter().map(|eye| eye.camera.name.as_str());
        let mut worst = Worst::new(names, cameras.collect());
        for (row, moment) in moments.iter().enumerate() {
            worst.braking(moment.time, -moment.ego.accel);
            for (camera, eye) in eyes.iter().enumerate() {
                if eye.camera.analysed {
                    let rate = self.rates.all()[camera];
                    worst.camera(moment.time, camera, demand(row, camera), rate);
                }
            }
            for (place, column) in columns.iter().enumerate() {
                if let Some(seen) = &column[row] {
                    worst.closeness(moment.time, place, seen.gap, seen.ttc);
                }
            }
        }
        worst
    }

    /// What of a drive's summary a recording has.
    fn summary(
        &self,
        moments: &[Moment<'_>],
        columns: &[Vec<Option<Seen>>],
        largest: f64,
    ) -> Value {
        let all = || columns.iter().flatten().flatten();
        let gap = all().filter_map(|seen| seen.gap).min_by(f64::total_cmp);
        let ttc = all().filter_map(|seen| seen.ttc).min_by(f64::total_cmp);
        let decel = moments.iter().map(|moment| -moment.ego.accel);
        let first = moments.first().map_or(0.0, |moment| moment.time);
        let last = moments.last().map_or(0.0, |moment| moment.time);
        let rates = self.rates.all().iter();
        let cameras: Vec<Value> = rates.map(|rate| json!({ "rate_fpr": rate })).collect();
        json!({
            "scenario": self.name,
            "title": format!("A recording, seen by vehicle {}", self.log.vehicle(self.ego).id),
            "seed": null,
            "root_seed": null,
            "collision": null,
            "end_s": last,
            "recorded_s": last - first,
            "smallest_gap_m": gap,
            "smallest_ttc_s": ttc,
            "manoeuvres": [],
            "notes": [],
            "hardest_braking_mps2": decel.max_by(f64::total_cmp),
            "estimate": { "largest_fpr": largest },
            "cameras": cameras,
            "share_of_30_fpr": null,
        })
    }

    fn provenance(&self) -> Provenance {
        let l_0 = match self.system.current_latency {
            Some(latency) => format!("{:.1} ms", 1e3 * latency),
            None => "each camera's own frame period".to_string(),
        };
        let frame = match self.road {
            Some(_) => "The frame is that of the road",
            None => "The frame is that of the ego's own recorded path",
        };
        let hash = |text: &str| format!("BLAKE3 {}", blake3::hash(text.as_bytes()).to_hex());
        Provenance {
            version: self.version.to_string(),
            command: self.command.clone(),
            sources: vec![
                ("Recording", format!("{} of {}", hash(self.text), self.name)),
                ("System", hash(&self.system.to_ron())),
                (
                    "Left out",
                    format!("vehicles that never come within {REACH} m of the ego"),
                ),
            ],
            rounding: ROUNDING,
            demand: format!(
                "Demand: what the recording asks of each camera at each of its steps by the paper's estimator, with l_0 = {l_0}. \
                 {frame}; occlusion is ignored for demands, and behind its last row a vehicle keeps its speed and offset."
            ),
            contains: CONTAINS,
        }
    }
}

fn actor(column: &[Option<Seen>], models: usize) -> Actor {
    let rows = || column.iter().map(Option::as_ref);
    let nothing = || Track::new(1.0, column.iter().map(|_| None));
    let visible = rows().map(|seen| u32::from(seen.is_some_and(|seen| seen.visible)));
    let never = || Steps::whole(column.iter().map(|_| 0));
    let ttc = rows().map(|seen| seen?.ttc.filter(|ttc| *ttc <= LONGEST_TTC));
    let latency = |model: usize| Steps::new(rows().map(|seen| seen?.latencies[model]));
    Actor {
        visible: Steps::whole(visible),
        confirmed: never(),
        found: never(),
        needed: 0,
        believed_x_m: nothing(),
        believed_y_m: nothing(),
        believed_speed_mps: nothing(),
        age_s: nothing(),
        gap_m: Track::new(1e3, rows().map(|seen| seen?.gap)),
        ttc_s: Track::new(1e3, ttc),
        latency_s: (0..models).map(latency).collect(),
    }
}

fn body(name: &str, column: &[Option<Seen>]) -> Body {
    let of = |per: f64, number: fn(&Seen) -> f64| {
        Track::new(per, column.iter().map(|seen| seen.as_ref().map(number)))
    };
    let footprint = column.iter().flatten().next().map(|seen| seen.footprint);
    Body {
        name: name.to_string(),
        length_m: footprint.map_or(0.0, |footprint| footprint.length),
        width_m: footprint.map_or(0.0, |footprint| footprint.width),
        x_m: of(1e3, |seen| seen.pose.x),
        y_m: of(1e3, |seen| seen.pose.y),
        heading_rad: of(1e5, |seen| seen.pose.heading),
        speed_mps: of(1e3, |seen| seen.speed),
        accel_mps2: of(1e3, |seen| seen.accel),
    }
}

fn ego(name: &str, moments: &[Moment<'_>]) -> Body {
    let of = |per: f64, number: fn(&Moment<'_>) -> f64| {
        Track::new(per, moments.iter().map(|moment| Some(number(moment))))
    };
    let footprint = moments.first().map(|moment| moment.ego.footprint);
    Body {
        name: name.to_string(),
        length_m: footprint.map_or(0.0, |footprint| footprint.length),
        width_m: footprint.map_or(0.0, |footprint| footprint.width),
        x_m: of(1e3, |moment| moment.pose.x),
        y_m: of(1e3, |moment| moment.pose.y),
        heading_rad: of(1e5, |moment| moment.pose.heading),
        speed_mps: of(1e3, |moment| moment.ego.speed),
        accel_mps2: of(1e3, |moment| moment.ego.accel),
    }
}
