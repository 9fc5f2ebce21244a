//! Which models were short, which collided when run again, and which is the tightest of the others.
//!
//! A model is ranked by what it asks for only where that was enough: those with a collision, and those below an MRF without one,
//! stand apart.

use std::fmt::Write as _;

use super::models::NEEDED;
use super::page::percent;
use super::table::Total;
use super::{Compared, Comparison};
use crate::reruns::Rerun;
use zhuyi_batch::statistics::mean;
use zhuyi_batch::text::{at_most_two_decimals, counted, listed};

/// How it came out, as a list.
pub(super) fn in_short(comparison: &Comparison, compared: &Compared, total: &Total) -> String {
    step_by_step(compared, total) + &in_closed_loop(comparison, compared)
}

fn rivals(compared: &Compared) -> impl Iterator<Item = usize> {
    (0..compared.models.len()).filter(|model| *model != NEEDED)
}

/// Which were short at a step, and who is the tightest of the rest.
fn step_by_step(compared: &Compared, total: &Total) -> String {
    let (short, enough): (Vec<usize>, Vec<usize>) =
        rivals(compared).partition(|model| total.models[*model].joint.short() > 0);
    let mut text = String::from("- ");
    if short.is_empty() {
        text += "No model was short at any step.";
    } else {
        let shares = by(short, |model| total.models[model].joint.share_short());
        let told = shares.iter().rev().map(|(model, share)| {
            let name = compared.models[*model];
            let harder = total.models[*model].share_short_with_harder_brakes();
            format!(
                "`{name}` {} % ({} %)",
                percent(Some(*share)),
                percent(harder)
            )
        });
        let _ = write!(
            text,
            "Short at some steps, as a share of those in need (in brackets: had the ego braked by {} m/s2): {}.",
            at_most_two_decimals(compared.assumptions.harder_decel),
            listed(&told.collect::<Vec<_>>())
        );
    }
    text += " What was needed is the answer of Zhuyi's own procedure, with the same a_b and the same held a_0, which favours `zhuyi`; \
             the closed loop does not.\n";
    text + &tightest(compared, total, enough)
}

/// Which collided at what they asked for, which were below the MRF all the same, and who is the tightest of the rest.
fn in_closed_loop(comparison: &Comparison, compared: &Compared) -> String {
    let closed_loop = &compared.closed_loop;
    let tried = closed_loop.trials.iter();
    let tried = tried.filter(|trials| trials.iter().any(Option::is_some));
    let tried = tried.count() as u64;
    if tried == 0 {
        return "- No scenario was run again, as some run collided in each.\n".to_string();
    }
    let named = |scenarios: Vec<usize>| {
        let names = scenarios.into_iter();
        let names = names.map(|scenario| comparison.scenarios[scenario].name.clone());
        listed(&names.collect::<Vec<_>>())
    };
    let told = |models: &[(usize, Vec<usize>)]| {
        let one = |(model, scenarios): &(usize, Vec<usize>)| {
            let name = compared.models[*model];
            format!("`{name}` (in {})", named(scenarios.clone()))
        };
        listed(&models.iter().map(one).collect::<Vec<_>>())
    };
    let collided_in = |model: usize| -> Vec<usize> {
        let trials = trials_with_collisions(compared, model).into_iter();
        trials.map(|(scenario, _)| scenario).collect()
    };
    let (collided, free): (Vec<_>, Vec<_>) = rivals(compared)
        .map(|model| (model, collided_in(model)))
        .partition(|(_, scenarios)| !scenarios.is_empty());
    let (below, enough): (Vec<_>, Vec<_>) = free
        .into_iter()
        .map(|(model, _)| (model, below_in(compared, model)))
        .partition(|(_, scenarios)| !scenarios.is_empty());

    let scenarios = counted(tried, "scenario");
    let mut text = if collided.is_empty() {
        format!("- Run again at what it asked for ({scenarios}), no model collides.\n")
    } else {
        format!(
            "- Run again at what it asked for ({scenarios}), some run collides with {}.\n",
            told(&collided)
        )
    };
    if !below.is_empty() {
        let _ = writeln!(
            text,
            "- Below the MRF, rounded up, and yet without a collision: {}.",
            told(&below)
        );
    }
    let of = if collided.is_empty() && below.is_empty() {
        "Of all"
    } else {
        "Of the others"
    };
    text + &tightest_in_closed_loop(
        compared,
        of,
        enough.into_iter().map(|(model, _)| model).collect(),
    )
}

