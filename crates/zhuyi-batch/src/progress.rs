//! How a long command tells what it is at.

/// Told about the progress of runs, from any thread. `()` says nothing.
pub trait Progress: Sync {
    /// A stage of `total` steps begins; the one before it is over.
    fn start(&self, what: &str, total: u64);
    /// One step of the stage is done.
    fn step(&self);
}

impl Progress for () {
    fn start(&self, _what: &str, _total: u64) {}
    fn step(&self) {}
}
