//! What the estimator is asked in the benches, each case by its name: `one_actor/standing` is case `standing` of
//! [`one_actor`].
//!
//! | list | what | one call answers |
//! |---|---|---|
//! | [`one_actor`] | a future of one piece or two; 12 s sampled at 10 Hz, plain and as a [`Recording`] | one trajectory |
//! | [`many`] | actors x trajectories of each, through [`Estimator::forecast`] | all of them |
//! | [`whole_run`] | every actor of a simulated run at every 10 ms step | some thousand trajectories |
//! | [`other_models`] | the models of `safety_models`, and the metrics of `criticality` | one trajectory |
//!
//! In all but the whole run the ego drives at 25 m/s and its camera at 30 FPR; gaps are bumper to bumper.

use std::hint::black_box;
use std::sync::Arc;

use zhuyi_core::{
    Across, ActorId, Along, Footprint, Forecast, FrameRates, LaneFrame, Road, Trajectory,
};
use zhuyi_estimator::samples::{Sample, trajectory};
use zhuyi_estimator::{Ego, Estimate, Estimator, Future, Params, Recording};
use zhuyi_metrics::criticality::{Limits, criticality};
use zhuyi_metrics::safety_models::SafetyModels;
use zhuyi_scenario::{Source, embedded, load};
use zhuyi_sim::{RunSpec, Trace, recorded};

/// A question, or some that belong together.
pub struct Case {
    pub name: &'static str,
    /// How many trajectories one call of `ask` answers for.
    pub trajectories: u32,
    /// How often a latency is held against a piece in one call; None where that is not counted.
    pub evaluations: Option<u32>,
    pub ask: Box<dyn Fn()>,
}

const CAR: Footprint = Footprint {
    length: 4.6,
    width: 1.85,
};

const EGO: Ego = Ego {
    s: 0.0,
    d: 0.0,
    speed: 25.0,
    accel: 0.0,
    footprint: CAR,
};

/// [s] l_0.
const CURRENT_LATENCY: f64 = 1.0 / 30.0;

fn estimator() -> Estimator {
    Estimator::new(Params::default())
}

/// Held at one offset.
fn lane(d: f64) -> Vec<Across> {
    vec![Across {
        time: 0.0,
        d,
        d_rate: 0.0,
    }]
}

/// A car `gap` ahead in lane `d` that keeps its speed.
fn steady(gap: f64, speed: f64, d: f64) -> Trajectory {
    Trajectory {
        along: vec![Along::constant_accel(0.0, gap + CAR.length, speed, 0.0)],
        across: lane(d),
        extents: Vec::new(),
        known_until: 20.0,
    }
}

/// A car `gap` ahead that brakes to standstill.
fn braking(gap: f64, speed: f64, decel: f64) -> Trajectory {
    let brake = Along::constant_accel(0.0, gap + CAR.length, speed, -decel);
    let stop = speed / decel;
    let along = vec![
        brake,
        Along::constant_accel(stop, brake.s_at(stop), 0.0, 0.0),
    ];
    Trajectory {
        along,
        across: lane(0.0),
        extents: Vec::new(),
        known_until: 20.0,
    }
}

/// 12 s at 10 Hz of a car that moves along as `exact` does, its offset given by `d`.
fn sampled(exact: &Trajectory, d: impl Fn(f64) -> f64) -> Trajectory {
    let sample = |step: u32| {
        let time = f64::from(step) / 10.0;
        let piece = exact
            .along
            .iter()
            .rfind(|piece| piece.time <= time)
            .expect("lists start at 0 s");
        Sample {
            time,
            s: piece.s_at(time),
            d: d(time),
            v: piece.v_at(time),
        }
    };
    let samples: Vec<Sample> = (0..=120).map(sample).collect();
    trajectory(&samples).expect("finite samples in order")
}

/// One actor on one trajectory.
pub fn one_actor() -> Vec<Case> {
    let changes_lane = |time: f64| 3.5 * (1.0 - (time - 2.0) / 3.0).clamp(0.0, 1.0);
    let lead = sampled(&braking(40.0, 20.0, 3.0), |_| 0.0);
    let cut_in = sampled(&steady(30.0, 18.0, 3.5), changes_lane);
    vec![
        plain("standing", steady(100.0, 0.0, 0.0)),
        plain("slower", steady(40.0, 10.0, 0.0)),
        plain("braking", braking(40.0, 20.0, 3.0)),
        plain("far", steady(400.0, 0.0, 0.0)),
        plain("beside", steady(40.0, 15.0, 3.5)),
        plain("sampled_braking", lead.clone()),
        plain("sampled_cut_in", cut_in.clone()),
        recording("sampled_braking_recording", lead),
        recording("sampled_cut_in_recording", cut_in),
        after("braking_after", braking(40.0, 20.0, 3.0)),
    ]
}

