//! What a run knew: beliefs and rates at every step, and what became of every frame. Recorded for those who look at a run
//! afterwards; nothing in the loop reads it, and a run without it does not pay for it.
//!
//! ```text
//!  frame:   exposed ──latency──▶ ready ──next step──▶ taken, if the run lasts as long
//!  belief:  what the planner was handed at a step, and beside it who was found but not yet confirmed
//! ```
//!
//! Left out: frames that were overtaken by a later one of their camera (reading R15), and what a frame measured.

use zhuyi_core::{ActorId, CameraId, Frame, SimTime};
use zhuyi_perception::tracker::Knowledge;
use zhuyi_perception::{Eyes, Tracker};

/// The record of what a run knew. Its rows are those of the trace.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Witness {
    /// Row after row, one per actor.
    beliefs: Vec<Knowledge>,
    /// [Hz] row after row, one per camera.
    rates: Vec<f64>,
    frames: Vec<Taken>,
    actors: usize,
    cameras: usize,
}

/// What became of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    /// Whose it is.
    pub camera: CameraId,
    /// When it was exposed.
    pub exposed: SimTime,
    /// When its result was ready.
    pub ready: SimTime,
    /// The step from which on the ego knew it; none when the run ended before.
    pub taken: Option<SimTime>,
    /// Who was found in it, in order.
    pub found: Vec<ActorId>,
}

impl Taken {
    fn new(frame: &Frame, taken: Option<SimTime>) -> Self {
        Self {
            camera: frame.camera,
            exposed: frame.exposed,
            ready: frame.ready,
            taken,
            found: frame.detections.iter().map(|found| found.actor).collect(),
        }
    }

    /// Whether an actor was found in it.
    pub fn shows(&self, actor: ActorId) -> bool {
        self.found.contains(&actor)
    }
}

impl Witness {
    /// Of a run with so many actors and cameras, before its first step.
    pub(crate) fn new(actors: usize, cameras: usize) -> Self {
        Self {
            actors,
            cameras,
            ..Self::default()
        }
    }

    /// A step has been planned at `now`.
    pub(crate) fn step(&mut self, now: SimTime, tracker: &Tracker, eyes: &Eyes) {
        let actors = (0..self.actors).map(|place| ActorId(place as u32));
        self.beliefs
            .extend(actors.map(|actor| tracker.knowledge(actor, now)));
        let cameras = (0..self.cameras).map(|place| CameraId(place as u8));
        self.rates.extend(cameras.map(|camera| eyes.rate(camera)));
    }

    /// The tracker has taken a frame.
    pub(crate) fn taken(&mut self, now: SimTime, frame: &Frame) {
        self.frames.push(Taken::new(frame, Some(now)));
    }

    /// The run is over: what has been exposed and not become ready.
    pub(crate) fn end(&mut self, in_flight: &[Frame]) {
        let open = in_flight.iter().map(|frame| Taken::new(frame, None));
        self.frames.extend(open);
        self.frames
            .sort_by_key(|frame| (frame.exposed, frame.camera));
    }

    /// What was known of the actors at a row, in their order.
    pub fn beliefs(&self, row: usize) -> &[Knowledge] {
        &self.beliefs[row * self.actors..(row + 1) * self.actors]
    }

    /// [Hz] the rates of the cameras at a row, in the order of the rig.
    pub fn rates(&self, row: usize) -> &[f64] {
        &self.rates[row * self.cameras..(row + 1) * self.cameras]
    }

    /// All frames, in the order of exposure.
    pub fn frames(&self) -> &[Taken] {
        &self.frames
    }
}
