//! One ego and one actor with constant rates, and the shorthands to ask about them.

use zhuyi_core::{Across, Along, Extent, Footprint};
use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};

/// Every box of these tests, if they do not say otherwise.
pub const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};

/// An ego on its path, and an actor.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    pub ego: Ego,
    pub footprint: Footprint,
    pub along: [Along; 1],
    pub across: [Across; 1],
    pub extents: Option<Extent>,
}

impl Scene {
    /// An ego at `speed`, and an actor `gap` metres ahead in its lane that drives at `lead` m/s.
    pub fn following(speed: f64, gap: f64, lead: f64) -> Self {
        Self {
            ego: Ego {
                s: 0.0,
                d: 0.0,
                speed,
                accel: 0.0,
                footprint: CAR,
            },
            footprint: CAR,
            along: [Along::constant_accel(0.0, gap + CAR.length, lead, 0.0)],
            across: [Across {
                time: 0.0,
                d: 0.0,
                d_rate: 0.0,
            }],
            extents: None,
        }
    }

    /// The actor is `d` metres to the left and moves at `d_rate`.
    pub fn aside(mut self, d: f64, d_rate: f64) -> Self {
        (self.across[0].d, self.across[0].d_rate) = (d, d_rate);
        self
    }

    /// The box of `footprint` stands on the path turned by `turn`, its rear edge where it was.
    pub fn turned(mut self, footprint: Footprint, turn: f64) -> Self {
        let stands = footprint.turned(turn);
        self.along[0].s += (stands.length - self.footprint.length) / 2.0;
        (self.footprint, self.extents) = (footprint, Some(Extent::held(stands)));
        self
    }

    pub fn future(&self) -> Future<'_> {
        Future {
            along: &self.along,
            across: &self.across,
            extents: self.extents.as_slice(),
            known_until: 20.0,
            now: 0.0,
        }
    }

    pub fn ask(&self, model: &(impl SafetyModel + ?Sized)) -> Reaction {
        model.reaction(&self.ego, self.footprint, &self.future())
    }

    /// [s] the time within which the model wants a reaction.
    pub fn time(&self, model: &(impl SafetyModel + ?Sized)) -> f64 {
        match self.ask(model) {
            Reaction::Within(time) => time,
            other => panic!("{}: {other:?} in {self:?}", model.name()),
        }
    }
}