fn plain(name: &'static str, trajectory: Trajectory) -> Case {
    let estimator = estimator();
    let evaluations =
        estimator.evaluations(&EGO, CAR, &Future::new(&trajectory, 0.0), CURRENT_LATENCY);
    let ask = move || {
        let future = Future::new(&trajectory, 0.0);
        let (ego, future) = (black_box(&EGO), black_box(&future));
        black_box(estimator.trajectory(ego, CAR, future, CURRENT_LATENCY));
    };
    Case {
        name,
        trajectories: 1,
        evaluations: Some(evaluations),
        ask: Box::new(ask),
    }
}

fn recording(name: &'static str, trajectory: Trajectory) -> Case {
    let (estimator, recording) = (estimator(), Recording::new(trajectory));
    let ask = move || {
        let (ego, recording) = (black_box(&EGO), black_box(&recording));
        black_box(estimator.recorded(ego, CAR, recording, 0.0, CURRENT_LATENCY));
    };
    Case {
        name,
        trajectories: 1,
        evaluations: None,
        ask: Box::new(ask),
    }
}

/// A warm start from the very answer.
fn after(name: &'static str, trajectory: Trajectory) -> Case {
    let estimator = estimator();
    let last = estimator.trajectory(&EGO, CAR, &Future::new(&trajectory, 0.0), CURRENT_LATENCY);
    let ask = move || {
        let future = Future::new(&trajectory, 0.0);
        let (ego, future, last) = (black_box(&EGO), black_box(&future), black_box(&last));
        black_box(estimator.trajectory_after(ego, CAR, future, CURRENT_LATENCY, last));
    };
    Case {
        name,
        trajectories: 1,
        evaluations: None,
        ask: Box::new(ask),
    }
}

/// Actors x trajectories: leads that brake, each from another place or by another deceleration.
pub fn many() -> Vec<Case> {
    [
        ("1x1", 1, 1),
        ("2x1", 2, 1),
        ("4x1", 4, 1),
        ("4x4", 4, 4),
        ("8x8", 8, 8),
    ]
    .into_iter()
    .map(|(name, actors, trajectories)| forecasts(name, actors, trajectories))
    .collect()
}

fn forecasts(name: &'static str, actors: u32, trajectories: u32) -> Case {
    let estimator = estimator();
    // Nearly alike, so that the cost per trajectory shows what the number of them adds.
    let future = |actor: u32, place: u32| {
        braking(
            40.0 + 0.1 * f64::from(actor),
            20.0,
            3.0 + 0.01 * f64::from(place),
        )
    };
    let forecasts: Vec<Forecast> = (0..actors)
        .map(|actor| Forecast {
            actor: ActorId(actor),
            footprint: CAR,
            trajectories: (0..trajectories)
                .map(|place| (1.0, future(actor, place)))
                .collect(),
        })
        .collect();
    let evaluations = forecasts
        .iter()
        .flat_map(|forecast| &forecast.trajectories)
        .map(|(_, trajectory)| {
            estimator.evaluations(&EGO, CAR, &Future::new(trajectory, 0.0), CURRENT_LATENCY)
        })
        .sum();
    let ask = move || {
        for forecast in black_box(&forecasts) {
            black_box(estimator.forecast(&EGO, forecast, 0.0, CURRENT_LATENCY));
        }
    };
    Case {
        name,
        trajectories: actors * trajectories,
        evaluations: Some(evaluations),
        ask: Box::new(ask),
    }
}

/// Every actor at every 10 ms step of 30 s of `cut-out-fast` at 30 FPR, its future known: as the simulator hands it
/// over, where pieces that go on alike are one, and with each step a piece of its own.
pub fn whole_run() -> Vec<Case> {
    let drive = Drive::new();
    let steps = |actor: usize| {
        let sample = |row: zhuyi_sim::trace::Row<'_>| Sample {
            time: row.time.seconds(),
            s: row.actors[actor].road.s,
            d: row.actors[actor].road.d,
            v: row.actors[actor].s_rate,
        };
        let samples: Vec<Sample> = drive.trace.rows().map(sample).collect();
        trajectory(&samples).expect("a trace has finite rows in order")
    };
    let merged = || recorded::futures(&drive.trace, LaneFrame::at(&drive.road, 0.0));
    let stepwise = || (0..drive.trace.names().len() - 1).map(steps).collect();
    vec![
        drive.plain("pieces_plain", merged()),
        drive.recorded("pieces", merged()),
        drive.played("pieces_after", merged()),
        drive.recorded("steps", stepwise()),
        drive.played("steps_after", stepwise()),
    ]
}

