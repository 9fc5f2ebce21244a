//! Where an actor is sideways, as seen from the ego's offset.

use crate::{Ego, Params};
use zhuyi_core::Footprint;

/// [m] an ego that has moved sideways by less has hardly moved.
const NEAR: f64 = 0.003;

/// Where the bodies begin to be close and to overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lines {
    /// [m] offset of the ego.
    pub ego: f64,
    /// [m] offset from it below which the bodies overlap sideways: half of both widths.
    pub body: f64,
    /// [m] offset from it below which the actor is in the corridor.
    pub lane: f64,
    /// [m] distance along the road below which they overlap lengthwise: half of both lengths.
    pub reach: f64,
}

impl Lines {
    pub fn new(params: &Params, ego: &Ego, actor: Footprint) -> Self {
        let body = f64::midpoint(ego.footprint.width, actor.width);
        Self {
            ego: ego.d,
            body,
            lane: body + params.lateral_margin,
            reach: f64::midpoint(ego.footprint.length, actor.length),
        }
    }

    /// The relation of bodies at this offset from each other.
    pub fn side_at(&self, offset: f64) -> Side {
        let distance = offset.abs();
        match (distance < self.lane, distance < self.body) {
            (true, true) => Side::Overlap,
            (true, false) => Side::Close,
            (false, _) => Side::Apart,
        }
    }

    /// The one relation of an actor that goes from one offset to another, whatever lines [near](Lines::are_near) these it is to;
    /// none if there may be more than one.
    pub fn side_between(&self, d: f64, end: f64) -> Option<Side> {
        let (from, to) = (d - self.ego, end - self.ego);
        let side = self.side_at(from);
        let is_surely = |offset: f64| {
            let distance = offset.abs();
            let clear = |line: f64| (distance - line).abs() > NEAR;
            self.side_at(offset) == side && clear(self.body) && clear(self.lane)
        };
        let crosses = side != Side::Overlap && (from > 0.0) != (to > 0.0);
        (is_surely(from) && is_surely(to) && !crosses && !to.is_nan()).then_some(side)
    }

    /// Whether others are the same for an ego that has hardly moved sideways.
    pub fn are_near(&self, other: &Self) -> bool {
        let same = (self.body, self.lane, self.reach) == (other.body, other.lane, other.reach);
        same && (self.ego - other.ego).abs() < NEAR
    }
}

/// Sideways relation of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Apart,
    Close,
    Overlap,
}
