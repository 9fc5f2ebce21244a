//! The report of a table of runs: the worst of them driven again.

use std::fmt::Write;

use clap::Parser;
use zhuyi_batch::Progress;
use zhuyi_report::drive::document::Document;
use zhuyi_report::sweep::table::{Row, Table};
use zhuyi_report::sweep::{Shown, Worst, document, worst};
use zhuyi_sim::Outcome;

use crate::commands::run::summary::Summary;
use crate::commands::{self, Command};
use crate::progress::Bar;
use crate::shell;

/// [s] as which times are told in the table.
const TOLD_TIME: f64 = 1e-4;

/// The page, and what is to be said of it on the terminal.
pub fn page(table: &Table, command: String) -> (String, String) {
    let worst = worst(table);
    let bar = Bar::new();
    bar.start("replays", worst.len() as u64);
    let shown: Vec<Shown> = worst
        .iter()
        .map(|worst| {
            let shown = again(worst);
            bar.step();
            shown
        })
        .collect();
    let replays = shown.iter().filter(|shown| shown.document.is_some());
    let replays = replays.count();
    let document = document(table, shown, env!("CARGO_PKG_VERSION"), command);
    let mut told = format!(
        "{} runs of {} scenarios, {replays} replays\n",
        document.runs,
        document.scenarios.len()
    );
    for shown in &document.drives {
        if let Some(note) = &shown.note {
            // Writing to a string cannot fail.
            let _ = writeln!(told, "{}: {note}", shown.command);
        }
    }
    let names: Vec<&str> = document
        .scenarios
        .iter()
        .map(|of| of.name.as_str())
        .collect();
    let title = format!("{}: zhuyi", names.join(", "));
    (zhuyi_report::page(&title, &document), told)
}

/// A run with its replay.
fn again(worst: &Worst<'_>) -> Shown {
    match driven(worst.row) {
        Ok((document, note)) => worst.shown(Some(document), note),
        Err(why) => worst.shown(None, Some(why)),
    }
}

/// The run of a row made again, and what then differs; or why it cannot be.
fn driven(row: &Row) -> Result<(Document, Option<String>), String> {
    let words = shell::words(&row.replay).ok_or("no replay: a quote in its command is open")?;
    let typed = commands::Arguments::try_parse_from(words)
        .map_err(|_| "no replay: its command is none of zhuyi".to_string())?;
    let Command::Run(typed) = typed.command else {
        return Err("no replay: its command is no zhuyi run".to_string());
    };
    let starts_program = |policy: &String| policy.starts_with("exec:");
    if typed.policy.as_ref().is_some_and(starts_program) {
        return Err("no replay: its command would start a program".to_string());
    }
    let failed = |error: crate::error::Error| format!("no replay: {error}");
    let run = typed.alone().meant().map_err(failed)?;
    let made = run.drive(true).map_err(failed)?;
    let same = match (&made.outcome, &row.collision) {
        (Outcome::Completed, None) => true,
        (Outcome::Collision(now), Some(then)) => {
            (now.time.seconds() - then.time).abs() <= TOLD_TIME
        }
        _ => false,
    };
    let note = (!same).then(|| {
        "driven again it ends otherwise than the table tells: another version, or other files"
            .to_string()
    });
    let summary = Summary::new(&run, &made);
    run.document(&summary, &made, row.replay.clone())
        .map(|document| (document, note))
        .ok_or_else(|| "no replay".to_string())
}
