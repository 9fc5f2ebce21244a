//! What braking can still do: required deceleration, BTN, TTB, impact speed.
//!
//! The actor holds its acceleration a_a until it stands, and does not react. The ego brakes by a constant deceleration
//! until it stands; the least that avoids contact is
//!
//! ```text
//!   a_req = (v_e - v_a)^2 / (2 g) - a_a                while both still move: 2 g / (v_e - v_a) <= T_a
//!   a_req = v_e^2 / (2 (g + v_a |v_a| / (2 |a_a|)))    where the actor stands first, after T_a = v_a / -a_a
//!   a_req = 0                                          where nothing is closing, now or later
//!
//!   BTN = a_req / a_max          TTB = the largest t for which holding a_e up to t and then braking by a_max avoids
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | g, v_e, v_a, a_e, a_a | as in [`super::approach`] | m, m/s, m/s2 |
//! | a_max | the hardest the ego can brake, or what it brakes already if that is more | m/s2 |
//!
//! With both speeds held TTB = TTC - (v_e - v_a) / (2 a_max). Once it is past, TTB is how long ago the braking had to
//! begin, the ego at its present speed until then and the actor unchanged: the same formula where speeds are held.
//! Where both are defined, TTB < 0 exactly where BTN > 1.
//!
//! Sources: Jansson, "Collision Avoidance Theory" (2005), section 5.3 (required acceleration with an actor that brakes
//! and may stop first, BTN); Brännström, Sjöberg & Coelingh (2008) (BTN); Hillenbrand, Spieker & Kroschel, "A
//! multilevel collision mitigation approach" (2006) (TTB). The impact speed is the speed difference at contact, the delta-v of a
//! partner of infinite mass; a real crash shares it between two masses. Left out: delay and build-up of the brakes,
//! drivers who react.

use super::Approach;
use zhuyi_estimator::ego_motion::{EgoMotion, Start};

/// Halvings of an interval of seconds: to the last digit of a double, and no more.
const HALVINGS: u32 = 60;

/// What the ego does until contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Response {
    /// It brakes as hard as it can from now on.
    BrakeNow,
    /// It holds its acceleration, until it stands.
    Hold,
}

impl Approach {
    /// [m/s2] a_req, at least 0; None if no deceleration will do: the actor comes towards the ego and does not stop in
    /// time, or no gap is left.
    ///
    /// 30 m at 25 against 10 m/s: 15^2/60 = 3.75; if the actor also brakes at 1 m/s2, 4.75. If it brakes at 5 m/s2 it
    /// stands 10 m further on, after 2 s, before the speeds could have met: 25^2 / 80 = 7.8125.
    /// ```
    /// use zhuyi_metrics::criticality::Approach;
    /// let pair = |actor_accel: f64| Approach {
    ///     gap: 30.0, ego_speed: 25.0, ego_accel: 0.0, actor_speed: 10.0, actor_accel,
    /// };
    /// assert_eq!(pair(0.0).required_decel(), Some(3.75));
    /// assert_eq!(pair(-1.0).required_decel(), Some(4.75));
    /// assert_eq!(pair(-5.0).required_decel(), Some(7.8125));
    /// assert_eq!(pair(4.0).required_decel(), Some(0.0)); // it gets away
    /// ```
    pub fn required_decel(&self) -> Option<f64> {
        let (closing, stands_from) = (self.closing_speed(), self.actor_stands_from());
        let stops = stands_from.is_finite();
        if self.gap < 0.0 || (self.actor_speed < 0.0 && !stops) {
            return None;
        }
        let room = self.gap
            + if stops {
                self.actor_distance(stands_from)
            } else {
                0.0
            };
        let to_stand = || self.ego_speed * self.ego_speed / (2.0 * room);
        let decel = if self.actor_speed < 0.0 {
            if room < 0.0 {
                return None;
            }
            to_stand()
        } else if closing > 0.0 && 2.0 * self.gap <= closing * stands_from {
            closing * closing / (2.0 * self.gap) - self.actor_accel
        } else if stops {
            to_stand()
        } else {
            0.0
        };
        if self.ego_speed == 0.0 {
            return Some(0.0);
        }
        decel.is_finite().then_some(decel.max(0.0))
    }

    /// [-] brake threat number, a_req / a_max; None where a_req is.
    ///
    /// 7.8125 m/s2 of 5 m/s2: 1.5625, too late.
    /// ```
    /// # use zhuyi_metrics::criticality::Approach;
    /// let pair = Approach { gap: 30.0, ego_speed: 25.0, ego_accel: 0.0, actor_speed: 10.0, actor_accel: -5.0 };
    /// assert_eq!(pair.btn(5.0), Some(1.5625));
    /// ```
    pub fn btn(&self, max_decel: f64) -> Option<f64> {
        self.required_decel()
            .map(|decel| decel / self.available(max_decel))
            .filter(|number| number.is_finite())
    }

