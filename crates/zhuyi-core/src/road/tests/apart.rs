//! Roads that come closer to themselves than they are wide, by hand and against a scan of all pairs of places.

use super::*;
use std::f64::consts::TAU;

fn line(length: f64) -> Segment {
    Segment::Line { length }
}

fn arc(length: f64, curvature: f64) -> Segment {
    Segment::Arc { length, curvature }
}

/// Two lanes of 3.5 m: 7 m wide.
fn lay(segments: &[Segment]) -> Result<Road, RoadError> {
    Road::new(Pose::default(), segments, 2, 3.5)
}

#[test]
fn hand_a_circle_is_a_ring_or_nothing() {
    let circle = arc(200.0 * PI, 0.01);
    let error = lay(&[circle]).unwrap_err();
    let RoadError::Itself { segments, lap, .. } = error else {
        panic!("{error}");
    };
    assert_eq!((segments, lap), ([0, 0], Some(200.0 * PI)));
    // The ends of nearly a circle: 3.5 % of it, 22 m of arc, are left out.
    assert!(lay(&[arc(193.0 * PI, 0.01)]).is_ok());
    assert!(Road::closed(Pose::default(), &[circle], 2, 3.5).is_ok());
}

#[test]
fn regress_three_arcs_of_500_m_on_one_circle_name_the_lap() {
    let error = Road::new(Pose::default(), &[arc(500.0, 0.01); 3], 1, 3.5).unwrap_err();
    let text = error.to_string();
    let RoadError::Itself { s, apart, lap, .. } = error else {
        panic!("{text}");
    };
    assert_near(lap.unwrap(), 200.0 * PI, 1e-9, "lap");
    assert!(s[1] - s[0] > 600.0 && apart < 3.5, "{text}");
    assert!(
        text.contains(
            "it comes back to its start at 628.319 m: a ring is one lap with `closed: true`"
        ),
        "{text}"
    );
}

#[test]
fn hand_a_road_that_crosses_itself() {
    // 200 m east, three quarters of a circle of 30 m radius to the left, then south across (170, 0).
    let turn = arc(45.0 * PI, 1.0 / 30.0);
    let crossing = lay(&[line(200.0), turn, line(60.0)]).unwrap_err();
    let RoadError::Itself { segments, .. } = crossing else {
        panic!("{crossing}");
    };
    assert_eq!(segments, [0, 2]);
    // Its end keeps half a width away from the paving, which is as far from the middle again.
    assert!(lay(&[line(200.0), turn, line(22.9)]).is_ok());
    assert!(lay(&[line(200.0), turn, line(23.1)]).is_err());
}

