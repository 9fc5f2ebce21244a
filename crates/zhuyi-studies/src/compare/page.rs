//! `compare.md`, and what the command prints: all figures in it are worked out here from the runs, none is typed.

use std::fmt::Write as _;

use super::audit::Audited;
use super::findings;
use super::in_short::in_short;
use super::scenes::{self, Answered};
use super::table::Total;
use super::{Compared, Comparison};
use crate::reruns::Rerun;
use zhuyi_batch::text::{at_most_two_decimals, cells, counted, decimals, markdown_table};

/// `compare.md`.
pub(super) fn markdown(comparison: &Comparison, compared: &Compared) -> String {
    let total = Total::new(compared);
    let scenes = scenes::answered(&comparison.system);
    let sections = [
        findings::markdown(comparison, compared, &total, &scenes),
        format!(
            "## Asked for against needed, step by step\n\n{}\n{}\n\
             Short at these shares [%] of the steps in need, by scenario:\n\n{}\n\
             Why it was short [% of those steps]:\n\n{}\n{}",
            audit(compared, &total),
            about_the_audit(comparison, compared, &total),
            by_scenario(comparison, compared),
            causes(compared, &total),
            about_causes(compared)
        ),
        format!(
            "## Asked for against required, in closed loop\n\n{}\n{}",
            closed_loop(comparison, compared),
            about_the_closed_loop(comparison)
        ),
        format!(
            "## The smallest scenes\n\n{}\n{}",
            of_scenes(compared, &scenes),
            ABOUT_SCENES
        ),
        format!("## Demand over time\n\n{}", over_time(comparison, compared)),
    ];
    format!(
        "# All models on the same runs\n\nWritten by `{}`: {}.\n\n{}",
        comparison.command,
        spelt(comparison),
        sections.join("\n")
    )
}

/// What the command prints.
pub(super) fn summary(comparison: &Comparison, compared: &Compared) -> String {
    let total = Total::new(compared);
    format!(
        "{}\n\nAsked for against needed, step by step\n\n{}\nLargest demand [FPR], and collisions when run again at it\n\n{}\n{}",
        spelt(comparison),
        audit(compared, &total),
        closed_loop(comparison, compared),
        in_short(comparison, compared, &total)
    )
}

fn spelt(comparison: &Comparison) -> String {
    format!(
        "{} FPR, {}, root seed {}, models asked every {} ms",
        comparison.fpr,
        counted(comparison.seeds, "seed"),
        comparison.root_seed,
        comparison.every_ms()
    )
}

pub(super) fn percent(share: Option<f64>) -> String {
    decimals(share.map(|share| 100.0 * share), 1)
}

/// [m/s2] the brakes that most rivals count on, spelt.
fn harder_decel(compared: &Compared) -> String {
    at_most_two_decimals(compared.assumptions.harder_decel)
}

fn audit(compared: &Compared, total: &Total) -> String {
    let harder = format!("at {} m/s2 [%]", harder_decel(compared));
    let header = cells(&[
        "model",
        "short [%]",
        &harder,
        "by, mean [FPR]",
        "at most [FPR]",
        "latency over [s]",
        "more, mean [FPR]",
        "median [FPR]",
        "asked for, mean [FPR]",
        "at 30 [%]",
    ]);
    let line = |(name, tally): (&&str, &super::audit::Tally)| {
        let joint = &tally.joint;
        vec![
            (*name).to_string(),
            percent(joint.share_short()),
            percent(tally.share_short_with_harder_brakes()),
            decimals(joint.mean_shortfall(), 2),
            decimals(joint.largest_shortfall(), 2),
            decimals(joint.longest_over(), 3),
            decimals(joint.mean_excess(true), 2),
            decimals(joint.median_excess(true), 2),
            decimals(joint.mean_asked(), 2),
            percent(joint.share_at_most()),
        ]
    };
    let lines: Vec<_> = compared
        .models
        .iter()
        .zip(&total.models)
        .map(line)
        .collect();
    markdown_table(&header, &lines)
}