/// Scenarios in which a model asks for less than the MRF.
fn below_in(compared: &Compared, model: usize) -> Vec<usize> {
    let trials = compared.closed_loop.trials.iter().enumerate();
    let is_below = |(scenario, trials): (usize, &Vec<Option<Rerun>>)| {
        let asked = trials[model].as_ref()?.asked;
        let is_below = compared.closed_loop.is_below(scenario, asked);
        is_below.then_some(scenario)
    };
    trials.filter_map(is_below).collect()
}

/// Scenarios in which a run collides at what a model asked for.
pub(super) fn trials_with_collisions(compared: &Compared, model: usize) -> Vec<(usize, &Rerun)> {
    let trials = compared.closed_loop.trials.iter().enumerate();
    trials
        .filter_map(|(scenario, trials)| Some((scenario, trials[model].as_ref()?)))
        .filter(|(_, rerun)| rerun.largest.collisions + rerun.own.collisions > 0)
        .collect()
}

/// Of models that asked for enough, the one that asks for the least first.
fn tightest_in_closed_loop(compared: &Compared, of: &str, enough: Vec<usize>) -> String {
    let above = |model: usize| -> Option<f64> {
        let trials = compared.closed_loop.trials.iter().enumerate();
        let above = |(scenario, trials): (usize, &Vec<Option<Rerun>>)| {
            let asked = trials[model].as_ref()?.asked;
            compared.closed_loop.above(scenario, asked)
        };
        mean(&trials.filter_map(above).collect::<Vec<_>>())
    };
    let told = by(enough, above);
    let told = told.iter().map(|(model, above)| {
        let name = compared.models[*model];
        format!("`{name}` with {above:.2}")
    });
    let told = listed(&told.collect::<Vec<_>>());
    if told.is_empty() {
        String::new()
    } else {
        format!(
            "- {of}, the tightest first, by the FPR that the largest demand, rounded up, is above the MRF in the mean of the \
             scenarios whose MRF is above 1: {told}.\n"
        )
    }
}

/// The models that were never short, the tightest first.
fn tightest(compared: &Compared, total: &Total, enough: Vec<usize>) -> String {
    let excess = by(enough, |model| total.models[model].joint.mean_excess(true));
    let told = excess.iter().map(|(model, excess)| {
        let name = compared.models[*model];
        format!("`{name}` with {excess:.2}")
    });
    let told = listed(&told.collect::<Vec<_>>());
    if told.is_empty() {
        String::new()
    } else {
        format!(
            "- Never short in these runs, the tightest first, by the FPR more than needed in the mean of the steps in need: {told}.\n"
        )
    }
}

/// Models that have a figure, in ascending order of it.
fn by(models: Vec<usize>, figure: impl Fn(usize) -> Option<f64>) -> Vec<(usize, f64)> {
    let with_figure = models
        .into_iter()
        .filter_map(|model| Some((model, figure(model)?)));
    let mut sorted: Vec<(usize, f64)> = with_figure.collect();
    sorted.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    sorted
}

#[cfg(test)]
mod tests {
    use super::super::ClosedLoop;
    use super::super::models::Panel;
    use super::*;
    use crate::Plan;
    use crate::reruns::Trial;
    use zhuyi_batch::mrf::required;
    use zhuyi_batch::rates::uniform;

