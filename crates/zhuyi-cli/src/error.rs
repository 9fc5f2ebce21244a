//! Why a command did not do what it was asked, and the exit codes.

use std::error::Error as _;
use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;

use zhuyi_batch::BatchError;
use zhuyi_batch::LabError;

use crate::problems::Problems;

/// Why a command did not do what it was asked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// What was asked cannot be meant; nothing has run.
    #[error("{}", .0.render(false))]
    Refused(Problems),
    /// A file could not be written.
    #[error("cannot write `{}`", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file is there that would have to be overwritten.
    #[error("`{}` exists already, and nothing is overwritten", .0.display())]
    Exists(PathBuf),
    /// Standard output could not be written.
    #[error("cannot write to standard output")]
    Print(#[source] io::Error),
    /// The place of the results.
    #[error(transparent)]
    Lab(#[from] LabError),
    /// The folder of a sweep.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// Ctrl-C, with what is done and how to go on.
    #[error("{0}")]
    Interrupted(String),
    /// `--check` found something.
    #[error("{0}")]
    Unmet(String),
    /// The policy made no decision in the middle of a drive.
    #[error("the policy failed")]
    Policy(#[from] zhuyi_sim::DecisionError),
    /// Ctrl-C cannot be caught.
    #[error("cannot listen for Ctrl-C")]
    Signals(#[from] ctrlc::Error),
}

impl Error {
    /// What the process ends with.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Unmet(_) => 1,
            Self::Interrupted(_) => 130,
            Self::Batch(batch) => match batch {
                BatchError::OtherPlan { .. }
                | BatchError::NoPlan { .. }
                | BatchError::NoBlocks { .. }
                | BatchError::Twice { .. } => 2,
                BatchError::Incomplete { .. } => 3,
                BatchError::Files(_) | BatchError::Begun { .. } | BatchError::Damaged { .. } => 4,
            },
            Self::Refused(problems) => problems.exit_code(),
            Self::Write { .. }
            | Self::Exists(_)
            | Self::Print(_)
            | Self::Lab(_)
            | Self::Policy(_)
            | Self::Signals(_) => 4,
        }
    }

    /// Tells standard error. Where even that is closed there is nobody to tell.
    pub fn report(&self) {
        let mut err = io::stderr().lock();
        let text = match self {
            Self::Refused(problems) => {
                problems.render(err.is_terminal() && std::env::var_os("NO_COLOR").is_none())
            }
            _ => format!("error: {}", self.with_causes()),
        };
        let _closed = writeln!(err, "{text}");
    }

    /// The text and behind it each cause that it does not tell already.
    fn with_causes(&self) -> String {
        let mut text = self.to_string();
        let mut cause = self.source();
        while let Some(error) = cause {
            let told = error.to_string();
            if !text.contains(&told) {
                text = format!("{text}: {told}");
            }
            cause = error.source();
        }
        text
    }
}
