//! Ctrl-C in a long command: exit code 130, and no file half written.
//!
//! Where work goes by blocks, the first Ctrl-C waits for the end of the block ([`listen_between`]), the second does not.
//!
//! Elsewhere files are written at the end, in milliseconds, under a lock that the handler takes before it ends the process: an interrupted
//! command has written all of its files or none.

use std::io::{Write, stderr};
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::error::Error;

static WRITING: Mutex<()> = Mutex::new(());
static ASKED: AtomicBool = AtomicBool::new(false);

/// From now on Ctrl-C ends the process, though not while files are being written.
pub fn listen() -> Result<(), Error> {
    ctrlc::set_handler(|| {
        let _whole = writing();
        let _closed = writeln!(stderr(), "\ninterrupted");
        exit(130);
    })?;
    Ok(())
}

/// From now on the first Ctrl-C is only noted, and the second ends the process.
pub fn listen_between() -> Result<(), Error> {
    ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            exit(130);
        }
        let told = "\ninterrupted: finishing this block; Ctrl-C again ends at once";
        let _closed = writeln!(stderr(), "{told}");
    })?;
    Ok(())
}

/// Whether there was a Ctrl-C since [`listen_between`].
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// Holds Ctrl-C back until the guard is dropped.
pub fn writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}
