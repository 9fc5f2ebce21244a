//! What `zhuyi reproduce` prints: the table in brief and the verdicts.

use std::fmt::Write as _;

use crate::reproduce::plan::Plan;
use crate::reproduce::table::{Row, Table};
use zhuyi_batch::claim::Claim;
use zhuyi_batch::text::{cells, markdown_table};

/// The summary, without a line end of its own at the end.
pub fn text(plan: &Plan, table: &Table, claims: &[Claim]) -> String {
    let header = cells(&[
        "scenario", "MRF", "paper", "sum", "paper", "fraction", "paper",
    ]);
    let line = |row: &Row| {
        let paper = |figure: fn(&crate::reproduce::paper::Row) -> String| {
            row.paper.as_ref().map_or(String::new(), figure)
        };
        vec![
            row.scenario.clone(),
            row.required.mrf.to_string(),
            paper(|paper| paper.mrf.to_string()),
            row.largest_sum
                .map_or("N/A".to_string(), |sum| format!("{sum:.1}")),
            paper(|paper| paper.max_sum.to_string()),
            row.fraction
                .map_or("N/A".to_string(), |fraction| format!("{fraction:.3}")),
            paper(|paper| format!("{:.2}", paper.fraction)),
        ]
    };
    let lines: Vec<_> = table.rows.iter().map(line).collect();
    let mut text = format!("{}\n\n{}\n", plan.spelt(), markdown_table(&header, &lines));
    for Claim {
        number,
        title,
        verdict,
        figures,
        ..
    } in claims
    {
        let _ = writeln!(text, "claim {number:<2} {verdict:<11} {title}. {figures}.");
    }
    text.trim_end().to_string()
}
