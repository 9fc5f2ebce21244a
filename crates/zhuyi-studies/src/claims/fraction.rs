//! Claim 3: the fraction of the frames of all analysed cameras at 30 FPR is at most 0.36.

use super::{Claim, Verdict};
use crate::reproduce::table::Table;
use zhuyi_batch::text::{cells, markdown_table};

/// [-] the paper's bound.
const BOUND: f64 = 0.36;

pub(super) fn claim(table: &Table) -> Claim {
    let within = |fraction: Option<f64>| fraction.is_some_and(|fraction| fraction <= BOUND);
    let holding = table.rows.iter().filter(|row| within(row.fraction)).count();
    let lines = table.rows.iter().map(|row| {
        let number = |value: Option<f64>, digits: usize| {
            value.map_or("N/A".to_string(), |value| format!("{value:.digits$}"))
        };
        let paper = row.paper.as_ref();
        vec![
            row.scenario.clone(),
            number(row.largest_sum, 2),
            number(row.fraction, 4),
            paper.map_or(String::new(), |paper| paper.max_sum.to_string()),
            paper.map_or(String::new(), |paper| format!("{:.2}", paper.fraction)),
            if within(row.fraction) {
                "within"
            } else {
                "above"
            }
            .to_string(),
        ]
    });
    let lines: Vec<_> = lines.collect();
    let header = cells(&[
        "scenario",
        "sum, ours",
        "fraction, ours",
        "sum, paper",
        "fraction, paper",
        "0.36",
    ]);
    Claim {
        number: "3",
        title: "The fraction is at most 0.36 in every scenario",
        verdict: Verdict::holds_if(holding == table.rows.len()),
        figures: format!(
            "{holding} of {} scenarios are within, compared unrounded",
            table.rows.len()
        ),
        details: format!(
            "{}\n0.36 is (30 + 1 + 1) / 90 = 0.3556: one camera at the clamp of 30 FPR, the others at rest. A scenario without a safe \
             rate has no fraction and counts as above.\n",
            markdown_table(&header, &lines)
        ),
    }
}
