//! `mrf_per_camera.md`, and what the command prints.

use std::fmt::Write as _;

use super::in_short::{in_short, percent_less, spelt};
use super::{BruteForce, Found, PerCamera, Searched};
use zhuyi_batch::mrf::told;
use zhuyi_batch::rates::group;
use zhuyi_batch::statistics::bound_without_event;
use zhuyi_batch::text::{cells, counted, listed, markdown_table, spans};

/// What is looked for.
const ABOUT: &str = "\
Each of these cameras has a rate of its own. A combination of rates is safe when it and all in which no camera is slower are free of \
collisions, with every seed. Looked for are the slowest safe ones: those that are no longer safe with any camera at its next lower \
rate. Together they are the Pareto frontier of the rates.
";

/// `mrf_per_camera.md`.
pub(super) fn markdown(plan: &PerCamera, found: &Found) -> String {
    let mut sections = vec![
        format!("## What came out\n\n{}", in_short(plan, found)),
        format!(
            "## How slow each camera may be\n\n{}\n{}",
            frontiers(plan, found),
            about_frontiers(plan, found)
        ),
        format!(
            "## What it took\n\n{}\n{}",
            runs(plan, found),
            about_runs(plan)
        ),
    ];
    if let Some(all) = &found.brute_force {
        sections.push(format!(
            "## Every combination of {}\n\n{}",
            plan.scenarios[all.scenario].name,
            every_combination(plan, all)
        ));
    }
    format!(
        "# A minimum required rate for each camera\n\nWritten by `{}`: {}.\n\n{ABOUT}\n{}",
        plan.command,
        settings(plan),
        sections.join("\n")
    )
}

/// What the command prints.
pub(super) fn summary(plan: &PerCamera, found: &Found) -> String {
    format!(
        "{}\n\n{}\n{}\n{}",
        settings(plan),
        frontiers(plan, found),
        runs(plan, found),
        in_short(plan, found)
    )
}

/// `rates 1 to 30 FPR on each of front_120, left and right (front_60 goes with front_120, rear keeps 30), ..`.
fn settings(plan: &PerCamera) -> String {
    let eyes = &plan.system.perception.eyes;
    let name = |place: usize| eyes[place].camera.name.as_str();
    let of_others = |place: usize| {
        let leading = plan
            .cameras()
            .find(|leading| group(name(*leading)) == group(name(place)));
        match leading {
            Some(leading) => format!("{} goes with {}", name(place), name(leading)),
            None => format!(
                "{} keeps {} and is not counted",
                name(place),
                plan.system.default_rates.all()[place]
            ),
        }
    };
    let others = (0..eyes.len()).filter(|place| !eyes[*place].camera.analysed);
    let others: Vec<String> = others.map(of_others).collect();
    let others = if others.is_empty() {
        String::new()
    } else {
        format!(" ({})", others.join(", "))
    };
    let names: Vec<String> = plan.names().into_iter().map(String::from).collect();
    format!(
        "rates {} FPR on each of {}{others}, {}, root seed {}",
        spans(plan.combinations.tested()),
        listed(&names),
        counted(plan.seeds, "seed"),
        plan.root_seed
    )
}

/// One line per combination of a frontier, the cheapest first in bold where there are several.
fn frontiers(plan: &PerCamera, found: &Found) -> String {
    let all = &plan.combinations;
    let mut header = cells(&["scenario", "MRF"]);
    header.extend(plan.names().into_iter().map(String::from));
    let highest = all.sum(all.count() - 1);
    header.extend([
        "sum".to_string(),
        format!("of {highest}"),
        format!("MRF x {}", all.cameras()),
        "less [%]".to_string(),
    ]);
    let mut lines = Vec::new();
    for (scenario, one) in plan.scenarios.iter().zip(&found.scenarios) {
        let same = one.mrf.safe_from().map(|rate| rate * all.cameras() as u32);
        let begun = || vec![scenario.name.clone(), one.mrf.to_string()];
        if one.frontier.is_empty() {
            let mut line = begun();
            line.resize(header.len(), String::new());
            lines.push(line);
        }
        for combination in &one.frontier {
            let sum = all.sum(*combination);
            let cheapest = one.frontier.len() > 1 && one.cheapest == Some(*combination);
            let bold = |text: String| {
                if cheapest {
                    format!("**{text}**")
                } else {
                    text
                }
            };
            let mut line = begun();
            line.extend(all.rates(*combination).iter().map(u32::to_string));
            line.push(bold(sum.to_string()));
            line.push(format!("{:.3}", f64::from(sum) / f64::from(highest)));
            line.push(same.map_or(String::new(), |same| same.to_string()));
            line.push(same.map_or(String::new(), |same| percent_less(sum, same)));
            lines.push(line);
        }
    }
    markdown_table(&header, &lines)
}

