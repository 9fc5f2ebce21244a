//! `--parquet`, where the program was built with it.

use std::path::Path;

use zhuyi_batch::BatchError;

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// Writes `runs.parquet` into the folder of a finished sweep.
pub type Write = fn(&Path) -> Result<(), BatchError>;

#[cfg(feature = "parquet")]
const WRITE: Option<Write> = Some(zhuyi_batch::parquet::write);
#[cfg(not(feature = "parquet"))]
const WRITE: Option<Write> = None;

/// What is asked for beside `runs.csv`; noted where this program cannot do it.
pub fn asked(typed: bool, problems: &mut Problems) -> Option<Write> {
    if typed && WRITE.is_none() {
        let argument = Argument::new("zhuyi", "--parquet");
        argument.refuse(&argument.all(), Fault::NoParquet, problems);
    }
    WRITE.filter(|_| typed)
}
