//! Demand models: every way in which the frame rate that a camera needs is computed while driving.
//!
//! | id | demand on a camera |
//! |---|---|
//! | `zhuyi` | by the paper's model, from what is perceived and predicted; always there |
//! | `phantom` | the same, or what an actor would demand that stands where no camera looks, whichever is more |
//! | `importance` | sum of 1/l over the actors that it covers |
//! | `offline` | by the paper's model with the true future, where the run is told it |
//! | `rss`, `ttc`, `pylot`, .. | by a safety model: the highest over the actors that it covers, of each the likeliest future |
//!
//! All are in Hz, and 1 where nothing is demanded (`importance`: 0). A policy names those that it looks at
//! ([`Policy::demand_models`](zhuyi_core::stages::Policy::demand_models)); no others are computed. A safety model of the user's
//! ([`RunSpec::with_safety_model`](crate::RunSpec::with_safety_model)) is one more, under its own name.

use std::sync::Arc;

use zhuyi_core::{Body, Road, Track};
use zhuyi_estimator::phantom::View;
use zhuyi_estimator::{Demand, Estimator, Future, Moment, PhantomParams, SafetyModel, Seen, Watch};
use zhuyi_metrics::safety_models::SafetyModels;
use zhuyi_scenario::System;
use zhuyi_scheduler::demands::{IMPORTANCE, OFFLINE, PHANTOM, ZHUYI};

use crate::surroundings::{believed, surroundings};
use crate::uncleared::{Look, Uncleared};

/// A demand model that is no safety model.
pub struct DemandModel {
    /// Name by which policies and files know it.
    pub id: &'static str,
    /// Unit of the demand.
    pub unit: &'static str,
    /// What it is, in half a sentence.
    pub meaning: &'static str,
    /// Computes the demand on each camera, in the order of the rig; none where it is not known.
    compute: fn(&mut DemandModels, &Question<'_>) -> Option<Vec<f64>>,
}

/// What a demand is computed from.
pub(crate) struct Question<'a> {
    pub ego: &'a Body,
    pub tracks: &'a [Track],
    /// Frames that each camera has processed.
    pub processed: &'a [u64],
    /// [Hz] demands that follow from the true future, where they are known.
    pub future: Option<&'a [f64]>,
    pub moment: &'a Moment<'a>,
    /// Demands by the paper's model.
    pub demands: &'a [Demand],
    /// [Hz] sum of 1/l over the actors that each camera covers.
    pub importance: &'a [f64],
}

/// Every demand model that is no safety model; the first is always computed.
pub const DEMAND_MODELS: [DemandModel; 4] = [
    DemandModel {
        id: ZHUYI,
        unit: "Hz",
        meaning: "the paper's model, from what is perceived and predicted",
        compute: |_, question| {
            let demands = question.demands.iter();
            Some(demands.map(|demand| demand.fpr).collect())
        },
    },
    DemandModel {
        id: PHANTOM,
        unit: "Hz",
        meaning: "the paper's model, counting actors assumed where no camera looks",
        compute: |models, question| Some(models.with_phantoms(question)),
    },
    DemandModel {
        id: IMPORTANCE,
        unit: "Hz",
        meaning: "sum of 1/latency over the actors that a camera covers",
        compute: |_, question| Some(question.importance.to_vec()),
    },
    DemandModel {
        id: OFFLINE,
        unit: "Hz",
        meaning: "the paper's model with the true future",
        compute: |_, question| question.future.map(<[f64]>::to_vec),
    },
];

/// Everything that computes demands, with what it remembers of a run.
pub(crate) struct DemandModels {
    system: Arc<System>,
    road: Arc<Road>,
    estimator: Estimator,
    safety_models: SafetyModels,
    /// Safety models of the user's.
    own: Vec<Box<dyn SafetyModel + Send>>,
    uncleared: Uncleared,
}

impl DemandModels {
    /// Creates the models of an ego with this system on this road.
    pub fn new(system: Arc<System>, road: Arc<Road>) -> Self {
        Self {
            estimator: Estimator::new(system.estimator.clone()),
            system,
            road,
            safety_models: SafetyModels::default(),
            own: Vec::new(),
            uncleared: Uncleared::default(),
        }
    }

