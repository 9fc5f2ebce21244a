//! Claim 7: how much work an estimate is.

use super::{Claim, Verdict};
use crate::claims::run::course::Course;
use crate::reproduce::plan::Plan;
use zhuyi_batch::text::{cells, markdown_table};
use zhuyi_estimator::Estimator;

/// Operations of one evaluation, C, as the paper has it.
const OPERATIONS: f64 = 100.0;

/// |A| in the paper's example, with one trajectory each.
const ACTORS: f64 = 2.0;

/// [kilo-operations] the paper's cap for it.
const CAP: f64 = 60.0;

pub(super) fn claim(plan: &Plan, courses: &[Vec<Course>]) -> Claim {
    let estimator = Estimator::new(plan.system.estimator.clone());
    let steps = f64::from(estimator.params().max_steps);
    let latencies = estimator.latencies().len();
    let by_the_letter = ACTORS * steps * latencies as f64 * OPERATIONS / 1e3;
    let most = |courses: &Vec<Course>| courses.iter().map(|course| course.evaluations).max();
    let lines = courses.iter().filter_map(|courses| {
        let first = courses.first()?;
        let rows: usize = courses.iter().map(|course| course.steps.len()).sum();
        Some(vec![
            first.scenario.clone(),
            first.actors.to_string(),
            (rows * first.actors).to_string(),
            most(courses)?.to_string(),
        ])
    });
    let lines: Vec<_> = lines.collect();
    let header = cells(&[
        "scenario",
        "actors",
        "estimates",
        "evaluations, at most, for one actor",
    ]);
    let largest = courses.iter().filter_map(most).max();
    let kilo = |evaluations: u32| ACTORS * f64::from(evaluations) * OPERATIONS / 1e3;
    Claim {
        number: "7",
        title: "2 actors with one trajectory each are at most 60 kilo-operations",
        verdict: largest.map_or(Verdict::FigureOnly, |largest| {
            Verdict::holds_if(kilo(largest) <= CAP)
        }),
        figures: match largest {
            Some(largest) => format!(
                "At most {largest} evaluations for one actor, {:.1} kilo-operations for two at the paper's {OPERATIONS:.0} each",
                kilo(largest)
            ),
            None => "No run to count in".to_string(),
        },
        details: format!(
            "{}\nAn evaluation holds one latency against one piece of a recorded future (solver `exact`; the paper's jumps are not \
             counted, their cap is |A| |T| M L C). With the {latencies} latencies of our grid in place of the paper's L = 30 that cap is \
             {by_the_letter:.0} kilo-operations, {CAP:.0} with 30. The 2 ms are a matter of the machine: measured times and \
             instructions are in bench/estimator.md (`benches/record.sh`).\n",
            markdown_table(&header, &lines)
        ),
    }
}
