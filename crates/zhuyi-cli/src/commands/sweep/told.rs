//! What a finished sweep says.

use std::collections::BTreeMap;
use std::path::Path;

use zhuyi_batch::manoeuvres::{Seen, note};
use zhuyi_batch::{Made, Plan, Run};

use super::super::grid::{REQUIRED, legend, required_cells};
use crate::tables::table;

/// The most rows of the table that is printed.
const MOST_ROWS: usize = 40;

/// The minimum required rate at every point, what could not be made, and where the rows are.
#[derive(Debug, Default)]
pub struct Told {
    rows: Vec<Vec<String>>,
    /// How many points there are, with those that have no row.
    points: usize,
    /// The point under way.
    point: Point,
    drives: u64,
    refused: u64,
    failed: u64,
    /// Which manoeuvres began, for each scenario in the order of the plan.
    seen: BTreeMap<usize, Seen>,
}

/// A point so far.
#[derive(Debug, Default)]
struct Point {
    first: Option<Run>,
    /// How many drives were made.
    made: u64,
    /// How many of them collided, of each rate so far.
    collided: Vec<(u32, u32)>,
}

impl Told {
    /// The next drive, in the order of the plan, with its manoeuvres as its row spells them.
    pub fn add(&mut self, plan: &Plan, run: Run, made: Made, manoeuvres: &str) {
        self.seen.entry(run.scenario).or_default().add(manoeuvres);
        let place = |run: &Run| (run.scenario, run.point);
        if self.point.first.as_ref().map(place) != Some(place(&run)) {
            self.end_point(plan);
            self.point.first = Some(run);
        }
        let collided = u32::from(made == Made::Collision);
        match self.point.collided.last_mut() {
            Some((rate, count)) if *rate == run.rate => *count += collided,
            _ => self.point.collided.push((run.rate, collided)),
        }
        match made {
            Made::Completed | Made::Collision => self.point.made += 1,
            Made::Refused => self.refused += 1,
            Made::Failed => self.failed += 1,
        }
        self.drives += 1;
    }

    fn end_point(&mut self, plan: &Plan) {
        let point = std::mem::take(&mut self.point);
        let Some(run) = point.first else {
            return;
        };
        self.points += 1;
        if self.rows.len() < MOST_ROWS {
            let mut cells = vec![plan.scenarios[run.scenario].name.clone()];
            cells.extend(plan.points[run.point].iter().cloned());
            cells.extend(point.required_or_not(plan));
            self.rows.push(cells);
        }
    }

    /// All that there is to say.
    pub fn text(mut self, plan: &Plan, out: &Path) -> String {
        self.end_point(plan);
        let mut names = vec!["scenario"];
        names.extend(plan.varied.iter().map(String::as_str));
        names.extend(REQUIRED);
        let mut rows = table(&names, &[names.len() - 3]);
        let more = match self.points - self.rows.len() {
            0 => String::new(),
            more => format!("and {more} more combinations\n"),
        };
        rows.add_rows(self.rows);
        let not_made = match (self.refused, self.failed) {
            (0, 0) => String::new(),
            (refused, failed) => {
                format!("{refused} refused and {failed} failed: the column `reason` says why\n")
            }
        };
        let never = self.seen.iter().filter_map(|(scenario, seen)| {
            let note = note(&plan.scenarios[*scenario].name, seen.never());
            note.map(|note| note + "\n")
        });
        format!(
            "{}\n{more}\n{}\n{not_made}{}{} drives in {}{}\n",
            rows.trim_fmt(),
            legend(plan.rates_hz.len(), plan.seeds),
            never.collect::<String>(),
            self.drives,
            out.join("runs.csv").display(),
            limited(plan)
        )
    }
}

impl Point {
    /// The MRF, where all its drives were made.
    fn required_or_not(&self, plan: &Plan) -> [String; 3] {
        if self.made == plan.rates_hz.len() as u64 * plan.seeds {
            required_cells(&self.collided)
        } else {
            ["-", "not all were made", ""].map(String::from)
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