fn about_the_audit(comparison: &Comparison, compared: &Compared, total: &Total) -> String {
    let joint = total.models.first().map(|tally| &tally.joint);
    let (steps, in_need) = joint.map_or((0, 0), |joint| (joint.steps(), joint.in_need()));
    let horizon = at_most_two_decimals(compared.assumptions.horizon);
    let harder = harder_decel(compared);
    let apart = &total.apart;
    let apart = if apart.total() == 0 {
        "None counts apart".to_string()
    } else {
        format!(
            "Apart count those at which braking at once comes too late ({}), that need more than 30 FPR ({}), with an actor alongside ({}) and with an ego that stands ({})",
            apart.unavoidable, apart.beyond_grid, apart.alongside, apart.standing
        )
    };
    let left_out: Vec<String> = (compared.models.iter().zip(&total.models))
        .filter(|(_, tally)| tally.not_defined > 0)
        .map(|(name, tally)| format!("`{name}` {}", tally.not_defined))
        .collect();
    let left_out = if left_out.is_empty() {
        String::new()
    } else {
        format!(
            " Not judged are the steps of a model at which who needs most is an actor that its source does not speak of (not defined): {}.",
            left_out.join(", ")
        )
    };
    let peaks = if comparison.every == 1 {
        String::new()
    } else {
        " Peaks are sharp: what lies between two questions is missed, so largest demands can be too small here.".to_string()
    };
    format!(
        "All scenarios and runs together. A step is a camera's. Judged, of the analysed cameras: {steps}; in need of more than the \
         least rate, of these: {in_need}. {apart}.{left_out} Needed is the answer of `zhuyi-standstill`: the largest latency with which an \
         ego that holds a_0 for t_r and then brakes at a_b touches nobody in {horizon} s of the recorded future. It has no margins, so to be \
         short is to touch, should this step's answer be the last. Short: less than needed was asked for, as a share of the steps in \
         need; what is left of that had the ego braked by {harder} m/s2, as most rivals count on, where a_b is less; by how much, and by \
         how much the latency was too long at most. More: by how much more was asked for at steps in need where it was enough. The last two columns: all steps judged.\n\nTo be short is no collision yet: a model that looks at the actor \
         as it is now may ask for more as soon as that begins to move, and this ego brakes before it must. Whether that comes in \
         time is what the closed loop tells.{peaks}\n"
    )
}

fn by_scenario(comparison: &Comparison, compared: &Compared) -> String {
    let header = with_models(&["scenario", "steps in need"], compared);
    let line = |(place, audited): (usize, &Audited)| {
        let in_need = audited
            .models
            .first()
            .map_or(0, |tally| tally.joint.in_need());
        let mut line = vec![
            comparison.scenarios[place].name.clone(),
            in_need.to_string(),
        ];
        line.extend(
            audited
                .models
                .iter()
                .map(|tally| match tally.joint.short() {
                    0 => ".".to_string(),
                    _ => percent(tally.joint.share_short()),
                }),
        );
        line
    };
    let lines: Vec<_> = compared.scenarios.iter().enumerate().map(line).collect();
    markdown_table(&header, &lines)
}

fn causes(compared: &Compared, total: &Total) -> String {
    let header = cells(&["model", "steps short", "brakes", "future", "both", "other"]);
    let line = |(name, tally): (&&str, &super::audit::Tally)| {
        let (causes, short) = (&tally.causes, tally.joint.short());
        let part = |count: u64| percent(Some(count as f64 / short as f64));
        let mut line = vec![(*name).to_string(), short.to_string()];
        line.extend([causes.brakes, causes.future, causes.both, causes.other].map(part));
        line
    };
    let short = compared
        .models
        .iter()
        .zip(&total.models)
        .filter(|(_, tally)| tally.joint.short() > 0);
    markdown_table(&header, &short.map(line).collect::<Vec<_>>())
}

fn about_causes(compared: &Compared) -> String {
    format!(
        "What was asked for would have been enough, brakes: had the ego braked by {} m/s2, as most rivals count on, not by a_b; \
         future: had the actors gone on from this step with the velocity they had; both: had both been so; other: not even then. The \
         first that holds counts.\n",
        harder_decel(compared)
    )
}

