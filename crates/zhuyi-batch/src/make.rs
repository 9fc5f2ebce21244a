//! The rows of a block: every run of it, each read, driven and told by itself.
//!
//! Whatever is wrong with a run is in its row: parameters that the reader refuses, or a drive that fails. It never ends the
//! sweep.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, Setting, Source, System, load};

use crate::estimators::estimator;
use crate::parallel::one_by_one;
use crate::plan::PART;
use crate::rates::uniform;
use crate::runs::{Columns, Typed};
use crate::sweep::{Cell, Experiment};
use crate::{Made, Plan, Run};

/// The name that errors call a varied parameter by.
const VARY: &str = "--vary";

/// A plan with what it is made from.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The scenarios' texts, in the order of the plan.
    pub scenarios: &'a [Source],
    /// The system's text.
    pub system: &'a Source,
    /// What is set in every run.
    pub settings: &'a [Setting],
    /// The system without what is varied: its cameras are those of the columns.
    pub base: &'a System,
    /// How a word is spelt on a command line.
    pub quote: fn(&str) -> String,
}

/// A scenario and a system at a point, ready to drive.
struct Ready {
    scenario: Scenario,
    system: System,
    estimator: Estimator,
}

impl Batch<'_> {
    /// The block's table, header first. `done` is called after each run, from any thread.
    pub fn block(&self, number: u64, done: impl Fn() + Sync) -> String {
        let columns = self.columns();
        let runs: Vec<Run> = self
            .plan
            .block(number)
            .map(|place| self.plan.run(place))
            .collect();
        let places = |run: &Run| (run.scenario, run.point);
        let mut points: Vec<(usize, usize)> = runs.iter().map(places).collect();
        points.dedup();
        let ready: Vec<Result<Ready, String>> = points
            .par_iter()
            .map(|(scenario, point)| self.ready(*scenario, *point, &columns))
            .collect();
        let row = |run: &Run| {
            // Ascending, as the runs are.
            let at = points.partition_point(|point| *point < places(run));
            let row = self.row(&columns, *run, &ready[at]);
            done();
            row
        };
        let rows: Vec<String> = one_by_one(&runs).map(row).collect();
        columns.header() + &rows.concat()
    }

    /// What the reader says of a point of a scenario.
    ///
    /// # Errors
    /// All that it refuses.
    pub fn read(
        &self,
        scenario: usize,
        point: usize,
    ) -> Result<(Scenario, System), zhuyi_scenario::Invalid> {
        let values = self.plan.varied.iter().zip(&self.plan.points[point]);
        let varied = values.map(|(path, value)| Setting::parse_as(VARY, &spelt(path, value)));
        let mut settings = self.settings.to_vec();
        for setting in varied {
            settings.push(setting?);
        }
        load(&self.scenarios[scenario], self.system, &settings)
    }

    fn columns(&self) -> Columns {
        Columns {
            varied: self.plan.varied_columns(),
            of_sweep: true,
            ..Columns::of(self.base)
        }
    }

    fn ready(&self, scenario: usize, point: usize, columns: &Columns) -> Result<Ready, String> {
        let read = self.read(scenario, point);
        let (scenario, system) = read.map_err(|invalid| invalid.brief())?;
        if Columns::of(&system).cameras != columns.cameras {
            return Err("its cameras are not those of the table's columns".to_string());
        }
        let estimator = estimator(&system, |_| {});
        Ok(Ready {
            scenario,
            system,
            estimator,
        })
    }

    fn row(&self, columns: &Columns, run: Run, ready: &Result<Ready, String>) -> String {
        let ready = match ready {
            Ok(ready) => ready,
            Err(reason) => return self.without_figures(columns, run, Made::Refused, reason),
        };
        let experiment = Experiment {
            scenarios: std::slice::from_ref(&ready.scenario),
            system: &ready.system,
            root_seed: self.plan.root_seed,
        };
        let cell = Cell {
            scenario: 0,
            rates: uniform(&ready.system, run.rate),
            seed: run.seed,
        };
        if let Err(crowded) = experiment.starts(&cell) {
            return self.without_figures(columns, run, Made::Refused, &crowded.to_string());
        }
        let drive = || experiment.record(&cell, std::slice::from_ref(&ready.estimator));
        match guarded(drive) {
            Ok(record) => columns.row(
                &experiment,
                &self.typed(run),
                PART,
                &self.plan.points[run.point],
                &record,
            ),
            Err(reason) => self.without_figures(columns, run, Made::Failed, &reason),
        }
    }

    fn without_figures(&self, columns: &Columns, run: Run, made: Made, reason: &str) -> String {
        let fields = self.plan.fields(run);
        let replay = self.replay(run);
        columns.without_figures(&fields, made.name(), reason, &replay)
    }

    /// How the run is called on the command line.
    fn typed(&self, run: Run) -> Typed {
        let values = self.plan.varied.iter().zip(&self.plan.points[run.point]);
        let varied =
            values.map(|(path, value)| format!("--set {}", (self.quote)(&spelt(path, value))));
        let options = Some(self.plan.options.clone()).filter(|options| !options.is_empty());
        Typed {
            scenarios: vec![self.plan.scenarios[run.scenario].typed.clone()],
            options: options
                .into_iter()
                .chain(varied)
                .collect::<Vec<_>>()
                .join(" "),
        }
    }

    /// The command that makes a run again.
    pub fn replay(&self, run: Run) -> String {
        self.typed(run)
            .command(0, &run.rate.to_string(), run.seed, self.plan.root_seed)
    }
}

/// A parameter as a setting.
fn spelt(path: &str, value: &str) -> String {
    format!("{path}={value}")
}

/// What a drive comes to, or the first line of its panic.
fn guarded<T>(drive: impl FnOnce() -> T) -> Result<T, String> {
    // Nothing outlives the panic but what the drive has only read.
    catch_unwind(AssertUnwindSafe(drive)).map_err(|panic| first_line(panic.as_ref()))
}

fn first_line(panic: &(dyn Any + Send)) -> String {
    let text = panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied());
    let line = text.and_then(|text| text.lines().next());
    line.unwrap_or("it panicked").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_a_drive_that_panics_is_told_in_one_line() {
        let number = [3];
        assert_eq!(guarded(|| number[0] + 1), Ok(4));
        let failed = guarded(|| -> u8 { panic!("first {}\nsecond", number[0]) });
        assert_eq!(failed, Err("first 3".to_string()));
    }
}
