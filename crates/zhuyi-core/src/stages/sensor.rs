//! Sensor: from the truth at one instant to detections.

use crate::{Body, Detection, Pose, Scene, SimTime};

/// Finds actors at one mount of the rig. When it exposes, how long a frame takes, and whether it is lost, are the rig's.
///
/// A radar that finds everything within 60 m, hidden or not:
/// ```
/// use zhuyi_core::stages::{Sensor, Truth};
/// use zhuyi_core::{ActorId, Detection};
///
/// struct Radar;
/// impl Sensor for Radar {
///     fn sense(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
///         let ego = truth.ego();
///         for index in 0..truth.actors() {
///             let body = truth.body(index);
///             if (body.pose.x - ego.x).hypot(body.pose.y - ego.y) <= 60.0 {
///                 detections.push(Detection::exact(ActorId(index as u32), &body));
///             }
///         }
///     }
/// }
/// ```
pub trait Sensor: Send {
    /// Appends what is found at an exposure to `detections`, at most one of each actor.
    fn sense(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>);

    /// Appends what is found before the first exposure, with which the tracker starts (reading R16): by default the same as at an
    /// exposure.
    fn sense_at_start(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        self.sense(truth, detections);
    }
}

/// The true world at one instant after the other. A body at an instant within a step has to be computed: a sensor asks for those that
/// it may have in view, by their [ends](Truth::ends), and for no others.
pub trait Truth {
    /// Goes on to an instant, never an earlier one than before.
    fn go_on(&mut self, to: SimTime);

    /// Returns the ego's pose at this instant.
    fn ego(&self) -> Pose;

    /// Returns the actors at the start and at the end of the step in which this instant lies, in their order.
    fn ends(&self) -> (&[Body], &[Body]);

    /// Returns the number of actors.
    fn actors(&self) -> usize {
        self.ends().1.len()
    }

    /// Returns an actor at this instant.
    fn body(&self, actor: usize) -> Body;
}

/// A scene in which time stands still.
impl Truth for &Scene {
    fn go_on(&mut self, _: SimTime) {}

    fn ego(&self) -> Pose {
        self.ego.pose
    }

    fn ends(&self) -> (&[Body], &[Body]) {
        (&self.actors, &self.actors)
    }

    fn body(&self, actor: usize) -> Body {
        self.actors[actor]
    }
}
