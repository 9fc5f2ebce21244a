//! The online estimate: what the ego asks of its cameras while it drives, from what it believes (paper, "Zhuyi-based AV
//! system", post-deployment).
//!
//! ```text
//!  tracks ──[predictor: several futures with probabilities]──▶ Forecasts ──[estimator]──▶ demand per camera
//! ```
//!
//! Nothing of the truth enters but the ego's own localisation. l_0 is fixed at 1/30 s unless the system says otherwise:
//! with the latency at which the camera runs now the demand feeds on itself (reading R22).

use std::sync::Arc;

use zhuyi_core::{Body, Forecast, LaneFrame, Road, SimTime, Track};
use zhuyi_estimator::phantom::{View, ViewAlong};
use zhuyi_estimator::rivals::Rivals;
use zhuyi_estimator::{
    Answer, Demand, Ego, Estimator, Future, Moment, Phantom, PhantomParams, SafetyModel, Seen,
    Watch,
};
use zhuyi_scenario::System;
use zhuyi_scheduler::{Demands, LooksAt};

use crate::surroundings::{believed, surroundings};
use crate::uncleared::{Look, Uncleared};

/// The estimator on what the ego believes.
#[derive(Debug)]
pub struct Online {
    system: Arc<System>,
    road: Arc<Road>,
    estimator: Estimator,
    rivals: Rivals,
    forecasts: Vec<Forecast>,
    uncleared: Uncleared,
    models: LooksAt,
}

/// What was asked of every camera at one time, in the order of the rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// When.
    pub time: SimTime,
    /// By the paper's model.
    pub demands: Vec<Demand>,
    /// By every model that a policy may share by.
    pub by_model: Vec<Demands>,
    /// [Hz] sum of 1/l over the actors that a camera covers.
    pub importance: Vec<f64>,
    /// [Hz] the rate that the camera had.
    pub rates: Vec<f64>,
    /// [Hz] the rate that it has from then on.
    pub granted: Vec<f64>,
    /// Whether that falls short of the demand.
    pub alarms: Vec<bool>,
}

impl Online {
    /// Of an ego with this system on this road.
    pub fn new(system: impl Into<Arc<System>>, road: impl Into<Arc<Road>>) -> Self {
        let system = system.into();
        Self {
            road: road.into(),
            estimator: Estimator::new(system.estimator.clone()),
            system,
            rivals: Rivals::default(),
            forecasts: Vec::new(),
            uncleared: Uncleared::default(),
            models: LooksAt::ALL,
        }
    }

    /// Leaves out models that nobody looks at: what they ask for is told as the paper's.
    #[must_use]
    pub fn looked_at(self, models: LooksAt) -> Self {
        Self { models, ..self }
    }

    /// What the ego asks for, with its cameras at `rates` [Hz], each having processed so many frames.
    pub fn ask(
        &mut self,
        time: SimTime,
        body: &Body,
        tracks: &[Track],
        rates: Vec<f64>,
        processed: &[u64],
    ) -> Asked {
        let (system, road) = (self.system.clone(), self.road.clone());
        let predictor = system.online.predictor;
        let lane = LaneFrame::at(&road, body.road.d);
        self.forecasts.clear();
        let forecasts = tracks
            .iter()
            .map(|track| predictor.forecast(&lane.track(track), &road));
        self.forecasts.extend(forecasts);
        let place = |track: &Track| believed(track, &road).pose;
        let seen: Vec<Seen<'_>> = tracks
            .iter()
            .zip(&self.forecasts)
            .map(|(track, forecast)| Seen {
                pose: place(track),
                forecast,
            })
            .collect();
        let l_0 = system.online.current_latency;
        let eyes = system.perception.eyes.iter().zip(&rates);
        let rig: Vec<Watch<'_>> = eyes
            .map(|(eye, hz)| Watch {
                camera: &eye.camera,
                current_latency: l_0.unwrap_or(1.0 / hz),
            })
            .collect();
        let moment = Moment {
            ego: Ego {
                s: lane.place(body.road.s),
                ..Ego::from(body)
            },
            pose: body.pose,
            now: 0.0,
            seen: &seen,
            rig: &rig,
        };
        let mut demands = vec![self.estimator.quiet(); rig.len()];
        let mut importance = vec![0.0; rig.len()];
        let mut places = seen.iter();
        self.estimator
            .moment(&moment, &mut demands, |answer: Answer| {
                let seen = places.next();
                for (watch, sum) in rig.iter().zip(&mut importance) {
                    let covers = seen.is_some_and(|seen| covers(watch, &moment, seen));
                    if covers {
                        *sum += answer.forecast.estimate.importance();
                    }
                }
            });
        let paper: Vec<f64> = demands.iter().map(|demand| demand.fpr).collect();
        let by = |model: &dyn SafetyModel| {
            if self.models.rivals {
                self.by_model(model, &moment)
            } else {
                paper.clone()
            }
        };
        let (rss, ttc, pylot) = (
            by(&self.rivals.rss),
            by(&self.rivals.ttc),
            by(&self.rivals.pylot),
        );
        let phantom = if self.models.phantoms {
            self.with_phantoms(body, tracks, processed, &rig, &demands)
        } else {
            paper.clone()
        };
        let by_model = (0..rig.len()).map(|camera| Demands {
            zhuyi: paper[camera],
            phantom: phantom[camera],
            rss: rss[camera],
            ttc: ttc[camera],
            pylot: pylot[camera],
            offline: None,
        });
        Asked {
            time,
            by_model: by_model.collect(),
            alarms: vec![false; rig.len()],
            granted: rates.clone(),
            demands,
            importance,
            rates,
        }
    }

    /// [Hz] the demands of who is confirmed, and of who may stand where no camera sees past them, or has seen for too short a
    /// time to tell.
    fn with_phantoms(
        &mut self,
        ego: &Body,
        tracks: &[Track],
        processed: &[u64],
        rig: &[Watch<'_>],
        demands: &[Demand],
    ) -> Vec<f64> {
        let believed = |track: &Track| believed(track, &self.road);
        let bodies: Vec<Body> = tracks.iter().map(believed).collect();
        let around = surroundings(&self.road, ego, &bodies);
        let params = PhantomParams {
            footprint: self.system.vehicle.footprint,
            speed: 0.0,
            headway: self.system.online.phantom_headway,
            visible_share: self.system.perception.visible_share,
        };
        let mut demands = demands.to_vec();
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
            processed,
            params: &params,
        });
        let footprint = params.footprint;
        for ((watch, view), demand) in rig.iter().zip(&views).zip(&mut demands) {
            // The nearest asks for the most.
            let mut view = ViewAlong::new(*view);
            let in_view = |phantom: &&Phantom| view.concerns(footprint, phantom.pose);
            if let Some(nearest) = self.uncleared.phantoms().find(in_view) {
                let (rig, demand) = (std::slice::from_ref(watch), std::slice::from_mut(demand));
                self.estimator
                    .add_phantom(ego, nearest, footprint, rig, demand);
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

fn covers(watch: &Watch<'_>, moment: &Moment<'_>, seen: &Seen<'_>) -> bool {
    watch
        .camera
        .covers_box(moment.pose, seen.forecast.footprint, seen.pose)
}
