//! `allocation.csv`: one row per scenario, policy and budget; units stand in the names of the columns, an empty field says
//! that there is no such figure, and the scenario `all` is all of them together.
//!
//! The last columns put the policy beside `uniform` at the same budget, drive by drive, with 95 % intervals
//! ([`tally`](super::tally)); they are empty where `uniform` was not driven.

use super::tally::{Interval, Paired, Tally, paired};
use super::{Allocated, Allocating, BEST_STATIC, Budgets, Cell};
use zhuyi_batch::statistics::wilson_interval;
use zhuyi_batch::text::{csv_row, decimals};

const HEADER: [&str; 29] = [
    "scenario",
    "policy",
    "rates",
    "drives",
    "collisions",
    "collision_share",
    "collision_share_low95",
    "collision_share_high95",
    "mean_delta_v_mps",
    "processed_fps",
    "share_of_30fpr",
    "transfers_avoided_per_drive",
    "avoided_megabytes_per_drive",
    "hardest_braking_mps2",
    "jerk_rms_mps3",
    "false_alarms_per_drive",
    "collisions_without_alarm",
    "alarm_lead_median_s",
    "alarm_standing_share",
    "only_this_collides",
    "only_uniform_collides",
    "collisions_less_uniform",
    "collisions_less_uniform_low95",
    "collisions_less_uniform_high95",
    "processed_less_uniform_fps",
    "processed_less_uniform_low95_fps",
    "processed_less_uniform_high95_fps",
    "budget_fps",
    "budget_tops",
];

/// `allocation.csv`.
pub(super) fn csv(plan: &Allocating, allocated: &Allocated) -> String {
    let mut text = csv_row(HEADER);
    let uniform = plan.policies.iter().position(|policy| policy == "uniform");
    for (place, budget) in plan.budgets().iter().enumerate() {
        let tops = match plan.budgets {
            Budgets::Fps(_) => String::new(),
            Budgets::Tops(_) => budget.amount.to_string(),
        };
        for (policy, cells) in plan.policies.iter().zip(&allocated.cells) {
            let beside = uniform.map(|uniform| &allocated.cells[uniform][place]);
            let rates = match allocated.best_static.get(place) {
                Some(found) if policy == BEST_STATIC => found.policy.as_str(),
                _ => "",
            };
            let mut add = |scenario: &str, cell: &Cell, beside: Option<&Cell>| {
                let cameras = plan.system.perception.eyes.len();
                let tally = Tally::of(cell.all(), cameras);
                let paired = beside.map(|beside| paired(cell, beside));
                let mut row = vec![scenario.to_string(), policy.clone(), rates.to_string()];
                row.extend(figures(plan, &tally));
                row.extend(differences(paired.as_ref()));
                row.push(format!("{:.4}", budget.fps));
                row.push(tops.clone());
                text += &csv_row(row.iter().map(String::as_str));
            };
            for (index, scenario) in plan.scenarios.iter().enumerate() {
                let of = |cell: &Cell| Cell {
                    drives: vec![cell.drives[index].clone()],
                };
                add(&scenario.name, &of(&cells[place]), beside.map(of).as_ref());
            }
            add("all", &cells[place], beside);
        }
    }
    text
}

fn figures(plan: &Allocating, tally: &Tally) -> [String; 16] {
    let (low, high) = wilson_interval(tally.collisions, tally.drives);
    let number = |value: f64| decimals(Some(value), 4);
    [
        tally.drives.to_string(),
        tally.collisions.to_string(),
        number(f64::from(tally.collisions) / f64::from(tally.drives)),
        number(low),
        number(high),
        decimals(tally.delta_v, 4),
        number(tally.processed),
        number(tally.share),
        number(tally.avoided),
        number(tally.avoided * plan.chip().frame_bytes as f64 / 1e6),
        number(tally.decel),
        number(tally.jerk),
        number(tally.false_alarms),
        tally.missed.to_string(),
        decimals(tally.lead, 4),
        number(tally.standing),
    ]
}

fn differences(paired: Option<&Paired>) -> [String; 8] {
    let Some(paired) = paired else {
        return Default::default();
    };
    let of = |Interval { value, low, high }: Interval| {
        [value, low, high].map(|value| decimals(Some(value), 4))
    };
    let [c, c_low, c_high] = of(paired.collisions);
    let [f, f_low, f_high] = of(paired.frames);
    [
        paired.only_first.to_string(),
        paired.only_second.to_string(),
        c,
        c_low,
        c_high,
        f,
        f_low,
        f_high,
    ]
}
