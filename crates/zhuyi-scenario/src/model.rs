//! A scenario and a system as meant: checked, in SI.

use std::sync::Arc;

use zhuyi_core::{Lane, Road, Segment, SimTime};
use zhuyi_estimator::Params as Estimator;
use zhuyi_perception::Perception;
use zhuyi_planner::PlannerParams;
use zhuyi_prediction::KinematicPredictor;
use zhuyi_scheduler::Compute;
use zhuyi_scheduler::safety::Response;
use zhuyi_world::{Vehicle, script::Actor};

/// Road, ego's start and actors.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Its name: the file's name without `.ron`.
    pub name: String,
    /// One sentence for lists.
    pub title: String,
    /// The road.
    pub road: Arc<Road>,
    /// What the road's reference line was laid out from, to show it.
    pub segments: Vec<Segment>,
    /// The ego's start.
    pub ego: EgoStart,
    /// The actors; their [`zhuyi_core::ActorId`] is their place here.
    pub actors: Vec<Actor>,
    /// How long a run lasts unless the ego touches something.
    pub duration: SimTime,
}

/// How the ego starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EgoStart {
    /// Its lane.
    pub lane: Lane,
    /// [m] arc length of its centre.
    pub s: f64,
    /// [m/s] its speed, which is also the speed it wants.
    pub speed: f64,
}

/// The ego's hardware and software: the same for every scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// Body, actuators and tyres.
    pub vehicle: Vehicle,
    /// Cameras, detection, confirmation and tracking.
    pub perception: Perception,
    /// [Hz] frame rate of each camera unless a run sets it, in the order of the rig.
    pub default_rates: zhuyi_core::FrameRates,
    /// Prediction for the planner.
    pub predictor: KinematicPredictor,
    /// The planner.
    pub planner: PlannerParams,
    /// The estimator.
    pub estimator: Estimator,
    /// [s] l_0, the latency at which the estimator takes every camera to run now; none: each camera's own frame period
    /// (readings R14, R22).
    pub current_latency: Option<f64>,
    /// How long a frame takes.
    pub compute: Compute,
    /// The estimate that the ego makes while it drives.
    pub online: Online,
    /// How the seeds of a sweep differ (reading R18).
    pub jitter: Jitter,
}

/// The estimate in the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Online {
    /// What it expects of others; the planner has a predictor of its own.
    pub predictor: KinematicPredictor,
    /// [s] l_0; none: the latency at which each camera runs now, which feeds on itself (reading R22).
    pub current_latency: Option<f64>,
    /// How often it is made, and rates are decided.
    pub period: SimTime,
    /// [s] headway that hiders are trusted to keep to what they hide, for demands with phantoms.
    pub phantom_headway: f64,
    /// What is done while a camera runs below its demand.
    pub response: Response,
    /// [s] how long that goes on after the last alarm.
    pub hold: f64,
}

/// Spread of the actors' start from seed to seed, uniform in ± these bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jitter {
    /// [m] along the road.
    pub position: f64,
    /// [m/s] of the speed, for actors that move.
    pub speed: f64,
}
