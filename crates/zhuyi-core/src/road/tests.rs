//! Evidence for the road: values worked by hand and published, round trips, derivatives, the nearest point by brute force.

mod apart;
mod near;
mod rings;

use super::*;
use crate::Point;
use std::f64::consts::{FRAC_PI_2, PI};

/// A road with every kind of join: line to arc with a step of curvature, clothoids in and out, an S-curve, two lines
/// in a row, a clothoid that changes sides, ends that are not lines where `bare`.
fn winding(bare: bool) -> Road {
    let mut segments = vec![
        Segment::Clothoid {
            length: 60.0,
            start: 0.0,
            end: 0.02,
        },
        Segment::Arc {
            length: 40.0,
            curvature: 0.02,
        },
        Segment::Clothoid {
            length: 90.0,
            start: 0.02,
            end: -0.03,
        },
        Segment::Arc {
            length: 20.0,
            curvature: -0.03,
        },
        Segment::Clothoid {
            length: 45.0,
            start: -0.03,
            end: 0.0,
        },
        Segment::Line { length: 30.0 },
        Segment::Line { length: 10.0 },
        Segment::Arc {
            length: 50.0,
            curvature: 0.01,
        },
        Segment::Arc {
            length: 50.0,
            curvature: -1e-9,
        },
    ];
    if !bare {
        segments.insert(0, Segment::Line { length: 80.0 });
        segments.push(Segment::Line { length: 20.0 });
    }
    Road::new(Pose::new(-30.0, 12.0, 0.7), &segments, 3, 3.5).unwrap()
}

fn assert_near(got: f64, want: f64, tolerance: f64, what: &str) {
    assert!(
        (got - want).abs() <= tolerance,
        "{what}: got {got}, want {want}"
    );
}

#[test]
fn hand_quarter_circle_to_the_right() {
    // Radius 100 m, heading north; the centre of the circle is at (110, 20).
    let quarter = Segment::Arc {
        length: 50.0 * PI,
        curvature: -0.01,
    };
    let road = Road::new(Pose::new(10.0, 20.0, FRAC_PI_2), &[quarter], 2, 4.0).unwrap();
    let end = road.world_from_road(Frenet {
        s: 50.0 * PI,
        d: 0.0,
    });
    assert_near(end.x, 110.0, 1e-12, "x");
    assert_near(end.y, 120.0, 1e-12, "y");
    assert_near(end.heading, 0.0, 1e-15, "heading");
    // Half way, 4 m inside: 96 m from the centre, at 135 degrees.
    let inside = road.world_from_road(Frenet {
        s: 25.0 * PI,
        d: -4.0,
    });
    assert_near(inside.x, 110.0 - 96.0 * 0.5_f64.sqrt(), 1e-12, "x");
    assert_near(inside.y, 20.0 + 96.0 * 0.5_f64.sqrt(), 1e-12, "y");
    // Past the end, straight east; before the start, straight north.
    let beyond = road.world_from_road(Frenet {
        s: 50.0 * PI + 7.0,
        d: 1.0,
    });
    assert_near(beyond.x, 117.0, 1e-12, "x");
    assert_near(beyond.y, 121.0, 1e-12, "y");
    let before = road.road_from_world(Point::new(12.0, 5.0));
    assert_near(before.s, -15.0, 1e-12, "s");
    assert_near(before.d, -2.0, 1e-12, "d");
}

#[test]
fn paper_clothoid_against_published_fresnel_integrals() {
    // Abramowitz & Stegun, table 7.7: C(t), S(t). With κ = π s/a², p(s) = a (C(s/a), S(s/a)).
    let a = 100.0;
    let road = Road::new(
        Pose::default(),
        &[Segment::Clothoid {
            length: a,
            start: 0.0,
            end: PI / a,
        }],
        2,
        3.5,
    )
    .unwrap();
    for (t, c, s) in [
        (0.5, 0.492_344_225_871_4, 0.064_732_432_859_7),
        (0.8, 0.722_844_171_896_6, 0.249_341_393_053_8),
        (1.0, 0.779_893_400_376_8, 0.438_259_147_390_4),
    ] {
        let pose = road.world_from_road(Frenet { s: a * t, d: 0.0 });
        assert_near(pose.x, a * c, 1e-10, "a C(t)");
        assert_near(pose.y, a * s, 1e-10, "a S(t)");
        assert_near(pose.heading, FRAC_PI_2 * t * t, 1e-14, "heading");
    }
}

