//! The world at the instants of the last step, as the cameras ask for it.

use zhuyi_core::{Body, Footprint, Point, Pose, SimTime};
use zhuyi_perception::Truth;
use zhuyi_world::World;

/// The world at an instant of the last step.
pub(crate) struct Instant<'w, 'a> {
    world: &'w World<'a>,
    time: SimTime,
    ego: Pose,
}

impl<'w, 'a> Instant<'w, 'a> {
    /// Now.
    pub fn of(world: &'w World<'a>) -> Self {
        let scene = world.scene();
        Self {
            world,
            time: scene.time,
            ego: scene.ego.pose,
        }
    }
}

impl Truth for Instant<'_, '_> {
    fn go_on(&mut self, to: SimTime) {
        (self.time, self.ego) = (to, self.world.ego_pose_at(to));
    }

    fn ego(&self) -> Pose {
        self.ego
    }

    fn roughly(&self, actor: usize) -> (Footprint, Point, f64) {
        self.world.roughly(actor)
    }

    fn body(&self, actor: usize) -> Body {
        self.world.actor_at(actor, self.time)
    }
}
