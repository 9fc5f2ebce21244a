//! The tables of the page `columns.md`.
//!
//! ```text
//! ## name             a table
//! what it is          the first line of text below
//! | `column` | type | unit | meaning |
//! ```
//!
//! The metrics of `criticality` come from their registry.

use zhuyi_batch::columns::{Column, Kind, Table};
use zhuyi_metrics::criticality::{METRICS, Metric};

/// The page.
const PAGE: &str = include_str!("columns.md");

/// Version of all these tables.
const VERSION: u32 = 1;

/// All of them, in the order of the page.
pub fn tables() -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    for line in PAGE.lines() {
        if let Some(name) = line.strip_prefix("## ") {
            tables.push(Table {
                name,
                version: VERSION,
                meaning: "".into(),
                columns: Vec::new(),
            });
        } else if let Some(table) = tables.last_mut() {
            match column(line) {
                Some(column) => table.columns.push(column),
                None if table.meaning.is_empty() => table.meaning = line.into(),
                None => {}
            }
        }
    }
    if let Some(table) = tables.iter_mut().find(|table| table.name == "criticality") {
        let column = |metric: Metric| {
            let Metric {
                id, unit, meaning, ..
            } = metric;
            Column::fixed(id, Kind::Number, unit, meaning)
        };
        table.columns.extend(METRICS.map(column));
    }
    tables
}

/// The column that a line tells of, if it does.
fn column(line: &'static str) -> Option<Column> {
    let line = line.strip_prefix("| `")?.strip_suffix(" |")?;
    let (name, rest) = line.split_once("` |")?;
    let mut cells = rest.splitn(3, '|').map(str::trim);
    let kinds = [Kind::Text, Kind::Whole, Kind::Number, Kind::Truth];
    let kind = cells.next()?;
    let kind = kinds.into_iter().find(|known| known.name() == kind)?;
    Some(Column::fixed(name, kind, cells.next()?, cells.next()?))
}

#[cfg(test)]
mod tests {
    use super::{METRICS, PAGE, tables};
    use zhuyi_estimator::State;

    #[test]
    fn law_every_line_of_the_page_is_read() {
        let lines = |start: &str| PAGE.lines().filter(|line| line.starts_with(start)).count();
        let tables = tables();
        let columns: usize = tables.iter().map(|table| table.columns.len()).sum();
        let columns = columns - METRICS.len();
        assert_eq!((tables.len(), columns), (lines("## "), lines("| `")));
        let names: std::collections::BTreeSet<&str> =
            tables.iter().map(|table| table.name).collect();
        assert_eq!(names.len(), tables.len(), "each once");
        for table in tables {
            assert!(
                !table.meaning.is_empty() && !table.columns.is_empty(),
                "{table:?}"
            );
        }
    }

    #[test]
    fn law_tables_of_states_name_all_of_them() {
        let names = State::ALL.map(State::name);
        let (last, others) = names.split_last().unwrap();
        let list = format!("{} or {last}", others.join(", "));
        let mut lists = 0;
        for table in tables() {
            for column in table.columns.iter().filter(|column| column.name == "state") {
                assert_eq!(column.meaning, list, "{}", table.name);
                lists += 1;
            }
            if table.name == "egos" {
                let columns = table.columns.iter().map(|column| &*column.name);
                let states: Vec<&str> = columns.filter(|name| names.contains(name)).collect();
                assert_eq!(states, names);
            }
        }
        assert_eq!(lists, 2);
    }
}
