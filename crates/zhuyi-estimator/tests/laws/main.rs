//! The laws of the estimator, each put to random cases: 2,000 in `cargo test`, and a million in
//!
//! ```sh
//! cargo test --release -p zhuyi-estimator --test laws -- --ignored --nocapture
//! ```
//!
//! | file | what it shows |
//! |---|---|
//! | `fast` | the crate's solvers, also on recordings, against a plain one that tries everything |
//! | `soundness` | an ego that follows the procedure does not touch, by an independent replay; how the two criteria differ |
//! | `monotone` | gap, speeds, K, C1, C2, C3, l_0: more room, time or brakes never hurt, and where this is no law |
//! | `invariance` | shift, rotation, mirror, another time, finer resampling |
//! | `aggregation` | percentile and mean between worst and best |
//! | `model_failures` | holes below a tolerable latency, and the cautious variant |
//! | `case` | how cases are drawn; `law`: what a law and a tie are; `plain` with `objection`, and `replay`: the two references |
//!
//! | law | its domain |
//! |---|---|
//! | the crate's answer, from a list or a recording, is the plain solver's | all, both solvers, both criteria |
//! | sound: no contact up to t_n, under `standstill` in the whole horizon | all, both solvers |
//! | more gap (at all times), a faster actor (at all times from t_0 on), a slower ego (a_0 held), a lower a_0: no less tolerated | solver `exact`, and no stay of the actor in the corridor is dropped (reading R8) in the harder case |
//! | fewer frames to confirm, a larger l_0 | solver `exact`, a_b >= the ego's own braking (C4 >= 1) |
//! | larger C1, C2, C3 | solver `exact` |
//! | `standstill` tolerates no more than `paper` with C1 = C2 = 1 | the ego stands within the horizon, and the actor is then outside the corridor or overlaps sideways |
//! | shift, mirror, another time, pieces cut, samples between samples: the same answer | all, both solvers |
//! | the world turned, moved, mirrored: the same demands per camera | all |
//! | percentile and mean between worst and best | all futures that are not `alongside` |
//! | `cautious`: every smaller latency is tolerable too | the ego does not stand (reading R8b); both solvers, any C4 |
//!
//! Outside these domains failures are counted.
//!
//! What the million cases gave stands in `src/laws.md`, which is part of the crate's documentation.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

mod aggregation;
mod case;
mod fast;
mod invariance;
mod law;
mod model_failures;
mod monotone;
mod objection;
mod plain;
mod replay;
mod soundness;
#[path = "../dense_scan/ways.rs"]
mod ways;

use law::{Law, Table};

/// A law on as many cases as bare `cargo test` has time for.
fn few(laws: &[&Law]) {
    Table::of(laws, 2_000).check();
}

#[test]
#[ignore = "minutes: cargo test --release -p zhuyi-estimator --test laws -- --ignored --nocapture"]
fn law_all_on_a_million_cases() {
    let laws = [
        fast::LAWS,
        soundness::LAWS,
        monotone::LAWS,
        invariance::LAWS,
        aggregation::LAWS,
        model_failures::LAWS,
    ]
    .concat();
    let table = Table::of(&laws, 1_000_000);
    println!("{table}");
    table.check();
}
