//! Why a collision happened: when the other could first be known of, and what each stage on the way from there to the brakes
//! cost in time and in metres.
//!
//! ```text
//!  exposed ─▶ captured ─▶ processed ─▶ confirmed ─▶ planned ─▶ brake on ─▶ contact
//!          wait for     latency      K frames in    planner    actuator    braking
//!          the shutter               a row
//!
//!  metres of a stage = D(its time) - D(time of the stage before),   D(t) = ∫ v dt
//! ```
//!
//! | stage | when |
//! |---|---|
//! | exposed | the actor came into sight: from this step on some camera sees it without a break (reading R17), up to the frames that confirmed it; or, for an actor that was confirmed before it became dangerous, the step at which it did |
//! | captured | the first exposure from there on in which it was found, unless the planner acted on an older one |
//! | processed | the step from which on the ego knew that frame |
//! | confirmed | the step from which on the planner was told of it (reading R16) |
//! | planned | the first step from there on at which the planner braked hard or evaded |
//! | brake on | the first from there on at which the ego slowed down by [`BRAKE_ON`] of what the planner asked for |
//! | contact | the instant of the contact |
//!
//! An actor is dangerous from the step on from which the ego's own planner, on the way that was driven, but told of this actor
//! exactly and at once, would brake hard or evade until the contact. Where the planner then acted on a frame from before that
//! step, that frame is the one told of: waiting for it to be exposed cost nothing, and nor did its processing where it was over.
//!
//! Left out: what the other could have done, other actors that the ego braked for, and how much of a step (10 ms) the stages
//! that are told by steps are late. A stage that was not reached before the contact has no time, and its metres count for
//! the next one that was.

mod chain;

use zhuyi_core::{ActorId, Manoeuvre, SimTime};
use zhuyi_scenario::{Scenario, System};

use crate::outcome::{Outcome, RunRecord};
use crate::trace::{Row, Trace};
use chain::Chain;

/// [-] share of the deceleration asked for at which the brakes count as on.
pub const BRAKE_ON: f64 = 0.9;

/// A stage on the way to the contact, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// It could be known of.
    Exposed,
    /// It was in a picture.
    Captured,
    /// That picture was processed.
    Processed,
    /// It was believed in.
    Confirmed,
    /// Hard braking, or evading, was decided on.
    Planned,
    /// The brakes had taken hold.
    BrakeOn,
    /// It was touched.
    Contact,
}

impl Stage {
    /// All, in order.
    pub const ALL: [Self; 7] = [
        Self::Exposed,
        Self::Captured,
        Self::Processed,
        Self::Confirmed,
        Self::Planned,
        Self::BrakeOn,
        Self::Contact,
    ];

    /// Its name in files.
    ///
    /// ```
    /// assert_eq!(zhuyi_sim::Stage::BrakeOn.name(), "brake_on");
    /// ```
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exposed => "exposed",
            Self::Captured => "captured",
            Self::Processed => "processed",
            Self::Confirmed => "confirmed",
            Self::Planned => "planned",
            Self::BrakeOn => "brake_on",
            Self::Contact => "contact",
        }
    }
}

/// What the chain began with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The actor came into sight.
    Sight,
    /// It had been known, and became dangerous.
    Danger,
    /// It had been known, and even exact and instant knowledge of it would not have made the planner brake hard.
    Never,
}

impl Cause {
    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sight => "came_into_sight",
            Self::Danger => "became_dangerous",
            Self::Never => "never_dangerous",
        }
    }
}

/// A stage and what it cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Which.
    pub stage: Stage,
    /// When it was reached; none when it was not.
    pub time: Option<SimTime>,
    /// [m] covered by the ego since the last stage that was reached; 0 for the first and for those not reached.
    pub metres: f64,
    /// [m/s] the ego's speed then.
    pub speed: Option<f64>,
}

