//! The `zhuyi` command: arguments as typed -> as meant -> run -> write.
//!
//! Results go to standard output, progress and diagnostics to standard error. Exit codes: 0 done, 1 an asserted expectation
//! failed (`--check`), 2 bad input, 3 incomplete sweep, 4 reading or writing failed, 130 interrupted. A collision is a result, not a failure.
//!
//! ```text
//!  argv ─[clap]─▶ Arguments ─[meant]─▶ Task ─[run]─▶ Answer ─[print]─▶ exit code
//!                                │ Problems: all that is wrong with what was asked, before anything runs
//! ```

mod answer;
mod argument;
mod commands;
mod error;
mod fault;
mod inputs;
mod interrupt;
mod output;
mod problems;
mod progress;
mod ranges;
mod rates;
mod shell;
mod sparkline;
mod tables;
mod top_view;
mod vary;

use std::process::ExitCode;

use clap::Parser;

use answer::Answer;
use commands::{Arguments, Task};

fn main() -> ExitCode {
    let typed = Arguments::parse();
    let done = typed
        .command
        .meant()
        .and_then(Task::run)
        .and_then(Answer::print);
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            error.report();
            ExitCode::from(error.exit_code())
        }
    }
}
