//! A system as its file.

use super::{degrees, number_for, value::Value};
use crate::model::{Jitter, Online, System};
use Value::{List, Number, Struct, Text, Truth, Variant, Whole};
use zhuyi_estimator::{Aggregation, Criterion, Evasion, Grid, Solver, Uncertainty};
use zhuyi_perception::Eye;
use zhuyi_planner::PlannerParams;
use zhuyi_prediction::KinematicPredictor;
use zhuyi_scheduler::safety::Response;
use zhuyi_scheduler::{Chip, Compute};
use zhuyi_world::Vehicle;

pub(super) fn system(system: &System) -> Value {
    let Jitter { position, speed } = system.jitter;
    Struct(vec![
        ("vehicle", vehicle(&system.vehicle)),
        ("perception", perception(system)),
        ("prediction", prediction(system.predictor)),
        ("planner", planner(&system.planner)),
        ("estimator", estimator(system)),
        ("compute", compute(&system.compute)),
        ("online", online(&system.online)),
        (
            "jitter",
            Struct(vec![
                ("position_m", Number(position)),
                ("speed_mps", Number(speed)),
            ]),
        ),
    ])
}

fn vehicle(vehicle: &Vehicle) -> Value {
    Struct(vec![
        ("length_m", Number(vehicle.footprint.length)),
        ("width_m", Number(vehicle.footprint.width)),
        ("mass_kg", Number(vehicle.mass)),
        ("wheelbase_m", Number(vehicle.wheelbase)),
        ("accel_lag_s", Number(vehicle.accel_lag)),
        ("max_jerk_mps3", Number(vehicle.max_jerk)),
        ("max_accel_mps2", Number(vehicle.max_accel)),
        ("max_decel_mps2", Number(vehicle.max_decel)),
        ("friction", Number(vehicle.friction)),
        ("steering_lag_s", Number(vehicle.steering_lag)),
        ("max_steering_deg", degrees(vehicle.max_steering)),
        (
            "max_steering_rate_degps",
            degrees(vehicle.max_steering_rate),
        ),
    ])
}

fn perception(system: &System) -> Value {
    let (perception, errors) = (&system.perception, &system.perception.errors);
    let cameras = perception
        .eyes
        .iter()
        .zip(system.default_rates.all())
        .map(|(eye, rate)| camera(eye, *rate));
    // Each camera tells its own below; this one would be for those that do not.
    let confirm_frames = perception
        .eyes
        .first()
        .map(|eye| ("confirm_frames", Whole(eye.confirm_frames)));
    let shared = [
        ("phase_shift", Number(perception.phase_shift)),
        ("visible_share", Number(perception.visible_share)),
        ("noise_along_m", Number(errors.noise_along)),
        ("noise_across_m", Number(errors.noise_across)),
        ("noise_speed_mps", Number(errors.noise_speed)),
        ("noise_heading_rad", Number(errors.noise_heading)),
        ("miss_rate", Number(errors.miss_rate)),
        ("latency_jitter_ms", milliseconds(errors.latency_jitter)),
        ("drop_rate", Number(errors.drop_rate)),
        ("lost_frames", Whole(perception.lost_frames)),
        (
            "jerk_density_along_m2ps5",
            Number(perception.jerk_density_along),
        ),
        (
            "jerk_density_across_m2ps5",
            Number(perception.jerk_density_across),
        ),
    ];
    Struct(
        [("cameras", List(cameras.collect()))]
            .into_iter()
            .chain(confirm_frames)
            .chain(shared)
            .collect(),
    )
}

