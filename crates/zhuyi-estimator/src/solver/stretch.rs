//! Time cut so finely that the ego and the actor each follow one polynomial, and what the constraints are on such a
//! piece.
//!
//! On a stretch of local time x in [0, length] the gap is a quadratic, the actor's speed a line, the ego's distance
//! a quadratic and its speed a line. So each of Eq. 1, Eq. 2 and the absence of contact (reading R6) is a
//! polynomial of degree two at most, and the first x that meets or breaks it is a root.

use super::recording::AlongBlock;
use crate::constraints::TOLERANCE;
use crate::ego_motion::Phase;
use zhuyi_core::Along;
use zhuyi_core::quadratic::Quadratic;

/// What time and place are counted from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Datum {
    /// [s] t_0 on the clock of the lists.
    pub now: f64,
    /// [m] the `s` of the actor's centre at which its rear bumper is where the ego's front bumper is at t_0.
    pub origin: f64,
}

/// Ego and actor on one piece of time; all polynomials are in x = t - start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    pub length: f64,
    /// s(t).
    pub gap: Quadratic,
    /// v_a(t), constant and linear coefficient.
    pub actor_speed: (f64, f64),
    /// d(t); v_e(t) is its derivative.
    pub distance: Quadratic,
}

impl Stretch {
    /// From `start` to `end`, within one piece of the actor and one phase of the ego.
    pub fn new(start: f64, end: f64, piece: &Along, datum: Datum, phase: &Phase) -> Self {
        let (x, y) = (start + datum.now - piece.time, start - phase.start);
        let s = Quadratic {
            c0: piece.s - datum.origin,
            c1: piece.s_rate,
            c2: piece.s_half_accel,
        };
        let d = Quadratic {
            c0: phase.distance,
            c1: phase.speed,
            c2: phase.accel / 2.0,
        };
        let actor_speed = (piece.v + x * piece.v_rate, piece.v_rate);
        Self {
            length: end - start,
            gap: s.from(x),
            actor_speed,
            distance: d.from(y),
        }
    }

    /// s - d, negative once the ego's front is beyond the actor's rear.
    fn clearance(&self) -> Quadratic {
        Quadratic {
            c0: self.gap.c0 - self.distance.c0 + TOLERANCE,
            c1: self.gap.c1 - self.distance.c1,
            c2: self.gap.c2 - self.distance.c2,
        }
    }

    /// Eq. 1 with its tolerance.
    fn distance_slack(&self, c1: f64) -> Quadratic {
        Quadratic {
            c0: c1 * self.gap.c0 - self.distance.c0 + TOLERANCE,
            c1: c1 * self.gap.c1 - self.distance.c1,
            c2: c1 * self.gap.c2 - self.distance.c2,
        }
    }

    /// The x at which the ego's front first passes the actor's rear.
    #[inline]
    pub fn first_contact(&self) -> Option<f64> {
        self.clearance().first_below(self.length)
    }

    /// The first x at which Eq. 1 is met.
    pub fn first_within(&self, c1: f64) -> Option<f64> {
        self.distance_slack(c1).first_reached(self.length)
    }

    /// The first x in [0, end] at which both constraints are met.
    #[inline]
    pub fn first_met(&self, margins: Margins, end: f64) -> Option<f64> {
        let met = self.first_met_below(margins, margins.c2, end);
        let reverses =
            self.actor_speed.0 < 0.0 || self.actor_speed.0 + self.actor_speed.1 * end < 0.0;
        if !reverses {
            return met;
        }
        // C2 max(0, v_a) is the larger of C2 v_a and 0, so either will do.
        match (met, self.first_met_below(margins, 0.0, end)) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// The first x in [0, end] with Eq. 1 and v_e <= c2 v_a.
    #[inline]
    fn first_met_below(&self, margins: Margins, c2: f64, end: f64) -> Option<f64> {
        let (from, to) = self.slow_enough(c2, end)?;
        self.distance_slack(margins.c1)
            .from(from)
            .first_reached(to - from)
            .map(|x| from + x)
    }

    /// The part of [0, end] with v_e <= c2 v_a.
    fn slow_enough(&self, c2: f64, end: f64) -> Option<(f64, f64)> {
        let slack = c2 * self.actor_speed.0 - self.distance.c1 + TOLERANCE;
        window(slack, c2 * self.actor_speed.1 - 2.0 * self.distance.c2, end)
    }

    /// Whether Eq. 2 is met at any time.
    pub fn ever_slow_enough(&self, margins: Margins) -> bool {
        self.slow_enough(margins.c2, self.length)
            .or_else(|| self.slow_enough(0.0, self.length))
            .is_some()
    }
}

/// Many stretches as one, with an error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outline {
    stretch: Stretch,
    gap_error: f64,
    speed_error: f64,
}

impl Outline {
    /// Over [start, end], within one block of the actor and one phase of the ego.
    pub fn new(start: f64, end: f64, block: &AlongBlock, datum: Datum, phase: &Phase) -> Self {
        let stretch = Stretch::new(start, end, &block.fit, datum, phase);
        Self {
            stretch,
            gap_error: block.s_error,
            speed_error: block.v_error,
        }
    }

    /// The x before which there is surely no contact; none where there is none on all of it.
    pub fn first_contact(&self) -> Option<f64> {
        let mut nearer = self.stretch;
        nearer.gap.c0 -= self.gap_error;
        nearer.first_contact()
    }

    /// The x before which both constraints are surely not met; none where they are not on all of it.
    pub fn first_met(&self, margins: Margins) -> Option<f64> {
        let mut kinder = self.stretch;
        kinder.gap.c0 += self.gap_error;
        kinder.actor_speed.0 += self.speed_error;
        kinder.first_met(margins, kinder.length)
    }
}

/// C1 and C2.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Margins {
    pub c1: f64,
    pub c2: f64,
}

/// The part of [0, end] on which `value + rate x` is at least zero.
fn window(value: f64, rate: f64, end: f64) -> Option<(f64, f64)> {
    let last = value + rate * end;
    match (value >= 0.0, last >= 0.0) {
        (true, true) => Some((0.0, end)),
        (true, false) => Some((0.0, (value / -rate).min(end))),
        (false, true) => Some(((-value / rate).min(end), end)),
        (false, false) => None,
    }
}
