//! The world at the instants of the last step, as the cameras ask for it.

use zhuyi_core::stages::Truth;
use zhuyi_core::{Body, Pose, SimTime};
use zhuyi_world::World;

/// The world at an instant of the last step.
pub(crate) struct Instant<'w> {
    world: &'w World,
    time: SimTime,
    ego: Pose,
}

impl<'w> Instant<'w> {
    /// Now.
    pub fn of(world: &'w World) -> Self {
        let scene = world.scene();
        Self {
            world,
            time: scene.time,
            ego: scene.ego.pose,
        }
    }
}

impl Truth for Instant<'_> {
    fn go_on(&mut self, to: SimTime) {
        (self.time, self.ego) = (to, self.world.ego_pose_at(to));
    }

    fn ego(&self) -> Pose {
        self.ego
    }

    fn ends(&self) -> (&[Body], &[Body]) {
        self.world.ends()
    }

    fn body(&self, actor: usize) -> Body {
        self.world.actor_at(actor, self.time)
    }
}
