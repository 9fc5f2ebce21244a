//! Results that are there already, read back to be drawn: table1.csv, allocation.csv and mrf_per_camera.csv.
//!
//! Columns are found by their names, so one more does no harm. Left out: whether a file belongs to this program's version, which
//! the `--check` of the command that wrote it tells.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Why a result cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum CommittedError {
    /// It is not there.
    #[error("`{}` is missing; `{command}` makes it", path.display())]
    Missing {
        /// Which.
        path: PathBuf,
        /// What makes it.
        command: &'static str,
    },
    /// It is there and cannot be read.
    #[error("cannot read `{}`: {source}", path.display())]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// It is not what the command writes.
    #[error("`{}`, line {line}: {what}; `{command}` makes it anew", path.display())]
    Content {
        /// Which.
        path: PathBuf,
        /// The line, from 1.
        line: u64,
        /// What is wrong.
        what: String,
        /// What makes it.
        command: &'static str,
    },
}

/// A cell of the table, ours and the paper's [FPR]; none where there is no such figure.
#[derive(Clone, Debug, PartialEq)]
pub struct TableRow {
    /// The scenario.
    pub scenario: String,
    /// As in the file: `mrf`, `est_6`, `max_sum`, `fraction`, ..
    pub quantity: String,
    /// `exact` or `paper`; empty where no solver enters.
    pub solver: String,
    /// As in the file: a number, nothing, or `>30`.
    pub ours: String,
    /// The same of the paper.
    pub paper: String,
}

/// What a policy came to at a budget, over all scenarios.
#[derive(Clone, Debug, PartialEq)]
pub struct Spent {
    /// Its name.
    pub policy: String,
    /// [FPR] the budget over all cameras.
    pub budget: f64,
    /// How many drives.
    pub drives: u32,
    /// How many of them collided.
    pub collisions: u32,
}

/// The slowest safe rates of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Slowest {
    /// The scenario.
    pub scenario: String,
    /// The cameras.
    pub cameras: Vec<String>,
    /// [FPR] the MRF of all cameras at the same rate; none where even the highest collides.
    pub mrf: Option<u32>,
    /// [FPR] the combinations of the Pareto frontier, a rate for each camera.
    pub frontier: Vec<Vec<u32>>,
}

/// A file of rows.
struct Rows {
    path: PathBuf,
    command: &'static str,
    header: csv::StringRecord,
    records: Vec<csv::StringRecord>,
}

impl Rows {
    fn read(dir: &Path, file: &str, command: &'static str) -> Result<Self, CommittedError> {
        let path = dir.join(file);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(CommittedError::Missing { path, command });
            }
            Err(source) => return Err(CommittedError::Read { path, source }),
        };
        Self::parse(path, &text, command)
    }

    fn parse(path: PathBuf, text: &str, command: &'static str) -> Result<Self, CommittedError> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let read = |reader: &mut csv::Reader<&[u8]>| -> csv::Result<_> {
            let header = reader.headers()?.clone();
            Ok((header, reader.records().collect::<Result<_, _>>()?))
        };
        match read(&mut reader) {
            Ok((header, records)) => Ok(Self {
                path,
                command,
                header,
                records,
            }),
            Err(error) => Err(CommittedError::Content {
                path,
                line: error.position().map_or(1, csv::Position::line),
                what: "not a row of CSV as long as the first".to_string(),
                command,
            }),
        }
    }

    fn wrong(&self, line: u64, what: String) -> CommittedError {
        CommittedError::Content {
            path: self.path.clone(),
            line,
            what,
            command: self.command,
        }
    }

    fn column(&self, name: &str) -> Result<usize, CommittedError> {
        let place = self.header.iter().position(|column| column == name);
        place.ok_or_else(|| self.wrong(1, format!("no column `{name}`")))
    }

    fn number<T: FromStr>(
        &self,
        row: &csv::StringRecord,
        column: usize,
    ) -> Result<T, CommittedError> {
        row[column].parse().map_err(|_| {
            let line = row.position().map_or(1, csv::Position::line);
            let name = &self.header[column];
            self.wrong(
                line,
                format!("`{}` is no number for `{name}`", &row[column]),
            )
        })
    }
}

/// The rows of table1.csv in a folder of results.
///
/// # Errors
/// When it is missing, cannot be read, or is something else.
pub fn table(dir: &Path) -> Result<Vec<TableRow>, CommittedError> {
    table_of(&Rows::read(dir, "table1.csv", "zhuyi reproduce")?)
}

fn table_of(file: &Rows) -> Result<Vec<TableRow>, CommittedError> {
    let names = ["scenario", "quantity", "solver", "ours", "paper"];
    let mut places = [0; 5];
    for (place, name) in places.iter_mut().zip(names) {
        *place = file.column(name)?;
    }
    let row = |row: &csv::StringRecord| {
        let [scenario, quantity, solver, ours, paper] = places.map(|place| row[place].to_string());
        TableRow {
            scenario,
            quantity,
            solver,
            ours,
            paper,
        }
    };
    Ok(file.records.iter().map(row).collect())
}

/// The rows of allocation.csv in a folder of results that are of all scenarios together, in their order.
///
/// # Errors
/// When it is missing, cannot be read, or is something else.
pub fn spent(dir: &Path) -> Result<Vec<Spent>, CommittedError> {
    spent_of(&Rows::read(
        dir,
        "allocation.csv",
        "zhuyi allocate --out results",
    )?)
}

