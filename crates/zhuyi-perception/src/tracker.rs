//! Which actors the ego believes in: confirmation and loss.
//!
//! An actor is confirmed, for all cameras, when one camera has found it in K consecutive processed frames. A frame of
//! that camera without it starts its count anew. Until then its detections already feed the filter.
//!
//! ```text
//! in sight    first exposure            K-th exposure       confirmed
//!    ├─ 0..T ────┤├──────── (K - 1) T ────────┤├──── latency ────┤        K..K+1 periods in all, with latency T
//! ```
//!
//! An actor is lost, and must be confirmed anew, when since its last detection by any camera
//! - one camera has processed M frames that should have shown it, or
//! - every camera has processed M frames, whichever way they look: what nobody can see coasts as long as the slowest
//!   camera takes for M frames.
//!
//! A camera should see an actor when the box that is believed at the instant of the exposure lies in its range and whole
//! in its field of view: at the edge of a picture a hand's breadth of error must not count as a miss. Other bodies do
//! not matter: who is hidden is lost like who has gone. All is counted in frames, not in seconds, else a camera at 1 Hz
//! would lose everything (reading R16). Losing an actor that was never confirmed discards its filter and keeps its
//! counts.

use zhuyi_core::stages::{self, Knowledge};
use zhuyi_core::{ActorId, Body, CameraId, Detection, Frame, Pose, Road, SimTime, Track};

use crate::belief::Belief;
use crate::sight::View;
use crate::{Errors, Perception};

/// The visible share of a box that nothing cuts, less what rounding takes off it.
const WHOLE: f64 = 1.0 - 1e-9;

/// Tracker with a Kalman filter per actor.
#[derive(Clone, Debug)]
pub struct KalmanTracker {
    params: Perception,
    /// One per camera.
    errors: Vec<Errors>,
    files: Vec<File>,
    /// One per camera.
    views: Vec<View>,
}

/// All that is kept about one actor.
#[derive(Clone, Debug)]
struct File {
    belief: Option<Belief>,
    confirmed: bool,
    counts: Vec<Counts>,
}

/// Frames of one camera, as they concern one actor.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    /// Consecutive frames with the actor.
    found: u32,
    /// Since its last detection by any camera: frames that should have shown it.
    missed: u32,
    /// Since its last detection by any camera: frames.
    passed: u32,
}

impl KalmanTracker {
    /// A tracker that knows of no one yet, of the `actors` that there are.
    pub fn new(params: &Perception, actors: usize) -> Self {
        let counts = vec![Counts::default(); params.eyes.len()];
        let cameras = (0..params.eyes.len()).map(|index| CameraId(index as u8));
        Self {
            files: vec![
                File {
                    belief: None,
                    confirmed: false,
                    counts
                };
                actors
            ],
            errors: cameras.map(|camera| params.errors_of(camera)).collect(),
            params: params.clone(),
            views: params.eyes.iter().map(|_| View::with_room(1)).collect(),
        }
    }

    /// Tells all beliefs in the laps of a ring in which they are nearest at `now` to the ego at `ego_s` [m]; does nothing on
    /// an open road.
    fn tell_near(&mut self, ego_s: f64, now: SimTime, road: &Road) {
        if road.lap().is_some() {
            for belief in self
                .files
                .iter_mut()
                .filter_map(|file| file.belief.as_mut())
            {
                belief.tell_near(ego_s, now, road);
            }
        }
    }
}

impl stages::Tracker for KalmanTracker {
    fn start(&mut self, frames: &[Frame], _: &Road) {
        for file in &mut self.files {
            (file.belief, file.confirmed) = (None, false);
            file.counts.fill(Counts::default());
        }
        for frame in frames {
            for detection in &frame.detections {
                let file = &mut self.files[detection.actor.index()];
                let errors = &self.errors[frame.camera.index()];
                file.take(detection, frame.exposed, errors, &self.params);
                file.confirmed = true;
            }
        }
    }

    fn update(&mut self, frame: &Frame, road: &Road) {
        let camera = frame.camera.index();
        let (eye, view) = (&self.params.eyes[camera], &mut self.views[camera]);
        let errors = &self.errors[camera];
        let mut aimed = false;
        // Both stand in the order of the actors.
        let mut detections = frame.detections.iter().peekable();
        for (index, file) in self.files.iter_mut().enumerate() {
            let is_of = |found: &&Detection| found.actor.index() == index;
            if let Some(detection) = detections.next_if(is_of) {
                if let (Some(_), Some(belief)) = (road.lap(), &mut file.belief) {
                    belief.tell_near(detection.road.s, frame.exposed, road);
                }
                file.take(detection, frame.exposed, errors, &self.params);
                file.counts[camera].found += 1;
                file.confirmed |= file.counts[camera].found >= eye.confirm_frames;
                continue;
            }
            file.counts[camera].found = 0;
            if let Some(belief) = &file.belief {
                if !aimed {
                    view.aim(&eye.camera, frame.ego);
                    aimed = true;
                }
                let expected = should_see(view, frame.exposed, belief, road);
                file.miss(camera, expected, self.params.lost_frames);
            }
        }
    }

    fn tracks(&mut self, now: SimTime, ego: &Body, road: &Road, tracks: &mut Vec<Track>) {
        self.tell_near(ego.road.s, now, road);
        for (index, file) in self.files.iter().enumerate() {
            if let (true, Some(belief)) = (file.confirmed, &file.belief) {
                tracks.push(belief.track(ActorId(index as u32), now, &self.params));
            }
        }
    }

    fn knowledge(&self, actor: ActorId, now: SimTime) -> Option<Knowledge> {
        let file = &self.files[actor.index()];
        let needed = self.params.eyes.iter().map(|eye| eye.confirm_frames);
        let counts = file.counts.iter().map(|counts| counts.found).zip(needed);
        let nearest = counts.min_by_key(|(found, needed)| needed.saturating_sub(*found));
        let (found, needed) = nearest.unwrap_or_default();
        let belief = file.belief.as_ref();
        Some(Knowledge {
            track: belief.map(|belief| belief.track(actor, now, &self.params)),
            confirmed: file.confirmed && file.belief.is_some(),
            found,
            needed,
        })
    }
}

impl File {
    fn take(
        &mut self,
        detection: &Detection,
        exposed: SimTime,
        errors: &Errors,
        params: &Perception,
    ) {
        match &mut self.belief {
            Some(belief) => belief.measure(detection, exposed, errors, params),
            None => self.belief = Some(Belief::start(detection, exposed, errors)),
        }
        for counts in &mut self.counts {
            counts.missed = 0;
            counts.passed = 0;
        }
    }

    fn miss(&mut self, camera: usize, expected: bool, lost_frames: u32) {
        let counts = &mut self.counts[camera];
        counts.passed += 1;
        counts.missed += u32::from(expected);
        let missed = counts.missed >= lost_frames;
        let given_up = self
            .counts
            .iter()
            .all(|counts| counts.passed >= lost_frames);
        if missed || given_up {
            self.belief = None;
            if self.confirmed {
                self.confirmed = false;
                self.counts.fill(Counts::default());
            }
        }
    }
}

/// Whether a camera has the whole box that is believed in before it, when it exposes.
fn should_see(view: &mut View, exposed: SimTime, belief: &Belief, road: &Road) -> bool {
    let (place, turn) = belief.place(exposed);
    let aligned = road.world_from_road(place);
    let pose = Pose::new(aligned.x, aligned.y, aligned.heading + turn);
    view.sees_alone(belief.footprint(), pose, WHOLE)
}
