//! The soak: random valid scenarios, driven. None may panic, give a number that is none, put a box into a box without a contact, or
//! go on for ever. A thousand in `cargo test`, and a million in
//!
//! ```sh
//! cargo test --release --test soak -- --ignored --nocapture
//! ```
//!
//! `ZHUYI_SOAK_COUNT` sets another number of cases, `ZHUYI_SOAK_FROM` the first of them, `ZHUYI_SOAK_THREADS` how many are driven at a
//! time. A case is named by its number alone: `ZHUYI_SOAK_FROM=4711 ZHUYI_SOAK_COUNT=1` drives case 4711 again, and a case that
//! fails is told with its file and the command that drives it.
//!
//! | file | what |
//! |---|---|
//! | `draw` | numbers from what is usual, now and then from all that is allowed |
//! | `scenario`, `system` | a text as a user might write it: roads, actors of every behaviour with scripts; settings of the system |
//! | `case` | the two read by the reader that reads files; what it refuses is drawn again, and counted. Eight cases share a system |
//! | `verdict` | what must hold of every drive |
//! | `soak` | many cases, and a watch over those that do not end |

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

mod case;
mod draw;
mod scenario;
mod soak;
mod system;
mod verdict;

use std::env;
use std::num::NonZero;
use std::thread::available_parallelism;

use case::{Case, Ego};
use soak::Soak;

#[test]
fn law_a_thousand_random_scenarios_hold() {
    let soaked = Soak {
        first: 0,
        count: 1_000,
        threads: 2,
    }
    .run();
    soaked.check();
    assert!(soaked.collided > 20 && soaked.collided < soaked.driven / 2);
}

#[test]
fn law_a_case_repeats_to_the_last_bit() {
    for number in 0..20 {
        let ego = Ego::of(number);
        let (case, scenario, _) = Case::of(number, &ego);
        let run = || verdict::run(&case, &scenario, &ego.system).expect("no program is asked");
        let (one, two) = (run(), run());
        assert_eq!(one.trace, two.trace, "case {number}");
        assert_eq!(one.decisions, two.decisions, "case {number}");
    }
}

#[test]
#[ignore = "an hour: cargo test --release --test soak -- --ignored --nocapture"]
fn law_a_million_random_scenarios_hold() {
    let set = |name: &str, usual: u64| match env::var(name) {
        Ok(typed) => typed.parse().expect("a whole number"),
        Err(_) => usual,
    };
    let threads = available_parallelism().map_or(1, NonZero::get) as u64;
    let soaked = Soak {
        first: set("ZHUYI_SOAK_FROM", 0),
        count: set("ZHUYI_SOAK_COUNT", 1_000_000),
        threads: set("ZHUYI_SOAK_THREADS", threads),
    }
    .run();
    println!("{soaked}");
    soaked.check();
}
