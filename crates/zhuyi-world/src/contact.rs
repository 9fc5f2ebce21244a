//! First contact of the ego with another body within a step, whatever the speed.
//!
//! Over one step a body's centre moves along a line and its heading turns evenly. Three stages, each for the few pairs
//! that the one before leaves; boxes that lie in each other from the start touch at the start:
//! 1. `boxes`: a pair that one of the four axes parts during the whole step, with `|turn| r` to spare for each
//!    body (no point of a box of circumscribed radius r is moved farther by its turning), cannot touch. In `f64`.
//! 2. A cast of one box against the other by parry2d, linear where nothing turns, nonlinear where something does, and
//!    an intersection test of the end poses behind both. In `f32`, in coordinates relative to the ego.
//! 3. Where the cast stopped early (by millimetres, as its `f32` closest points are good to 1e-3 of their size), on from
//!    there in `f64` by conservative advancement: each axis bounds from below for how long the boxes stay apart
//!    (Mirtich, Impulse-based Dynamic Simulation, 1996).
//!
//! The side of the ego that is touched follows the contact normal: within 45 degrees of straight ahead it is the front,
//! and so on round the ego. So an ego whose front corner runs into the flank of a car beside it is hit at its side,
//! one whose front corner runs into the rear of a car that stands askew at its front. Left out: any shape but the box.

pub(crate) mod boxes;

use parry2d::math::{Pose as Placement, Vector};
use parry2d::query::{
    NonlinearRigidMotion, ShapeCastOptions, cast_shapes, cast_shapes_nonlinear, intersection_test,
};
use parry2d::shape::Cuboid;
use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{ActorId, Body, Footprint, Pose};

use boxes::{Placed, axes, into_frame, normal};

/// [m] movement by turning below the resolution of parry's `f32`: the body goes straight.
const STRAIGHT: f64 = 1e-6;

/// [m] boxes touch when the gap is no wider: the resolution of parry's `f32` some metres away.
const TOUCH: f64 = 1e-5;

/// A body over one step: its centre moves along a line, its heading turns evenly, the short way round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Its box.
    pub footprint: Footprint,
    /// Where it is at the start of the step.
    pub from: Pose,
    /// Where it is at the end of the step.
    pub to: Pose,
}

impl Motion {
    /// [rad] how far it turns, counter-clockwise.
    fn turn(&self) -> f64 {
        wrap_angle(self.to.heading - self.from.heading)
    }

    /// The pose at a fraction of the step.
    fn at(&self, fraction: f64) -> Pose {
        Pose::new(
            self.from.x + fraction * (self.to.x - self.from.x),
            self.from.y + fraction * (self.to.y - self.from.y),
            self.from.heading + fraction * self.turn(),
        )
    }
}

/// The first touch of the ego with another body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The other body.
    pub actor: ActorId,
    /// [-] when in the step, from 0 to 1.
    pub fraction: f64,
    /// Where the ego is touched.
    pub side: Side,
}

/// A side of the ego's box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The front bumper.
    Front,
    /// The rear bumper.
    Rear,
    /// The left flank.
    Left,
    /// The right flank.
    Right,
}

impl Side {
    /// The side that faces along a normal of the ego's frame (forward, left).
    fn facing((forward, left): (f64, f64)) -> Self {
        match (forward.abs() >= left.abs(), forward > 0.0, left > 0.0) {
            (true, true, _) => Self::Front,
            (true, false, _) => Self::Rear,
            (false, _, true) => Self::Left,
            (false, _, false) => Self::Right,
        }
    }
}

