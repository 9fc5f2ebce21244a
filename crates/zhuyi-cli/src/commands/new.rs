//! `zhuyi new`: a commented file to start from.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use zhuyi_scenario::{Kind, Source, embedded};

use super::Task;
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::inputs::any_source;
use crate::problems::Problems;
use crate::shell;

/// What `--from` calls the plan that comes with the program.
const PLAN: &str = "plan";

/// `zhuyi new` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi new                                my-scenario.ron, explained line by line
  zhuyi new two-lanes -o my-two-lanes.ron
  zhuyi new my-cut-in --from cut-in        a copy of a built-in scenario
  zhuyi new my-car --from default          a copy of the built-in system, with the car and cameras
  zhuyi new my-sweep --from plan           a plan for zhuyi sweep, explained line by line")]
pub struct Arguments {
    /// Name of the new file, which is NAME.ron
    #[arg(value_name = "NAME", default_value = "my-scenario")]
    name: String,
    /// Copy this instead: a built-in scenario, `default` for the built-in system, `plan` for a plan of a sweep, or a .ron file
    #[arg(long, value_name = "SCENARIO")]
    from: Option<String>,
    /// Write to this file instead of NAME.ron; nothing is ever overwritten
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// A file to begin.
#[derive(Debug)]
pub struct New {
    path: PathBuf,
    source: Source,
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<New, Error> {
        let mut problems = Problems::default();
        let source = match &self.from {
            None => Some(Source::new("template.ron", embedded::template())),
            Some(from) if from == PLAN => Some(Source::new("plan.ron", embedded::plan())),
            Some(from) => any_source(Argument::new("--from", from), &mut problems),
        };
        let in_name = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if self.name.is_empty() || !self.name.chars().all(in_name) {
            let argument = Argument::new("NAME", &self.name);
            argument.refuse(
                &argument.all(),
                Fault::Name(self.name.clone()),
                &mut problems,
            );
        }
        let path = self
            .output
            .unwrap_or_else(|| format!("{}.ron", self.name).into());
        problems.finish(source.map(|source| New { path, source }))
    }
}

impl Task for New {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let path = self.path.clone();
        self.write().map_err(|source| match source.kind() {
            io::ErrorKind::AlreadyExists => Error::Exists(path),
            _ => Error::Write { path, source },
        })?;
        let file = self.path.to_string_lossy();
        let next = match Kind::of(&self.source) {
            Kind::Scenario => vec![
                vec!["check", &file],
                vec!["show", &file],
                vec!["run", &file],
            ],
            Kind::System => vec![
                vec!["check", &file],
                vec!["run", "cut-in", "--system", &file],
            ],
            Kind::Plan => vec![
                vec!["check", &file],
                vec!["sweep", &file, "--dry-run"],
                vec!["sweep", &file, "--out", "out"],
            ],
        };
        let next = next
            .into_iter()
            .map(|words| shell::line(["zhuyi"].into_iter().chain(words)));
        let lines: Vec<String> = next.map(|line| format!("  {line}\n")).collect();
        Ok(Answer::new(format!(
            "Wrote {file}. Next:\n{}",
            lines.concat()
        )))
    }
}

impl New {
    /// Writes the file whole, or leaves none.
    fn write(&self) -> io::Result<()> {
        let mut file = OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&self.path)?;
        let written = file
            .write_all(self.source.text().as_bytes())
            .and_then(|()| file.sync_all());
        if written.is_err() {
            // The first error is the one to tell.
            let _gone = fs::remove_file(&self.path);
        }
        written
    }
}
