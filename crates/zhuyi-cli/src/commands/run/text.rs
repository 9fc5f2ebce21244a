//! The summary of a drive as text.

use std::fmt::Write;
use std::path::Path;

use super::summary::{Alarms, AtRest, Collision, Summary};
use crate::tables::table;

/// The text, with drawings, the files that were written, commands to go on with and what they are for.
pub fn describe(
    summary: &Summary,
    drawings: &str,
    written: &[&Path],
    next: &[(String, &str)],
) -> String {
    let mut text = format!(
        "{}, seed {}: {}\n\n",
        summary.scenario, summary.seed, summary.title
    );
    text += &outcome(summary);
    text += &closeness(summary);
    text += &manoeuvres(summary);
    text.push('\n');
    text += &notes(summary);
    text += &cameras(summary);
    text += &remarks(summary);
    text.push('\n');
    text += drawings;
    if !written.is_empty() {
        let names: Vec<String> = written
            .iter()
            .map(|path| path.display().to_string())
            .collect();
        let _infallible = writeln!(text, "\nWrote {}", names.join(", "));
    }
    text += "\nNext:\n";
    let width = next.iter().map(|(line, _)| line.chars().count()).max();
    for (line, purpose) in next {
        let _infallible = writeln!(
            text,
            "  {line:width$}   {purpose}",
            width = width.unwrap_or(0)
        );
    }
    text
}

fn outcome(summary: &Summary) -> String {
    match &summary.collision {
        None => format!("No collision in {} s.\n", summary.end_s),
        Some(collision) => contact(collision),
    }
}

fn contact(
    Collision {
        time_s,
        actor,
        side,
        struck_from_behind,
        actor_confirmed: _,
        crash,
    }: &Collision,
) -> String {
    let mut text = format!("COLLISION at {time_s:.3} s: the ego's {side} touched `{actor}`.\n");
    if *struck_from_behind {
        text += "Struck from behind: the actor closed in on the ego's rear half, which no frame rate prevents.\n";
    }
    let Some(crash) = crash else {
        return text + "The crash could not be worked out.\n";
    };
    let _infallible = writeln!(
        text,
        "  impact speed       {:.2} m/s",
        crash.impact_speed_mps
    );
    for (who, rest) in [("ego", &crash.ego), (actor.as_str(), &crash.other)] {
        let _infallible = writeln!(
            text,
            "  {who:18} delta-v {:.2} m/s, {}",
            rest.delta_v_mps,
            resting(rest)
        );
    }
    if !crash.further.is_empty() {
        let _infallible = writeln!(text, "  also drawn in      {}", crash.further.join(", "));
    }
    text
}

fn resting(rest: &AtRest) -> String {
    let ends = match rest.after_s {
        Some(after) => format!("rests after {after:.1} s"),
        None => "still moves after 10 s".to_string(),
    };
    // Adding zero turns a rounded -0.0 into 0.0.
    let left = (10.0 * rest.d_m).round() / 10.0 + 0.0;
    format!(
        "{ends}, {:.1} m further, at s {:.1} m, d {left:.1} m",
        rest.distance_m, rest.s_m
    )
}

fn closeness(summary: &Summary) -> String {
    let mut text = String::new();
    let mut say = |what: &str, value: String| {
        let _infallible = writeln!(text, "  {what:18} {value}");
    };
    let nobody = "nobody was ahead in the ego's way";
    let never = "never closing in on anyone in the ego's way";
    say(
        "smallest gap",
        summary
            .smallest_gap_m
            .map_or(nobody.into(), |gap| format!("{gap:.2} m")),
    );
    say(
        "smallest TTC",
        summary
            .smallest_ttc_s
            .map_or(never.into(), |time| format!("{time:.2} s")),
    );
    let braking = format!("{:.2} m/s2", summary.hardest_braking_mps2);
    say(
        "hardest braking",
        match summary.hard_braking_from_s {
            Some(from) => format!("{braking}, braking hard from {from:.2} s"),
            None => braking,
        },
    );
    if let Some(from) = summary.evading_from_s {
        say(
            "evasion",
            format!("the ego leaves its lane from {from:.2} s on"),
        );
    }
    text
}

