//! One drive under a policy, in figures.
//!
//! Jerk is the root mean square of the change of the ego's acceleration from step to step over the time of a step, in
//! m/s3. An alarm speaks [`HORIZON`] ahead. Left out: lateral jerk.

use zhuyi_scenario::Scenario;
use zhuyi_scheduler::score::{Score, score};
use zhuyi_sim::{DecisionError, Frames, Outcome, RunRecord, RunSpec, STEP};

/// [s] X: a collision that comes later than this after an alarm was not what it spoke of.
pub const HORIZON: f64 = 3.0;

/// A drive in figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// The contact, if there was one.
    pub collision: Option<Severity>,
    /// [s] how long it took.
    pub seconds: f64,
    /// Frames of all cameras together.
    pub frames: Frames,
    /// Frames that all cameras at 30 FPR would have sent to the accelerator and that were not sent.
    pub avoided: u64,
    /// [m/s2] hardest braking.
    pub decel: f64,
    /// [m/s3] root mean square of the jerk.
    pub jerk: f64,
    /// The alarms against the collision.
    pub alarms: Score,
}

/// How bad a contact was; no figures where the crash solver has refused the state of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Severity {
    /// [m/s] change of the ego's velocity by the impact.
    pub delta_v: Option<f64>,
}

/// Drives once under a policy with a budget [Hz]. `future` is what the policy `clairvoyant` is told.
///
/// # Errors
/// If the policy fails.
///
/// # Panics
/// If there is no policy of that name, or the budget is not positive and finite.
pub fn drive(
    spec: RunSpec,
    (name, budget): (&str, f64),
    future: Vec<Vec<f64>>,
) -> Result<Driven, DecisionError> {
    let scenario = spec.scenario().clone();
    let spec = spec.under_policy(name, budget);
    let spec = spec.unwrap_or_else(|error| panic!("{error}"));
    let run = spec.with_known_future(future).run()?;
    Ok(Driven::new(&scenario, &run))
}

impl Driven {
    fn new(scenario: &Scenario, run: &RunRecord) -> Self {
        let (collision, end) = match &run.outcome {
            Outcome::Completed => (None, scenario.duration),
            Outcome::Collision(collision) => {
                let crash = collision.crash.as_ref().ok();
                let severity = Severity {
                    delta_v: crash.map(|crash| crash.ego.delta_v),
                };
                (Some(severity), collision.time)
            }
        };
        let seconds = end.seconds();
        let mut frames = Frames::default();
        for of in &run.frames {
            frames.exposed += of.exposed;
            frames.processed += of.processed;
            frames.dropped += of.dropped;
        }
        let timeline: Vec<(f64, bool)> = run
            .decisions
            .iter()
            .map(|asked| (asked.time.seconds(), asked.alarms.contains(&true)))
            .collect();
        let contact = collision.map(|_| seconds);
        Self {
            collision,
            seconds,
            frames,
            avoided: run.frames.iter().map(|of| of.avoided(seconds)).sum(),
            decel: run.extremes(&scenario.road).decel,
            jerk: jerk(run),
            alarms: score(&timeline, contact, HORIZON),
        }
    }
}

fn jerk(run: &RunRecord) -> f64 {
    let accels: Vec<f64> = run.trace.rows().map(|row| row.ego.accel).collect();
    let squares = accels
        .windows(2)
        .map(|pair| ((pair[1] - pair[0]) / STEP.seconds()).powi(2));
    let count = accels.len().saturating_sub(1);
    if count == 0 {
        return 0.0;
    }
    (squares.sum::<f64>() / count as f64).sqrt()
}
