//! `allocation.md`, and what the command prints: all figures in it are worked out here from the drives, none is typed.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::drive::HORIZON;
use super::feedback::IN_TABLE;
use super::responses::RESPONSES;
use super::tally::{Tally, paired, safe_from};
use super::{Allocated, Allocating, Budgets, Cell, ZHUYI};
use zhuyi_batch::text::{at_most_two_decimals, cells, counted, decimals, markdown_table};

/// How many budgets of the leaderboard's columns: the smallest ones, where policies differ.
const SHOWN: usize = 6;

/// One policy over all scenarios.
struct Ranked<'a> {
    policy: &'a str,
    cells: &'a [Cell],
    /// At each budget, over all scenarios.
    tallies: Vec<Tally>,
    /// The place of the smallest budget from which on nothing collides.
    safe_from: Option<usize>,
}

impl Ranked<'_> {
    /// [Hz] what it processes where it is safe.
    fn processed(&self) -> f64 {
        self.safe_from
            .map_or(f64::INFINITY, |place| self.tallies[place].processed)
    }
}

/// All policies, who is safe with the least first; among equals who processes less.
fn ranked<'a>(plan: &'a Allocating, allocated: &'a Allocated) -> Vec<Ranked<'a>> {
    let cameras = plan.system.perception.eyes.len();
    let of = |(policy, cells): (&'a String, &'a Vec<Cell>)| {
        let tallies: Vec<Tally> = cells
            .iter()
            .map(|cell| Tally::of(cell.all(), cameras))
            .collect();
        let collisions: Vec<u32> = tallies.iter().map(|tally| tally.collisions).collect();
        Ranked {
            policy,
            cells,
            safe_from: safe_from(&collisions),
            tallies,
        }
    };
    let mut all: Vec<Ranked<'a>> = plan.policies.iter().zip(&allocated.cells).map(of).collect();
    all.sort_by(|a, b| {
        let place = |ranked: &Ranked<'_>| ranked.safe_from.unwrap_or(usize::MAX);
        let by_place = place(a).cmp(&place(b));
        by_place.then(a.processed().total_cmp(&b.processed()))
    });
    all
}

/// `allocation.md`.
pub(super) fn markdown(plan: &Allocating, allocated: &Allocated) -> String {
    let ranked = ranked(plan, allocated);
    let mut sections = vec![
        format!("## In short\n\n{}\n", in_short(plan, &ranked).join("\n")),
        format!(
            "## Leaderboard\n\n{}\n{}",
            leaderboard(plan, &ranked),
            about_the_leaderboard(plan, &ranked)
        ),
        format!(
            "## Smallest budget without a collision, by scenario [{}]\n\n{}",
            plan.unit(),
            by_scenario(plan, &ranked)
        ),
        beside_uniform(plan, &ranked),
        alarms(plan, &ranked),
    ];
    if !allocated.answered.is_empty() {
        sections.push(responses(allocated));
    }
    if !allocated.smallest.is_empty() {
        sections.push(smallest(allocated));
    }
    if let Some(feedback) = &allocated.feedback {
        sections.push(literal(feedback));
    }
    if !allocated.best_static.is_empty() {
        sections.push(statics(plan, allocated));
    }
    format!(
        "# Rates under a budget\n\nWritten by `{}`: {}.\n\n{}",
        plan.command,
        spelt(plan),
        sections.join("\n")
    )
}

/// What the command prints.
pub(super) fn summary(plan: &Allocating, allocated: &Allocated) -> String {
    let ranked = ranked(plan, allocated);
    format!(
        "{}\n\n{}\n{}",
        spelt(plan),
        leaderboard(plan, &ranked),
        in_short(plan, &ranked).join("\n")
    )
}

fn spelt(plan: &Allocating) -> String {
    let drives = plan.scenarios.len() as u64 * plan.seeds;
    let compute = match plan.budgets {
        Budgets::Fps(_) => "a frame takes its period".to_string(),
        Budgets::Tops(_) => format!(
            "frames queue for the accelerator, {} GOP each",
            at_most_two_decimals(plan.chip().gop_per_frame)
        ),
    };
    format!(
        "{}, {}, {} per policy and budget, root seed {}, {compute}",
        counted(plan.scenarios.len() as u64, "scenario"),
        counted(plan.seeds, "seed"),
        counted(drives, "drive"),
        plan.root_seed
    )
}

