//! Claim 8: the estimate in the loop is safe in cut-in, and differs from the one with hindsight mainly by prediction.

use zhuyi_core::FrameRates;
use zhuyi_core::camera::FULL_RATE;

use super::{Claim, Verdict};
use crate::claims::run::foresight::{Decision, Foresight, SHOWN, foresights, of_one_future};
use crate::reproduce::plan::Plan;
use crate::reruns::again;
use zhuyi_batch::rates::{own, spelt};
use zhuyi_batch::text::{cells, markdown_table};

/// What came of the runs with one predictor.
struct Online {
    runs: usize,
    decisions: Vec<Decision>,
    out_of_reach: usize,
    /// Each camera at its largest demand of all runs.
    rates: FrameRates,
    /// How many collide at these.
    collisions: u32,
}

impl Online {
    /// None without a run of the scenario that does not collide.
    fn new(plan: &Plan) -> Option<Self> {
        let (place, runs) = (plan.place(SHOWN)?, foresights(plan, SHOWN)?);
        let largest = |camera: usize| {
            let demands = runs.iter().map(|run: &Foresight| run.largest[camera]);
            demands.reduce(f64::max)
        };
        let cameras = 0..plan.system.perception.eyes.len();
        let demands: Option<Vec<f64>> = cameras.map(largest).collect();
        let rates = own(&plan.system, &demands?);
        let mut of_scenario = vec![None; plan.scenarios.len()];
        of_scenario[place] = Some(rates.clone());
        let (trials, _) = again(&plan.experiment(), &of_scenario, plan.seeds, &());
        Some(Self {
            runs: runs.len(),
            out_of_reach: runs.iter().map(|run| run.out_of_reach).sum(),
            decisions: runs.iter().flat_map(|run| run.decisions.clone()).collect(),
            rates,
            collisions: trials
                .into_iter()
                .flatten()
                .map(|trial| trial.collisions)
                .sum(),
        })
    }

    /// [s] by how much one latency differs from another in the mean.
    fn difference(&self, one: fn(&Decision) -> f64, other: fn(&Decision) -> f64) -> f64 {
        let all = self.decisions.iter();
        let sum: f64 = all
            .map(|decision| (one(decision) - other(decision)).abs())
            .sum();
        sum / self.decisions.len() as f64
    }

    fn by_prediction(&self) -> f64 {
        self.difference(|one| one.predicted, |one| one.offline)
    }

    fn by_perception(&self) -> f64 {
        self.difference(|one| one.online, |one| one.predicted)
    }

    /// [FPR] the largest demand.
    fn peak(&self, of: fn(&Decision) -> f64) -> String {
        let latency = self.decisions.iter().map(of).fold(1.0, f64::min);
        format!("{:.1}", (1.0 / latency).min(FULL_RATE))
    }

    /// Of the decisions, in percent.
    fn share(&self, of: fn(&Decision) -> bool) -> String {
        let count = self.decisions.iter().filter(|one| of(one)).count();
        format!("{:.0}", 100.0 * count as f64 / self.decisions.len() as f64)
    }

    fn line(&self, plan: &Plan, predictor: &str) -> Vec<String> {
        let out_of_reach = 100.0 * self.out_of_reach as f64 / self.decisions.len() as f64;
        vec![
            predictor.to_string(),
            self.peak(|one| one.online),
            self.peak(|one| one.predicted),
            format!("{:.1}", 1e3 * self.by_prediction()),
            format!("{:.1}", 1e3 * self.by_perception()),
            self.share(|one| one.online < one.offline),
            self.share(|one| one.online > one.offline),
            format!("{out_of_reach:.0}"),
            spelt(&plan.system, &self.rates),
            format!("{} of {}", self.collisions, plan.seeds),
        ]
    }

    fn holds(&self) -> bool {
        self.collisions == 0 && self.by_prediction() > self.by_perception()
    }
}

pub(super) fn claim(plan: &Plan) -> Claim {
    let (number, title) = (
        "8",
        "The estimate in the loop is safe in cut-in and differs from the offline one mainly by prediction",
    );
    let one_future = of_one_future(plan);
    let (Some(usual), Some(single)) = (Online::new(plan), Online::new(&one_future)) else {
        return Claim {
            number,
            title,
            verdict: Verdict::FigureOnly,
            figures: format!("No run of {SHOWN} without a collision"),
            details: String::new(),
        };
    };
    let header = cells(&[
        "futures",
        "peak online [FPR]",
        "peak of truth, predicted [FPR]",
        "by prediction [ms]",
        "by perception [ms]",
        "asks for more [%]",
        "for less [%]",
        "out of reach [%]",
        "rates asked for",
        "collisions",
    ]);
    let lines = [
        usual.line(plan, "several, as the system has it"),
        single.line(&one_future, "one, the planner's"),
    ];
    Claim {
        number,
        title,
        verdict: Verdict::holds_if(usual.holds()),
        figures: format!(
            "{} of {} runs collide at the rates asked for online; the latency of the front camera differs by {:.0} ms in the mean through \
             prediction and by {:.0} ms through perception",
            usual.collisions,
            plan.seeds,
            1e3 * usual.by_prediction(),
            1e3 * usual.by_perception()
        ),
        details: format!(
            "{}\nOf the first analysed camera at {} decisions of {} runs at {} FPR; offline it peaks at {} FPR. By prediction: from the \
             recorded future to predicted ones, told the truth; by perception: from there to what is believed. More and less: online \
             against offline. Out of reach: a predicted future is beyond the grid or unavoidable, which counts as 30 FPR. The scenario \
             is run again with each camera at its largest demand online. With the system's predictor this says little, as long as the \
             peak is the clamp of 30 FPR: the future in which the car ahead brakes hard asks for that while the ego follows, and one \
             without it does not. Drawn: figures/online-cut-in.svg (`zhuyi figures`).\n",
            markdown_table(&header, &lines),
            usual.decisions.len(),
            usual.runs,
            plan.highest_rate(),
            usual.peak(|one| one.offline),
        ),
    }
}
