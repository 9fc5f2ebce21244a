//! A recording as read: who was where at which time.
//!
//! A log is a list of steps, each with a time, and of vehicles, each with one row per step at which it was there.
//! Vehicles may appear, vanish and be missing in between. Times are kept as the numbers and as the texts of the file.

use zhuyi_core::{ActorId, Footprint, Pose};

/// A recording; rows and steps in the order of time, vehicles in the order of appearing in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    pub(crate) steps: Vec<Step>,
    pub(crate) vehicles: Vec<Vehicle>,
}

/// One time of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// [s] the time.
    pub time: f64,
    /// The same as it stands in the file.
    pub text: String,
}

/// One vehicle of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Vehicle {
    /// Its name in the file.
    pub id: String,
    /// One row per step at which it is there, in the order of time; not empty.
    pub rows: Vec<Row>,
}

/// One vehicle at one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Place of the step in the log.
    pub step: usize,
    /// Centre and heading of its box in the world.
    pub pose: Pose,
    /// [m/s] speed in the direction of its heading; negative when it reverses.
    pub speed: f64,
    /// [m/s2] rate of change of the speed.
    pub accel: f64,
    /// Its box.
    pub footprint: Footprint,
}

impl Log {
    /// All times.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// All vehicles; their [`ActorId`] is their place here.
    pub fn vehicles(&self) -> &[Vehicle] {
        &self.vehicles
    }

    /// The vehicle of this id in the file.
    pub fn find(&self, id: &str) -> Option<ActorId> {
        let place = self.vehicles.iter().position(|vehicle| vehicle.id == id)?;
        Some(ActorId(place as u32))
    }

    /// A vehicle.
    pub fn vehicle(&self, vehicle: ActorId) -> &Vehicle {
        &self.vehicles[vehicle.index()]
    }
}

impl Vehicle {
    /// Place of the row at a step, if it is there then.
    pub(crate) fn row_at(&self, step: usize) -> Option<usize> {
        self.rows.binary_search_by_key(&step, |row| row.step).ok()
    }

    /// Steps between its first and its last row at which it is missing.
    pub fn missing(&self) -> usize {
        let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) else {
            return 0;
        };
        last.step - first.step + 1 - self.rows.len()
    }
}