fn camera(
    Eye {
        camera,
        latency,
        confirm_frames,
        phase,
        own,
    }: &Eye,
    rate: f64,
) -> Value {
    let mut fields = vec![
        ("name", Text(camera.name.clone())),
        ("forward_m", Number(camera.forward)),
        ("left_m", Number(camera.left)),
        ("yaw_deg", degrees(camera.yaw)),
        ("fov_deg", degrees(camera.fov)),
        ("range_m", Number(camera.range)),
        ("rate_hz", Number(rate)),
        ("latency", frame_latency(*latency)),
        ("confirm_frames", Whole(*confirm_frames)),
        ("analysed", Truth(camera.analysed)),
    ];
    // There is no word for a phase that is drawn.
    fields.extend(phase.map(|share| ("phase_share", Number(share))));
    let own = [
        ("noise_along_m", own.noise_along.map(Number)),
        ("noise_across_m", own.noise_across.map(Number)),
        ("noise_speed_mps", own.noise_speed.map(Number)),
        ("noise_heading_rad", own.noise_heading.map(Number)),
        ("miss_rate", own.miss_rate.map(Number)),
        ("latency_jitter_ms", own.latency_jitter.map(milliseconds)),
        ("drop_rate", own.drop_rate.map(Number)),
    ];
    fields.extend(
        own.into_iter()
            .filter_map(|(name, value)| Some((name, value?))),
    );
    Struct(fields)
}

/// A latency [s] of its own, or the frame period.
fn frame_latency(latency: Option<f64>) -> Value {
    latency.map_or(Variant("FramePeriod", Vec::new()), |latency| {
        Variant("Fixed", vec![("latency_ms", milliseconds(latency))])
    })
}

/// Seconds in milliseconds.
fn milliseconds(seconds: f64) -> Value {
    number_for(seconds, seconds * 1e3, |ms| ms / 1e3)
}

fn prediction(predictor: KinematicPredictor) -> Value {
    match predictor {
        KinematicPredictor::ConstantVelocity => Variant("ConstantVelocity", Vec::new()),
        KinematicPredictor::ConstantAcceleration => Variant("ConstantAcceleration", Vec::new()),
        KinematicPredictor::LaneChange { threshold } => {
            Variant("LaneChange", vec![("threshold_mps", Number(threshold))])
        }
        KinematicPredictor::Manoeuvres(manoeuvres) => Variant(
            "Manoeuvres",
            vec![
                ("threshold_mps", Number(manoeuvres.threshold)),
                ("braking", Number(manoeuvres.braking)),
                ("decel_mps2", Number(manoeuvres.decel)),
                ("changing", Number(manoeuvres.changing)),
                ("lateral_speed_mps", Number(manoeuvres.lateral_speed)),
            ],
        ),
    }
}

fn planner(planner: &PlannerParams) -> Value {
    Struct(vec![
        ("time_headway_s", Number(planner.time_headway)),
        ("min_gap_m", Number(planner.min_gap)),
        ("max_accel_mps2", Number(planner.max_accel)),
        ("comfortable_decel_mps2", Number(planner.comfortable_decel)),
        ("exponent", Number(planner.exponent)),
        (
            "comfort_decel_limit_mps2",
            Number(planner.comfort_decel_limit),
        ),
        ("brake_above_mps2", Number(planner.brake_above)),
        ("release_below_mps2", Number(planner.release_below)),
        ("max_decel_mps2", Number(planner.max_decel)),
        ("evade_above_mps2", Number(planner.evade_above)),
        ("standstill_gap_m", Number(planner.standstill_gap)),
        ("anticipation_s", Number(planner.anticipation)),
        ("lateral_margin_m", Number(planner.lateral_margin)),
        (
            "evasion_lateral_accel_mps2",
            Number(planner.evasion_lateral_accel),
        ),
        ("safe_decel_mps2", Number(planner.safe_decel)),
        ("lateral_gain_per_s2", Number(planner.lateral_gain)),
        ("heading_gain_per_s", Number(planner.heading_gain)),
    ])
}

