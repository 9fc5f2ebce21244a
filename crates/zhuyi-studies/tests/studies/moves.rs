use zhuyi_studies::robustness;

use crate::small::{cut_short, plan};

#[test]
fn law_every_variation_and_block_has_a_line() {
    let plan = cut_short(plan(&["front-right-activity-1"], &[30], 1), 2);
    let results = robustness(&plan, &());
    let [("robustness.md", page)] = results.files.as_slice() else {
        panic!("{:?}", results.files)
    };
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let lines: Vec<String> = page
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(words)
        .collect();
    // Two tables with header, rule and the paper's own line: 15 variations, 20 blocks.
    assert_eq!(lines.len(), 2 * 3 + 15 + 20, "{page}");
    for line in [
        "| the paper's | | 1 | |",
        "| nothing | | **<=30** | 0 of 1 |",
        "| distances | x 0.90 | **<=30** | 0 of 1 |",
        "| headway | +0.2 s | **<=30** | 0 of 1 |",
        "| seeds | 3000 to 3000 | **<=30** | 0 of 1 |",
        "| seeds | 3019 to 3019 | **<=30** | 0 of 1 |",
    ] {
        assert!(
            lines.iter().any(|found| found == line),
            "no line {line} in\n{page}"
        );
    }
    // Only 30 FPR is tested, so that the MRF is 30 or less, not 1. 0 of 20: 3.8415 / (20 + 3.8415) = 0.16.
    let sentence = "0 of 20 blocks of 1 fresh seeds give every MRF as published (95 % Wilson interval of the share: 0.00 to 0.16).";
    assert!(results.summary.starts_with(sentence), "{}", results.summary);
    assert!(
        results
            .summary
            .ends_with("front-right-activity-1: <=30 in 20."),
        "{}",
        results.summary
    );
}
