//! How the table's MRFs move with what was chosen, and with the seeds.
//!
//! One thing is changed at a time, and the MRFs found anew by the full scan of rates with the same seeds; then nothing is
//! changed but the seeds. Runs end at their first collision and are put to no estimator. Left out: changes of two things at
//! once. An actor that starts at the planner's steady gap starts there under another headway, too: it has time to settle.

mod lead;
mod variations;

use std::fmt::Write as _;
use std::ops::Range;

use zhuyi_core::FrameRates;

use crate::reproduce::paper;
use crate::reproduce::plan::Plan;
use variations::{Variation, variations};
use zhuyi_batch::mrf::{Mrf, Required, required};
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::uniform;
use zhuyi_batch::results::Results;
use zhuyi_batch::statistics::wilson_interval;
use zhuyi_batch::sweep::{Experiment, grid};
use zhuyi_batch::text::{cells, markdown_table};

/// How many blocks of fresh seeds are run.
const BLOCKS: u64 = 20;

/// The first fresh seed: far from those over which the scenarios were searched. A block is spent once it was looked at; spent are
/// 1000 to 1199, before turned boxes, and 2000 to 2199, before the distances were searched anew.
const FRESH_FROM: u64 = 3_000;

/// One line of a table: what was changed, and the MRF of each scenario.
struct Line {
    changed: String,
    by: String,
    required: Vec<Required>,
}

/// Runs the plan's variations and makes the file `robustness.md`.
///
/// # Panics
/// If the plan has no rate, a rate of 0, rates out of order or no seed.
pub fn robustness(plan: &Plan, progress: &dyn Progress) -> Results {
    plan.assert_complete();
    let variations = variations(plan);
    let sweeps = variations.len() as u64 + BLOCKS;
    progress.start(
        "variations and fresh seeds",
        sweeps * plan.cells().len() as u64,
    );
    let varied: Vec<Line> = variations
        .iter()
        .map(|variation| varied(plan, variation, progress))
        .collect();
    let fresh: Vec<Line> = (1..=BLOCKS)
        .map(|block| fresh(plan, block, progress))
        .collect();
    let mut text = markdown(plan, &varied, &fresh);
    if let Some(table) = lead::braking_lead(plan, progress) {
        let _ = write!(
            text,
            "\n## Vehicle following over the lead's braking\n\n{table}\n\
             The paper gives no braking of the lead. Estimate: mean over the seeds at the highest rate. Sum: the largest over the \
             analysed cameras at one step of any run at a rate from the MRF on; fraction: of 90. The scenario's own value was not \
             chosen for its sum, whose clamp at one camera would be 32.\n"
        );
    }
    Results {
        files: vec![("robustness.md", text)],
        claims: Vec::new(),
        summary: blocks_as_published(plan, &fresh),
    }
}

fn varied(plan: &Plan, variation: &Variation, progress: &dyn Progress) -> Line {
    let Variation {
        changed,
        by,
        scenarios,
        system,
    } = variation;
    let experiment = Experiment {
        scenarios,
        system,
        root_seed: plan.root_seed,
    };
    let required = scan(&experiment, &plan.rates, 0..plan.seeds, progress);
    Line {
        changed: (*changed).to_string(),
        by: by.clone(),
        required,
    }
}

fn fresh(plan: &Plan, block: u64, progress: &dyn Progress) -> Line {
    let first = FRESH_FROM + (block - 1) * plan.seeds;
    let seeds = first..first + plan.seeds;
    let by = format!("{} to {}", seeds.start, seeds.end - 1);
    Line {
        changed: "seeds".to_string(),
        by,
        required: scan(&plan.experiment(), &plan.rates, seeds, progress),
    }
}

/// The MRF of each scenario by the full scan of rates.
pub(crate) fn scan(
    experiment: &Experiment<'_>,
    rates: &[u32],
    seeds: Range<u64>,
    progress: &dyn Progress,
) -> Vec<Required> {
    let per_rate = seeds.clone().count();
    let all: Vec<FrameRates> = rates
        .iter()
        .map(|rate| uniform(experiment.system, *rate))
        .collect();
    let cells = grid(experiment.scenarios.len(), &all, seeds);
    let records = experiment.run(&cells, |_| &[], || progress.step());
    let per_scenario = records.chunks(rates.len() * per_rate);
    let of_scenario = |records: &[zhuyi_batch::sweep::Record]| {
        let collisions = records
            .chunks(per_rate)
            .map(|runs| runs.iter().filter(|run| run.collision.is_some()).count() as u32);
        required(&rates.iter().copied().zip(collisions).collect::<Vec<_>>())
    };
    per_scenario.map(of_scenario).collect()
}

