//! Wall time of the simulator, case by case (see [`cases`]). `cargo bench --bench drive`, or `.. -- run`.
//!
//! On a machine with other work the fastest time is the one to quote. `cargo bench --bench drive_instructions` counts
//! instructions, `benches/record.sh` writes both to results/bench/. One call of the estimator is timed and counted by the
//! benches `estimator` and `instructions`.

#[expect(dead_code, reason = "steps are for the bench `drive_instructions`")]
mod cases;

use divan::Bencher;

fn main() {
    divan::main();
}

fn names() -> Vec<&'static str> {
    cases::all().iter().map(|case| case.name).collect()
}

#[divan::bench(args = names(), sample_count = 50)]
fn drive(bencher: Bencher<'_, '_>, name: &str) {
    let cases = cases::all();
    let case = cases.iter().find(|case| case.name == name);
    let ready = &case.expect("a case of this list").ready;
    bencher.with_inputs(ready).bench_local_refs(|call| call());
}
