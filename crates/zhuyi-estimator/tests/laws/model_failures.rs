//! Where the model itself breaks a law that one would expect, how often, and the cautious variant.
//!
//! One expects that below a tolerable latency every latency is tolerable. Two things break this: the jumps of Eq. 3 may
//! miss a t_n from an earlier start, and with C4 < 1 the procedure may brake less than the ego does by itself, so that
//! to react later is to brake harder. `Params::cautious` answers with the largest latency below which there is no such
//! hole.

use crate::case::{Case, Way};
use crate::law::{Asked, Figures, Law, Side, tolerance};
use zhuyi_estimator::State;

pub const LAWS: &[&Law] = &[&REPAIRED, &JUMPS, &WEAK];

/// The case with a procedure that may brake less than the ego does.
fn weak(case: &Case) -> Case {
    let dice = &mut case.dice(50);
    let (c4, accel) = (dice.between(0.1, 1.0), dice.between(-9.0, -2.0));
    case.with(|case| {
        case.params.c4 = c4;
        case.ego.accel = accel;
    })
}

fn cautious(case: &Case) -> Case {
    case.with(|case| case.params.cautious = true)
}

const REPAIRED: Law = Law {
    name: "cautious: every smaller latency is tolerable too, and none larger than this is so",
    check: |asked, _| {
        for case in [cautious(asked.case), cautious(&weak(asked.case))] {
            let cautious = Asked::new(&case);
            if !cautious.plain.conflict {
                continue;
            }
            for way in Way::ALL {
                let answer = cautious.answer(way)?;
                if answer.state == State::Standing {
                    continue;
                }
                let estimator = case.estimator(way);
                let grid = estimator.latencies();
                let refused = |l: f64| {
                    cautious
                        .plain
                        .tolerates(cautious.plain.reaction(l), way)
                        .is_none()
                };
                let smallest_refused = grid.iter().copied().rev().find(|l| refused(*l));
                let holds = match (answer.latency, smallest_refused) {
                    (Some(latency), refused) => refused.is_none_or(|refused| refused > latency),
                    (None, refused) => refused == grid.last().copied(),
                };
                if !holds {
                    return Err(format!(
                        "{way:?}: {answer:?}, but {smallest_refused:?} is refused\n{case:?}"
                    ));
                }
            }
        }
        Ok(Side::Inside)
    },
};

/// The cautious variant tolerates less only where there is a hole.
fn hole(case: &Case, way: Way, name: &'static str, figures: &mut Figures) -> Result<bool, String> {
    let careful = cautious(case);
    let (usual, careful) = (
        Asked::new(case).answer(way)?,
        Asked::new(&careful).answer(way)?,
    );
    let hole = tolerance(&careful) < tolerance(&usual);
    if tolerance(&careful) > tolerance(&usual) {
        return Err(format!(
            "cautious tolerates more: {careful:?}, usually {usual:?}\n{case:?}"
        ));
    }
    if hole {
        figures.add(
            name,
            careful.fpr().unwrap_or(30.0) - usual.fpr().unwrap_or(30.0),
        );
    }
    Ok(hole)
}

const JUMPS: Law = Law {
    name: "jumps: below a tolerable latency all are tolerable",
    check: |asked, figures| {
        if !asked.plain.conflict {
            return Ok(Side::Silent);
        }
        for way in Way::SURE {
            if hole(asked.case, way, "never", figures)? {
                return Err(format!("{way:?}: a hole, with C4 >= 1\n{:?}", asked.case));
            }
        }
        Ok(Side::Outside(!hole(
            asked.case,
            Way::Jumps,
            "hole: jumps, cautious asks for more [FPR more]",
            figures,
        )?))
    },
};

const WEAK: Law = Law {
    name: "C4 < 1: below a tolerable latency all are tolerable",
    check: |asked, figures| {
        let case = weak(asked.case);
        if case.held_accel() == 0.0 {
            return Ok(Side::Silent);
        }
        let exact = hole(
            &case,
            Way::Exact,
            "hole: C4 < 1, paper, cautious asks for more [FPR more]",
            figures,
        )?;
        let standstill = hole(
            &case,
            Way::Standstill,
            "hole: C4 < 1, standstill, cautious asks for more [FPR more]",
            figures,
        )?;
        Ok(Side::Outside(!exact && !standstill))
    },
};

#[test]
fn law_the_cautious_variant_has_no_holes() {
    crate::few(LAWS);
}
