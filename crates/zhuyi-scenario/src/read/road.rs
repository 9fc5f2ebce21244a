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
        let closed = fields.optional("closed");
        let is_closed = closed.as_ref().map_or(Some(false), Node::truth);
        let (lanes, lane_width, nodes, segments) = (lanes?, lane_width?, nodes?, segments?);
        // One at a time first, so that each that breaks a rule of its own is pointed at.
        let alone = nodes.iter().zip(&segments).map(|(node, segment)| {
            match Road::new(Pose::default(), &[*segment], lanes, lane_width) {
                Ok(_) | Err(RoadError::Itself { .. }) => Some(()),
                Err(error) => refuse(node, error),
            }
        });
        every(alone)?;
        let lay_out = if is_closed? { Road::closed } else { Road::new };
        let road = match lay_out(Pose::default(), &segments, lanes, lane_width) {
            Ok(road) => road,
            Err(error) => {
                return match (&error, &closed) {
                    (RoadError::Itself { segments, .. }, _) => {
                        let [first, second] = *segments;
                        let first = (first != second).then(|| &nodes[first]);
                        refuse_beside(&nodes[second], first, error)
                    }
                    (RoadError::Open { .. }, Some(closed)) => refuse(closed, error),
                    _ => refuse(node, error),
                };
            }
        };
        Some(Layout { road, segments })
    });
    (lanes, layout)
}

/// Points at a segment, and at the one that it lies over if that is another.
fn refuse_beside<T>(node: &Node, other: Option<&Node>, error: RoadError) -> Option<T> {
    let Some(other) = other else {
        return refuse(node, error);
    };
    node.refuse_beside(Conflict::from(error), other);
    None
}

fn refuse<T>(node: &Node, error: RoadError) -> Option<T> {
    node.refuse(Conflict::from(error));
    None
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