fn estimator(system: &System) -> Value {
    let params = &system.estimator;
    let name = |name| Variant(name, Vec::new());
    let paper = vec![
        ("c1", Number(params.c1)),
        ("c2", Number(params.c2)),
        ("c3_mps2", Number(params.c3)),
        ("c4", Number(params.c4)),
        ("confirm_frames", Whole(params.confirm_frames)),
        ("max_steps", Whole(params.max_steps)),
        ("horizon_s", Number(params.horizon)),
        ("lateral_margin_m", Number(params.lateral_margin)),
        (
            "grid",
            name(match params.grid {
                Grid::Ms33 => "Ms33",
                Grid::Thirtieths => "Thirtieths",
                Grid::Fps => "Fps",
            }),
        ),
        (
            "solver",
            name(match params.solver {
                Solver::Exact => "Exact",
                Solver::Paper => "Paper",
            }),
        ),
        (
            "criterion",
            name(match params.criterion {
                Criterion::Paper => "Paper",
                Criterion::Standstill => "Standstill",
            }),
        ),
        (
            "aggregation",
            match params.aggregation {
                Aggregation::Percentile(share) => {
                    Variant("Percentile", vec![("share", Number(share))])
                }
                Aggregation::Worst => name("Worst"),
                Aggregation::Mean => name("Mean"),
            },
        ),
        ("cautious", Truth(params.cautious)),
        ("current_latency", frame_latency(system.current_latency)),
    ];
    // What goes beyond the paper is not spoken of where it is off.
    let uncertainty = params
        .uncertainty
        .map(|on| ("uncertainty", uncertainty(&on)));
    let evasion = params.evasion.map(|on| ("evasion", evasion(on)));
    Struct(
        paper
            .into_iter()
            .chain(uncertainty)
            .chain(evasion)
            .collect(),
    )
}

fn evasion(on: Evasion) -> Value {
    Variant(
        "LaneChange",
        vec![
            ("lateral_accel_mps2", Number(on.lateral_accel)),
            ("window_s", Number(on.window)),
        ],
    )
}

fn compute(compute: &Compute) -> Value {
    match compute {
        Compute::Ideal => Variant("Ideal", Vec::new()),
        Compute::Accelerator(Chip {
            tops,
            gop_per_frame,
            frame_bytes,
            discipline: _,
            drop_stale,
        }) => Variant(
            "Accelerator",
            vec![
                ("tops", Number(*tops)),
                ("gop_per_frame", Number(*gop_per_frame)),
                ("frame_bytes", Number(*frame_bytes as f64)),
                ("drop_stale", Truth(*drop_stale)),
            ],
        ),
    }
}

fn online(online: &Online) -> Value {
    let name = |name| Variant(name, Vec::new());
    let response = match online.response {
        Response::None => name("Record"),
        Response::EmergencyBackup => name("EmergencyBackup"),
        Response::LimitedFunctionality {
            freed_share,
            lower_speed,
            longer_headway,
        } => Variant(
            "LimitedFunctionality",
            vec![
                ("freed_share", Number(freed_share)),
                ("lower_speed_mps", Number(lower_speed)),
                ("longer_headway_s", Number(longer_headway)),
            ],
        ),
        Response::RaiseRates => name("RaiseRates"),
    };
    Struct(vec![
        ("prediction", prediction(online.predictor)),
        ("current_latency", frame_latency(online.current_latency)),
        ("every_ms", Number(online.period.nanos() as f64 / 1e6)),
        ("phantom_headway_s", Number(online.phantom_headway)),
        ("response", response),
        ("hold_s", Number(online.hold)),
    ])
}

/// Files know deviations alone: covariances between them are not written.
fn uncertainty(on: &Uncertainty) -> Value {
    let deviation = |variance: f64| number_for(variance, variance.sqrt(), |root| root * root);
    Variant(
        "Track",
        vec![
            ("sigmas", Number(on.sigmas)),
            ("position_m", deviation(on.covariance.ss)),
            ("speed_mps", deviation(on.covariance.vv)),
            ("accel_mps2", deviation(on.covariance.aa)),
            ("jerk_density_m2ps5", Number(on.jerk_density)),
        ],
    )
}
