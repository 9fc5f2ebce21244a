//! The verdict on one reaction time, by either solver and either criterion, and what speaks against a refused one.
//!
//! A latency is refused when no t_n exists. That is put down to pass-through where a t_n would exist but for
//! contact (reading R6), to the speed (Eq. 2) where the ego is never slow enough, and to the distance (Eq. 1)
//! otherwise.

use crate::conflict::Zone;
use crate::encounter::{Ask, Encounter, overlap};
use crate::exact::Found;
use crate::{Binding, Criterion, Params, Solver, exact, paper};

/// How reaction times are judged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judge<'a> {
    pub encounter: &'a Encounter<'a>,
    pub params: &'a Params,
}

impl Judge<'_> {
    /// The first of `count` reaction times, given in falling order, that will do. `guess` says where to look first.
    pub fn first_tolerable(
        &self,
        count: usize,
        reaction_time: impl Fn(usize) -> f64,
        guess: usize,
    ) -> Option<Found> {
        if self.jumps() {
            let jump_to = |index| {
                let t_n =
                    paper::found_time(self.encounter, reaction_time(index), self.params.max_steps)?;
                Some(Found {
                    index,
                    t_n: Some(t_n),
                })
            };
            return (0..count).find_map(jump_to);
        }
        let candidate = |index| self.encounter.candidate(reaction_time(index));
        if self.encounter.earlier_is_better() {
            return exact::first_tolerable(
                self.encounter,
                self.params.criterion,
                count,
                candidate,
                guess,
            );
        }
        (0..count).find_map(|index| {
            let found = self.exact(reaction_time(index))?;
            Some(Found { index, ..found })
        })
    }

    /// The t_n of one reaction time in continuous time.
    fn exact(&self, reaction_time: f64) -> Option<Found> {
        let candidate = |_| self.encounter.candidate(reaction_time);
        exact::first_tolerable(self.encounter, self.params.criterion, 1, candidate, 0)
    }

    /// Whether t_n is searched by jumps, which may miss it.
    fn jumps(&self) -> bool {
        self.params.criterion == Criterion::Paper && self.params.solver == Solver::Paper
    }

    /// What refuses a reaction time that is not tolerable; `None` if it leaves no time in the horizon at all, or if
    /// nothing does and the jumps missed every t_n.
    pub fn refusal(&self, reaction_time: f64) -> Option<Binding> {
        let encounter = self.encounter;
        if self.params.criterion == Criterion::Standstill {
            return Some(Binding::PassThrough);
        }
        let horizon = encounter.corridor.horizon;
        if reaction_time > horizon || (self.jumps() && self.exact(reaction_time).is_some()) {
            return None;
        }
        let candidate = encounter.candidate(reaction_time);
        let met = Ask {
            contact: false,
            met: true,
        };
        let mut slow_enough = false;
        for span in encounter.spans() {
            let Some((from, to)) = overlap(&span, reaction_time, horizon) else {
                continue;
            };
            let outside = span.zone == Zone::After;
            if outside || encounter.first_event(met, &candidate, from, to).is_some() {
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
