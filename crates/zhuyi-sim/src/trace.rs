//! What was true at every step of a run.

use zhuyi_core::{Body, Command, Scene, SimTime};

/// Physics, planning and recording go in steps of 10 ms; exposures do not (reading R15).
pub const STEP: SimTime = SimTime::from_millis(10);

/// The record of a run: one row per step, from the start to the last step before a contact or the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Names of the vehicles: the ego, then the actors in order.
    names: Vec<String>,
    times: Vec<SimTime>,
    commands: Vec<Command>,
    /// All bodies of all rows, row after row.
    bodies: Vec<Body>,
    /// [m] a lap of the road, if that is a ring.
    lap: Option<f64>,
}

/// One step of a trace.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// When.
    pub time: SimTime,
    /// The ego.
    pub ego: &'a Body,
    /// The actors, in order.
    pub actors: &'a [Body],
    /// What the planner asked for at this time.
    pub command: Command,
}

impl Trace {
    /// An empty record of the ego and actors of these names, with room for so many rows.
    pub fn new<'n>(actors: impl Iterator<Item = &'n str>, rows: usize) -> Self {
        let names: Vec<_> = std::iter::once("ego")
            .chain(actors)
            .map(String::from)
            .collect();
        Self {
            times: Vec::with_capacity(rows),
            commands: Vec::with_capacity(rows),
            bodies: Vec::with_capacity(rows * names.len()),
            names,
            lap: None,
        }
    }

    /// The same on a ring of that lap [m], on which every row tells all actors in the laps nearest to the ego.
    #[must_use]
    pub fn round(self, lap: Option<f64>) -> Self {
        Self { lap, ..self }
    }

    /// [m] a lap of the road, none where that is open.
    pub fn lap(&self) -> Option<f64> {
        self.lap
    }

    /// [m] the place `s` in the lap of a ring in which it is nearest to `near_s`; on an open road `s`.
    pub fn nearest_lap(&self, s: f64, near_s: f64) -> f64 {
        self.lap
            .map_or(s, |lap| s + ((near_s - s) / lap).round() * lap)
    }

    /// Adds a row.
    pub(crate) fn push(&mut self, scene: &Scene, command: Command) {
        self.times.push(scene.time);
        self.commands.push(command);
        self.bodies.push(scene.ego);
        self.bodies.extend_from_slice(&scene.actors);
    }

    /// Removes all rows.
    pub(crate) fn clear(&mut self) {
        self.times.clear();
        self.commands.clear();
        self.bodies.clear();
    }

    /// Takes all rows away into a record of their own.
    pub(crate) fn take(&mut self) -> Self {
        Self {
            names: self.names.clone(),
            times: std::mem::take(&mut self.times),
            commands: std::mem::take(&mut self.commands),
            bodies: std::mem::take(&mut self.bodies),
            lap: self.lap,
        }
    }

    /// Names of the vehicles: `ego`, then the actors in order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Row `index`, from 0.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, index: usize) -> Row<'_> {
        let width = self.names.len();
        let row = &self.bodies[index * width..(index + 1) * width];
        Row {
            time: self.times[index],
            ego: &row[0],
            actors: &row[1..],
            command: self.commands[index],
        }
    }

    /// An actor at each row, from the first on.
    pub(crate) fn course(&self, actor: usize) -> impl Iterator<Item = (SimTime, &Body)> {
        let bodies = self.bodies.iter().skip(1 + actor).step_by(self.names.len());
        self.times.iter().copied().zip(bodies)
    }

    /// All rows in order.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = Row<'_>> {
        (0..self.len()).map(|i| self.row(i))
    }
}
