//! The face of the crate: an [`Estimator`] answers for one trajectory, one forecast, or the cameras of a rig.

use crate::ego_motion::{latency_within, reaction_time};
use crate::grid::Latencies;
use crate::judge::Judge;
use crate::solver::conflict::Corridor;
use crate::solver::encounter::{Delay, Encounter};
use crate::solver::exact::Found;
use crate::solver::recording::{Recording, View};
use crate::{Ego, Estimate, Future, Params, State, Uncertainty};
use zhuyi_core::Footprint;

/// The Zhuyi model with its parameters and its list of latencies. It holds no state: the same question has the same
/// answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimator {
    params: Params,
    latencies: Latencies,
}

/// An estimate, and what it took.
pub(crate) struct Answer {
    pub estimate: Estimate,
    /// How often a candidate was looked at on a piece.
    evaluations: u32,
    /// The place among the candidates of the first that has a t_n, about that of the answer; nowhere if there was no conflict,
    /// or if no rate helps.
    pub place: Option<usize>,
}

impl Estimator {
    /// An estimator for these parameters.
    pub fn new(params: Params) -> Self {
        Self {
            latencies: Latencies::new(params.grid),
            params,
        }
    }

    /// The same on the same list of latencies, with other parameters.
    pub(crate) fn with_params(&self, params: Params) -> Self {
        Self {
            latencies: self.latencies.clone(),
            params,
        }
    }

    /// What it was told.
    pub fn params(&self) -> &Params {
        &self.params
    }

    /// [s] the candidate latencies, descending.
    pub fn latencies(&self) -> &[f64] {
        self.latencies.all()
    }

    /// [s] the largest latency, what a camera with nothing to fear may take.
    pub(crate) fn largest(&self) -> f64 {
        self.latencies.largest()
    }

    /// [s] the smallest latency.
    pub(crate) fn smallest(&self) -> f64 {
        self.latencies.smallest()
    }

    /// The tolerable latency of one actor on one trajectory, while the camera runs at `current_latency` (l_0).
    ///
    /// A car stands 50 m ahead of an ego at 10 m/s. Eq. 1 leaves it 45 m, of which braking at 4.9 m/s2 takes 10.2;
    /// the other 34.8 m are 3.48 s of reaction, and `l + 5 (l - 1/30) <= 3.48` makes l at most 0.607: 0.604 s on
    /// the grid.
    /// ```
    /// use zhuyi_core::{Across, Along, Footprint};
    /// use zhuyi_estimator::{Binding, Ego, Estimator, Future, Params, State};
    /// let car = Footprint { length: 4.0, width: 2.0 };
    /// let ego = Ego { s: 0.0, d: 0.0, speed: 10.0, accel: 0.0, footprint: car };
    /// let along = [Along::constant_accel(0.0, 54.0, 0.0, 0.0)];
    /// let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    ///
    /// let estimate = Estimator::new(Params::default()).trajectory(&ego, car, &future, 1.0 / 30.0);
    /// assert_eq!((estimate.state, estimate.latency), (State::Tolerable, Some(0.604)));
    /// assert_eq!(estimate.binding, Some(Binding::Distance));
    /// ```
    pub fn trajectory(
        &self,
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        current_latency: f64,
    ) -> Estimate {
        self.answer(ego, actor, &View::plain(*future), current_latency, None)
            .estimate
    }

