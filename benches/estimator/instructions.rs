//! Instructions and evaluations of the estimator, case by case (see [`cases`]), as CSV: `cargo bench --bench
//! instructions`, or `.. -- slower` for the cases with that in their name. How they are counted: [`callgrind`].
//!
//! The paper counts |A| |T| M L evaluations: M = 10 jumps for each of L = 30 latencies, for every trajectory of every
//! actor, at some 100 operations each. The other count is that of
//! [`Estimator::evaluations`](zhuyi_estimator::Estimator::evaluations).

#[path = "../callgrind.rs"]
mod callgrind;
mod cases;

use callgrind::{Call, Failure};
use cases::Case;

/// M L of the paper.
const PAPER_EVALUATIONS: u32 = 10 * 30;

fn main() -> Result<(), Failure> {
    let cases = cases_with(&callgrind::filter());
    let asks: Vec<&dyn Fn()> = cases.iter().map(|(_, case)| &*case.ask).collect();
    let ready: Vec<_> = asks
        .iter()
        .map(|ask| move || Box::new(ask) as Call<'_>)
        .collect();
    if let Some(counts) = callgrind::counts("instructions", &ready)? {
        report(&cases, &counts);
    }
    Ok(())
}

/// The cases with `filter` in their names `list/case`, each with its list.
fn cases_with(filter: &str) -> Vec<(&'static str, Case)> {
    [
        ("one_actor", cases::one_actor()),
        ("many", cases::many()),
        ("whole_run", cases::whole_run()),
        ("other_models", cases::other_models()),
    ]
    .into_iter()
    .flat_map(|(list, cases)| cases.into_iter().map(move |case| (list, case)))
    .filter(|(list, case)| format!("{list}/{}", case.name).contains(filter))
    .collect()
}

#[expect(clippy::print_stdout, reason = "the table is the result")]
fn report(cases: &[(&str, Case)], counts: &[u64]) {
    println!("case,trajectories,instructions,evaluations,paper_evaluations");
    for ((list, case), instructions) in cases.iter().zip(counts) {
        let evaluations = case
            .evaluations
            .map(|count| count.to_string())
            .unwrap_or_default();
        let paper = if *list == "other_models" {
            String::new()
        } else {
            (case.trajectories * PAPER_EVALUATIONS).to_string()
        };
        println!(
            "{list}/{},{},{instructions},{evaluations},{paper}",
            case.name, case.trajectories
        );
    }
}
