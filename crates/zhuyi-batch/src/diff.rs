//! What changed between two folders of results: runs, minimum required rates, claims, other files.
//!
//! Runs are found again by what they are named by, wherever their rows stand, and compared column by column. `plan.json`,
//! `manifest.json` and the column `replay` tell how results were made, not what they are: they are passed over. Left out:
//! folders within, such as figures.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use crate::error::{Attempt, LabError};
use crate::mrf::required;
use crate::runs::{NAMED_BY, OUTCOME};

/// The files that tell how results were made.
const PROVENANCE: [&str; 2] = ["plan.json", "manifest.json"];

/// The most changes of a kind that are told one by one.
const MOST: usize = 10;

/// What changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// Minimum required rates.
    pub mrfs: Vec<String>,
    /// Outcomes of runs, and runs that only one has.
    pub runs: Vec<String>,
    /// Figures: the columns in which runs with the same outcome differ, and in how many.
    pub figures: Vec<String>,
    /// Claims and their verdicts.
    pub claims: Vec<String>,
    /// Other files.
    pub files: Vec<String>,
}

impl Changes {
    fn kinds(&self) -> [(&'static str, &[String]); 5] {
        [
            ("MRFs", &self.mrfs),
            ("runs", &self.runs),
            ("figures of runs", &self.figures),
            ("claims", &self.claims),
            ("files", &self.files),
        ]
    }

    /// Whether nothing has changed.
    pub fn is_empty(&self) -> bool {
        self.kinds().iter().all(|(_, changes)| changes.is_empty())
    }
}

impl fmt::Display for Changes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (kind, changes) in self.kinds() {
            if changes.is_empty() {
                continue;
            }
            writeln!(f, "{kind}:")?;
            for change in changes.iter().take(MOST) {
                writeln!(f, "  {change}")?;
            }
            if changes.len() > MOST {
                writeln!(f, "  and {} more", changes.len() - MOST)?;
            }
        }
        Ok(())
    }
}

/// What changed from one folder to the other.
///
/// # Errors
/// When one cannot be read.
pub fn diff(a: &Path, b: &Path) -> Result<Changes, LabError> {
    let mut changes = Changes::default();
    let mut names = names(a)?;
    names.extend(self::names(b)?);
    for name in names {
        let (one, two) = (read(&a.join(&name))?, read(&b.join(&name))?);
        match (one, two) {
            (Some(one), Some(two)) => changes.compare(&name, &one, &two),
            (one, _) => {
                let which = if one.is_some() { a } else { b };
                let told = format!("{name} is only in {}", which.display());
                changes.files.push(told);
            }
        }
    }
    Ok(changes)
}

/// Names of the files of a folder that tell results.
fn names(dir: &Path) -> Result<BTreeSet<String>, LabError> {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(dir).map_err(Attempt::Read.on(dir))? {
        let entry = entry.map_err(Attempt::Read.on(dir))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let passed_over = name.starts_with('.') || PROVENANCE.contains(&name.as_str());
        if entry.path().is_file() && !passed_over {
            names.insert(name);
        }
    }
    Ok(names)
}

/// A file's text, if it is there.
fn read(path: &Path) -> Result<Option<String>, LabError> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(String::from_utf8_lossy(&bytes).into_owned())),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Attempt::Read.on(path)(error)),
    }
}

/// The first line, from 1, in which two texts that differ do so.
fn first_line(one: &str, two: &str) -> usize {
    let same = one.split('\n').zip(two.split('\n'));
    1 + same.take_while(|(one, two)| one == two).count()
}

/// The rows of a `runs.csv` by what names them.
struct Runs {
    /// The columns that name a run.
    named_by: Vec<String>,
    /// The other columns.
    columns: Vec<String>,
    rows: BTreeMap<Vec<String>, BTreeMap<String, String>>,
}

