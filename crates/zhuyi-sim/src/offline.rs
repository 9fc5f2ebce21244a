//! The offline estimate: what a run asked of every camera at every step, its future known (readings R14, R21).
//!
//! This is the paper's pre-deployment use: ground truth, one trajectory per actor, the one that was driven.

use zhuyi_core::{ActorId, Body, Camera, CameraId, FrameRates, SimTime};
use zhuyi_estimator::{Demand, Ego, Estimate, Estimator, Recording, Watch};
use zhuyi_perception::Eye;
use zhuyi_scenario::System;

use crate::recorded::futures;
use crate::trace::{Row, Trace};

/// A run's recorded future, ready to be asked at any step.
#[derive(Clone, Debug)]
pub struct Hindsight<'a> {
    trace: &'a Trace,
    futures: Vec<Recording>,
    rig: Vec<Watch<'a>>,
}

impl<'a> Hindsight<'a> {
    /// From a finished run of `system` at `rates`, with l_0 each camera's own frame period unless the system sets another.
    pub fn new(trace: &'a Trace, system: &'a System, rates: &FrameRates) -> Self {
        let watch = |(eye, hz): (&'a Eye, &f64)| Watch {
            camera: &eye.camera,
            current_latency: system.current_latency.unwrap_or(1.0 / hz),
        };
        let rig = system.perception.eyes.iter().zip(rates.all());
        Self {
            trace,
            futures: futures(trace).into_iter().map(Recording::new).collect(),
            rig: rig.map(watch).collect(),
        }
    }

    /// The estimate for one actor at one row.
    pub fn estimate(
        &self,
        estimator: &Estimator,
        row: &Row<'_>,
        actor: ActorId,
        current_latency: f64,
    ) -> Estimate {
        self.estimate_after(estimator, row, actor, current_latency, None)
    }

    /// The same, looked for first where it was.
    fn estimate_after(
        &self,
        estimator: &Estimator,
        row: &Row<'_>,
        actor: ActorId,
        current_latency: f64,
        last: Option<&Estimate>,
    ) -> Estimate {
        let ego = Ego {
            s: row.ego.road.s,
            d: row.ego.road.d,
            speed: row.ego.speed,
            accel: row.ego.accel,
            footprint: row.ego.footprint,
        };
        let (body, future) = (&row.actors[actor.index()], &self.futures[actor.index()]);
        let (footprint, now) = (body.footprint, row.time.seconds());
        match last {
            Some(last) => {
                estimator.recorded_after(&ego, footprint, future, now, current_latency, last)
            }
            None => estimator.recorded(&ego, footprint, future, now, current_latency),
        }
    }

    /// The demand on every camera at one row, in the order of the rig.
    pub fn demands(&self, estimator: &Estimator, row: &Row<'_>) -> Vec<Demand> {
        let actors = row
            .actors
            .iter()
            .enumerate()
            .map(|(i, body)| (ActorId(i as u32), body));
        estimator.demands(&self.rig, row.ego.pose, actors, |actor, current_latency| {
            self.estimate(estimator, row, actor, current_latency)
        })
    }

    /// The largest demands over all rows.
    pub fn peaks(&self, estimator: &Estimator) -> Peaks {
        let quiet = Peak {
            fpr: 0.0,
            time: SimTime::ZERO,
            actor: None,
        };
        let mut peaks = Peaks {
            cameras: vec![quiet; self.rig.len()],
            ..Peaks::default()
        };
        let mut demands = vec![estimator.quiet(); self.rig.len()];
        // The answer of the step before, of each actor.
        let mut last: Vec<Option<Estimate>> = vec![None; self.futures.len()];
        for row in self.trace.rows() {
            let actors = (0..).map(ActorId).zip(row.actors);
            let covers = |camera: &Camera, _, body: &Body| camera.covers_body(row.ego.pose, body);
            let estimate = |actor: ActorId, l_0: f64| {
                let last = &mut last[actor.index()];
                *last.insert(self.estimate_after(estimator, &row, actor, l_0, last.as_ref()))
            };
            estimator.demands_into(&self.rig, actors, covers, estimate, &mut demands);
            self.add(&mut peaks, row.time, &demands);
        }
        peaks
    }

    fn add(&self, peaks: &mut Peaks, time: SimTime, demands: &[Demand]) {
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

/// What a run asked for at most.
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
