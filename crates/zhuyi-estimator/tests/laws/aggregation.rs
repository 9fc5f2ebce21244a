//! Several futures of one actor (reading R13): the answer lies between the worst and the best of them.
//!
//! The laws are about futures that ask for a rate; those with the actor alongside are left out, as in the crate. A
//! mean counts futures beyond the grid as 1/30 s, so where every latency is smaller than that it may lie above the
//! best.

use zhuyi_core::{ActorId, Forecast, Trajectory};
use zhuyi_estimator::{Aggregation, Estimate, Estimator, Params, State};

use crate::case::{Case, Way};
use crate::law::{Asked, Figures, Law, Side, tolerance};

pub const LAWS: &[&Law] = &[&BETWEEN];

const BETWEEN: Law = Law {
    name: "percentiles and mean lie between worst and best, larger shares lower, order and scale are nothing",
    check: between,
};

fn between(asked: &Asked<'_>, _: &mut Figures) -> Result<Side, String> {
    let (case, dice) = (asked.case, &mut asked.case.dice(40));
    let mut futures = vec![(dice.between(0.01, 1.0), case.clone())];
    for i in 0..dice.below(4) as u64 {
        // Another future of the same actor at the same place, or of one elsewhere; round only if this one is.
        let other = Case::draw(case.number + 5 * (1 + i));
        futures.push((
            dice.between(0.01, 1.0),
            transplanted(case, &other, dice.chance(0.5)),
        ));
    }
    let (share, more) = (dice.between(0.01, 1.0), dice.between(0.0, 1.0));
    let mut each = Vec::new();
    for (_, future) in &futures {
        each.push(Asked::new(future).answer(Way::Exact)?);
    }
    each.retain(|estimate| estimate.state != State::Alongside);
    let tolerances = || each.iter().map(tolerance);
    let (Some(worst), Some(best)) = (
        tolerances().min_by(f64::total_cmp),
        tolerances().max_by(f64::total_cmp),
    ) else {
        return Ok(Side::Silent);
    };
    let ask = |aggregation, futures: &[(f64, Case)]| aggregated(case, aggregation, futures);
    let percentile = |share| tolerance(&ask(Aggregation::Percentile(share), &futures));
    let (found, stricter) = (percentile(share), percentile(share + (1.0 - share) * more));
    let mean = tolerance(&ask(Aggregation::Mean, &futures));
    let mut reordered = futures.clone();
    reordered.reverse();
    for (weight, _) in &mut reordered {
        *weight *= 3.0;
    }
    let fails = [
        (
            worst <= found && found <= best,
            "the percentile is not between worst and best",
        ),
        (stricter <= found, "a larger share gives more"),
        (percentile(1.0) == worst, "100 % is not the worst"),
        (
            tolerance(&ask(Aggregation::Worst, &futures)) == worst,
            "the worst is not the worst",
        ),
        (
            worst - 1e-12 <= mean && mean <= best.max(1.0 / 30.0) + 1e-12,
            "the mean is not between worst and best",
        ),
        (
            tolerance(&ask(Aggregation::Percentile(share), &reordered)) == found,
            "order or scale of weights counts",
        ),
    ];
    for (holds, failure) in fails {
        if !holds {
            return Err(format!(
                "{failure}: share {share}, {found} {stricter} {mean}, each {each:?}\n{futures:?}"
            ));
        }
    }
    Ok(Side::Inside)
}

/// The future of `other` before the ego of `case`.
fn transplanted(case: &Case, other: &Case, from_same_place: bool) -> Case {
    let place = |case: &Case| {
        crate::ways::holding(&case.along, |piece| piece.time, case.now).s_at(case.now)
    };
    let ahead = if from_same_place {
        place(case) - case.ego.s
    } else {
        place(other) - other.ego.s
    };
    case.with(|new| {
        (new.along, new.across) = (other.along.clone(), other.across.clone());
        for piece in &mut new.along {
            piece.time += case.now - other.now;
        }
        for piece in &mut new.across {
            // With its own part in the nudge of a case that lies on a border.
            piece.time += case.now - other.now + case.nudge;
            piece.d += case.ego.d - other.ego.d;
        }
        let by = case.ego.s + ahead - place(new);
        new.shift_actor(by);
    })
}

fn aggregated(case: &Case, aggregation: Aggregation, futures: &[(f64, Case)]) -> Estimate {
    let params = Params {
        aggregation,
        ..case.params.clone()
    };
    let trajectories: Vec<(f64, Trajectory)> = futures
        .iter()
        .map(|(weight, future)| (*weight, future.trajectory()))
        .collect();
    let forecast = Forecast {
        actor: ActorId(0),
        footprint: case.actor,
        trajectories,
    };
    Estimator::new(params)
        .forecast(&case.ego, &forecast, case.now, case.current_latency)
        .estimate
}

#[test]
fn law_aggregates_lie_between_worst_and_best() {
    crate::few(LAWS);
}
