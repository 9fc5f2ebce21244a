//! The same run gives the same bits whatever instructions the processor has.
//!
//! The C library of Linux picks its sine, logarithm and power by processor, with fused multiplication or without, and
//! their last bits differ. Runs take these from the crate `libm`, the same everywhere. One exception is known: the tree
//! of rapier2d's broad phase takes `f32::log2` of its size after a contact, and rounds what it makes of it to a whole
//! number of branches to rebuild. For up to 2000 bodies the number before rounding is 0.12 or more away from a half.

use std::fmt::{self, Write};
use std::process::Command;

use crate::{read, run};
use zhuyi_scenario::embedded;

/// Set in the second process, which prints its hashes and compares nothing.
const SECOND: &str = "ZHUYI_TEST_SECOND_PROCESS";

/// A hash of what is written to it.
struct Hash(blake3::Hasher);

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}

/// A hash of all states, commands and outcomes of the first `count` runs, over all scenarios, rates and seeds.
/// Numbers are written with as many digits as tell them from their neighbours.
fn states(count: usize) -> String {
    let mut hash = Hash(blake3::Hasher::new());
    let scenarios: Vec<_> = embedded::names().map(|name| read(name, &[])).collect();
    for i in 0..count {
        let (scenario, system) = &scenarios[i * 2 % scenarios.len()];
        let run = run(scenario, system, [30, 1, 7, 3][i % 4], i as u64 / 4);
        write!(hash, "{:?}{:?}", run.trace, run.outcome).expect("a hash takes everything");
    }
    hash.0.finalize().to_string()
}

/// A hash of the C library's own functions, to see whether the second process has others.
fn functions_of_the_system() -> String {
    let mut hash = Hash(blake3::Hasher::new());
    for i in 1..10_000 {
        let x = f64::from(i) * 0.001;
        let (sin, cos) = x.sin_cos();
        write!(hash, "{sin}{cos}{}{}{}", x.exp(), x.ln(), x.powf(4.1)).expect("a hash");
    }
    hash.0.finalize().to_string()
}

fn compare(test: &str, count: usize) {
    let here = states(count);
    if std::env::var_os(SECOND).is_some() {
        println!("\nhashes {here} {}", functions_of_the_system());
        return;
    }
    let output = Command::new(std::env::current_exe().expect("this test"))
        .args(["--exact", test, "--include-ignored", "--nocapture"])
        .env(SECOND, "yes")
        .env("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA")
        .output()
        .expect("a second process");
    let text = String::from_utf8_lossy(&output.stdout);
    let (there, system) = text
        .lines()
        .find_map(|line| line.strip_prefix("hashes ")?.split_once(' '))
        .unwrap_or_else(|| panic!("no hashes in {text}"));
    if system == functions_of_the_system() {
        println!("this C library has one variant for both processes: nothing is shown");
    }
    assert_eq!(here, there);
}

#[test]
fn law_five_runs_are_the_same_without_fused_multiplication() {
    compare(
        "processors::law_five_runs_are_the_same_without_fused_multiplication",
        5,
    );
}

#[test]
#[ignore = "400 runs in two processes"]
fn law_two_hundred_runs_are_the_same_without_fused_multiplication() {
    compare(
        "processors::law_two_hundred_runs_are_the_same_without_fused_multiplication",
        200,
    );
}
