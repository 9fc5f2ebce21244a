//! From actors to cameras (Eq. 5, reading R14).
//!
//! ```text
//!  l_camera = min over the actors it covers of l_actor,   FPR = 1 / l_camera
//! ```
//!
//! An actor counts for every camera that has some of its box in view at t_0, with the latency at which that
//! camera runs now as l_0. A camera that covers nobody may take the largest latency. No rate helps with an actor
//! alongside, nor an ego that stands: both are counted and ask for nothing. Left out: occlusion; [`Estimator::demands_where`] takes any
//! other rule of who counts, and [`Estimator::demands_into`] writes into a list of the caller's and allocates nothing.

use crate::estimate::State;
use crate::grid::fpr;
use crate::{Estimate, Estimator, Tolerance};
use zhuyi_core::{ActorId, Body, Camera, Pose};

/// A camera and the latency at which it runs now.
#[derive(Clone, Copy, Debug)]
pub struct Watch<'a> {
    /// The camera.
    pub camera: &'a Camera,
    /// [s] l_0.
    pub current_latency: f64,
}

/// What the actors ask of one camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// [s] tolerable latency of the camera; the smallest of the grid where even that is too slow.
    pub latency: f64,
    /// [Hz] the frame processing rate asked for.
    pub fpr: f64,
    /// The actor that asks for it: the first of the most demanding; none where no actor asks for anything, or a phantom
    /// for more.
    pub actor: Option<ActorId>,
    /// Whether a [`phantom`](crate::phantom) asks for it.
    pub phantom: bool,
    /// Actors that ask for more than the grid offers.
    pub beyond_grid: u32,
    /// Actors for which even braking at once is too late.
    pub unavoidable: u32,
    /// Actors alongside.
    pub alongside: u32,
    /// Actors in conflict with an ego that stands.
    pub standing: u32,
}

