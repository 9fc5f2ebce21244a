//! Places on roads that come near to themselves and on rings.

use std::f64::consts::{PI, TAU};
use zhuyi_core::{Frenet, Point, Pose, Road, Segment};
use zhuyi_log::{Log, Replay, places_on};

use crate::{HEADER, row};

/// 200 m east, a half circle of 15 m radius to the left, 200 m back: legs 30 m apart.
fn hairpin() -> Road {
    let leg = Segment::Line { length: 200.0 };
    let turn = Segment::Arc {
        length: 15.0 * PI,
        curvature: 1.0 / 15.0,
    };
    Road::new(Pose::default(), &[leg, turn, leg], 2, 3.5).unwrap()
}

fn ring() -> Road {
    let circle = Segment::Arc {
        length: 400.0,
        curvature: TAU / 400.0,
    };
    Road::closed(Pose::default(), &[circle], 2, 3.5).unwrap()
}

/// A row of a body on a road that drives along it.
fn on(road: &Road, text: &mut String, time: f64, id: &str, place: Frenet, speed: f64) {
    let Pose { x, y, heading } = road.world_from_road(place);
    row(text, time, id, [x, y, heading, speed, 0.0]);
}

#[test]
fn hand_a_vehicle_beside_a_hairpin_stays_on_its_leg() {
    // It strays from its leg to 20 m beside it, where the other leg is nearer.
    let road = hairpin();
    let mut text = HEADER.to_string();
    for i in 0..60 {
        let time = f64::from(i) / 10.0;
        row(
            &mut text,
            time,
            "ego",
            [20.0 + 20.0 * time, 4.0 * time, 0.2, 20.4, 0.0],
        );
    }
    let log = Log::read(&text, None).unwrap();
    let places: Vec<_> = places_on(&road, &log, &log.vehicles()[0]).collect();
    for (i, place) in (0..).zip(&places) {
        let time = f64::from(i) / 10.0;
        assert!((place.s - (20.0 + 20.0 * time)).abs() < 1e-9, "{place:?}");
        assert!((place.d - 4.0 * time).abs() < 1e-9, "{place:?}");
    }
    let nearest = road.road_from_world(Point::new(138.0, 23.6));
    assert!(nearest.s > 247.0, "{nearest:?}");
}

#[test]
fn hand_rows_a_second_apart_find_their_way_round_a_hairpin() {
    let road = hairpin();
    let mut text = HEADER.to_string();
    for i in 0..14 {
        let time = f64::from(i);
        on(
            &road,
            &mut text,
            time,
            "ego",
            Frenet {
                s: 10.0 + 30.0 * time,
                d: 0.0,
            },
            30.0,
        );
    }
    let log = Log::read(&text, None).unwrap();
    for (i, place) in (0..).zip(places_on(&road, &log, &log.vehicles()[0])) {
        assert!(
            (place.s - (10.0 + 30.0 * f64::from(i))).abs() < 1e-8,
            "{place:?}"
        );
    }
}

#[test]
fn law_on_a_ring_everybody_is_told_in_the_lap_nearest_to_the_ego() {
    // The ego passes a car that stands, again and again; another one drives 30 m ahead of it across the seam.
    let road = ring();
    let mut text = HEADER.to_string();
    for i in 0..700 {
        let time = f64::from(i) / 10.0;
        let s = 5.0 + 20.0 * time;
        on(
            &road,
            &mut text,
            time,
            "ego",
            Frenet { s, d: 1.75 },
            20.0 * (1.0 - 1.75 * TAU / 400.0),
        );
        on(
            &road,
            &mut text,
            time,
            "stands",
            Frenet { s: 390.0, d: -1.75 },
            0.0,
        );
        on(
            &road,
            &mut text,
            time,
            "ahead",
            Frenet {
                s: s + 30.0,
                d: 1.75,
            },
            20.0 * (1.0 - 1.75 * TAU / 400.0),
        );
    }
    let log = Log::read(&text, None).unwrap();
    let replay = Replay::new(&log, log.find("ego").unwrap(), Some(&road), 20.0);
    // Along the ego's lane, which is on the inside.
    let scale = 1.0 - 1.75 * TAU / 400.0;
    for moment in replay.moments() {
        assert!((moment.ego.s - scale * (5.0 + 20.0 * moment.time)).abs() < 1e-6);
        let [stands, ahead] = &moment.actors[..] else {
            panic!("two others");
        };
        let way = stands.body.road.s - moment.ego.s;
        assert!(way.abs() <= scale * 200.0 + 1e-6, "{way}");
        assert!((ahead.body.road.s - moment.ego.s - scale * 30.0).abs() < 1e-6);
        // The future begins where the body is told, and one that stands stays there.
        for (actor, still) in [(stands, true), (ahead, false)] {
            let along = &actor.future.trajectory().along;
            let place = along.partition_point(|piece| piece.time <= moment.time);
            let there = along[place.saturating_sub(1)].s_at(moment.time);
            assert!((there - actor.body.road.s).abs() < 1e-6, "{there}");
            let last = along[along.len() - 1].s;
            let stays = (last - actor.body.road.s).abs() < 1e-6;
            assert!(stays || !still, "{last}");
        }
    }
}

/// A vehicle at the centre of the bend, moving and standing, used to end the program: no length there belongs to a length of the
/// road.
#[test]
fn regress_a_vehicle_at_the_centre_of_a_bend_is_answered() {
    let bend = [Segment::Arc {
        length: 100.0,
        curvature: 1.0 / 64.0,
    }];
    let road = Road::new(Pose::default(), &bend, 2, 3.5).unwrap();
    for speed in [0.0, 3.0] {
        let mut text = HEADER.to_string();
        for step in 0..20 {
            let time = f64::from(step) / 10.0;
            row(&mut text, time, "ego", [10.0 * time, 0.0, 0.0, 10.0, 0.0]);
            row(
                &mut text,
                time,
                "middle",
                [speed * time, 64.0, 0.0, speed, 0.0],
            );
        }
        let log = Log::read(&text, None).unwrap();
        let replay = Replay::new(&log, log.find("ego").unwrap(), Some(&road), 20.0);
        for moment in replay.moments() {
            let body = moment.actors[0].body;
            assert!(
                body.road.s.is_finite() && body.s_rate.abs() <= 5.5 * 3.0,
                "{body:?}"
            );
        }
    }
}