/// Where the ego is at each step of a run.
struct Drive {
    road: Arc<Road>,
    trace: Trace,
    egos: Vec<(f64, Ego)>,
}

impl Drive {
    fn new() -> Self {
        let name = "cut-out-fast";
        let text = embedded::scenario(name).expect("an embedded scenario");
        let system = Source::new("default.ron", embedded::system());
        let (scenario, system) =
            load(&Source::new("cut-out-fast.ron", text), &system, &[]).expect("a valid scenario");
        let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
        let trace = RunSpec::new(scenario.clone(), system.clone())
            .at_rates(rates.clone())
            .run_fixed()
            .trace;
        let ego = |row: zhuyi_sim::trace::Row<'_>| (row.time.seconds(), Ego::from(row.ego));
        let egos = trace.rows().map(ego).collect();
        let road = scenario.road.clone();
        Self { road, trace, egos }
    }

    /// A case that asks `answer` about each actor at each step.
    fn case<F: 'static>(
        &self,
        name: &'static str,
        futures: Vec<F>,
        answer: impl Fn(&Ego, &F, f64) -> Estimate + 'static,
    ) -> Case {
        self.case_of_courses(name, futures, move |egos, future| {
            for (now, ego) in egos {
                black_box(answer(black_box(ego), future, *now));
            }
        })
    }

    /// A case that has `ask` ask about each actor at each step.
    fn case_of_courses<F: 'static>(
        &self,
        name: &'static str,
        futures: Vec<F>,
        ask: impl Fn(&[(f64, Ego)], &F) + 'static,
    ) -> Case {
        let (egos, trajectories) = (self.egos.clone(), self.egos.len() * futures.len());
        Case {
            name,
            trajectories: trajectories as u32,
            evaluations: None,
            ask: Box::new(move || futures.iter().for_each(|future| ask(&egos, future))),
        }
    }

    fn plain(&self, name: &'static str, futures: Vec<Trajectory>) -> Case {
        let estimator = estimator();
        let of_one = |future: &Trajectory| -> u32 {
            self.egos
                .iter()
                .map(|(now, ego)| {
                    estimator.evaluations(ego, CAR, &Future::new(future, *now), CURRENT_LATENCY)
                })
                .sum()
        };
        let evaluations = futures.iter().map(of_one).sum();
        let estimator = estimator.clone();
        let case = self.case(name, futures, move |ego, future, now| {
            estimator.trajectory(ego, CAR, &Future::new(future, now), CURRENT_LATENCY)
        });
        Case {
            evaluations: Some(evaluations),
            ..case
        }
    }

    fn recorded(&self, name: &'static str, futures: Vec<Trajectory>) -> Case {
        let estimator = estimator();
        let recordings = futures.into_iter().map(Recording::new).collect();
        self.case(name, recordings, move |ego, recording, now| {
            estimator.recorded(ego, CAR, recording, now, CURRENT_LATENCY)
        })
    }

    fn played(&self, name: &'static str, futures: Vec<Trajectory>) -> Case {
        let estimator = estimator();
        let recordings = futures.into_iter().map(Recording::new).collect();
        self.case_of_courses(name, recordings, move |egos, recording| {
            let mut playback = estimator.playback(recording, CAR);
            for (now, ego) in egos {
                black_box(playback.tolerance(black_box(ego), *now, CURRENT_LATENCY));
            }
        })
    }
}

/// What others ask for and measure, of the lead that brakes.
pub fn other_models() -> Vec<Case> {
    let models = SafetyModels::default();
    let model = |place: usize| {
        let (estimator, lead) = (estimator(), braking(40.0, 20.0, 3.0));
        let ask = move || {
            let future = Future::new(&lead, 0.0);
            let (ego, future) = (black_box(&EGO), black_box(&future));
            black_box(estimator.by_model(models.all()[place], ego, CAR, future, CURRENT_LATENCY));
        };
        Case {
            name: models.all()[place].name(),
            trajectories: 1,
            evaluations: None,
            ask: Box::new(ask),
        }
    };
    let lead = braking(40.0, 20.0, 3.0);
    let metrics = move || {
        let future = Future::new(&lead, 0.0);
        black_box(criticality(
            black_box(&EGO),
            CAR,
            black_box(&future),
            &Limits::default(),
        ));
    };
    let metrics = Case {
        name: "criticality",
        trajectories: 1,
        evaluations: None,
        ask: Box::new(metrics),
    };
    (0..models.all().len())
        .map(model)
        .chain([metrics])
        .collect()
}
