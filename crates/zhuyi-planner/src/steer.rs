//! Steering: the curvature that follows a lateral path.
//!
//! ```text
//!  a_d = d'' + k_v (d' - d_e') + k_p (d - d_e)       c = κ / (1 - κ d_e) + a_d / v^2
//! ```
//!
//! Feedforward of the path and of the road's curvature κ, proportional and derivative feedback on the offset; below
//! 3 m/s the division is held, so that a car that comes to a stop does not turn its wheels.

use zhuyi_core::{Body, Lateral, Road};

/// [1/m] the curvature that brings `ego` onto `path`.
pub(crate) fn curvature(
    ego: &Body,
    road: &Road,
    path: Lateral,
    lateral_gain: f64,
    heading_gain: f64,
) -> f64 {
    let accel =
        path.accel + heading_gain * (path.rate - ego.d_rate) + lateral_gain * (path.d - ego.road.d);
    let along = road.curvature(ego.road.s);
    along / (1.0 - along * ego.road.d) + accel / ego.speed.max(3.0).powi(2)
}
