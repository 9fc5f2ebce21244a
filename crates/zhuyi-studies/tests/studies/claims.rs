use zhuyi_core::FrameRates;
use zhuyi_studies::Plan;
use zhuyi_studies::claims::{Claim, Verdict, examine, markdown};
use zhuyi_studies::reproduce::table::Table;
use zhuyi_studies::reruns::{Rerun, Reruns, Trial};

use crate::small::Came::{self, Asked, Collided};
use crate::small::{plan, records};

fn trial(collisions: u32) -> Trial {
    Trial {
        rates: FrameRates::new(vec![7.0; 5]),
        runs: 1,
        collisions,
    }
}

fn reruns(scenarios: Vec<Option<Rerun>>) -> Reruns {
    Reruns {
        scenarios,
        largest: Vec::new(),
        own: Vec::new(),
    }
}

fn fine() -> Rerun {
    Rerun {
        asked: 6.3,
        largest: trial(0),
        own: trial(0),
    }
}

fn examined(plan: &Plan, came: &[Came], reruns: &Reruns) -> Vec<Claim> {
    examine(plan, &Table::new(plan, &records(plan, came)), reruns)
}

fn verdicts(claims: &[Claim]) -> Vec<(&'static str, Verdict)> {
    claims
        .iter()
        .map(|claim| (claim.number, claim.verdict))
        .collect()
}

/// Cut-out fast has an MRF of 6 in the paper.
fn cut_out_fast() -> Plan {
    plan(&["cut-out-fast"], &[5, 6, 30], 1)
}

#[test]
fn hand_all_hold_on_a_table_like_the_papers() {
    let claims = examined(
        &cut_out_fast(),
        &[Collided, Asked(9.5), Asked(7.0)],
        &reruns(vec![Some(fine())]),
    );
    let holds = ["1", "2a", "2b", "3"].map(|number| (number, Verdict::Holds));
    assert_eq!(verdicts(&claims)[..4], holds);
    assert_eq!(verdicts(&claims)[4], ("4", Verdict::FigureOnly));
    // Both cells are the paper's to the digit.
    assert!(
        claims[4]
            .figures
            .starts_with("Mean absolute difference 0.000 FPR over 2 common cells"),
        "{}",
        claims[4].figures
    );
}

#[test]
fn hand_each_fails_alone() {
    let plan = cut_out_fast();
    let of = |came: &[Came], reruns: &Reruns| {
        let claims = examined(&plan, came, reruns);
        let failing = claims
            .into_iter()
            .filter(|claim| claim.verdict == Verdict::Fails);
        failing.map(|claim| claim.number).collect::<Vec<_>>()
    };
    let good = reruns(vec![Some(fine())]);
    // The MRF is 5.
    assert_eq!(of(&[Asked(9.0), Asked(9.5), Asked(7.0)], &good), ["1"]);
    // The estimate at 30 FPR is below the MRF of 6, by less than any rounding would show.
    assert_eq!(of(&[Collided, Asked(9.5), Asked(5.999_999)], &good), ["2a"]);
    // A collision at the rates asked for, of either kind; and a run at 30 FPR that asked for nothing because it collided.
    let largest = Some(Rerun {
        largest: trial(1),
        ..fine()
    });
    let own = Some(Rerun {
        own: trial(1),
        ..fine()
    });
    for again in [largest, own, None] {
        assert_eq!(
            of(&[Collided, Asked(9.5), Asked(7.0)], &reruns(vec![again])),
            ["2b"]
        );
    }
    // A sum of 32.4 is 0.36 and just holds, 32.41 does not.
    assert!(of(&[Collided, Asked(30.4), Asked(7.0)], &good).is_empty());
    assert_eq!(of(&[Collided, Asked(30.41), Asked(7.0)], &good), ["3"]);
}

#[test]
fn hand_nothing_is_safe_where_the_highest_rate_collides() {
    let claims = examined(
        &cut_out_fast(),
        &[Asked(9.0), Asked(9.5), Collided],
        &reruns(vec![None]),
    );
    let fails = ["1", "2a", "2b", "3"].map(|number| (number, Verdict::Fails));
    assert_eq!(verdicts(&claims)[..4], fails);
    assert!(
        claims[1]
            .details
            .contains("cut-out-fast at 5 to 6 FPR: estimates from 9.000, MRF >30"),
        "{}",
        claims[1].details
    );
}

#[test]
fn hand_only_cells_above_an_mrf_of_1_are_counted_as_able_to_fail() {
    let plan = plan(&["cut-out-fast", "cut-in"], &[1, 6], 1);
    let claims = examined(
        &plan,
        &[Collided, Asked(9.5), Asked(1.0), Asked(1.0)],
        &reruns(vec![Some(fine()), Some(fine())]),
    );
    let safe = &claims[1];
    assert_eq!(
        safe.figures,
        "0 of 3 cells at the paper's rates are below their MRF, 0 of 3 at all rates tested"
    );
    assert!(
        safe.details
            .contains("Only a cell whose MRF is above 1 can fail: 1 of those"),
        "{}",
        safe.details
    );
    assert!(
        safe.details
            .contains("thinnest margin is 3.500 FPR: cut-out-fast at 6 FPR"),
        "{}",
        safe.details
    );
}

#[test]
fn hand_differences_baselines_and_one_sided_cells() {
    // The paper's cut-in: N/A at 1 FPR, 3.9 at 2, 5 at 3; its cut-out-fast: N/A at 1 to 3.
    let plan = plan(&["cut-out-fast", "cut-in"], &[1, 2, 3], 1);
    let came = [
        Collided,
        Asked(6.0),
        Collided,
        Asked(2.0),
        Asked(4.9),
        Asked(7.0),
    ];
    let claim = &examined(&plan, &came, &reruns(vec![Some(fine()), Some(fine())]))[4];
    // |4.9 - 3.9| and |7 - 5|; from 5: 1.1 and 0; from the median 4.45: 0.55 twice.
    assert_eq!(
        claim.figures,
        "Mean absolute difference 1.500 FPR over 2 common cells; baselines 0.550 and 0.550"
    );
    assert!(
        claim.details.contains("- cut-in, 1 FPR: ours only\n"),
        "{}",
        claim.details
    );
    assert!(
        claim.details.contains("- cut-out-fast, 2 FPR: ours only\n"),
        "{}",
        claim.details
    );
    assert!(
        !claim.details.contains("the paper only"),
        "{}",
        claim.details
    );
}

#[test]
fn hand_a_scenario_that_the_paper_does_not_have_is_left_out_of_the_comparison() {
    let mut plan = cut_out_fast();
    plan.scenarios[0].name = "mine".into();
    let claims = examined(
        &plan,
        &[Collided, Asked(9.5), Asked(7.0)],
        &reruns(vec![Some(fine())]),
    );
    assert_eq!(claims[0].figures, "0 of 0 as published");
    assert!(
        claims[4]
            .figures
            .starts_with("Mean absolute difference N/A FPR over 0 common cells"),
        "{}",
        claims[4].figures
    );
    let page = markdown(&plan, &claims);
    assert!(
        page.contains("## 2a. The estimate is at least the MRF in every cell: holds\n"),
        "{page}"
    );
    assert!(!page.contains("NaN"), "{page}");
}
