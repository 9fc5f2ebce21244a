//! What reads as valid must drive: a few seconds of it, without a panic or a number that is none.

use zhuyi_core::SimTime;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, System};
use zhuyi_sim::{Hindsight, RunSpec, STEP};

/// Steps of a drive with five cameras and few actors.
const STEPS: usize = 200;

/// How much one drive may cost: a camera that looks at an actor past another one, in every step.
const WORK: f64 = 200_000.0;

/// Drives a valid scenario as far as an input has time for, with the estimate in the loop and in hindsight.
pub fn drive(scenario: &Scenario, system: &System) {
    let (bodies, cameras) = (scenario.actors.len() + 1, system.perception.eyes.len());
    let fastest = system
        .default_rates
        .all()
        .iter()
        .copied()
        .fold(1.0, f64::max);
    let looks = (bodies * bodies * cameras) as f64 * (fastest / 100.0).max(1.0);
    let steps = ((WORK / looks) as usize).clamp(3, STEPS);
    let mut short = scenario.clone();
    short.duration = short
        .duration
        .min(SimTime::from_nanos(steps as i64 * STEP.nanos()));
    let rates = &system.default_rates;
    let run = RunSpec::new(short.clone(), system.clone())
        .estimated()
        .run_fixed();
    for row in run.trace.rows() {
        for body in std::iter::once(row.ego).chain(row.actors) {
            let numbers = [
                body.pose.x,
                body.pose.y,
                body.pose.heading,
                body.speed,
                body.accel,
            ];
            assert!(numbers.iter().all(|number| number.is_finite()), "{body:?}");
        }
    }
    let estimator = Estimator::new(system.estimator.clone());
    let hindsight = Hindsight::new(&run.trace, &scenario.road, system, rates);
    let rows = run.trace.rows().step_by(50);
    let demands = rows.flat_map(|row| hindsight.demands(&estimator, &row));
    for demand in run
        .decisions
        .into_iter()
        .flat_map(|asked| asked.demands)
        .chain(demands)
    {
        assert!(demand.fpr.is_finite() && demand.fpr > 0.0, "{demand:?}");
    }
}
