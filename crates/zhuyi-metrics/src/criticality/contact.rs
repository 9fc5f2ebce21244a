//! When one vehicle first touches the one ahead, both with constant acceleration until they stand: TTC with
//! accelerations, and what braking metrics rest on.
//!
//! ```text
//!   g + v_a t + a_a t^2/2 - d(t) = 0        d(t): the ego holds, brakes, stands (ego_motion)
//! ```
//!
//! The actor stands from T_a = v_a / -a_a on where a_a opposes v_a. Between the times at which either changes its
//! acceleration the gap is one quadratic, so the first contact is a root. To touch at one instant without pressing on
//! is no contact. Source: Jansson, "Collision Avoidance Theory" (2005), chapter 5, for held accelerations; that
//! vehicles stop and stay is reading R2.

use super::Approach;
use zhuyi_core::approach::LEAST_CLOSING_SPEED;
use zhuyi_core::quadratic::Quadratic;
use zhuyi_estimator::ego_motion::{EgoMotion, Phase, Start};

impl Approach {
    /// [s] time to collision with both accelerations held, each until its vehicle stands; None if there is none, or where
    /// the two move alike: the gap closes by less than 1 mm/s, and within a second still does.
    ///
    /// 8 m apart, both at 10 m/s, the actor brakes at 4 m/s2: 8 = 4 t^2/2 after 2 s, while it still drives at 2 m/s.
    /// At 18.5 m it stands, after 2.5 s and 12.5 m, before the ego has come 31 m in 3.1 s.
    /// ```
    /// use zhuyi_metrics::criticality::Approach;
    /// let mut pair = Approach { gap: 8.0, ego_speed: 10.0, ego_accel: 0.0, actor_speed: 10.0, actor_accel: -4.0 };
    /// assert_eq!((pair.ttc(), pair.ttc_with_accelerations()), (None, Some(2.0)));
    /// pair.gap = 18.5;
    /// assert!((pair.ttc_with_accelerations().unwrap() - 3.1).abs() < 1e-12);
    /// ```
    pub fn ttc_with_accelerations(&self) -> Option<f64> {
        if self.moves_alike() {
            return None;
        }
        self.first_contact(&self.held())
    }

    /// Whether speeds, and speeds a second later, differ by less than [`LEAST_CLOSING_SPEED`].
    fn moves_alike(&self) -> bool {
        let second = 1.0;
        let later = self.held().speed(second) - self.actor_speed_at(second);
        let alike = |speed: f64| speed.abs() < LEAST_CLOSING_SPEED;
        alike(self.closing_speed()) && alike(later)
    }

    /// The ego's motion with its acceleration held.
    pub(super) fn held(&self) -> EgoMotion {
        EgoMotion::held(Start::new(self.ego_speed, self.ego_accel))
    }

    /// When the ego on `motion` first presses on the actor.
    pub(super) fn first_contact(&self, motion: &EgoMotion) -> Option<f64> {
        let mut from = 0.0;
        for (phase, end) in motion.phases() {
            for until in [self.actor_stands_from().min(end), end] {
                if until > from {
                    if let Some(x) = first_below(&self.gap_from(phase, from), until - from) {
                        return Some(from + x);
                    }
                    from = until;
                }
            }
        }
        None
    }

    /// [s] T_a, from which on the actor stands; infinite if it never does. A standing actor may pull off, but does not
    /// begin to reverse.
    pub(super) fn actor_stands_from(&self) -> f64 {
        let (speed, accel) = (self.actor_speed, self.actor_accel);
        if speed * accel < 0.0 {
            -speed / accel
        } else if speed == 0.0 && accel < 0.0 {
            0.0
        } else {
            f64::INFINITY
        }
    }

    /// [m] how far the actor has gone.
    pub(super) fn actor_distance(&self, time: f64) -> f64 {
        let moving = time.min(self.actor_stands_from());
        moving * (self.actor_speed + moving * (self.actor_accel / 2.0))
    }

    /// [m/s] how fast the actor is.
    pub(super) fn actor_speed_at(&self, time: f64) -> f64 {
        if time < self.actor_stands_from() {
            self.actor_speed + time * self.actor_accel
        } else {
            0.0
        }
    }

    /// The gap as seen from a time of one phase of the ego.
    fn gap_from(&self, phase: &Phase, time: f64) -> Quadratic {
        let accel = if time < self.actor_stands_from() {
            self.actor_accel
        } else {
            0.0
        };
        Quadratic {
            c0: self.gap + self.actor_distance(time) - phase.distance_at(time),
            c1: self.actor_speed_at(time) - phase.speed_at(time),
            c2: (accel - phase.accel) / 2.0,
        }
    }
}

/// As [`Quadratic::first_below`], for an end that may be infinite.
fn first_below(gap: &Quadratic, end: f64) -> Option<f64> {
    let Quadratic { c0, c1, c2 } = *gap;
    // From there on the curve does not fall through zero for the first time.
    let last = if c2 > 0.0 {
        -c1 / c2
    } else if c2 < 0.0 {
        1.0 + (c1.abs() + (c1 * c1 - 4.0 * c0.max(0.0) * c2).sqrt()) / -c2
    } else {
        1.0 + c0.max(0.0) / -c1
    };
    let end = if end.is_finite() { end } else { last.max(0.0) };
    gap.first_below(end).filter(|time| time.is_finite())
}
