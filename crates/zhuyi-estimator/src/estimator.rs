//! The face of the crate: an [`Estimator`] answers for one trajectory, one forecast, or the cameras of a rig.

use crate::ego_motion::reaction_time;
use crate::encounter::Encounter;
use crate::grid::Latencies;
use crate::judge::{Judge, Tolerated};
use crate::recording::{Recording, View};
use crate::{Ego, Estimate, Future, Params, State};
use zhuyi_core::Footprint;

/// The Zhuyi model with its parameters and its list of latencies. It holds no state: the same question has the same
/// answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimator {
    params: Params,
    latencies: Latencies,
}

impl Estimator {
    /// An estimator for these parameters.
    pub fn new(params: Params) -> Self {
        Self {
            latencies: Latencies::new(params.grid),
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
    /// let future = Future { along: &along, across: &across, known_until: 20.0, now: 0.0 };
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
        self.answer(ego, actor, View::plain(*future), current_latency)
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
        self.answer(ego, actor, recording.view(now), current_latency)
    }

    fn answer(
        &self,
        ego: &Ego,
        actor: Footprint,
        view: View<'_>,
        current_latency: f64,
    ) -> Estimate {
        let reaction =
            |latency: f64| reaction_time(latency, current_latency, self.params.confirm_frames);
        let quiet = Estimate {
            state: State::None,
            latency: Some(self.largest()),
            t_n: None,
            binding: None,
            extrapolated: view.future.extrapolated(self.params.horizon),
        };
        let longest = reaction(self.largest());
        let Some(encounter) = Encounter::new(&self.params, ego, actor, view, longest) else {
            return quiet;
        };
        let judge = Judge {
            encounter: &encounter,
            solver: self.params.solver,
            criterion: self.params.criterion,
            max_steps: self.params.max_steps,
        };
        let Some((index, tolerated)) = self.largest_tolerable(&judge, reaction) else {
            return intolerable(&judge, reaction(self.smallest()), quiet);
        };
        let larger = index.checked_sub(1).map(|index| self.latencies()[index]);
        Estimate {
            state: State::Tolerable,
            latency: Some(self.latencies()[index]),
            t_n: tolerated.t_n,
            binding: larger.and_then(|larger| judge.refusal(reaction(larger))),
            ..quiet
        }
    }

    /// Place in the grid of the largest latency that will do, if cautious of the largest up to which all will do.
    fn largest_tolerable(
        &self,
        judge: &Judge<'_>,
        reaction: impl Fn(f64) -> f64,
    ) -> Option<(usize, Tolerated)> {
        let tolerates = |index: usize| judge.tolerates(reaction(self.latencies()[index]));
        if !judge.monotone() {
            if self.params.cautious {
                let from_smallest = (0..self.latencies().len()).rev();
                return from_smallest
                    .map_while(|index| Some((index, tolerates(index)?)))
                    .last();
            }
            return (0..self.latencies().len()).find_map(|index| Some((index, tolerates(index)?)));
        }
        if let Some(tolerated) = tolerates(0) {
            return Some((0, tolerated));
        }
        // Everything up to `refused` is refused; `best`, once found, is tolerable and bounds the rest from below.
        let (mut refused, mut end, mut best) = (0, self.latencies().len(), None);
        while refused + 1 < end {
            let middle = usize::midpoint(refused, end);
            match tolerates(middle) {
                Some(tolerated) => (end, best) = (middle, Some((middle, tolerated))),
                None => refused = middle,
            }
        }
        best
    }
}

/// The answer where even the `shortest` reaction of the grid is refused.
fn intolerable(judge: &Judge<'_>, shortest: f64, quiet: Estimate) -> Estimate {
    let at_once = judge.tolerates(0.0);
    let (state, t_n, refused) = match at_once {
        _ if judge.encounter.abreast() => (State::Alongside, None, shortest),
        Some(tolerated) => (State::BeyondGrid, tolerated.t_n, shortest),
        None => (State::Unavoidable, None, 0.0),
    };
    Estimate {
        state,
        latency: None,
        t_n,
        binding: judge.refusal(refused),
        ..quiet
    }
}
