//! Planner and prediction.

use super::{ACCEL, read_all};
use crate::conflict::Conflict;
use crate::fields::Fields;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_planner::PlannerParams;
use zhuyi_prediction::{KinematicPredictor, Manoeuvres};
use zhuyi_world::Vehicle;

/// The planner of a vehicle.
pub(super) fn planner(node: &Node, vehicle: Option<&Vehicle>) -> Option<PlannerParams> {
    node.structure("Planner", |fields| {
        let planner = read_all!(PlannerParams {
            time_headway: fields.number("time_headway_s", within(0.0, 10.0)),
            min_gap: fields.number("min_gap_m", above(0.0, 50.0)),
            max_accel: fields.number("max_accel_mps2", ACCEL),
            comfortable_decel: fields.number("comfortable_decel_mps2", ACCEL),
            exponent: fields.number("exponent", within(1.0, 100.0)),
            comfort_decel_limit: fields.number("comfort_decel_limit_mps2", ACCEL),
            brake_above: fields.number("brake_above_mps2", ACCEL),
            release_below: fields.number("release_below_mps2", ACCEL),
            max_decel: fields.number("max_decel_mps2", ACCEL),
            evade_above: fields.number("evade_above_mps2", ACCEL),
            standstill_gap: fields.number("standstill_gap_m", within(0.0, 50.0)),
            anticipation: fields.number("anticipation_s", within(0.0, 10.0)),
            lateral_margin: fields.number("lateral_margin_m", within(0.0, 3.0)),
            evasion_lateral_accel: fields.number("evasion_lateral_accel_mps2", ACCEL),
            safe_decel: fields.number("safe_decel_mps2", ACCEL),
            lateral_gain: fields.number("lateral_gain_per_s2", above(0.0, 100.0)),
            heading_gain: fields.number("heading_gain_per_s", above(0.0, 100.0)),
        })?;
        check_order(
            fields,
            "release_below_mps2",
            planner.release_below,
            "brake_above_mps2",
            planner.brake_above,
        );
        if let Some(vehicle) = vehicle {
            check_order(
                fields,
                "max_decel_mps2",
                planner.max_decel,
                "vehicle.max_decel_mps2",
                vehicle.max_decel,
            );
        }
        Some(planner)
    })
}

/// Checks that a field's value does not exceed another value.
fn check_order(fields: &Fields, name: &'static str, got: f64, bound: &'static str, limit: f64) {
    if got > limit
        && let Some(node) = fields.optional(name)
    {
        node.refuse(Conflict::Exceeds {
            name,
            bound,
            got,
            limit,
        });
    }
}

/// The predictor.
pub(super) fn prediction(node: &Node) -> Option<KinematicPredictor> {
    node.variant(
        "prediction",
        &[
            ("ConstantVelocity", &|_| {
                Some(KinematicPredictor::ConstantVelocity)
            }),
            ("ConstantAcceleration", &|_| {
                Some(KinematicPredictor::ConstantAcceleration)
            }),
            ("LaneChange", &|fields| {
                read_all!(KinematicPredictor::LaneChange {
                    threshold: fields.number("threshold_mps", above(0.0, 10.0))
                })
            }),
            ("Manoeuvres", &|fields| {
                Some(KinematicPredictor::Manoeuvres(read_all!(Manoeuvres {
                    threshold: fields.number("threshold_mps", above(0.0, 10.0)),
                    braking: fields.number("braking", within(0.0, 0.3)),
                    decel: fields.number("decel_mps2", ACCEL),
                    changing: fields.number("changing", within(0.0, 0.3)),
                    lateral_speed: fields.number("lateral_speed_mps", above(0.0, 10.0)),
                })?))
            }),
        ],
    )
}
