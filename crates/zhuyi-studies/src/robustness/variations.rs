//! What is changed, one thing at a time.

use zhuyi_scenario::{Scenario, System};

use crate::reproduce::plan::Plan;
use zhuyi_batch::distances::scaled;

/// A plan's scenarios and system with one thing changed.
pub(super) struct Variation {
    /// What.
    pub(super) changed: &'static str,
    /// By how much, or to what.
    pub(super) by: String,
    /// The scenarios.
    pub(super) scenarios: Vec<Scenario>,
    /// The system.
    pub(super) system: System,
}

/// [-] factors on the distances.
const DISTANCES: [f64; 4] = [0.9, 0.95, 1.05, 1.1];
/// [m/s2] on the planner's hardest braking.
const BRAKING: [f64; 4] = [-0.3, -0.15, 0.15, 0.3];
/// [s] on the lag of acceleration and brakes.
const LAG: [f64; 2] = [-0.05, 0.05];
/// [s] on the planner's headway.
const HEADWAY: [f64; 2] = [-0.2, 0.2];
/// [-] shares of a body that must be visible (reading R17).
const VISIBLE: [f64; 2] = [0.25, 0.5];

/// All of them, the unchanged plan first.
pub(super) fn variations(plan: &Plan) -> Vec<Variation> {
    let unchanged = (
        "nothing",
        String::new(),
        plan.scenarios.clone(),
        plan.system.clone(),
    );
    let distances = DISTANCES.map(|factor| {
        let scenarios = plan
            .scenarios
            .iter()
            .map(|scenario| scaled(scenario, factor))
            .collect();
        (
            "distances",
            format!("x {factor:.2}"),
            scenarios,
            plan.system.clone(),
        )
    });
    let system = |changed: &'static str, by: String, change: &dyn Fn(&mut System)| {
        let mut system = plan.system.clone();
        change(&mut system);
        (changed, by, plan.scenarios.clone(), system)
    };
    let braking = BRAKING.map(|by| {
        system("hardest braking", format!("{by:+.2} m/s2"), &|system| {
            system.planner.max_decel += by;
        })
    });
    let lag = LAG.map(|by| {
        system("actuator lag", format!("{by:+.2} s"), &|system| {
            system.vehicle.accel_lag += by;
        })
    });
    let headway = HEADWAY.map(|by| {
        system("headway", format!("{by:+.1} s"), &|system| {
            system.planner.time_headway += by;
        })
    });
    let visible = VISIBLE.map(|share| {
        system("visible share", format!("{share:.2}"), &|system| {
            system.perception.visible_share = share;
        })
    });
    let all = [unchanged]
        .into_iter()
        .chain(distances)
        .chain(braking)
        .chain(lag)
        .chain(headway)
        .chain(visible);
    all.map(|(changed, by, scenarios, system)| Variation {
        changed,
        by,
        scenarios,
        system,
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_every_variation_but_the_first_changes_one_side() {
        let plan = Plan::embedded().unwrap();
        let all = variations(&plan);
        assert_eq!(all.len(), 15);
        assert!(all[0].scenarios == plan.scenarios && all[0].system == plan.system);
        for variation in &all[1..] {
            let of_scenarios = variation.scenarios != plan.scenarios;
            let of_system = variation.system != plan.system;
            // The published share may be one of those shown.
            assert!(
                of_scenarios != of_system || variation.changed == "visible share",
                "{} {}",
                variation.changed,
                variation.by
            );
        }
    }
}
