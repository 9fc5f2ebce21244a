//! A scene in plain numbers for the tests of this folder, and the shorthands to ask about it.

use proptest::prelude::*;
use zhuyi_core::{Across, Along, Extent, Footprint};
use zhuyi_estimator::{Ego, Future};
use zhuyi_metrics::criticality::{Approach, Criticality, Limits, criticality};

/// Every box of these tests.
pub const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};

/// One ego and one future of one actor.
#[derive(Clone, Debug)]
pub struct Scene {
    pub ego: Ego,
    pub along: Vec<Along>,
    pub across: Vec<Across>,
    pub extents: Vec<Extent>,
    pub now: f64,
}

impl Scene {
    /// The ego of `pair`, and its actor in the same lane.
    pub fn in_lane(pair: &Approach) -> Self {
        Self {
            ego: Ego {
                s: 0.0,
                d: 0.0,
                speed: pair.ego_speed,
                accel: pair.ego_accel,
                footprint: CAR,
            },
            along: vec![Along::constant_accel(
                0.0,
                pair.gap + CAR.length,
                pair.actor_speed,
                pair.actor_accel,
            )],
            across: vec![Across {
                time: 0.0,
                d: 0.0,
                d_rate: 0.0,
            }],
            extents: Vec::new(),
            now: 0.0,
        }
    }

    /// The actor is at offset `d` and moves sideways by `d_rate`.
    pub fn sideways(mut self, d: f64, d_rate: f64) -> Self {
        self.across[0] = Across {
            time: 0.0,
            d,
            d_rate,
        };
        self
    }

    /// The actor's box keeps standing on the path with these extents.
    pub fn standing(mut self, extent: Footprint) -> Self {
        self.extents = vec![Extent::held(extent)];
        self
    }

    pub fn future(&self) -> Future<'_> {
        Future {
            along: &self.along,
            across: &self.across,
            extents: &self.extents,
            known_until: self.now + 20.0,
            now: self.now,
        }
    }

    pub fn ask(&self, limits: &Limits) -> Criticality {
        criticality(&self.ego, CAR, &self.future(), limits)
    }
}

/// A pair without accelerations.
pub fn steady(gap: f64, ego_speed: f64, actor_speed: f64) -> Approach {
    Approach {
        gap,
        ego_speed,
        ego_accel: 0.0,
        actor_speed,
        actor_accel: 0.0,
    }
}

prop_compose! {
    /// A car ahead, at any speeds and accelerations.
    pub fn any_pair()(
        gap in 0.5..150.0_f64,
        ego_speed in 0.5..40.0_f64,
        ego_accel in -6.0..3.0_f64,
        actor_speed in prop_oneof![Just(0.0), 0.0..40.0_f64],
        actor_accel in prop_oneof![Just(0.0), -9.0..3.0_f64],
    ) -> Approach {
        let actor_accel = if actor_speed == 0.0 { actor_accel.max(0.0) } else { actor_accel };
        Approach { gap, ego_speed, ego_accel, actor_speed, actor_accel }
    }
}
