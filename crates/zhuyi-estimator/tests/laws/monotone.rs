//! More room, more time or more brakes never lower what is tolerated.
//!
//! The domain of each stands in the table of `main.rs`.
//!
//! "Dropped" is reading R8: a stay in the corridor that begins with the actor's front behind the ego's rear is not the
//! ego's to prevent by braking. With more gap, a faster actor or a slower ego the same stay may begin beside or before the
//! ego, and is then its business: what was tolerable, or no conflict at all, may be alongside. The stay counts in
//! the easier of both cases only; where none is dropped in the harder one, all stays are the same in both.
//!
//! All of this is said of the solver that misses no t_n. The jumps of Eq. 3 may miss one in the easier case that they hit
//! in the harder one; they have rows of their own, wholly outside the domain.
//!
//! Why the ego's speed is a law: with the reaction time fixed, the slower ego is at every time less far and not faster,
//! whatever a_0. Why K and l_0 are: they act through t_r alone, and with a_b >= |a_0| (C4 >= 1) an ego that reacts
//! earlier is at every time less far and not faster.

use zhuyi_estimator::State;

use crate::case::{Case, Way};
use crate::law::{Asked, Figures, Law, Side, tolerance};

pub const LAWS: &[&Law] = &[
    &Law {
        name: "a larger gap never hurts",
        check: |asked, _| kinematic(asked, further, &Way::SURE),
    },
    &Law {
        name: "a faster actor never hurts",
        check: |asked, _| kinematic(asked, faster, &Way::SURE),
    },
    &Law {
        name: "a slower ego never hurts",
        check: |asked, _| kinematic(asked, slower, &Way::SURE),
    },
    &Law {
        name: "an ego that brakes more at t_0 never hurts",
        check: |asked, _| kinematic(asked, braking, &Way::SURE),
    },
    &Law {
        name: "fewer frames to confirm never hurt",
        check: |asked, _| parametric(asked, fewer_frames, &Way::SURE),
    },
    &Law {
        name: "a larger l_0 never hurts",
        check: |asked, _| parametric(asked, slower_camera, &Way::SURE),
    },
    &Law {
        name: "a larger C1 never hurts",
        check: |asked, _| parametric(asked, larger_c1, &Way::SURE),
    },
    &Law {
        name: "a larger C2 never hurts",
        check: |asked, _| parametric(asked, larger_c2, &Way::SURE),
    },
    &Law {
        name: "a larger C3 never hurts",
        check: |asked, _| parametric(asked, larger_c3, &Way::SURE),
    },
    &STANDSTILL,
    &Law {
        name: "jumps: a larger gap never hurts",
        check: |asked, _| jumps(asked, further),
    },
    &Law {
        name: "jumps: a faster actor never hurts",
        check: |asked, _| jumps(asked, faster),
    },
    &Law {
        name: "jumps: a slower ego never hurts",
        check: |asked, _| jumps(asked, slower),
    },
    &Law {
        name: "jumps: fewer frames to confirm never hurt",
        check: |asked, _| jumps(asked, fewer_frames),
    },
    &Law {
        name: "jumps: a larger C1 never hurts",
        check: |asked, _| jumps(asked, larger_c1),
    },
    &Law {
        name: "jumps: a larger C2 never hurts",
        check: |asked, _| jumps(asked, larger_c2),
    },
];

/// The same case, made easier.
type Easier = fn(&Case) -> Case;

/// A change of any size, from a thousandth to `most`.
fn size(case: &Case, purpose: u64, most: f64) -> f64 {
    most * f64::powf(1e-3 / most, case.dice(purpose).between(0.0, 1.0))
}

fn further(case: &Case) -> Case {
    case.with(|case| case.shift_actor(size(case, 1, 50.0)))
}

fn faster(case: &Case) -> Case {
    let more = size(case, 2, 20.0);
    case.with(|case| {
        for piece in &mut case.along {
            piece.s += more * (piece.time - case.now);
            piece.s_rate += more;
            piece.v += more;
        }
    })
}

