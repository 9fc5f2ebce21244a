//! What the figures show, in words: which model asked for too little, where and why.

use std::fmt::Write as _;

use super::audit::{Moment, Tally};
use super::ideas::idea;
use super::in_short::{in_short, trials_with_collisions};
use super::models::NEEDED;
use super::page::percent;
use super::scenes::Answered;
use super::table::Total;
use super::{Compared, Comparison};
use zhuyi_batch::text::{at_most_two_decimals, counted, listed};

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

fn of_model(
    comparison: &Comparison,
    compared: &Compared,
    total: &Total,
    scenes: &[Answered],
    model: usize,
) -> String {
    let (name, tally) = (compared.models[model], &total.models[model]);
    let mut text = format!("**`{name}`** {}.", idea(name, &compared.assumptions.rivals));
    let joint = &tally.joint;
    let worst = tally.worst.as_ref().zip(total.worst_in[model]);
    if let Some((worst, scenario)) = worst {
        let (count, of) = short_in(compared, model);
        let _ = write!(
            text,
            " Short at {} of {} in need ({} %), in {count} of {}, {}; by {:.2} FPR in the mean, and at most {}. {}",
            joint.short(),
            counted(joint.in_need(), "step"),
            percent(joint.share_short()),
            counted(of, "scenario"),
            smallest(comparison, compared, model),
            joint.mean_shortfall().unwrap_or_default(),
            told(comparison, worst, scenario),
            why(tally, compared.assumptions.harder_decel)
        );
    } else {
        text += " Never short in these runs.";
    }
    let scene = scenes.iter().find(|answered| answered.is_short(model));
    if let Some(answered @ Answered { scene, .. }) = scene {
        let fpr = |model: usize| answered.fpr(model).unwrap_or_default();
        let opening = if worst.is_some() {
            "The smallest scene in which it is short"
        } else {
            "It can be: the smallest scene in which it is"
        };
        let _ = write!(
            text,
            " {opening}, {}: {}; it asks for {:.1} FPR, and {:.1} are needed.",
            scene.name,
            scene.what,
            fpr(model),
            fpr(NEEDED)
        );
    }
    for (scenario, rerun) in trials_with_collisions(compared, model) {
        let _ = write!(
            text,
            " In {} it asks for {:.1} FPR at most, and at {} FPR on all cameras it collides in {} of {}, with each camera at its own in {} of {}; \
             the MRF is {}.",
            comparison.scenarios[scenario].name,
            rerun.asked,
            rerun.largest.rates.all()[0],
            rerun.largest.collisions,
            counted(rerun.largest.runs, "seed"),
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

/// In how many scenarios a model is short, of how many.
fn short_in(compared: &Compared, model: usize) -> (u64, u64) {
    let short = compared
        .scenarios
        .iter()
        .filter(|audited| audited.models[model].joint.short() > 0);
    (short.count() as u64, compared.scenarios.len() as u64)
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
        let actors = scenario.actors.len() as u64;
        format!(
            "the smallest {} ({})",
            scenario.name,
            counted(actors, "actor")
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
fn why(tally: &Tally, harder_decel: f64) -> String {
    let causes = &tally.causes;
    let brakes = format!(
        "had the ego braked by {} m/s2",
        at_most_two_decimals(harder_decel)
    );
    let mut all = [
        (causes.brakes, brakes.as_str()),
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
