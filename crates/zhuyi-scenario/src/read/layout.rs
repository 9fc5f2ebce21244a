//! Where everything stands at the start: on the road, and nothing inside anything else.
//!
//! Boxes are compared where they stand in the world: in a bend two of them may touch that have a gap along the road.

use crate::conflict::Conflict;
use crate::model::EgoStart;
use crate::node::Node;
use zhuyi_core::{Footprint, Frenet, Road};
use zhuyi_world::contact::overlap;
use zhuyi_world::script::{Actor, Place};

/// A box on the road with what errors call it by.
struct Standing<'a, 'n> {
    name: &'n str,
    /// Its centre.
    place: Frenet,
    footprint: Footprint,
    /// What errors point at.
    node: Node<'a>,
}

/// Checks the ego's start and those of the actors that could be read, whose nodes stand in the same order.
pub(super) fn check_start(
    road: &Road,
    ego: (Footprint, EgoStart, &Node),
    actors: &[Option<Actor>],
    nodes: &[Node],
) {
    let (footprint, start, node) = ego;
    let mut standing = vec![Standing {
        name: "ego",
        place: Frenet {
            s: start.s,
            d: road.lane_center(start.lane),
        },
        footprint,
        node: node.clone(),
    }];
    for (actor, node) in actors.iter().zip(nodes) {
        let Some(actor) = actor else { continue };
        let node = node.field("start").unwrap_or_else(|| node.clone());
        standing.push(Standing {
            name: &actor.name,
            place: Frenet {
                s: centre(actor, start.s, footprint),
                d: road.lane_center(actor.start.lane),
            },
            footprint: actor.footprint,
            node,
        });
    }
    for (index, one) in standing.iter().enumerate() {
        let (rear, front) = (
            one.place.s - one.footprint.length / 2.0,
            one.place.s + one.footprint.length / 2.0,
        );
        if let Some(lap) = road.lap() {
            check_lap(one, start.s, lap);
        } else if rear < 0.0 || front > road.length() {
            let (name, length) = (one.name.to_string(), road.length());
            one.node.refuse(Conflict::OffRoad {
                name,
                rear,
                front,
                length,
            });
        }
        for other in &standing[..index] {
            check_apart(road, one, other);
        }
    }
}

/// On a ring all stand within one lap: the ego of its start, the others of the ego.
fn check_lap(one: &Standing, ego: f64, lap: f64) {
    let (way, from) = if one.name == "ego" {
        (ego, "the start of the road")
    } else {
        (one.place.s - ego, "the ego")
    };
    if way.abs() > lap {
        one.node.refuse(Conflict::BeyondLap {
            name: one.name.to_string(),
            way: way.abs(),
            from,
            lap,
        });
    }
}

/// [m] the centre of an actor, given the ego's.
fn centre(actor: &Actor, ego: f64, footprint: Footprint) -> f64 {
    let halves = actor.footprint.half_lengths(footprint);
    match actor.start.along {
        Place::Ahead(gap) => ego + gap + halves,
        Place::Behind(gap) => ego - gap - halves,
        Place::Beside(offset) => ego + offset,
        Place::At(s) => s,
    }
}

fn check_apart(road: &Road, one: &Standing, other: &Standing) {
    let placed = |of: &Standing| (of.footprint, road.world_from_road(of.place));
    if let Some((along, across)) = overlap(placed(one), placed(other)) {
        let rule = Conflict::Overlap {
            name: one.name.to_string(),
            other: other.name.to_string(),
            along,
            across,
        };
        one.node.refuse_beside(rule, &other.node);
    }
}
