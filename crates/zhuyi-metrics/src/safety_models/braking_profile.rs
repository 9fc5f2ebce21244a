//! How a vehicle moves along the road when it holds and then brakes, and the least distance between two that do.
//!
//! ```text
//!   a | a_0 ‾‾‾‾‾\                    hold, build up the braking with a jerk j, brake by b, stand
//!     |           \
//!     | -b         \________ 0 ____
//!       0        onset              t
//!
//!   room(t) = ahead + x_a(t) - x_e(t) - reach      a cubic between two changes of either
//! ```
//!
//! The least room is found in closed form: at the ends of every stretch, and where its derivative is zero.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | x_e, x_a | distances covered by ego and actor since t_0 | m |
//! | ahead | the actor's centre less the ego's at t_0 | m |
//! | reach | half of both lengths | m |
//!
//! Left out: lags of the actuator. A vehicle never reverses.

use zhuyi_core::quadratic::Quadratic;
use zhuyi_estimator::Reaction;
use zhuyi_estimator::ego_motion::Start;

/// [s] how far ahead a contact counts (as reading R8).
pub(super) const HORIZON: f64 = 20.0;

/// [m] what is lost to rounding is no contact.
const ROUNDING: f64 = 1e-9;

/// A stretch of constant jerk, up to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stretch {
    start: f64,
    distance: f64,
    speed: f64,
    accel: f64,
    jerk: f64,
}

impl Stretch {
    /// The motion at `time`, to be continued from there on.
    fn at(&self, time: f64) -> Self {
        let x = time - self.start;
        Self {
            start: time,
            distance: self.distance
                + x * (self.speed + x * (self.accel / 2.0 + x * (self.jerk / 6.0))),
            speed: self.speed + x * (self.accel + x * (self.jerk / 2.0)),
            accel: self.accel + x * self.jerk,
            jerk: self.jerk,
        }
    }
}

/// How the brakes work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Brakes {
    /// [m/s2] b.
    pub decel: f64,
    /// [m/s3] j; none if the braking is there at once.
    pub jerk: Option<f64>,
}

/// A motion of at most four stretches; those not needed start at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BrakingProfile {
    stretches: [Stretch; 4],
}

impl BrakingProfile {
    /// Hold the acceleration until `onset`, then brake until standing. One that brakes harder already keeps to it.
    pub fn braking(start: Start, onset: f64, brakes: Brakes) -> Self {
        let hold = Stretch {
            start: 0.0,
            distance: 0.0,
            speed: start.speed,
            accel: start.accel,
            jerk: 0.0,
        };
        let full = start.accel.min(-brakes.decel);
        let build_up = brakes.jerk.map_or(0.0, |jerk| (start.accel - full) / jerk);
        let ramp = Stretch {
            jerk: brakes.jerk.map_or(0.0, |jerk| -jerk),
            ..hold.at(onset)
        };
        let mut brake = ramp.at(onset + build_up);
        (brake.accel, brake.jerk) = (full, 0.0);
        let never = Stretch {
            start: f64::INFINITY,
            ..brake
        };
        let moving = if build_up > 0.0 {
            [hold, ramp, brake]
        } else {
            [hold, brake, never]
        };
        Self::until_standing(moving, never)
    }

    /// Hold the speed for ever.
    pub fn steady(speed: f64) -> Self {
        let hold = Stretch {
            start: 0.0,
            distance: 0.0,
            speed,
            accel: 0.0,
            jerk: 0.0,
        };
        let never = Stretch {
            start: f64::INFINITY,
            ..hold
        };
        Self {
            stretches: [hold, never, never, never],
        }
    }

    /// The stretches up to the first standstill, and standing from there on.
    fn until_standing(moving: [Stretch; 3], never: Stretch) -> Self {
        let mut stretches = [moving[0], moving[1], moving[2], never];
        for index in 0..moving.len() {
            let stretch = moving[index];
            let end = stretches[index + 1].start.min(LONG);
            if stretch.start >= end {
                continue;
            }
            let speed = Quadratic {
                c0: stretch.speed,
                c1: stretch.accel,
                c2: stretch.jerk / 2.0,
            };
            if let Some(stop) = speed.first_below(end - stretch.start) {
                let mut stand = stretch.at(stretch.start + stop);
                (stand.speed, stand.accel, stand.jerk) = (0.0, 0.0, 0.0);
                stretches[index + 1] = stand;
                for later in &mut stretches[index + 2..] {
                    *later = never;
                }
                break;
            }
        }
        Self { stretches }
    }

    fn stretch(&self, time: f64) -> &Stretch {
        let later = self.stretches[1..]
            .iter()
            .take_while(|stretch| stretch.start <= time)
            .count();
        &self.stretches[later]
    }

    /// [s] when the next stretch after `time` starts.
    fn next_start(&self, time: f64) -> f64 {
        let starts = self.stretches.iter().map(|stretch| stretch.start);
        starts.fold(f64::INFINITY, |next, start| {
            if start > time { next.min(start) } else { next }
        })
    }

    /// [m] the least distance by which `leader` covers more than this one, over the window.
    fn least_lead(&self, leader: &Self, (from, to): (f64, f64)) -> f64 {
        let (mut least, mut time) = (f64::INFINITY, from);
        while time <= to {
            let end = self.next_start(time).min(leader.next_start(time)).min(to);
            let (ours, theirs) = (self.stretch(time).at(time), leader.stretch(time).at(time));
            let lead = Stretch {
                start: 0.0,
                distance: theirs.distance - ours.distance,
                speed: theirs.speed - ours.speed,
                accel: theirs.accel - ours.accel,
                jerk: theirs.jerk - ours.jerk,
            };
            least = least.min(least_distance(&lead, end - time));
            if end >= to {
                break;
            }
            time = end;
        }
        least
    }

    /// Whether one on this profile stays behind one on the other in the window, with centres `ahead` apart at t_0 and
    /// never nearer than `reach`.
    pub fn stays_behind(&self, leader: &Self, ahead: f64, reach: f64, window: (f64, f64)) -> bool {
        ahead + self.least_lead(leader, window) >= reach - ROUNDING
    }
}

/// [s] longer than anything brakes.
const LONG: f64 = 1e6;

/// The least distance of one stretch, up to `end` seconds from its start.
fn least_distance(stretch: &Stretch, end: f64) -> f64 {
    let Stretch {
        speed, accel, jerk, ..
    } = *stretch;
    let at = |x: f64| stretch.at(x).distance;
    let ends = at(0.0).min(at(end));
    // A minimum inside: speed + accel x + jerk x^2/2 = 0 where accel + jerk x > 0, in the form without cancellation.
    let root = (accel * accel - 2.0 * jerk * speed).sqrt();
    let x = if accel > 0.0 {
        -2.0 * speed / (accel + root)
    } else {
        (root - accel) / jerk
    };
    if x > 0.0 && x < end {
        ends.min(at(x))
    } else {
        ends
    }
}

/// The largest time in [0, HORIZON] that is clear, by bisection between a clear one and one that is not: no danger
/// where the whole horizon is clear, too late where zero is not.
pub(super) fn largest_clear(clear: impl Fn(f64) -> bool) -> Reaction {
    if clear(HORIZON) {
        return Reaction::NoDanger;
    }
    if !clear(0.0) {
        return Reaction::TooLate;
    }
    let (mut yes, mut no) = (0.0, HORIZON);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(yes, no);
        if clear(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
    Reaction::Within(yes)
}

/// 20 s / 2^44 is a picosecond.
const HALVINGS: u32 = 44;
