//! First contact of the ego with another body within a step, whatever the speed.
//!
//! Over one step a body's centre moves along a line and its heading turns evenly. Two stages, the second for the few
//! pairs that the first leaves:
//! 1. `boxes`: a pair that one of the four axes parts during the whole step, with `|turn| r` to spare for each
//!    body (no point of a box of circumscribed radius r is moved farther by its turning), cannot touch.
//! 2. Conservative advancement from the start of the step: each axis bounds from below for how long the boxes stay apart,
//!    and time goes on as far as the best of them allows until they touch or the step is over (Mirtich, Impulse-based
//!    Dynamic Simulation, 1996). A bound is exact where nothing turns.
//!
//! The side of the ego that is touched follows the contact normal: within 45 degrees of straight ahead it is the front,
//! and so on round the ego. So an ego whose front corner runs into the flank of a car beside it is hit at its side,
//! one whose front corner runs into the rear of a car that stands askew at its front. Left out: any shape but the box.

pub(crate) mod boxes;

use zhuyi_core::geometry::wrap_angle;
use zhuyi_core::{ActorId, Body, Footprint, Pose};

use boxes::{Placed, axes, into_frame, normal};

/// [m] boxes touch when the gap is no wider. The time for which they stay apart is never shorter than such a gap takes.
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
    } else {
        encounter.advance()
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

    /// The first touch, or the first instant at which the boxes lie in each other.
    fn advance(&self) -> Option<f64> {
        let mut fraction = 0.0;
        while let Some(parted_for) = self.parted_for(fraction) {
            let next = fraction + parted_for;
            if next == fraction {
                break;
            }
            fraction = next;
            if fraction > 1.0 || fraction.is_nan() {
                return None;
            }
        }
        Some(fraction)
    }

    /// A span of the step, from `fraction` on, during which the boxes surely stay apart; `None` when they touch.
    fn parted_for(&self, fraction: f64) -> Option<f64> {
        let relative_turn = self.other_turn - self.ego_turn;
        let askew = self.askew + fraction * relative_turn;
        let heading = fraction * self.ego_turn;
        let [centre, moved, last] =
            [self.centre(fraction), self.moved, self.centre(1.0)].map(|v| into_frame(heading, v));
        // The ego as the other sees it.
        let [back, moved_back] = [centre, moved].map(|v| into_frame(askew, (-v.0, -v.1)));
        let distance = length(centre).max(length(last));
        let from_ego = View {
            own: self.ego,
            turn: self.ego_turn,
            other: self.other,
            at: Pose::new(centre.0, centre.1, askew),
            moved,
            relative_turn,
        };
        let from_other = View {
            own: self.other,
            turn: self.other_turn,
            other: self.ego,
            at: Pose::new(back.0, back.1, -askew),
            moved: moved_back,
            relative_turn: -relative_turn,
        };
        let spans = [from_ego, from_other].map(|view| view.beyond_for(distance));
        spans.into_iter().flatten().reduce(f64::max)
    }
}

/// A box as seen from another, in that one's axes.
struct View {
    /// The box that sees.
    own: Footprint,
    /// [rad] how far it turns in the step.
    turn: f64,
    /// The box that is seen.
    other: Footprint,
    /// Where the other is.
    at: Pose,
    /// [m] how far the other's centre moves in the step, in axes that do not turn.
    moved: (f64, f64),
    /// [rad] how far the other turns in the step against the one that sees.
    relative_turn: f64,
}

impl View {
    /// The longest span of the step in which the other box surely stays beyond one side of the own one; `None` when it
    /// is beyond none. The centres are never more than `distance` apart until the end of the step.
    ///
    /// The other's corner `c`, around its centre at `p`, is farther along a normal `n` of the own box than its side by
    /// ```text
    ///  g   = n (p + c) - half          v  how far the centre moves in a step, r = |c|
    ///  g'  = n (v - w Jp + u Jc)       w  how far the own box turns, u the other against it, J a quarter turn
    ///  g'' = -n (2 w Jv + w^2 p + u^2 c) >= -K,          K = 2 |w| |v| + w^2 |p| + u^2 r
    /// ```
    /// and stays so for the span `h` that solves `g + g' h - K h^2 / 2 = 0`.
    fn beyond_for(&self, distance: f64) -> Option<f64> {
        let Self { at, moved, .. } = self;
        let (turn, relative) = (self.turn, self.relative_turn);
        let bend = 2.0 * turn.abs() * length(*moved)
            + turn * turn * distance
            + relative * relative * self.other.radius();
        let drift = (moved.0 + turn * at.y, moved.1 - turn * at.x);
        let corners = self.other.corners(*at).map(|corner| {
            let (forward, left) = (corner.x - at.x, corner.y - at.y);
            let moved = (drift.0 - relative * left, drift.1 + relative * forward);
            [(corner.x, moved.0), (corner.y, moved.1)]
        });
        let halves = [(at.x, self.own.length / 2.0), (at.y, self.own.width / 2.0)];
        let spans = halves.iter().enumerate().map(|(axis, (centre, half))| {
            let side = centre.signum();
            let gaps = corners.map(|corner| (side * corner[axis].0 - half, side * corner[axis].1));
            if gaps.iter().any(|(gap, _)| *gap <= TOUCH) {
                return None;
            }
            let spans = gaps.map(|(gap, rate)| positive_for(gap, rate, bend));
            spans.into_iter().reduce(f64::min)
        });
        spans.flatten().reduce(f64::max)
    }
}

/// For how long `value + rate h - bend h^2 / 2` is positive, from a positive `value`, with no negative `bend`.
fn positive_for(value: f64, rate: f64, bend: f64) -> f64 {
    let root = (rate * rate + 2.0 * bend * value).sqrt();
    if rate < 0.0 {
        2.0 * value / (root - rate)
    } else if bend > 0.0 {
        (rate + root) / bend
    } else {
        f64::INFINITY
    }
}

fn length((x, y): (f64, f64)) -> f64 {
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod sampled;
#[cfg(test)]
mod tests;