impl Runs {
    /// None where the text is no such table.
    fn read(text: &str) -> Option<Self> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header: Vec<String> = reader.headers().ok()?.iter().map(String::from).collect();
        let outcome = header.iter().position(|name| name == OUTCOME)?;
        if !header[..outcome].iter().take(NAMED_BY.len()).eq(NAMED_BY) {
            return None;
        }
        let mut rows = BTreeMap::new();
        for row in reader.records() {
            let row = row.ok()?;
            let name = row.iter().take(outcome).map(String::from).collect();
            let rest = header.iter().zip(&row).skip(outcome);
            let rest = rest.map(|(column, value)| (column.clone(), value.to_string()));
            rows.insert(name, rest.collect());
        }
        Some(Self {
            named_by: header[..outcome].to_vec(),
            columns: header[outcome..].to_vec(),
            rows,
        })
    }

    /// The MRF of each scenario at each point of what is varied, where all its drives were made.
    fn mrfs(&self) -> BTreeMap<Vec<String>, String> {
        let mut counts: BTreeMap<Vec<String>, Option<BTreeMap<u32, u32>>> = BTreeMap::new();
        for (name, row) in &self.rows {
            let [scenario, part, rate, _seed, varied @ ..] = name.as_slice() else {
                continue;
            };
            // Runs at rates that the estimate asked for are no search for an MRF.
            if part != "sweep" {
                continue;
            }
            let point = [std::slice::from_ref(scenario), varied].concat();
            let counts = counts.entry(point).or_insert_with(|| Some(BTreeMap::new()));
            let collided = match row.get(OUTCOME).map(String::as_str) {
                Some("collision") => Some(1),
                Some("completed") => Some(0),
                _ => None,
            };
            match (counts.as_mut(), rate.parse::<u32>(), collided) {
                (Some(counts), Ok(rate), Some(collided)) => {
                    *counts.entry(rate).or_insert(0) += collided;
                }
                _ => *counts = None,
            }
        }
        let mrf = |(point, counts): (_, Option<BTreeMap<u32, u32>>)| {
            let counts: Vec<(u32, u32)> = counts?.into_iter().collect();
            Some((point, required(&counts).mrf.to_string()))
        };
        counts.into_iter().filter_map(mrf).collect()
    }
}

impl Changes {
    /// Adds what changed in the file of this name from one text to the other.
    pub fn compare(&mut self, name: &str, one: &str, two: &str) {
        match name {
            _ if one == two => {}
            "runs.csv" => self.compare_runs(one, two),
            "claims.md" => self.compare_claims(one, two),
            _ => self.files.push(format!(
                "{name} differs from line {} on",
                first_line(one, two)
            )),
        }
    }

    fn compare_runs(&mut self, one: &str, two: &str) {
        let (Some(one), Some(two)) = (Runs::read(one), Runs::read(two)) else {
            self.files.push("runs.csv is no table of runs".to_string());
            return;
        };
        if one.named_by != two.named_by {
            let (one, two) = (one.named_by.join(", "), two.named_by.join(", "));
            self.runs.push(format!("named by {one} -> by {two}"));
            return;
        }
        let mrfs = two.mrfs();
        for (point, before) in one.mrfs() {
            if let Some(after) = mrfs.get(&point).filter(|after| **after != before) {
                self.mrfs
                    .push(format!("{}: {before} -> {after}", point.join(" ")));
            }
        }
        let mut differing: BTreeMap<&str, usize> = BTreeMap::new();
        for (name, before) in &one.rows {
            let Some(after) = two.rows.get(name) else {
                self.runs
                    .push(format!("{}: only in the first", name.join(" ")));
                continue;
            };
            let outcomes = (before.get(OUTCOME), after.get(OUTCOME));
            if let ((Some(before), Some(after)), true) = (outcomes, outcomes.0 != outcomes.1) {
                self.runs
                    .push(format!("{}: {before} -> {after}", name.join(" ")));
                continue;
            }
            for column in &one.columns {
                let differs = after
                    .get(column)
                    .is_some_and(|after| before.get(column) != Some(after));
                if differs && column != "replay" {
                    *differing.entry(column).or_default() += 1;
                }
            }
        }
        let new = two.rows.keys().filter(|name| !one.rows.contains_key(*name));
        self.runs
            .extend(new.map(|name| format!("{}: only in the second", name.join(" "))));
        let told =
            |(column, count)| format!("{column} differs in {count} of {} runs", one.rows.len());
        self.figures.extend(differing.into_iter().map(told));
        let only = |columns: &[String], others: &[String], which| -> Vec<String> {
            let only = columns.iter().filter(|column| !others.contains(column));
            only.map(|column| format!("column {column} is only in the {which}"))
                .collect()
        };
        self.figures
            .extend(only(&one.columns, &two.columns, "first"));
        self.figures
            .extend(only(&two.columns, &one.columns, "second"));
    }