/// The way to a collision.
#[derive(Clone, Debug, PartialEq)]
pub struct Waterfall {
    /// Who was touched.
    pub actor: ActorId,
    /// What it began with.
    pub cause: Cause,
    /// All stages, in order.
    pub steps: [Step; 7],
    /// When, from the step of planned on, the planner first left its lane to evade, with which the brakes may never come on.
    pub evading_from: Option<SimTime>,
    /// [m] from bumper to bumper along the road when the actor was exposed; negative where they were side by side.
    pub gap: Option<f64>,
    /// [m] covered by the actor along the road from exposed to contact.
    pub actor_metres: Option<f64>,
}

impl Waterfall {
    /// Of a run with a trace and a record of what it knew; none where there was no collision or no such record. It is told by the
    /// built-in stages, whatever others the run had.
    pub fn of(scenario: &Scenario, system: &System, run: &RunRecord) -> Option<Self> {
        let Outcome::Collision(collision) = &run.outcome else {
            return None;
        };
        if run.trace.is_empty() {
            return None;
        }
        let chain = Chain {
            scenario,
            system,
            trace: &run.trace,
            witness: run.witness.as_ref()?,
            actor: collision.actor,
        };
        let (cause, times) = chain.times(collision.time);
        let driven = Driven::new(&run.trace);
        let mut before = None;
        let steps = [0, 1, 2, 3, 4, 5, 6].map(|place| {
            let time: Option<SimTime> = times[place];
            let at = time.map(|time| driven.at(time.seconds()));
            let metres = at.map_or(0.0, |(metres, _)| metres - before.unwrap_or(metres));
            before = at.map(|(metres, _)| metres).or(before);
            Step {
                stage: Stage::ALL[place],
                time,
                metres,
                speed: at.map(|(_, speed)| speed),
            }
        });
        let evades = |row: &Row<'_>| row.command.manoeuvre == Manoeuvre::Evade;
        let evading_from = times[4].and_then(|planned| {
            let mut rows = run.trace.rows();
            let row = rows.find(|row| row.time >= planned && evades(row));
            row.map(|row| row.time)
        });
        let row = times[0].and_then(|time| run.trace.rows().find(|row| row.time >= time));
        let other = |row: &Row<'_>| row.actors[collision.actor.index()];
        let last = run.trace.rows().last();
        Some(Self {
            actor: collision.actor,
            cause,
            steps,
            evading_from,
            gap: row.map(|row| other(&row).rear() - row.ego.front()),
            actor_metres: row.zip(last).map(|(row, last)| {
                let rest = (collision.time - last.time).seconds();
                let from = other(&row).road.s;
                let to = run.trace.nearest_lap(other(&last).road.s, from);
                to - from + other(&last).s_rate * rest
            }),
        })
    }

    /// [m] covered by the ego from exposed to contact.
    pub fn metres(&self) -> f64 {
        self.steps.iter().map(|step| step.metres).sum()
    }
}

/// How far the ego had come, by its speed.
struct Driven<'a> {
    trace: &'a Trace,
    /// [m] at every row.
    metres: Vec<f64>,
}

impl<'a> Driven<'a> {
    fn new(trace: &'a Trace) -> Self {
        let mut sum = 0.0;
        let mut last: Option<(f64, f64)> = None;
        let metres = trace.rows().map(|row| {
            let (time, speed) = (row.time.seconds(), row.ego.speed);
            if let Some((before, slower)) = last {
                sum += (time - before) * f64::midpoint(slower, speed);
            }
            last = Some((time, speed));
            sum
        });
        Self {
            metres: metres.collect(),
            trace,
        }
    }

    /// [m] and [m/s] at a time, with the acceleration of the row before it.
    fn at(&self, time: f64) -> (f64, f64) {
        let rows = self.trace.rows();
        let behind = rows.take_while(|row| row.time.seconds() <= time).count();
        let row = behind.saturating_sub(1);
        let Row {
            time: from, ego, ..
        } = self.trace.row(row);
        let speed = |at: f64| (ego.speed + ego.accel * at).max(0.0);
        let since = (time - from.seconds()).max(0.0);
        let later = speed(since);
        (
            self.metres[row] + since * f64::midpoint(ego.speed, later),
            later,
        )
    }
}
