//! Responsibility-Sensitive Safety: the largest response time at which the distance to the actor is still a safe one.
//!
//! A situation is dangerous only if the longitudinal and the lateral distance are both unsafe, so the answer is the
//! larger of the answers of the two axes, each in closed form:
//!
//! ```text
//!   t_r = max(rho_long, rho_lat),   d_long(rho_long) = gap,   d_lat(rho_lat) = edge_gap
//! ```
//!
//! [`longitudinal`] and [`lateral`] hold the two distances and what solves them for rho. Only the ego is late: in the
//! lateral distance the other's response time stays what it is assumed to be.
//!
//! Source: Shalev-Shwartz, Shammah, Shashua, "On a Formal Model of Safe and Scalable Self-driving Cars" (2017,
//! arXiv 1708.06374): safe longitudinal distance (same and opposite directions), safe lateral distance, dangerous situation; the
//! cap on the speed is that of Intel's ad-rss-lib. An actor that comes towards the ego is taken for the one in the wrong lane.
//! One that crosses the path ([`Direction`]) is not defined: the source judges it by the geometry of two routes and the right
//! of way. Left out: intersections, occlusion, unstructured roads. An actor behind the ego is no danger: to keep that distance
//! is its own duty.

pub mod lateral;
pub mod longitudinal;

use super::{Approach, Direction, at_start};
use zhuyi_core::Footprint;
use zhuyi_estimator::{Ego, Future, Reaction, SafetyModel};

/// The parameters of RSS, and RSS as a model.
///
/// The default is the set with which the Joint Research Centre of the European Commission runs RSS as a performance
/// model for UN R157, because the cut-ins it is checked against come with that set. The paper leaves all numbers
/// open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rss {
    /// [s] rho of the other (0.75); the ego's is what is asked for.
    pub response: f64,
    /// [m/s2] largest acceleration while responding (3).
    pub accel: f64,
    /// [m/s2] least braking of the one behind (6).
    pub least_brake: f64,
    /// [m/s2] hardest braking of the one ahead (6).
    pub most_brake: f64,
    /// [m/s2] least braking of an ego in its correct lane before one that comes towards it (3, ad-rss-lib's, as the set below
    /// has none).
    pub correct_brake: f64,
    /// [m/s2] largest lateral acceleration while responding (1).
    pub lateral_accel: f64,
    /// [m/s2] least lateral braking (1).
    pub lateral_brake: f64,
    /// [m] lateral margin, mu (0.3).
    pub lateral_margin: f64,
    /// [m/s] speed up to which the ego may accelerate while it responds; none in the paper's form.
    pub speed_cap: Option<f64>,
}

impl Default for Rss {
    fn default() -> Self {
        Self {
            response: 0.75,
            accel: 3.0,
            least_brake: 6.0,
            most_brake: 6.0,
            correct_brake: 3.0,
            lateral_accel: 1.0,
            lateral_brake: 1.0,
            lateral_margin: 0.3,
            speed_cap: None,
        }
    }
}

impl Rss {
    /// The library's form. Its cap is the 50 km/h of the library's own tests: a faster ego holds its speed while it
    /// responds, a slower one may accelerate up to it.
    pub fn capped() -> Self {
        Self {
            speed_cap: Some(50.0 / 3.6),
            ..Self::default()
        }
    }
}

impl SafetyModel for Rss {
    fn name(&self) -> &'static str {
        if self.speed_cap.is_some() {
            "rss-capped"
        } else {
            "rss"
        }
    }

    fn reaction(&self, ego: &Ego, actor: Footprint, future: &Future<'_>) -> Reaction {
        at_start(future, |start| {
            let approach = Approach::new(ego, future.box_at(actor, 0.0), start);
            if approach.behind {
                return None;
            }
            let (gap, speed) = (approach.gap, ego.speed.max(0.0));
            let along = match Direction::of(start) {
                Direction::Crossing => return Some(Reaction::NotDefined),
                Direction::Opposite => self.opposite_response(gap, speed, -start.speed),
                Direction::Same | Direction::Standing => {
                    self.longitudinal_response(gap, speed, start.speed.max(0.0))
                }
            };
            // The ego keeps its offset, so its own lateral speed is zero.
            let across = self.lateral_response(approach.edge_gap, 0.0, approach.inward_speed);
            Some(laxer(along, across))
        })
    }
}

/// The answer of the axis that leaves more time.
fn laxer(one: Reaction, other: Reaction) -> Reaction {
    match (one, other) {
        (Reaction::NotDefined, _) | (_, Reaction::NotDefined) => Reaction::NotDefined,
        (Reaction::NoDanger, _) | (_, Reaction::NoDanger) => Reaction::NoDanger,
        (Reaction::TooLate, answer) | (answer, Reaction::TooLate) => answer,
        (Reaction::Within(one), Reaction::Within(other)) => Reaction::Within(one.max(other)),
    }
}
