//! How tables are spelt: Markdown with aligned columns, rows of CSV.

/// A Markdown table: every row as long as the header, columns padded to line up in plain text.
pub fn markdown_table(header: &[String], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.fold(header[column].chars().count().max(3), usize::max)
    };
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    let joined = |cells: Vec<String>| format!("|{}|\n", cells.join("|"));
    let line = |cells: &[String]| {
        let padded = |(cell, width): (&String, &usize)| format!(" {cell:<width$} ");
        joined(cells.iter().zip(&widths).map(padded).collect())
    };
    let rule = joined(widths.iter().map(|width| "-".repeat(width + 2)).collect());
    let body: String = rows.iter().map(|row| line(row)).collect();
    format!("{}{rule}{body}", line(header))
}

/// Words as cells.
pub fn cells(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_string()).collect()
}

/// A row of CSV with its line end (RFC 4180): quotes where a field needs them.
pub fn csv_row<'a>(fields: impl IntoIterator<Item = &'a str>) -> String {
    let quoted = |field: &str| {
        if field.contains(['"', ',', '\n', '\r']) {
            format!("\"{}\"", field.replace('"', "\"\""))
        } else {
            field.to_string()
        }
    };
    let fields: Vec<String> = fields.into_iter().map(quoted).collect();
    format!("{}\n", fields.join(","))
}

/// A number with fixed decimals, or nothing.
pub fn decimals(number: Option<f64>, digits: usize) -> String {
    number.map_or(String::new(), |number| format!("{number:.digits$}"))
}

/// A number as short as it can be with two decimals: `6`, `7.59`.
pub fn at_most_two_decimals(number: f64) -> String {
    ((number * 100.0).round() / 100.0).to_string()
}

/// How many of what: `1 seed`, `2 seeds`. `one` takes an s where there are not one.
pub fn counted(count: impl Into<u64>, one: &str) -> String {
    match count.into() {
        1 => format!("1 {one}"),
        count => format!("{count} {one}s"),
    }
}

/// `a, b and c`.
pub fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Rates in ascending order, neighbours drawn together: `1 to 10, 15, 30`.
pub fn spans(rates: &[u32]) -> String {
    let spans = rates.chunk_by(|a, b| a + 1 == *b).map(|span| match span {
        [first, .., last] => format!("{first} to {last}"),
        _ => span.iter().map(u32::to_string).collect(),
    });
    spans.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_columns_line_up() {
        let table = markdown_table(&cells(&["a", "long name"]), &[cells(&["wide cell", "1"])]);
        assert_eq!(
            table,
            "| a         | long name |\n|-----------|-----------|\n| wide cell | 1         |\n"
        );
    }

    #[test]
    fn hand_a_reader_of_csv_gets_back_what_was_written() {
        let fields = ["plain", "with, comma", "with \"quotes\"", "", "two\nlines"];
        let row = csv_row(fields);
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(row.as_bytes());
        let read = reader.records().next().unwrap().unwrap();
        assert_eq!(read.iter().collect::<Vec<_>>(), fields);
        assert!(row.starts_with("plain,"));
    }

    #[test]
    fn hand_neighbouring_rates_are_drawn_together() {
        assert_eq!(spans(&[1, 2, 3, 15, 30]), "1 to 3, 15, 30");
        assert_eq!(spans(&[]), "");
    }

    #[test]
    fn hand_one_is_singular_and_whole_numbers_have_no_point() {
        assert_eq!(
            [0_u64, 1, 2].map(|n| counted(n, "seed")),
            ["0 seeds", "1 seed", "2 seeds"]
        );
        assert_eq!(
            [6.0, 7.592_94, 50.0 / 3.6 * 3.6].map(at_most_two_decimals),
            ["6", "7.59", "50"]
        );
    }
}