    fn compare_claims(&mut self, one: &str, two: &str) {
        let verdicts = |text: &str| -> Vec<String> {
            let headings = text.lines().filter_map(|line| line.strip_prefix("## "));
            headings.map(String::from).collect()
        };
        let before = self.claims.len();
        let (first, second) = (verdicts(one), verdicts(two));
        let only = |of: &[String], others: &[String], sign: &str| -> Vec<String> {
            let only = of.iter().filter(|verdict| !others.contains(verdict));
            only.map(|verdict| format!("{sign} {verdict}")).collect()
        };
        self.claims.extend(only(&first, &second, "-"));
        self.claims.extend(only(&second, &first, "+"));
        if self.claims.len() == before {
            let line = first_line(one, two);
            self.claims.push(format!(
                "the same verdicts; claims.md differs from line {line} on"
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "scenario,part,fpr_hz,seed,x,outcome,gap_m,replay\n";

    fn folder(runs: &str, claims: &str) -> tempfile::TempDir {
        let dir = tempfile::tempdir().unwrap();
        fs::write(dir.path().join("runs.csv"), format!("{HEADER}{runs}")).unwrap();
        fs::write(dir.path().join("claims.md"), claims).unwrap();
        fs::write(dir.path().join("plan.json"), claims).unwrap();
        dir
    }

    #[test]
    fn hand_an_outcome_that_changes_moves_the_mrf() {
        let runs = "a,sweep,1,0,7,collision,,r\na,sweep,2,0,7,completed,3.0,r\na,sweep,3,0,7,completed,4.0,r\n";
        let one = folder(runs, "## 1. MRFs: holds\nmore\n");
        assert!(diff(one.path(), one.path()).unwrap().is_empty());
        let moved = runs.replace("2,0,7,completed,3.0,r", "2,0,7,collision,,s");
        let moved = moved.replace("4.0", "4.5");
        let two = folder(&moved, "## 1. MRFs: does not hold\nmore\n");
        fs::write(two.path().join("table1.md"), "").unwrap();
        let changes = diff(one.path(), two.path()).unwrap();
        let expected = Changes {
            mrfs: vec!["a 7: 2 -> 3".into()],
            runs: vec!["a sweep 2 0 7: completed -> collision".into()],
            figures: vec!["gap_m differs in 1 of 3 runs".into()],
            claims: vec!["- 1. MRFs: holds".into(), "+ 1. MRFs: does not hold".into()],
            files: vec![format!("table1.md is only in {}", two.path().display())],
        };
        assert_eq!(changes, expected);
        assert!(
            changes
                .to_string()
                .starts_with("MRFs:\n  a 7: 2 -> 3\nruns:\n")
        );
    }

    #[test]
    fn hand_rows_elsewhere_and_other_replays_are_no_change_and_others_are() {
        let runs = [
            "a,sweep,1,0,7,completed,1,r\n",
            "a,sweep,1,1,7,completed,2,r\n",
        ];
        let one = folder(&runs.concat(), "");
        let turned = [runs[1], runs[0]].concat().replace(",r\n", ",s\n");
        assert!(
            diff(one.path(), folder(&turned, "").path())
                .unwrap()
                .is_empty()
        );
        let fewer = diff(one.path(), folder(runs[1], "").path()).unwrap();
        assert_eq!(fewer.runs, ["a sweep 1 0 7: only in the first"]);
        let refused = turned.replace("1,7,completed,2", "1,7,refused,");
        let refused = diff(one.path(), folder(&refused, "").path()).unwrap();
        assert_eq!(refused.runs, ["a sweep 1 1 7: completed -> refused"]);
        assert!(refused.mrfs.is_empty());
    }
}
