//! Instructions and evaluations of the estimator, case by case (see [`cases`]), as CSV: `cargo bench --bench
//! instructions`, or `.. -- slower` for the cases with that in their name.
//!
//! The bench runs itself under valgrind's callgrind, which counts what happens inside [`measured`] and writes one file
//! per call of it; so building a case is not counted, and the counts repeat to the last digit on any load. Of a single
//! case `callgrind_annotate target/tmp/instructions/calls.1` tells which lines they come from. Without valgrind there is
//! nothing to count and the bench says so.
//!
//! The paper counts |A| |T| M L evaluations: M = 10 jumps for each of L = 30 latencies, for every trajectory of every
//! actor, at some 100 operations each. The other count is that of
//! [`Estimator::evaluations`](zhuyi_estimator::Estimator::evaluations).

mod cases;

use std::hint::black_box;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use cases::Case;

/// M L of the paper.
const PAPER_EVALUATIONS: u32 = 10 * 30;

/// The argument with which the bench starts itself.
const COUNTED: &str = "--counted";

/// What a bench's `main` may fail with.
type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let filter = env::args()
        .skip(1)
        .find(|argument| !argument.starts_with('-'));
    let filter = filter.unwrap_or_default();
    if env::args().any(|argument| argument == COUNTED) {
        for (_, case) in cases_with(&filter) {
            // What happens in the first call alone, such as the linker looking symbols up, is not counted.
            (case.ask)();
            measured(&case.ask);
        }
        return Ok(());
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("instructions");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let files = folder.join("calls");
    let run = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet"])
        .args([
            "--toggle-collect=instructions::measured",
            "--dump-after=instructions::measured",
        ])
        .arg(format!("--callgrind-out-file={}", files.display()))
        .arg(env::current_exe()?)
        .args([COUNTED, &filter])
        .status();
    match run {
        Ok(status) if status.success() => report(&files, &filter),
        Ok(status) => Err(format!("valgrind ended with {status}").into()),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            eprintln!("no instruction counts: valgrind is not installed");
            Ok(())
        }
        Err(error) => Err(error.into()),
    }
}

/// What is counted: one call.
#[inline(never)]
fn measured(ask: &dyn Fn()) {
    ask();
    // Behind it something must follow, or the call becomes a jump and the end is not seen.
    black_box(());
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
fn report(files: &Path, filter: &str) -> Result<(), Failure> {
    println!("case,trajectories,instructions,evaluations,paper_evaluations");
    for (place, (list, case)) in cases_with(filter).into_iter().enumerate() {
        let file = PathBuf::from(format!("{}.{}", files.display(), place + 1));
        let instructions = fs::read_to_string(&file)
            .ok()
            .and_then(|text| total(&text))
            .ok_or_else(|| format!("callgrind left no total in {}", file.display()))?;
        let evaluations = case
            .evaluations
            .map(|count| count.to_string())
            .unwrap_or_default();
        let paper = if list == "other_models" {
            String::new()
        } else {
            (case.trajectories * PAPER_EVALUATIONS).to_string()
        };
        println!(
            "{list}/{},{},{instructions},{evaluations},{paper}",
            case.name, case.trajectories
        );
    }
    Ok(())
}

/// The count of all instructions in a file of callgrind.
fn total(file: &str) -> Option<u64> {
    let line = file
        .lines()
        .find_map(|line| line.strip_prefix("totals: "))?;
    line.trim().parse().ok()
}
