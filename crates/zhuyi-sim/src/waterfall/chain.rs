//! When each stage of a collision was reached, from the trace and what the run knew. The stages are told in the parent module.

use zhuyi_core::stages::Planner;
use zhuyi_core::{ActorId, Manoeuvre, SimTime, Track};
use zhuyi_perception::View;
use zhuyi_planner::RuleBasedPlanner;
use zhuyi_scenario::{Scenario, System};

use super::{BRAKE_ON, Cause};
use crate::trace::STEP;
use crate::trace::{Row, Trace};
use crate::witness::{Taken, Witness};

/// A collision to be told.
pub(super) struct Chain<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) system: &'a System,
    pub(super) trace: &'a Trace,
    pub(super) witness: &'a Witness,
    pub(super) actor: ActorId,
}

impl Chain<'_> {
    /// What it began with, and when each stage was reached.
    pub(super) fn times(&self, contact: SimTime) -> (Cause, [Option<SimTime>; 7]) {
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
        let captured = from.and_then(|from| self.frame_from(from - STEP));
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
        let mut planner =
            RuleBasedPlanner::new(&self.system.planner, road.clone(), ego.lane, ego.speed);
        let hard: Vec<bool> = self
            .trace
            .rows()
            .map(|row| {
                let track = Track::exact(self.actor, row.time, &row.actors[self.actor.index()]);
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
