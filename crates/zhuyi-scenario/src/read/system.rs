//! A system as a whole.

use super::compute::compute;
use super::estimator::estimator;
use super::online::online;
use super::planner::{planner, prediction};
use super::read_all;
use super::rig::perception;
use super::vehicle::vehicle;
use crate::limits::within;
use crate::model::{Jitter, System};
use crate::node::Node;
use zhuyi_core::FrameRates;

/// The system that stands at `root`.
pub(crate) fn system(root: &Node) -> Option<System> {
    root.structure("System", |fields| {
        let vehicle = fields.required("vehicle").and_then(|node| vehicle(&node));
        let rig = fields
            .required("perception")
            .and_then(|node| perception(&node, vehicle.as_ref()));
        let predictor = fields
            .required("prediction")
            .and_then(|node| prediction(&node));
        let planner = fields
            .required("planner")
            .and_then(|node| planner(&node, vehicle.as_ref()));
        let estimator = fields
            .required("estimator")
            .and_then(|node| estimator(&node));
        let (compute, online) = (compute(fields), online(fields));
        let jitter = fields.required("jitter").and_then(|node| jitter(&node));
        let (rig, estimator) = (rig?, estimator?);
        Some(System {
            vehicle: vehicle?,
            perception: rig.perception,
            default_rates: FrameRates::new(rig.rates),
            predictor: predictor?,
            planner: planner?,
            estimator: estimator.params,
            current_latency: estimator.current_latency,
            compute: compute?,
            online: online?,
            jitter: jitter?,
        })
    })
}

fn jitter(node: &Node) -> Option<Jitter> {
    node.structure("Jitter", |fields| {
        read_all!(Jitter {
            position: fields.number("position_m", within(0.0, 10.0)),
            speed: fields.number("speed_mps", within(0.0, 10.0)),
        })
    })
}
