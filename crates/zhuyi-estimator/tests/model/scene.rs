//! A scene in plain numbers for the tests of this folder, and the shorthands to ask about it.

use zhuyi_core::{Across, Along, Extent, Footprint};
use zhuyi_estimator::{Ego, Estimate, Estimator, Future, Params};

/// Every box of these tests.
pub const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};

/// [s] l_0 unless a test says otherwise.
pub const L0: f64 = 1.0 / 30.0;

/// One ego and one future of one actor.
#[derive(Clone, Debug)]
pub struct Scene {
    pub ego: Ego,
    pub along: Vec<Along>,
    pub across: Vec<Across>,
    pub extents: Vec<Extent>,
    pub now: f64,
    pub current_latency: f64,
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
            along: vec![Along::constant_accel(0.0, gap + CAR.length, lead, 0.0)],
            across: vec![Across {
                time: 0.0,
                d: 0.0,
                d_rate: 0.0,
            }],
            extents: Vec::new(),
            now: 0.0,
            current_latency: L0,
        }
    }

    /// The actor changes its speed at `accel` from `time` on until it has reached `speed`.
    pub fn then(mut self, time: f64, accel: f64, speed: f64) -> Self {
        let last = self.along[self.along.len() - 1];
        let (s, v) = (last.s_at(time), last.v_at(time));
        let reached = time + (speed - v) / accel;
        let piece = Along::constant_accel(time, s, v, accel);
        self.along.extend([
            piece,
            Along::constant_accel(reached, piece.s_at(reached), speed, 0.0),
        ]);
        self
    }

    /// The actor is at offset `d` from `time` on.
    pub fn jumps_to(mut self, time: f64, d: f64) -> Self {
        self.across.push(Across {
            time,
            d,
            d_rate: 0.0,
        });
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

    pub fn ask(&self, params: &Params) -> Estimate {
        Estimator::new(params.clone()).trajectory(
            &self.ego,
            CAR,
            &self.future(),
            self.current_latency,
        )
    }
}
