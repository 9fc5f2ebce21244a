//! What the columns of a sweep's `runs.csv` are.

use std::fs::File;
use std::path::Path;

use crate::batch_error::BatchError;
use crate::blocks::{PLAN, RUNS, known_plan};
use crate::columns::Table;
use crate::error::Attempt;
use crate::merge::damaged;
use crate::runs::Columns;

/// What follows the name of a camera in the column of its frames.
const FRAMES: &str = "_frames";

/// The table of the finished sweep in a folder: its columns by its plan, and by the header, as a plan does not name the cameras.
///
/// # Errors
/// When there is no finished sweep, or its table does not have the columns that it should have.
pub fn table(dir: &Path) -> Result<Table, BatchError> {
    let Some(plan) = known_plan(dir)? else {
        return Err(BatchError::NoPlan {
            path: dir.join(PLAN),
            reason: "there is no such file".to_string(),
        });
    };
    let path = dir.join(RUNS);
    let file = File::open(&path).map_err(Attempt::Read.on(&path))?;
    let mut reader = csv::Reader::from_reader(file);
    let header = reader.headers();
    let header = header.map_err(|error| damaged(&path, &error.to_string()))?;
    let columns = Columns {
        cameras: header.iter().filter_map(camera).collect(),
        varied: plan.varied_columns(),
        of_sweep: true,
    };
    let table = columns.table();
    let names = table.columns.iter().map(|column| column.name.as_ref());
    if !names.eq(header.iter()) {
        return Err(damaged(&path, "its header is another"));
    }
    Ok(table)
}

fn camera(name: &str) -> Option<String> {
    name.strip_suffix(FRAMES).map(String::from)
}
