//! `zhuyi report`: one HTML file of what other commands, or others, left behind.

mod sweep;
mod trace;

use std::fs;
use std::path::PathBuf;

use clap::Args;
use zhuyi_report::sweep::table::Table;

use super::Task;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::interrupt;
use crate::output::Output;
use crate::problems::{Problem, Problems};
use crate::shell;
use trace::Trace;

/// The table of runs in a folder.
const RUNS: &str = "runs.csv";

/// `zhuyi report` as typed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Examples:
  zhuyi sweep cut-out-fast --out out
  zhuyi report out -o cut-out-fast.html
  zhuyi report results -o nine.html                        the runs of zhuyi reproduce
  zhuyi report recording.csv --ego 427 -o recording.html   a recording, seen by vehicle 427
  zhuyi run cut-out-fast --fpr 5 --report drive.html       of one drive, with what the car believed: see zhuyi run

The file needs no network and opens from disk.

Of a sweep it shows the outcome by rate and seed, the minimum required rate of every scenario, and the worst runs with their \
replays and why they crashed: the collision at the highest rate, the hardest impact, and where nothing collided the smallest gap. \
These are driven again by the commands in the table, from the folder in which it was made if they name files; what then differs \
from the table is told. Commands that are no zhuyi run, or that would start a program (--policy exec:..), are not carried out.

Of a trace, as for zhuyi estimate, it shows where everyone was, what each camera was asked for and what every model tolerates; what \
the ego believed nobody recorded. Vehicles that never come within 150 m of the ego are left out.")]
pub struct Arguments {
    /// The folder of a sweep, with its runs.csv, or a trace, a CSV file as zhuyi run --trace writes it
    #[arg(value_name = "DIR|TRACE")]
    of: PathBuf,
    /// The file to write; what is there is replaced
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Of a trace: id of the vehicle that is the ego [default: ego]
    #[arg(long, value_name = "ID", allow_hyphen_values = true)]
    ego: Option<String>,
    /// Of a trace: frame rates at which the cameras run, as for zhuyi estimate
    #[arg(long, value_name = "RATES", allow_hyphen_values = true)]
    fpr: Option<String>,
    /// Of a trace: the scenario, by name or path, on whose road it was taken
    #[arg(long, value_name = "FILE")]
    road: Option<String>,
    /// Of a trace: cameras and estimator, a system file [default: the built-in `default`]
    #[arg(long, value_name = "FILE")]
    rig: Option<String>,
    /// Of a trace: set one value of the system file, or of the scenario that --road names; may be given more
    /// than once
    #[arg(long = "set", value_name = "PATH=VALUE")]
    settings: Vec<String>,
}

/// A report to write.
#[derive(Debug)]
pub struct Report {
    of: Of,
    out: Output,
    /// The command that makes it again.
    command: String,
}

/// What it is about.
#[derive(Debug)]
enum Of {
    Runs(Table),
    Trace(Box<Trace>),
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Report, Error> {
        let mut problems = Problems::default();
        let of = self.of(&mut problems);
        let out = Output::reserve(&self.out, &mut problems);
        let command = self.command();
        let report = of.zip(out).map(|(of, out)| Report { of, out, command });
        problems.finish(report)
    }

    fn of(&self, problems: &mut Problems) -> Option<Of> {
        let path = if self.of.is_dir() {
            self.of.join(RUNS)
        } else {
            self.of.clone()
        };
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(source) => {
                problems.push(Problem::Read { path, source });
                return None;
            }
        };
        let header = text.lines().next().unwrap_or("");
        let is_table = self.of.is_dir() || header.split(',').any(|column| column == "replay");
        if !is_table {
            let trace = Trace::read(self, text, problems)?;
            return Some(Of::Trace(Box::new(trace)));
        }
        self.refuse_flags(problems);
        match Table::read(&text) {
            Ok(table) => Some(Of::Runs(table)),
            Err(why) => {
                let typed = self.of.display().to_string();
                let argument = Argument::new("DIR|TRACE", &typed);
                let path = path.display().to_string();
                argument.refuse(&argument.all(), Fault::NoTable { path, why }, problems);
                None
            }
        }
    }

    /// What a table of runs would not look at.
    fn refuse_flags(&self, problems: &mut Problems) {
        let flags = [
            ("--ego", &self.ego),
            ("--fpr", &self.fpr),
            ("--road", &self.road),
            ("--rig", &self.rig),
        ];
        let typed = flags
            .into_iter()
            .filter_map(|(flag, value)| Some((flag, value.as_deref()?)));
        let settings = self
            .settings
            .iter()
            .map(|setting| ("--set", setting.as_str()));
        for (flag, value) in typed.chain(settings) {
            let argument = Argument::new(flag, value);
            argument.refuse(&argument.all(), Fault::OfTraces(flag), problems);
        }
    }

    /// The command that makes the report again.
    fn command(&self) -> String {
        let (of, out) = (
            self.of.display().to_string(),
            self.out.display().to_string(),
        );
        let mut words = vec!["zhuyi", "report", of.as_str()];
        let flags = [
            ("--ego", &self.ego),
            ("--fpr", &self.fpr),
            ("--road", &self.road),
            ("--rig", &self.rig),
        ];
        for (flag, value) in flags {
            words.extend(value.iter().flat_map(|value| [flag, value.as_str()]));
        }
        words.extend(
            self.settings
                .iter()
                .flat_map(|setting| ["--set", setting.as_str()]),
        );
        words.extend(["-o", out.as_str()]);
        shell::line(words)
    }
}

impl Task for Report {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let (page, told) = match &self.of {
            Of::Runs(table) => sweep::page(table, self.command),
            Of::Trace(trace) => trace.page(self.command),
        };
        let path = self.out.path().display().to_string();
        self.out.write(page.as_bytes())?;
        Ok(Answer::new(format!("{told}Wrote {path}\n")))
    }
}
