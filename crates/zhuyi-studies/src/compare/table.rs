//! `compare.csv` and `compare_demand.csv`.
//!
//! The first is long, `scenario,model,quantity,value`, one row per figure; units stand in the names of the quantities, an empty
//! value says that there is no such figure, and the scenario `all` is all of them together. The second is a demand over time,
//! `scenario,seed,time_s,camera,model,fpr_hz`: seed 0, sampled every 0.1 s. A row is written where the sample differs from the one
//! before of its scenario, camera and model; in between the demand stays what it was.

use std::fmt::Write as _;

use super::audit::{Apart, Audited, Tally};
use super::{Compared, Comparison};
use zhuyi_batch::text::{csv_row, decimals};

/// `compare.csv`.
pub(super) fn csv(comparison: &Comparison, compared: &Compared) -> String {
    let mut text = csv_row(["scenario", "model", "quantity", "value"]);
    let mut add = |scenario: &str, model: &str, quantity: &str, value: String| {
        text += &csv_row([scenario, model, quantity, &value]);
    };
    for (place, audited) in compared.scenarios.iter().enumerate() {
        let scenario = &comparison.scenarios[place].name;
        let mrf = &compared.closed_loop.required[place].mrf;
        add(scenario, "", "mrf_hz", mrf.to_string());
        add(scenario, "", "runs_audited", audited.runs.0.to_string());
        add(scenario, "", "runs_collided", audited.runs.1.to_string());
        for (quantity, value) in apart(&audited.apart) {
            add(scenario, "", quantity, value.to_string());
        }
        for (name, (tally, rerun)) in compared.models.iter().zip(
            audited
                .models
                .iter()
                .zip(&compared.closed_loop.trials[place]),
        ) {
            for (quantity, value) in figures(tally) {
                add(scenario, name, quantity, value);
            }
            let worst = tally.worst.as_ref();
            let camera =
                |place: usize| comparison.system.perception.eyes[place].camera.name.clone();
            let actor = |index: usize| comparison.scenarios[place].actors[index].name.clone();
            let of_worst = [
                ("worst_seed", worst.map(|worst| worst.seed.to_string())),
                (
                    "worst_time_s",
                    worst.map(|worst| format!("{:.3}", worst.time.seconds())),
                ),
                (
                    "worst_needed_hz",
                    worst.map(|worst| format!("{:.4}", worst.needed.1)),
                ),
                (
                    "worst_asked_hz",
                    worst.map(|worst| format!("{:.4}", worst.asked.1)),
                ),
                ("worst_camera", worst.map(|worst| camera(worst.camera))),
                ("worst_actor", worst.map(|worst| actor(worst.actor.index()))),
            ];
            for (quantity, value) in of_worst {
                add(scenario, name, quantity, value.unwrap_or_default());
            }
            let rerun = rerun.as_ref();
            let collisions = |count: Option<u32>| count.map_or(String::new(), |n| n.to_string());
            add(
                scenario,
                name,
                "largest_asked_hz",
                decimals(rerun.map(|rerun| rerun.asked), 4),
            );
            add(
                scenario,
                name,
                "collisions_all_cameras_at_largest",
                collisions(rerun.map(|rerun| rerun.largest.collisions)),
            );
            add(
                scenario,
                name,
                "collisions_each_camera_at_its_own",
                collisions(rerun.map(|rerun| rerun.own.collisions)),
            );
        }
    }
    let all = Total::new(compared);
    for (quantity, value) in apart(&all.apart) {
        add("all", "", quantity, value.to_string());
    }
    for (name, tally) in compared.models.iter().zip(&all.models) {
        for (quantity, value) in figures(tally) {
            add("all", name, quantity, value);
        }
    }
    text
}

fn apart(apart: &Apart) -> [(&'static str, u64); 4] {
    [
        ("camera_steps_unavoidable", apart.unavoidable),
        ("camera_steps_beyond_grid", apart.beyond_grid),
        ("camera_steps_alongside", apart.alongside),
        ("camera_steps_standing", apart.standing),
    ]
}

fn figures(tally: &Tally) -> Vec<(&'static str, String)> {
    let (joint, causes) = (&tally.joint, &tally.causes);
    let number = |value: Option<f64>| decimals(value, 4);
    vec![
        ("camera_steps_judged", joint.steps().to_string()),
        ("camera_steps_in_need", joint.in_need().to_string()),
        ("camera_steps_short", joint.short().to_string()),
        ("share_short_of_those_in_need", number(joint.share_short())),
        ("mean_shortfall_hz", number(joint.mean_shortfall())),
        ("largest_shortfall_hz", number(joint.largest_shortfall())),
        ("longest_latency_over_s", number(joint.longest_over())),
        ("short_by_brakes", causes.brakes.to_string()),
        ("short_by_future", causes.future.to_string()),
        ("short_by_both", causes.both.to_string()),
        ("short_by_other", causes.other.to_string()),
        (
            "below_30_where_no_rate_would_do",
            tally.below_most.to_string(),
        ),
        ("camera_steps_not_defined", tally.not_defined.to_string()),
        ("mean_excess_hz", number(joint.mean_excess(false))),
        ("median_excess_hz", number(joint.median_excess(false))),
        ("mean_excess_in_need_hz", number(joint.mean_excess(true))),
        (
            "median_excess_in_need_hz",
            number(joint.median_excess(true)),
        ),
        ("mean_asked_hz", number(joint.mean_asked())),
        ("share_at_30", number(joint.share_at_most())),
    ]
}

/// All scenarios together.
pub(super) struct Total {
    /// One entry per model.
    pub models: Vec<Tally>,
    /// The scenario of each one's worst moment.
    pub worst_in: Vec<Option<usize>>,
    /// What was not judged.
    pub apart: Apart,
}

impl Total {
    pub(super) fn new(compared: &Compared) -> Self {
        let count = compared.models.len();
        let mut total = Self {
            models: vec![Tally::default(); count],
            worst_in: vec![None; count],
            apart: Apart::default(),
        };
        for (scenario, Audited { models, apart, .. }) in compared.scenarios.iter().enumerate() {
            total.apart.add(apart);
            for (place, tally) in models.iter().enumerate() {
                if total.models[place].add(tally) {
                    total.worst_in[place] = Some(scenario);
                }
            }
        }
        total
    }
}

/// `compare_demand.csv`.
pub(super) fn demand_csv(comparison: &Comparison, compared: &Compared) -> String {
    let mut text = csv_row(["scenario", "seed", "time_s", "camera", "model", "fpr_hz"]);
    for (scenario, audited) in comparison.scenarios.iter().zip(&compared.scenarios) {
        let name = csv_row([scenario.name.as_str()]);
        for sample in &audited.curve.samples {
            let camera = &comparison.system.perception.eyes[sample.camera].camera.name;
            let camera = csv_row([camera.as_str()]);
            let _ = writeln!(
                text,
                "{},0,{:.1},{},{},{:.4}",
                name.trim_end(),
                sample.time.seconds(),
                camera.trim_end(),
                compared.models[sample.model],
                sample.fpr
            );
        }
    }
    text
}