fn closed_loop(comparison: &Comparison, compared: &Compared) -> String {
    let header = with_models(&["scenario", "MRF"], compared);
    let line = |(place, trials): (usize, &Vec<Option<Rerun>>)| {
        let mut line = vec![
            comparison.scenarios[place].name.clone(),
            compared.closed_loop.required[place].mrf.to_string(),
        ];
        let trial = |trial: &Option<Rerun>| match trial {
            None => "N/A".to_string(),
            Some(rerun) => {
                let asked = format!("{:.1}", rerun.asked);
                let asked = if compared.closed_loop.is_below(place, rerun.asked) {
                    format!("**{asked}**")
                } else {
                    asked
                };
                match (rerun.largest.collisions, rerun.own.collisions) {
                    (0, 0) => asked,
                    (largest, own) => format!("{asked} ({largest}, {own})"),
                }
            }
        };
        line.extend(trials.iter().map(trial));
        line
    };
    let trials = compared.closed_loop.trials.iter().enumerate();
    markdown_table(&header, &trials.map(line).collect::<Vec<_>>())
}

fn about_the_closed_loop(comparison: &Comparison) -> String {
    format!(
        "The largest demand [FPR] of each model, any analysed camera and step of any run at {} FPR; bold where, rounded up to a whole rate as \
         it is run again, it is below the MRF, the smallest rate from 1 to 30 FPR at which, and at every higher one, no seed collides; \
         N/A where a run collided. In brackets, where there are any, collisions in {} when the scenario is run again, with all cameras \
         at that demand and with each camera at its own, both rounded up. At an MRF of 1 no model can fail.\n",
        comparison.fpr,
        counted(comparison.seeds, "seed")
    )
}

fn of_scenes(compared: &Compared, scenes: &[Answered]) -> String {
    let header = with_models(&["scene", "in figures"], compared);
    let line = |answered: &Answered| {
        let mut line = cells(&[answered.scene.name, answered.scene.what]);
        line.extend((0..answered.answers.len()).map(|model| {
            let asked = decimals(answered.fpr(model), 1);
            if answered.answers[model].is_none() {
                "not defined".to_string()
            } else if answered.is_short(model) {
                format!("**{asked}**")
            } else {
                asked
            }
        }));
        line
    };
    markdown_table(&header, &scenes.iter().map(line).collect::<Vec<_>>())
}

const ABOUT_SCENES: &str = "\
What each model asks for [FPR] in scenes of the ego, one actor and no run, at l_0 = 1/30 s; bold where it is less than \
`zhuyi-standstill` says is needed. Bodies are 4 m by 2 m, lanes 3.5 m; distances are from bumper to bumper.
";

fn over_time(comparison: &Comparison, compared: &Compared) -> String {
    let mut text = String::from(
        "Seed 0: the largest demand [FPR] on any analysed camera within each second, sampled every 0.1 s; seconds like the one before \
         are left out. compare_demand.csv has all cameras and samples.\n",
    );
    for (scenario, audited) in comparison.scenarios.iter().zip(&compared.scenarios) {
        let header = with_models(&["second"], compared);
        let mut lines: Vec<Vec<String>> = Vec::new();
        for (second, demands) in audited
            .curve
            .by_second(compared.models.len())
            .iter()
            .enumerate()
        {
            let demands: Vec<String> = demands.iter().map(|fpr| format!("{fpr:.1}")).collect();
            if lines.last().is_none_or(|last| last[1..] != demands) {
                let mut line = vec![second.to_string()];
                line.extend(demands);
                lines.push(line);
            }
        }
        let _ = write!(
            text,
            "\n### {}\n\n{}",
            scenario.name,
            markdown_table(&header, &lines)
        );
    }
    text
}

fn with_models(first: &[&str], compared: &Compared) -> Vec<String> {
    let mut header = cells(first);
    header.extend(compared.models.iter().map(ToString::to_string));
    header
}