fn about_frontiers(plan: &PerCamera, found: &Found) -> String {
    let tested = plan.combinations.tested();
    let mut text = format!(
        "Each line has a slowest safe combination, in FPR; bold, where a scenario has several: the cheapest. Sum: of these cameras; beside \
         it, as a share of what they take at {} FPR. Then what the same rate on all of them takes, the MRF, and by how much the sum is \
         less. That none of {} collided leaves a chance of a collision below {:.0} % (with 95 % confidence), not of zero; and what a \
         camera needs is told of these scenarios alone.\n",
        tested[tested.len() - 1],
        counted(plan.seeds, "seed"),
        100.0 * bound_without_event(plan.seeds as u32)
    );
    let first = found.scenarios.iter().enumerate();
    let mut first = first.filter_map(|(scenario, one)| Some((scenario, one.cheapest?)));
    if let Some((scenario, combination)) = first.next() {
        let cell = plan.cell(scenario, combination, 0);
        let replay = plan.typed.replay(&plan.experiment(), &cell);
        let _ = writeln!(text, "\nOne of the runs again: `{replay}`.");
    }
    text
}

fn runs(plan: &PerCamera, found: &Found) -> String {
    let header = cells(&[
        "scenario",
        "same rate on all",
        "settled",
        "checked",
        "combinations",
        "runs",
        "every one, up to",
        "checked that collide",
        "free but not safe",
    ]);
    let most = plan.combinations.count() as u64 * plan.seeds;
    let line = |(scenario, one): (&zhuyi_scenario::Scenario, &Searched)| {
        let effort = one.effort();
        let figures = [
            one.uniform.runs,
            one.settled.runs,
            one.checked.runs,
            effort.combinations,
            effort.runs,
            most,
            one.violations,
            one.free_but_not_safe.len() as u64,
        ];
        let mut line = vec![scenario.name.clone()];
        line.extend(figures.iter().map(u64::to_string));
        line
    };
    let lines: Vec<_> = plan
        .scenarios
        .iter()
        .zip(&found.scenarios)
        .map(line)
        .collect();
    markdown_table(&header, &lines)
}

fn about_runs(plan: &PerCamera) -> String {
    let all = &plan.combinations;
    format!(
        "In runs, but for combinations and the last two columns. Same rate on all: from the highest down to the first that collides, \
         which gives the MRF. Settled: what may be a slowest safe combination is tried; where it collides, each camera is raised as far \
         as the collision goes, and that rules out all in which no camera is faster. This is proof. What is not ruled out is taken to \
         be free of collisions, as a higher rate should not harm. Checked: that it does not, next to the combinations found, along each \
         camera, and at places spread over all. Every one: {} combinations of {}, of which those that collide take fewer. Free but not \
         safe: tried and free of collisions, although one in which no camera is slower collides.\n\n\
         The paper (related work) says that the grid search of Suraksha \"could easily become infeasible in multi-camera setting\". Every \
         combination is just that, as each further camera makes it {} times as much.\n",
        all.count(),
        counted(plan.seeds, "run"),
        all.tested().len()
    )
}

fn every_combination(plan: &PerCamera, all: &BruteForce) -> String {
    let combinations = &plan.combinations;
    let names = plan.names();
    let per_rate = combinations.count() / combinations.tested().len();
    let rows: Vec<Vec<String>> = names
        .iter()
        .enumerate()
        .map(|(camera, name)| {
            let (ended, begun) = all.steps(combinations, camera);
            vec![
                (*name).to_string(),
                ended.to_string(),
                begun.to_string(),
                told(&all.collisions_by_rate(combinations, camera)),
            ]
        })
        .collect();
    let header = cells(&["camera", "ended", "begun", "combinations that collide"]);
    let mut text = format!(
        "{}\nEnded: how many combinations collide and do not with this camera at its next higher rate, the others as they are; begun: \
         the other way round. Last: how many collide with this camera at a rate, of {per_rate} each.\n",
        markdown_table(&header, &rows)
    );
    let odd = all.free_but_not_safe();
    if !odd.is_empty() {
        let shown = odd.iter().take(SHOWN).map(|one| spelt(plan, *one));
        let mut shown: Vec<String> = shown.collect();
        if odd.len() > SHOWN {
            shown.push("the rest in the .csv".to_string());
        }
        let _ = writeln!(
            text,
            "\nFree of collisions, although a combination in which no camera is slower collides: {} ({}).",
            odd.len(),
            listed(&shown)
        );
    }
    text
}

/// How many odd combinations the page names.
const SHOWN: usize = 20;
