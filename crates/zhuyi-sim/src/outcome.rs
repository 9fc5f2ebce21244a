//! How a run ended, and what it took.

use zhuyi_core::approach::{closes, time_to_collision};
use zhuyi_core::boxes::{distance, swept_gap};
use zhuyi_core::camera::FULL_RATE;
use zhuyi_core::{ActorId, Body, LaneFrame, Road, SimTime};
use zhuyi_world::crash::CrashError;
use zhuyi_world::{Crash, Progress, Side};

use crate::online::Asked;
use crate::trace::Trace;
use crate::witness::Witness;

/// Record of a finished run.
#[derive(Debug)]
pub struct RunRecord {
    /// How it ended.
    pub outcome: Outcome,
    /// Frames of each camera, in the order of the rig.
    pub frames: Vec<Frames>,
    /// How far the manoeuvres of each actor came: in the order of the actors, and of their scripts.
    pub manoeuvres: Vec<Vec<Progress>>,
    /// What was true at every step; empty where the specification leaves it out.
    pub trace: Trace,
    /// What was known at every step, where it was asked for.
    pub witness: Option<Witness>,
    /// Every decision about the rates, in order; empty where rates stay and nothing is estimated.
    pub decisions: Vec<Asked>,
}

/// How a run ended.
#[derive(Debug)]
pub enum Outcome {
    /// The scenario's time was over, or the run ended before, and the ego had touched nothing.
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
    /// Whether it was struck from behind: by an actor that closed in on the rear half of its box.
    pub from_behind: bool,
    /// Whether the ego had confirmed the actor by the end of the step of the contact.
    pub confirmed: bool,
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
        let all = (FULL_RATE * seconds).round() as u64;
        all.saturating_sub(self.exposed - self.dropped)
    }
}

/// How close it was: the extremes over a run and the actors in the ego's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// [m] smallest distance of the boxes of the ego and of an actor ahead that overlaps it sideways; 0 where it touched one.
    pub gap: Option<f64>,
    /// [s] smallest time to collision with such an actor: the ego's way to its box over the closing speed, along the ego's lane
    /// ([`swept_gap`], [`time_to_collision`]).
    pub time_to_collision: Option<f64>,
    /// [m/s2] hardest braking of the ego.
    pub decel: f64,
}

impl RunRecord {
    /// Whether the ego touched something.
    pub fn collided(&self) -> bool {
        matches!(self.outcome, Outcome::Collision(_))
    }

    /// How close it was, on the road of the run; of an empty trace nothing is known.
    pub fn extremes(&self, road: &Road) -> Extremes {
        let mut extremes = Extremes {
            gap: None,
            time_to_collision: None,
            decel: 0.0,
        };
        for row in self.trace.rows() {
            if -row.ego.accel > extremes.decel {
                extremes.decel = -row.ego.accel;
            }
            let lane = LaneFrame::at(road, row.ego.road.d);
            let ahead =
                |actor: &&Body| actor.overlaps_sideways(row.ego) && actor.road.s > row.ego.road.s;
            for actor in row.actors.iter().filter(ahead) {
                if lane.is_reference_line() {
                    extremes.take(row.ego, actor);
                } else {
                    extremes.take(&lane.body(row.ego), &lane.body(actor));
                }
            }
        }
        if self.collided() {
            extremes.gap = Some(0.0);
        }
        extremes
    }
}

impl Extremes {
    /// Takes an actor ahead that overlaps the ego sideways, both along the ego's lane.
    fn take(&mut self, ego: &Body, actor: &Body) {
        // The gap of the boxes is never less than that of their half extents; nor is their distance, but that in a bend the
        // straight line is shorter than the lane, over less than half a circle not by half.
        let (least, closing) = (actor.rear() - ego.front(), ego.s_rate - actor.s_rate);
        if self.gap.is_none_or(|gap| least / 2.0 < gap) {
            let aligned = ego.turn == 0.0 && actor.turn == 0.0;
            let distance = || distance((ego.footprint, ego.pose), (actor.footprint, actor.pose));
            let gap = if aligned { least } else { distance() };
            if gap >= 0.0 {
                lower(&mut self.gap, gap);
            }
        }
        let sooner = |time: f64| self.time_to_collision.is_none_or(|least| time < least);
        if closes(closing) && sooner(least / closing) {
            let time = swept_gap(ego, actor).and_then(|gap| time_to_collision(gap, closing));
            if let Some(time) = time {
                lower(&mut self.time_to_collision, time);
            }
        }
    }
}

fn lower(least: &mut Option<f64>, value: f64) {
    if least.is_none_or(|l| value < l) {
        *least = Some(value);
    }
}
