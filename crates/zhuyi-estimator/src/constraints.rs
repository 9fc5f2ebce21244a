//! The two constraints at t_n (reading R5).
//!
//! ```text
//!  d(t_n)   <= C1 s(t_n)               Eq. 1: be behind the actor
//!  v_e(t_n) <= C2 max(0, v_a(t_n))     Eq. 2: be slower than it
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | d, v_e | distance covered by the ego since t_0, its speed | m, m/s |
//! | s | gap: the ego's front bumper at t_0 to the actor's rear bumper at t_n | m |
//! | v_a | speed of the actor along the ego's path | m/s |
//!
//! Each holds within [`TOLERANCE`]: without it the jumps of Eq. 3 end one rounding error short of the line they aim
//! at.

/// [m, m/s] how far a constraint may be missed.
pub const TOLERANCE: f64 = 1e-9;

/// [m] what is left of Eq. 1: C1 s - d. Met when at least minus [`TOLERANCE`].
///
/// C1 = 0.9 and a gap of 50 m leave 5 m to an ego that went 40 m:
/// ```
/// use zhuyi_estimator::constraints::distance_slack;
/// assert!((distance_slack(0.9, 50.0, 40.0) - 5.0).abs() < 1e-12);
/// ```
pub fn distance_slack(c1: f64, gap: f64, distance: f64) -> f64 {
    c1 * gap - distance
}

/// [m/s] what is left of Eq. 2: C2 max(0, v_a) - v_e. Met when at least minus [`TOLERANCE`].
///
/// C2 = 0.9 and an actor at 10 m/s leave 1 m/s to an ego at 8 m/s; one that reverses counts as standing:
/// ```
/// use zhuyi_estimator::constraints::speed_slack;
/// assert!((speed_slack(0.9, 10.0, 8.0) - 1.0).abs() < 1e-12);
/// assert_eq!(speed_slack(0.9, -3.0, 0.0), 0.0);
/// ```
pub fn speed_slack(c2: f64, actor_speed: f64, ego_speed: f64) -> f64 {
    c2 * actor_speed.max(0.0) - ego_speed
}
