//! A scenario as its file.

use super::{number_for, value::Value};
use crate::body::Body;
use crate::model::Scenario;
use Value::{List, Number, Struct, Text, Truth, Variant, Whole};
use zhuyi_core::{ActorId, Lane, Segment, SimTime};
use zhuyi_world::script::{Action, Actor, Behaviour, Manoeuvre, Place, Trigger};

pub(super) fn scenario(scenario: &Scenario) -> Value {
    let duration = scenario.duration;
    let seconds = number_for(0.0, duration.seconds(), |s| {
        (SimTime::from_seconds(s) - duration).seconds()
    });
    Struct(vec![
        ("title", Text(scenario.title.clone())),
        ("road", road(scenario)),
        (
            "ego",
            Struct(vec![
                ("lane", lane(scenario.ego.lane)),
                ("s_m", Number(scenario.ego.s)),
                ("speed_mps", Number(scenario.ego.speed)),
            ]),
        ),
        ("duration_s", seconds),
        (
            "actors",
            List(
                scenario
                    .actors
                    .iter()
                    .map(|one| actor(one, &scenario.actors))
                    .collect(),
            ),
        ),
    ])
}

fn road(scenario: &Scenario) -> Value {
    let mut fields = vec![
        ("lanes", Whole(scenario.road.lanes().into())),
        ("lane_width_m", Number(scenario.road.lane_width())),
        (
            "segments",
            List(scenario.segments.iter().copied().map(segment).collect()),
        ),
    ];
    if scenario.road.lap().is_some() {
        fields.push(("closed", Truth(true)));
    }
    Struct(fields)
}

fn segment(segment: Segment) -> Value {
    match segment {
        Segment::Line { length } => Variant("Line", vec![("length_m", Number(length))]),
        Segment::Arc { length, curvature } => Variant(
            "Arc",
            vec![
                ("length_m", Number(length)),
                (
                    "radius_m",
                    number_for(curvature, curvature.recip(), f64::recip),
                ),
            ],
        ),
        Segment::Clothoid { length, start, end } => Variant(
            "Clothoid",
            vec![
                ("length_m", Number(length)),
                ("start_curvature_per_m", Number(start)),
                ("end_curvature_per_m", Number(end)),
            ],
        ),
    }
}

fn lane(lane: Lane) -> Value {
    Whole(lane.0.into())
}

fn actor(actor: &Actor, all: &[Actor]) -> Value {
    let manoeuvres = actor
        .manoeuvres
        .iter()
        .map(|one| manoeuvre(*one, all))
        .collect();
    Struct(vec![
        ("name", Text(actor.name.clone())),
        (
            "body",
            body(Body {
                footprint: actor.footprint,
                mass: actor.mass,
            }),
        ),
        ("lane", lane(actor.start.lane)),
        ("start", place(actor.start.along)),
        ("speed_mps", Number(actor.speed)),
        ("behaviour", behaviour(actor.behaviour)),
        ("manoeuvres", List(manoeuvres)),
    ])
}

fn body(body: Body) -> Value {
    match body {
        Body::CAR => Variant("Car", Vec::new()),
        Body::TRUCK => Variant("Truck", Vec::new()),
        Body { footprint, mass } => Variant(
            "Box",
            vec![
                ("length_m", Number(footprint.length)),
                ("width_m", Number(footprint.width)),
                ("mass_kg", Number(mass)),
            ],
        ),
    }
}

fn place(place: Place) -> Value {
    match place {
        Place::Ahead(gap) => Variant("Ahead", vec![("gap_m", Number(gap))]),
        Place::Behind(gap) => Variant("Behind", vec![("gap_m", Number(gap))]),
        Place::Beside(offset) => Variant("Beside", vec![("offset_m", Number(offset))]),
        Place::At(s) => Variant("At", vec![("s_m", Number(s))]),
    }
}

fn behaviour(behaviour: Behaviour) -> Value {
    match behaviour {
        Behaviour::Obstacle => Variant("Obstacle", Vec::new()),
        Behaviour::Cruise => Variant("Cruise", Vec::new()),
        Behaviour::Follow { driver, max_decel } => Variant(
            "Follow",
            vec![
                ("desired_speed_mps", Number(driver.desired_speed)),
                ("time_headway_s", Number(driver.time_headway)),
                ("min_gap_m", Number(driver.min_gap)),
                ("max_accel_mps2", Number(driver.max_accel)),
                ("comfortable_decel_mps2", Number(driver.comfortable_decel)),
                ("exponent", Number(driver.exponent)),
                ("max_decel_mps2", Number(max_decel)),
            ],
        ),
        Behaviour::HoldBeside(station) => Variant(
            "HoldBeside",
            vec![
                ("offset_m", Number(station.offset)),
                ("max_accel_mps2", Number(station.max_accel)),
                ("max_decel_mps2", Number(station.max_decel)),
            ],
        ),
    }
}

fn manoeuvre(manoeuvre: Manoeuvre, actors: &[Actor]) -> Value {
    Struct(vec![
        ("when", trigger(manoeuvre.when, actors)),
        ("then", action(manoeuvre.then)),
    ])
}

fn trigger(trigger: Trigger, actors: &[Actor]) -> Value {
    let name_of = |actor: ActorId| {
        Text(
            actors
                .get(actor.index())
                .map_or_else(String::new, |actor| actor.name.clone()),
        )
    };
    match trigger {
        Trigger::Time(at) => Variant("Time", vec![("at_s", Number(at))]),
        Trigger::GapToEgo(gap) => Variant("GapToEgo", vec![("gap_m", Number(gap))]),
        Trigger::DistanceTo { actor, distance } => Variant(
            "DistanceTo",
            vec![("actor", name_of(actor)), ("distance_m", Number(distance))],
        ),
        Trigger::TimeToCollision(time) => {
            Variant("TimeToCollision", vec![("time_s", Number(time))])
        }
    }
}

fn action(action: Action) -> Value {
    match action {
        Action::ChangeLane {
            lane: target,
            duration,
        } => Variant(
            "ChangeLane",
            vec![("lane", lane(target)), ("duration_s", Number(duration))],
        ),
        Action::ReachSpeed { speed, accel } => Variant(
            "ReachSpeed",
            vec![("speed_mps", Number(speed)), ("accel_mps2", Number(accel))],
        ),
        Action::Brake { decel } => Variant("Brake", vec![("decel_mps2", Number(decel))]),
        Action::Behave(then) => Variant("Behave", vec![("behaviour", behaviour(then))]),
    }
}