#[test]
fn hand_lanes_from_the_right() {
    let road = Road::straight(100.0, 4, 3.0).unwrap();
    let centers = [1, 2, 3, 4].map(|n| road.lane_center(Lane(n)));
    assert_eq!(centers, [-4.5, -1.5, 1.5, 4.5]);
    for (n, center) in (1..).zip(centers) {
        assert_eq!(road.lane_at(center), Some(Lane(n)));
        assert_eq!(road.lane_at(center + 1.499), Some(Lane(n)));
        assert_eq!(
            road.lane_at(center - 1.5),
            Some(Lane(n)),
            "a line between lanes belongs to the left one"
        );
    }
    assert_eq!(road.lane_at(6.0), None);
    assert_eq!(road.lane_at(-6.001), None);
    assert_eq!(road.lane_at(f64::NAN), None);
}

#[test]
fn law_round_trip_from_the_road() {
    for road in [
        winding(false),
        winding(true),
        Road::straight(300.0, 3, 3.5).unwrap(),
    ] {
        for i in 0..=2_000 {
            let s = -50.0 + (road.length() + 100.0) * f64::from(i) / 2_000.0;
            for d in [-5.25, -3.5, -0.01, 0.0, 1.7, 5.25] {
                let back = road.road_from_world(road.world_from_road(Frenet { s, d }).point());
                assert_near(back.s, s, 1e-9, "s");
                assert_near(back.d, d, 1e-9, "d");
            }
        }
    }
}

#[test]
fn law_round_trip_from_the_world() {
    // Any point of the plane is `d` to the side of its nearest point of the line, on the road or far from it.
    for road in [winding(false), winding(true)] {
        for i in 0..60 {
            for j in 0..60 {
                let point = Point::new(-200.0 + 10.3 * f64::from(i), -250.0 + 10.7 * f64::from(j));
                let back = road.world_from_road(road.road_from_world(point));
                assert_near(back.x, point.x, 1e-9, "x");
                assert_near(back.y, point.y, 1e-9, "y");
            }
        }
    }
}

#[test]
fn law_nearest_point_is_the_nearest_of_all() {
    // Besides the winding road an S that curls up: points with two minima on one clothoid.
    let curl = Segment::Clothoid {
        length: 100.0,
        start: 0.12,
        end: -0.045,
    };
    let curled = Road::new(Pose::new(0.0, 0.0, 0.7), &[curl], 3, 3.5).unwrap();
    for (road, corner, step) in [
        (winding(true), (-100.0, -150.0), 10.3),
        (curled, (-60.0, -60.0), 3.1),
    ] {
        let line: Vec<Pose> = (-2_000..=6_000)
            .map(|i| {
                road.world_from_road(Frenet {
                    s: f64::from(i) * 0.1,
                    d: 0.0,
                })
            })
            .collect();
        for i in 0..40 {
            for j in 0..40 {
                let point = Point::new(
                    corner.0 + step * f64::from(i),
                    corner.1 + step * f64::from(j),
                );
                let mut scanned = f64::INFINITY;
                for on in &line {
                    let distance = (point.x - on.x).hypot(point.y - on.y);
                    if distance < scanned {
                        scanned = distance;
                    }
                }
                let found = road.road_from_world(point).d.abs();
                // The scan's step of 0.1 m is off the foot by at most 0.05 m.
                assert!(
                    found <= scanned + 1e-9 && found >= scanned - 0.05,
                    "{point:?}: {found} m away, a scan finds {scanned} m"
                );
            }
        }
    }
}

