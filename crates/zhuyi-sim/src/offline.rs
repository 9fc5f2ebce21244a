//! The offline estimate: what a run asked of every camera at every step, its future known (readings R14, R21).
//!
//! This is the paper's pre-deployment use: ground truth, one trajectory per actor, the one that was driven.
//!
//! Beyond the paper, each an option: [`Hindsight::with_phantoms`] adds an actor wherever nobody looks,
//! [`Hindsight::with_evasion`] lets the ego evade, [`Hindsight::of_the_visible`] leaves out who is hidden (reading R14).

use std::sync::OnceLock;

use zhuyi_core::{
    ActorId, Body, Camera, CameraId, Footprint, FrameRates, Lane, LaneFrame, Road, SimTime,
};
use zhuyi_estimator::phantom::visible_share;
use zhuyi_estimator::{
    Demand, Ego, Estimate, Estimator, Future, Phantom, PhantomParams, Recording, Tolerance, Watch,
};
use zhuyi_perception::Eye;
use zhuyi_scenario::System;

mod covered;
mod told;

use covered::Covered;
use told::Told;

use crate::recorded::futures;
use crate::surroundings::surroundings;
use crate::trace::{Row, Trace};

/// A run's recorded future, ready to be asked at any step.
#[derive(Clone, Debug)]
pub struct Hindsight<'a> {
    trace: &'a Trace,
    road: &'a Road,
    /// The futures along each lane, made when the ego is first in it; on a straight road they are the same along all.
    lanes: Vec<OnceLock<Vec<Recording>>>,
    rig: Vec<Watch<'a>>,
    phantoms: Option<(&'a Road, PhantomParams)>,
    evades_on: Option<&'a Road>,
    least_share: Option<f64>,
}

impl<'a> Hindsight<'a> {
    /// From a finished run of `system` on `road` at `rates`, with l_0 each camera's own frame period unless the system sets
    /// another.
    ///
    /// # Panics
    /// If the trace is empty.
    pub fn new(trace: &'a Trace, road: &'a Road, system: &'a System, rates: &FrameRates) -> Self {
        let watch = |(eye, hz): (&'a Eye, &f64)| Watch {
            camera: &eye.camera,
            current_latency: system.current_latency.unwrap_or(1.0 / hz),
        };
        let rig = system.perception.eyes.iter().zip(rates.all());
        let hindsight = Self {
            trace,
            road,
            lanes: vec![
                OnceLock::new();
                if road.is_straight() {
                    1
                } else {
                    usize::from(road.lanes())
                }
            ],
            rig: rig.map(watch).collect(),
            phantoms: None,
            evades_on: None,
            least_share: None,
        };
        hindsight.futures(hindsight.lane(&trace.row(0)));
        hindsight
    }

    /// Beside the actors count phantoms, at every edge along the ego's path of what no camera sees. The ego brakes for
    /// them, whether it may evade or not.
    #[must_use]
    pub fn with_phantoms(mut self, road: &'a Road, params: PhantomParams) -> Self {
        self.phantoms = Some((road, params));
        self
    }

    /// Where an estimator knows of evasion, the ego may evade to the sides that are free on this road.
    #[must_use]
    pub fn with_evasion(mut self, road: &'a Road) -> Self {
        self.evades_on = Some(road);
        self
    }

    /// An actor counts for a camera only if that sees at least this share [-] of it (reading R17).
    #[must_use]
    pub fn of_the_visible(mut self, least_share: f64) -> Self {
        self.least_share = Some(least_share);
        self
    }

    /// The lane that the ego is in at a row; the first on a straight road.
    fn lane(&self, row: &Row<'_>) -> Lane {
        if self.lanes.len() == 1 {
            return Lane(1);
        }
        LaneFrame::lane(self.road, row.ego.road.d)
    }

    /// The ego at a row, along a lane.
    fn ego_along(&self, row: &Row<'_>, lane: Lane) -> Ego {
        let frame = LaneFrame::of(self.road, lane);
        Ego {
            s: frame.place(row.ego.road.s),
            ..Ego::from(row.ego)
        }
    }

    /// The same as it meets an actor's recorded future: on a ring, where that future counts on over its laps and a row does not,
    /// in the lap in which both are nearest to each other.
    fn ego_before(&self, ego: Ego, row: &Row<'_>, lane: Lane, actor: ActorId) -> Ego {
        if self.trace.lap().is_none() {
            return ego;
        }
        let s = ego.s + self.laps(row, lane, actor);
        Ego { s, ..ego }
    }

    /// The ego at a row, along a lane, as it meets an actor's recorded future.
    fn ego(&self, row: &Row<'_>, lane: Lane, actor: ActorId) -> Ego {
        self.ego_before(self.ego_along(row, lane), row, lane, actor)
    }

