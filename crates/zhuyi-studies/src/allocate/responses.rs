//! What the three responses of the paper to an alarm are worth, beside recording it alone.
//!
//! The same drives as in the grid, under two policies, one that looks at no demand and one that does, at the budgets of
//! the plan that leave something to mend: [`SCARCE`] at most. An alarm that is heeded prevents the collision that would
//! have proved it, so alarms are scored where they change nothing, and responses by the collisions that are left.

use zhuyi_scheduler::safety::Response;
use zhuyi_sim::DecisionError;

use super::tally::Tally;
use super::{Allocating, Budgets};
use zhuyi_batch::progress::Progress;

/// [Hz] budgets above this are enough for every scenario at the largest minimum rate of the paper.
pub const SCARCE: f64 = 25.0;

/// The policies.
const POLICIES: [&str; 2] = ["uniform", "demand-hysteresis"];

/// The responses, with the words for them. What the paper leaves open about the second is ours: a quarter more compute,
/// 5 m/s less, half a second more headway.
pub const RESPONSES: [(&str, Response); 4] = [
    ("recorded alone", Response::None),
    ("emergency back-up", Response::EmergencyBackup),
    (
        "limited functionality",
        Response::LimitedFunctionality {
            freed_share: 0.25,
            lower_speed: 5.0,
            longer_headway: 0.5,
        },
    ),
    ("rates raised", Response::RaiseRates),
];

/// What a response comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// Under which policy.
    pub policy: &'static str,
    /// [Hz] with what budget.
    pub budget: f64,
    /// Of each response, in the order of [`RESPONSES`].
    pub tallies: Vec<Tally>,
}

/// All responses at the scarce budgets of the plan; none where budgets are those of an accelerator.
pub(super) fn answered(
    plan: &Allocating,
    progress: &dyn Progress,
) -> Result<Vec<Answered>, DecisionError> {
    let Budgets::Fps(budgets) = &plan.budgets else {
        return Ok(Vec::new());
    };
    let scarce = budgets.iter().copied().filter(|budget| *budget <= SCARCE);
    let rows: Vec<(&str, f64)> = POLICIES
        .into_iter()
        .flat_map(|policy| scarce.clone().map(move |budget| (policy, budget)))
        .collect();
    let systems = RESPONSES.map(|(_, response)| {
        let mut system = plan.system.clone();
        system.online.response = response;
        system
    });
    progress.start(
        "drives with responses to alarms",
        (rows.len() * systems.len() * plan.drives().len()) as u64,
    );
    rows.into_iter()
        .map(|(policy, budget)| {
            let tallies = systems
                .iter()
                .map(|system| plan.tally(system, (policy, budget), progress));
            Ok(Answered {
                policy,
                budget,
                tallies: tallies.collect::<Result<_, _>>()?,
            })
        })
        .collect()
}
