//! Notes on a run: what its actors and its ego did that no figure of it tells.
//!
//! | note | from the first to the last step at which |
//! |---|---|
//! | actors in each other | the boxes of two actors overlap: actors do not touch each other, they pass through |
//! | off the road | a side of a vehicle's box lies beyond the edge of the road |
//! | past the end | a vehicle's front lies beyond the end of the road |
//!
//! Boxes count as they stand. Each stretch of time is a note of its own. They are found in the trace once a run is over: a run that
//! nobody asks for notes does not pay for them.

use zhuyi_core::{ActorId, Body, Footprint, Pose, Road, SimTime};
use zhuyi_world::contact::overlap;

use crate::trace::{Row, Trace};

/// [m] a box lies beyond an edge from here on: less is rounding.
const BEYOND: f64 = 1e-6;

/// A vehicle of a run: an actor, or the ego.
pub type Vehicle = Option<ActorId>;

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// Two actors are in each other.
    Through(ActorId, ActorId),
    /// A vehicle is beyond the edge of the road.
    OffRoad(Vehicle),
    /// A vehicle is past the end of the road.
    PastEnd(Vehicle),
}

/// Something that happened in a run, and when.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Note {
    /// What.
    pub subject: Subject,
    /// The first step at which it holds.
    pub from: SimTime,
    /// The last step at which it holds.
    pub until: SimTime,
}

impl Subject {
    /// Its kind, as documents spell it.
    pub const fn kind(self) -> &'static str {
        match self {
            Self::Through(..) => "actors_in_each_other",
            Self::OffRoad(_) => "off_road",
            Self::PastEnd(_) => "past_end",
        }
    }
}

impl Note {
    /// The note in words; `names` are those of the trace: the ego, then the actors.
    pub fn text(&self, names: &[String]) -> String {
        let name = |vehicle: Vehicle| {
            let place = vehicle.map_or(0, |actor| actor.index() + 1);
            names.get(place).map_or("", String::as_str)
        };
        let during = format!(
            "from {:.2} to {:.2} s",
            self.from.seconds(),
            self.until.seconds()
        );
        match self.subject {
            Subject::Through(one, other) => format!(
                "`{}` and `{}` drive through each other {during}",
                name(Some(one)),
                name(Some(other))
            ),
            Subject::OffRoad(vehicle) => {
                format!(
                    "`{}` is beyond the edge of the road {during}",
                    name(vehicle)
                )
            }
            Subject::PastEnd(vehicle) => {
                format!("`{}` is past the end of the road {during}", name(vehicle))
            }
        }
    }
}

/// The notes of a trace on a road, in the order in which they begin.
pub fn notes(trace: &Trace, road: &Road) -> Vec<Note> {
    let mut notes = Notes::default();
    let actors = trace.names().len().saturating_sub(1);
    for row in trace.rows() {
        for (vehicle, body) in vehicles(&row) {
            if is_off(body, road) {
                notes.holds(Subject::OffRoad(vehicle), row.time);
            }
            if road.lap().is_none() && body.front() > road.length() {
                notes.holds(Subject::PastEnd(vehicle), row.time);
            }
        }
        for one in 0..actors {
            for other in one + 1..actors {
                if are_in_each_other(&row.actors[one], &row.actors[other]) {
                    let pair = (ActorId(one as u32), ActorId(other as u32));
                    notes.holds(Subject::Through(pair.0, pair.1), row.time);
                }
            }
        }
        notes.close(row.time);
    }
    notes.finish()
}

fn vehicles<'a>(row: &Row<'a>) -> impl Iterator<Item = (Vehicle, &'a Body)> {
    let actors = (0..).map(ActorId).map(Some).zip(row.actors);
    std::iter::once((None, row.ego)).chain(actors)
}

/// Whether a side of a box lies beyond an edge of the road.
fn is_off(body: &Body, road: &Road) -> bool {
    let edge = f64::from(road.lanes()) * road.lane_width() / 2.0 + BEYOND;
    body.road.d.abs() + body.extent.width / 2.0 > edge
}

/// Whether two boxes overlap in the world.
fn are_in_each_other(one: &Body, other: &Body) -> bool {
    let reach = one.footprint.radius() + other.footprint.radius();
    let (x, y) = (one.pose.x - other.pose.x, one.pose.y - other.pose.y);
    let placed = |body: &Body| -> (Footprint, Pose) { (body.footprint, body.pose) };
    x.abs() < reach && y.abs() < reach && overlap(placed(one), placed(other)).is_some()
}

/// Notes under way, and those that are over.
#[derive(Debug, Default)]
struct Notes {
    /// Those that held at the last step; few.
    open: Vec<Note>,
    over: Vec<Note>,
}

impl Notes {
    /// A subject holds at a step.
    fn holds(&mut self, subject: Subject, time: SimTime) {
        match self.open.iter_mut().find(|note| note.subject == subject) {
            Some(note) => note.until = time,
            None => self.open.push(Note {
                subject,
                from: time,
                until: time,
            }),
        }
    }

    /// A step is over: what has not held at it is.
    fn close(&mut self, time: SimTime) {
        let over = self.open.extract_if(.., |note| note.until < time);
        self.over.extend(over);
    }

    fn finish(mut self) -> Vec<Note> {
        self.over.append(&mut self.open);
        self.over.sort_by_key(|note| (note.from, note.subject));
        self.over
    }
}
