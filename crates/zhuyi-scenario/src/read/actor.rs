//! An actor: its body, its start and its behaviour.

use super::manoeuvre::manoeuvres;
use super::pace::check_pace;
use super::{ACCEL, GAP, OFFSET, SPEED, lane, read_all, speed_in, unique_name};
use crate::body::Body;
use crate::conflict::Conflict;
use crate::fields::{Fields, Refused};
use crate::limits::{above, within};
use crate::model::EgoStart;
use crate::node::{Node, Variants};
use zhuyi_core::{Footprint, Lane, idm::Idm};
use zhuyi_world::script::{Actor, Behaviour, Place, Start, Station};

/// What an actor may refer to. `None` is what was itself refused.
pub(super) struct Scope<'a, 'b> {
    /// All actors.
    pub(super) nodes: &'b [Node<'a>],
    /// Lanes of the road.
    pub(super) lanes: Option<u8>,
    /// The ego's start.
    pub(super) ego: Option<EgoStart>,
    /// [m] the gap that the ego's planner keeps at the ego's speed.
    pub(super) steady_gap: Option<f64>,
    /// [s] the duration of the run.
    pub(super) duration: Option<f64>,
}

/// The actor at a place of the list.
pub(super) fn actor(index: usize, scope: &Scope) -> Option<Actor> {
    let (earlier, node) = (scope.nodes.get(..index)?, scope.nodes.get(index)?);
    node.structure("Actor", |fields| {
        let name = unique_name(fields, "actor", earlier);
        let body = fields
            .optional("body")
            .map_or(Some(Body::CAR), |node| body(&node));
        let lane = lane(fields, scope.lanes);
        let place = fields
            .required("start")
            .and_then(|node| place(&node, scope));
        let is_obstacle = fields
            .optional("behaviour")
            .is_some_and(|node| node.is("Obstacle"));
        let speed = speed(fields, scope.ego, is_obstacle);
        let driver = Driver { lane, speed, place };
        let behaviour = match fields.optional("behaviour") {
            Some(node) => behaviour(&node, driver, true),
            None => Some(Behaviour::Cruise),
        };
        let manoeuvres = fields
            .optional("manoeuvres")
            .map_or(Some(Vec::new()), |node| {
                let read = manoeuvres(&node, index, scope, driver)?;
                if is_obstacle && !read.is_empty() {
                    node.refuse(Conflict::ObstacleManoeuvres);
                }
                if let (false, Some(speed), Some(behaviour)) = (is_obstacle, speed, behaviour) {
                    check_pace(speed, behaviour, &read, &node.list(0..=100)?);
                }
                Some(read)
            });
        let body = body?;
        Some(Actor {
            name: name?,
            footprint: body.footprint,
            mass: body.mass,
            start: Start {
                lane: lane?,
                along: place?,
            },
            speed: speed?,
            behaviour: behaviour?,
            manoeuvres: manoeuvres?,
        })
    })
}

fn body(node: &Node) -> Option<Body> {
    node.variant(
        "body",
        &[
            ("Car", &|_| Some(Body::CAR)),
            ("Truck", &|_| Some(Body::TRUCK)),
            ("Box", &|fields| {
                let footprint = read_all!(Footprint {
                    length: fields.number("length_m", within(0.1, 30.0)),
                    width: fields.number("width_m", within(0.1, 4.0)),
                });
                read_all!(Body {
                    footprint,
                    mass: fields.number("mass_kg", within(1.0, 100_000.0))
                })
            }),
        ],
    )
}

fn place(node: &Node, scope: &Scope) -> Option<Place> {
    let gap = |fields: &Fields| fields.number("gap_m", GAP);
    node.variant(
        "start",
        &[
            ("Ahead", &|fields| Some(Place::Ahead(gap(fields)?))),
            ("Behind", &|fields| Some(Place::Behind(gap(fields)?))),
            ("Beside", &|fields| {
                Some(Place::Beside(fields.number("offset_m", OFFSET)?))
            }),
            ("At", &|fields| {
                Some(Place::At(fields.number("s_m", within(0.0, 100_000.0))?))
            }),
            ("Steady", &|_| Some(Place::Ahead(scope.steady_gap?))),
        ],
    )
}

