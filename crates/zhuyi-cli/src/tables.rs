//! Tables on the terminal.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, presets};

/// Columns of the narrowest terminal to which a table is fitted; some tell that they have none.
const NARROWEST: u16 = 60;

/// A table with this header, as wide as its content or a narrower terminal. Columns at `right` hold numbers.
pub fn table(header: &[&str], right: &[usize]) -> Table {
    let rule = LineStyle::none().fill('-').junction('-');
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING.header_separator(rule))
        .set_header(header.iter().copied());
    if table.width().is_some_and(|columns| columns >= NARROWEST) {
        table.set_content_arrangement(ContentArrangement::Dynamic);
    }
    for index in right {
        if let Some(column) = table.column_mut(*index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}
