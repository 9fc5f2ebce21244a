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

use zhuyi_core::stages::{DemandSeries, Predictor};
use zhuyi_core::{Body, Forecast, LaneFrame, Road, SimTime, Track};
use zhuyi_estimator::{Answer, Demand, Ego, Moment, SafetyModel, Seen, Watch};
use zhuyi_scenario::System;
use zhuyi_scheduler::demands::ZHUYI;

use crate::demand_models::{DemandModels, Question, covers};
use crate::surroundings::believed;

/// The estimator on what the ego believes.
pub struct Online {
    models: DemandModels,
    /// The tracks along the ego's lane.
    along_lane: Vec<Track>,
    forecasts: Vec<Forecast>,
    /// Ids of the demand models that are computed beside the paper's.
    beside: Vec<String>,
}

/// What was asked of every camera at one time, in the order of the rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// When.
    pub time: SimTime,
    /// By the paper's model.
    pub demands: Vec<Demand>,
    /// By every model that is computed, the paper's first.
    pub by_model: Vec<DemandSeries>,
    /// [Hz] the rate that the camera had.
    pub rates: Vec<f64>,
    /// [Hz] the rate that it has from then on.
    pub granted: Vec<f64>,
    /// Whether that falls short of the demand.
    pub alarms: Vec<bool>,
}

impl Online {
    /// Creates the estimate of an ego with this system on this road, by the paper's model.
    pub fn new(system: impl Into<Arc<System>>, road: impl Into<Arc<Road>>) -> Self {
        Self {
            models: DemandModels::new(system.into(), road.into()),
            along_lane: Vec::new(),
            forecasts: Vec::new(),
            beside: Vec::new(),
        }
    }

    /// Computes demands by these models too. Those of which there is none by that name are left out.
    #[must_use]
    pub fn by_models(mut self, models: &[&str]) -> Self {
        for model in models.iter().filter(|model| **model != ZHUYI) {
            if !self.beside.iter().any(|known| known == model) {
                self.beside.push((*model).to_string());
            }
        }
        self
    }

    /// Adds a safety model of the user's, under its own name.
    pub(crate) fn add(&mut self, model: Box<dyn SafetyModel + Send>) {
        self.models.add(model);
    }

    /// Estimates what the ego demands of its cameras, at `rates` [Hz] now, each having processed so many frames. `future` is the demand
    /// [Hz] on each that follows from the true future, where that is known.
    pub fn ask(
        &mut self,
        time: SimTime,
        body: &Body,
        tracks: &[Track],
        rates: Vec<f64>,
        processed: &[u64],
        future: Option<&[f64]>,
    ) -> Asked {
        let (system, road) = self.models.of();
        let predictor = system.online.predictor;
        let lane = LaneFrame::at(&road, body.road.d);
        let mut forecasts = std::mem::take(&mut self.forecasts);
        self.along_lane.clear();
        self.along_lane
            .extend(tracks.iter().map(|track| lane.track(track)));
        predictor.predict_all(&self.along_lane, &road, &mut forecasts);
        let place = |track: &Track| believed(track, &road).pose;
        let seen: Vec<Seen<'_>> = tracks
            .iter()
            .zip(&forecasts)
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
        let mut demands = vec![self.models.estimator().quiet(); rig.len()];
        let mut importance = vec![0.0; rig.len()];
        let mut places = seen.iter();
        self.models
            .estimator()
            .moment(&moment, &mut demands, |answer: Answer| {
                let seen = places.next();
                for (watch, sum) in rig.iter().zip(&mut importance) {
                    let covers = seen.is_some_and(|seen| covers(watch, &moment, seen));
                    if covers {
                        *sum += answer.forecast.estimate.importance();
                    }
                }
            });
        let question = Question {
            ego: body,
            tracks,
            processed,
            future,
            moment: &moment,
            demands: &demands,
            importance: &importance,
        };
        let ids = std::iter::once(ZHUYI).chain(self.beside.iter().map(String::as_str));
        let models = &mut self.models;
        let series = |id: &str| Some(DemandSeries::new(id, models.demands(id, &question)?));
        let by_model = ids.filter_map(series).collect();
        self.forecasts = forecasts;
        Asked {
            time,
            by_model,
            alarms: vec![false; rig.len()],
            granted: rates.clone(),
            demands,
            rates,
        }
    }
}