/// [m/s] the speed at the start, which an obstacle need not give.
fn speed(fields: &Fields, ego: Option<EgoStart>, is_obstacle: bool) -> Option<f64> {
    let names = ["speed_mph", "speed_mps", "relative_mph", "relative_mps"];
    let given = if is_obstacle {
        fields.at_most_one_of(&names).ok()?
    } else {
        Some(fields.one_of(&names)?)
    };
    let Some((name, node)) = given else {
        return Some(0.0);
    };
    let speed = if name.starts_with("relative") {
        let relative = |low, high| {
            speed_in(
                (name, node.clone()),
                within(SPEED.low - low, SPEED.high - high),
            )
        };
        match ego {
            Some(EgoStart { speed, .. }) => (speed + relative(speed, speed)?).min(SPEED.high),
            // Too much for any ego is too much for one that is unknown.
            None => return relative(SPEED.high, SPEED.low).and(None),
        }
    } else {
        speed_in((name, node.clone()), SPEED)?
    };
    if is_obstacle && speed > 0.0 {
        node.refuse(Conflict::MovingObstacle { speed });
    }
    Some(speed)
}

/// What is known of an actor when its behaviour is read.
#[derive(Clone, Copy)]
pub(super) struct Driver {
    pub(super) lane: Option<Lane>,
    /// [m/s] its speed at the start.
    pub(super) speed: Option<f64>,
    pub(super) place: Option<Place>,
}

/// The behaviour of an actor; that of a standing obstacle only `at_start`.
pub(super) fn behaviour(node: &Node, driver: Driver, at_start: bool) -> Option<Behaviour> {
    let cruise = |_: &Fields| Some(Behaviour::Cruise);
    let follow = |fields: &Fields| follow(fields, driver.speed);
    let hold_beside = |fields: &Fields| hold_beside(fields, driver.place);
    let obstacle = |_: &Fields| Some(Behaviour::Obstacle);
    let variants: Variants<_> = &[
        ("Cruise", &cruise),
        ("Follow", &follow),
        ("HoldBeside", &hold_beside),
        ("Obstacle", &obstacle),
    ];
    // An obstacle stands from the start: an actor that comes to a stop brakes.
    node.variant(
        "behaviour",
        if at_start { variants } else { &variants[..3] },
    )
}

/// Follows; by default as an ordinary driver (Treiber & Kesting 2013, section 11.3: T of 1 to 2 s, s0 of 2 m, a and b of
/// 1 to 2 m/s2) who can brake hard.
fn follow(fields: &Fields, speed: Option<f64>) -> Option<Behaviour> {
    let desired_speed = match fields.at_most_one_of(&["desired_speed_mph", "desired_speed_mps"]) {
        Ok(Some(given)) => speed_in(given, above(0.0, SPEED.high)),
        Ok(None) => speed.filter(|speed| {
            if *speed == 0.0 {
                fields.refuse(Conflict::NoDesiredSpeed);
            }
            *speed > 0.0
        }),
        Err(Refused) => None,
    };
    let driver = read_all!(Idm {
        desired_speed,
        time_headway: fields.number_or("time_headway_s", within(0.0, 10.0), 1.5),
        min_gap: fields.number_or("min_gap_m", within(0.0, 50.0), 2.0),
        max_accel: fields.number_or("max_accel_mps2", ACCEL, 1.5),
        comfortable_decel: fields.number_or("comfortable_decel_mps2", ACCEL, 2.0),
        exponent: fields.number_or("exponent", within(1.0, 100.0), 4.0),
    });
    read_all!(Behaviour::Follow {
        driver,
        max_decel: fields.number_or("max_decel_mps2", ACCEL, 8.0)
    })
}

fn hold_beside(fields: &Fields, place: Option<Place>) -> Option<Behaviour> {
    let offset = match (fields.optional("offset_m"), place) {
        (Some(node), _) => node.number(OFFSET),
        (None, Some(Place::Beside(offset))) => Some(offset),
        (None, Some(_)) => {
            fields.refuse(Conflict::NoOffset);
            None
        }
        (None, None) => None,
    };
    let station = read_all!(Station {
        offset,
        max_accel: fields.number_or("max_accel_mps2", ACCEL, 2.0),
        max_decel: fields.number_or("max_decel_mps2", ACCEL, 8.0),
    });
    station.map(Behaviour::HoldBeside)
}
