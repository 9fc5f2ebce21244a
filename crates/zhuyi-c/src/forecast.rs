//! Several futures of one actor with their probabilities.

use crate::border::list;
use crate::limits::positive;
use crate::{Footprint, Status, Trajectory};
use zhuyi_core::ActorId;

/// One of several futures.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedTrajectory {
    /// [-] its probability, or any number in proportion to it; above 0.
    pub weight: f64,
    /// The future.
    pub trajectory: Trajectory,
}

/// The possible futures of one actor. The list stays the caller's.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// The actor's box.
    pub footprint: Footprint,
    /// The futures.
    pub trajectories: *const WeightedTrajectory,
    /// How many; at least 1.
    pub trajectory_count: usize,
}

impl Forecast {
    /// The forecast as meant, with copies of all lists.
    ///
    /// # Safety
    /// Each list has as many entries as it says, aligned, which nobody changes during the call.
    pub(crate) unsafe fn meant(&self, actor: ActorId) -> Result<zhuyi_core::Forecast, Status> {
        let footprint = self.footprint.meant()?;
        // SAFETY: promised by the caller of this function.
        let futures = unsafe { list(self.trajectories, self.trajectory_count)? };
        if futures.is_empty() {
            return Err(Status::Empty);
        }
        let copy = |future: &WeightedTrajectory| {
            // SAFETY: promised by the caller of this function.
            let pieces = unsafe { future.trajectory.meant()? };
            let trajectory = zhuyi_core::Trajectory {
                along: pieces.along.to_vec(),
                across: pieces.across.to_vec(),
                extents: pieces.extents.to_vec(),
                known_until: pieces.known_until,
            };
            Ok((positive(future.weight)?, trajectory))
        };
        Ok(zhuyi_core::Forecast {
            actor,
            footprint,
            trajectories: futures.iter().map(copy).collect::<Result<_, Status>>()?,
        })
    }
}
