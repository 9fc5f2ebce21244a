//! Where an actor is sideways, as seen from the ego's offset.

use super::recording::AcrossBlock;
use crate::{Ego, Params};
use zhuyi_core::Footprint;

/// [m] an ego that has moved sideways, or whose box has turned, by less than this at the edges has hardly moved.
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
    /// For an actor that keeps these extents; of one that turns none.
    pub fn new(params: &Params, ego: &Ego, actor: Footprint) -> Self {
        let body = ego.footprint.half_widths(actor);
        Self {
            ego: ego.d,
            body,
            lane: body + params.lateral_margin,
            reach: ego.footprint.half_lengths(actor),
        }
    }

    /// The edges of an actor's box at offset `d` that reaches `half` [m] to each side beyond what these lines count.
    #[inline]
    pub fn edges(&self, d: f64, half: f64) -> Edges {
        let offset = d - self.ego;
        Edges {
            right: offset - half,
            left: offset + half,
        }
    }

    /// The relation of bodies with these edges.
    #[inline]
    pub fn side_at(&self, edges: Edges) -> Side {
        let Edges { right, left } = edges;
        match (
            right < self.lane && left > -self.lane,
            right < self.body && left > -self.body,
        ) {
            (true, true) => Side::Overlap,
            (true, false) => Side::Close,
            (false, _) => Side::Apart,
        }
    }

    /// The one relation on all of a block, whose edges count `half` [m] that these lines count too; none where it may change.
    #[inline]
    pub fn side_over(&self, block: &AcrossBlock, half: f64) -> Option<Side> {
        let Self {
            ego, body, lane, ..
        } = *self;
        let (right, left) = (half - ego, -half - ego);
        let (right_min, right_max) = (block.right_min + right, block.right_max + right);
        let (left_min, left_max) = (block.left_min + left, block.left_max + left);
        if right_min >= lane || left_max <= -lane {
            Some(Side::Apart)
        } else if right_max < body && left_min > -body {
            Some(Side::Overlap)
        } else if (right_min >= body && right_max < lane) || (left_max <= -body && left_min > -lane)
        {
            Some(Side::Close)
        } else {
            None
        }
    }

    /// Whether the actor is in the corridor.
    #[inline]
    pub fn holds(&self, edges: Edges) -> bool {
        edges.right < self.lane && edges.left > -self.lane
    }

    /// The one relation of an actor whose edges go straight from one place to another, whatever lines [near](Lines::are_near)
    /// these it is to; none if there may be more than one.
    pub fn side_between(&self, from: Edges, to: Edges) -> Option<Side> {
        let side = self.side_at(from);
        let is_surely = |edges: Edges| {
            let clear = |edge: f64, line: f64| (edge - line).abs() > NEAR;
            self.side_at(edges) == side
                && [self.body, self.lane]
                    .iter()
                    .all(|line| clear(edges.right, *line) && clear(edges.left, -line))
        };
        let crosses = side != Side::Overlap && from.is_to_the_left() != to.is_to_the_left();
        (is_surely(from) && is_surely(to) && !crosses && !to.right.is_nan()).then_some(side)
    }

    /// Whether others are about the same, for an ego that has hardly moved sideways.
    pub fn are_near(&self, other: &Self) -> bool {
        let aside = (self.ego - other.ego).abs();
        let wider = larger(
            (self.body - other.body).abs(),
            (self.lane - other.lane).abs(),
        );
        aside + wider < NEAR && (self.reach - other.reach).abs() < NEAR
    }
}

/// Edges of an actor's box, as offsets from the ego's [m], less what the lines count of it: of a box that keeps its extents
/// both are the offset of its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edges {
    pub right: f64,
    pub left: f64,
}

impl Edges {
    /// Whether an actor that does not overlap the ego is to its left.
    #[inline]
    pub fn is_to_the_left(self) -> bool {
        self.right > 0.0
    }
}

/// Sideways relation of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Apart,
    Close,
    Overlap,
}

/// The larger of two numbers.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
