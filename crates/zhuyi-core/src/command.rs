//! What the planner asks of the ego.

/// The planner's wish for the next step; the actuator decides what becomes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// [m/s2] wanted acceleration along the ego's heading.
    pub accel: f64,
    /// [1/m] wanted curvature of the path of the ego's centre, positive to the left.
    pub curvature: f64,
    /// Why, for traces and explanations.
    pub manoeuvre: Manoeuvre,
}

/// What the ego is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Manoeuvre {
    /// Following the lane at the desired speed or behind a leader.
    Follow,
    /// Braking hard.
    Brake,
    /// Changing lane to evade what braking alone cannot.
    Evade,
}
