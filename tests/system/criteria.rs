//! What the nine scenarios ask for under each criterion of the estimator, at 30 FPR on all cameras.
//!
//! The figures stand in the documentation of `zhuyi-estimator` (`laws.md`); this test prints them and fails where they
//! are others.

use crate::{read, run};
use zhuyi_core::FrameRates;
use zhuyi_estimator::{Criterion, Estimator, Params};
use zhuyi_scenario::embedded;
use zhuyi_sim::{Hindsight, Peaks, Trace};

const SEEDS: u64 = 10;

/// What the runs of one scenario asked of the analysed cameras at most, under both criteria.
struct Asked {
    peaks: Vec<[Peaks; 2]>,
    /// Demands of an analysed camera at a step: all, those in which `standstill` asks for more, for less.
    demands: [usize; 3],
}

impl Asked {
    fn of(name: &str) -> Self {
        let (scenario, system) = read(name, &[]);
        let estimators = [Criterion::Paper, Criterion::Standstill].map(|criterion| {
            Estimator::new(Params {
                criterion,
                ..system.estimator.clone()
            })
        });
        let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
        let mut asked = Self {
            peaks: Vec::new(),
            demands: [0; 3],
        };
        for seed in 0..SEEDS {
            let run = run(&scenario, &system, 30, seed);
            assert!(!run.collided(), "{name}, seed {seed}");
            let trace: &Trace = &run.trace;
            let hindsight = Hindsight::new(trace, &scenario.road, &system, &rates);
            asked.peaks.push(
                estimators
                    .each_ref()
                    .map(|estimator| hindsight.peaks(estimator)),
            );
            for row in trace.rows() {
                let [paper, standstill] = estimators
                    .each_ref()
                    .map(|estimator| hindsight.demands(estimator, &row));
                for ((paper, standstill), eye) in
                    paper.iter().zip(&standstill).zip(&system.perception.eyes)
                {
                    if eye.camera.analysed {
                        asked.demands[0] += 1;
                        asked.demands[1] += usize::from(standstill.fpr > paper.fpr);
                        asked.demands[2] += usize::from(standstill.fpr < paper.fpr);
                    }
                }
            }
        }
        asked
    }

    /// Mean and largest over the runs of a number under one criterion.
    fn largest(&self, criterion: usize) -> (f64, f64) {
        let each = self.peaks.iter().map(|peaks| peaks[criterion].largest);
        (
            each.clone().sum::<f64>() / SEEDS as f64,
            each.fold(0.0, f64::max),
        )
    }

    fn row(&self, name: &str) -> String {
        let [(paper, paper_most), (standstill, standstill_most)] = [0, 1].map(|i| self.largest(i));
        let beyond = [0, 1].map(|i| {
            let beyond = |peaks: &&[Peaks; 2]| peaks[i].beyond_grid || peaks[i].unavoidable;
            self.peaks.iter().filter(beyond).count()
        });
        let share = |i: usize| 100.0 * self.demands[i] as f64 / self.demands[0] as f64;
        format!(
            "| {name} | {paper:.1} ({paper_most:.1}) | {} | {standstill:.1} ({standstill_most:.1}) | {} | {:.2} % | {:.2} % |",
            beyond[0],
            beyond[1],
            share(1),
            share(2),
        )
    }
}

#[test]
#[ignore = "a minute: cargo test --release --test system -- --ignored --nocapture criteria"]
fn regress_what_the_nine_ask_for_under_each_criterion() {
    let page = include_str!("../../crates/zhuyi-estimator/src/laws.md");
    let rows: Vec<String> = embedded::names()
        .map(|name| Asked::of(name).row(name))
        .collect();
    println!("{}", rows.join("\n"));
    for row in rows {
        assert!(
            page.contains(&row),
            "not in crates/zhuyi-estimator/src/laws.md: {row}"
        );
    }
}