impl Estimator {
    /// The demand on each camera of a rig, in its order. `estimate` answers for an actor at a current latency l_0;
    /// it is asked once per actor and different l_0, and not at all for actors out of everyone's sight.
    ///
    /// A front camera covers the car ahead, which tolerates 0.25 s: 4 FPR. The rear one covers nobody: 1 FPR.
    /// ```
    /// use zhuyi_core::{ActorId, Body, Camera, Footprint, Frenet, Pose};
    /// use zhuyi_estimator::{Estimate, Estimator, Params, State, Watch};
    /// # use std::f64::consts::PI;
    /// let camera = |name: &str, yaw: f64| Camera {
    ///     name: name.into(), forward: 0.0, left: 0.0, yaw, fov: 2.0, range: 100.0, analysed: true,
    /// };
    /// let (front, rear) = (camera("front", 0.0), camera("rear", PI));
    /// let rig = [&front, &rear].map(|camera| Watch { camera, current_latency: 1.0 / 30.0 });
    /// let car = Body {
    ///     footprint: Footprint { length: 4.0, width: 2.0 }, road: Frenet { s: 30.0, d: 0.0 },
    ///     pose: Pose::new(30.0, 0.0, 0.0), turn: 0.0, extent: Footprint { length: 4.0, width: 2.0 }, speed: 0.0, accel: 0.0, s_rate: 0.0, d_rate: 0.0,
    /// };
    /// let answer =
    ///     Estimate { state: State::Tolerable, latency: Some(0.25), t_n: None, binding: None, extrapolated: 0.0 };
    ///
    /// let estimator = Estimator::new(Params::default());
    /// let ego = Pose::new(0.0, 0.0, 0.0);
    /// let demands = estimator.demands(&rig, ego, [(ActorId(7), &car)], |_actor, _current_latency| answer);
    /// assert_eq!((demands[0].fpr, demands[0].actor), (4.0, Some(ActorId(7))));
    /// assert_eq!((demands[1].fpr, demands[1].actor), (1.0, None));
    /// ```
    pub fn demands<'a>(
        &self,
        rig: &[Watch<'_>],
        ego: Pose,
        actors: impl IntoIterator<Item = (ActorId, &'a Body)>,
        estimate: impl FnMut(ActorId, f64) -> Estimate,
    ) -> Vec<Demand> {
        self.demands_where(
            rig,
            actors,
            |place, _, body| rig[place].camera.covers_body(ego, body),
            estimate,
        )
    }

    /// The same, where `counts` says which actors count for the camera at a place in the rig.
    pub fn demands_where<'a>(
        &self,
        rig: &[Watch<'_>],
        actors: impl IntoIterator<Item = (ActorId, &'a Body)>,
        counts: impl Fn(usize, ActorId, &Body) -> bool,
        mut estimate: impl FnMut(ActorId, f64) -> Estimate,
    ) -> Vec<Demand> {
        let mut demands = vec![self.quiet(); rig.len()];
        let mut tolerance = |actor, l_0| Tolerance::from(estimate(actor, l_0));
        self.demands_into(rig, actors, counts, &mut tolerance, &mut demands);
        demands
    }

    /// The same by tolerances, into the front of `demands`, one per camera; cameras for which it has no room are left out.
    pub fn demands_into<'a>(
        &self,
        rig: &[Watch<'_>],
        actors: impl IntoIterator<Item = (ActorId, &'a Body)>,
        counts: impl Fn(usize, ActorId, &Body) -> bool,
        mut estimate: impl FnMut(ActorId, f64) -> Tolerance,
        demands: &mut [Demand],
    ) {
        demands.fill(self.quiet());
        for (actor, body) in actors {
            let mut answers = Answers::default();
            for (place, (watch, demand)) in rig.iter().zip(&mut *demands).enumerate() {
                if counts(place, actor, body) {
                    let answer = answers.of(watch.current_latency, |l_0| estimate(actor, l_0));
                    self.add(demand, Some(actor), answer);
                }
            }
        }
    }

    /// What a camera is asked for that covers nobody.
    pub fn quiet(&self) -> Demand {
        let latency = self.largest();
        Demand {
            latency,
            fpr: fpr(latency),
            actor: None,
            phantom: false,
            beyond_grid: 0,
            unavoidable: 0,
            alongside: 0,
            standing: 0,
        }
    }

    /// What an actor asks, or a phantom: none.
    pub(crate) fn add(
        &self,
        demand: &mut Demand,
        actor: Option<ActorId>,
        answer: impl Into<Tolerance>,
    ) {
        let answer = answer.into();
        match answer.state {
            State::None => return,
            State::Tolerable => {}
            State::BeyondGrid => demand.beyond_grid += 1,
            State::Unavoidable => demand.unavoidable += 1,
            State::Alongside => {
                demand.alongside += 1;
                return;
            }
            State::Standing => {
                demand.standing += 1;
                return;
            }
        }
        let latency = answer.latency.unwrap_or_else(|| self.smallest());
        let first = demand.actor.is_none() && !demand.phantom;
        if first || latency < demand.latency {
            demand.latency = latency;
            demand.fpr = fpr(latency);
            (demand.actor, demand.phantom) = (actor, actor.is_none());
        }
    }
}

/// The most current latencies for which answers are remembered; a rig rarely has more.
const REMEMBERED: usize = 8;

/// The answers for one actor, each asked for once per current latency.
pub(crate) struct Answers<A> {
    known: [Option<(f64, A)>; REMEMBERED],
}

impl<A: Copy> Default for Answers<A> {
    fn default() -> Self {
        Self {
            known: [None; REMEMBERED],
        }
    }
}

impl<A: Copy> Answers<A> {
    /// The answer at a current latency.
    pub fn of(&mut self, current_latency: f64, ask: impl FnOnce(f64) -> A) -> A {
        for known in &mut self.known {
            match known {
                Some((latency, answer)) if *latency == current_latency => return *answer,
                Some(_) => {}
                None => return known.insert((current_latency, ask(current_latency))).1,
            }
        }
        ask(current_latency)
    }
}

#[cfg(test)]
mod tests {
    use super::{Demand, Watch};
    use crate::{Estimate, Estimator, Params, State};
    use std::cell::Cell;
    use zhuyi_core::{ActorId, Body, Camera, Footprint, Frenet, Pose};

    fn answer(state: State, latency: Option<f64>) -> Estimate {
        Estimate {
            state,
            latency,
            t_n: None,
            binding: None,
            extrapolated: 0.0,
        }
    }

    fn body() -> Body {
        let (road, pose) = (Frenet { s: 20.0, d: 0.0 }, Pose::new(20.0, 0.0, 0.0));
        let footprint = Footprint {
            length: 4.0,
            width: 2.0,
        };
        Body {
            footprint,
            road,
            pose,
            turn: 0.0,
            extent: footprint,
            speed: 0.0,
            accel: 0.0,
            s_rate: 0.0,
            d_rate: 0.0,
        }
    }

    fn camera(yaw: f64) -> Camera {
        Camera {
            name: "front".into(),
            forward: 0.0,
            left: 0.0,
            yaw,
            fov: 1.0,
            range: 100.0,
            analysed: true,
        }
    }

    fn of_one_camera(answers: &[Estimate]) -> Demand {
        let (estimator, front, car) = (Estimator::new(Params::default()), camera(0.0), body());
        let rig = [Watch {
            camera: &front,
            current_latency: 0.1,
        }];
        let actors = (0..answers.len()).map(|place| (ActorId(place as u32), &car));
        estimator.demands(&rig, Pose::default(), actors, |actor, _| {
            answers[actor.index()]
        })[0]
    }

    #[test]
    fn hand_the_most_demanding_actor_counts() {
        let quiet = answer(State::None, Some(1.0));
        let demand = of_one_camera(&[
            quiet,
            answer(State::Tolerable, Some(0.5)),
            answer(State::Tolerable, Some(0.2)),
        ]);
        assert_eq!(
            (demand.latency, demand.fpr, demand.actor),
            (0.2, 5.0, Some(ActorId(2)))
        );
        let demand = of_one_camera(&[quiet]);
        assert_eq!((demand.latency, demand.fpr, demand.actor), (1.0, 1.0, None));
    }

    #[test]
    fn hand_a_phantom_counts_where_it_asks_for_more() {
        let estimator = Estimator::new(Params::default());
        let mut demand = of_one_camera(&[answer(State::Tolerable, Some(0.5))]);
        estimator.add(&mut demand, None, answer(State::Tolerable, Some(0.8)));
        assert_eq!((demand.actor, demand.phantom), (Some(ActorId(0)), false));
        estimator.add(&mut demand, None, answer(State::Tolerable, Some(0.25)));
        assert_eq!(
            (demand.fpr, demand.actor, demand.phantom),
            (4.0, None, true)
        );
        estimator.add(&mut demand, None, answer(State::Tolerable, Some(0.5)));
        assert_eq!((demand.fpr, demand.phantom), (4.0, true));
        estimator.add(&mut demand, None, answer(State::Unavoidable, None));
        assert_eq!((demand.fpr, demand.unavoidable), (30.0, 1));
    }

    #[test]
    fn hand_actors_that_no_rate_helps_ask_for_nothing() {
        let demand = of_one_camera(&[
            answer(State::Alongside, None),
            answer(State::Standing, Some(1.0)),
            answer(State::Tolerable, Some(0.5)),
        ]);
        assert_eq!(
            (demand.fpr, demand.actor, demand.alongside, demand.standing),
            (2.0, Some(ActorId(2)), 1, 1)
        );
        let demand = of_one_camera(&[answer(State::Standing, Some(1.0))]);
        assert_eq!((demand.fpr, demand.actor, demand.standing), (1.0, None, 1));
        let demand = of_one_camera(&[
            answer(State::BeyondGrid, None),
            answer(State::Unavoidable, None),
        ]);
        assert_eq!(
            (demand.latency, demand.fpr, demand.actor),
            (0.033, 30.0, Some(ActorId(0)))
        );
        assert_eq!(
            (demand.beyond_grid, demand.unavoidable, demand.alongside),
            (1, 1, 0)
        );
    }

    #[test]
    fn hand_equal_current_latencies_are_asked_once_and_cameras_that_look_away_never() {
        let (estimator, front, rear, car) = (
            Estimator::new(Params::default()),
            camera(0.0),
            camera(3.0),
            body(),
        );
        let rig = [(&front, 0.1), (&front, 0.2), (&front, 0.1), (&rear, 0.3)].map(
            |(camera, current_latency)| Watch {
                camera,
                current_latency,
            },
        );
        let asked = Cell::new(0);
        let demands = estimator.demands(
            &rig,
            Pose::default(),
            [(ActorId(0), &car)],
            |_, current_latency| {
                asked.set(asked.get() + 1);
                answer(State::Tolerable, Some(current_latency))
            },
        );
        assert_eq!(asked.get(), 2);
        assert_eq!(
            demands
                .iter()
                .map(|demand| demand.latency)
                .collect::<Vec<_>>(),
            [0.1, 0.2, 0.1, 1.0]
        );
    }
}
