//! Tracker: from frames to confirmed tracks.

use crate::{ActorId, Body, Frame, Road, SimTime, Track};

/// Decides which actors the ego believes in, and where they are.
///
/// A tracker that believes every detection at once and forgets nothing:
/// ```
/// use std::collections::BTreeMap;
/// use zhuyi_core::stages::Tracker;
/// use zhuyi_core::{Body, Detection, Frame, Frenet, Road, SimTime, Track};
///
/// #[derive(Default)]
/// struct Naive {
///     seen: BTreeMap<u32, (SimTime, Detection)>,
/// }
/// impl Tracker for Naive {
///     fn start(&mut self, frames: &[Frame], road: &Road) {
///         self.seen.clear();
///         frames.iter().for_each(|frame| self.update(frame, road));
///     }
///     fn update(&mut self, frame: &Frame, _: &Road) {
///         self.seen.extend(frame.detections.iter().map(|found| (found.actor.0, (frame.exposed, *found))));
///     }
///     fn tracks(&mut self, now: SimTime, _: &Body, _: &Road, tracks: &mut Vec<Track>) {
///         let track = |(seen, found): &(SimTime, Detection)| {
///             let s = found.road.s + found.s_rate * (now - *seen).seconds();
///             Track {
///                 actor: found.actor, time: now, seen: *seen, footprint: found.footprint, road: Frenet { s, ..found.road },
///                 turn: found.turn, extent: found.footprint.turned(found.turn), s_rate: found.s_rate, s_accel: 0.0,
///                 d_rate: found.d_rate, s_deviation: 0.0, d_deviation: 0.0,
///             }
///         };
///         tracks.extend(self.seen.values().map(track));
///     }
/// }
/// ```
pub trait Tracker: Send {
    /// Begins a run: forgets all, and believes at once what `frames` show, which are taken before the first exposure, one of each
    /// sensor.
    fn start(&mut self, frames: &[Frame], road: &Road);

    /// Processes a frame. Frames come in the order in which they become ready.
    fn update(&mut self, frame: &Frame, road: &Road);

    /// Appends the confirmed actors as believed to be at `now` to `tracks`, in the order of their ids. On a ring each is in the lap
    /// in which it is nearest to the ego.
    fn tracks(&mut self, now: SimTime, ego: &Body, road: &Road, tracks: &mut Vec<Track>);

    /// Returns what is known of one actor at `now`, for records; the loop decides nothing by it. None where the tracker keeps
    /// nothing but tracks: the actor is then known if it is among the last [`tracks`](Tracker::tracks).
    fn knowledge(&self, actor: ActorId, now: SimTime) -> Option<Knowledge> {
        let _ = (actor, now);
        None
    }
}

/// Knowledge of the ego about one actor, confirmed or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knowledge {
    /// The actor as believed to be now; none before it is found and after it is lost.
    pub track: Option<Track>,
    /// Whether the planner is told.
    pub confirmed: bool,
    /// Consecutive frames with it, of the camera that is nearest to confirming it ...
    pub found: u32,
    /// ... and how many that camera needs.
    pub needed: u32,
}
