//! Cameras, detection and tracking.

use super::{COUNT, every, read_all, unique_name};
use crate::conflict::Conflict;
use crate::fields::Fields;
use crate::limits::{Limits, above, within};
use crate::node::Node;
use zhuyi_core::Camera;
use zhuyi_perception::{Errors, Eye, OwnErrors, Perception};
use zhuyi_world::Vehicle;

/// [-] shares.
const SHARE: Limits = within(0.0, 1.0);

/// Perception and how often its cameras look.
pub(super) struct Rig {
    pub(super) perception: Perception,
    /// [Hz] one per camera.
    pub(super) rates: Vec<f64>,
}

/// The rig of a vehicle.
pub(super) fn perception(node: &Node, vehicle: Option<&Vehicle>) -> Option<Rig> {
    node.structure("Perception", |fields| {
        let confirm_frames = fields.whole("confirm_frames", COUNT);
        let phase = fields
            .optional("phase_share")
            .and_then(|node| node.number(SHARE));
        let eyes = fields
            .required("cameras")
            .and_then(|node| cameras(&node, confirm_frames, phase, vehicle));
        let (eyes, rates) = eyes.map(|eyes| eyes.into_iter().unzip()).unzip();
        let perception = read_all!(Perception {
            eyes,
            phase_shift: fields.number_or("phase_shift", SHARE, 0.0),
            visible_share: fields.number("visible_share", SHARE),
            errors: errors(fields),
            lost_frames: fields.whole("lost_frames", COUNT),
            jerk_density_along: fields.number("jerk_density_along_m2ps5", above(0.0, 10_000.0)),
            jerk_density_across: fields.number("jerk_density_across_m2ps5", above(0.0, 10_000.0)),
        });
        read_all!(Rig { perception, rates })
    })
}

/// [m], [m/s] standard deviations of measured places and speeds.
const NOISE: Limits = within(0.0, 10.0);
/// [rad] standard deviations of measured headings.
const NOISE_HEADING: Limits = within(0.0, 1.0);
/// [ms] jitter of the latency.
const JITTER: Limits = within(0.0, 10_000.0);

/// The errors of every camera that has none of its own.
fn errors(fields: &Fields) -> Option<Errors> {
    read_all!(Errors {
        noise_along: fields.number("noise_along_m", NOISE),
        noise_across: fields.number("noise_across_m", NOISE),
        noise_speed: fields.number("noise_speed_mps", NOISE),
        noise_heading: fields.number_or("noise_heading_rad", NOISE_HEADING, 0.01),
        miss_rate: fields.number("miss_rate", SHARE),
        latency_jitter: fields
            .number_or("latency_jitter_ms", JITTER, 0.0)
            .map(|milliseconds| milliseconds / 1e3),
        drop_rate: fields.number_or("drop_rate", SHARE, 0.0),
    })
}

/// The errors of one camera, under the same names.
fn own_errors(fields: &Fields) -> Option<OwnErrors> {
    let own = |name: &'static str, limits: Limits| {
        let node = fields.optional(name);
        node.map_or(Some(None), |node| node.number(limits).map(Some))
    };
    read_all!(OwnErrors {
        noise_along: own("noise_along_m", NOISE),
        noise_across: own("noise_across_m", NOISE),
        noise_speed: own("noise_speed_mps", NOISE),
        noise_heading: own("noise_heading_rad", NOISE_HEADING),
        miss_rate: own("miss_rate", SHARE),
        latency_jitter: own("latency_jitter_ms", JITTER)
            .map(|jitter| jitter.map(|milliseconds| milliseconds / 1e3)),
        drop_rate: own("drop_rate", SHARE),
    })
}

/// The cameras with their rates.
fn cameras(
    node: &Node,
    confirm_frames: Option<u32>,
    phase: Option<f64>,
    vehicle: Option<&Vehicle>,
) -> Option<Vec<(Eye, f64)>> {
    let nodes = node.list(1..=32)?;
    every(nodes.iter().enumerate().map(|(index, node)| {
        node.structure("Camera", |fields| {
            let own_frames = fields
                .optional("confirm_frames")
                .map_or(confirm_frames, |node| node.whole(COUNT));
            let latency = fields
                .optional("latency")
                .map_or(Some(None), |node| latency("latency", &node));
            let own_phase = fields
                .optional("phase_share")
                .map_or(phase, |node| node.number(SHARE));
            let rate = fields.number_or("rate_hz", within(0.1, 1_000.0), 30.0);
            let camera = camera(fields, &nodes[..index], vehicle);
            let eye = read_all!(Eye {
                camera,
                latency,
                confirm_frames: own_frames,
                phase: Some(own_phase),
                own: own_errors(fields),
            });
            eye.zip(rate)
        })
    }))
}

fn camera<'a>(
    fields: &Fields<'a>,
    earlier: &[Node<'a>],
    vehicle: Option<&Vehicle>,
) -> Option<Camera> {
    let box_of = vehicle.map(|vehicle| vehicle.footprint);
    read_all!(Camera {
        name: unique_name(fields, "camera", earlier),
        forward: mount(
            fields,
            "forward_m",
            box_of.map(|footprint| footprint.length / 2.0)
        ),
        left: mount(
            fields,
            "left_m",
            box_of.map(|footprint| footprint.width / 2.0)
        ),
        yaw: fields
            .number_or("yaw_deg", within(-180.0, 180.0), 0.0)
            .map(f64::to_radians),
        fov: fields.angle("fov_deg", within(1.0, 360.0)),
        range: fields.number("range_m", above(0.0, 500.0)),
        analysed: fields
            .optional("analysed")
            .map_or(Some(false), |node| node.truth()),
    })
}

/// [m] a coordinate of the mount, on the vehicle; its centre unless given.
fn mount(fields: &Fields, name: &'static str, limit: Option<f64>) -> Option<f64> {
    let Some(node) = fields.optional(name) else {
        return Some(0.0);
    };
    let got = node.number(within(-30.0, 30.0))?;
    match limit {
        Some(limit) if got.abs() > limit => node.refuse(Conflict::Mount { limit, got }),
        _ => {}
    }
    Some(got)
}

/// [s] the latency; `None` for one frame period.
#[expect(
    clippy::option_option,
    reason = "refused, or read: one frame period or a time of its own"
)]
pub(super) fn latency(name: &'static str, node: &Node) -> Option<Option<f64>> {
    node.variant(
        name,
        &[
            ("FramePeriod", &|_| Some(None)),
            ("Fixed", &|fields| {
                Some(Some(
                    fields.number("latency_ms", within(0.1, 10_000.0))? / 1e3,
                ))
            }),
        ],
    )
}
