//! Tables on the terminal.

use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, presets};

/// A table with this header, as wide as its content or a narrower terminal. Columns at `right` hold numbers.
pub fn table(header: &[&str], right: &[usize]) -> Table {
    let rule = LineStyle::none().fill('-').junction('-');
    let mut table = Table::new();
    table
        .set_content_arrangement(ContentArrangement::Dynamic)
        .load_style(presets::NOTHING.header_separator(rule))
        .set_header(header.iter().copied());
    for index in right {
        if let Some(column) = table.column_mut(*index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    table
}
