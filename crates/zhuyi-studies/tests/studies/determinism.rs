use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicU64, Ordering};
use zhuyi_batch::estimators::{TABLE, VARIANTS};
use zhuyi_batch::rates::uniform;
use zhuyi_batch::sweep::{Cell, grid};
use zhuyi_batch::{Progress, Results};
use zhuyi_studies::reproduce;

use crate::small::{cut_short, plan};

/// Counts what it is told.
#[derive(Default)]
struct Counted {
    total: AtomicU64,
    steps: AtomicU64,
}

impl Progress for Counted {
    fn start(&self, _what: &str, total: u64) {
        self.total.fetch_add(total, Ordering::Relaxed);
    }

    fn step(&self) {
        self.steps.fetch_add(1, Ordering::Relaxed);
    }
}

#[test]
fn law_the_same_bytes_at_one_and_two_threads() {
    let plan = cut_short(
        plan(
            &["challenging-cut-in", "front-right-activity-2"],
            &[2, 30],
            2,
        ),
        8,
    );
    let counted = Counted::default();
    let at = |threads: usize, progress: &dyn Progress| -> Results {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| reproduce(&plan, progress))
    };
    let one = at(1, &counted);
    assert_eq!(one, at(2, &()));
    assert_eq!(counted.steps.into_inner(), counted.total.into_inner());
}

#[test]
fn law_the_order_of_the_cells_does_not_matter() {
    let plan = cut_short(plan(&["cut-out", "challenging-cut-in-curved"], &[], 0), 6);
    let rates = [3, 30].map(|fps| uniform(&plan.system, fps));
    let cells = grid(2, &rates, 0..2);
    // 8 cells in steps of 3: every one once, none at its place but the first.
    let shuffled: Vec<Cell> = (0..8).map(|i| cells[i * 3 % 8].clone()).collect();
    let estimators = [VARIANTS[TABLE].estimator(&plan.system)];
    let run = |cells: &[Cell]| plan.experiment().run(cells, |_| &estimators, || ());
    let (records, mut of_shuffled) = (run(&cells), run(&shuffled));
    of_shuffled.sort_by_key(|record| cells.iter().position(|cell| *cell == record.cell));
    assert_eq!(records, of_shuffled);
    assert_eq!(
        records[3],
        plan.experiment().record(&cells[3], &estimators),
        "a run alone is the run of the sweep"
    );
    assert_ne!(records[0].extremes, records[1].extremes, "seeds differ");
}