/// The first of `others` that the ego touches during the step, the first in their order of those at the same instant.
///
/// ```
/// use zhuyi_core::{ActorId, Footprint, Pose};
/// use zhuyi_world::contact::{Motion, Side, first_contact};
/// let footprint = Footprint { length: 4.0, width: 2.0 };
/// // The ego covers 10 m in the step; its bumper reaches the standing car's, 2.5 m away, after a quarter of it.
/// let ego = Motion { footprint, from: Pose::default(), to: Pose::new(10.0, 0.0, 0.0) };
/// let car = Motion { footprint, from: Pose::new(6.5, 0.5, 0.0), to: Pose::new(6.5, 0.5, 0.0) };
/// let contact = first_contact(&ego, [(ActorId(0), car)].into_iter()).unwrap();
/// assert!((contact.fraction - 0.25).abs() < 1e-6);
/// assert_eq!(contact.side, Side::Front);
/// ```
#[inline]
pub fn first_contact(
    ego: &Motion,
    others: impl Iterator<Item = (ActorId, Motion)>,
) -> Option<Contact> {
    let mut first: Option<Contact> = None;
    for (actor, other) in others {
        let Some(fraction) = touch(ego, &other) else {
            continue;
        };
        if first.is_none_or(|contact| fraction < contact.fraction) {
            let (here, there) = (ego.at(fraction), other.at(fraction));
            let approach = (
                (other.to.x - other.from.x) - (ego.to.x - ego.from.x),
                (other.to.y - other.from.y) - (ego.to.y - ego.from.y),
            );
            let normal = normal((ego.footprint, here), (other.footprint, there), approach);
            first = Some(Contact {
                actor,
                fraction,
                side: Side::facing(normal),
            });
        }
    }
    first
}

/// Whether two bodies, from the start of a step to its end, are surely apart during all of it: in the world's x or y.
#[inline]
pub fn are_far_apart(ego: (&Body, &Body), other: (&Body, &Body)) -> bool {
    // No box reaches farther than half its length and half its width together.
    let (a, b) = (ego.0.footprint, other.0.footprint);
    let reach = 0.5 * (a.length + a.width + b.length + b.width);
    let (before, after) = ((ego.0.pose, other.0.pose), (ego.1.pose, other.1.pose));
    parted(before.1.x - before.0.x, after.1.x - after.0.x, reach)
        || parted(before.1.y - before.0.y, after.1.y - after.0.y, reach)
}

/// The fraction of the step at which two bodies first touch.
fn touch(ego: &Motion, other: &Motion) -> Option<f64> {
    let before = (other.from.x - ego.from.x, other.from.y - ego.from.y);
    let after = (other.to.x - ego.to.x, other.to.y - ego.to.y);
    let encounter = Encounter::new(ego, other, before, after);
    if encounter.stays_apart() {
        None
    } else if overlap((ego.footprint, ego.from), (other.footprint, other.from)).is_some() {
        Some(0.0)
    } else {
        encounter.advance(encounter.cast()?)
    }
}

/// [m] how far one box reaches into another along its own length and across it, when they overlap by more than a touch.
pub fn overlap(one: Placed, other: Placed) -> Option<(f64, f64)> {
    let centre = one.1.local(other.1.point());
    let gaps = axes(one.0, other.0, other.1.heading - one.1.heading).map(|axis| axis.gap(centre));
    gaps.iter()
        .all(|gap| *gap < -TOUCH)
        .then_some((-gaps[0], -gaps[1]))
}

/// Whether a coordinate that moves from `start` to `end` stays beyond `reach` on one side.
fn parted(start: f64, end: f64, reach: f64) -> bool {
    (start > reach && end > reach) || (start < -reach && end < -reach)
}

/// The motion of another body as seen from the centre of the ego, in its axes at the start of the step.
struct Encounter {
    ego: Footprint,
    other: Footprint,
    /// [m] from the ego's centre to the other's at the start of the step.
    before: (f64, f64),
    /// [m] how far the other moves against the ego.
    moved: (f64, f64),
    /// [rad] heading of the other against the ego's at the start.
    askew: f64,
    /// [rad] how far the ego turns.
    ego_turn: f64,
    /// [rad] how far the other turns.
    other_turn: f64,
}

impl Encounter {
    fn new(ego: &Motion, other: &Motion, before: (f64, f64), after: (f64, f64)) -> Self {
        let moved = (after.0 - before.0, after.1 - before.1);
        Self {
            ego: ego.footprint,
            other: other.footprint,
            before: into_frame(ego.from.heading, before),
            moved: into_frame(ego.from.heading, moved),
            askew: wrap_angle(other.from.heading - ego.from.heading),
            ego_turn: ego.turn(),
            other_turn: other.turn(),
        }
    }

