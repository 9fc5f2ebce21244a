//! What was wrong with a program, told so that its author finds the place.

use std::fmt;
use std::io;
use std::process::ExitStatus;

use crate::RateLimit;

/// A program that gave no usable answer: which, when, what was wrong, and the line that it wrote, if any.
#[derive(Debug, thiserror::Error)]
#[error("the program `{program}`, asked at {time:.3} s, {fault}{}", Got(line.as_deref()))]
pub struct ProgramError {
    /// The command as given.
    pub program: String,
    /// [s] time of the decision.
    pub time: f64,
    /// What was wrong.
    #[source]
    pub fault: Fault,
    /// The line that it wrote: its first 200 characters, control characters escaped.
    pub line: Option<String>,
}

/// What can be wrong with a program.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The shell could not be started.
    #[error("could not be started")]
    Start(#[source] io::Error),
    /// It hangs.
    #[error("has not answered within {limit} s")]
    Silent {
        /// [s] how long it had.
        limit: f64,
    },
    /// It died, or closed its output.
    #[error("has ended without an answer{}", status.map_or(String::new(), |s| format!(" ({s})")))]
    Ended {
        /// How, where it has ended altogether.
        status: Option<ExitStatus>,
    },
    /// It wrote a line that nobody had asked for.
    #[error("had written a line before it was asked")]
    Unasked,
    /// The line is not what was agreed.
    #[error("did not answer with a line such as {{\"rates_fps\":[10,5]}}")]
    NotAnAnswer(#[source] serde_json::Error),
    /// Too few numbers, or too many.
    #[error("answered with {got} rates for {cameras} cameras")]
    Count {
        /// Numbers in the line.
        got: usize,
        /// Numbers needed.
        cameras: usize,
    },
    /// Its rates break a limit.
    #[error(transparent)]
    Rates(#[from] RateLimit),
    /// It was given up earlier in this run.
    #[error("has failed before in this run and is not asked again")]
    GivenUp,
}

/// The line, where there is one.
struct Got<'a>(Option<&'a str>);

impl fmt::Display for Got<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            None => Ok(()),
            Some(line) => write!(f, "; its line: {line}"),
        }
    }
}

/// A line as an error tells it.
pub(super) fn excerpt(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(line);
    let mut told = String::new();
    for (count, character) in text.trim_end().chars().enumerate() {
        if count == 200 {
            told.push('…');
            break;
        }
        if character.is_control() {
            told.extend(character.escape_default());
        } else {
            told.push(character);
        }
    }
    told
}
