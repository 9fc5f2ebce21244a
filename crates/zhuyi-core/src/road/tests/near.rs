//! Places by continuity, by hand and against a walk in small steps.

use super::*;
use std::f64::consts::TAU;

/// 200 m east, a half circle of 15 m radius to the left, 200 m back.
fn hairpin() -> Road {
    let leg = Segment::Line { length: 200.0 };
    let turn = Segment::Arc {
        length: 15.0 * PI,
        curvature: 1.0 / 15.0,
    };
    Road::new(Pose::default(), &[leg, turn, leg], 2, 3.5).unwrap()
}

#[test]
fn hand_between_the_legs_of_a_hairpin_a_body_stays_with_its_leg() {
    // It drifts off the first leg, 30 m from the second, past the middle between them and over the second.
    let road = hairpin();
    let mut s = 20.0;
    for i in 0..=80 {
        let (x, y) = (20.0 + 2.0 * f64::from(i), 0.4 * f64::from(i));
        let place = road.road_from_world_near(Point::new(x, y), s);
        assert_near(place.s, x, 1e-9, "s");
        assert_near(place.d, y, 1e-9, "d");
        s = place.s;
        let nearest = road.road_from_world(Point::new(x, y));
        assert_eq!(nearest.s > 200.0, y > 15.0, "{y} m from the first leg");
    }
    // The same point for a body that comes along the second leg: 100 m from its start.
    let there = road.road_from_world_near(Point::new(100.0, 10.0), 290.0 + 15.0 * PI);
    assert_near(there.s, 300.0 + 15.0 * PI, 1e-9, "s");
    assert_near(there.d, 20.0, 1e-9, "d");
}

#[test]
fn hand_on_a_ring_places_count_on_over_the_laps() {
    let lap = 200.0 * PI;
    let circle = Segment::Arc {
        length: lap,
        curvature: 0.01,
    };
    let road = Road::closed(Pose::default(), &[circle], 2, 3.5).unwrap();
    for (step, sign) in [(7.0, 1.0), (31.0, -1.0)] {
        let mut near = 5.0;
        for i in 0..300 {
            let s = 5.0 + sign * step * f64::from(i);
            let point = road.world_from_road(Frenet { s, d: 2.0 }).point();
            let place = road.road_from_world_near(point, near);
            assert_near(place.s, s, 1e-8, "s");
            assert_near(place.d, 2.0, 1e-9, "d");
            near = place.s;
        }
    }
    let first = road.world_from_road(Frenet {
        s: 3.0 * lap + 9.0,
        d: 0.0,
    });
    assert_near(
        road.road_from_world(first.point()).s,
        9.0,
        1e-9,
        "first lap",
    );
    // From the centre all places are equally far: it stays where it is.
    let centre = road.road_from_world_near(Point::new(0.0, 100.0), 77.0);
    assert!(centre.d > 99.9 && centre.s.is_finite());
}

/// The place found by going on in steps of 2 mm while that comes nearer.
fn walked(road: &Road, point: Point, near_s: f64) -> f64 {
    let apart = |s: f64| {
        let there = road.world_from_road(Frenet { s, d: 0.0 });
        (there.x - point.x).hypot(there.y - point.y)
    };
    let way = if apart(near_s + 1e-4) < apart(near_s - 1e-4) {
        0.002
    } else {
        -0.002
    };
    let (mut s, mut here) = (near_s, apart(near_s));
    loop {
        let next = apart(s + way);
        if next >= here {
            return s;
        }
        (s, here) = (s + way, next);
    }
}

#[test]
fn law_a_walk_in_small_steps_comes_to_the_same_place() {
    let ring = {
        let side = Segment::Line { length: 60.0 };
        let into = Segment::Clothoid {
            length: 30.0,
            start: 0.0,
            end: 0.04,
        };
        let out = Segment::Clothoid {
            length: 30.0,
            start: 0.04,
            end: 0.0,
        };
        let bend = Segment::Arc {
            length: (PI - 1.2) / 0.04,
            curvature: 0.04,
        };
        let half = [side, into, bend, out];
        Road::closed(Pose::new(3.0, 4.0, 1.0), &[half, half].concat(), 2, 3.5).unwrap()
    };
    assert_near(
        ring.heading(ring.length() + 1.0),
        1.0 + TAU,
        1e-9,
        "heading",
    );
    let mut ill_defined = 0;
    for road in [winding(false), winding(true), hairpin(), ring] {
        for i in 0..15 {
            for j in 0..30 {
                let near = -30.0 + (road.length() + 60.0) * f64::from(i) / 15.0;
                let (ahead, left) = (
                    f64::from(j % 6) * 13.0 - 31.0,
                    f64::from(j / 6) * 17.0 - 33.0,
                );
                let from = road.world_from_road(Frenet { s: near, d: 0.0 });
                let point = from.offset(ahead, left);
                let found = road.road_from_world_near(point, near);
                let back = road.world_from_road(found);
                assert_near(back.x, point.x, 1e-8, "x");
                assert_near(back.y, point.y, 1e-8, "y");
                let walked = walked(&road, point, near);
                // At a centre of curvature the distance is level, and the walk stops where rounding says so.
                if (road.lane_rate(found.s, found.d)).abs() < 1e-3 {
                    ill_defined += 1;
                    continue;
                }
                assert_near(found.s, walked, 0.004, &format!("{point:?} from {near}"));
            }
        }
    }
    assert!(ill_defined < 20, "{ill_defined}");
}
