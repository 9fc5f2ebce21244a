//! The best static allocation of a budget: one for all scenarios, found by driving them all.
//!
//! Cameras that look the same way share a rate ([`group`]). Candidates are those of [`allocations`] with [`CHOICES`]; the
//! cost is the number of drives that collide. A candidate is given up as soon as it costs as much as the best before it,
//! and the search ends at a cost of nothing, so the result is that of trying all. A greater budget begins with what the
//! smaller one found. Source: Suraksha (ISSRE 2021). Left out: rates between the choices.

use std::collections::BTreeMap;

use rayon::prelude::*;
use zhuyi_core::FrameRates;
use zhuyi_core::camera::least_rate;
use zhuyi_scenario::System;
use zhuyi_scheduler::search::allocations;

use super::{Allocating, Budget};
use zhuyi_batch::progress::Progress;
use zhuyi_batch::rates::group;

/// [Hz] the rates that are tried.
pub const CHOICES: [f64; 12] = [
    1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 30.0,
];

/// What was found at a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// As `--policy` takes it.
    pub policy: String,
    /// How many drives collide.
    pub collisions: u32,
    /// How many allocations were driven, in part or in full.
    pub tried: u32,
}

/// The best at every budget.
pub(super) fn search(plan: &Allocating, budgets: &[Budget], progress: &dyn Progress) -> Vec<Found> {
    let groups = groups(&plan.system);
    let sizes: Vec<usize> = groups.iter().map(|(_, size)| *size).collect();
    progress.start("budgets searched for static rates", budgets.len() as u64);
    let mut known = Known::default();
    let mut found: Vec<Found> = Vec::new();
    let mut last: Option<Vec<f64>> = None;
    for budget in budgets {
        let mut candidates = allocations(&sizes, &CHOICES, budget.fps);
        if candidates.is_empty() {
            // Not even one frame a second for each camera.
            let each = least_rate(budget.fps, plan.system.perception.eyes.len());
            candidates.push(vec![each; groups.len()]);
        }
        // What did well with less is tried first, with what more it can have.
        if let Some(last) = &last {
            let raises = |rates: &Vec<f64>| rates.iter().zip(last).all(|(new, old)| new >= old);
            candidates.sort_by_key(|rates| !raises(rates));
        }
        let system = plan.with(budget.compute);
        let mut best: Option<(Vec<f64>, u32)> = None;
        let mut tried = 0;
        for rates in candidates {
            let limit = best.as_ref().map_or(u32::MAX, |(_, cost)| *cost);
            if limit == 0 {
                break;
            }
            tried += 1;
            if let Some(cost) = known.cost(plan, &system, &groups, &rates, limit) {
                best = Some((rates, cost));
            }
        }
        let (rates, collisions) = best.unwrap_or_else(|| unreachable!("a first candidate"));
        found.push(Found {
            policy: spelt(&groups, &rates),
            collisions,
            tried,
        });
        last = Some(rates);
        progress.step();
    }
    found
}

/// The groups of cameras that share a rate, with their sizes, in the order of the rig.
fn groups(system: &System) -> Vec<(String, usize)> {
    let mut groups: Vec<(String, usize)> = Vec::new();
    for eye in &system.perception.eyes {
        let name = group(&eye.camera.name);
        match groups.iter_mut().find(|(known, _)| known == name) {
            Some((_, size)) => *size += 1,
            None => groups.push((name.to_string(), 1)),
        }
    }
    groups
}

fn spelt(groups: &[(String, usize)], rates: &[f64]) -> String {
    let named = groups.iter().zip(rates);
    let named: Vec<String> = named
        .map(|((name, _), hz)| format!("{name}={hz}"))
        .collect();
    format!("static:{}", named.join(","))
}

/// What drives at fixed rates have cost: they are asked for again at other budgets.
#[derive(Default)]
struct Known {
    /// By the rates in hundredths and what frames take: collisions of each scenario, as far as driven.
    collisions: BTreeMap<(Vec<u64>, String), Vec<u32>>,
}

impl Known {
    /// How many drives collide, if fewer than `limit`.
    fn cost(
        &mut self,
        plan: &Allocating,
        system: &System,
        groups: &[(String, usize)],
        rates: &[f64],
        limit: u32,
    ) -> Option<u32> {
        let key = rates.iter().map(|hz| (hz * 100.0).round() as u64).collect();
        let key = (key, format!("{:?}", system.compute));
        let known = self.collisions.entry(key).or_default();
        let mut cost = 0;
        for scenario in 0..plan.scenarios.len() {
            let of_scenario = known.get(scenario).copied();
            cost += of_scenario.unwrap_or_else(|| {
                let collisions = collisions(plan, system, groups, rates, scenario);
                known.push(collisions);
                collisions
            });
            if cost >= limit {
                return None;
            }
        }
        Some(cost)
    }
}

/// How many seeds of a scenario collide.
fn collisions(
    plan: &Allocating,
    system: &System,
    groups: &[(String, usize)],
    rates: &[f64],
    scenario: usize,
) -> u32 {
    let of_camera = |name: &str| {
        let place = groups.iter().position(|(known, _)| known == group(name));
        place.map_or(1.0, |place| rates[place])
    };
    let eyes = system.perception.eyes.iter();
    let rates = FrameRates::new(eyes.map(|eye| of_camera(&eye.camera.name)).collect());
    let collides = |seed: u64| {
        let spec = plan.spec(scenario, system, seed);
        let run = spec.at_rates(rates.clone()).run_fixed();
        u32::from(run.collided())
    };
    (0..plan.seeds).into_par_iter().map(collides).sum()
}
