//! The verdict on one delay, by either solver and either criterion, and what speaks against a refused one.
//!
//! A latency is refused when no t_n exists. That is put down to pass-through where a t_n would exist but for
//! contact (reading R6), to the speed (Eq. 2) where the ego is never slow enough, and to the distance (Eq. 1)
//! otherwise.

use crate::solver::conflict::Zone;
use crate::solver::encounter::{Ask, Candidate, Delay, Encounter, overlap};
use crate::solver::exact::{self, Found};
use crate::{Binding, Criterion, Params, paper};

/// How reaction times are judged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judge<'a> {
    pub encounter: &'a Encounter<'a>,
    pub params: &'a Params,
}

/// A reaction time that will do.
#[derive(Clone, Copy, Debug)]
struct Tolerated {
    t_n: Option<f64>,
}

impl Judge<'_> {
    /// The first of `count` delays, given in falling order, that has a t_n, where to react earlier is never worse. `guess` says
    /// where to look first.
    pub fn first_with_time(
        &self,
        count: usize,
        delay: impl Fn(usize) -> Delay,
        guess: usize,
    ) -> Option<Found> {
        let candidate = |index| self.encounter.candidate(delay(index));
        let (encounter, criterion) = (self.encounter, self.params.criterion);
        encounter
            .earlier_is_better()
            .then(|| exact::first_tolerable_near(encounter, criterion, count, candidate, guess))
    }

    /// The first of `count` delays that will do; with [`Params::cautious`] the first from which on all will do. The last of them,
    /// to react at once, does not count for that. `with_time` is the first that has a t_n, where that is known.
    pub fn first_tolerable(
        &self,
        count: usize,
        delay: impl Fn(usize) -> Delay,
        with_time: Option<Found>,
    ) -> Found {
        if let Some(found) = with_time
            && !self.params.jumps()
        {
            return found;
        }
        let found = |index, t_n| Found {
            t_n,
            ..Found::known(index)
        };
        let tolerated = |index| {
            let Tolerated { t_n } = self.tolerated(delay(index))?;
            Some(found(index, t_n))
        };
        let first = if self.params.cautious {
            let from_smallest = (0..count - 1).rev().map_while(tolerated);
            from_smallest.last().or_else(|| tolerated(count - 1))
        } else {
            // Jumps may miss a t_n; they find none where there is none.
            let first = with_time.map_or(0, |found| found.index);
            (first..count).find_map(tolerated)
        };
        first.unwrap_or_else(|| found(count, None))
    }

    /// Whether one delay will do, and its t_n.
    fn tolerated(&self, delay: Delay) -> Option<Tolerated> {
        if self.params.jumps() {
            return paper::found_time(self.encounter, delay, self.params.max_steps)
                .map(|t_n| Tolerated { t_n: Some(t_n) });
        }
        self.exactly(delay)
    }

    /// The same in continuous time.
    fn exactly(&self, delay: Delay) -> Option<Tolerated> {
        let candidate = |_| self.encounter.candidate(delay);
        let found = exact::first_tolerable(self.encounter, self.params.criterion, 0..1, candidate);
        (found.index == 0).then_some(Tolerated { t_n: found.t_n })
    }

    /// What refuses a delay that is not tolerable; `None` if it leaves no time in the horizon at all, or if
    /// nothing does and the jumps missed every t_n.
    ///
    /// Until `unmet_until` it is known not to meet the constraints.
    pub fn refusal(&self, delay: Delay, unmet_until: f64) -> Option<Binding> {
        let (encounter, reaction_time) = (self.encounter, delay.reaction_time);
        if self.params.criterion == Criterion::Standstill {
            return Some(Binding::PassThrough);
        }
        let horizon = encounter.corridor.horizon;
        if reaction_time > horizon || (self.params.jumps() && self.exactly(delay).is_some()) {
            return None;
        }
        let candidate = encounter.candidate(delay);
        // Mostly the end tells: an actor that goes on is by then ahead again of an ego that stands.
        Some(
            if unmet_until < horizon && encounter.meets_at_end(&candidate) {
                Binding::PassThrough
            } else {
                self.cause(&candidate, unmet_until)
            },
        )
    }

    /// The same of a candidate that has reacted by the end of the horizon, told by a walk along the pieces.
    fn cause(&self, candidate: &Candidate, unmet_until: f64) -> Binding {
        let encounter = self.encounter;
        let met = Ask {
            contact: false,
            met: true,
        };
        let mut slow_enough = false;
        for span in encounter.spans() {
            let horizon = encounter.corridor.horizon;
            let Some((from, to)) = overlap(&span, candidate.reaction_time, horizon) else {
                continue;
            };
            let unknown = if from > unmet_until {
                from
            } else {
                unmet_until
            };
            let met_later =
                || unknown < to && encounter.first_event(met, candidate, unknown, to).is_some();
            if span.zone == Zone::After || met_later() {
                return Binding::PassThrough;
            }
            // Standing is slow enough for anything.
            slow_enough |= candidate.motion.stands_from() <= to
                || encounter.ever_slow_enough(candidate, from, to);
        }
        if slow_enough {
            Binding::Distance
        } else {
            Binding::Speed
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Judge;
    use crate::solver::conflict::Corridor;
    use crate::solver::encounter::{Delay, Encounter};
    use crate::solver::recording::View;
    use crate::{Binding, Criterion, Ego, Estimator, Future, Params, State};
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;
    use zhuyi_core::{Across, Along, Footprint};

    const CAR: Footprint = Footprint {
        length: 4.0,
        width: 2.0,
    };

    /// 20 m/s, a car stands 5 m ahead: the ego ends 40.8 m on, never behind it. That the list has it elsewhere from
    /// the end of the horizon on is beyond the horizon.
    #[test]
    fn hand_the_end_of_the_horizon_belongs_to_the_piece_before_it() {
        let ego = Ego {
            s: 0.0,
            d: 0.0,
            speed: 20.0,
            accel: 0.0,
            footprint: CAR,
        };
        let across = [Across {
            time: 0.0,
            d: 0.0,
            d_rate: 0.0,
        }];
        let binding = |elsewhere_from: f64| {
            let along = [
                Along::constant_accel(0.0, 9.0, 0.0, 0.0),
                Along::constant_accel(elsewhere_from, 500.0, 0.0, 0.0),
            ];
            let future = Future {
                along: &along,
                across: &across,
                extents: &[],
                known_until: 20.0,
                now: 0.0,
            };
            let estimate =
                Estimator::new(Params::default()).trajectory(&ego, CAR, &future, 1.0 / 30.0);
            (estimate.state, estimate.binding)
        };
        let unavoidable = |binding| (State::Unavoidable, Some(binding));
        assert_eq!(binding(20.0), unavoidable(Binding::Distance));
        assert_eq!(binding(19.9), unavoidable(Binding::PassThrough));
    }

    prop_compose! {
        /// A lead that changes its acceleration a few times and its offset now and then.
        fn any_future()(
            gap in 0.5..80.0_f64,
            speed in 0.0..30.0_f64,
            along in prop::collection::vec((0.1..3.0_f64, -8.0..3.0_f64), 1..10),
            across in prop::collection::vec((0.1..4.0_f64, -4.0..4.0_f64), 0..6),
        ) -> (Vec<Along>, Vec<Across>) {
            let mut pieces = vec![Along::constant_accel(0.0, gap + CAR.length, speed, 0.0)];
            for (length, accel) in along {
                let last = pieces[pieces.len() - 1];
                let time = last.time + length;
                let v = last.v_at(time).max(0.0);
                let accel = if v == 0.0 { accel.max(0.0) } else { accel };
                pieces.push(Along::constant_accel(time, last.s_at(time), v, accel));
            }
            let mut offsets = vec![Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
            for (length, d) in across {
                let time = offsets[offsets.len() - 1].time + length;
                offsets.push(Across { time, d, d_rate: 0.0 });
            }
            (pieces, offsets)
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 5000, failure_persistence: None, rng_seed: RngSeed::Fixed(2022), ..ProptestConfig::default() })]

        /// What the search knows of the refused candidate saves work, and no more than that; nor does where it looks
        /// first.
        #[test]
        fn law_the_cause_and_the_answer_are_those_of_a_search_that_knows_nothing(
            (along, across) in any_future(),
            speed in 1.0..40.0_f64,
            accel in -6.0..3.0_f64,
            guess in 0..40_usize,
            longest in 0.1..8.0_f64,
            further in prop_oneof![Just(0.0), 0.0..3.0_f64],
        ) {
            let ego = Ego { s: 0.0, d: 0.0, speed, accel, footprint: CAR };
            let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
            let params = Params { criterion: Criterion::Paper, ..Params::default() };
            let view = View::plain(future);
            let corridor = Corridor::new(&params, &ego, CAR, &view);
            let Some(encounter) = Encounter::new(&params, &corridor) else { return Ok(()) };
            let judge = Judge { encounter: &encounter, params: &params };
            let delay = |index: usize| {
                let share = 1.0 - index as f64 / 32.0;
                Delay { reaction_time: longest * share, head_start: further * share }
            };
            let found = judge.first_tolerable(33, delay, judge.first_with_time(33, delay, guess));
            let expected = (0..33).find(|index| judge.tolerated(delay(*index)).is_some());
            prop_assert_eq!(found.index, expected.unwrap_or(33));
            if let Some(refused) = found.index.checked_sub(1).map(delay) {
                let walked = judge.cause(&encounter.candidate(refused), 0.0);
                prop_assert_eq!(judge.refusal(refused, found.unmet_until), Some(walked));
            }
        }
    }
}
