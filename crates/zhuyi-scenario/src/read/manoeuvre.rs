//! What an actor is told to do, and when.

use super::actor::{Driver, Scope, behaviour};
use super::{ACCEL, DISTANCE, SPEED, every, lane, read_all, speed_in};
use crate::conflict::Conflict;
use crate::fields::Fields;
use crate::invalid::Rule;
use crate::limits::{above, within};
use crate::node::Node;
use zhuyi_core::ActorId;
use zhuyi_world::script::{Action, Manoeuvre, Trigger};

/// The manoeuvres of the actor at `index`.
pub(super) fn manoeuvres(
    node: &Node,
    index: usize,
    scope: &Scope,
    driver: Driver,
) -> Option<Vec<Manoeuvre>> {
    let mut lane = driver.lane;
    let mut time = 0.0;
    every(node.list(0..=100)?.into_iter().map(|node| {
        node.structure("Manoeuvre", |fields| {
            let when = fields.required("when").and_then(|node| {
                let when = trigger(&node, index, scope);
                if let Some(Trigger::Time(at)) = when {
                    check_time(&node, at, time, scope.duration);
                    time = at;
                }
                when
            });
            let then = fields.required("then").and_then(|node| {
                let then = action(&node, scope, driver);
                if let Some(Action::ChangeLane { lane: target, .. }) = then {
                    if lane == Some(target) {
                        node.refuse(Conflict::SameLane { lane: target.0 });
                    }
                    lane = Some(target);
                }
                then
            });
            Some(Manoeuvre {
                when: when?,
                then: then?,
            })
        })
    }))
}

/// Times come in order and before the end of the run.
fn check_time(node: &Node, at: f64, before: f64, end: Option<f64>) {
    if at < before {
        node.refuse(Conflict::TimeOrder { at, before });
    }
    match end {
        Some(end) if at >= end => node.refuse(Conflict::AfterEnd { at, end }),
        _ => {}
    }
}

fn trigger(node: &Node, index: usize, scope: &Scope) -> Option<Trigger> {
    let time = above(0.0, 600.0);
    node.variant(
        "trigger",
        &[
            ("Time", &|fields| {
                Some(Trigger::Time(fields.number("at_s", within(0.0, 600.0))?))
            }),
            ("GapToEgo", &|fields| {
                Some(Trigger::GapToEgo(fields.number("gap_m", DISTANCE)?))
            }),
            ("DistanceTo", &|fields| {
                read_all!(Trigger::DistanceTo {
                    actor: fields
                        .required("actor")
                        .and_then(|node| other_actor(&node, index, scope)),
                    distance: fields.number("distance_m", DISTANCE),
                })
            }),
            ("TimeToCollision", &|fields| {
                Some(Trigger::TimeToCollision(fields.number("time_s", time)?))
            }),
        ],
    )
}

fn other_actor(node: &Node, index: usize, scope: &Scope) -> Option<ActorId> {
    let name = node.text()?;
    let names: Vec<_> = scope
        .nodes
        .iter()
        .map(|node| node.own_name().unwrap_or_default())
        .collect();
    let rule = match names.iter().position(|other| *other == name) {
        Some(other) if other != index => return u32::try_from(other).ok().map(ActorId),
        Some(_) => Conflict::OwnDistance.into(),
        None if name == "ego" => Conflict::DistanceToEgo.into(),
        None => {
            let others = names
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != index);
            Rule::unknown("actor", &name, others.map(|(_, name)| name.as_str()))
        }
    };
    node.refuse(rule);
    None
}

fn action(node: &Node, scope: &Scope, driver: Driver) -> Option<Action> {
    node.variant(
        "action",
        &[
            ("ChangeLane", &|fields| {
                read_all!(Action::ChangeLane {
                    lane: lane(fields, scope.lanes),
                    duration: fields.number("duration_s", within(0.5, 30.0)),
                })
            }),
            ("ReachSpeed", &|fields| {
                read_all!(Action::ReachSpeed {
                    speed: target_speed(fields),
                    accel: fields.number("accel_mps2", ACCEL)
                })
            }),
            ("Brake", &|fields| {
                read_all!(Action::Brake {
                    decel: fields.number("decel_mps2", ACCEL)
                })
            }),
            ("Behave", &|fields| {
                Some(Action::Behave(
                    fields
                        .required("behaviour")
                        .and_then(|node| behaviour(&node, driver, false))?,
                ))
            }),
        ],
    )
}

fn target_speed(fields: &Fields) -> Option<f64> {
    speed_in(fields.one_of(&["speed_mph", "speed_mps"])?, SPEED)
}
