//! The columns of a drive, gathered row by row.

use zhuyi_core::Body as Truth;
use zhuyi_core::approach::time_to_collision;
use zhuyi_core::boxes::{distance, swept_gap};
use zhuyi_core::{ActorId, FrameRates, LaneFrame};
use zhuyi_estimator::{Demand, Estimate, Estimator};
use zhuyi_perception::View;
use zhuyi_sim::Hindsight;
use zhuyi_sim::trace::Row;
use zhuyi_studies::compare::models::Panel;

use super::Drive;
use super::column::{Steps, Track};
use super::document::{Actor, Body, Camera};
use super::moments::{Moment, Worst};

/// [s] the largest time to collision that is told.
pub(crate) const LONGEST_TTC: f64 = 30.0;

/// All columns.
pub(super) struct Columns {
    pub(super) bodies: Vec<Body>,
    pub(super) actors: Vec<Actor>,
    pub(super) cameras: Vec<Camera>,
    pub(super) models: Vec<&'static str>,
    pub(super) manoeuvre: Option<Steps>,
    pub(super) asked: Option<Track>,
    pub(super) moments: Vec<Moment>,
}

/// What is estimated at every row: per row and camera the demand, per row and actor the latency [s] by every model.
struct Estimates {
    models: Vec<&'static str>,
    demands: Vec<Vec<Demand>>,
    latencies: Vec<Vec<Vec<Option<f64>>>>,
}

impl Columns {
    pub(super) fn of(drive: &Drive<'_>) -> Self {
        let (trace, witness) = (&drive.run.trace, drive.witness);
        let estimates = Estimates::of(drive);
        let eyes = &drive.system.perception.eyes;
        let names = eyes.iter().map(|eye| eye.camera.name.as_str());
        let mut worst = Worst::new(trace.names(), names.collect());
        for (place, row) in trace.rows().enumerate() {
            let time = row.time.seconds();
            let lane = LaneFrame::at(&drive.scenario.road, row.ego.road.d);
            worst.ego(&row);
            let rates = witness.rates(place).iter().enumerate();
            for (camera, rate) in rates.filter(|(camera, _)| eyes[*camera].camera.analysed) {
                let demand = &estimates.demands[place][camera];
                let by = demand.actor.map(ActorId::index);
                worst.camera(time, camera, (demand.fpr, by), *rate);
            }
            for actor in 0..row.actors.len() {
                let (gap, ttc) = closeness(&lane, row.ego, &row.actors[actor]);
                worst.closeness(time, actor, gap, ttc);
                let belief = &witness.beliefs(place)[actor];
                if let (true, Some(track)) = (belief.confirmed, &belief.track) {
                    let mut track = *track;
                    let truth = row.actors[actor].road.s;
                    track.road.s = drive.run.trace.nearest_lap(track.road.s, truth);
                    worst.belief(&row, actor, &track);
                }
            }
        }
        let actors = drive.scenario.actors.len();
        let visible = visible(drive);
        let asked = trace.rows().map(|row| Some(row.command.accel));
        let manoeuvre = trace.rows().map(|row| row.command.manoeuvre as u32);
        Self {
            bodies: (0..=actors).map(|place| body(drive, place)).collect(),
            actors: (0..actors)
                .map(|place| actor(drive, &estimates, &visible, place))
                .collect(),
            cameras: (0..eyes.len())
                .map(|place| camera(drive, &estimates, place))
                .collect(),
            moments: worst.moments(),
            manoeuvre: Some(Steps::whole(manoeuvre)),
            asked: Some(Track::new(1e3, asked)),
            models: estimates.models,
        }
    }
}

