//! The estimate in the loop, and what follows from it. A block or field that is left out has the values below.

use super::compute::response;
use super::planner::prediction;
use super::read_all;
use super::rig::latency;
use crate::fields::Fields;
use crate::limits::within;
use crate::model::Online;
use zhuyi_core::SimTime;
use zhuyi_prediction::{KinematicPredictor, Manoeuvres};
use zhuyi_scheduler::safety::Response;

/// What is taken where the file says nothing: others go on, brake by 6 m/s2 in two of a hundred cases, and change to
/// either side in four of a thousand, which the percentile 99 forgives; l_0 of a system that starts from nothing
/// (reading R22). Alarms are recorded and change nothing.
const USUAL: Online = Online {
    predictor: KinematicPredictor::Manoeuvres(Manoeuvres {
        threshold: 0.3,
        braking: 0.02,
        decel: 6.0,
        changing: 0.004,
        lateral_speed: 1.0,
    }),
    current_latency: Some(1.0 / 30.0),
    period: SimTime::from_millis(100),
    phantom_headway: 0.0,
    response: Response::None,
    hold: 1.0,
};

/// The block, if it is there.
pub(super) fn online(fields: &Fields) -> Option<Online> {
    fields.block("online")?.structure("Online", |fields| {
        read_all!(Online {
            predictor: fields
                .optional("prediction")
                .map_or(Some(USUAL.predictor), |node| prediction(&node)),
            current_latency: fields.optional("current_latency").map_or(
                Some(USUAL.current_latency),
                |node| latency("current_latency", &node)
            ),
            period: fields
                .number_or("every_ms", within(10.0, 10_000.0), 100.0)
                .map(|ms| SimTime::from_seconds(ms / 1e3)),
            phantom_headway: fields.number_or(
                "phantom_headway_s",
                within(0.0, 10.0),
                USUAL.phantom_headway
            ),
            response: fields
                .optional("response")
                .map_or(Some(USUAL.response), |node| response(&node)),
            hold: fields.number_or("hold_s", within(0.0, 60.0), USUAL.hold),
        })
    })
}
