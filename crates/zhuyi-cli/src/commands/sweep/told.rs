//! What a finished sweep says.

use std::path::Path;

use zhuyi_lab::batch::{Made, Plan};

use super::super::grid::{REQUIRED, legend, required_cells};
use crate::tables::table;

/// The most rows of the table that is printed.
const MOST_ROWS: usize = 40;

/// The minimum required rate at every point, what could not be made, and where the rows are.
pub fn told(plan: &Plan, made: &[Made], out: &Path) -> String {
    let mut names = vec!["scenario"];
    names.extend(plan.varied.iter().map(String::as_str));
    names.extend(REQUIRED);
    let mut rows = table(&names, &[names.len() - 3]);
    let per_point = plan.rates_hz.len() * plan.seeds as usize;
    let points = made.chunks(per_point);
    let count = points.len();
    for (place, made) in points.enumerate().take(MOST_ROWS) {
        let run = plan.run((place * per_point) as u64);
        let mut cells = vec![plan.scenarios[run.scenario].name.clone()];
        cells.extend(plan.points[run.point].iter().cloned());
        cells.extend(required_or_not(plan, made, per_point));
        rows.add_row(cells);
    }
    let more = match count.saturating_sub(MOST_ROWS) {
        0 => String::new(),
        more => format!("and {more} more combinations\n"),
    };
    format!(
        "{}\n{more}\n{}\n{}{} drives in {}{}\n",
        rows.trim_fmt(),
        legend(plan.rates_hz.len(), plan.seeds),
        not_made(made),
        made.len(),
        out.join("runs.csv").display(),
        limited(plan)
    )
}

/// The MRF, where all its drives were made.
fn required_or_not(plan: &Plan, made: &[Made], per_point: usize) -> [String; 3] {
    let whole = made.len() == per_point
        && made
            .iter()
            .all(|made| matches!(made, Made::Completed | Made::Collision));
    if !whole {
        return ["-", "not all were made", ""].map(String::from);
    }
    let collided = |made: &&Made| **made == Made::Collision;
    let rates = plan.rates_hz.iter().copied();
    let counts = made
        .chunks(plan.seeds as usize)
        .map(|made| made.iter().filter(collided).count() as u32);
    required_cells(&rates.zip(counts).collect::<Vec<_>>())
}

/// How many drives have a reason instead of figures.
fn not_made(made: &[Made]) -> String {
    let count = |which: Made| made.iter().filter(|made| **made == which).count();
    match (count(Made::Refused), count(Made::Failed)) {
        (0, 0) => String::new(),
        (refused, failed) => {
            format!("{refused} refused and {failed} failed: the column `reason` says why\n")
        }
    }
}

/// How many of what: `1 seed`, `2 seeds`.
pub fn counted(count: u64, one: &str) -> String {
    match count {
        1 => format!("1 {one}"),
        count => format!("{count} {one}s"),
    }
}

/// A note where not all of a plan is made.
pub fn limited(plan: &Plan) -> String {
    let all = plan.runs_in_full();
    if plan.runs() < all {
        format!(" (limited: the first of {all})")
    } else {
        String::new()
    }
}
