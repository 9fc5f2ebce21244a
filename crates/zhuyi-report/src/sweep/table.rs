//! A table of runs, as `zhuyi sweep` and `zhuyi reproduce` write it, read back.
//!
//! Read are the columns `scenario`, `part`, `fpr_hz`, `seed`, `outcome`, `collision_time_s`, `collision_actor`,
//! `impact_speed_mps`, `smallest_gap_m`, `smallest_ttc_s`, `largest_estimate_fpr` and `replay`, in any order; others are passed
//! over. Runs outside the grid, with a rate of its own for each camera or of another part, are counted and left out.

use csv::{Reader, StringRecord};

/// One run of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its scenario.
    pub scenario: String,
    /// [Hz] the rate of all cameras.
    pub fpr: u32,
    /// Which of the random drives.
    pub seed: u64,
    /// The first contact.
    pub collision: Option<Contact>,
    /// [m] smallest gap to an actor ahead in the ego's way.
    pub gap: Option<f64>,
    /// [s] smallest time to collision with one.
    pub ttc: Option<f64>,
    /// [FPR] the largest demand on an analysed camera.
    pub estimate: Option<f64>,
    /// The command that makes it again.
    pub replay: String,
}

/// A contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// [s] when.
    pub time: f64,
    /// Whom.
    pub actor: String,
    /// [m/s] how fast; none where the crash could not be worked out.
    pub impact: Option<f64>,
}

/// A table of runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The runs of the grid, in the order of the file.
    pub rows: Vec<Row>,
    /// How many others there are.
    pub others: usize,
}

/// Why a text is no table of runs.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InvalidTable {
    /// A column that is not there.
    #[error("it has no column `{0}`")]
    Column(&'static str),
    /// A line that is no row.
    #[error("line {line}: {what}")]
    Line {
        /// Which.
        line: u64,
        /// What is wrong.
        what: String,
    },
    /// A sweep of more than rates and seeds.
    #[error(
        "it varies `{0}`; a report shows a grid of rates and seeds: keep the rows of one value and drop the column"
    )]
    Varied(String),
    /// Nothing to show.
    #[error("it has no run of a grid of rates and seeds")]
    Empty,
}

/// The columns, each at its place.
const COLUMNS: [&str; 12] = [
    "scenario",
    "part",
    "fpr_hz",
    "seed",
    "outcome",
    "collision_time_s",
    "collision_actor",
    "impact_speed_mps",
    "smallest_gap_m",
    "smallest_ttc_s",
    "largest_estimate_fpr",
    "replay",
];

impl Table {
    /// The table that a text holds.
    ///
    /// # Errors
    /// The first thing that is wrong with it.
    pub fn read(text: &str) -> Result<Self, InvalidTable> {
        let mut reader = Reader::from_reader(text.as_bytes());
        let broken = |error: csv::Error| InvalidTable::Line {
            line: error.position().map_or(1, csv::Position::line),
            what: error.to_string(),
        };
        let header = reader.headers().map_err(broken)?.clone();
        let mut places = [0; COLUMNS.len()];
        for (place, name) in places.iter_mut().zip(COLUMNS) {
            let found = header.iter().position(|column| column == name);
            *place = found.ok_or(InvalidTable::Column(name))?;
        }
        // What a sweep varies stands between the seed and the outcome.
        let varied = header.iter().take(places[4]).nth(places[3] + 1);
        if let Some(varied) = varied {
            return Err(InvalidTable::Varied(varied.to_string()));
        }
        let mut table = Self::default();
        for record in reader.records() {
            let record = record.map_err(broken)?;
            match Fields(&record, places).row()? {
                Some(row) => table.rows.push(row),
                None => table.others += 1,
            }
        }
        if table.rows.is_empty() {
            return Err(InvalidTable::Empty);
        }
        Ok(table)
    }
}

/// A line, with the places of the columns.
struct Fields<'a>(&'a StringRecord, [usize; COLUMNS.len()]);

