//! What the cameras look at.

use zhuyi_core::{Body, Footprint, Point, Pose, Scene, SimTime};

/// The world at one instant after the other. A camera asks for the bodies that it may have in view, and for no others.
pub trait Truth {
    /// Goes on to an instant, never an earlier one than before.
    fn go_on(&mut self, to: SimTime);

    /// The ego's pose then.
    fn ego(&self) -> Pose;

    /// The box of an actor, and about where it is then: a point, and how far from it [m] its centre is at most.
    fn roughly(&self, actor: usize) -> (Footprint, Point, f64);

    /// An actor then.
    fn body(&self, actor: usize) -> Body;
}

/// A scene in which time stands still.
impl Truth for &Scene {
    fn go_on(&mut self, _: SimTime) {}

    fn ego(&self) -> Pose {
        self.ego.pose
    }

    fn roughly(&self, actor: usize) -> (Footprint, Point, f64) {
        let Body {
            footprint, pose, ..
        } = self.actors[actor];
        (footprint, pose.point(), 0.0)
    }

    fn body(&self, actor: usize) -> Body {
        self.actors[actor]
    }
}