    /// [m] laps along a lane from where a row tells an actor to where its recorded future has it; none on an open road.
    fn laps(&self, row: &Row<'_>, lane: Lane, actor: ActorId) -> f64 {
        let Some(lap) = self.trace.lap() else {
            return 0.0;
        };
        let frame = LaneFrame::of(self.road, lane);
        let lap = frame.place(lap) - frame.place(0.0);
        let told = frame.place(row.actors[actor.index()].road.s);
        let (now, recorded) = (
            row.time.seconds(),
            self.futures(lane)[actor.index()].trajectory(),
        );
        let behind = recorded.along.partition_point(|piece| piece.time <= now);
        let piece = &recorded.along[behind.saturating_sub(1)];
        ((piece.s_at(now) - told) / lap).round() * lap
    }

    /// The recorded future of every actor along a lane.
    fn futures(&self, lane: Lane) -> &[Recording] {
        self.lanes[usize::from(lane.0) - 1].get_or_init(|| {
            let frame = LaneFrame::of(self.road, lane);
            let futures = futures(self.trace, frame).into_iter();
            futures.map(Recording::new).collect()
        })
    }

    /// How many actors there are.
    fn actors(&self) -> usize {
        self.trace.names().len() - 1
    }

    /// The estimate for one actor at one row.
    pub fn estimate(
        &self,
        estimator: &Estimator,
        row: &Row<'_>,
        actor: ActorId,
        current_latency: f64,
    ) -> Estimate {
        let lane = self.lane(row);
        let ego = self.ego(row, lane, actor);
        let (body, future) = (
            &row.actors[actor.index()],
            &self.futures(lane)[actor.index()],
        );
        let (footprint, now) = (body.footprint, row.time.seconds());
        if let (Some(road), Some(evasion)) = (self.evades_on, estimator.params().evasion) {
            let known = Future::new(future.trajectory(), now);
            let frame = LaneFrame::of(self.road, lane);
            let others = row.actors.iter().enumerate();
            let others = others.filter(|(place, _)| *place != actor.index());
            let laps = self.laps(row, lane, actor);
            let others: Vec<Body> = others
                .map(|(_, body)| moved(frame.body(body), laps))
                .collect();
            let half_road = f64::from(road.lanes()) * road.lane_width() / 2.0;
            let sides = evasion.free_sides(
                estimator.params(),
                &ego,
                (footprint, &known),
                &others,
                (-half_road, half_road),
            );
            return estimator
                .recorded_evading(&ego, footprint, (future, now), sides, current_latency)
                .estimate;
        }
        estimator.recorded(&ego, footprint, future, now, current_latency)
    }

    /// Whether the ego may evade as far as this estimator knows.
    fn evades(&self, estimator: &Estimator) -> bool {
        self.evades_on.is_some() && estimator.params().evasion.is_some()
    }

    /// What [`Hindsight::estimate`] asks about, for models other than the estimator's own: the ego, the actor's box and its
    /// recorded future.
    pub fn question(&self, row: &Row<'_>, actor: ActorId) -> (Ego, Footprint, Future<'_>) {
        let lane = self.lane(row);
        let recorded = self.futures(lane)[actor.index()].trajectory();
        (
            self.ego(row, lane, actor),
            row.actors[actor.index()].footprint,
            Future::new(recorded, row.time.seconds()),
        )
    }

    /// The demand on every camera at one row, in the order of the rig.
    pub fn demands(&self, estimator: &Estimator, row: &Row<'_>) -> Vec<Demand> {
        self.demands_by(estimator, row, |actor, current_latency| {
            self.estimate(estimator, row, actor, current_latency)
        })
    }

    /// The same where `estimate` answers for an actor at a current latency.
    pub fn demands_by(
        &self,
        estimator: &Estimator,
        row: &Row<'_>,
        mut estimate: impl FnMut(ActorId, f64) -> Estimate,
    ) -> Vec<Demand> {
        let mut demands = vec![estimator.quiet(); self.rig.len()];
        let mut covered = Covered::by(&self.rig, self.actors());
        covered.look(&self.rig, row);
        let tolerance = |actor: ActorId, l_0: f64| estimate(actor, l_0).into();
        self.demands_into(estimator, row, tolerance, &covered, &mut demands);
        demands
    }

    /// The same of a row at which the cameras cover these actors.
    fn demands_into(
        &self,
        estimator: &Estimator,
        row: &Row<'_>,
        tolerance: impl FnMut(ActorId, f64) -> Tolerance,
        covered: &Covered,
        demands: &mut [Demand],
    ) {
        let actors = (0..).map(ActorId).zip(row.actors);
        let counts = |place: usize, actor: ActorId, body: &Body| {
            covered.holds(place, actor) && self.shows(self.rig[place].camera, row, body)
        };
        estimator.demands_into(&self.rig, actors, counts, tolerance, demands);
        if let Some((road, params)) = &self.phantoms {
            let around = surroundings(road, row.ego, row.actors);
            estimator.add_phantoms(&around, &self.rig, params, demands);
        }
    }

