//! What the options beyond the paper change, on a small plan.

use zhuyi_batch::estimators::{TABLE, VARIANTS as TABLES};
use zhuyi_studies::beyond;
use zhuyi_studies::beyond::{Peak, VARIANTS};

use crate::small::plan;

fn place(name: &str) -> usize {
    VARIANTS
        .iter()
        .position(|variant| *variant == name)
        .unwrap()
}

#[test]
fn law_options_move_the_demand_the_way_they_must() {
    let plan = plan(&["cut-out-fast", "vehicle-following"], &[30], 2);
    let found = beyond(&plan, &());
    let estimators = [TABLES[TABLE].estimator(&plan.system)];
    let records = plan.experiment().run(&plan.cells(), |_| &estimators, || {});
    let runs: Vec<_> = found.peaks.iter().flatten().collect();
    assert_eq!(runs.len(), records.len());
    let (paper, evasion) = (place("paper"), place("evasion"));
    for (peaks, record) in runs.iter().zip(&records) {
        // The first variant is the table's.
        let table = &record.peaks[TABLE];
        assert_eq!(
            (peaks[paper].largest, peaks[paper].sum, peaks[paper].change),
            (table.largest, table.sum, 0.0)
        );
        // Each of these asks for no less than the one before it.
        for chain in [
            ["paper", "uncertainty", "first sight"],
            ["paper", "phantom, 2 s", "phantom"],
        ] {
            let largest = chain.map(|name| peaks[place(name)].largest);
            assert!(largest.is_sorted(), "{chain:?}: {largest:?}");
        }
        assert!(peaks[evasion].largest <= peaks[paper].largest);
    }
    // Where they must show: nobody is beside the ego that follows; who leaves the lane in a cut-out hides something.
    let last = |variant: usize| -> &Peak { &runs[3][variant] };
    assert!(last(evasion).largest < last(paper).largest);
    assert!(runs[0][place("phantom")].unavoidable > 0);
}

#[test]
fn hand_a_phantom_asks_before_the_obstacle_is_in_sight() {
    let found = beyond(&plan(&["cut-out-fast"], &[30], 1), &());
    let options: Vec<_> = found.comparisons.iter().map(|c| c.option).collect();
    assert_eq!(options, ["uncertainty", "phantom", "evasion"]);
    let phantom = &found.comparisons[1];
    let [(sight, _)] = phantom.marks[..] else {
        panic!("one mark: {:?}", phantom.marks);
    };
    let before = |line: usize| -> f64 {
        let points = phantom.lines[line].points.iter();
        let before = points.filter(|(time, _)| *time < sight);
        before.map(|(_, fpr)| *fpr).fold(0.0, f64::max)
    };
    // 6 FPR are needed; without a phantom the camera is asked for the least.
    assert_eq!(before(0), 1.0);
    assert!(before(1) >= 6.0 && before(2) > 1.0);
    // The lead hides something, and so does the obstacle that it leaves behind in its lane. Two front cameras look at both.
    let [edge, kept] = found.edges[0];
    for edges in [edge, kept] {
        assert_eq!((edges.most, edges.further), (2, 0));
        assert!(edges.phantoms > edges.steps, "{edges:?}");
    }
    for words in [
        "## Largest estimate",
        "## Phantoms at a step",
        "cut-out-fast",
        "first sight",
    ] {
        assert!(found.text.contains(words), "{words}");
    }
}
