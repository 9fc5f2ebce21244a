//! Files that a command leaves behind: tried before the long run, written whole or not at all behind it.
//!
//! A file is made beside its place under another name and then renamed. What exists and is no ordinary file, as `/dev/full` or
//! a pipe, is written to as it is.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::interrupt;
use crate::problems::{Problem, Problems};

/// A place that a file will be written to.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    way: Way,
}

#[derive(Debug)]
enum Way {
    /// Made beside this place, links followed, and renamed to it.
    Replace(PathBuf),
    /// Written into what is there already.
    Into(File),
}

impl Output {
    /// Proves that a file can be written here; what stands here stays as it is.
    pub fn reserve(path: &Path, problems: &mut Problems) -> Option<Self> {
        let refused = |source| Problem::Write {
            path: path.to_path_buf(),
            source,
        };
        match Way::to(path) {
            Ok(way) => Some(Self {
                path: path.to_path_buf(),
                way,
            }),
            Err(source) => {
                problems.push(refused(source));
                None
            }
        }
    }

    /// Where.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file.
    pub fn write(self, bytes: &[u8]) -> Result<(), Error> {
        Self::write_all([(self, bytes)])
    }

    /// Writes several files: first all of them beside their places, so that what fails or is interrupted leaves all as
    /// they were, then each to its own.
    pub fn write_all<const N: usize>(files: [(Self, &[u8]); N]) -> Result<(), Error> {
        let _whole = interrupt::writing();
        let mut drafts = Vec::with_capacity(N);
        for (output, bytes) in files {
            match output.draft(bytes) {
                Ok(draft) => drafts.extend(draft),
                Err(error) => {
                    drafts.into_iter().for_each(Draft::discard);
                    return Err(error);
                }
            }
        }
        let mut drafts = drafts.into_iter();
        let published = drafts.by_ref().try_for_each(Draft::publish);
        drafts.for_each(Draft::discard);
        published
    }

    /// The file beside its place, if it is made there.
    fn draft(self, bytes: &[u8]) -> Result<Option<Draft>, Error> {
        let made = match self.way {
            Way::Into(mut file) => file
                .write_all(bytes)
                .and_then(|()| file.flush())
                .map(|()| None),
            Way::Replace(place) => beside(&place).and_then(|beside| {
                let draft = Draft {
                    path: self.path.clone(),
                    beside,
                    place,
                };
                match draft.fill(bytes) {
                    Ok(()) => Ok(Some(draft)),
                    Err(error) => {
                        draft.discard();
                        Err(error)
                    }
                }
            }),
        };
        made.map_err(|source| Error::Write {
            path: self.path,
            source,
        })
    }
}

/// A file that is whole, but not yet at its place.
struct Draft {
    path: PathBuf,
    beside: PathBuf,
    place: PathBuf,
}

impl Draft {
    fn fill(&self, bytes: &[u8]) -> io::Result<()> {
        let mut file = File::create(&self.beside)?;
        file.write_all(bytes)?;
        file.sync_all()
    }

    fn discard(self) {
        // The first error is the one to tell.
        let _gone = fs::remove_file(&self.beside);
    }

    fn publish(self) -> Result<(), Error> {
        if let Err(source) = fs::rename(&self.beside, &self.place) {
            let path = self.path.clone();
            self.discard();
            return Err(Error::Write { path, source });
        }
        Ok(())
    }
}

/// A folder that files will be written to; made where it is missing, and gone again when nothing comes of it.
#[derive(Debug)]
pub struct Folder {
    /// The folders that were made, the outermost first.
    made: Vec<PathBuf>,
}

impl Folder {
    /// Proves that files of these names can be written here.
    pub fn reserve<const N: usize>(
        path: &Path,
        names: [&str; N],
        problems: &mut Problems,
    ) -> Option<(Self, [Output; N])> {
        let missing = path.ancestors().take_while(|above| {
            !above.as_os_str().is_empty() && matches!(above.try_exists(), Ok(false))
        });
        let mut made: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
        made.reverse();
        let folder = Self { made };
        if let Err(source) = fs::create_dir_all(path) {
            problems.push(Problem::Write {
                path: path.to_path_buf(),
                source,
            });
            folder.remove();
            return None;
        }
        let outputs = names.map(|name| Output::reserve(&path.join(name), problems));
        if outputs.iter().any(Option::is_none) {
            folder.remove();
            return None;
        }
        Some((
            folder,
            outputs.map(|output| output.unwrap_or_else(|| unreachable!("all are there"))),
        ))
    }

    /// Takes away the folders that were made, as far as they are empty.
    pub fn remove(self) {
        for path in self.made.iter().rev() {
            // What is not there or not empty may stay.
            let _gone = fs::remove_dir(path);
        }
    }
}

impl Way {
    fn to(path: &Path) -> io::Result<Self> {
        let exists = path.exists();
        if exists {
            let file = OpenOptions::new().append(true).open(path)?;
            if !file.metadata()?.is_file() {
                return Ok(Self::Into(file));
            }
        }
        let place = if exists {
            path.canonicalize()?
        } else if path.as_os_str().as_encoded_bytes().ends_with(b"/") {
            return Err(io::ErrorKind::IsADirectory.into());
        } else {
            path.to_path_buf()
        };
        let beside = beside(&place)?;
        File::create(&beside)?;
        fs::remove_file(&beside)?;
        Ok(Self::Replace(place))
    }
}

/// The name under which a file is made until it is whole.
fn beside(place: &Path) -> io::Result<PathBuf> {
    let Some(name) = place.file_name() else {
        return Err(io::ErrorKind::InvalidFilename.into());
    };
    let mut unfinished = std::ffi::OsString::from(".");
    unfinished.push(name);
    unfinished.push(format!(".{}.part", std::process::id()));
    Ok(place.with_file_name(unfinished))
}