fn amount(plan: &Allocating, place: Option<usize>) -> String {
    let budgets = plan.budgets();
    if let Some(place) = place {
        return at_most_two_decimals(budgets[place].amount);
    }
    let most = budgets.last().map_or(0.0, |budget| budget.amount);
    format!(">{}", at_most_two_decimals(most))
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

fn in_short(plan: &Allocating, ranked: &[Ranked<'_>]) -> Vec<String> {
    let mut lines = Vec::new();
    let uniform = ranked.iter().find(|ranked| ranked.policy == "uniform");
    let best = ranked.iter().find(|ranked| ZHUYI.contains(&ranked.policy));
    let (Some(uniform), Some(best)) = (uniform, best) else {
        return lines;
    };
    let unit = plan.unit();
    let says = |ranked: &Ranked<'_>| match ranked.safe_from {
        Some(place) => format!(
            "no collision from {} {unit} on ({} frames/s processed, {} % of 30 FPR on all cameras)",
            amount(plan, Some(place)),
            decimals(Some(ranked.tallies[place].processed), 1),
            percent(ranked.tallies[place].share)
        ),
        None => format!("collisions up to the largest budget, {} {unit}", {
            let last = plan.budgets().len() - 1;
            amount(plan, Some(last))
        }),
    };
    lines.push(format!("- `uniform`: {}.", says(uniform)));
    lines.push(format!(
        "- The best policy by the paper's model, `{}`: {}.",
        best.policy,
        says(best)
    ));
    let verdict = match (best.safe_from, uniform.safe_from) {
        (Some(best_place), uniform_place) if uniform_place.is_none_or(|u| best_place < u) => {
            let there = &uniform.tallies[best_place];
            format!(
                "- There `uniform` collides in {} of {} drives. Saved against the smallest safe budget of `uniform`: {} % of \
                 the frames processed.",
                there.collisions,
                there.drives,
                percent(1.0 - best.processed() / uniform.processed())
            )
        }
        _ => "- It is not safe with less than `uniform` is.".to_string(),
    };
    lines.push(verdict);
    for (who, name) in [
        ("The paper's own rule", "proportional"),
        (
            "Fixed rates, found by driving these very drives",
            "best-static",
        ),
        ("Who knows the future", "clairvoyant"),
    ] {
        if let Some(other) = ranked.iter().find(|ranked| ranked.policy == name) {
            lines.push(format!("- {who}, `{name}`: {}.", says(other)));
        }
    }
    let never: Vec<&str> = ranked
        .iter()
        .filter(|ranked| ranked.safe_from.is_none())
        .map(|ranked| ranked.policy)
        .collect();
    if !never.is_empty() {
        lines.push(format!(
            "- Not safe with any budget: `{}`.",
            never.join("`, `")
        ));
    }
    lines
}

fn leaderboard(plan: &Allocating, ranked: &[Ranked<'_>]) -> String {
    let unit = plan.unit();
    let safe = format!("safe from [{unit}]");
    let mut header = cells(&[
        "policy",
        &safe,
        "processed [frames/s]",
        "of 30 FPR [%]",
        "jerk [m/s3]",
        "braking [m/s2]",
    ]);
    let budgets = plan.budgets();
    let shown = budgets.iter().take(SHOWN);
    header.extend(shown.map(|budget| format!("at {}", at_most_two_decimals(budget.amount))));
    header.push("delta-v [m/s]".into());
    let telling = telling(plan, ranked);
    let line = |ranked: &Ranked<'_>| {
        let there = ranked.safe_from.map(|place| &ranked.tallies[place]);
        let of = |figure: fn(&Tally) -> f64, digits| decimals(there.map(figure), digits);
        let mut line = vec![
            ranked.policy.to_string(),
            amount(plan, ranked.safe_from),
            of(|tally| tally.processed, 1),
            of(|tally| 100.0 * tally.share, 1),
            of(|tally| tally.jerk, 2),
            of(|tally| tally.decel, 2),
        ];
        let shown = ranked.tallies.iter().take(SHOWN);
        line.extend(shown.map(|tally| tally.collisions.to_string()));
        let severity = ranked.tallies[telling].delta_v;
        line.push(decimals(severity, 1));
        line
    };
    let lines: Vec<_> = ranked.iter().map(line).collect();
    markdown_table(&header, &lines)
}

fn about_the_leaderboard(plan: &Allocating, ranked: &[Ranked<'_>]) -> String {
    let drives = plan.scenarios.len() as u64 * plan.seeds;
    let telling = amount(plan, Some(telling(plan, ranked)));
    format!(
        "Safe from: the smallest budget at which, and at every larger one, none of {drives} drives collides, which says little \
         about rarer events: no collision in {drives} drives leaves a chance of {} % per drive at 95 %. Processed, jerk (root mean square) and \
         hardest braking: means over the drives at that budget. At ..: drives that collide at that budget [{}]. Delta-v: mean change \
         of the ego's velocity in the collisions at {telling}, where policies differ the most.\n",
        percent(zhuyi_batch::statistics::bound_without_event(drives as u32)),
        plan.unit()
    )
}

fn by_scenario(plan: &Allocating, ranked: &[Ranked<'_>]) -> String {
    let mut header = cells(&["policy"]);
    header.extend(plan.scenarios.iter().map(|scenario| scenario.name.clone()));
    let line = |ranked: &Ranked<'_>| {
        let of = |scenario: usize| {
            let collisions = ranked.cells.iter().map(|cell| {
                let drives = &cell.drives[scenario];
                drives.iter().filter(|d| d.collision.is_some()).count() as u32
            });
            let collisions: Vec<u32> = collisions.collect();
            amount(plan, safe_from(&collisions))
        };
        let scenarios = (0..plan.scenarios.len()).map(of);
        [ranked.policy.to_string()]
            .into_iter()
            .chain(scenarios)
            .collect()
    };
    let lines: Vec<Vec<String>> = ranked.iter().map(line).collect();
    markdown_table(&header, &lines)
}

/// The policies beside `uniform` at the largest budget at which that still collides.
fn beside_uniform(plan: &Allocating, ranked: &[Ranked<'_>]) -> String {
    let Some(uniform) = ranked.iter().find(|ranked| ranked.policy == "uniform") else {
        return String::new();
    };
    let place = uniform.tallies.iter().rposition(|t| t.collisions > 0);
    let place = place.unwrap_or(0);
    let header = cells(&[
        "policy",
        "only this collides",
        "only uniform collides",
        "collisions, difference [% of drives]",
        "frames processed, difference [frames/s]",
    ]);
    let interval = |found: super::tally::Interval, scale: f64| {
        let [value, low, high] = [found.value, found.low, found.high].map(|x| {
            let shown = format!("{:+.1}", scale * x);
            if shown == "-0.0" {
                "+0.0".into()
            } else {
                shown
            }
        });
        format!("{value} ({low} to {high})")
    };
    let others = ranked.iter().filter(|ranked| ranked.policy != "uniform");
    let lines: Vec<_> = others
        .map(|ranked| {
            let pair = paired(&ranked.cells[place], &uniform.cells[place]);
            vec![
                ranked.policy.to_string(),
                pair.only_first.to_string(),
                pair.only_second.to_string(),
                interval(pair.collisions, 100.0),
                interval(pair.frames, 1.0),
            ]
        })
        .collect();
    format!(
        "## Beside `uniform`, drive by drive\n\nAt {} {}, the largest budget at which `uniform` collides (in {} of {} drives). \
         In brackets 95 % intervals for pairs (Newcombe 1998, method 10; mean ± 1.96 standard errors).\n\n{}",
        amount(plan, Some(place)),
        plan.unit(),
        uniform.tallies[place].collisions,
        uniform.tallies[place].drives,
        markdown_table(&header, &lines)
    )
}

/// The place of the budget at which policies differ the most: by how many counts of collisions there are.
fn telling(plan: &Allocating, ranked: &[Ranked<'_>]) -> usize {
    let counts = |place: usize| {
        let counts = ranked.iter().map(|r| r.tallies[place].collisions);
        counts.collect::<BTreeSet<u32>>().len()
    };
    // The smallest of the most telling.
    let places = (0..plan.budgets().len()).rev();
    places.max_by_key(|place| counts(*place)).unwrap_or(0)
}

/// How good the alarms are.
fn alarms(plan: &Allocating, ranked: &[Ranked<'_>]) -> String {
    let place = telling(plan, ranked);
    let header = cells(&[
        "policy",
        "collisions",
        "without an alarm",
        "lead, median [s]",
        "false alarms per drive",
        "alarm stands [% of the time]",
    ]);
    let line = |ranked: &Ranked<'_>| {
        let tally = &ranked.tallies[place];
        vec![
            ranked.policy.to_string(),
            tally.collisions.to_string(),
            tally.missed.to_string(),
            decimals(tally.lead, 1),
            decimals(Some(tally.false_alarms), 2),
            percent(tally.standing),
        ]
    };
    let lines: Vec<_> = ranked.iter().map(line).collect();
    format!(
        "## Alarms\n\nAn alarm is raised while a camera's rate is below its demand by the paper's model. At {} {}, recorded alone. \
         An alarm speaks of a collision that comes while it stands or within {HORIZON} s after; lead is counted from its beginning.\n\n{}",
        amount(plan, Some(place)),
        plan.unit(),
        markdown_table(&header, &lines)
    )
}

fn responses(allocated: &Allocated) -> String {
    let mut header = cells(&["policy", "budget [frames/s]"]);
    header.extend(RESPONSES.map(|(name, _)| name.to_string()));
    let mut lines = Vec::new();
    for answered in &allocated.answered {
        let mut line = vec![
            answered.policy.to_string(),
            at_most_two_decimals(answered.budget),
        ];
        line.extend(answered.tallies.iter().map(|tally| {
            format!(
                "{} ({}; {})",
                tally.collisions,
                decimals(Some(tally.jerk), 1),
                decimals(Some(tally.processed), 1)
            )
        }));
        lines.push(line);
    }
    format!(
        "## Responses to alarms\n\nCollisions, in brackets jerk [m/s3] and frames processed per second. Emergency back-up brakes \
         at C3 while an alarm stands; limited functionality gives the cameras a quarter more, drives 5 m/s slower and keeps half a \
         second more headway; rates raised takes from cameras above their demand for those below it.\n\n{}",
        markdown_table(&header, &lines)
    )
}

fn smallest(allocated: &Allocated) -> String {
    let header = cells(&[
        "policy",
        "budget [frames/s]",
        "collisions",
        "without an alarm",
        "delta-v [m/s]",
        "processed [frames/s]",
    ]);
    let line = |smallest: &super::Smallest| {
        let tally = &smallest.tally;
        vec![
            smallest.policy.to_string(),
            at_most_two_decimals(smallest.budget),
            format!("{} of {}", tally.collisions, tally.drives),
            tally.missed.to_string(),
            decimals(tally.delta_v, 1),
            decimals(Some(tally.processed), 1),
        ]
    };
    let lines: Vec<_> = allocated.smallest.iter().map(line).collect();
    format!(
        "## The smallest drive in which the estimate asks for too little\n\nOne standing car on an empty road, at 70 mph \
         (crates/zhuyi-studies/src/allocate/one-standing-car.ron). Before it is confirmed nobody asks for anything: every camera runs at \
         1 FPR, and K frames take K seconds. No budget mends that; a reserve does, and so does to assume somebody where no camera \
         has cleared the road.\n\n{}",
        markdown_table(&header, &lines)
    )
}

fn literal(feedback: &super::Feedback) -> String {
    let header = cells(&[
        "budget [frames/s]",
        "collisions, l_0 = 1/30 s",
        "collisions, l_0 = 1/rate",
        "alarm stands [%]",
        "alarm stands, l_0 = 1/rate [%]",
    ]);
    let line = |(budget, [fixed, literal]): &(f64, [Tally; 2])| {
        vec![
            at_most_two_decimals(*budget),
            fixed.collisions.to_string(),
            literal.collisions.to_string(),
            percent(fixed.standing),
            percent(literal.standing),
        ]
    };
    let lines: Vec<_> = feedback.collisions.iter().map(line).collect();
    let mut text = format!(
        "## The literal l_0\n\nWith l_0 the latency at which a camera runs now, the demand feeds on itself (reading R22): the slower \
         a camera runs, the less K frames of confirmation seem to cost. `{IN_TABLE}` under both:\n\n{}",
        markdown_table(&header, &lines)
    );
    let mean = |points: &[(f64, f64)]| {
        points.iter().map(|(_, fpr)| fpr).sum::<f64>() / points.len().max(1) as f64
    };
    if let [fixed, literal] = feedback.comparison.lines.as_slice() {
        let both = fixed.points.len().min(literal.points.len());
        let _infallible = writeln!(
            text,
            "\nfigures/allocation-feedback.svg shows it in {}, each camera at its demand: {} is asked for {} FPR in the mean with \
             l_0 = 1/30 s and for {} with l_0 = 1/rate over the same {:.1} s.",
            feedback.comparison.scenario,
            feedback.comparison.camera,
            decimals(Some(mean(&fixed.points[..both])), 2),
            decimals(Some(mean(&literal.points[..both])), 2),
            fixed.points[..both].last().map_or(0.0, |(time, _)| *time)
        );
    }
    text
}

fn statics(plan: &Allocating, allocated: &Allocated) -> String {
    let header = cells(&[
        &format!("budget [{}]", plan.unit()),
        "best static rates",
        "collisions",
        "allocations driven",
    ]);
    let until = allocated.best_static.iter();
    let until = until.take_while(|found| found.collisions > 0).count() + 1;
    let lines: Vec<_> = allocated
        .best_static
        .iter()
        .enumerate()
        .take(until)
        .map(|(place, found)| {
            vec![
                amount(plan, Some(place)),
                found.policy.clone(),
                found.collisions.to_string(),
                found.tried.to_string(),
            ]
        })
        .collect();
    format!(
        "## Best static rates\n\nOne allocation for all scenarios, found by driving them: what hindsight over these very drives can \
         do without an estimate. Up to the first budget without a collision.\n\n{}",
        markdown_table(&header, &lines)
    )
}