/// When the manoeuvres of the actors began and ended.
fn manoeuvres(summary: &Summary) -> String {
    let mut text = String::new();
    for one in &summary.manoeuvres {
        let when = match (one.began_s, one.ended_s) {
            (None, _) => "never began".to_string(),
            (Some(began), None) => format!("from {began:.2} s, not ended"),
            (Some(began), Some(ended)) if one.replaced => {
                format!("{began:.2} to {ended:.2} s, replaced")
            }
            (Some(began), Some(ended)) => format!("{began:.2} to {ended:.2} s"),
        };
        let name = format!("{}.{}", one.actor, one.place);
        let _infallible = writeln!(text, "  {name:18} {:11} {when}", one.action);
    }
    text
}

/// What no figure tells.
fn notes(summary: &Summary) -> String {
    let mut text = String::new();
    for note in &summary.notes {
        let _infallible = writeln!(text, "Note: {}.", note.text);
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

fn cameras(summary: &Summary) -> String {
    let header = [
        "camera",
        "ran at",
        "highest demand",
        "at",
        "for",
        "frames",
        "of 30 FPR",
    ];
    let mut cameras = table(&header, &[1, 2, 3, 5, 6]);
    for camera in &summary.cameras {
        let mark = if camera.analysed { "*" } else { "" };
        let asked = camera.demand_actor.as_deref();
        cameras.add_row([
            format!("{}{mark}", camera.name),
            // Whole rates as they were typed, the means of a policy rounded.
            format!("{} FPR", (100.0 * camera.rate_fpr).round() / 100.0),
            format!("{:.2} FPR", camera.demand_fpr),
            camera
                .demand_time_s
                .map_or(String::new(), |time| format!("{time:.2} s")),
            asked.unwrap_or("nobody").to_string(),
            camera.frames_processed.to_string(),
            percent(camera.share_of_30_fpr),
        ]);
    }
    cameras.add_row([
        "all".to_string(),
        String::new(),
        String::new(),
        String::new(),
        String::new(),
        summary.frames_processed.to_string(),
        percent(summary.share_of_30_fpr),
    ]);
    cameras.trim_fmt() + "\n"
}

/// What the safety check found.
fn alarm(alarms: &Alarms) -> String {
    let Alarms {
        checks_with_alarm,
        checks,
        first_s,
    } = alarms;
    match first_s {
        None => format!("Safety check: no camera below its demand at any of {checks} decisions."),
        Some(first) => format!(
            "Safety check: a camera below its demand at {checks_with_alarm} of {checks} decisions, \
             first at {first:.2} s."
        ),
    }
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

fn remarks(summary: &Summary) -> String {
    let estimate = &summary.estimate;
    let mut text = format!(
        "* analysed: at most {:.2} FPR for one of them, {:.2} FPR for all at one time",
        estimate.largest_fpr, estimate.largest_sum_fpr
    );
    text += if estimate.until_contact {
        ", estimated up to the contact.\n"
    } else {
        ".\n"
    };
    if let Some(alarms) = &summary.alarms {
        let _infallible = writeln!(text, "{}", alarm(alarms));
    }
    let remarks = [
        (
            estimate.unavoidable,
            "At some time even braking at once came too late; that counts as 30 FPR.",
        ),
        (
            estimate.beyond_grid,
            "At some time more than 30 FPR were asked for; that counts as 30.",
        ),
        (
            estimate.alongside,
            "At some time someone alongside came into the ego's way, where no rate helps; left out.",
        ),
        (
            estimate.standing,
            "At some time the ego stood in someone's way, where no rate helps; left out.",
        ),
    ];
    for (_, remark) in remarks.iter().filter(|(applies, _)| *applies) {
        text += remark;
        text.push('\n');
    }
    text
}
