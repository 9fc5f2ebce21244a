//! A scenario and a system that pass.

use zhuyi_scenario::{Source, System};

pub const SCENARIO: &str = r#"(
    title: "A lead ahead",
    road: (lanes: 3, lane_width_m: 3.5, segments: [Line(length_m: 1000)]),
    ego: (lane: 2, s_m: 100, speed_mps: 20),
    duration_s: 30,
    actors: [
        (name: "lead", lane: 2, start: Ahead(gap_m: 30), speed_mps: 15),
        (
            name: "cutter",
            lane: 1,
            start: Beside(offset_m: 20),
            speed_mps: 10,
            manoeuvres: [(when: Time(at_s: 5), then: ChangeLane(lane: 2, duration_s: 3))],
        ),
    ],
)
"#;

pub const SYSTEM: &str = r#"(
    vehicle: (
        length_m: 4.8, width_m: 1.9, mass_kg: 1800, wheelbase_m: 2.8,
        accel_lag_s: 0.1, max_jerk_mps3: 50, max_accel_mps2: 3, max_decel_mps2: 9, friction: 0.9,
        steering_lag_s: 0.1, max_steering_deg: 35, max_steering_rate_degps: 40,
    ),
    perception: (
        cameras: [
            (name: "front", forward_m: 1.8, fov_deg: 120, range_m: 150, analysed: true),
            (name: "rear", forward_m: -2.3, yaw_deg: 180, fov_deg: 100, range_m: 100),
        ],
        confirm_frames: 5, lost_frames: 5, visible_share: 0.5,
        noise_along_m: 0.1, noise_across_m: 0.05, noise_speed_mps: 0.05, miss_rate: 0,
        jerk_density_along_m2ps5: 10, jerk_density_across_m2ps5: 1, noise_heading_rad: 0.01,
    ),
    prediction: ConstantVelocity,
    planner: (
        time_headway_s: 1, min_gap_m: 3, max_accel_mps2: 1.6, comfortable_decel_mps2: 3, exponent: 4,
        comfort_decel_limit_mps2: 1, brake_above_mps2: 4, release_below_mps2: 1, max_decel_mps2: 5,
        evade_above_mps2: 6, standstill_gap_m: 1, anticipation_s: 0.4, lateral_margin_m: 0.2,
        evasion_lateral_accel_mps2: 5, safe_decel_mps2: 4, lateral_gain_per_s2: 1, heading_gain_per_s: 1.5,
    ),
    estimator: (),
    jitter: (position_m: 0.5, speed_mps: 0.2),
)
"#;

/// The system above.
pub fn system() -> System {
    System::read(&Source::new("system.ron", SYSTEM), &[]).unwrap()
}
