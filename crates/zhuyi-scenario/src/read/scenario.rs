//! A scenario as a whole.

use super::actor::{Scope, actor};
use super::layout::check_start;
use super::road::road;
use super::{SPEED, lane, read_all, speed_in};
use crate::fields::Fields;
use crate::limits::within;
use crate::model::{EgoStart, Scenario, System};
use crate::node::Node;
use zhuyi_core::SimTime;
use zhuyi_world::script::Actor;

/// The scenario that stands at `root`. Without a system, what depends on it goes unchecked.
pub(crate) fn scenario(root: &Node, name: &str, system: Option<&System>) -> Option<Scenario> {
    root.structure("Scenario", |fields| {
        let title = fields.required("title").and_then(|title| title.line());
        let (lanes, layout) = fields
            .required("road")
            .map_or((None, None), |node| road(&node));
        let ego_node = fields.required("ego");
        let start = ego_node.as_ref().and_then(|node| ego_start(node, lanes));
        let duration = fields.number("duration_s", within(0.1, 600.0));
        let steady_gap = system
            .zip(start)
            .map(|(system, EgoStart { speed, .. })| system.planner.driver(speed).steady_gap(speed));
        let nodes = fields
            .required("actors")
            .and_then(|actors| actors.list(0..=100))?;
        let scope = Scope {
            nodes: &nodes,
            lanes,
            ego: start,
            steady_gap,
            duration,
        };
        let actors: Vec<Option<Actor>> =
            (0..nodes.len()).map(|index| actor(index, &scope)).collect();
        if let (Some(layout), Some(system), Some(start), Some(node)) =
            (&layout, system, start, &ego_node)
        {
            check_start(
                &layout.road,
                (system.vehicle.footprint, start, node),
                &actors,
                &nodes,
            );
        }
        let layout = layout?;
        Some(Scenario {
            name: name.to_string(),
            title: title?,
            road: layout.road.into(),
            segments: layout.segments,
            ego: start?,
            actors: actors.into_iter().collect::<Option<_>>()?,
            duration: SimTime::from_seconds(duration?),
        })
    })
}

fn ego_start(node: &Node, lanes: Option<u8>) -> Option<EgoStart> {
    node.structure("Ego", |fields| {
        read_all!(EgoStart {
            lane: lane(fields, lanes),
            s: fields.number("s_m", within(0.0, 100_000.0)),
            speed: own_speed(fields),
        })
    })
}

fn own_speed(fields: &Fields) -> Option<f64> {
    speed_in(fields.one_of(&["speed_mph", "speed_mps"])?, SPEED)
}
