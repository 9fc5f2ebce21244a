//! What the figures show, in words: which model asked for too little, where and why; which is the tightest of the others.

use std::fmt::Write as _;

use super::audit::{Moment, Tally};
use super::files::Total;
use super::models::NEEDED;
use super::page::percent;
use super::scenes::Answered;
use super::{Compared, Comparison};
use crate::mrf::Mrf;
use crate::reruns::Rerun;
use crate::statistics::mean;

/// The section, with its heading.
pub(super) fn markdown(
    comparison: &Comparison,
    compared: &Compared,
    total: &Total,
    scenes: &[Answered],
) -> String {
    let mut text = format!(
        "## What came out\n\n{}\nModel by model:\n\n",
        in_short(comparison, compared, total)
    );
    for model in 0..compared.models.len() {
        if model != NEEDED {
            let _ = writeln!(
                text,
                "- {}",
                of_model(comparison, compared, total, scenes, model)
            );
        }
    }
    text
}

/// Which were short, which collided, and who is the tightest of the rest.
pub(super) fn in_short(comparison: &Comparison, compared: &Compared, total: &Total) -> String {
    let rivals = || (0..compared.models.len()).filter(|model| *model != NEEDED);
    let (short, enough): (Vec<usize>, Vec<usize>) =
        rivals().partition(|model| total.models[*model].joint.short() > 0);
    let mut text = String::new();
    if short.is_empty() {
        text += "- No model was short at any step.\n";
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
        let _ = writeln!(
            text,
            "- Short at some steps, as a share of those in need (in brackets: had the ego braked by 6 m/s2): {}.",
            listed(&told.collect::<Vec<_>>())
        );
    }
    text += &tightest(compared, total, enough);
    let collided: Vec<usize> = rivals()
        .filter(|model| !trials_with_collisions(compared, *model).is_empty())
        .collect();
    let tried = (0..comparison.scenarios.len())
        .filter(|scenario| {
            compared.closed_loop.trials[*scenario]
                .iter()
                .any(Option::is_some)
        })
        .count();
    if collided.is_empty() {
        let _ = writeln!(
            text,
            "- Run again at what it asked for, no model collides in any of {tried} scenarios."
        );
    } else {
        let names = collided.iter().map(|model| {
            let scenarios = trials_with_collisions(compared, *model);
            let scenarios = scenarios
                .iter()
                .map(|(scenario, _)| comparison.scenarios[*scenario].name.clone());
            format!(
                "`{}` (in {})",
                compared.models[*model],
                listed(&scenarios.collect::<Vec<_>>())
            )
        });
        let _ = writeln!(
            text,
            "- Run again at what it asked for, of {tried} scenarios, some run collides with {}.",
            listed(&names.collect::<Vec<_>>())
        );
    }
    text += &tightest_in_closed_loop(
        compared,
        rivals().filter(|model| !collided.contains(model)).collect(),
    );
    text
}

