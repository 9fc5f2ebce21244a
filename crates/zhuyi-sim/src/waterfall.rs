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

use zhuyi_core::{ActorId, Body, Manoeuvre, SimTime, Track};
use zhuyi_perception::View;
use zhuyi_planner::Planner;
use zhuyi_scenario::{Scenario, System};

use crate::outcome::{Outcome, Run};
use crate::trace::{Row, Trace};
use crate::witness::{Taken, Witness};

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
    /// [m] from bumper to bumper along the road when the actor was exposed; negative where they were side by side.
    pub gap: Option<f64>,
    /// [m] covered by the actor along the road from exposed to contact.
    pub actor_metres: Option<f64>,
}

impl Waterfall {
    /// Of a run with a record of what it knew; none where there was no collision or no such record.
    pub fn of(scenario: &Scenario, system: &System, run: &Run) -> Option<Self> {
        let Outcome::Collision(collision) = &run.outcome else {
            return None;
        };
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
        let row = times[0].and_then(|time| run.trace.rows().find(|row| row.time >= time));
        let other = |row: &Row<'_>| row.actors[collision.actor.index()];
        let last = run.trace.rows().last();
        Some(Self {
            actor: collision.actor,
            cause,
            steps,
            gap: row.map(|row| other(&row).rear() - row.ego.front()),
            actor_metres: row.zip(last).map(|(row, last)| {
                let rest = (collision.time - last.time).seconds();
                other(&last).road.s - other(&row).road.s + other(&last).s_rate * rest
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

/// A collision to be told.
struct Chain<'a> {
    scenario: &'a Scenario,
    system: &'a System,
    trace: &'a Trace,
    witness: &'a Witness,
    actor: ActorId,
}

impl Chain<'_> {
    /// What it began with, and when each stage was reached.
    fn times(&self, contact: SimTime) -> (Cause, [Option<SimTime>; 7]) {
        let confirmed = self.confirmed();
        let danger = self.danger();
        let known =
            confirmed.is_some_and(|row| row == 0 || danger.is_some_and(|danger| row < danger));
        let mut times = [None; 7];
        times[6] = Some(contact);
        if !known {
            self.by_sight(confirmed, &mut times);
        } else if let Some(danger) = danger {
            self.by_danger(danger, &mut times);
        }
        if let Some(planned) = times[3].and_then(|from| self.hard_from(from)) {
            times[4] = Some(planned);
            times[5] = self.brake_on(planned);
        }
        let cause = match (known, danger) {
            (false, _) => Cause::Sight,
            (true, Some(_)) => Cause::Danger,
            (true, None) => Cause::Never,
        };
        (cause, times)
    }

    /// The row from which on the planner was told of it up to the end.
    fn confirmed(&self) -> Option<usize> {
        let told = |row: usize| self.witness.beliefs(row)[self.actor.index()].confirmed;
        began(self.trace.len(), told)
    }

    fn by_sight(&self, confirmed: Option<usize>, times: &mut [Option<SimTime>; 7]) {
        let time = |row: usize| self.trace.row(row).time;
        let until = confirmed.map(time);
        let visible = self.visible();
        // The frames that confirmed it, or else the last ones, began in the stretch of sight that is told.
        let anchor = match until {
            Some(until) => self.first_of_streak(until),
            None => None,
        };
        let place = match anchor {
            Some(exposed) => {
                let rows = self.trace.rows();
                rows.take_while(|row| row.time < exposed).count()
            }
            None => visible
                .iter()
                .rposition(|seen| *seen)
                .map_or(0, |row| row + 1),
        };
        let end = place.min(visible.len());
        // An exposure may fall between the last step without sight and the first with it.
        let begin = began(end, |row| visible[row]).unwrap_or(end);
        let sight = (begin < visible.len()).then(|| time(begin));
        let from = match (sight, anchor) {
            (Some(sight), Some(anchor)) => Some(sight.min(anchor)),
            (sight, anchor) => sight.or(anchor),
        };
        let slack = SimTime::from_millis(10);
        let captured = from.and_then(|from| self.frame_from(from - slack));
        let exposed = match (from, captured) {
            (Some(from), Some(frame)) => Some(from.min(frame.exposed)),
            (from, _) => from,
        };
        *times = [
            exposed,
            captured.map(|frame| frame.exposed),
            captured.and_then(|frame| frame.taken),
            until,
            None,
            None,
            times[6],
        ];
    }

    fn by_danger(&self, danger: usize, times: &mut [Option<SimTime>; 7]) {
        let exposed = self.trace.row(danger).time;
        // What the planner acted on may have been exposed before the actor became dangerous.
        let planned = self.hard_from(exposed);
        let frame = planned.and_then(|planned| self.newest_at(planned));
        let frame = frame.filter(|frame| frame.exposed < exposed);
        let frame = frame.or_else(|| self.frame_from(exposed));
        let captured = frame.map(|frame| frame.exposed.max(exposed));
        let processed = frame.and_then(|frame| frame.taken);
        let processed = processed.map(|taken| taken.max(exposed));
        *times = [
            Some(exposed),
            captured,
            processed,
            processed,
            None,
            None,
            times[6],
        ];
    }

    /// The newest frame with it that was known at a step.
    fn newest_at(&self, step: SimTime) -> Option<&Taken> {
        let known = |frame: &&Taken| {
            frame.shows(self.actor) && frame.taken.is_some_and(|taken| taken <= step)
        };
        let frames = self.witness.frames().iter().filter(known);
        frames.max_by_key(|frame| frame.exposed)
    }

    /// Whether some camera sees it, at every row.
    fn visible(&self) -> Vec<bool> {
        let perception = &self.system.perception;
        let mut view = View::default();
        let mut sees = |row: Row<'_>| {
            perception.eyes.iter().any(|eye| {
                let boxes = row.actors.iter().map(|body| (body.footprint, body.pose));
                view.look_at_boxes(&eye.camera, row.ego.pose, boxes);
                view.sees(self.actor.index(), perception.visible_share)
            })
        };
        self.trace.rows().map(&mut sees).collect()
    }

    /// The first frame from a time on in which it was found.
    fn frame_from(&self, from: SimTime) -> Option<&Taken> {
        let mut frames = self.witness.frames().iter();
        frames.find(|frame| frame.exposed >= from && frame.shows(self.actor))
    }

    /// The exposure with which the frames in a row began that confirmed it at a step.
    fn first_of_streak(&self, confirmed: SimTime) -> Option<SimTime> {
        let frames = || self.witness.frames().iter();
        let shown = |frame: &&Taken| frame.taken == Some(confirmed) && frame.shows(self.actor);
        let streak = |last: &Taken| {
            let of_camera: Vec<&Taken> = frames()
                .filter(|frame| frame.camera == last.camera && frame.exposed <= last.exposed)
                .collect();
            let streak = of_camera
                .iter()
                .rev()
                .take_while(|frame| frame.shows(self.actor));
            let needed = self.system.perception.eyes[last.camera.index()].confirm_frames;
            let (count, first) = streak.fold((0, last.exposed), |(count, _), frame| {
                (count + 1, frame.exposed)
            });
            (count >= needed).then_some(first)
        };
        frames().filter(shown).filter_map(streak).min()
    }

    /// The row from which on the planner, told of it exactly and at once, would brake hard or evade up to the end.
    fn danger(&self) -> Option<usize> {
        let Scenario { road, ego, .. } = self.scenario;
        let mut planner = Planner::new(&self.system.planner, road, ego.lane, ego.speed);
        let hard: Vec<bool> = self
            .trace
            .rows()
            .map(|row| {
                let track = exact(self.actor, row.time, &row.actors[self.actor.index()]);
                let forecast = self.system.predictor.forecast(&track, road);
                let command = planner.plan(row.time, row.ego, &[track], &[forecast]);
                command.manoeuvre != Manoeuvre::Follow
            })
            .collect();
        began(hard.len(), |row| hard[row])
    }

    /// The first step from a time on at which the planner braked hard or evaded.
    fn hard_from(&self, from: SimTime) -> Option<SimTime> {
        let mut rows = self.trace.rows();
        let hard = |row: &Row<'_>| row.time >= from && row.command.manoeuvre != Manoeuvre::Follow;
        rows.find(hard).map(|row| row.time)
    }

    fn brake_on(&self, planned: SimTime) -> Option<SimTime> {
        let on = |row: &Row<'_>| {
            let asked = row.command.accel;
            row.time >= planned && asked < 0.0 && row.ego.accel <= BRAKE_ON * asked
        };
        self.trace.rows().find(on).map(|row| row.time)
    }
}

/// Where the stretch began that holds at the last of so many rows.
fn began(rows: usize, holds: impl Fn(usize) -> bool) -> Option<usize> {
    let count = (0..rows).rev().take_while(|row| holds(*row)).count();
    (count > 0).then(|| rows - count)
}

/// An actor known exactly and at once.
fn exact(actor: ActorId, time: SimTime, body: &Body) -> Track {
    Track {
        actor,
        time,
        seen: time,
        footprint: body.footprint,
        road: body.road,
        s_rate: body.s_rate,
        s_accel: body.accel,
        d_rate: body.d_rate,
        s_deviation: 0.0,
        d_deviation: 0.0,
    }
}