    /// Two scenarios of an MRF of 5 and of 1; in the first, 3 FPR are free of collisions as well.
    fn compared(asked: [[f64; 3]; 2], collisions: [[u32; 3]; 2]) -> (Comparison, Compared) {
        let plan = Plan::embedded().unwrap();
        let trial = |asked: f64, collisions: u32| Trial {
            rates: uniform(&plan.system, asked.ceil() as u32),
            runs: 1,
            collisions,
        };
        let rerun = |(asked, collisions): (f64, u32)| {
            Some(Rerun {
                asked,
                largest: trial(asked, collisions),
                own: trial(asked, collisions),
            })
        };
        let trials = asked
            .into_iter()
            .zip(collisions)
            .map(|(asked, collisions)| asked.into_iter().zip(collisions).map(rerun).collect());
        let compared = Compared {
            models: vec!["a", "needed", "b"],
            assumptions: Panel::new(&plan.system).assumptions(),
            scenarios: Vec::new(),
            closed_loop: ClosedLoop {
                required: vec![
                    required(&[(1, 1), (2, 1), (3, 0), (4, 1), (5, 0), (6, 0)]),
                    required(&[(1, 0), (2, 0)]),
                ],
                trials: trials.collect(),
            },
        };
        let comparison = Comparison {
            scenarios: plan.scenarios.into_iter().take(2).collect(),
            system: plan.system,
            root_seed: 0,
            fpr: 30,
            seeds: 1,
            every: 1,
            command: "zhuyi compare".to_string(),
        };
        (comparison, compared)
    }

    #[test]
    fn hand_a_demand_is_rounded_up_before_it_meets_the_mrf() {
        // 4.8 runs as 5, which is the MRF; 6.2 as 7, two above it.
        let (comparison, compared) = compared([[6.2, 1.0, 4.8], [1.0; 3]], [[0; 3]; 2]);
        let closed_loop = &compared.closed_loop;
        assert_eq!(
            [4.0, 4.1, 5.0].map(|asked| closed_loop.is_below(0, asked)),
            [true, false, false]
        );
        assert_eq!(
            [4.1, 6.2].map(|asked| closed_loop.above(0, asked)),
            [Some(0.0), Some(2.0)]
        );
        assert_eq!(closed_loop.above(1, 6.2), None);
        let text = in_closed_loop(&comparison, &compared);
        let start = "- Run again at what it asked for (2 scenarios), no model collides.\n- Of all";
        assert!(text.starts_with(start), "{text}");
        assert!(
            text.ends_with("above 1: `b` with 0.00 and `a` with 2.00.\n"),
            "{text}"
        );
    }

    #[test]
    fn hand_below_the_mrf_is_no_rank() {
        // 2.4 runs as 3, where no seed happens to collide.
        let (comparison, both) = compared([[6.2, 1.0, 2.4], [1.0; 3]], [[0; 3]; 2]);
        let name = &comparison.scenarios[0].name;
        let text = in_closed_loop(&comparison, &both);
        let apart =
            format!("- Below the MRF, rounded up, and yet without a collision: `b` (in {name}).\n");
        assert!(text.contains(&apart), "{text}");
        assert!(text.ends_with("above 1: `a` with 2.00.\n"), "{text}");
        // With a collision it is told as that, and once.
        let (comparison, both) = compared([[6.2, 1.0, 2.0], [1.0; 3]], [[0, 0, 1], [0; 3]]);
        let text = in_closed_loop(&comparison, &both);
        assert!(
            text.contains(&format!("some run collides with `b` (in {name}).\n")),
            "{text}"
        );
        assert!(!text.contains("yet without"), "{text}");
    }

    #[test]
    fn hand_where_nothing_was_run_again_nobody_is_praised() {
        let (comparison, mut compared) = compared([[1.0; 3]; 2], [[0; 3]; 2]);
        compared.closed_loop.trials = vec![vec![None; 3]; 2];
        assert_eq!(
            in_closed_loop(&comparison, &compared),
            "- No scenario was run again, as some run collided in each.\n"
        );
    }
}
