//! What a command leaves behind: files as text, made in full before any of them is written.
//!
//! Writing goes in two steps, so that an interrupted command leaves no half-written file: every file under a temporary name
//! in the same directory, flushed to the disk; then each is given its name. Left out: a lock against a second writer.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::claim::Claim;
use crate::error::{Attempt, LabError};

/// The files of a command and what it says.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// Names and texts; a name may begin with a folder in that of the results.
    pub files: Vec<(&'static str, String)>,
    /// The claims that were examined; none where the command examines none.
    pub claims: Vec<Claim>,
    /// What the command prints.
    pub summary: String,
}

/// A file that is not as it would be written now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Difference {
    /// It is not there.
    Missing {
        /// Its name.
        file: &'static str,
    },
    /// Its first line that differs.
    Line {
        /// Its name.
        file: &'static str,
        /// The line, from 1.
        line: usize,
        /// What would be written; none where the text would have ended.
        expected: Option<String>,
        /// What is there; none where the file has ended.
        found: Option<String>,
    },
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing { file } => write!(f, "{file}: missing"),
            Self::Line {
                file,
                line,
                expected,
                found,
            } => {
                let shown = |text: &Option<String>| match text {
                    Some(text) => format!("`{}`", text.escape_debug()),
                    None => "the end of the file".to_string(),
                };
                let (found, expected) = (shown(found), shown(expected));
                write!(f, "{file}:{line}: found {found}, expected {expected}")
            }
        }
    }
}

/// Makes the directory if it is missing and proves that files can be written there, before a long run.
///
/// # Errors
/// When they cannot.
pub fn prepare(dir: &Path) -> Result<(), LabError> {
    fs::create_dir_all(dir).map_err(Attempt::CreateDirectory.on(dir))?;
    Draft::write(dir, "writable", "").map(drop)
}

impl Results {
    /// Writes every file: first all under temporary names, then all under their own.
    ///
    /// # Errors
    /// When one cannot be written: then none has changed. When one cannot be renamed: then those before it are new, the others
    /// old, and none is half-written.
    pub fn write(&self, dir: &Path) -> Result<(), LabError> {
        let draft = |(name, text): &(&str, String)| Draft::write(dir, name, text);
        let drafts = self
            .files
            .iter()
            .map(draft)
            .collect::<Result<Vec<_>, _>>()?;
        for (draft, (name, _)) in drafts.into_iter().zip(&self.files) {
            draft.rename(&dir.join(name))?;
        }
        Ok(())
    }

    /// Compares every file, byte for byte, with the one in a directory: an entry for each that is missing or differs.
    ///
    /// # Errors
    /// When one is there and cannot be read.
    pub fn check(&self, dir: &Path) -> Result<Vec<Difference>, LabError> {
        let mut differences = Vec::new();
        for (file, text) in &self.files {
            let path = dir.join(file);
            match fs::read(&path) {
                Ok(found) => differences.extend(first_difference(file, text, &found)),
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    differences.push(Difference::Missing { file });
                }
                Err(error) => return Err(Attempt::Read.on(path)(error)),
            }
        }
        Ok(differences)
    }
}

fn first_difference(file: &'static str, expected: &str, found: &[u8]) -> Option<Difference> {
    if expected.as_bytes() == found {
        return None;
    }
    // With their line ends, so that a missing one or a carriage return is a difference too.
    let mut expected = expected.as_bytes().split_inclusive(|byte| *byte == b'\n');
    let mut found = found.split_inclusive(|byte| *byte == b'\n');
    let text = |line: Option<&[u8]>| line.map(|line| String::from_utf8_lossy(line).into_owned());
    for line in 1.. {
        let pair = (expected.next(), found.next());
        if pair.0 != pair.1 {
            let (expected, found) = (text(pair.0), text(pair.1));
            return Some(Difference::Line {
                file,
                line,
                expected,
                found,
            });
        }
    }
    None
}

/// A file that does not have its name yet; gone when dropped.
pub struct Draft(PathBuf);

impl Draft {
    /// A complete one.
    pub(crate) fn write(dir: &Path, name: &str, text: &str) -> Result<Self, LabError> {
        let (draft, mut file) = Self::begin(dir, name)?;
        let written = file
            .write_all(text.as_bytes())
            .and_then(|()| file.sync_all());
        written.map_err(Attempt::Write.on(&draft.0))?;
        Ok(draft)
    }

    /// One to be written to piece by piece, and flushed to the disk before it is given its name.
    pub(crate) fn begin(dir: &Path, name: &str) -> Result<(Self, File), LabError> {
        let path = dir.join(name);
        let (parent, file) = (path.parent().unwrap_or(dir), path.file_name());
        // A folder of its own, never that of the results: where that has vanished something is wrong.
        if parent != dir && !parent.is_dir() {
            fs::create_dir(parent).map_err(Attempt::CreateDirectory.on(parent))?;
        }
        let file = file.unwrap_or_default().to_string_lossy();
        let draft = Self(parent.join(format!(".{file}.{}.draft", std::process::id())));
        let file = File::create(&draft.0).map_err(Attempt::Write.on(&draft.0))?;
        Ok((draft, file))
    }

    /// Where it stands.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Gives it its name.
    pub(crate) fn rename(self, path: &Path) -> Result<(), LabError> {
        fs::rename(&self.0, path).map_err(Attempt::Rename.on(path))
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // Not there any more once renamed; and where it cannot be removed there is nothing better to do.
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests;
