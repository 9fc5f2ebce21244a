//! The ego's body, actuators and tyres.

use super::{ACCEL, read_all};
use crate::conflict::Conflict;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_core::Footprint;
use zhuyi_world::Vehicle;

/// The vehicle.
pub(super) fn vehicle(node: &Node) -> Option<Vehicle> {
    node.structure("Vehicle", |fields| {
        let footprint = read_all!(Footprint {
            length: fields.number("length_m", within(1.0, 30.0)),
            width: fields.number("width_m", within(0.5, 4.0)),
        });
        let wheelbase_node = fields.required("wheelbase_m");
        let wheelbase = wheelbase_node
            .as_ref()
            .and_then(|node| node.number(within(0.5, 20.0)));
        if let (Some(node), Some(got), Some(footprint)) = (wheelbase_node, wheelbase, footprint)
            && got > footprint.length
        {
            let limit = footprint.length;
            node.refuse(Conflict::Exceeds {
                name: "wheelbase_m",
                bound: "length_m",
                got,
                limit,
            });
        }
        read_all!(Vehicle {
            footprint,
            mass: fields.number("mass_kg", within(50.0, 100_000.0)),
            wheelbase,
            accel_lag: fields.number("accel_lag_s", within(0.0, 5.0)),
            max_jerk: fields.number("max_jerk_mps3", above(0.0, 1_000.0)),
            max_accel: fields.number("max_accel_mps2", ACCEL),
            max_decel: fields.number("max_decel_mps2", ACCEL),
            friction: fields.number("friction", above(0.0, 2.0)),
            steering_lag: fields.number("steering_lag_s", within(0.0, 5.0)),
            max_steering: fields.angle("max_steering_deg", within(1.0, 80.0)),
            max_steering_rate: fields.angle("max_steering_rate_degps", within(1.0, 1_000.0)),
        })
    })
}
