//! Closed roads: what closes, laps, and the way round.

use super::*;
use std::f64::consts::TAU;

fn circle(length: f64, curvature: f64) -> Result<Road, RoadError> {
    Road::closed(
        Pose::new(1.0, 2.0, 0.5),
        &[Segment::Arc { length, curvature }],
        2,
        3.5,
    )
}

#[test]
fn hand_what_a_ring_may_miss() {
    // 1 mm too long: the end lies that much past its start and is turned by a hundredth of it.
    assert!(circle(200.0 * PI + 0.001, 0.01).is_ok());
    let error = circle(200.0 * PI - 0.02, 0.01).unwrap_err();
    let RoadError::Open {
        ahead,
        left,
        turned,
    } = error
    else {
        panic!("{error}");
    };
    assert_near(ahead, -0.02, 1e-6, "ahead");
    assert_near(left, 2e-6, 1e-6, "left");
    assert_near(turned, -2e-4, 1e-9, "turned");
    assert_eq!(
        error.to_string(),
        "a closed road ends where it starts, to within 0.01 m and 0.001 rad: its end lies 0.0200 m before and 0.0000 m to \
         the left of its start and is turned by -0.00020 rad"
    );
    // In place, but turned by a quarter: three quarters of a circle and a line of its radius twice.
    let (turn, line) = (
        Segment::Arc {
            length: 30.0 * PI,
            curvature: 0.05,
        },
        Segment::Line { length: 20.0 },
    );
    let corner = Road::closed(Pose::default(), &[line, turn, line], 2, 3.5).unwrap_err();
    let RoadError::Open { turned, .. } = corner else {
        panic!("{corner}");
    };
    assert_near(turned, -FRAC_PI_2, 1e-12, "turned");
    let straight = Road::closed(Pose::default(), &[line], 2, 3.5).unwrap_err();
    assert!(matches!(straight, RoadError::Open { ahead, .. } if ahead == 20.0));
}

#[test]
fn law_laps_repeat_and_headings_count() {
    for sign in [1.0, -1.0] {
        let road = circle(200.0 * PI, sign * 0.01).unwrap();
        let lap = road.lap().unwrap();
        assert_eq!(lap, road.length());
        for i in -40..40 {
            let s = 13.7 * f64::from(i);
            let place = |s| Frenet { s, d: 2.5 };
            for laps in [-2.0, 1.0, 3.0] {
                let (here, there) = (
                    road.world_from_road(place(s)),
                    road.world_from_road(place(s + laps * lap)),
                );
                assert_near(there.x, here.x, 1e-9, "x");
                assert_near(there.y, here.y, 1e-9, "y");
                assert_near(
                    there.heading,
                    here.heading + laps * sign * TAU,
                    1e-9,
                    "heading",
                );
                assert_eq!(there.heading, road.heading(s + laps * lap));
            }
            // Nothing jumps where laps meet.
            let rate = road.heading(s + 1e-3) - road.heading(s - 1e-3);
            assert_near(rate, sign * 2e-5, 1e-12, "heading'");
            assert_eq!(road.curvature(s), sign * 0.01);
        }
        // A lane 3 m to the left is 6 π shorter in a lap to the left.
        let length = road.lane_length(-100.0, 3.0 * lap - 100.0, 3.0);
        assert_near(length, 3.0 * (lap - sign * 3.0 * TAU), 1e-9, "length");
        assert!(!road.is_straight());
    }
    assert_eq!(Road::straight(100.0, 1, 3.5).unwrap().lap(), None);
}

#[test]
fn law_the_way_round_is_the_shorter_one() {
    let road = circle(200.0 * PI, 0.01).unwrap();
    let lap = road.length();
    for i in -30..30 {
        for j in -30..30 {
            let (from, to) = (61.0 * f64::from(i), 47.0 * f64::from(j));
            let way = road.ahead(from, to);
            assert!(way.abs() <= lap / 2.0 + 1e-9);
            let laps = (to - from - way) / lap;
            assert_near(laps, laps.round(), 1e-9, "whole laps");
            let near = road.nearest_lap(to, from);
            assert_near(near - from, way, 1e-9, "nearest lap");
        }
    }
    let line = Road::straight(100.0, 1, 3.5).unwrap();
    assert_eq!(line.ahead(90.0, -2_000.0), -2_090.0);
    assert_eq!(line.nearest_lap(90.0, -2_000.0), 90.0);
}

#[test]
fn hand_a_straight_of_a_ring_ends_with_its_lap() {
    let (line, bend) = (
        Segment::Line { length: 100.0 },
        Segment::Arc {
            length: 30.0 * PI,
            curvature: 1.0 / 30.0,
        },
    );
    let road = Road::closed(Pose::default(), &[bend, line, bend, line], 2, 3.5).unwrap();
    let half = 100.0 + 30.0 * PI;
    let ends = [half - 1.0, 2.0 * half - 1.0, 3.0 * half - 1.0, -1.0];
    let until = ends.map(|s| road.straight_until(s).unwrap());
    for (until, end) in until.into_iter().zip(ends) {
        assert_near(until, end + 1.0, 1e-9, "until");
    }
    assert_eq!(road.straight_until(2.0 * half + 1.0), None);
}
