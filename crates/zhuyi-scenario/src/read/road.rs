//! The road.

use super::{every, read_all};
use crate::conflict::Conflict;
use crate::fields::Fields;
use crate::invalid::Rule;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_core::{Pose, Road, RoadError, Segment};

/// A road and what it was laid out from.
pub(super) struct Layout {
    pub(super) road: Road,
    pub(super) segments: Vec<Segment>,
}

/// The number of lanes of a road, and the road, from the origin along the x axis.
pub(super) fn road(node: &Node) -> (Option<u8>, Option<Layout>) {
    let mut lanes = None;
    let layout = node.structure("Road", |fields| {
        lanes = fields
            .whole("lanes", 1..=u32::from(Road::MAX_LANES))
            .and_then(|lanes| u8::try_from(lanes).ok());
        let lane_width = fields.number("lane_width_m", within(2.0, 6.0));
        let nodes = fields
            .required("segments")
            .and_then(|segments| segments.list(1..=1000));
        let segments = every(nodes.iter().flatten().map(segment));
        let (lanes, lane_width, nodes, segments) = (lanes?, lane_width?, nodes?, segments?);
        let lay_out =
            |segments: &[Segment]| Road::new(Pose::default(), segments, lanes, lane_width);
        // One at a time first, so that each that breaks a rule of the road is pointed at.
        let alone = nodes
            .iter()
            .zip(&segments)
            .map(|(node, segment)| accept(lay_out(&[*segment]), node));
        every(alone)?;
        Some(Layout {
            road: accept(lay_out(&segments), node)?,
            segments,
        })
    });
    (lanes, layout)
}

/// The road, unless it breaks its own rules.
fn accept(road: Result<Road, RoadError>, node: &Node) -> Option<Road> {
    road.map_err(|error| node.refuse(Conflict::from(error)))
        .ok()
}

fn segment(node: &Node) -> Option<Segment> {
    let length = above(0.0, 100_000.0);
    let curvature = within(-0.2, 0.2);
    node.variant(
        "segment",
        &[
            ("Line", &|fields| {
                read_all!(Segment::Line {
                    length: fields.number("length_m", length)
                })
            }),
            ("Arc", &|fields| {
                read_all!(Segment::Arc {
                    length: fields.number("length_m", length),
                    curvature: radius(fields).map(f64::recip)
                })
            }),
            ("Clothoid", &|fields| {
                read_all!(Segment::Clothoid {
                    length: fields.number("length_m", length),
                    start: fields.number("start_curvature_per_m", curvature),
                    end: fields.number("end_curvature_per_m", curvature),
                })
            }),
        ],
    )
}

/// [m] positive to the left.
fn radius(fields: &Fields) -> Option<f64> {
    let node = fields.required("radius_m")?;
    let radius = node.number(within(-100_000.0, 100_000.0))?;
    if radius.abs() < 5.0 {
        let limits = "5 or more to the left, -5 or less to the right".to_string();
        node.refuse(Rule::Range {
            name: "radius_m".to_string(),
            limits,
            got: radius.to_string(),
        });
        return None;
    }
    Some(radius)
}
