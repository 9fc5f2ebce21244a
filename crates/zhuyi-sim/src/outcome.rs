//! How a run ended, and what it took.

use zhuyi_core::{ActorId, Body, SimTime};
use zhuyi_scheduler::sharing::CAP;
use zhuyi_world::crash::CrashError;
use zhuyi_world::{Crash, Side};

use crate::trace::Trace;
use crate::witness::Witness;

/// A finished run.
#[derive(Debug)]
pub struct Run {
    /// How it ended.
    pub outcome: Outcome,
    /// Frames of each camera, in the order of the rig.
    pub frames: Vec<Frames>,
    /// What was true at every step.
    pub trace: Trace,
    /// What was known at every step, where it was asked for.
    pub witness: Option<Witness>,
}

/// How a run ended.
#[derive(Debug)]
pub enum Outcome {
    /// The scenario's time was over and the ego had touched nothing.
    Completed,
    /// The ego touched an actor.
    Collision(Collision),
}

/// The first contact of the ego.
#[derive(Debug)]
pub struct Collision {
    /// When.
    pub time: SimTime,
    /// Whom.
    pub actor: ActorId,
    /// With which of its sides.
    pub side: Side,
    /// What it did to both.
    pub crash: Result<Crash, CrashError>,
}

/// How much a camera saw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Frames {
    /// Pictures taken.
    pub exposed: u64,
    /// Pictures processed within the run.
    pub processed: u64,
    /// Pictures lost on their way, or dropped while they waited for the accelerator: they were never transferred to it.
    pub dropped: u64,
}

impl Frames {
    /// Pictures that a camera at 30 FPR would have sent to the accelerator in a run of `seconds` and that were not sent:
    /// the transfers avoided (the paper's section on a Zhuyi-based system).
    ///
    /// 40 pictures in 2 s, of which 4 were dropped: 60 - 36.
    /// ```
    /// use zhuyi_sim::Frames;
    /// let frames = Frames { exposed: 40, processed: 35, dropped: 4 };
    /// assert_eq!(frames.avoided(2.0), 24);
    /// ```
    pub fn avoided(&self, seconds: f64) -> u64 {
        let all = (CAP * seconds).round() as u64;
        all.saturating_sub(self.exposed - self.dropped)
    }
}

/// How close it was: the extremes over a run and the actors in the ego's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// [m] smallest gap, bumper to bumper, to an actor ahead whose side-to-side extent overlaps the ego's.
    pub gap: Option<f64>,
    /// [s] smallest time to collision with such an actor: gap over closing speed (Hayward 1972).
    pub time_to_collision: Option<f64>,
    /// [m/s2] hardest braking of the ego.
    pub decel: f64,
}

impl Run {
    /// Whether the ego touched something.
    pub fn collided(&self) -> bool {
        matches!(self.outcome, Outcome::Collision(_))
    }

    /// How close it was.
    pub fn extremes(&self) -> Extremes {
        let mut extremes = Extremes {
            gap: None,
            time_to_collision: None,
            decel: 0.0,
        };
        for row in self.trace.rows() {
            if -row.ego.accel > extremes.decel {
                extremes.decel = -row.ego.accel;
            }
            for actor in row.actors.iter().filter(|actor| ahead(row.ego, actor)) {
                let gap = actor.rear() - row.ego.front();
                lower(&mut extremes.gap, gap);
                let closing = row.ego.s_rate - actor.s_rate;
                if closing > 0.0 {
                    lower(&mut extremes.time_to_collision, gap / closing);
                }
            }
        }
        extremes
    }
}

/// Whether `actor` is ahead of the ego and overlaps it side to side.
fn ahead(ego: &Body, actor: &Body) -> bool {
    actor.rear() >= ego.front() && actor.overlaps_sideways(ego)
}

fn lower(least: &mut Option<f64>, value: f64) {
    if least.is_none_or(|l| value < l) {
        *least = Some(value);
    }
}
