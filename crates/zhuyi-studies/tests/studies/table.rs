use zhuyi_batch::estimators::TABLE;
use zhuyi_batch::mrf::Mrf;
use zhuyi_studies::reproduce::page;
use zhuyi_studies::reproduce::table::Table;

use crate::small::Came::{Asked, Collided};
use crate::small::{plan, records};

#[test]
fn hand_a_cell_is_the_mean_over_its_runs_and_none_where_one_collided() {
    // Three seeds at each rate; at 3 FPR one of them collides.
    let plan = plan(&["cut-out"], &[2, 3, 4, 30], 3);
    #[rustfmt::skip]
    let came = [
        Asked(9.0), Asked(9.0), Asked(30.0), // free of collisions, but below the MRF
        Asked(9.0), Collided, Asked(9.0),
        Asked(4.0), Asked(5.0), Asked(30.0),
        Asked(3.0), Asked(3.5), Asked(4.0),
    ];
    let table = Table::new(&plan, &records(&plan, &came));
    let row = &table.rows[0];
    assert_eq!(
        (row.required.mrf, row.required.safe_below.as_slice()),
        (Mrf::Rate(4), [2].as_slice())
    );
    assert_eq!(row.estimates(2, TABLE).unwrap().mean, 16.0);
    assert_eq!(row.estimates(3, TABLE), None);
    let at_4 = row.estimates(4, TABLE).unwrap();
    assert_eq!(
        (at_4.mean, at_4.median, at_4.beyond_grid, at_4.unavoidable),
        (13.0, 5.0, 1, 0)
    );
    assert_eq!(row.tested[1].collisions, 1);
    // The largest sum from the MRF on, 30 + 2, of three analysed cameras at 30.
    assert_eq!(
        (row.largest_sum, row.fraction),
        (Some(32.0), Some(32.0 / 90.0))
    );
}

#[test]
fn hand_runs_below_the_mrf_do_not_enter_the_sum() {
    let plan = plan(&["cut-out"], &[2, 3, 4], 1);
    let table = Table::new(&plan, &records(&plan, &[Asked(30.0), Collided, Asked(5.0)]));
    assert_eq!(table.rows[0].largest_sum, Some(7.0));
}

#[test]
fn hand_a_scenario_without_a_safe_rate_has_no_sum_and_no_fraction() {
    let plan = plan(&["cut-out"], &[29, 30], 2);
    let table = Table::new(
        &plan,
        &records(&plan, &[Asked(5.0), Asked(5.0), Collided, Asked(5.0)]),
    );
    let row = &table.rows[0];
    assert_eq!(
        (row.required.mrf, row.largest_sum, row.fraction),
        (Mrf::Above(30), None, None)
    );
    assert!(page::csv(&table).contains("cut-out,mrf,,>30,2\n"));
    assert!(page::csv(&table).contains("cut-out,fraction,exact,,0.12\n"));
}

#[test]
fn hand_the_long_form_has_ours_beside_the_papers() {
    let plan = plan(&["cut-out"], &[1, 2, 11, 30], 2);
    let came = [
        Collided,
        Asked(4.0),
        Asked(4.0),
        Asked(4.5),
        Asked(6.0),
        Asked(7.0),
        Asked(6.5),
        Asked(7.0),
    ];
    let csv = page::csv(&Table::new(&plan, &records(&plan, &came)));
    let expected = "\
scenario,quantity,solver,ours,paper
cut-out,mrf,,2,2
cut-out,est_1,exact,,
cut-out,est_median_1,exact,,
cut-out,est_2,exact,4.2500,4
cut-out,est_median_2,exact,4.2500,4
cut-out,est_11,exact,6.5000,
cut-out,est_median_11,exact,6.5000,
cut-out,est_30,exact,6.7500,7
cut-out,est_median_30,exact,6.7500,7
cut-out,est_1,paper,,
cut-out,est_median_1,paper,,
cut-out,est_2,paper,4.2500,4
cut-out,est_median_2,paper,4.2500,4
cut-out,est_30,paper,6.7500,7
cut-out,est_median_30,paper,6.7500,7
cut-out,max_sum,exact,9.0000,11
cut-out,fraction,exact,0.1000,0.12
";
    assert_eq!(csv, expected);
}

#[test]
fn hand_the_page_shows_both_rows_and_the_odd_ones() {
    let plan = plan(&["cut-out-fast"], &[5, 6, 7], 1);
    let table = Table::new(&plan, &records(&plan, &[Asked(9.0), Collided, Asked(30.0)]));
    let page = page::markdown(&plan, &table);
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let lines: Vec<String> = page.lines().map(words).collect();
    for expected in [
        "| cut-out-fast | ours | 40 | yes | yes | yes | 7 | 9.0 | N/A | 30.0 | 32.0 | 0.356 |",
        "| | paper | 40 | yes | yes | yes | 6 | N/A | 9.5 | 11.7 | 32 | 0.36 |",
        "| cut-out-fast | 9.0 | N/A | 30.0 1b |",
        "| cut-out-fast | . | 1 | . |",
    ] {
        assert!(
            lines.iter().any(|line| line == expected),
            "no line {expected} in\n{page}"
        );
    }
    assert!(
        page.contains("Not monotone: cut-out-fast: no collision at 5 FPR, below its MRF."),
        "{page}"
    );
}
