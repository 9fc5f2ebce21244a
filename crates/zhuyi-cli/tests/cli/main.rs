//! The real binary, as a user meets it: arguments in; standard output, standard error, exit code and files out.
//!
//! | file | what it shows |
//! |---|---|
//! | `batches` | `sweep` with `--vary`, killed, interrupted and resumed, in shards; `merge` |
//! | `budgets` | `allocate`: policies under budgets |
//! | `plans` | `sweep plan.ron`: one sweep with the equal flags, broken plans |
//! | `choices` | `map` and `boundary` |
//! | `files` | `list`, `show`, `check`, `new` |
//! | `one_run` | `run`: text, JSON, trace, rates, settings |
//! | `many_runs` | `mrf`, `sweep`, `reproduce`, `robustness`, `compare`, `beyond`, `figures` |
//! | `recordings` | `estimate`: traces of runs and of real traffic, bad rows |
//! | `reports` | `run --report`: the data in the page |
//! | `explanations` | `explain`: stages, changes that save the drive |
//! | `refusals` | bad input: exit code, place, rule, hint |
//! | `scripts` | manoeuvres that began and never did, notes on a run, contacts from behind, starts with jitter |
//! | `schemas` | `schema`: the documents and tables that commands write are what their schemas say |
//! | `places` | where results go: unwritable, full, closed, interrupted |

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.
#![expect(clippy::unwrap_used, reason = "a test may")]

mod batches;
mod budgets;
mod choices;
mod explanations;
mod files;
mod many_runs;
mod one_run;
mod places;
mod plans;
mod recordings;
mod refusals;
mod reports;
mod schemas;
mod scripts;

use std::path::PathBuf;
use std::process::Command;

/// What a command did.
struct Ran {
    code: Option<i32>,
    out: String,
    err: String,
}

/// A folder of its own to run commands in.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    /// Names of all that lies in a folder, sorted.
    fn names(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path(folder)).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_zhuyi"));
        command
            .args(line.split_whitespace())
            .current_dir(self.0.path());
        command
    }

    /// Runs `zhuyi` with words separated by blanks.
    fn zhuyi(&self, line: &str) -> Ran {
        run(&mut self.command(line))
    }

    /// What a command that succeeds prints.
    fn out(&self, line: &str) -> String {
        let ran = self.zhuyi(line);
        assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{line}");
        ran.out
    }
}

fn run(command: &mut Command) -> Ran {
    let output = command.output().unwrap();
    Ran {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}