    /// Whether an actor that a camera covers is seen well enough to count.
    fn shows(&self, camera: &Camera, row: &Row<'_>, body: &Body) -> bool {
        self.least_share.is_none_or(|least| {
            let (footprint, pose) = (body.footprint, body.pose);
            visible_share(camera, row.ego.pose, footprint, pose, row.actors) >= least
        })
    }

    /// What decides at a row where nobody looks; none without phantoms.
    pub fn phantoms(&self, row: &Row<'_>) -> Vec<Phantom> {
        let phantoms = self.phantoms.as_ref().map(|(road, params)| {
            let around = surroundings(road, row.ego, row.actors);
            around.phantoms(&self.rig, params).collect()
        });
        phantoms.unwrap_or_default()
    }

    /// The largest demands over all rows.
    pub fn peaks(&self, estimator: &Estimator) -> Peaks {
        let mut peaks = self.no_peaks();
        let mut demands = vec![estimator.quiet(); self.rig.len()];
        let mut covered = Covered::by(&self.rig, self.actors());
        let mut told = Told::by(self, estimator);
        // Phantoms and hidden actors depend on where everybody is, and that changes at every row.
        let settled = self.phantoms.is_none() && self.least_share.is_none();
        for (place, row) in self.trace.rows().enumerate() {
            let covered_anew = covered.look(&self.rig, &row);
            let told_anew = told.ask(&row, &covered);
            if place > 0 && settled && !covered_anew && !told_anew {
                continue; // what it was at the row before
            }
            let tolerance = |actor: ActorId, l_0: f64| told.of(actor, l_0);
            self.demands_into(estimator, &row, tolerance, &covered, &mut demands);
            self.add(&mut peaks, row.time, &demands);
        }
        peaks
    }

    /// The largest demands over no rows, to [`Hindsight::add`] to.
    pub fn no_peaks(&self) -> Peaks {
        let quiet = Peak {
            fpr: 0.0,
            time: SimTime::ZERO,
            actor: None,
        };
        Peaks {
            cameras: vec![quiet; self.rig.len()],
            ..Peaks::default()
        }
    }

    /// Takes the demands of one row into the largest.
    pub fn add(&self, peaks: &mut Peaks, time: SimTime, demands: &[Demand]) {
        let mut sum = 0.0;
        for ((demand, watch), peak) in demands.iter().zip(&self.rig).zip(&mut peaks.cameras) {
            if demand.fpr > peak.fpr {
                *peak = Peak {
                    fpr: demand.fpr,
                    time,
                    actor: demand.actor,
                };
            }
            if watch.camera.analysed {
                sum += demand.fpr;
                peaks.beyond_grid |= demand.beyond_grid > 0;
                peaks.unavoidable |= demand.unavoidable > 0;
                peaks.alongside |= demand.alongside > 0;
                peaks.standing |= demand.standing > 0;
                if demand.fpr > peaks.largest {
                    peaks.largest = demand.fpr;
                }
            }
        }
        if sum > peaks.sum {
            peaks.sum = sum;
        }
    }
}

/// A body some laps [m] on.
fn moved(mut body: Body, laps: f64) -> Body {
    body.road.s += laps;
    body
}

/// What a run asked for at most.
#[expect(
    clippy::struct_excessive_bools,
    reason = "findings that do not exclude each other"
)]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Peaks {
    /// [FPR] the largest demand of each camera, in the order of the rig.
    pub cameras: Vec<Peak>,
    /// [FPR] the largest demand of all analysed cameras.
    pub largest: f64,
    /// [FPR] the largest sum over the analysed cameras at one step.
    pub sum: f64,
    /// Whether some step asked an analysed camera for more than the grid offers.
    pub beyond_grid: bool,
    /// Whether at some step even braking at once came too late for an analysed camera.
    pub unavoidable: bool,
    /// Whether at some step an actor in view of an analysed camera was alongside in the corridor.
    pub alongside: bool,
    /// Whether at some step the ego stood in conflict with an actor in view of an analysed camera.
    pub standing: bool,
}

/// A camera's largest demand, when it came first and from whom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// [FPR] the demand.
    pub fpr: f64,
    /// When.
    pub time: SimTime,
    /// From whom; nobody when the camera was never asked for more than the least.
    pub actor: Option<ActorId>,
}

impl Peaks {
    /// A camera's peak.
    pub fn of(&self, camera: CameraId) -> &Peak {
        &self.cameras[camera.index()]
    }
}
