//! The lateral safe distance of RSS, and its solution for the ego's response time.
//!
//! Both may accelerate towards each other while they respond, then each brakes its motion towards the other:
//!
//! ```text
//!   x(v, rho) = v rho + a rho^2/2 + ([v + a rho]+)^2/(2 b)           how far one comes towards the other
//!   d(rho)    = [ mu + x(v_e, rho) + x(v_o, rho_o) ]+
//! ```
//!
//! With `C = edge_gap - mu - x(v_o, rho_o)`, the ego's answer is the larger root of `x(v_e, rho) = C`. It lies on the
//! branch v_e + a rho >= 0, on which x is a quadratic; counted from the branch's beginning `rho_1 = [-v_e/a]+` it is
//! solved as the longitudinal one is.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | rho, rho_o | response times of the ego and the other | s |
//! | v_e, v_o | lateral speeds, positive towards each other | m/s |
//! | a, b | largest lateral acceleration, least lateral braking | m/s2 |
//! | mu | margin | m |
//!
//! Source: arXiv 1708.06374, safe lateral distance. Its formula is written for motion towards each other. One that still moves
//! away after its response is taken where it is then, and the margin is inside the bracket: the printed examples of
//! ad-rss-lib are met with these two readings and not without them. Left out: the definition of lateral speed in
//! curves.

use super::{Rss, longitudinal::largest_response};
use zhuyi_estimator::Reaction;

impl Rss {
    /// [m] x(v, rho), how far one comes towards the other.
    ///
    /// v = 1, rho = 2, a = 1, b = 1: 2 + 2 + 3^2/2 = 8.5 m. At v = -3 it has turned to -1 by then: -6 + 2 = -4 m.
    /// ```
    /// use zhuyi_metrics::safety_models::Rss;
    /// assert_eq!(Rss::default().lateral_advance(2.0, 1.0), 8.5);
    /// assert_eq!(Rss::default().lateral_advance(2.0, -3.0), -4.0);
    /// ```
    pub fn lateral_advance(&self, response: f64, speed: f64) -> f64 {
        let reached = speed + self.lateral_accel * response;
        let braked = reached.max(0.0);
        response * f64::midpoint(speed, reached) + braked * braked / (2.0 * self.lateral_brake)
    }

    /// [m] d(rho), the safe lateral distance for these speeds towards each other.
    ///
    /// Default parameters, nobody moves sideways, rho = 1, the other's 0.75: 0.3 + 1 + 0.5625 = 1.8625 m.
    /// ```
    /// use zhuyi_metrics::safety_models::Rss;
    /// assert_eq!(Rss::default().lateral_distance(1.0, 0.0, 0.0), 1.8625);
    /// ```
    pub fn lateral_distance(&self, response: f64, ego: f64, other: f64) -> f64 {
        let advances =
            self.lateral_advance(response, ego) + self.lateral_advance(self.response, other);
        (self.lateral_margin + advances).max(0.0)
    }

    /// The largest response time of the ego for which `edge_gap` is a safe distance; none is where bodies overlap
    /// sideways, any is where nothing moves or may accelerate towards the other.
    ///
    /// ```
    /// use zhuyi_estimator::Reaction;
    /// use zhuyi_metrics::safety_models::Rss;
    /// assert_eq!(Rss::default().lateral_response(1.8625, 0.0, 0.0), Reaction::Within(1.0));
    /// assert_eq!(Rss::default().lateral_response(0.8, 0.0, 0.0), Reaction::TooLate);
    /// ```
    pub fn lateral_response(&self, edge_gap: f64, ego: f64, other: f64) -> Reaction {
        let (a, b) = (self.lateral_accel, self.lateral_brake);
        if edge_gap < 0.0 {
            return Reaction::TooLate;
        }
        let room = edge_gap - self.lateral_margin - self.lateral_advance(self.response, other);
        if ego >= 0.0 {
            return largest_response(room - ego * ego / (2.0 * b), ego, a, b);
        }
        if a <= 0.0 {
            // It moves away for ever: late enough any distance becomes safe.
            return Reaction::NoDanger;
        }
        // At `turn` it has stopped moving away, ego^2/(2 a) further off.
        let turn = -ego / a;
        match largest_response(room + ego * ego / (2.0 * a), 0.0, a, b) {
            Reaction::Within(rest) => Reaction::Within(turn + rest),
            other => other,
        }
    }
}