    /// [s] time to brake; negative when it is too late. None if the ego need not brake as things are, or if no earlier
    /// braking would have helped.
    ///
    /// 40 m at 20 m/s towards a standing actor: braking at 8 m/s2 takes 25 m, the other 15 m are 0.75 s. At 20 m it is
    /// 5 m, or 0.25 s, too late.
    /// ```
    /// use zhuyi_metrics::criticality::Approach;
    /// let pair = |gap: f64| Approach { gap, ego_speed: 20.0, ego_accel: 0.0, actor_speed: 0.0, actor_accel: 0.0 };
    /// assert!((pair(40.0).ttb(8.0).unwrap() - 0.75).abs() < 1e-12);
    /// assert!((pair(20.0).ttb(8.0).unwrap() + 0.25).abs() < 1e-12);
    /// ```
    pub fn ttb(&self, max_decel: f64) -> Option<f64> {
        let available = self.available(max_decel);
        let enough = |pair: &Self| {
            pair.required_decel()
                .is_some_and(|decel| decel <= available)
        };
        if self.required_decel()? <= available {
            let contact = self.ttc_with_accelerations()?;
            return Some(last(contact, |time| enough(&self.later(time))));
        }
        let begun = |time: f64| self.had_it_braked(time, available);
        let longest = self.ego_speed / available;
        if !longest.is_finite() || !enough(&begun(longest)) {
            return None;
        }
        // How long ago is too short: the last such time is also the first one that would have done.
        Some(-last(longest, |time| !enough(&begun(time))))
    }

    /// [m/s] speed difference at contact, 0 if there is none.
    ///
    /// 20 m at 20 m/s towards a standing actor, braking at 8 m/s2: sqrt(400 - 2 x 8 x 20) = 8.94; holding, 20.
    /// ```
    /// use zhuyi_metrics::criticality::{Approach, Response};
    /// let pair = Approach { gap: 20.0, ego_speed: 20.0, ego_accel: 0.0, actor_speed: 0.0, actor_accel: 0.0 };
    /// assert!((pair.impact_speed(8.0, Response::BrakeNow) - 80_f64.sqrt()).abs() < 1e-12);
    /// assert_eq!(pair.impact_speed(8.0, Response::Hold), 20.0);
    /// ```
    pub fn impact_speed(&self, max_decel: f64, response: Response) -> f64 {
        let available = self.available(max_decel);
        let motion = match response {
            // Said by the closed form, so that rounding leaves no crash at BTN = 1.
            Response::BrakeNow
                if self
                    .required_decel()
                    .is_some_and(|decel| decel <= available) =>
            {
                return 0.0;
            }
            Response::BrakeNow => {
                EgoMotion::new(Start::new(self.ego_speed, self.ego_accel), 0.0, available)
            }
            Response::Hold => self.held(),
        };
        let contact = match response {
            Response::BrakeNow => self.first_contact(&motion),
            Response::Hold => self.ttc_with_accelerations(),
        };
        contact.map_or(0.0, |time| {
            (motion.speed(time) - self.actor_speed_at(time)).max(0.0)
        })
    }

    /// a_max: what the ego does already it can, so that to brake earlier is never worse.
    fn available(&self, max_decel: f64) -> f64 {
        max_decel.max(-self.ego_accel)
    }

    /// The pair after `time`, with all accelerations held.
    fn later(&self, time: f64) -> Self {
        let held = self.held();
        let stands = time >= self.actor_stands_from();
        Self {
            gap: self.gap + self.actor_distance(time) - held.distance(time),
            ego_speed: held.speed(time),
            ego_accel: self.ego_accel,
            actor_speed: self.actor_speed_at(time),
            actor_accel: if stands { 0.0 } else { self.actor_accel },
        }
    }

    /// The pair now, had the ego come at its present speed and braked for the last `time` seconds.
    fn had_it_braked(&self, time: f64, decel: f64) -> Self {
        Self {
            gap: self.gap + decel * time * time / 2.0,
            ego_speed: (self.ego_speed - decel * time).max(0.0),
            ..*self
        }
    }
}

/// The last time in [0, `end`] up to which `holds`, given that it holds at 0 and changes once.
fn last(end: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut yes, mut no) = (0.0, end);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(yes, no);
        if holds(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
    yes
}
