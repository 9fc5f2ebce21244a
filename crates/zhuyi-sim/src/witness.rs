//! What a run knew: beliefs and rates at every step, and what became of every frame. Recorded for those who look at a run
//! afterwards; nothing in the loop reads it, and a run without it does not pay for it.
//!
//! ```text
//!  frame:   exposed ──latency, or the accelerator's queue──▶ ready ──next step──▶ taken, unless dropped
//!  belief:  what the planner was handed at a step, and beside it who was found but not yet confirmed
//! ```
//!
//! Left out: what a frame measured, and why one was dropped.

use zhuyi_core::stages::{Knowledge, Tracker};
use zhuyi_core::{ActorId, CameraId, Frame, SimTime, Track};

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
    /// The step from which on the ego knew it; none when the run ended before, or it was dropped.
    pub taken: Option<SimTime>,
    /// Who was found in it, in order.
    pub found: Vec<ActorId>,
}

impl Taken {
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

    /// A step has been planned at `now`, with these tracks and rates [Hz].
    pub(crate) fn step(
        &mut self,
        now: SimTime,
        tracker: &dyn Tracker,
        tracks: &[Track],
        rates: &[f64],
    ) {
        let actors = (0..self.actors).map(|place| ActorId(place as u32));
        let of_track = |actor: ActorId| {
            let track = tracks.iter().find(|track| track.actor == actor).copied();
            Knowledge {
                confirmed: track.is_some(),
                track,
                found: 0,
                needed: 0,
            }
        };
        let knowledge = |actor| {
            let told = tracker.knowledge(actor, now);
            told.unwrap_or_else(|| of_track(actor))
        };
        self.beliefs.extend(actors.map(knowledge));
        self.rates.extend_from_slice(rates);
    }

    /// Pictures have been taken; some of them may be known already.
    pub(crate) fn exposed<'a>(&mut self, in_flight: impl Iterator<Item = &'a Frame>) {
        for frame in in_flight {
            if self.record(frame).is_none() {
                let record = Taken {
                    camera: frame.camera,
                    exposed: frame.exposed,
                    taken: None,
                    found: frame.detections.iter().map(|found| found.actor).collect(),
                };
                let no_later = |other: &Taken| other.exposed <= record.exposed;
                let place = self.frames.iter().rposition(no_later);
                self.frames.insert(place.map_or(0, |last| last + 1), record);
            }
        }
    }

    /// The tracker has taken a frame.
    pub(crate) fn taken(&mut self, now: SimTime, frame: &Frame) {
        if let Some(record) = self.record(frame) {
            record.taken = Some(now);
        }
    }

    /// The record of a frame. Records stand in the order of exposure.
    fn record(&mut self, frame: &Frame) -> Option<&mut Taken> {
        let records = self.frames.iter_mut().rev();
        let mut late = records.take_while(|record| record.exposed >= frame.exposed);
        late.find(|record| record.camera == frame.camera && record.exposed == frame.exposed)
    }

    /// The run is over.
    pub(crate) fn end(&mut self) {
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
