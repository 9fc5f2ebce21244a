//! The verdict on one reaction time, by either solver and either criterion, and what speaks against a refused one.
//!
//! A latency is refused when no t_n exists. That is put down to pass-through where a t_n would exist but for
//! contact (reading R6), to the speed (Eq. 2) where the ego is never slow enough, and to the distance (Eq. 1)
//! otherwise.

use crate::conflict::Zone;
use crate::encounter::{Encounter, overlap};
use crate::stretch::{Outline, Stretch};
use crate::{Binding, Criterion, Solver, exact, paper};

/// How a reaction time is judged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judge<'a> {
    pub encounter: &'a Encounter<'a>,
    pub solver: Solver,
    pub criterion: Criterion,
    pub max_steps: u32,
}

/// A tolerable reaction time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerated {
    pub t_n: Option<f64>,
}

impl Judge<'_> {
    /// Whether a reaction time will do.
    pub fn tolerates(&self, reaction_time: f64) -> Option<Tolerated> {
        match (self.criterion, self.solver) {
            (Criterion::Standstill, _) => {
                let motion = self.encounter.reaction(reaction_time)?;
                let contact =
                    self.encounter
                        .first_contact(&motion, reaction_time, self.encounter.horizon);
                contact.is_none().then_some(Tolerated { t_n: None })
            }
            (Criterion::Paper, Solver::Exact) => exact::first_time(self.encounter, reaction_time)
                .map(|t_n| Tolerated { t_n: Some(t_n) }),
            (Criterion::Paper, Solver::Paper) => {
                paper::found_time(self.encounter, reaction_time, self.max_steps)
                    .map(|t_n| Tolerated { t_n: Some(t_n) })
            }
        }
    }

    /// Whether a latency below a tolerable one is sure to be tolerable: not with the jumps, which may miss.
    pub fn monotone(&self) -> bool {
        let jumps = self.criterion == Criterion::Paper && self.solver == Solver::Paper;
        !jumps && self.encounter.earlier_is_better()
    }

    /// What refuses a reaction time that is not tolerable; `None` if it leaves no time in the horizon at all, or if
    /// nothing does and the jumps missed every t_n.
    pub fn refusal(&self, reaction_time: f64) -> Option<Binding> {
        let encounter = self.encounter;
        if self.criterion == Criterion::Standstill {
            return Some(Binding::PassThrough);
        }
        let missed = || exact::first_time(encounter, reaction_time).is_some();
        if reaction_time > encounter.horizon || (self.solver == Solver::Paper && missed()) {
            return None;
        }
        let (motion, margins) = (encounter.motion(reaction_time), encounter.margins);
        let hopeless = |outline: &Outline| outline.is_unmet(margins);
        let met = |stretch: &Stretch| stretch.first_met(margins, stretch.length);
        let slow = |stretch: &Stretch| stretch.ever_slow_enough(margins).then_some(());
        let mut slow_enough = false;
        for span in encounter.spans.iter() {
            let Some((from, to)) = overlap(&span, reaction_time, encounter.horizon) else {
                continue;
            };
            let outside = span.zone == Zone::After;
            if outside || encounter.walk(&motion, from, to, hopeless, met).is_some() {
                return Some(Binding::PassThrough);
            }
            // Standing is slow enough for anything.
            slow_enough |= motion.stands_from() <= to
                || encounter.walk(&motion, from, to, |_| false, slow).is_some();
        }
        Some(if slow_enough {
            Binding::Distance
        } else {
            Binding::Speed
        })
    }
}
