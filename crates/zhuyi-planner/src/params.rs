//! The planner's parameters.

use zhuyi_core::idm::Idm;

/// One set for every scenario; the desired speed alone is the scenario's.
#[derive(Clone, Debug, PartialEq)]
pub struct Planner {
    /// [s] T of the car-following model.
    pub time_headway: f64,
    /// [m] s0 of the car-following model.
    pub min_gap: f64,
    /// [m/s2] a of the car-following model.
    pub max_accel: f64,
    /// [m/s2] b of the car-following model.
    pub comfortable_decel: f64,
    /// [-] δ of the car-following model.
    pub exponent: f64,
    /// [m/s2] hardest braking of the car-following model.
    pub comfort_decel_limit: f64,
    /// [m/s2] required deceleration at which hard braking begins.
    pub brake_above: f64,
    /// [m/s2] required deceleration at which hard braking ends.
    pub release_below: f64,
    /// [m/s2] hardest braking asked for.
    pub max_decel: f64,
    /// [m/s2] deceleration that would just avoid a contact, above which a lane change is begun instead.
    pub evade_above: f64,
    /// [m] gap that hard braking aims to keep at its end.
    pub standstill_gap: f64,
    /// [s] how far ahead a forecast is looked at for the actor's entry into the ego's corridor.
    pub anticipation: f64,
    /// [m] lateral clearance below which an actor is in the ego's corridor.
    pub lateral_margin: f64,
    /// [m/s2] lateral acceleration of an evasive lane change.
    pub evasion_lateral_accel: f64,
    /// [m/s2] b_safe of MOBIL: hardest braking imposed on the follower in the new lane.
    pub safe_decel: f64,
    /// [1/s2] lateral feedback on the offset from the wanted path.
    pub lateral_gain: f64,
    /// [1/s] lateral feedback on the lateral speed.
    pub heading_gain: f64,
}

impl Planner {
    /// The car-following model of a driver who wants `desired_speed` [m/s].
    pub fn driver(&self, desired_speed: f64) -> Idm {
        Idm {
            desired_speed,
            time_headway: self.time_headway,
            min_gap: self.min_gap,
            max_accel: self.max_accel,
            comfortable_decel: self.comfortable_decel,
            exponent: self.exponent,
        }
    }
}
