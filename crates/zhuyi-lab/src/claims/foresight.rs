//! Claim 8: the estimate in the loop is safe in cut-in, and differs from the one with hindsight mainly by prediction.

use zhuyi_core::FrameRates;

use super::{Claim, Verdict};
use crate::foresight::{Decision, Foresight, SHOWN, foresights};
use crate::rates::{own, spelt};
use crate::reproduce::Plan;
use crate::reruns::{Trial, again};
use crate::text::{cells, markdown_table};

pub(super) fn claim(plan: &Plan) -> Claim {
    let (number, title) = (
        "8",
        "The estimate in the loop is safe in cut-in and differs from the offline one mainly by prediction",
    );
    let runs = foresights(plan, SHOWN).unwrap_or_default();
    let (Some(place), Some(first)) = (plan.place(SHOWN), runs.first()) else {
        return Claim {
            number,
            title,
            verdict: Verdict::FigureOnly,
            figures: format!("No run of {SHOWN} without a collision"),
            details: String::new(),
        };
    };
    let rates = asked_for(plan, &runs);
    let mut of_scenario = vec![None; plan.scenarios.len()];
    of_scenario[place] = Some(rates.clone());
    let (trials, _) = again(&plan.experiment(), &of_scenario, plan.seeds, &());
    let collisions = trials[place]
        .as_ref()
        .map_or(0, |trial: &Trial| trial.collisions);
    let decisions = || runs.iter().flat_map(|run| &run.decisions);
    let count = decisions().count();
    let mean = |of: &dyn Fn(&Decision) -> f64| decisions().map(of).sum::<f64>() / count as f64;
    let prediction = mean(&|one| (one.predicted - one.offline).abs());
    let perception = mean(&|one| (one.online - one.predicted).abs());
    let less = decisions().filter(|one| one.online > one.offline).count();
    let more = decisions().filter(|one| one.online < one.offline).count();
    let out_of_reach: usize = runs.iter().map(|run| run.out_of_reach).sum();
    let smallest = |of: fn(&Decision) -> f64| {
        let latency = decisions().map(of).fold(f64::INFINITY, f64::min);
        format!("{:.1}", (1.0 / latency).min(30.0))
    };
    let lines = [
        vec![
            "offline: truth, recorded future".to_string(),
            smallest(|one| one.offline),
            String::new(),
        ],
        vec![
            "truth, predicted futures".to_string(),
            smallest(|one| one.predicted),
            format!("{:.1}", 1e3 * prediction),
        ],
        vec![
            "online: belief, predicted futures".to_string(),
            smallest(|one| one.online),
            format!("{:.1}", 1e3 * perception),
        ],
    ];
    let header = cells(&[
        "estimate",
        "peak [FPR]",
        "mean difference to the line above [ms]",
    ]);
    let share = |part: usize| format!("{:.0} %", 100.0 * part as f64 / count as f64);
    Claim {
        number,
        title,
        verdict: Verdict::holds_if(collisions == 0 && prediction > perception),
        figures: format!(
            "{collisions} of {} runs collide at the rates asked for online; the latency differs by {:.0} ms in the mean through prediction \
             and by {:.0} ms through perception",
            plan.seeds,
            1e3 * prediction,
            1e3 * perception
        ),
        details: format!(
            "{}\nOf {} at {count} decisions of {} runs at {} FPR. Run again at {}, the largest demand online on each camera: \
             {collisions} of {} collide. At {} of the decisions online asks for \
             more than offline, at {} for less, and at {} a predicted future is beyond the grid or unavoidable, which asks for 30 FPR: a \
             rate that large is safe, and saves nothing. Drawn: \
             figures/online-cut-in.svg (`zhuyi figures`).\n",
            markdown_table(&header, &lines),
            first.camera,
            runs.len(),
            first.rate,
            spelt(&plan.system, &rates),
            plan.seeds,
            share(more),
            share(less),
            share(out_of_reach),
        ),
    }
}

/// Each camera at its largest demand of all runs.
fn asked_for(plan: &Plan, runs: &[Foresight]) -> FrameRates {
    let cameras = plan.system.perception.eyes.len();
    let largest = |camera: usize| {
        runs.iter()
            .map(|run| run.largest[camera])
            .fold(0.0, f64::max)
    };
    own(&plan.system, &(0..cameras).map(largest).collect::<Vec<_>>())
}
