//! Why a model asked for too little: would it have been enough in a kinder world?
//!
//! A step at which a model is short is put to the procedure again under other assumptions, from the kindest in a word on:
//!
//! | cause | what the model asked for would have been enough, had |
//! |---|---|
//! | brakes | the ego braked as hard as most rivals count on ([`Panel::braking_harder`]), not by a_b |
//! | future | the actors gone on from t_0 with the velocity they had |
//! | both | both been so |
//! | other | not even then: lane rules, thresholds, the ego's own acceleration, the instant at which a model stops looking |
//!
//! The first that holds counts. Left out: other assumptions of the models, such as a braking that builds up.

use zhuyi_core::{Across, ActorId, Along, Extent};
use zhuyi_estimator::{Demand, Estimator, Future};
use zhuyi_sim::Hindsight;
use zhuyi_sim::trace::Row;

use super::models::Panel;

/// What the procedure would have needed in kinder worlds, per camera.
#[derive(Clone, Debug)]
pub struct KinderWorlds {
    worlds: [Vec<Demand>; 3],
}

/// How many steps fell to each cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Causes {
    /// Only the brakes.
    pub brakes: u64,
    /// Only what the actors did after t_0.
    pub future: u64,
    /// Both together.
    pub both: u64,
    /// Neither.
    pub other: u64,
}

impl KinderWorlds {
    /// At one row.
    pub fn new(panel: &Panel, hindsight: &Hindsight<'_>, row: &Row<'_>) -> Self {
        let steady = |estimator: &Estimator| {
            hindsight.demands_by(estimator, row, |actor: ActorId, current_latency| {
                let (ego, body, future) = hindsight.question(row, actor);
                let Some(start) = future.start() else {
                    return estimator.trajectory(&ego, body, &future, current_latency);
                };
                let along = [Along::constant_accel(future.now, start.s, start.speed, 0.0)];
                let across = [Across {
                    time: future.now,
                    d: start.d,
                    d_rate: start.d_rate,
                }];
                let stands = Extent::held(future.box_at(body, 0.0));
                let extents = [Extent {
                    time: future.now,
                    ..stands
                }];
                let going_on = Future {
                    along: &along,
                    across: &across,
                    extents: &extents,
                    ..future
                };
                estimator.trajectory(&ego, body, &going_on, current_latency)
            })
        };
        Self {
            worlds: [
                hindsight.demands(&panel.braking_harder, row),
                steady(panel.procedure()),
                steady(&panel.braking_harder),
            ],
        }
    }

    /// Counts the cause of a model's shortfall on a camera.
    pub fn count(&self, camera: usize, asked: &Demand, causes: &mut Causes) {
        let enough = |world: &[Demand]| asked.latency <= world[camera].latency;
        let [brakes, future, both] = &self.worlds;
        if enough(brakes) {
            causes.brakes += 1;
        } else if enough(future) {
            causes.future += 1;
        } else if enough(both) {
            causes.both += 1;
        } else {
            causes.other += 1;
        }
    }
}

impl Causes {
    /// Adds the counts of another.
    pub fn add(&mut self, other: &Self) {
        self.brakes += other.brakes;
        self.future += other.future;
        self.both += other.both;
        self.other += other.other;
    }
}
