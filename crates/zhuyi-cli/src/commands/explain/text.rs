//! The explanation of a drive as text.

use std::fmt::Write;

use super::changes::Change;
use super::document::{Explanation, Waterfall};
use crate::tables::table;

/// What each stage waited for.
const STAGES: [(&str, &str); 7] = [
    ("exposed", ""),
    ("captured", "the shutter"),
    ("processed", "the frame's latency"),
    ("confirmed", "frames in a row"),
    ("planned", "the planner"),
    ("brake_on", "the brakes"),
    ("contact", "braking"),
];

/// The text.
pub fn describe(explanation: &Explanation) -> String {
    let mut text = format!("{}, seed {}: ", explanation.scenario, explanation.seed);
    let Some(collision) = &explanation.collision else {
        text += "no collision, so there is nothing to explain.\n";
        return text + &closeness(explanation);
    };
    let _infallible = writeln!(
        text,
        "COLLISION at {:.3} s, the ego's {} touched `{}`.",
        collision.time_s, collision.side, collision.actor
    );
    if let Some(told) = &explanation.told {
        let _infallible = writeln!(text, "{told}");
    }
    if let Some(waterfall) = &explanation.waterfall {
        let _infallible = write!(text, "\n{}", stages(waterfall));
    }
    text + &saved(&explanation.changes)
}

fn closeness(explanation: &Explanation) -> String {
    let gap = match explanation.smallest_gap_m {
        Some(gap) => format!("smallest gap {gap:.2} m"),
        None => "nobody was ahead in the ego's way".to_string(),
    };
    let ttc = match explanation.smallest_ttc_s {
        Some(time) => format!("smallest TTC {time:.2} s"),
        None => "never closing in on anyone".to_string(),
    };
    let braking = explanation.hardest_braking_mps2;
    format!("How close it was: {gap}, {ttc}, hardest braking {braking:.2} m/s2.\n")
}

fn stages(waterfall: &Waterfall) -> String {
    let mut rows = table(
        &["stage", "at", "waited for", "took", "cost", "speed"],
        &[1, 3, 4, 5],
    );
    for (stage, (name, wait)) in waterfall.stages.iter().zip(STAGES) {
        let number = |number: Option<f64>, decimals: usize, unit: &str| {
            number.map_or(String::new(), |number| {
                format!("{number:.decimals$} {unit}")
            })
        };
        let reached = stage.time_s.is_some();
        let at = number(stage.time_s, 3, "s");
        rows.add_row([
            name.replace('_', " "),
            if reached { at } else { "never".to_string() },
            wait.to_string(),
            number(stage.took_s, 3, "s"),
            number(stage.took_s.map(|_| stage.metres_m), 2, "m"),
            number(stage.speed_mps, 2, "m/s"),
        ]);
    }
    format!(
        "{}\n{:.2} m in all since it was exposed.\n",
        rows.trim_fmt(),
        waterfall.metres_m
    )
}

fn saved(changes: &[Change]) -> String {
    if changes.is_empty() {
        return "\nNo change was tried: the policy is a program of yours.\n".to_string();
    }
    let mut rows = table(&["change", "from", "to", "by", "drives"], &[1, 2, 3, 4]);
    for change in changes {
        let with_unit = |number: f64| format!("{number} {}", change.unit).trim_end().to_string();
        let mark = if change.best { "*" } else { "" };
        rows.add_row([
            format!("{}{mark}", change.what),
            with_unit(change.from),
            change.to.map_or_else(
                || format!("none up to {}", with_unit(change.limit)),
                with_unit,
            ),
            change
                .relative
                .map_or(String::new(), |by| format!("{:+.0} %", 100.0 * by)),
            change.tried.to_string(),
        ]);
    }
    let mut text = format!(
        "\nWhat would have saved it, one thing changed at a time and driven again:\n\n{}\n",
        rows.trim_fmt()
    );
    let best = changes.iter().find(|change| change.best);
    if let Some(command) = best.and_then(|change| change.command.as_ref()) {
        let _infallible = writeln!(
            text,
            "* the smallest in relation to what it was:\n  {command}"
        );
    } else {
        text += "None of them saved it.\n";
    }
    text
}
