//! The Safety Force Field: how late the ego's safety procedure may begin without its claimed set touching the other's.
//!
//! ```text
//!   claimed set C = all (t, place) that a body sweeps while its safety procedure runs
//!   t_r = the largest r with  C_ego(r) ∩ C_actor = ∅
//!
//!   ego:    hold a_0 until r, then brake by any b in [b_min, b_max]       lengthwise at t: [x(t; b_max), x(t; b_min)]
//!   actor:  brake from t_0 by any b in [b_min, b_max], heading held       sideways: d(t) = d_0 + (d'/v_a) x_a(t)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | r | when the ego's procedure begins | s |
//! | x(t; b) | distance covered, braking by b | m |
//! | d_0, d', v_a | the actor's offset, its rate and its speed at t_0 | m, m/s, m/s |
//! | b_min, b_max | bounds of the braking | m/s2 |
//!
//! This reading: both bodies are boxes along the road; both procedures are braking to standstill; the sets live in
//! space and time, so two bodies that use one place one after the other do not touch. The set at a time is taken as
//! the box around all of its brakings: while the boxes can overlap sideways, the ego must stay behind the actor, or the
//! actor behind the ego, for all pairs of brakings (with b_min = b_max that is the set itself). r is found between 0 and 20 s. An ego that may hold for all of
//! the 20 s is in no danger, even if a braking in between would let them touch. An actor behind the ego at t_0 is none of its business.
//!
//! Source: Nister, Lee, Ng, Wang, "The Safety Force Field" and "An Introduction to the Safety Force Field" (NVIDIA,
//! 2019); DriveWorks documentation, "Safety Force Field". They leave the procedure and its bounds open; the default
//! brakes by 6 m/s2 sharp, as the other models do. Left out: the force itself (the gradient along which controls are
//! constrained), steering as part of a procedure, claimed sets that grow with time for uncertainty of control, and
//! procedures that follow the road. The source claims sets for any actor; this reading has none for one that comes towards the
//! ego or crosses its path ([`Direction`]), and is not defined for it.

use super::braking_profile::{Brakes, BrakingProfile, HORIZON, largest_clear};
use super::{Direction, at_start};
use zhuyi_core::Footprint;
use zhuyi_estimator::ego_motion::Start;
use zhuyi_estimator::{ActorStart, Ego, Future, Reaction, SafetyModel};

/// Claimed sets of two braking vehicles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafetyForceField {
    /// [m/s2] b_min, the least braking of a procedure (6).
    pub least_decel: f64,
    /// [m/s2] b_max, the hardest (6).
    pub most_decel: f64,
}

impl Default for SafetyForceField {
    fn default() -> Self {
        Self {
            least_decel: 6.0,
            most_decel: 6.0,
        }
    }
}

impl SafetyModel for SafetyForceField {
    fn name(&self) -> &'static str {
        "sff"
    }

    /// 12 m/s, a standing car 42 m ahead: braking takes 12 m, and the other 30 m are 2.5 s.
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint};
    /// # use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};
    /// use zhuyi_metrics::safety_models::SafetyForceField;
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let ego = Ego { s: 0.0, d: 0.0, speed: 12.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 46.0, 0.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// let Reaction::Within(time) = SafetyForceField::default().reaction(&ego, car, &future) else { panic!() };
    /// assert!((time - 2.5).abs() < 1e-9);
    /// ```
    fn reaction(&self, ego: &Ego, actor: Footprint, future: &Future<'_>) -> Reaction {
        at_start(future, |start| {
            let actor = future.box_at(actor, 0.0);
            let reach = ego.footprint.half_lengths(actor);
            let ahead = start.s - ego.s;
            if ahead < -reach {
                return None;
            }
            if !Direction::of(start).is_a_leads() {
                return Some(Reaction::NotDefined);
            }
            let half_widths = ego.footprint.half_widths(actor);
            let window = self.overlap(start, ego.d, half_widths)?;
            let speed = Start::new(ego.speed, ego.accel);
            let braking = |start, onset, decel| {
                BrakingProfile::braking(start, onset, Brakes { decel, jerk: None })
            };
            let other = Start::new(start.speed, 0.0);
            let (actor_near, actor_far) = (
                braking(other, 0.0, self.most_decel),
                braking(other, 0.0, self.least_decel),
            );
            Some(largest_clear(|onset| {
                let far = braking(speed, onset, self.least_decel);
                let near = braking(speed, onset, self.most_decel);
                far.stays_behind(&actor_near, ahead, reach, window)
                    || actor_far.stays_behind(&near, -ahead, reach, window)
            }))
        })
    }
}

impl SafetyForceField {
    /// [s] the window in which the boxes can overlap sideways: it opens when the least braking brings the actor in,
    /// and closes when the hardest takes it out again.
    fn overlap(&self, start: &ActorStart, ego_d: f64, half_widths: f64) -> Option<(f64, f64)> {
        let aside = start.d - ego_d;
        let slope = if start.speed > 0.0 {
            start.d_rate / start.speed
        } else {
            0.0
        };
        if slope == 0.0 {
            return (aside.abs() < half_widths).then_some((0.0, HORIZON));
        }
        let (one, other) = (
            (-half_widths - aside) / slope,
            (half_widths - aside) / slope,
        );
        let (enter, leave) = (one.min(other), one.max(other));
        if leave <= 0.0 {
            return None;
        }
        let from = braking_time(enter, start.speed, self.least_decel)?;
        let to = braking_time(leave, start.speed, self.most_decel).unwrap_or(HORIZON);
        (from < HORIZON).then_some((from, to.min(HORIZON)))
    }
}

/// [s] when one that brakes from `speed` has covered `distance`; none if it stands before.
fn braking_time(distance: f64, speed: f64, decel: f64) -> Option<f64> {
    if distance <= 0.0 {
        return Some(0.0);
    }
    let left = speed * speed - 2.0 * decel * distance;
    (left > 0.0).then(|| 2.0 * distance / (speed + left.sqrt()))
}