    /// [m] from the ego's centre to the other's.
    fn centre(&self, fraction: f64) -> (f64, f64) {
        (
            self.before.0 + fraction * self.moved.0,
            self.before.1 + fraction * self.moved.1,
        )
    }

    /// [m] how far turning moves the corners of both, at most.
    fn slack(&self) -> f64 {
        self.ego.radius() * self.ego_turn.abs() + self.other.radius() * self.other_turn.abs()
    }

    /// Whether one axis parts the boxes during the whole step.
    fn stays_apart(&self) -> bool {
        let (before, after, slack) = (self.centre(0.0), self.centre(1.0), self.slack());
        let axes = axes(self.ego, self.other, self.askew);
        axes.iter()
            .any(|axis| parted(axis.along(before), axis.along(after), axis.reach + slack))
    }

    /// The first touch by parry2d.
    fn cast(&self) -> Option<f64> {
        let vector = |(x, y): (f64, f64)| Vector::new(x as f32, y as f32);
        let shape = |of: Footprint| Cuboid::new(vector((of.length / 2.0, of.width / 2.0)));
        let (ego, other, moved) = (shape(self.ego), shape(self.other), vector(self.moved));
        let there = Placement::new(vector(self.before), self.askew as f32);
        let hit = if self.slack() <= STRAIGHT {
            let step = ShapeCastOptions::with_max_time_of_impact(1.0);
            cast_shapes(
                &Placement::IDENTITY,
                Vector::ZERO,
                &ego,
                &there,
                moved,
                &other,
                step,
            )
        } else {
            let turning =
                |from, moved, turn| NonlinearRigidMotion::new(from, Vector::ZERO, moved, turn);
            let own = turning(Placement::IDENTITY, Vector::ZERO, self.ego_turn as f32);
            let others = turning(there, moved, self.other_turn as f32);
            cast_shapes_nonlinear(&own, &ego, &others, &other, 0.0, 1.0, true)
        };
        if let Ok(Some(hit)) = hit {
            return Some(f64::from(hit.time_of_impact).clamp(0.0, 1.0));
        }
        // Boxes that overlap without moving against each other, and whatever a cast gives up on.
        let here = Placement::new(Vector::ZERO, self.ego_turn as f32);
        let there = Placement::new(
            vector(self.centre(1.0)),
            (self.askew + self.other_turn) as f32,
        );
        let overlap = intersection_test(&here, &ego, &there, &other);
        overlap.is_ok_and(|found| found.intersecting).then_some(1.0)
    }

    /// The first touch from `fraction` on: time and again as far as one of the axes surely parts the boxes.
    fn advance(&self, mut fraction: f64) -> Option<f64> {
        while fraction <= 1.0 {
            let parted_for = self.parted_for(fraction);
            if parted_for == 0.0 {
                return Some(fraction);
            }
            fraction += parted_for;
        }
        None
    }

    /// A span of the step, from `fraction` on, during which the boxes surely stay apart; zero when they touch.
    ///
    /// A gap `|p · n| - h` shrinks at most as fast as the centres close in along `n`, `n` turns under `p` and under
    /// their motion, and the box that `n` does not belong to turns its corners.
    fn parted_for(&self, fraction: f64) -> f64 {
        let relative_turn = self.other_turn - self.ego_turn;
        let heading = fraction * self.ego_turn;
        let centre = into_frame(heading, self.centre(fraction));
        let moved = into_frame(heading, self.moved);
        let lever = libm::hypot(centre.0, centre.1) + 2.0 * libm::hypot(moved.0, moved.1);
        let (ego, other) = ((self.ego_turn, self.other), (self.other_turn, self.ego));
        let axes = axes(self.ego, self.other, self.askew + fraction * relative_turn);
        let mut longest = 0.0;
        for (axis, (turn, opposite)) in axes.iter().zip([ego, ego, other, other]) {
            let closing = -axis.along(moved) * axis.along(centre).signum();
            let shrinking =
                closing.max(0.0) + turn.abs() * lever + opposite.radius() * relative_turn.abs();
            let gap = axis.gap(centre);
            if gap > TOUCH && gap / shrinking > longest {
                longest = gap / shrinking;
            }
        }
        longest
    }
}

#[cfg(test)]
mod tests;
