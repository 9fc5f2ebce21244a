//! Counts instructions: a bench runs itself under valgrind's callgrind, which counts what happens inside [`measured`] and
//! writes one file per call of it. So what comes before a call is not counted, and the counts repeat to the last digit on
//! any load. Of a single case `callgrind_annotate target/tmp/BENCH/calls.1` tells which lines they come from.
//!
//! What other threads do is not counted.

use std::hint::black_box;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What is counted of a case, got ready uncounted.
pub type Call<'a> = Box<dyn FnMut() + 'a>;

/// What a bench's `main` may fail with.
pub type Failure = Box<dyn std::error::Error>;

/// The argument with which the bench starts itself.
const COUNTED: &str = "--counted";

/// The bench's first argument, a part of the names of the cases that are asked for.
pub fn filter() -> String {
    let mut arguments = env::args().skip(1);
    let filter = arguments.find(|argument| !argument.starts_with('-'));
    filter.unwrap_or_default()
}

/// The instructions of one call of each case of `bench`. None where there is nothing to report: in the bench that has
/// been started for counting, and without valgrind, as the bench then says.
pub fn counts<'a>(
    bench: &str,
    cases: &[impl Fn() -> Call<'a>],
) -> Result<Option<Vec<u64>>, Failure> {
    if env::args().any(|argument| argument == COUNTED) {
        for ready in cases {
            // What happens in the first call alone, such as the linker looking symbols up, is not counted.
            ready()();
            measured(&mut *ready());
        }
        return Ok(None);
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(bench);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let files = folder.join("calls");
    let run = Command::new("valgrind")
        .args(["--tool=callgrind", "--quiet"])
        .args([
            "--toggle-collect=*::callgrind::measured",
            "--dump-after=*::callgrind::measured",
        ])
        .arg(format!("--callgrind-out-file={}", files.display()))
        .arg(env::current_exe()?)
        .args([COUNTED, &filter()])
        .status();
    match run {
        Ok(status) if status.success() => {
            let file = |place: usize| PathBuf::from(format!("{}.{place}", files.display()));
            let all = (1..=cases.len()).map(|place| total(&file(place)));
            all.collect::<Result<_, _>>().map(Some)
        }
        Ok(status) => Err(format!("valgrind ended with {status}").into()),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            eprintln!("no instruction counts: valgrind is not installed");
            Ok(None)
        }
        Err(error) => Err(error.into()),
    }
}

/// What is counted: one call.
#[inline(never)]
fn measured(call: &mut dyn FnMut()) {
    call();
    // Behind it something must follow, or the call becomes a jump and the end is not seen.
    black_box(());
}

/// The count of all instructions in a file of callgrind.
fn total(file: &Path) -> Result<u64, Failure> {
    let text = fs::read_to_string(file)?;
    let line = text.lines().find_map(|line| line.strip_prefix("totals: "));
    let total = line.and_then(|line| line.trim().parse().ok());
    total.ok_or_else(|| format!("callgrind left no total in {}", file.display()).into())
}
