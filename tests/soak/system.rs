//! Random settings of the system, from all that its file may hold.

use crate::draw::Draw;

/// A number of the system: its path, what is usual, and what is allowed.
type Number = (&'static str, (f64, f64), (f64, f64));

/// Shares that something must have.
const SOME: (f64, f64) = (0.001, 1.0);
/// [m/s2] that something must have.
const ACCEL: (f64, f64) = (0.001, 20.0);

/// The numbers.
const NUMBERS: [Number; 50] = [
    ("perception.visible_share", (0.1, 0.9), (0.0, 1.0)),
    ("perception.noise_along_m", (0.0, 1.0), (0.0, 10.0)),
    ("perception.noise_across_m", (0.0, 0.5), (0.0, 10.0)),
    ("perception.noise_speed_mps", (0.0, 1.0), (0.0, 10.0)),
    ("perception.noise_heading_rad", (0.0, 0.1), (0.0, 1.0)),
    ("perception.miss_rate", (0.0, 0.3), (0.0, 1.0)),
    ("perception.phase_share", (0.0, 1.0), (0.0, 1.0)),
    (
        "perception.jerk_density_along_m2ps5",
        (0.5, 20.0),
        (0.001, 10_000.0),
    ),
    (
        "perception.jerk_density_across_m2ps5",
        (0.1, 10.0),
        (0.001, 10_000.0),
    ),
    (
        "perception.cameras.front_120.fov_deg",
        (60.0, 180.0),
        (1.0, 360.0),
    ),
    (
        "perception.cameras.front_120.range_m",
        (40.0, 250.0),
        (0.1, 500.0),
    ),
    (
        "perception.cameras.front_120.phase_share",
        (0.0, 1.0),
        (0.0, 1.0),
    ),
    (
        "perception.cameras.left.yaw_deg",
        (45.0, 135.0),
        (-180.0, 180.0),
    ),
    (
        "perception.cameras.right.range_m",
        (20.0, 150.0),
        (0.1, 500.0),
    ),
    (
        "perception.cameras.front_60.fov_deg",
        (30.0, 90.0),
        (1.0, 360.0),
    ),
    ("perception.cameras.rear.left_m", (-0.5, 0.5), (-0.95, 0.95)),
    ("planner.time_headway_s", (0.5, 2.5), (0.0, 10.0)),
    ("planner.min_gap_m", (1.0, 6.0), (0.001, 50.0)),
    ("planner.max_accel_mps2", (0.5, 3.0), ACCEL),
    ("planner.comfortable_decel_mps2", (1.0, 5.0), ACCEL),
    ("planner.exponent", (2.0, 6.0), (1.0, 100.0)),
    ("planner.comfort_decel_limit_mps2", (0.5, 3.0), ACCEL),
    ("planner.brake_above_mps2", (2.0, 6.0), ACCEL),
    ("planner.release_below_mps2", (0.5, 2.0), ACCEL),
    ("planner.max_decel_mps2", (3.0, 9.0), (0.001, 9.0)),
    ("planner.evade_above_mps2", (3.0, 9.0), ACCEL),
    ("planner.standstill_gap_m", (1.0, 5.0), (0.0, 50.0)),
    ("planner.anticipation_s", (0.0, 1.0), (0.0, 10.0)),
    ("planner.lateral_margin_m", (0.0, 0.6), (0.0, 3.0)),
    ("planner.evasion_lateral_accel_mps2", (2.0, 7.0), ACCEL),
    ("planner.safe_decel_mps2", (2.0, 6.0), ACCEL),
    ("planner.lateral_gain_per_s2", (0.3, 3.0), (0.001, 100.0)),
    ("planner.heading_gain_per_s", (0.5, 4.0), (0.001, 100.0)),
    ("vehicle.accel_lag_s", (0.0, 0.5), (0.0, 5.0)),
    ("vehicle.max_jerk_mps3", (5.0, 100.0), (0.001, 1_000.0)),
    ("vehicle.max_accel_mps2", (1.0, 5.0), ACCEL),
    ("vehicle.max_decel_mps2", (5.0, 10.0), (4.75, 20.0)),
    ("vehicle.friction", (0.3, 1.2), (0.001, 2.0)),
    ("vehicle.steering_lag_s", (0.0, 0.4), (0.0, 5.0)),
    ("vehicle.max_steering_deg", (20.0, 50.0), (1.0, 80.0)),
    (
        "vehicle.max_steering_rate_degps",
        (10.0, 100.0),
        (1.0, 1_000.0),
    ),
    ("estimator.c1", (0.5, 1.0), SOME),
    ("estimator.c2", (0.5, 1.0), SOME),
    ("estimator.c3_mps2", (2.0, 8.0), ACCEL),
    ("estimator.c4", (0.8, 1.5), (0.001, 10.0)),
    ("estimator.horizon_s", (5.0, 30.0), (1.0, 100.0)),
    ("estimator.lateral_margin_m", (0.0, 0.6), (0.0, 3.0)),
    ("online.every_ms", (50.0, 300.0), (10.0, 10_000.0)),
    ("jitter.position_m", (0.0, 1.0), (0.0, 10.0)),
    ("jitter.speed_mps", (0.0, 1.0), (0.0, 10.0)),
];

/// Whole numbers, with what is allowed; most of them are small.
const WHOLES: [(&str, u32); 5] = [
    ("perception.confirm_frames", 1_000),
    ("perception.lost_frames", 1_000),
    ("perception.cameras.front_120.confirm_frames", 1_000),
    ("estimator.confirm_frames", 1_000),
    ("estimator.max_steps", 1_000),
];

/// Words.
const WORDS: [(&str, &[&str]); 12] = [
    (
        "perception.cameras.front_120.latency",
        &[
            "FramePeriod",
            "Fixed(latency_ms: 0.1)",
            "Fixed(latency_ms: 250)",
            "Fixed(latency_ms: 10000)",
        ],
    ),
    (
        "prediction",
        &[
            "ConstantVelocity",
            "ConstantAcceleration",
            "LaneChange(threshold_mps: 0.5)",
            "Manoeuvres(threshold_mps: 0.3, braking: 0.1, decel_mps2: 6, changing: 0.1, lateral_speed_mps: 1)",
        ],
    ),
    ("estimator.grid", &["Ms33", "Thirtieths", "Fps"]),
    ("estimator.solver", &["Exact", "Paper"]),
    ("estimator.criterion", &["Paper", "Standstill"]),
    (
        "estimator.aggregation",
        &["Worst", "Mean", "Percentile(share: 0.5)"],
    ),
    ("estimator.cautious", &["true", "false"]),
    (
        "estimator.current_latency",
        &["FramePeriod", "Fixed(latency_ms: 33.33)"],
    ),
    (
        "estimator.uncertainty",
        &[
            "Off",
            "Track(sigmas: 2, position_m: 0.3, speed_mps: 0.3, accel_mps2: 0.5, jerk_density_m2ps5: 1)",
        ],
    ),
    (
        "estimator.evasion",
        &["Off", "LaneChange(lateral_accel_mps2: 4, window_s: 3)"],
    ),
    (
        "compute",
        &[
            "Ideal",
            "Accelerator()",
            "Accelerator(tops: 0.1, drop_stale: false)",
            "Accelerator(tops: 5, drop_stale: true)",
        ],
    ),
    (
        "online.response",
        &[
            "Record",
            "EmergencyBackup",
            "RaiseRates",
            "LimitedFunctionality()",
        ],
    ),
];

/// Some settings, each `path=value`.
pub fn settings(draw: &mut Draw) -> Vec<String> {
    let mut settings: Vec<String> = Vec::new();
    if draw.chance(20) {
        return settings;
    }
    for _ in 0..draw.whole(1, 6) {
        let (path, usual, allowed) = draw.one(&NUMBERS);
        settings.push(format!("{path}={}", draw.number(usual, allowed)));
    }
    for _ in 0..draw.whole(0, 2) {
        let (path, most) = draw.one(&WHOLES);
        settings.push(format!(
            "{path}={}",
            draw.number((1.0, 12.0), (1.0, f64::from(most))) as u32
        ));
    }
    for _ in 0..draw.whole(0, 3) {
        let (path, values) = draw.one(&WORDS);
        settings.push(format!("{path}={}", draw.one(values)));
    }
    // A value may be set once.
    settings.sort_by_key(|setting| setting.split('=').next().map(String::from));
    settings.dedup_by_key(|setting| setting.split('=').next().map(String::from));
    settings
}