impl Estimates {
    fn of(drive: &Drive<'_>) -> Self {
        let mut system = drive.system.clone();
        if drive.by_policy {
            system.current_latency = system.online.current_latency;
        }
        let panel = Panel::new(&system);
        let estimator = Estimator::new(system.estimator.clone());
        let (mut demands, mut latencies) = (Vec::new(), Vec::new());
        // l_0 is what changes with the rates, where it is not fixed.
        let mut known: Option<(Vec<f64>, Hindsight<'_>)> = None;
        for (place, row) in drive.run.trace.rows().enumerate() {
            let rates = drive.witness.rates(place);
            let stale = |known: &(Vec<f64>, Hindsight<'_>)| {
                system.current_latency.is_none() && known.0 != rates
            };
            if known.as_ref().is_none_or(stale) {
                let rates = rates.to_vec();
                let set = FrameRates::new(rates.clone());
                known = Some((
                    rates,
                    Hindsight::new(&drive.run.trace, &drive.scenario.road, &system, &set),
                ));
            }
            let Some((_, hindsight)) = &known else {
                continue;
            };
            demands.push(hindsight.demands(&estimator, &row));
            let actors = (0..row.actors.len()).map(|actor| {
                let (ego, footprint, future) = hindsight.question(&row, ActorId(actor as u32));
                let eyes = system.perception.eyes.iter().zip(rates);
                let covering = eyes
                    .filter(|(eye, _)| eye.camera.covers_body(row.ego.pose, &row.actors[actor]));
                let l_0 = covering.map(|(_, hz)| system.current_latency.unwrap_or(1.0 / hz));
                most_demanding(panel.models.len(), l_0, |l_0| {
                    panel.answers(&ego, footprint, &future, l_0)
                })
            });
            latencies.push(actors.collect());
        }
        Self {
            models: panel.names(),
            demands,
            latencies,
        }
    }
}

/// [s] the tolerable latency for an actor by so many models: the most demanding answer over the cameras that have it in view,
/// given the current latencies [s] of these, and what all models answer at one; none of a model that is not defined for it.
pub(crate) fn most_demanding(
    models: usize,
    current_latencies: impl Iterator<Item = f64>,
    answers: impl Fn(f64) -> Vec<Option<Estimate>>,
) -> Vec<Option<f64>> {
    let mut most: Option<Vec<Option<Estimate>>> = None;
    let mut done: Vec<f64> = Vec::new();
    for l_0 in current_latencies {
        if done.contains(&l_0) {
            continue;
        }
        done.push(l_0);
        let answers = answers(l_0);
        most = Some(match most {
            None => answers,
            Some(before) => before
                .into_iter()
                .zip(answers)
                .map(|(one, other)| match (one, other) {
                    (Some(one), Some(other)) if one.by_importance(&other).is_gt() => Some(other),
                    (one, _) => one,
                })
                .collect(),
        });
    }
    match most {
        None => vec![None; models],
        Some(answers) => answers
            .iter()
            .map(|answer| answer.as_ref().and_then(latency))
            .collect(),
    }
}

fn latency(estimate: &Estimate) -> Option<f64> {
    let helps = estimate.fpr().is_some();
    helps.then(|| estimate.latency.unwrap_or(0.0))
}

/// Per actor and row whether some camera sees it.
fn visible(drive: &Drive<'_>) -> Vec<Vec<bool>> {
    let perception = &drive.system.perception;
    let mut view = View::default();
    let mut visible = vec![Vec::new(); drive.scenario.actors.len()];
    for row in drive.run.trace.rows() {
        let mut seen = vec![false; row.actors.len()];
        for eye in &perception.eyes {
            let boxes = row.actors.iter().map(|body| (body.footprint, body.pose));
            view.look_at_boxes(&eye.camera, row.ego.pose, boxes);
            for (actor, seen) in seen.iter_mut().enumerate() {
                *seen = *seen || view.sees(actor, perception.visible_share);
            }
        }
        for (column, seen) in visible.iter_mut().zip(seen) {
            column.push(seen);
        }
    }
    visible
}

/// [m] least distance of the boxes and [s] time to collision along the ego's lane, of an actor ahead that overlaps the ego side
/// to side; as the smallest ones of a run ([`zhuyi_sim::Extremes`]).
fn closeness(lane: &LaneFrame<'_>, ego: &Truth, other: &Truth) -> (Option<f64>, Option<f64>) {
    if !other.overlaps_sideways(ego) || other.road.s <= ego.road.s {
        return (None, None);
    }
    let (along, ahead) = (lane.body(ego), lane.body(other));
    let gap = if ego.turn == 0.0 && other.turn == 0.0 {
        ahead.rear() - along.front()
    } else {
        distance((ego.footprint, ego.pose), (other.footprint, other.pose))
    };
    let closing = along.s_rate - ahead.s_rate;
    let ttc = swept_gap(&along, &ahead).and_then(|gap| time_to_collision(gap, closing));
    ((gap >= 0.0).then_some(gap), ttc)
}

fn body(drive: &Drive<'_>, place: usize) -> Body {
    let trace = &drive.run.trace;
    let at = |row: &Row<'_>| match place {
        0 => *row.ego,
        actor => row.actors[actor - 1],
    };
    let of = |per: f64, number: fn(&Truth) -> f64| {
        let numbers = trace.rows().map(|row| Some(number(&at(&row))));
        Track::new(per, numbers)
    };
    let footprint = at(&trace.row(0)).footprint;
    Body {
        name: trace.names()[place].clone(),
        length_m: footprint.length,
        width_m: footprint.width,
        x_m: of(1e3, |body| body.pose.x),
        y_m: of(1e3, |body| body.pose.y),
        heading_rad: of(1e5, |body| body.pose.heading),
        speed_mps: of(1e3, |body| body.speed),
        accel_mps2: of(1e3, |body| body.accel),
    }
}

