//! Files of checks by others: `../shared/data/checks` beside the repository.

use std::fs;
use std::path::Path;

/// The rows of a file of checks, by the names in its header.
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// One row of a [`Table`].
#[derive(Clone, Copy)]
pub struct Row<'a> {
    header: &'a [String],
    cells: &'a [String],
}

impl Table {
    /// None where the folder does not exist.
    #[expect(clippy::print_stdout, reason = "a skipped test says so")]
    pub fn read(file: &str) -> Option<Self> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../../shared/data/checks")
            .join(file);
        let Ok(text) = fs::read_to_string(path) else {
            println!("skipped: ../shared/data/checks/{file} is not there");
            return None;
        };
        let mut lines = text.lines().map(split);
        let header = lines.next().expect("a header");
        Some(Self {
            header,
            rows: lines.collect(),
        })
    }

    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|cells| Row {
            header: &self.header,
            cells,
        })
    }
}

impl<'a> Row<'a> {
    pub fn text(&self, column: &str) -> &'a str {
        let place = self.header.iter().position(|name| name == column);
        &self.cells[place.expect(column)]
    }

    pub fn number(&self, column: &str) -> f64 {
        self.text(column).parse().expect(column)
    }

    /// [m/s] a column in km/h.
    pub fn speed(&self, column: &str) -> f64 {
        self.number(column) / 3.6
    }
}

/// Cells of a line; a quoted cell may hold commas.
fn split(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().expect("a cell").push(c),
        }
    }
    cells
}
