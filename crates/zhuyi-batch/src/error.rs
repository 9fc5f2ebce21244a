//! What can go wrong outside the runs: the place for the results.

use std::io;
use std::path::PathBuf;

/// Reading or writing failed.
#[derive(Debug, thiserror::Error)]
#[error("cannot {attempt} {}", path.display())]
pub struct LabError {
    /// What was attempted.
    pub attempt: Attempt,
    /// On what.
    pub path: PathBuf,
    /// Why it failed.
    pub source: io::Error,
}

/// What may be attempted with the place for the results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attempt {
    /// Make the directory.
    CreateDirectory,
    /// Write a file in full.
    Write,
    /// Give a file that is complete its name.
    Rename,
    /// Read a file.
    Read,
    /// Remove what is not needed any more.
    Remove,
}

impl std::fmt::Display for Attempt {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::CreateDirectory => "create the directory",
            Self::Write => "write",
            Self::Rename => "put in place",
            Self::Read => "read",
            Self::Remove => "remove",
        })
    }
}

impl Attempt {
    /// The error of this attempt on a path, for `map_err`.
    pub fn on(self, path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> LabError {
        let path = path.into();
        move |source| LabError {
            attempt: self,
            path,
            source,
        }
    }
}