/// The paper's MRF of each scenario of a plan that it has.
fn published(plan: &Plan) -> Vec<Option<Mrf>> {
    let of_scenario = |scenario: &zhuyi_scenario::Scenario| {
        paper::Row::of(&scenario.name).map(|row| Mrf::Rate(row.mrf))
    };
    plan.scenarios.iter().map(of_scenario).collect()
}

/// How many of a line's MRFs are the paper's, and of how many.
fn as_published(line: &Line, published: &[Option<Mrf>]) -> (usize, usize) {
    let pairs = || {
        line.required
            .iter()
            .zip(published)
            .filter_map(|(ours, paper)| Some((ours.mrf, (*paper)?)))
    };
    (
        pairs().filter(|(ours, paper)| ours == paper).count(),
        pairs().count(),
    )
}

fn markdown(plan: &Plan, varied: &[Line], fresh: &[Line]) -> String {
    let table = |lines: &[Line]| table(plan, lines);
    format!(
        "# How the minimum required rates move\n\n\
         Written by `zhuyi robustness`: {}.\n\n\
         ## One change at a time\n\n{}\n\
         Bold: not the paper's MRF. †: some rate below the MRF has no collision either. Distances: every gap, distance and time to \
         collision that a manoeuvre waits for, and every gap ahead at the start.\n\n\
         ## Nothing changed but the seeds\n\n{}\n{}\n",
        plan.spelt(),
        table(varied),
        table(fresh),
        blocks_as_published(plan, fresh)
    )
}

fn table(plan: &Plan, lines: &[Line]) -> String {
    let published = published(plan);
    let mut header = cells(&["changed", "by"]);
    header.extend(plan.scenarios.iter().map(|scenario| scenario.name.clone()));
    header.push("as published".to_string());
    let mut paper = cells(&["the paper's", ""]);
    paper.extend(
        published
            .iter()
            .map(|mrf| mrf.map_or(String::new(), |mrf| mrf.to_string())),
    );
    paper.push(String::new());
    let line = |line: &Line| {
        let mut row = vec![line.changed.clone(), line.by.clone()];
        row.extend(line.required.iter().zip(&published).map(|(ours, paper)| {
            let dagger = if ours.safe_below.is_empty() {
                ""
            } else {
                "†"
            };
            match paper {
                Some(paper) if *paper != ours.mrf => format!("**{}**{dagger}", ours.mrf),
                _ => format!("{}{dagger}", ours.mrf),
            }
        }));
        let (same, of) = as_published(line, &published);
        row.push(format!("{same} of {of}"));
        row
    };
    let rows: Vec<_> = std::iter::once(paper)
        .chain(lines.iter().map(line))
        .collect();
    markdown_table(&header, &rows)
}

/// One sentence on the fresh blocks, and one on each scenario whose MRF moved.
fn blocks_as_published(plan: &Plan, fresh: &[Line]) -> String {
    let published = published(plan);
    let all = |line: &&Line| {
        let (same, of) = as_published(line, &published);
        same == of
    };
    let count = fresh.iter().filter(all).count();
    let (low, high) = wilson_interval(count as u32, fresh.len() as u32);
    let mut text = format!(
        "{count} of {} blocks of {} fresh seeds give every MRF as published (95 % Wilson interval of the share: {low:.2} to {high:.2}).",
        fresh.len(),
        plan.seeds
    );
    for (place, scenario) in plan.scenarios.iter().enumerate() {
        let Some(paper) = published[place] else {
            continue;
        };
        let mut found: Vec<Mrf> = fresh.iter().map(|line| line.required[place].mrf).collect();
        found.sort_unstable();
        if found.iter().any(|mrf| *mrf != paper) {
            let counts = found
                .chunk_by(|a, b| a == b)
                .map(|same| format!("{} in {}", same[0], same.len()));
            let _ = write!(
                text,
                " {}: {}.",
                scenario.name,
                counts.collect::<Vec<_>>().join(", ")
            );
        }
    }
    text
}
