//! The longitudinal safe distances of RSS, for two vehicles in one direction and in opposite ones, and their solutions for the
//! response time.
//!
//! ```text
//!   d(rho) = [ v_r rho + a rho^2/2 + (v_r + rho a)^2/(2 b_min) - v_f^2/(2 b_max) ]+
//!
//!   d(rho) = gap:   A rho^2 + B rho = C,   A = a k/2,  B = v_r k,  C = gap + v_f^2/(2 b_max) - v_r^2/(2 b_min),
//!                   k = 1 + a/b_min,       rho = 2 C / (B + sqrt(B^2 + 4 A C))
//! ```
//!
//! With a cap c the one behind accelerates up to `max(v_r, c)` and then holds, from t_c = (c - v_r)/a on:
//!
//! ```text
//!   d(rho) = d(t_c) + c (rho - t_c)   for rho > t_c
//! ```
//!
//! Towards each other both may accelerate while they respond, then both brake, the ego in its correct lane by less:
//!
//! ```text
//!   d(rho) = v_e rho + a rho^2/2 + (v_e + rho a)^2/(2 b_correct) + |v_o| rho_o + a rho_o^2/2 + (|v_o| + rho_o a)^2/(2 b_min)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | rho | response time of the one behind, or of the ego | s |
//! | v_r, v_f | speeds of the one behind and the one ahead | m/s |
//! | rho_o | response time of the one that comes towards the ego | s |
//! | v_e, v_o | speeds of the ego and of that one | m/s |
//! | a | largest acceleration while responding | m/s2 |
//! | b_min, b_max | least braking behind, hardest ahead | m/s2 |
//! | b_correct | least braking of the ego in its correct lane | m/s2 |
//!
//! Source: arXiv 1708.06374, safe longitudinal distance, same direction and opposite directions; the cap: ad-rss-lib,
//! `max_speed_on_acceleration`. Left out: an ego in the wrong lane.

use super::Rss;
use zhuyi_estimator::Reaction;

impl Rss {
    /// [m] distance until standstill for one that accelerates through `response` and then brakes by b_min.
    ///
    /// 20 m/s, 1 s, a = 2, b_min = 4: 20 + 1 + 22^2/8 = 81.5 m.
    /// ```
    /// use zhuyi_metrics::safety_models::Rss;
    /// let rss = Rss { accel: 2.0, least_brake: 4.0, ..Rss::default() };
    /// assert_eq!(rss.stopping_distance(1.0, 20.0), 81.5);
    /// // Capped at 20 m/s it holds: 20 + 400/8 = 70 m. Capped at 21 m/s it does so after half a second:
    /// // 20 x 0.5 + 0.25 + 21 x 0.5 + 441/8 = 75.875 m.
    /// assert_eq!(Rss { speed_cap: Some(20.0), ..rss }.stopping_distance(1.0, 20.0), 70.0);
    /// assert_eq!(Rss { speed_cap: Some(21.0), ..rss }.stopping_distance(1.0, 20.0), 75.875);
    /// ```
    pub fn stopping_distance(&self, response: f64, speed: f64) -> f64 {
        self.stopping_by(self.least_brake, response, speed)
    }

    /// The same for another braking.
    fn stopping_by(&self, brake: f64, response: f64, speed: f64) -> f64 {
        let gaining = response.min(self.gaining_time(speed));
        let reached = speed + gaining * self.accel;
        gaining * f64::midpoint(speed, reached)
            + (response - gaining) * reached
            + reached * reached / (2.0 * brake)
    }

    /// [m] d(rho), the safe distance of an ego at `rear` m/s to an actor ahead at `front` m/s.
    ///
    /// 20 m/s behind 10 m/s, 1 s, a = 2, b_min = 4, b_max = 8: 81.5 - 100/16 = 75.25 m.
    /// ```
    /// use zhuyi_metrics::safety_models::Rss;
    /// let rss = Rss { accel: 2.0, least_brake: 4.0, most_brake: 8.0, ..Rss::default() };
    /// assert_eq!(rss.longitudinal_distance(1.0, 20.0, 10.0), 75.25);
    /// assert_eq!(rss.longitudinal_distance(0.0, 1.0, 10.0), 0.0);
    /// ```
    pub fn longitudinal_distance(&self, response: f64, rear: f64, front: f64) -> f64 {
        (self.stopping_distance(response, rear) - front * front / (2.0 * self.most_brake)).max(0.0)
    }