impl Fields<'_> {
    fn at(&self, column: usize) -> &str {
        self.0.get(self.1[column]).unwrap_or("")
    }

    fn wrong(&self, column: usize, expected: &str) -> InvalidTable {
        InvalidTable::Line {
            line: self.0.position().map_or(1, csv::Position::line),
            what: format!(
                "expected {expected} as {}, got `{}`",
                COLUMNS[column],
                self.at(column)
            ),
        }
    }

    /// A finite number, or none for an empty field.
    fn number(&self, column: usize) -> Result<Option<f64>, InvalidTable> {
        let text = self.at(column);
        if text.is_empty() {
            return Ok(None);
        }
        let number = text.parse().ok().filter(|number: &f64| number.is_finite());
        number
            .map(Some)
            .ok_or_else(|| self.wrong(column, "a number"))
    }

    /// The run; none where it is not of the grid.
    fn row(&self) -> Result<Option<Row>, InvalidTable> {
        let Ok(fpr) = self.at(2).parse() else {
            // Rates by the names of cameras.
            return if self.at(2).contains('=') {
                Ok(None)
            } else {
                Err(self.wrong(2, "a whole rate, or rates by camera"))
            };
        };
        if self.at(1) != "sweep" {
            return Ok(None);
        }
        let collision = match self.at(4) {
            "completed" => None,
            "collision" => Some(Contact {
                time: self.number(5)?.ok_or_else(|| self.wrong(5, "a time"))?,
                actor: self.at(6).to_string(),
                impact: self.number(7)?,
            }),
            // A run that could not be made, with its reason in another column.
            "refused" | "failed" => return Ok(None),
            _ => return Err(self.wrong(4, "`completed`, `collision`, `refused` or `failed`")),
        };
        Ok(Some(Row {
            scenario: self.at(0).to_string(),
            fpr,
            seed: (self.at(3).parse()).map_err(|_| self.wrong(3, "a whole number"))?,
            collision,
            gap: self.number(8)?,
            ttc: self.number(9)?,
            estimate: self.number(10)?,
            replay: self.at(11).to_string(),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::{COLUMNS, Contact, InvalidTable, Table};

    fn table(lines: &[&str]) -> Result<Table, InvalidTable> {
        Table::read(&(COLUMNS.join(",") + "\n" + &lines.join("\n") + "\n"))
    }

    #[test]
    fn hand_runs_of_the_grid_are_read_and_others_counted() {
        let read = table(&[
            "cut-in,sweep,4,7,collision,8.25,cutter,2.5,0.1,,,zhuyi run cut-in --fpr 4 --seed 7",
            "cut-in,rerun_own,4,7,completed,,,,1,2,3,x",
            "cut-in,sweep,\"front_120=4,left=1\",7,completed,,,,1,2,3,x",
        ])
        .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((read.rows.len(), read.others), (1, 2));
        let contact = Contact {
            time: 8.25,
            actor: "cutter".into(),
            impact: Some(2.5),
        };
        assert_eq!(read.rows[0].collision, Some(contact));
        assert_eq!((read.rows[0].fpr, read.rows[0].seed), (4, 7));
        assert_eq!((read.rows[0].gap, read.rows[0].ttc), (Some(0.1), None));
    }

    #[test]
    fn hand_runs_that_were_not_made_are_counted_and_a_varied_parameter_is_refused() {
        let read = table(&[
            "cut-in,sweep,4,7,completed,,,,1,2,3,x",
            "cut-in,sweep,4,8,refused,,,,,,,x",
            "cut-in,sweep,4,9,failed,,,,,,,x",
        ])
        .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((read.rows.len(), read.others), (1, 2));
        let header = COLUMNS
            .join(",")
            .replace("seed,outcome", "seed,planner.min_gap_m,outcome");
        assert_eq!(
            Table::read(&(header + "\n")),
            Err(InvalidTable::Varied("planner.min_gap_m".into()))
        );
    }

    #[test]
    fn hand_what_is_no_table_is_refused_with_its_line() {
        assert_eq!(
            Table::read("a,b\n1,2\n"),
            Err(InvalidTable::Column("scenario"))
        );
        assert_eq!(table(&[]), Err(InvalidTable::Empty));
        for (line, told) in [
            (
                "cut-in,sweep,4,7,exploded,,,,,,,x",
                "line 2: expected `completed`, `collision`, `refused` or `failed` as outcome, got `exploded`",
            ),
            (
                "cut-in,sweep,four,7,completed,,,,,,,x",
                "line 2: expected a whole rate, or rates by camera as fpr_hz, got `four`",
            ),
            (
                "cut-in,sweep,4,7,completed,,,,NaN,,,x",
                "line 2: expected a number as smallest_gap_m, got `NaN`",
            ),
        ] {
            let error = table(&[line]).err().map(|error| error.to_string());
            assert_eq!(error.as_deref(), Some(told));
        }
    }
}
