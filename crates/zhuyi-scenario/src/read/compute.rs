//! How long perception takes, and what an alarm of the safety check leads to.

use super::read_all;
use crate::fields::Fields;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_scheduler::safety::Response;
use zhuyi_scheduler::{Chip, Compute};

/// The block `compute`; without it every frame takes its period.
pub(super) fn compute(fields: &Fields) -> Option<Compute> {
    let Some(node) = fields.optional("compute") else {
        return Some(Compute::Ideal);
    };
    node.variant(
        "compute",
        &[
            ("Ideal", &|_| Some(Compute::Ideal)),
            ("Accelerator", &|fields| {
                Some(Compute::Accelerator(chip(fields)?))
            }),
        ],
    )
}

/// The order of frames is not the chip's but the policy's.
fn chip(fields: &Fields) -> Option<Chip> {
    let usual = Chip::default();
    let discipline = usual.discipline;
    read_all!(Chip {
        // Within these limits a frame takes an hour at most.
        tops: fields.number_or("tops", within(0.1, 1e6), usual.tops),
        gop_per_frame: fields.number_or("gop_per_frame", above(0.0, 1e5), usual.gop_per_frame),
        frame_bytes: fields
            .whole_or("frame_bytes", 0..=u32::MAX, usual.frame_bytes as u32)
            .map(u64::from),
        discipline: Some(discipline),
        drop_stale: fields
            .optional("drop_stale")
            .map_or(Some(usual.drop_stale), |node| node.truth()),
    })
}

/// What is done while an alarm stands.
pub(super) fn response(node: &Node) -> Option<Response> {
    node.variant(
        "response",
        &[
            ("Record", &|_| Some(Response::None)),
            ("EmergencyBackup", &|_| Some(Response::EmergencyBackup)),
            ("LimitedFunctionality", &|fields| {
                let freed_share = fields.number_or("freed_share", within(0.0, 10.0), 0.25);
                let lower_speed = fields.number_or("lower_speed_mps", within(0.0, 40.0), 5.0);
                let longer_headway = fields.number_or("longer_headway_s", within(0.0, 10.0), 0.5);
                Some(Response::LimitedFunctionality {
                    freed_share: freed_share?,
                    lower_speed: lower_speed?,
                    longer_headway: longer_headway?,
                })
            }),
            ("RaiseRates", &|_| Some(Response::RaiseRates)),
        ],
    )
}