    /// The largest response time of the ego for which `gap` is a safe distance; side by side (a negative gap) none is.
    ///
    /// ```
    /// use zhuyi_estimator::Reaction;
    /// use zhuyi_metrics::safety_models::Rss;
    /// let rss = Rss { accel: 2.0, least_brake: 4.0, most_brake: 8.0, ..Rss::default() };
    /// assert_eq!(rss.longitudinal_response(75.25, 20.0, 10.0), Reaction::Within(1.0));
    /// // 20^2/8 - 10^2/16 = 43.75 m are needed even by one that responds at once.
    /// assert_eq!(rss.longitudinal_response(43.7, 20.0, 10.0), Reaction::TooLate);
    /// ```
    pub fn longitudinal_response(&self, gap: f64, rear: f64, front: f64) -> Reaction {
        if gap < 0.0 {
            return Reaction::TooLate;
        }
        let room = gap + front * front / (2.0 * self.most_brake);
        self.stops_within(room, rear, self.least_brake)
    }

    /// [m] d(rho), the safe distance of an ego at `ego` m/s in its lane to an actor that comes towards it at `other` m/s.
    ///
    /// 20 m/s, 1 s, a = 2, b_correct = 4: 81.5 m. The other at 10 m/s, 0.5 s, b_min = 5: 5 + 0.25 + 11^2/10 = 17.35 m.
    /// ```
    /// use zhuyi_metrics::safety_models::Rss;
    /// let rss = Rss { response: 0.5, accel: 2.0, least_brake: 5.0, correct_brake: 4.0, ..Rss::default() };
    /// assert_eq!(rss.opposite_distance(1.0, 20.0, 10.0), 81.5 + 17.35);
    /// ```
    pub fn opposite_distance(&self, response: f64, ego: f64, other: f64) -> f64 {
        self.stopping_by(self.correct_brake, response, ego)
            + self.stopping_distance(self.response, other)
    }

    /// The largest response time of the ego for which `gap` is a safe distance to one that comes towards it.
    ///
    /// ```
    /// use zhuyi_estimator::Reaction;
    /// use zhuyi_metrics::safety_models::Rss;
    /// let rss = Rss { response: 0.5, accel: 2.0, least_brake: 5.0, correct_brake: 4.0, ..Rss::default() };
    /// assert_eq!(rss.opposite_response(81.5 + 17.35, 20.0, 10.0), Reaction::Within(1.0));
    /// assert_eq!(rss.opposite_response(50.0, 20.0, 10.0), Reaction::TooLate);
    /// ```
    pub fn opposite_response(&self, gap: f64, ego: f64, other: f64) -> Reaction {
        let room = gap - self.stopping_distance(self.response, other);
        self.stops_within(room, ego, self.correct_brake)
    }

    /// The largest response time with which one at `speed` stops within `room`, braking by `brake`.
    fn stops_within(&self, room: f64, speed: f64, brake: f64) -> Reaction {
        let gaining = self.gaining_time(speed);
        if gaining.is_finite() {
            let spare = room - self.stopping_by(brake, gaining, speed);
            let held = speed + gaining * self.accel;
            if spare > 0.0 && held > 0.0 {
                return Reaction::Within(gaining + spare / held);
            }
        }
        let c = room - speed * speed / (2.0 * brake);
        largest_response(c, speed, self.accel, brake)
    }

    /// [s] how long one at this speed may accelerate until it meets the cap; infinite without one.
    fn gaining_time(&self, speed: f64) -> f64 {
        match self.speed_cap {
            Some(cap) if cap <= speed || self.accel <= 0.0 => 0.0,
            Some(cap) => (cap - speed) / self.accel,
            None => f64::INFINITY,
        }
    }
}

/// The rho >= 0 at which `v rho + a rho^2/2 + ((v + a rho)^2 - v^2)/(2 b)` reaches `c`, for v >= 0.
pub(super) fn largest_response(c: f64, v: f64, a: f64, b: f64) -> Reaction {
    if c < 0.0 {
        return Reaction::TooLate;
    }
    let k = 1.0 + a / b;
    let (quadratic, linear) = (a * k / 2.0, v * k);
    let divisor = linear + (linear * linear + 4.0 * quadratic * c).sqrt();
    if divisor > 0.0 {
        Reaction::Within(2.0 * c / divisor)
    } else if quadratic > 0.0 {
        Reaction::Within(0.0)
    } else {
        Reaction::NoDanger
    }
}
