//! The competent and careful driver of UN R157: the latest onset of its braking that avoids the collision.
//!
//! ```text
//!   the actor:  keeps its speed, and its lateral speed until its centre is on the ego's path, then stays there
//!   the ego:    holds a_0 until t_r, builds its braking up to b in t_b (jerk j = b/t_b), brakes until it stands
//!   t_r = the largest onset with room(t) >= 0 whenever the boxes overlap sideways
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | b | 0.774 g = 7.593 m/s2 | m/s2 |
//! | t_b, j | 0.6 s, 12.65 m/s3 | s, m/s3 |
//! | room | distance between the boxes lengthwise | m |
//!
//! What the driver itself takes before the onset is not part of the question: the regulation grants it 0.4 s to judge
//! the risk, from a lateral wandering of 0.375 m on, and 0.75 s of delay. [`super::cut_in`] plays a whole cut-in with
//! a driver who takes its time. The actor is taken as it is at t_0 and not from the rest of its future: the driver
//! has no other to look at. One that moves away leaves for ever.
//!
//! The onset is found by bisection over the motions in closed form. No danger if holding on for 20 s touches nothing,
//! or the actor is behind the ego at t_0.
//!
//! The guidance speaks of vehicles that cut in, cut out or decelerate; for one that comes towards the ego or crosses its path
//! it is not defined.
//!
//! Source: UN R157, guidance on critical traffic disturbance scenarios (annex 4, appendix 3 of the 2020 text; annex 3
//! since the 01 series). Left out: its drag of the engine during the delay, and steering.

use super::braking_profile::{Brakes, BrakingProfile, HORIZON, largest_clear};
use super::{Direction, at_start};
use zhuyi_core::Footprint;
use zhuyi_estimator::ego_motion::Start;
use zhuyi_estimator::{ActorStart, Ego, Future, Reaction, SafetyModel};

/// The driver's brakes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarefulDriver {
    /// [m/s2] b.
    pub decel: f64,
    /// [s] t_b, in which the braking builds up from nothing; zero for at once.
    pub build_up: f64,
}

impl Default for CarefulDriver {
    fn default() -> Self {
        Self {
            decel: 0.774 * 9.81,
            build_up: 0.6,
        }
    }
}

impl CarefulDriver {
    fn brakes(&self) -> Brakes {
        Brakes {
            decel: self.decel,
            jerk: (self.build_up > 0.0).then(|| self.decel / self.build_up),
        }
    }
}

impl SafetyModel for CarefulDriver {
    fn name(&self) -> &'static str {
        "r157-driver"
    }

    /// 12 m/s, a standing car 42 m ahead, 6 m/s2 reached in 0.6 s (10 m/s3). The build-up takes 12 x 0.6 - 10 x 0.6^3/6
    /// = 6.84 m and leaves 10.2 m/s, the rest 10.2^2/12 = 8.67 m; the other 26.49 m are 2.2075 s.
    /// ```
    /// # use zhuyi_core::{Across, Along, Footprint};
    /// # use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};
    /// use zhuyi_metrics::safety_models::CarefulDriver;
    /// # let car = Footprint { length: 4.0, width: 2.0 };
    /// # let ego = Ego { s: 0.0, d: 0.0, speed: 12.0, accel: 0.0, footprint: car };
    /// # let along = [Along::constant_accel(0.0, 46.0, 0.0, 0.0)];
    /// # let across = [Across { time: 0.0, d: 0.0, d_rate: 0.0 }];
    /// # let future = Future { along: &along, across: &across, extents: &[], known_until: 20.0, now: 0.0 };
    /// let driver = CarefulDriver { decel: 6.0, build_up: 0.6 };
    /// let Reaction::Within(time) = driver.reaction(&ego, car, &future) else { panic!() };
    /// assert!((time - 2.2075).abs() < 1e-9);
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
            let window = overlap(start, ego.d, half_widths)?;
            let leader = BrakingProfile::steady(start.speed);
            let speed = Start::new(ego.speed, ego.accel);
            Some(largest_clear(|onset| {
                let braking = BrakingProfile::braking(speed, onset, self.brakes());
                braking.stays_behind(&leader, ahead, reach, window)
                    || leader.stays_behind(&braking, -ahead, reach, window)
            }))
        })
    }
}

/// [s] the window in which the boxes overlap sideways, within the horizon.
fn overlap(start: &ActorStart, ego_d: f64, half_widths: f64) -> Option<(f64, f64)> {
    let aside = start.d - ego_d;
    let outward = if aside == 0.0 {
        0.0
    } else {
        start.d_rate * aside.signum()
    };
    if aside.abs() < half_widths {
        // Already overlapping: one that moves inward stays, one that moves outward leaves.
        let leaves = (half_widths - aside.abs()) / outward;
        let to = if outward > 0.0 { leaves } else { HORIZON };
        return Some((0.0, to.min(HORIZON)));
    }
    if outward >= 0.0 {
        return None;
    }
    let from = (aside.abs() - half_widths) / -outward;
    (from < HORIZON).then_some((from, HORIZON))
}