#[test]
fn law_nearest_point_at_the_centre_of_curvature() {
    // There D'' = 0: the hardest case of the search. Half way along the clothoid κ = 0.01.
    let road = Road::new(
        Pose::default(),
        &[Segment::Clothoid {
            length: 100.0,
            start: 0.0,
            end: 0.02,
        }],
        1,
        3.0,
    )
    .unwrap();
    let centre = road.world_from_road(Frenet { s: 50.0, d: 100.0 }).point();
    let found = road.road_from_world(centre);
    // Nearest is not s = 50 but a place further on, where the curve is tighter than the circle around this centre.
    let back = road.world_from_road(found);
    assert_near(back.x, centre.x, 1e-9, "x");
    assert_near(back.y, centre.y, 1e-9, "y");
    assert!(found.d < 100.0 && found.s > 50.0, "{found:?}");
}

#[test]
fn law_heading_is_the_derivative_of_position() {
    let road = winding(false);
    let h = 1e-4;
    for i in 0..4_000 {
        let s = -20.0 + (road.length() + 40.0) * f64::from(i) / 4_000.0;
        let (a, b) = (
            road.world_from_road(Frenet { s: s - h, d: 0.0 }),
            road.world_from_road(Frenet { s: s + h, d: 0.0 }),
        );
        let (sin, cos) = road.heading(s).sin_cos();
        assert_near((b.x - a.x) / (2.0 * h), cos, 1e-8, "x'");
        assert_near((b.y - a.y) / (2.0 * h), sin, 1e-8, "y'");
        assert_eq!(
            road.world_from_road(Frenet { s, d: 2.0 }).heading,
            road.heading(s)
        );
    }
}

#[test]
fn law_curvature_is_the_derivative_of_heading_and_as_given() {
    let road = winding(false);
    let h = 1e-3;
    let joins = [80.0, 140.0, 180.0, 270.0, 290.0, 335.0, 375.0, 425.0, 475.0];
    for i in 0..4_000 {
        let s = -20.0 + (road.length() + 40.0) * f64::from(i) / 4_000.0;
        if joins.iter().all(|join| (s - join).abs() > 2.0 * h) {
            assert_near(
                (road.heading(s + h) - road.heading(s - h)) / (2.0 * h),
                road.curvature(s),
                1e-10,
                "heading'",
            );
        }
    }
    // Continuous where clothoids join their neighbours, a step where the arc of 0.01 begins without one.
    for join in &joins[..6] {
        assert_near(
            road.curvature(join + 1e-9),
            road.curvature(join - 1e-9),
            1e-11,
            "curvature",
        );
    }
    assert_eq!(
        (road.curvature(375.0 - 1e-9), road.curvature(375.0)),
        (0.0, 0.01)
    );
}

#[test]
fn law_the_length_of_a_lane_is_that_of_its_curve_in_the_world() {
    // Summed over chords of 5 mm, whose sag leaves 1e-9 of the length out.
    let road = winding(false);
    for d in [-5.25, -1.0, 0.0, 3.5] {
        for (from, to) in [
            (-30.0, 500.0),
            (60.0, 150.0),
            (179.0, 181.0),
            (230.0, 460.0),
        ] {
            let steps = ((to - from) / 0.005) as u32;
            let at = |i: u32| {
                let s = from + (to - from) * f64::from(i) / f64::from(steps);
                road.world_from_road(Frenet { s, d })
            };
            let chords = (0..steps).map(|i| (at(i), at(i + 1)));
            let scanned: f64 = chords.map(|(a, b)| (b.x - a.x).hypot(b.y - a.y)).sum();
            assert_near(road.lane_length(from, to, d), scanned, 1e-6, "length");
            assert_near(road.lane_length(to, from, d), -scanned, 1e-6, "length back");
        }
    }
    let h = 1e-3;
    let (before, after) = (100.0 - h, 100.0 + h);
    let rate = road.lane_length(before, after, 3.0) / (2.0 * h);
    assert_near(road.lane_rate(100.0, 3.0), rate, 1e-9, "rate");
    let straight = Road::straight(300.0, 3, 3.5).unwrap();
    assert!(straight.is_straight() && !road.is_straight());
    assert_eq!(straight.lane_length(-10.0, 320.0, 3.5), 330.0);
}

