//! Wall time of the estimator, case by case (see [`cases`]). `cargo bench --bench estimator -- one_actor`.
//!
//! On a machine with other work the fastest time is the one to quote. `cargo bench --bench instructions` counts
//! instructions, `benches/record.sh` writes both to results/bench/.

#[expect(dead_code, reason = "counts are for the bench `instructions`")]
mod cases;

use cases::Case;
use divan::Bencher;

fn main() {
    divan::main();
}

fn names(cases: &[Case]) -> Vec<&'static str> {
    cases.iter().map(|case| case.name).collect()
}

fn time(bencher: Bencher<'_, '_>, cases: &[Case], name: &str) {
    let case = cases.iter().find(|case| case.name == name);
    bencher.bench_local(&case.expect("a case of this list").ask);
}

#[divan::bench(args = names(&cases::one_actor()))]
fn one_actor(bencher: Bencher<'_, '_>, name: &str) {
    time(bencher, &cases::one_actor(), name);
}

#[divan::bench(args = names(&cases::many()))]
fn many(bencher: Bencher<'_, '_>, name: &str) {
    time(bencher, &cases::many(), name);
}

#[divan::bench(args = names(&cases::whole_run()), sample_count = 20)]
fn whole_run(bencher: Bencher<'_, '_>, name: &str) {
    time(bencher, &cases::whole_run(), name);
}

#[divan::bench(args = names(&cases::other_models()))]
fn other_models(bencher: Bencher<'_, '_>, name: &str) {
    time(bencher, &cases::other_models(), name);
}
