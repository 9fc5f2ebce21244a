//! The verdict on one delay, by either solver and either criterion, and what speaks against a refused one.
//!
//! A latency is refused when no t_n exists. That is put down to pass-through where a t_n would exist but for
//! contact (reading R6), to the speed (Eq. 2) where the ego is never slow enough, and to the distance (Eq. 1)
//! otherwise.

use crate::conflict::Zone;
use crate::encounter::{Ask, Delay, Encounter, overlap};
use crate::exact::Found;
use crate::{Binding, Criterion, Params, Solver, exact, paper};

/// How reaction times are judged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judge<'a> {
    pub encounter: &'a Encounter<'a>,
    pub params: &'a Params,
}

impl Judge<'_> {
    /// The first of `count` delays (at least one), given in falling order, that will do. `guess` says where to look
    /// first.
    pub fn first_tolerable(
        &self,
        count: usize,
        delay: impl Fn(usize) -> Delay,
        guess: usize,
    ) -> Found {
        if !self.jumps() && self.encounter.earlier_is_better() {
            let candidate = |index| self.encounter.candidate(delay(index));
            return exact::first_tolerable_near(
                self.encounter,
                self.params.criterion,
                count,
                candidate,
                guess,
            );
        }
        let tolerated = |index| {
            let t_n = self.tolerated(delay(index))?;
            Some(Found {
                index,
                t_n,
                unmet_until: 0.0,
            })
        };
        (0..count).find_map(tolerated).unwrap_or(Found {
            index: count,
            t_n: None,
            unmet_until: 0.0,
        })
    }

    /// Whether one delay will do, and its t_n.
    fn tolerated(&self, delay: Delay) -> Option<Option<f64>> {
        if self.jumps() {
            return paper::found_time(self.encounter, delay, self.params.max_steps).map(Some);
        }
        self.exactly(delay)
    }

    /// The same in continuous time.
    fn exactly(&self, delay: Delay) -> Option<Option<f64>> {
        let candidate = |_| self.encounter.candidate(delay);
        let found = exact::first_tolerable(self.encounter, self.params.criterion, 0..1, candidate);
        (found.index == 0).then_some(found.t_n)
    }

    /// Whether t_n is searched by jumps, which may miss it.
    fn jumps(&self) -> bool {
        self.params.criterion == Criterion::Paper && self.params.solver == Solver::Paper
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
        if reaction_time > horizon || (self.jumps() && self.exactly(delay).is_some()) {
            return None;
        }
        let candidate = encounter.candidate(delay);
        let met = Ask {
            contact: false,
            met: true,
        };
        let mut slow_enough = false;
        for span in encounter.spans() {
            let Some((from, to)) = overlap(&span, reaction_time, horizon) else {
                continue;
            };
            let unknown = if from > unmet_until {
                from
            } else {
                unmet_until
            };
            let met_later = || {
                unknown < to
                    && encounter
                        .first_event(met, &candidate, unknown, to)
                        .is_some()
            };
            if span.zone == Zone::After || met_later() {
                return Some(Binding::PassThrough);
            }
            // Standing is slow enough for anything.
            slow_enough |= candidate.motion.stands_from() <= to
                || encounter.ever_slow_enough(&candidate, from, to);
        }
        Some(if slow_enough {
            Binding::Distance
        } else {
            Binding::Speed
        })
    }
}