    /// Returns the system and the road.
    pub fn of(&self) -> (Arc<System>, Arc<Road>) {
        (self.system.clone(), self.road.clone())
    }

    /// Returns the paper's estimator.
    pub fn estimator(&self) -> &Estimator {
        &self.estimator
    }

    /// Adds a safety model of the user's, under its own name.
    pub fn add(&mut self, model: Box<dyn SafetyModel + Send>) {
        self.own.push(model);
    }

    /// Computes the demands [Hz] of a model; none where there is no such model or they are not known.
    pub fn demands(&mut self, id: &str, question: &Question<'_>) -> Option<Vec<f64>> {
        if let Some(model) = DEMAND_MODELS.iter().find(|model| model.id == id) {
            return (model.compute)(self, question);
        }
        if let Some(model) = self.own.iter().find(|model| model.name() == id) {
            return Some(self.by_model(&**model, question.moment));
        }
        let models = self.safety_models.all();
        let model = models.into_iter().find(|model| model.name() == id)?;
        Some(self.by_model(model, question.moment))
    }

    /// [Hz] the demands of who is confirmed, and of who may stand where no camera sees past them, or has seen for too short a
    /// time to tell.
    fn with_phantoms(&mut self, question: &Question<'_>) -> Vec<f64> {
        let (ego, rig) = (question.ego, question.moment.rig);
        let believed = |track: &Track| believed(track, &self.road);
        let bodies: Vec<Body> = question.tracks.iter().map(believed).collect();
        let around = surroundings(&self.road, ego, &bodies);
        let params = PhantomParams {
            footprint: self.system.vehicle.footprint,
            speed: 0.0,
            headway: self.system.online.phantom_headway,
            visible_share: self.system.perception.visible_share,
        };
        let mut demands = question.demands.to_vec();
        self.estimator
            .add_phantoms(&around, rig, &params, &mut demands);
        let views: Vec<View<'_>> = rig
            .iter()
            .map(|watch| View::new(watch.camera, ego.pose))
            .collect();
        self.uncleared.look(&Look {
            road: &self.road,
            eyes: &self.system.perception.eyes,
            views: &views,
            ego,
            bodies: &bodies,
            processed: question.processed,
            params: &params,
        });
        let footprint = params.footprint;
        // The nearest asks for the most.
        let nearest = |camera: usize| self.uncleared.nearest(camera);
        let nearest: Vec<_> = (0..rig.len()).map(nearest).collect();
        for (camera, of_camera) in nearest.iter().enumerate() {
            if let Some((_, phantom)) = of_camera
                && !nearest[..camera].contains(of_camera)
            {
                let counts = |camera: usize| nearest[camera] == *of_camera;
                self.estimator
                    .add_phantom(ego, phantom, footprint, rig, &mut demands, counts);
            }
        }
        demands.iter().map(|demand| demand.fpr).collect()
    }

    /// [Hz] what another model asks of every camera: of each actor the future that is most likely. An actor for which the
    /// model is not defined asks for nothing.
    fn by_model(&self, model: &dyn SafetyModel, moment: &Moment<'_>) -> Vec<f64> {
        let of = |watch: &Watch<'_>| {
            let mut most = self.estimator.quiet().fpr;
            for seen in moment
                .seen
                .iter()
                .filter(|seen| covers(watch, moment, seen))
            {
                let likely = |a: &&(f64, _), b: &&(f64, _)| a.0.total_cmp(&b.0);
                if let Some((_, trajectory)) = seen.forecast.trajectories.iter().max_by(likely) {
                    let future = Future::new(trajectory, moment.now);
                    let footprint = seen.forecast.footprint;
                    let l_0 = watch.current_latency;
                    let answer =
                        self.estimator
                            .by_model(model, &moment.ego, footprint, &future, l_0);
                    let asked = answer.map_or(0.0, |answer| answer.importance());
                    if asked > most {
                        most = asked;
                    }
                }
            }
            most
        };
        moment.rig.iter().map(of).collect()
    }
}

/// Returns whether a camera covers an actor that has been seen.
pub(crate) fn covers(watch: &Watch<'_>, moment: &Moment<'_>, seen: &Seen<'_>) -> bool {
    watch
        .camera
        .covers_box(moment.pose, seen.forecast.footprint, seen.pose)
}
