//! The fast path against the plain one.

use zhuyi_estimator::{Recording, State};

use crate::case::Way;
use crate::law::{Figures, Law, Side};

pub const LAWS: &[&Law] = &[&PLAIN, &RECORDED, &EXACT_MISSES_NOTHING];

/// The whole grid is tried from the largest latency down. (Other laws ask other questions about the case, and there the
/// plain solver tries the answer and the next larger latency.)
const PLAIN: Law = Law {
    name: "the answer is the plain solver's, in state, latency, t_n and what refused",
    check: |asked, figures| {
        if !asked.plain.conflict {
            figures.count("state: none");
        }
        for way in Way::ALL {
            let (answer, estimator) = (asked.case.ask(way), asked.case.estimator(way));
            if let Some(objection) =
                asked
                    .plain
                    .objection(&answer, way, estimator.latencies(), true)
            {
                return Err(format!("{objection}\n{:?}", asked.case));
            }
            if way == Way::Exact {
                count(
                    figures,
                    answer.state,
                    answer.latency == Some(estimator.latencies()[0]),
                );
            }
        }
        Ok(Side::Inside)
    },
};

fn count(figures: &mut Figures, state: State, largest: bool) {
    figures.count(match state {
        State::None => return,
        State::Tolerable if largest => "state: tolerable, the largest of the grid",
        State::Tolerable => "state: tolerable, less than that",
        State::BeyondGrid => "state: beyond_grid",
        State::Unavoidable => "state: unavoidable",
        State::Alongside => "state: alongside",
        State::Standing => "state: standing",
    });
}

const RECORDED: Law = Law {
    name: "a recording has the answer of its list",
    check: |asked, _| {
        let recording = Recording::new(asked.case.trajectory());
        for way in Way::ALL {
            let (list, found) = (asked.answer(way)?, asked.case.ask_recorded(way, &recording));
            let close = (found.t_n.unwrap_or(-1.0) - list.t_n.unwrap_or(-1.0)).abs() < 1e-6;
            let same = (
                found.state,
                found.latency,
                found.binding,
                found.extrapolated,
            ) == (list.state, list.latency, list.binding, list.extrapolated);
            if !same || !close {
                return Err(format!(
                    "{way:?}: {found:?}, the list {list:?}\n{:?}",
                    asked.case
                ));
            }
        }
        Ok(Side::Inside)
    },
};

const EXACT_MISSES_NOTHING: Law = Law {
    name: "the jumps never tolerate more than the exact solver",
    check: |asked, figures| {
        let (exact, jumps) = (asked.answer(Way::Exact)?, asked.answer(Way::Jumps)?);
        let (fine, coarse) = (crate::law::tolerance(&exact), crate::law::tolerance(&jumps));
        if coarse > fine {
            return Err(format!(
                "jumps {jumps:?}, exact {exact:?}\n{:?}",
                asked.case
            ));
        }
        if let (true, Some(less), Some(more)) = (coarse < fine, exact.fpr(), jumps.fpr()) {
            figures.add(
                "the jumps ask for more than the exact solver [FPR more]",
                more - less,
            );
        }
        Ok(Side::Inside)
    },
};

#[test]
fn law_the_fast_path_is_the_plain_one() {
    crate::few(LAWS);
}
