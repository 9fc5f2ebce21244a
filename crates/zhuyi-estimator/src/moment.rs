//! Everything that the ego knows at one moment, answered at once: the face for a stack that embeds the model.
//!
//! ```text
//!  ego, rig with current rates, forecasts with probabilities
//!        │
//!        ▼
//!  Estimator::moment ──▶ per actor: Answer (state, latency, deciding trajectory, t_n, what bound, cameras)
//!                    └─▶ per camera: Demand (latency, FPR, the actor behind it)
//! ```
//!
//! An actor is asked about with the latency at which each camera that covers it runs now (l_0, reading R14); its own
//! answer is the most important of these. One that no camera covers is asked about with the l_0 of the fastest camera
//! and makes no demand. Sources: paper, Eq. 4 and 5.

use crate::demand::Answers;
use crate::{Demand, Ego, Estimator, ForecastEstimate, Watch};
use zhuyi_core::{ActorId, Forecast, Pose};

/// What the ego knows at one moment.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The ego along its path.
    pub ego: Ego,
    /// The centre of its box in the world: what the cameras are mounted on.
    pub pose: Pose,
    /// [s] t_0 on the clock of the forecasts.
    pub now: f64,
    /// The actors.
    pub seen: &'a [Seen<'a>],
    /// The cameras, and the latency at which each runs now.
    pub rig: &'a [Watch<'a>],
}

/// One actor that the ego knows of.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The centre of its box in the world at t_0.
    pub pose: Pose,
    /// Where it may go, along and across the ego's path.
    pub forecast: &'a Forecast,
}

/// What one actor asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The actor.
    pub actor: ActorId,
    /// Its answer, over its futures, and the future that decided.
    pub forecast: ForecastEstimate,
    /// How many cameras cover it.
    pub cameras: usize,
}

impl Estimator {
    /// Answers for all actors, in order, through `tell`, and writes the demand on each camera into `demands`, one per
    /// camera of the rig; cameras for which it has no room are left out. Allocates nothing.
    ///
    /// A car stands 50 m ahead of an ego at 10 m/s: 0.604 s, 1.66 FPR (see [`Estimator::trajectory`]), asked for of the
    /// front camera.
    /// ```
    /// use zhuyi_core::{Across, ActorId, Along, Camera, Footprint, Forecast, Pose, Trajectory};
    /// use zhuyi_estimator::{Ego, Estimator, Moment, Params, Seen, Watch};
    /// let car = Footprint { length: 4.0, width: 2.0 };
    /// let stands = Trajectory {
    ///     along: vec![Along::constant_accel(0.0, 54.0, 0.0, 0.0)],
    ///     across: vec![Across { time: 0.0, d: 0.0, d_rate: 0.0 }],
    ///     extents: Vec::new(),
    ///     known_until: 5.0,
    /// };
    /// let forecast = Forecast { actor: ActorId(7), footprint: car, trajectories: vec![(1.0, stands)] };
    /// let front = Camera {
    ///     name: "front".into(), forward: 1.0, left: 0.0, yaw: 0.0, fov: 2.0, range: 150.0, analysed: true,
    /// };
    ///
    /// let moment = Moment {
    ///     ego: Ego { s: 0.0, d: 0.0, speed: 10.0, accel: 0.0, footprint: car },
    ///     pose: Pose::new(0.0, 0.0, 0.0),
    ///     now: 0.0,
    ///     seen: &[Seen { pose: Pose::new(54.0, 0.0, 0.0), forecast: &forecast }],
    ///     rig: &[Watch { camera: &front, current_latency: 1.0 / 30.0 }],
    /// };
    /// let estimator = Estimator::new(Params::default());
    /// let mut demands = [estimator.quiet()];
    /// estimator.moment(&moment, &mut demands, |answer| assert_eq!(answer.forecast.estimate.latency, Some(0.604)));
    /// assert_eq!((demands[0].latency, demands[0].actor), (0.604, Some(ActorId(7))));
    /// ```
    pub fn moment(
        &self,
        moment: &Moment<'_>,
        demands: &mut [Demand],
        mut tell: impl FnMut(Answer),
    ) {
        demands.fill(self.quiet());
        let latencies = moment.rig.iter().map(|watch| watch.current_latency);
        let fastest = latencies.fold(self.largest(), |least, latency| {
            if latency < least { latency } else { least }
        });
        for seen in moment.seen {
            let forecast = seen.forecast;
            let ask = |l_0: f64| self.forecast(&moment.ego, forecast, moment.now, l_0);
            let (mut answers, mut most, mut cameras) = (Answers::default(), None, 0);
            for (place, watch) in moment.rig.iter().enumerate() {
                let covers = watch
                    .camera
                    .covers_box(moment.pose, forecast.footprint, seen.pose);
                if !covers {
                    continue;
                }
                cameras += 1;
                let answer: ForecastEstimate = answers.of(watch.current_latency, ask);
                if let Some(demand) = demands.get_mut(place) {
                    self.add(demand, Some(forecast.actor), answer.estimate);
                }
                most = Some(match most {
                    Some(most) if !more_important(&answer, &most) => most,
                    _ => answer,
                });
            }
            tell(Answer {
                actor: forecast.actor,
                forecast: most.unwrap_or_else(|| ask(fastest)),
                cameras,
            });
        }
    }
}

fn more_important(a: &ForecastEstimate, b: &ForecastEstimate) -> bool {
    a.estimate.by_importance(&b.estimate).is_lt()
}