fn actor(drive: &Drive<'_>, estimates: &Estimates, visible: &[Vec<bool>], place: usize) -> Actor {
    let (trace, road) = (&drive.run.trace, &drive.scenario.road);
    let beliefs = || (0..trace.len()).map(|row| &drive.witness.beliefs(row)[place]);
    let tracks = || beliefs().map(|belief| belief.track.as_ref());
    let poses = || tracks().map(|track| track.map(|track| road.world_from_road(track.road)));
    let age = trace
        .rows()
        .zip(tracks())
        .map(|(row, track)| track.map(|track| (row.time - track.seen).seconds().max(0.0)));
    let near = || {
        trace.rows().map(|row| {
            let lane = LaneFrame::at(road, row.ego.road.d);
            closeness(&lane, row.ego, &row.actors[place])
        })
    };
    let ttc = near().map(|(_, ttc)| ttc.filter(|ttc| *ttc <= LONGEST_TTC));
    let speed = tracks().map(|track| track.map(|track| track.s_rate));
    let latencies = (0..estimates.models.len()).map(|model| {
        let answers = estimates.latencies.iter();
        Steps::new(answers.map(|actors| actors[place][model]))
    });
    Actor {
        visible: Steps::whole(visible[place].iter().map(|seen| u32::from(*seen))),
        confirmed: Steps::whole(beliefs().map(|belief| u32::from(belief.confirmed))),
        found: Steps::whole(beliefs().map(|belief| belief.found.min(belief.needed))),
        needed: beliefs().next().map_or(0, |belief| belief.needed),
        believed_x_m: Track::new(1e3, poses().map(|pose| pose.map(|pose| pose.x))),
        believed_y_m: Track::new(1e3, poses().map(|pose| pose.map(|pose| pose.y))),
        believed_speed_mps: Track::new(1e3, speed),
        age_s: Track::new(1e3, age),
        gap_m: Track::new(1e3, near().map(|(gap, _)| gap)),
        ttc_s: Track::new(1e3, ttc),
        latency_s: latencies.collect(),
    }
}

fn camera(drive: &Drive<'_>, estimates: &Estimates, place: usize) -> Camera {
    let camera = &drive.system.perception.eyes[place].camera;
    let rows = || 0..drive.run.trace.len();
    let demands = || estimates.demands.iter().map(|cameras| &cameras[place]);
    let online = (!drive.run.decisions.is_empty()).then(|| {
        let mut asked = drive.run.decisions.iter().peekable();
        let mut held = None;
        Steps::new(drive.run.trace.rows().map(|row| {
            while let Some(decision) = asked.next_if(|asked| asked.time <= row.time) {
                held = Some(decision.demands[place].fpr);
            }
            held
        }))
    });
    let by = demands().map(|demand| demand.actor.map(|actor| f64::from(actor.0)));
    Camera {
        name: camera.name.clone(),
        analysed: camera.analysed,
        forward_m: camera.forward,
        left_m: camera.left,
        yaw_rad: camera.yaw,
        fov_rad: camera.fov,
        range_m: camera.range,
        rate_fpr: Steps::new(rows().map(|row| Some(drive.witness.rates(row)[place]))),
        demand_fpr: Steps::new(demands().map(|demand| Some(demand.fpr))),
        demand_actor: Steps::new(by),
        online_fpr: online,
    }
}