fn spent_of(file: &Rows) -> Result<Vec<Spent>, CommittedError> {
    let [scenario, policy] = [file.column("scenario")?, file.column("policy")?];
    let budget = file.column("budget_fps")?;
    let [drives, collisions] = [file.column("drives")?, file.column("collisions")?];
    let all = file.records.iter().filter(|row| &row[scenario] == "all");
    let one = |row: &csv::StringRecord| {
        Ok(Spent {
            policy: row[policy].to_string(),
            budget: file.number(row, budget)?,
            drives: file.number(row, drives)?,
            collisions: file.number(row, collisions)?,
        })
    };
    all.map(one).collect()
}

/// What mrf_per_camera.csv in a folder of results says of each scenario, by the search.
///
/// # Errors
/// When it is missing, cannot be read, or is something else.
pub fn slowest(dir: &Path) -> Result<Vec<Slowest>, CommittedError> {
    let command = "zhuyi mrf --per-camera --out results";
    slowest_of(&Rows::read(dir, "mrf_per_camera.csv", command)?)
}

fn slowest_of(file: &Rows) -> Result<Vec<Slowest>, CommittedError> {
    let [scenario, method] = [file.column("scenario")?, file.column("method")?];
    let [quantity, value] = [file.column("quantity")?, file.column("value")?];
    let columns = file.header.iter().enumerate();
    let cameras: Vec<(usize, String)> = columns
        .filter_map(|(place, name)| Some((place, name.strip_suffix("_hz")?.to_string())))
        .collect();
    let mut all: Vec<Slowest> = Vec::new();
    for row in file.records.iter().filter(|row| &row[method] == "search") {
        if all.last().is_none_or(|last| last.scenario != row[scenario]) {
            all.push(Slowest {
                scenario: row[scenario].to_string(),
                cameras: cameras.iter().map(|(_, name)| name.clone()).collect(),
                mrf: None,
                frontier: Vec::new(),
            });
        }
        let Some(last) = all.last_mut() else { continue };
        match &row[quantity] {
            "mrf_hz" => last.mrf = row[value].trim_start_matches("<=").parse().ok(),
            "frontier" => {
                let rates = cameras.iter().map(|(place, _)| file.number(row, *place));
                last.frontier.push(rates.collect::<Result<_, _>>()?);
            }
            _ => {}
        }
    }
    Ok(all)
}

/// What a text is, read as each of the three files.
#[derive(Debug)]
pub struct Content {
    /// As table1.csv.
    pub table: Result<Vec<TableRow>, CommittedError>,
    /// As allocation.csv.
    pub spent: Result<Vec<Spent>, CommittedError>,
    /// As mrf_per_camera.csv.
    pub slowest: Result<Vec<Slowest>, CommittedError>,
}

impl Content {
    /// Of a text, without a file.
    ///
    /// # Errors
    /// When it is no CSV.
    pub fn of(text: &str) -> Result<Self, CommittedError> {
        let file = Rows::parse(PathBuf::from("text"), text, "zhuyi")?;
        Ok(Self {
            table: table_of(&file),
            spent: spent_of(&file),
            slowest: slowest_of(&file),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(file: &str, text: &str) -> tempfile::TempDir {
        let dir = tempfile::tempdir().unwrap();
        fs::write(dir.path().join(file), text).unwrap();
        dir
    }

    #[test]
    fn hand_a_missing_result_says_what_makes_it() {
        let dir = tempfile::tempdir().unwrap();
        let told = spent(dir.path()).unwrap_err().to_string();
        assert!(
            told.ends_with("is missing; `zhuyi allocate --out results` makes it"),
            "{told}"
        );
    }

    #[test]
    fn hand_only_all_scenarios_together_are_spent() {
        let text = "scenario,policy,rates,drives,collisions,budget_fps\ncut-in,uniform,,10,9,5.0\nall,uniform,,90,40,5.0000\n";
        let dir = folder("allocation.csv", text);
        let expected = Spent {
            policy: "uniform".into(),
            budget: 5.0,
            drives: 90,
            collisions: 40,
        };
        assert_eq!(spent(dir.path()).unwrap(), [expected]);
        let dir = folder("allocation.csv", &text.replace("40", "many"));
        let told = spent(dir.path()).unwrap_err().to_string();
        assert!(
            told.contains("line 3: `many` is no number for `collisions`"),
            "{told}"
        );
        let dir = folder("allocation.csv", "scenario,policy\n");
        let told = spent(dir.path()).unwrap_err().to_string();
        assert!(told.contains("line 1: no column `budget_fps`"), "{told}");
    }

    #[test]
    fn hand_the_frontier_is_that_of_the_search() {
        let text = "scenario,method,quantity,front_120_hz,left_hz,value\ncut-out,search,mrf_hz,,,2\n\
                    cut-out,search,frontier,2,1,3\ncut-out,brute_force,frontier,9,9,18\ncut-in,search,mrf_hz,,,>30\n";
        let dir = folder("mrf_per_camera.csv", text);
        let found = slowest(dir.path()).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!(
            (found[0].mrf, &found[0].frontier),
            (Some(2), &vec![vec![2, 1]])
        );
        assert_eq!(found[0].cameras, ["front_120", "left"]);
        assert_eq!((found[1].mrf, found[1].frontier.len()), (None, 0));
    }
}