/// The models with which no run collided, the one that asks for the least first.
fn tightest_in_closed_loop(compared: &Compared, free: Vec<usize>) -> String {
    let above = |model: usize| -> Option<f64> {
        let required = &compared.closed_loop.required;
        let trials = required.iter().zip(&compared.closed_loop.trials);
        let above: Vec<f64> = trials
            .filter_map(|(required, trials)| match required.mrf {
                Mrf::Rate(rate) if rate > 1 => {
                    Some(trials[model].as_ref()?.asked - f64::from(rate))
                }
                _ => None,
            })
            .collect();
        mean(&above)
    };
    let told = by(free, above);
    let told = told.iter().map(|(model, above)| {
        let name = compared.models[*model];
        format!("`{name}` with {above:.2}")
    });
    let told = listed(&told.collect::<Vec<_>>());
    if told.is_empty() {
        String::new()
    } else {
        format!(
            "- Of the others, the tightest first, by the FPR that the largest demand is above the MRF in the mean of the scenarios whose \
             MRF is above 1: {told}.\n"
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
            "- Never short, the tightest first, by the FPR more than needed in the mean of the steps in need: {told}.\n"
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

fn of_model(
    comparison: &Comparison,
    compared: &Compared,
    total: &Total,
    scenes: &[Answered],
    model: usize,
) -> String {
    let (name, tally) = (compared.models[model], &total.models[model]);
    let mut text = format!("**`{name}`** {}.", idea(name));
    let joint = &tally.joint;
    let worst = tally.worst.as_ref().zip(total.worst_in[model]);
    if let Some((worst, scenario)) = worst {
        let (count, of) = short_in(compared, model);
        let _ = write!(
            text,
            " Short at {} of {} steps in need ({} %), in {count} of {of} scenarios, {}; by {:.2} FPR in the mean, and at most {}. {}",
            joint.short(),
            joint.in_need(),
            percent(joint.share_short()),
            smallest(comparison, compared, model),
            joint.mean_shortfall().unwrap_or_default(),
            told(comparison, worst, scenario),
            why(tally)
        );
    } else {
        text += " Never short.";
    }
    let scene = scenes
        .iter()
        .find(|answered| answered.answers[model].fpr() < answered.answers[NEEDED].fpr());
    if let Some(Answered { scene, answers }) = scene {
        let fpr = |model: usize| answers[model].fpr().unwrap_or_default();
        let _ = write!(
            text,
            " The smallest scene in which it is short, {}: {}; it asks for {:.1} FPR, and {:.1} are needed.",
            scene.name,
            scene.what,
            fpr(model),
            fpr(NEEDED)
        );
    }
    for (scenario, rerun) in trials_with_collisions(compared, model) {
        let _ = write!(
            text,
            " In {} it asks for {:.1} FPR at most, and at {} FPR on all cameras {} of {} seeds collide, with each camera at its own {} of {}; \
             the MRF is {}.",
            comparison.scenarios[scenario].name,
            rerun.asked,
            rerun.largest.rates.all()[0],
            rerun.largest.collisions,
            rerun.largest.runs,
            rerun.own.collisions,
            rerun.own.runs,
            compared.closed_loop.required[scenario].mrf
        );
    }
    if let Some(excess) = joint.mean_excess(true) {
        let _ = write!(
            text,
            " Where it asked for enough at a step in need, it asked for {excess:.2} FPR more in the mean (median {:.2}).",
            joint.median_excess(true).unwrap_or_default(),
        );
    }
    text
}

/// What a model goes by, which is what makes it short or strict. Sources and equations: zhuyi-estimator's `rivals`.
fn idea(name: &str) -> &'static str {
    match name {
        "zhuyi" => {
            "knows the future, keeps the margins C1 and C2, and looks no further than the first t_n at which it is behind and slower"
        }
        "zhuyi-jumps" => {
            "is the same with the paper's jumps, which miss some t_n and so ask for more"
        }
        "rss" => {
            "lets the ego speed up while it responds and then brake by 6 m/s2, the actor brake at once as hard, and is content where either axis is"
        }
        "rss-capped" => {
            "is `rss`, but lets an ego above 50 km/h only hold its speed while it responds"
        }
        "sff" => {
            "lets both brake by 6 m/s2 and the actor keep its heading; a lane change that has not begun and a harder braking are outside it"
        }
        "r157-cut-in" => {
            "takes the time to collision at the speeds of the moment less what braking by 6 m/s2 takes; a lead as fast as the ego is none"
        }
        "r157-driver" => {
            "lets the actor go on as it does, and brakes by 0.774 g; a lead that brakes is to it one that keeps its speed"
        }
        "ttc" => {
            "takes 2 s off the time to collision at the speeds of the moment, whatever braking takes; a lead as fast as the ego is none"
        }
        "pylot" => "looks at the ego's speed alone, the same deadline for every actor in view",
        "visibility" => {
            "lets every actor in the lane stand still, brakes by 6 m/s2, and sees nobody who is not in the lane or on the way into it"
        }
        _ => "is a model",
    }
}

/// In how many scenarios a model is short, of how many.
fn short_in(compared: &Compared, model: usize) -> (usize, usize) {
    let short = compared
        .scenarios
        .iter()
        .filter(|audited| audited.models[model].joint.short() > 0);
    (short.count(), compared.scenarios.len())
}

/// The scenario with the fewest actors in which a model is short.
fn smallest(comparison: &Comparison, compared: &Compared, model: usize) -> String {
    let short = comparison
        .scenarios
        .iter()
        .zip(&compared.scenarios)
        .filter(|(_, audited)| audited.models[model].joint.short() > 0);
    let fewest = short.min_by_key(|(scenario, _)| scenario.actors.len());
    fewest.map_or(String::new(), |(scenario, _)| {
        let actors = scenario.actors.len();
        format!(
            "the smallest {} ({actors} {})",
            scenario.name,
            if actors == 1 { "actor" } else { "actors" }
        )
    })
}

fn told(comparison: &Comparison, worst: &Moment, scenario: usize) -> String {
    let Moment {
        seed,
        time,
        camera,
        actor,
        needed,
        asked,
        ego,
        gap,
        aside,
        start,
    } = worst;
    let scenario = &comparison.scenarios[scenario];
    let side = if *aside < 0.0 { "right" } else { "left" };
    format!(
        "{:.2} (in {}, seed {seed}, {:.2} s, {}: asked {:.1}, needed {:.1} for {}, {gap:.1} m ahead and {:.1} m to the {side} at {:.1} m/s \
         and {:+.1} m/s2, the ego at {:.1} m/s and {:+.1} m/s2)",
        worst.shortfall(),
        scenario.name,
        time.seconds(),
        comparison.system.perception.eyes[*camera].camera.name,
        asked.1,
        needed.1,
        scenario.actors[actor.index()].name,
        aside.abs(),
        start.speed,
        start.accel,
        ego.0,
        ego.1
    )
}

/// The causes, the most frequent first.
fn why(tally: &Tally) -> String {
    let causes = &tally.causes;
    let mut all = [
        (causes.brakes, "had the ego braked by 6 m/s2"),
        (causes.future, "had the actors kept their velocity"),
        (causes.both, "had both been so"),
        (causes.other, "not even with both"),
    ];
    all.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    let short = tally.joint.short() as f64;
    let told = all.iter().filter(|(count, _)| *count > 0);
    let told =
        told.map(|(count, what)| format!("at {} % {what}", percent(Some(*count as f64 / short))));
    format!(
        "It would have been enough {}.",
        listed(&told.collect::<Vec<_>>())
    )
}

/// Scenarios in which a run collides at what a model asked for.
fn trials_with_collisions(compared: &Compared, model: usize) -> Vec<(usize, &Rerun)> {
    let trials = compared.closed_loop.trials.iter().enumerate();
    trials
        .filter_map(|(scenario, trials)| Some((scenario, trials[model].as_ref()?)))
        .filter(|(_, rerun)| rerun.largest.collisions + rerun.own.collisions > 0)
        .collect()
}

/// `a, b and c`.
fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}