fn slower(case: &Case) -> Case {
    case.with(|case| case.ego.speed = (case.ego.speed - size(case, 3, 20.0)).max(0.0))
}

fn braking(case: &Case) -> Case {
    case.with(|case| case.ego.accel -= size(case, 4, 5.0))
}

fn fewer_frames(case: &Case) -> Case {
    let most = case.params.confirm_frames;
    case.with(|case| case.params.confirm_frames = case.dice(5).below(most.max(1) as usize) as u32)
}

fn slower_camera(case: &Case) -> Case {
    case.with(|case| case.current_latency += size(case, 6, 1.0))
}

fn larger_c1(case: &Case) -> Case {
    case.with(|case| case.params.c1 += (1.0 - case.params.c1) * case.dice(7).between(0.0, 1.0))
}

fn larger_c2(case: &Case) -> Case {
    case.with(|case| case.params.c2 += (1.0 - case.params.c2) * case.dice(8).between(0.0, 1.0))
}

fn larger_c3(case: &Case) -> Case {
    case.with(|case| case.params.c3 += size(case, 9, 5.0))
}

fn kinematic(asked: &Asked<'_>, easier: Easier, ways: &[Way]) -> Result<Side, String> {
    never_less(asked, &easier(asked.case), ways, asked.plain.dropped == 0)
}

fn parametric(asked: &Asked<'_>, easier: Easier, ways: &[Way]) -> Result<Side, String> {
    never_less(asked, &easier(asked.case), ways, true)
}

fn jumps(asked: &Asked<'_>, easier: Easier) -> Result<Side, String> {
    if asked.plain.dropped > 0 || !asked.plain.conflict {
        return Ok(Side::Silent);
    }
    never_less(asked, &easier(asked.case), &[Way::Jumps], false)
}

fn never_less(
    asked: &Asked<'_>,
    easier: &Case,
    ways: &[Way],
    inside: bool,
) -> Result<Side, String> {
    if !asked.plain.conflict && inside {
        return Ok(Side::Silent);
    }
    let eased = Asked::new(easier);
    let mut holds = true;
    for way in ways {
        let (less, more) = (asked.answer(*way)?, eased.answer(*way)?);
        holds &= tolerance(&more) >= tolerance(&less);
        if inside && !holds {
            return Err(format!(
                "{way:?}: {less:?}, made easier {more:?}\n{:?}\n{easier:?}",
                asked.case
            ));
        }
    }
    Ok(if inside {
        Side::Inside
    } else {
        Side::Outside(holds)
    })
}

const STANDSTILL: Law = Law {
    name: "standstill tolerates no more than paper without margins",
    check: standstill,
};

fn standstill(asked: &Asked<'_>, _: &mut Figures) -> Result<Side, String> {
    use crate::plain::Zone;
    let strict = asked.answer(Way::Standstill)?;
    let (State::Tolerable, Some(latency)) = (strict.state, strict.latency) else {
        return Ok(Side::Silent);
    };
    let free = asked
        .case
        .with(|case| (case.params.c1, case.params.c2) = (1.0, 1.0));
    let free = Asked::new(&free).answer(Way::Exact)?;
    let holds = tolerance(&strict) <= tolerance(&free);
    let stands = asked
        .plain
        .motion(asked.plain.reaction(latency))
        .stands_from()
        < asked.case.params.horizon - 1e-6;
    let inside = stands && matches!(asked.plain.last_zone(), Some(Zone::Overlap | Zone::After));
    match (inside, holds) {
        (true, false) => Err(format!(
            "{strict:?}, without margins {free:?}\n{:?}",
            asked.case
        )),
        (true, true) => Ok(Side::Inside),
        (false, holds) => Ok(Side::Outside(holds)),
    }
}

#[test]
fn law_more_never_hurts() {
    crate::few(LAWS);
}