    /// The same answer, sooner where it is what it was a step ago: `last` is looked at first and nothing else if it
    /// still holds. It need not be right.
    ///
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint};
    /// # use zhuyi_estimator::{Ego, Estimator, Future, Params};
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let mut ego = Ego { s: 0.0, d: 0.0, speed: 10.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 54.0, 0.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// # let estimator = Estimator::new(Params::default());
    /// let before = estimator.trajectory(&ego, car, &future, 1.0 / 30.0);
    /// ego.s += 0.1;
    /// let now = estimator.trajectory_after(&ego, car, &future, 1.0 / 30.0, &before);
    /// assert_eq!(now, estimator.trajectory(&ego, car, &future, 1.0 / 30.0));
    /// ```
    pub fn trajectory_after(
        &self,
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        current_latency: f64,
        last: &Estimate,
    ) -> Estimate {
        let (view, guess) = (View::plain(*future), self.place(last));
        self.answer(ego, actor, &view, current_latency, guess)
            .estimate
    }

    /// How often a latency was held against a piece of the future to answer [`Estimator::trajectory`]: the paper's
    /// count for one trajectory is at most M x L. Of the exact solver; the paper's jumps are not counted.
    pub fn evaluations(
        &self,
        ego: &Ego,
        actor: Footprint,
        future: &Future<'_>,
        current_latency: f64,
    ) -> u32 {
        self.answer(ego, actor, &View::plain(*future), current_latency, None)
            .evaluations
    }

    /// The same for a recorded future with `now` on its clock as t_0: the same answer, sooner for long lists.
    pub fn recorded(
        &self,
        ego: &Ego,
        actor: Footprint,
        recording: &Recording,
        now: f64,
        current_latency: f64,
    ) -> Estimate {
        self.answer(ego, actor, &recording.view(now), current_latency, None)
            .estimate
    }

    /// The answer, looked for first at the candidate `guess`.
    #[inline]
    pub(crate) fn answer(
        &self,
        ego: &Ego,
        actor: Footprint,
        view: &View<'_>,
        current_latency: f64,
        guess: Option<usize>,
    ) -> Answer {
        let corridor = Corridor::new(&self.params, ego, actor, view);
        if let Some(encounter) = Encounter::new(&self.params, &corridor) {
            return self.conflict(&encounter, current_latency, guess, None);
        }
        self.unasked(State::None, view)
    }

    /// An answer for which no latency is tried: any will do.
    fn unasked(&self, state: State, view: &View<'_>) -> Answer {
        let estimate = Estimate {
            state,
            latency: Some(self.largest()),
            t_n: None,
            binding: None,
            extrapolated: view.future.extrapolated(self.params.horizon),
        };
        Answer {
            estimate,
            evaluations: 0,
            place: None,
        }
    }

    /// The same where there is a conflict; the first candidate that has a t_n is `known`, or is looked for first at `guess`.
    pub(crate) fn conflict(
        &self,
        encounter: &Encounter<'_>,
        current_latency: f64,
        guess: Option<usize>,
        known: Option<usize>,
    ) -> Answer {
        if encounter.corridor.held.stands() {
            return self.unasked(State::Standing, encounter.corridor.view);
        }
        let judge = Judge {
            encounter,
            params: &self.params,
        };
        // Behind the latencies of the grid stands the last candidate: to react at once.
        let latencies = self.latencies();
        let delay = |index: usize| self.delay_of(index, current_latency);
        let count = latencies.len() + 1;
        let with_time = known.map(Found::known).or_else(|| {
            let guess = guess.unwrap_or_else(|| {
                let frames = self.params.confirm_frames;
                self.first_within(latency_within(encounter.guess(), current_latency, frames))
            });
            judge.first_with_time(count, delay, guess)
        });
        let found = judge.first_tolerable(count, delay, with_time);
        // What is put down as the cause is what refused the candidate before; of an actor alongside, the smallest latency.
        let (state, refused) = match found.index.checked_sub(latencies.len()) {
            None => (State::Tolerable, found.index.checked_sub(1)),
            Some(_) if encounter.abreast() => (State::Alongside, latencies.len().checked_sub(1)),
            Some(0) => (State::BeyondGrid, found.index.checked_sub(1)),
            Some(_) => (State::Unavoidable, found.index.checked_sub(1)),
        };
        let alongside = state == State::Alongside;
        let unmet_until = if alongside { 0.0 } else { found.unmet_until };
        let estimate = Estimate {
            state,
            latency: latencies.get(found.index).copied(),
            t_n: found.t_n.filter(|_| !alongside),
            binding: refused.and_then(|index| judge.refusal(delay(index), unmet_until)),
            extrapolated: encounter
                .corridor
                .view
                .future
                .extrapolated(self.params.horizon),
        };
        Answer {
            estimate,
            evaluations: found.evaluations,
            place: (!alongside).then(|| with_time.unwrap_or(found).index.min(latencies.len())),
        }
    }

    /// What a candidate costs: those of the grid, behind them to react at once.
    pub(crate) fn delay_of(&self, index: usize, current_latency: f64) -> Delay {
        self.delay(self.latencies().get(index).copied(), current_latency)
    }

    /// What a latency costs; none: to react at once.
    pub(crate) fn delay(&self, latency: Option<f64>, current_latency: f64) -> Delay {
        let frames = self.params.confirm_frames;
        let head_start =
            |uncertainty: Uncertainty| uncertainty.head_start(latency.unwrap_or_default());
        Delay {
            reaction_time: latency.map_or(0.0, |latency| {
                reaction_time(latency, current_latency, frames)
            }),
            head_start: self.params.uncertainty.map_or(0.0, head_start),
        }
    }

    /// The place of the first latency of the grid that is no larger.
    fn first_within(&self, latency: f64) -> usize {
        let larger = |candidate: &f64| *candidate > latency;
        self.latencies().partition_point(larger)
    }

    /// As [`Answer::place`].
    fn place(&self, estimate: &Estimate) -> Option<usize> {
        let latencies = self.latencies();
        match estimate.state {
            State::None | State::Standing | State::Alongside => None,
            State::Tolerable => Some(self.first_within(estimate.latency?)),
            State::BeyondGrid | State::Unavoidable => Some(latencies.len()),
        }
    }
}
