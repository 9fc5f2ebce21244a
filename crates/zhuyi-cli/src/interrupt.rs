//! Ctrl-C in a long command: exit code 130, and no file half written.
//!
//! Files are written at the end, in milliseconds, under a lock that the handler takes before it ends the process: an interrupted
//! command has written all of its files or none.

use std::io::{Write, stderr};
use std::process::exit;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::Error;

static WRITING: Mutex<()> = Mutex::new(());

/// From now on Ctrl-C ends the process, though not while files are being written.
pub fn listen() -> Result<(), Error> {
    ctrlc::set_handler(|| {
        let _whole = writing();
        let _closed = writeln!(stderr(), "\ninterrupted");
        exit(130);
    })?;
    Ok(())
}

/// Holds Ctrl-C back until the guard is dropped.
pub fn writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}
