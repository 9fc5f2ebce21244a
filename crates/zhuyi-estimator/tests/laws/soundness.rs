//! Soundness: an ego that follows the procedure with the returned latency does not touch the actor.
//!
//! Under the criterion `paper` the promise ends at t_n; where t_n lies outside the corridor, and under `standstill`, it
//! ends with the horizon. The replay (`replay.rs`) also looks whether t_n is what R5 and R9 say.

use zhuyi_estimator::State;

use crate::case::Way;
use crate::law::{Asked, Figures, Law, Side};
use crate::replay::{Replay, replay};

pub const LAWS: &[&Law] = &[&SOUND, &CRITERIA];

/// [m] contact counts from here on: the model's own tolerance and the rounding of some hundred metres.
const CONTACT: f64 = -1e-6;

const SOUND: Law = Law {
    name: "the procedure is sound: up to t_n, under standstill throughout",
    check: |asked, _| {
        let horizon = asked.case.params.horizon;
        let mut promised = false;
        for way in Way::ALL {
            let answer = asked.answer(way)?;
            let Some(reaction) = reaction(asked, answer.state, answer.latency) else {
                let conflict = replay(asked.case, 0.0, horizon).conflict;
                if conflict.is_none() != (answer.state == State::None) {
                    return Err(format!(
                        "{way:?} {answer:?}, conflict from {conflict:?}\n{:?}",
                        asked.case
                    ));
                }
                continue;
            };
            promised = true;
            let seen = replay(asked.case, reaction, answer.t_n.unwrap_or(horizon));
            let throughout = || replay(asked.case, reaction, horizon).clearance;
            let kept = seen.clearance > CONTACT
                && (answer.t_n.is_none()
                    || serves(&seen)
                    || seen.outside && throughout() > CONTACT);
            if !kept {
                let clearance = throughout();
                return Err(format!(
                    "{way:?} {answer:?}, {seen:?}, in all {clearance} m\n{:?}",
                    asked.case
                ));
            }
        }
        Ok(if promised { Side::Inside } else { Side::Silent })
    },
};

/// Eq. 1 and Eq. 2 hold.
fn serves(seen: &Replay) -> bool {
    seen.slack > CONTACT
}

/// [s] the reaction time that was found tolerable (R1).
fn reaction(asked: &Asked<'_>, state: State, latency: Option<f64>) -> Option<f64> {
    let confirm =
        |l: f64| f64::from(asked.case.params.confirm_frames) * (l - asked.case.current_latency);
    match (state, latency) {
        (State::Tolerable, Some(l)) => Some(if confirm(l) > 0.0 { l + confirm(l) } else { l }),
        (State::BeyondGrid, _) => Some(0.0),
        _ => None,
    }
}

/// `standstill` may tolerate more (it knows no margins) or less (it looks beyond t_n).
const CRITERIA: Law = Law {
    name: "standstill tolerates no more than paper (no law: counted)",
    check: |asked, figures| {
        let (paper, standstill) = (asked.answer(Way::Exact)?, asked.answer(Way::Standstill)?);
        if matches!(paper.state, State::None | State::Standing) {
            return Ok(Side::Silent);
        }
        after_t_n(asked, paper.state, paper.latency, figures);
        if (paper.state, paper.latency) == (standstill.state, standstill.latency) {
            figures.count("criteria: conflict, and the same answer");
        } else if let (Some(paper), Some(standstill)) = (paper.fpr(), standstill.fpr()) {
            match standstill - paper {
                0.0 => figures.count("criteria: they differ in the state alone, at 30 FPR"),
                more if more > 0.0 => {
                    figures.add("criteria: standstill asks for more [FPR more]", more);
                }
                less => figures.add("criteria: standstill asks for less [FPR less]", -less),
            }
        } else {
            figures.count("criteria: alongside for one of them alone");
        }
        Ok(Side::Outside(
            crate::law::tolerance(&standstill) <= crate::law::tolerance(&paper),
        ))
    },
};

/// What comes after t_n, with the braking kept up.
fn after_t_n(asked: &Asked<'_>, state: State, latency: Option<f64>, figures: &mut Figures) {
    let Some(reaction) = reaction(asked, state, latency) else {
        return;
    };
    let clearance = replay(asked.case, reaction, asked.case.params.horizon).clearance;
    figures.count("paper: tolerable or beyond_grid, replayed to the horizon");
    if clearance <= CONTACT {
        figures.add("paper: of these, contact after t_n [m inside]", -clearance);
    }
}

#[test]
fn law_the_procedure_is_sound() {
    crate::few(LAWS);
}
