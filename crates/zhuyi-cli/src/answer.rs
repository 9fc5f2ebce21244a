//! What a command says on standard output.

use std::io::{self, ErrorKind, Write};

use crate::error::Error;

/// The text for standard output, and what is to be said on standard error and by the exit code behind it.
#[derive(Debug)]
pub struct Answer {
    text: String,
    /// Lines for standard error.
    notes: Vec<String>,
    failure: Option<Error>,
}

impl Answer {
    /// The answer of a command that has done what it was asked.
    pub fn new(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            notes: Vec::new(),
            failure: None,
        }
    }

    /// The same answer with notes for standard error: what a document on standard output has no reader for.
    #[must_use]
    pub fn with_notes(mut self, notes: Vec<String>) -> Self {
        self.notes = notes;
        self
    }

    /// The answer of a command that has something to show although it failed.
    pub fn failing(text: impl Into<String>, failure: Error) -> Self {
        Self {
            text: text.into(),
            notes: Vec::new(),
            failure: Some(failure),
        }
    }

    /// Prints the text, and the notes. Whoever closes the pipe early, as `head` does, has seen enough.
    pub fn print(self) -> Result<(), Error> {
        let mut out = io::stdout().lock();
        let printed = out
            .write_all(self.text.as_bytes())
            .and_then(|()| out.flush());
        let mut err = io::stderr().lock();
        for note in &self.notes {
            // Where standard error is closed there is nobody to tell.
            let _closed = writeln!(err, "note: {note}");
        }
        match printed {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Error::Print(error)),
            _ => self.failure.map_or(Ok(()), Err),
        }
    }
}