#[test]
fn hand_a_hairpin_needs_the_width_of_the_road() {
    // Legs 7.2 m apart beside each other, 7 m wide.
    let hairpin = [line(500.0), arc(3.6 * PI, 1.0 / 3.6), line(500.0)];
    assert!(lay(&hairpin).is_ok());
    // Legs 8 m apart that close in by 0.02 m per metre: 7.1 m apart after 45 m, 6.9 m after 55 m.
    let closing = |leg| lay(&[line(100.0), arc(4.0 * (PI + 0.02), 0.25), line(leg)]);
    assert!(closing(45.0).is_ok());
    let error = closing(55.0).unwrap_err();
    let RoadError::Itself {
        segments,
        s,
        apart,
        lap,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!((segments, lap), ([0, 2], None));
    assert!(s[1] > 100.0 + 4.0 * PI + 50.0 && apart > 6.88, "{error}");
}

#[test]
fn hand_long_roads_are_looked_at_at_once() {
    // A spiral of 1,000 km clothoids, and a serpentine of 400 legs of 1,000 km that come back beside each other.
    let tighter = |i: u32| 5e-6 * f64::from(i);
    let spiral: Vec<Segment> = (0..12)
        .map(|i| Segment::Clothoid {
            length: 1e6,
            start: tighter(i) / 12.0,
            end: tighter(i + 1) / 12.0,
        })
        .collect();
    assert!(lay(&spiral).is_ok());
    let legs = (0..400).flat_map(|i| {
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        [line(1e6), arc(3.6 * PI, side / 3.6)]
    });
    assert!(lay(&legs.collect::<Vec<_>>()).is_ok());
    // Two thirds of a turn of 150 km radius, back beside itself 7.001 m further out, and 0.01 m too near.
    let beside = |gap: f64| {
        let (inner, outer) = (150_000.0, 150_000.0 + gap);
        let back = arc(gap / 2.0 * PI, -2.0 / gap);
        lay(&[
            arc(6e5, -1.0 / outer),
            back,
            arc(6e5 * inner / outer, 1.0 / inner),
        ])
    };
    assert!(beside(7.001).is_ok());
    assert!(matches!(
        beside(7.0 - 0.01),
        Err(RoadError::Curvature { .. })
    ));
}

/// Numbers in 0..1, the same ones each time.
fn draws(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn drawn(seed: u64) -> Vec<Segment> {
    let mut draw = draws(seed);
    let count = 2 + (draw() * 6.0) as usize;
    let mut curvature = 0.0;
    (0..count)
        .map(|_| {
            let length = 5.0 + 60.0 * draw();
            let bend = (draw() - 0.35) * 0.22;
            match (draw() * 3.0) as u8 {
                0 => line(length),
                1 => arc(length, bend),
                _ => {
                    let start = curvature;
                    curvature = bend;
                    Segment::Clothoid {
                        length,
                        start,
                        end: bend,
                    }
                }
            }
        })
        .collect()
}

/// [rad] how far the line has turned, and its points, every 0.1 m.
fn scan(road: &Road) -> Vec<(f64, Point)> {
    let mut turned = 0.0;
    let steps = (road.length() / 0.1) as u32;
    (0..=steps)
        .map(|i| {
            let s = road.length() * f64::from(i) / f64::from(steps);
            let here = (turned, road.world_from_road(Frenet { s, d: 0.0 }).point());
            turned += road.curvature(s).abs() * road.length() / f64::from(steps);
            here
        })
        .collect()
}

#[test]
fn law_a_scan_of_all_pairs_finds_the_same() {
    let (mut refused, mut accepted) = (0, 0);
    for seed in 0..400 {
        let segments = drawn(seed);
        let wide = Road::new(Pose::default(), &segments, 1, 5.0);
        if let Err(RoadError::Curvature { .. } | RoadError::Turn { .. }) = wide {
            continue;
        }
        // The same line without the rule.
        let thin = Road {
            length: segments.iter().map(|segment| segment.parts().0).sum(),
            pieces: lay_out(Pose::default(), &segments, false),
            ..Road::straight(1.0, 1, 5.0).unwrap()
        };
        let points = scan(&thin);
        let mut least = f64::INFINITY;
        for (i, (turned, a)) in points.iter().enumerate() {
            for (later, b) in points[i..].iter().rev() {
                if later - turned <= PI {
                    break;
                }
                least = least.min((b.x - a.x).hypot(b.y - a.y));
            }
        }
        match wide {
            // The scan misses the least distance by at most its step, and its sum of turns by a thousandth.
            Ok(_) => {
                accepted += 1;
                assert!(least > 5.0 - 2e-3, "{seed}: accepted, but {least} m apart");
            }
            Err(RoadError::Itself { s, apart, .. }) => {
                refused += 1;
                let [a, b] = s.map(|s| thin.world_from_road(Frenet { s, d: 0.0 }));
                assert_near(apart, (b.x - a.x).hypot(b.y - a.y), 1e-12, "apart");
                assert!(apart < 5.0 && s[0] < s[1], "{seed}: {s:?} {apart}");
                assert!(least < 5.0 + 0.1, "{seed}: refused, but {least} m apart");
            }
            Err(error) => panic!("{seed}: {error}"),
        }
    }
    assert!(refused > 50 && accepted > 50, "{refused} {accepted}");
}

#[test]
fn law_a_ring_is_looked_at_round_its_seam() {
    // A stadium whose straights are 8 m apart, with its seam anywhere: fine 7 m wide, not 9 m wide.
    let bend = arc(4.0 * PI, 0.25);
    for seam in [1.0, 25.0, 49.0] {
        let stadium = [line(seam), bend, line(50.0), bend, line(50.0 - seam)];
        let lay = |lane_width| Road::closed(Pose::default(), &stadium, 2, lane_width);
        assert!(lay(3.5).is_ok(), "{seam}");
        assert!(matches!(lay(4.5), Err(RoadError::Curvature { .. })));
    }
    // A peanut: two lobes of 20 m radius, and two counter-bends of 20 m that leave a waist between them. Centres of a lobe
    // and a counter-bend are 40 m apart, b = 10 m + waist/2 + 10 m of it to the side.
    let peanut = |waist: f64| {
        let tilt = ((20.0 + waist / 2.0) / 40.0_f64).asin();
        let lobe = arc(20.0 * 2.0 * (PI - tilt), 0.05);
        let counter = arc(20.0 * (PI - 2.0 * tilt), -0.05);
        Road::closed(Pose::default(), &[lobe, counter, lobe, counter], 2, 3.5)
    };
    assert!(peanut(7.1).is_ok());
    let error = peanut(6.9).unwrap_err();
    let RoadError::Itself {
        segments, apart, ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(segments == [1, 3] && apart > 6.89, "{error}");
    let eight = [arc(20.0 * TAU, 0.05), arc(20.0 * TAU, -0.05)];
    let error = Road::closed(Pose::default(), &eight, 2, 3.5).unwrap_err();
    assert!(matches!(error, RoadError::Itself { .. }), "{error}");
}
