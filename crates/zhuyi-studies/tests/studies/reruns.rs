use zhuyi_studies::reruns::Reruns;

use crate::small::Came::{Asked, Collided};
use crate::small::{cut_short, plan, records};

#[test]
fn hand_the_largest_of_all_runs_at_the_highest_rate_is_rounded_up() {
    // Two seeds at 10 FPR, which do not count, and two at 30.
    let plan = cut_short(plan(&["front-right-activity-1"], &[10, 30], 2), 1);
    let came = [Asked(20.0), Collided, Asked(6.2), Asked(5.5)];
    let reruns = Reruns::new(&plan, &records(&plan, &came), &());
    let rerun = reruns.scenarios[0].as_ref().unwrap();
    assert_eq!(rerun.asked, 6.2);
    assert_eq!(rerun.largest.rates.all(), [7.0; 5]);
    // The records ask 1 FPR of all cameras but front_120: front_60 goes with it, the rear one keeps its rate.
    assert_eq!(rerun.own.rates.all(), [7.0, 7.0, 1.0, 1.0, 30.0]);
    assert_eq!((rerun.largest.runs, rerun.own.runs), (2, 2));
    let seeds = |records: &[zhuyi_batch::sweep::Record]| {
        records
            .iter()
            .map(|record| record.cell.seed)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        (seeds(&reruns.largest), seeds(&reruns.own)),
        (vec![0, 1], vec![0, 1])
    );
}

#[test]
fn hand_where_a_run_at_the_highest_rate_collides_nothing_is_run_again() {
    let plan = cut_short(plan(&["cut-out", "front-right-activity-1"], &[30], 2), 1);
    let came = [Asked(6.0), Collided, Asked(1.0), Asked(1.0)];
    let reruns = Reruns::new(&plan, &records(&plan, &came), &());
    assert_eq!(reruns.scenarios[0], None);
    let rerun = reruns.scenarios[1].as_ref().unwrap();
    assert_eq!(
        (rerun.asked, rerun.largest.rates.all()),
        (1.0, [1.0; 5].as_slice())
    );
    assert!(
        reruns
            .largest
            .iter()
            .chain(&reruns.own)
            .all(|record| record.cell.scenario == 1)
    );
    assert_eq!(reruns.largest.len() + reruns.own.len(), 4);
}

#[test]
fn hand_a_rerun_that_collides_is_counted() {
    // Whoever asks for 1 FPR before a standing obstacle hits it.
    let plan = plan(&["cut-out-fast"], &[30], 2);
    let reruns = Reruns::new(&plan, &records(&plan, &[Asked(1.0), Asked(1.0)]), &());
    let rerun = reruns.scenarios[0].as_ref().unwrap();
    assert_eq!((rerun.largest.collisions, rerun.own.collisions), (2, 2));
}
