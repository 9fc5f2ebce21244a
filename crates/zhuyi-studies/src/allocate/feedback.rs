//! What the demand does to itself where l_0 is taken literally, as the latency at which the camera runs now (reading R22).
//!
//! ```text
//! t_r = l + K max(0, l - l_0),   l_0 = 1/f,   f = the demand of the decision before
//! ```
//!
//! A camera that runs slowly has a large l_0, so that the K frames of confirmation seem to cost nothing, and a larger l
//! is tolerable: the rate falls, l_0 grows with it, until the term is gone. A new actor then takes K frames at that slow
//! rate to be confirmed, which nobody has asked about. The drives are those of [`POLICY`], which gives each camera its
//! demand and no more, under both readings of l_0.

use zhuyi_scenario::System;
use zhuyi_sim::DecisionError;

use super::tally::Tally;
use super::{Allocating, Budgets};
use crate::beyond::{Comparison, Line};
use zhuyi_batch::progress::Progress;

/// Who drives for the figure: rates are what is asked for, in full.
pub const POLICY: &str = "demand-only";

/// Who drives for the table: at the smaller budgets of the plan.
pub const IN_TABLE: &str = "demand-hysteresis";

/// [Hz] budgets above this are not looked at: they are enough under both.
const SCARCE: f64 = 30.0;

/// [Hz] enough for 30 on each of five cameras and more.
const PLENTY: f64 = 1e4;

/// [s] and [FPR].
type Points = Vec<(f64, f64)>;

/// Both readings of l_0.
#[derive(Clone, Debug, PartialEq)]
pub struct Feedback {
    /// The demand on the first analysed camera over the drive in which both differ the most.
    pub comparison: Comparison,
    /// Collisions of [`IN_TABLE`] at each budget, with l_0 fixed and literal.
    pub collisions: Vec<(f64, [Tally; 2])>,
}

/// None where budgets are those of an accelerator.
pub(super) fn feedback(
    plan: &Allocating,
    progress: &dyn Progress,
) -> Result<Option<Feedback>, DecisionError> {
    let Budgets::Fps(budgets) = &plan.budgets else {
        return Ok(None);
    };
    let systems = [Some(1.0 / 30.0), None].map(|l_0| {
        let mut system = plan.system.clone();
        system.online.current_latency = l_0;
        system
    });
    let scarce = || budgets.iter().filter(|budget| **budget <= SCARCE);
    progress.start(
        "drives with the literal l_0",
        (scarce().count() * systems.len() * plan.drives().len()) as u64,
    );
    let collisions = scarce()
        .map(|budget| {
            let [fixed, literal] = &systems;
            let tally = |system| plan.tally(system, (IN_TABLE, *budget), progress);
            Ok((*budget, [tally(fixed)?, tally(literal)?]))
        })
        .collect::<Result<_, DecisionError>>()?;
    Ok(Some(Feedback {
        comparison: comparison(plan, &systems)?,
        collisions,
    }))
}

/// The drives of seed 0 in which the demands under both readings lie furthest apart in the mean over the time that both
/// last.
fn comparison(plan: &Allocating, systems: &[System; 2]) -> Result<Comparison, DecisionError> {
    let eyes = &plan.system.perception.eyes;
    let camera = eyes.iter().position(|eye| eye.camera.analysed);
    let camera = camera.unwrap_or_default();
    let points = |scenario: usize, system: &System| -> Result<Points, DecisionError> {
        let spec = plan.spec(scenario, system, 0).under_policy(POLICY, PLENTY);
        let run = spec.unwrap_or_else(|error| panic!("{error}")).run()?;
        let point = |asked: &zhuyi_sim::Asked| (asked.time.seconds(), asked.demands[camera].fpr);
        Ok(run.decisions.iter().map(point).collect())
    };
    let mut furthest: Option<(f64, usize, [Points; 2])> = None;
    for scenario in 0..plan.scenarios.len() {
        let [fixed, literal] = systems;
        let lines = [points(scenario, fixed)?, points(scenario, literal)?];
        let pairs = lines[0].iter().zip(&lines[1]);
        let count = pairs.len().max(1) as f64;
        let apart = pairs.map(|(a, b)| (a.1 - b.1).abs()).sum::<f64>() / count;
        if furthest.as_ref().is_none_or(|(most, ..)| apart > *most) {
            furthest = Some((apart, scenario, lines));
        }
    }
    let (_, scenario, [fixed, literal]) = furthest.unwrap_or_default();
    let line = |name, points| Line { name, points };
    Ok(Comparison {
        option: "feedback",
        scenario: plan.scenarios[scenario].name.clone(),
        camera: eyes[camera].camera.name.clone(),
        lines: vec![line("l_0 = 1/30 s", fixed), line("l_0 = 1/rate", literal)],
        marks: Vec::new(),
    })
}