#[test]
fn law_an_almost_straight_arc_is_straight() {
    for curvature in [1e-300, -1e-15, 1e-12] {
        let almost = Road::new(
            Pose::default(),
            &[Segment::Arc {
                length: 1_000.0,
                curvature,
            }],
            3,
            3.5,
        )
        .unwrap();
        let place = almost.road_from_world(Point::new(700.0, 2.0));
        assert_near(place.s, 700.0, 1e-8, "s");
        assert_near(place.d, 2.0, 1e-6, "d");
    }
}

#[test]
fn law_a_mirrored_road_gives_mirrored_places() {
    let curve = |sign: f64| {
        let segments = [
            Segment::Clothoid {
                length: 70.0,
                start: 0.0,
                end: sign * 0.025,
            },
            Segment::Arc {
                length: 30.0,
                curvature: sign * 0.025,
            },
        ];
        Road::new(Pose::default(), &segments, 3, 3.5).unwrap()
    };
    let (left, right) = (curve(1.0), curve(-1.0));
    for i in 0..100 {
        let place = Frenet {
            s: 1.3 * f64::from(i) - 10.0,
            d: 4.0,
        };
        let (a, b) = (
            left.world_from_road(place),
            right.world_from_road(Frenet {
                d: -place.d,
                ..place
            }),
        );
        assert_eq!((a.x, a.y, a.heading), (b.x, -b.y, -b.heading));
        let (a, b) = (
            left.road_from_world(a.point()),
            right.road_from_world(b.point()),
        );
        assert_eq!((a.s, a.d), (b.s, -b.d));
    }
}

#[test]
fn hand_rules_for_roads() {
    let start = Pose::default();
    let line = Segment::Line { length: 10.0 };
    let error =
        |segments: &[Segment], lanes, width| Road::new(start, segments, lanes, width).unwrap_err();
    assert_eq!(error(&[], 3, 3.5), RoadError::NoSegments);
    assert_eq!(error(&[line], 0, 3.5), RoadError::Lanes { got: 0 });
    assert_eq!(error(&[line], 13, 3.5), RoadError::Lanes { got: 13 });
    for width in [0.0, -1.0, 10.1, f64::INFINITY] {
        assert_eq!(
            error(&[line], 3, width),
            RoadError::LaneWidth { got: width }
        );
    }
    assert!(matches!(error(&[line], 3, f64::NAN), RoadError::LaneWidth { got } if got.is_nan()));
    for length in [0.0, -5.0, 2e6, f64::INFINITY] {
        assert_eq!(
            error(&[line, Segment::Line { length }], 3, 3.5),
            RoadError::Length {
                segment: 1,
                got: length
            }
        );
    }
    let nan = Segment::Clothoid {
        length: 10.0,
        start: 0.0,
        end: f64::NAN,
    };
    assert!(
        matches!(error(&[nan], 3, 3.5), RoadError::Curvature { segment: 0, got, .. } if got.is_nan())
    );
    // Two lanes of 4 m: the inner edge lies 4 m from the middle.
    let sharp = |curvature| {
        [Segment::Arc {
            length: 1.0,
            curvature,
        }]
    };
    assert_eq!(
        error(&sharp(-0.25), 2, 4.0),
        RoadError::Curvature {
            segment: 0,
            got: -0.25,
            below: 0.25
        }
    );
    assert!(Road::new(start, &sharp(0.249), 2, 4.0).is_ok());
    let turns = Segment::Clothoid {
        length: 1_000.0,
        start: 0.01,
        end: -0.03,
    };
    assert_eq!(
        error(&[turns], 2, 4.0),
        RoadError::Turn {
            segment: 0,
            got: 12.5
        }
    );
    let circle = Segment::Arc {
        length: 40.0 * PI,
        curvature: 0.05,
    };
    assert!(Road::closed(start, &[circle], 2, 4.0).is_ok());
    let nowhere = Road::new(Pose::new(f64::NAN, 0.0, 0.0), &[line], 2, 4.0).unwrap_err();
    assert!(matches!(nowhere, RoadError::Start { .. }));
    assert_eq!(
        error(&sharp(0.3), 2, 4.0).to_string(),
        "curvature stays below 1/m 0.25 in magnitude, where the inner edge of the road meets its centre, got 0.3"
    );
}
