//! `zhuyi report`: one HTML file of what other commands left behind.

mod sweep;

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

/// The table of runs in a folder.
const RUNS: &str = "runs.csv";

/// `zhuyi report` as typed.
#[derive(Args, Clone, Debug)]
#[command(after_help = "\
Examples:
  zhuyi sweep cut-out-fast --out out && zhuyi report out -o cut-out-fast.html
  zhuyi report results -o nine.html                        the runs of zhuyi reproduce
  zhuyi run cut-out-fast --fpr 5 --report drive.html       of one drive: see zhuyi run

The file needs no network and opens from disk. It shows the outcome by rate and seed, the minimum required rate of every \
scenario, and the worst runs with their replays and why they crashed: the collision at the highest rate, the hardest impact, and \
where nothing collided the smallest gap. These are driven again by the commands in the table, from the folder in which it was \
made if they name files; what then differs from the table is told. Commands that are no zhuyi run, or that would start a program \
(--policy exec:..), are not carried out.")]
pub struct Arguments {
    /// The folder of a sweep, with its runs.csv
    #[arg(value_name = "DIR")]
    of: PathBuf,
    /// The file to write; what is there is replaced
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
}

/// A report to write.
#[derive(Debug)]
pub struct Report {
    table: Table,
    out: Output,
    /// The command that makes it again.
    command: String,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Report, Error> {
        let mut problems = Problems::default();
        let table = self.table(&mut problems);
        let out = Output::reserve(&self.out, &mut problems);
        let (of, file) = (
            self.of.display().to_string(),
            self.out.display().to_string(),
        );
        let command = shell::line(["zhuyi", "report", of.as_str(), "-o", file.as_str()]);
        let report = table.zip(out).map(|(table, out)| Report {
            table,
            out,
            command,
        });
        problems.finish(report)
    }

    fn table(&self, problems: &mut Problems) -> Option<Table> {
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
        match Table::read(&text) {
            Ok(table) => Some(table),
            Err(why) => {
                let typed = self.of.display().to_string();
                let argument = Argument::new("DIR", &typed);
                let path = path.display().to_string();
                argument.refuse(&argument.all(), Fault::NoTable { path, why }, problems);
                None
            }
        }
    }
}

impl Task for Report {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        interrupt::listen()?;
        let (page, told) = sweep::page(&self.table, self.command);
        let path = self.out.path().display().to_string();
        self.out.write(page.as_bytes())?;
        Ok(Answer::new(format!("{told}Wrote {path}\n")))
    }
}
