//! `runs.csv`: one row per run, with the command that replays it. An empty field says that there is no such figure. The
//! columns are those of `described`, from which header, rows and schema are made.

mod described;

use zhuyi_scenario::System;

use crate::columns::{Column, Table};
use crate::rates::spelt;
use crate::sweep::{Cell, Experiment, Record};
use crate::text::csv_row;

/// How runs are called on the command line, so that each row can tell how to run it again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Typed {
    /// The scenarios as typed, in the order of the experiment: names or paths.
    pub scenarios: Vec<String>,
    /// What else every command needs, as `--system my.ron --set planner.min_gap_m=2`.
    pub options: String,
}

impl Typed {
    /// The scenarios and the system that come with the program.
    pub fn embedded(experiment: &Experiment<'_>) -> Self {
        let names = experiment
            .scenarios
            .iter()
            .map(|scenario| scenario.name.clone());
        Self {
            scenarios: names.collect(),
            options: String::new(),
        }
    }

    /// The command that runs a cell again.
    pub fn replay(&self, experiment: &Experiment<'_>, cell: &Cell) -> String {
        let rates = spelt(experiment.system, &cell.rates);
        self.command(cell.scenario, &rates, cell.seed, experiment.root_seed)
    }

    /// The command of a run.
    pub fn command(&self, scenario: usize, rates: &str, seed: u64, root: u64) -> String {
        let scenario = &self.scenarios[scenario];
        let root = match root {
            0 => String::new(),
            root => format!("--root-seed {root}"),
        };
        let run = format!("zhuyi run {scenario} --fpr {rates} --seed {seed}");
        let parts = [run, root, self.options.clone()];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        parts.join(" ")
    }
}

/// The table of runs of embedded scenarios and the embedded system, header first: parts with their names, in their order. The
/// estimates are those of the first estimator that a run was put to.
pub fn csv(experiment: &Experiment<'_>, parts: &[(&str, &[Record])]) -> String {
    csv_typed(experiment, &Typed::embedded(experiment), parts)
}

/// The same for scenarios and a system that were typed otherwise.
pub fn csv_typed(
    experiment: &Experiment<'_>,
    typed: &Typed,
    parts: &[(&str, &[Record])],
) -> String {
    let columns = Columns::of(experiment.system);
    let mut text = columns.header();
    for (part, records) in parts {
        for record in *records {
            text += &columns.row(experiment, typed, part, &[], record);
        }
    }
    text
}

use described::Row;
pub(crate) use described::{NAMED_BY, OUTCOME};

/// The columns of a table of runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// The names of the cameras, in the order of the rig.
    pub(crate) cameras: Vec<String>,
    /// What differs from run to run besides the scenario, the rates and the seed.
    pub(crate) varied: Vec<Column>,
    /// Whether it is of a sweep: all cameras have one rate, and there is a column that says why a run could not be made.
    pub(crate) of_sweep: bool,
}

/// The table of `zhuyi reproduce` for a system; that of a sweep is [`batch::table`](crate::table).
pub fn table(system: &System) -> Table {
    Columns::of(system).table()
}

impl Columns {
    /// The columns for the cameras of a system.
    pub fn of(system: &System) -> Self {
        let eyes = system.perception.eyes.iter();
        Self {
            cameras: eyes.map(|eye| eye.camera.name.clone()).collect(),
            varied: Vec::new(),
            of_sweep: false,
        }
    }

    fn names(&self) -> Vec<String> {
        let entries = self.entries().into_iter();
        entries
            .map(|entry| entry.column.name.into_owned())
            .collect()
    }

    /// The header.
    pub fn header(&self) -> String {
        csv_row(self.names().iter().map(String::as_str))
    }

    /// The row of a run, with the values of what is varied.
    pub fn row(
        &self,
        experiment: &Experiment<'_>,
        typed: &Typed,
        part: &str,
        values: &[String],
        record: &Record,
    ) -> String {
        let row = Row {
            experiment,
            typed,
            part,
            values,
            record,
        };
        let entries = self.entries();
        let fields: Vec<String> = entries.iter().map(|entry| entry.field(&row)).collect();
        csv_row(fields.iter().map(String::as_str))
    }

    /// The row of a run that could not be made: `named` are the fields before the outcome.
    pub fn without_figures(
        &self,
        named: &[String],
        outcome: &str,
        reason: &str,
        replay: &str,
    ) -> String {
        let known = named.len() + 3;
        let nothing = vec![""; self.names().len() - known];
        let named = named.iter().map(String::as_str).chain([outcome]);
        csv_row(named.chain(nothing).chain([reason, replay]))
    }
}
