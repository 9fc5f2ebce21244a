//! `zhuyi schema`: what the JSON documents and the tables that commands write are made of.

mod tables;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::Value;
use zhuyi_batch::columns::Table;
use zhuyi_batch::{plan, runs, table};
use zhuyi_scenario::{System, did_you_mean};
use zhuyi_studies::reproduce::manifest;

use super::explain::document::Explanation;
use super::run::summary::Summary;
use super::{Task, mrf};
use crate::answer::Answer;
use crate::argument::Argument;
use crate::error::Error;
use crate::fault::Fault;
use crate::inputs::default_system;
use crate::problems::Problems;

/// Version of what `--json` prints: fields are added to them, never renamed.
const VERSION: u32 = 1;

/// `zhuyi schema` as typed.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  zhuyi schema               what there is
  zhuyi schema run           the document of zhuyi run --json
  zhuyi schema runs          the table runs.csv of zhuyi reproduce
  zhuyi schema out/cut-in    the runs.csv of this sweep, with the columns of what it varies

Documents are told as JSON Schema (draft 2020-12), tables as Frictionless Table Schema (Data Package 2.0): columns with type, unit \
and meaning. The version of plan.json, manifest.json and runs.csv stands in both of these files as `schema`.")]
pub struct Arguments {
    /// One of the list, or the folder of a sweep; without it the list
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

/// What to tell.
#[derive(Debug)]
pub enum Schema {
    /// What there is.
    List,
    /// This.
    Of(Value),
    /// The table of a sweep.
    Folder(PathBuf),
}

/// A document: its name, what it is, and its schema.
type Document = (&'static str, &'static str, fn() -> Value);

/// All documents.
const DOCUMENTS: [Document; 5] = [
    ("run", "zhuyi run --json: one drive", || {
        zhuyi_batch::schema::document::<Summary>("run", VERSION)
    }),
    (
        "explain",
        "zhuyi explain --json: why a drive collided",
        || zhuyi_batch::schema::document::<Explanation>("explain", VERSION),
    ),
    (
        "mrf",
        "zhuyi mrf --json: minimum required rates, and what they rest on",
        || zhuyi_batch::schema::document::<mrf::document::Document>("mrf", VERSION),
    ),
    (
        "plan",
        "plan.json of zhuyi sweep and merge: which runs",
        plan::schema,
    ),
    (
        "manifest",
        "manifest.json of zhuyi reproduce: what it was made from",
        manifest::schema,
    ),
];

/// All tables.
fn all_tables() -> impl Iterator<Item = Table> {
    // The embedded system passes its own checks.
    let system = System::read(&default_system(), &[]);
    let runs = system.ok().map(|system| runs::table(&system));
    runs.into_iter().chain(tables::tables())
}

impl Arguments {
    /// What was typed, as meant.
    pub fn meant(self) -> Result<Schema, Error> {
        let Some(name) = self.name else {
            return Ok(Schema::List);
        };
        if let Some((_, _, schema)) = DOCUMENTS.iter().find(|(known, _, _)| *known == name) {
            return Ok(Schema::Of(schema()));
        }
        if let Some(table) = all_tables().find(|table| table.name == name) {
            return Ok(Schema::Of(table.schema()));
        }
        if Path::new(&name).is_dir() {
            return Ok(Schema::Folder(name.into()));
        }
        let documents = DOCUMENTS.iter().map(|(known, _, _)| *known);
        let known: Vec<&str> = documents
            .chain(all_tables().map(|table| table.name))
            .collect();
        let mut problems = Problems::default();
        let argument = Argument::new("NAME", &name);
        let hint = match did_you_mean(&name, known.iter().copied()) {
            Some(name) => format!("did you mean `{name}`?"),
            None => format!("known: {}; or the folder of a sweep", known.join(", ")),
        };
        let (what, got) = ("document or table", name.clone());
        let fault = Fault::Unknown { what, got, hint };
        argument.refuse(&argument.all(), fault, &mut problems);
        problems.finish(None)
    }
}

impl Task for Schema {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let schema = match *self {
            Self::List => return Ok(Answer::new(list())),
            Self::Of(schema) => schema,
            Self::Folder(dir) => table::table(&dir)?.schema(),
        };
        Ok(Answer::new(format!("{schema:#}\n")))
    }
}

/// What there is.
fn list() -> String {
    let mut text = "Documents, as JSON Schema:\n".to_string();
    // Writing to a string cannot fail.
    for (name, meaning, _) in DOCUMENTS {
        let _ = writeln!(text, "  {name:<18}{meaning}");
    }
    text += "\nTables, as Frictionless Table Schema:\n";
    for table in all_tables() {
        let _ = writeln!(text, "  {:<18}{}", table.name, table.meaning);
    }
    text + "  DIR               runs.csv of the sweep in this folder\n"
}
