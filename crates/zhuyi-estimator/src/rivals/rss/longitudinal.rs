//! The longitudinal safe distance of RSS for two vehicles in one direction, and its solution for the response time.
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
//! | symbol | meaning | unit |
//! |---|---|---|
//! | rho | response time of the one behind | s |
//! | v_r, v_f | speeds of the one behind and the one ahead | m/s |
//! | a | largest acceleration while responding | m/s2 |
//! | b_min, b_max | least braking behind, hardest ahead | m/s2 |
//!
//! Source: arXiv 1708.06374, safe longitudinal distance, same direction; the cap: ad-rss-lib, `max_speed_on_acceleration`. Left out:
//! opposite directions.

use super::Rss;
use crate::Reaction;

impl Rss {
    /// [m] distance until standstill for one that accelerates through `response` and then brakes by b_min.
    ///
    /// 20 m/s, 1 s, a = 2, b_min = 4: 20 + 1 + 22^2/8 = 81.5 m.
    /// ```
    /// use zhuyi_estimator::rivals::Rss;
    /// let rss = Rss { accel: 2.0, least_brake: 4.0, ..Rss::default() };
    /// assert_eq!(rss.stopping_distance(1.0, 20.0), 81.5);
    /// // Capped at 20 m/s it holds: 20 + 400/8 = 70 m. Capped at 21 m/s it does so after half a second:
    /// // 20 x 0.5 + 0.25 + 21 x 0.5 + 441/8 = 75.875 m.
    /// assert_eq!(Rss { speed_cap: Some(20.0), ..rss }.stopping_distance(1.0, 20.0), 70.0);
    /// assert_eq!(Rss { speed_cap: Some(21.0), ..rss }.stopping_distance(1.0, 20.0), 75.875);
    /// ```
    pub fn stopping_distance(&self, response: f64, speed: f64) -> f64 {
        let gaining = response.min(self.gaining_time(speed));
        let reached = speed + gaining * self.accel;
        gaining * f64::midpoint(speed, reached)
            + (response - gaining) * reached
            + reached * reached / (2.0 * self.least_brake)
    }

    /// [m] d(rho), the safe distance of an ego at `rear` m/s to an actor ahead at `front` m/s.
    ///
    /// 20 m/s behind 10 m/s, 1 s, a = 2, b_min = 4, b_max = 8: 81.5 - 100/16 = 75.25 m.
    /// ```
    /// use zhuyi_estimator::rivals::Rss;
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
    /// use zhuyi_estimator::rivals::Rss;
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
        let gaining = self.gaining_time(rear);
        if gaining.is_finite() {
            let spare = room - self.stopping_distance(gaining, rear);
            let held = rear + gaining * self.accel;
            if spare > 0.0 && held > 0.0 {
                return Reaction::Within(gaining + spare / held);
            }
        }
        let c = room - rear * rear / (2.0 * self.least_brake);
        largest_response(c, rear, self.accel, self.least_brake)
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
