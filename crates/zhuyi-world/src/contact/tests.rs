//! Evidence for contact: cases worked by hand, a dense scan in `f64`, symmetry.

use super::*;
use std::f64::consts::{FRAC_PI_2, PI};

const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};

fn motion(from: (f64, f64, f64), to: (f64, f64, f64)) -> Motion {
    let pose = |(x, y, heading)| Pose::new(x, y, heading);
    Motion {
        footprint: CAR,
        from: pose(from),
        to: pose(to),
    }
}

fn standing(x: f64, y: f64, heading: f64) -> Motion {
    motion((x, y, heading), (x, y, heading))
}

fn contact(ego: &Motion, other: Motion) -> Option<Contact> {
    first_contact(ego, std::iter::once((ActorId(7), other)))
}

fn assert_touch(ego: &Motion, other: Motion, fraction: f64, side: Side) {
    let contact =
        contact(ego, other).unwrap_or_else(|| panic!("no contact of {ego:?} with {other:?}"));
    assert_eq!(
        (contact.actor, contact.side),
        (ActorId(7), side),
        "{ego:?} with {other:?}"
    );
    assert!(
        (contact.fraction - fraction).abs() < 2e-6,
        "{} instead of {fraction}",
        contact.fraction
    );
}

#[test]
fn hand_head_on() {
    // 20 m between centres, 16 m between bumpers, each covers 10 m: they touch after 0.8 of the step.
    let ego = motion((0.0, 0.0, 0.0), (10.0, 0.0, 0.0));
    assert_touch(
        &ego,
        motion((20.0, 0.3, PI), (10.0, 0.3, PI)),
        0.8,
        Side::Front,
    );
}

#[test]
fn hand_the_ego_runs_into_a_slower_lead() {
    let ego = motion((0.0, 0.0, 0.0), (0.3, 0.0, 0.0));
    assert_touch(
        &ego,
        motion((4.1, 1.5, 0.0), (4.2, 1.5, 0.0)),
        0.5,
        Side::Front,
    );
}

#[test]
fn hand_an_actor_runs_into_the_ego() {
    let ego = motion((0.0, 0.0, 0.0), (0.1, 0.0, 0.0));
    assert_touch(
        &ego,
        motion((-4.1, -1.0, 0.0), (-3.8, -1.0, 0.0)),
        0.5,
        Side::Rear,
    );
}

#[test]
fn hand_side_swipe_while_changing_lane() {
    // Side by side, 0.4 m between the flanks, the ego moves 0.8 m to the left.
    let ego = motion((0.0, 0.0, 0.0), (3.0, 0.8, 0.0));
    assert_touch(
        &ego,
        motion((0.5, 2.4, 0.0), (3.5, 2.4, 0.0)),
        0.5,
        Side::Left,
    );
    // The same to the right with both slightly turned into the change: flank on corner.
    let ego = motion((0.0, 0.0, -0.05), (3.0, -0.8, -0.05));
    let found = contact(&ego, motion((0.5, -2.4, 0.0), (3.5, -2.4, 0.0))).unwrap();
    assert_eq!(found.side, Side::Right);
}

#[test]
fn hand_crossing_traffic() {
    // A car from the left at right angles into the ego's flank: 3.5 m to go with its half length and our half width.
    let ego = standing(0.0, 0.0, 0.0);
    assert_touch(
        &ego,
        motion((0.0, 6.5, -FRAC_PI_2), (0.0, -0.5, -FRAC_PI_2)),
        0.5,
        Side::Left,
    );
    // The ego into the flank of a crossing one: its front.
    let ego = motion((0.0, 0.0, 0.0), (2.0, 0.0, 0.0));
    assert_touch(&ego, standing(4.0, 0.5, FRAC_PI_2), 0.5, Side::Front);
}

#[test]
fn hand_corners() {
    // The ego's front left corner into the rear of a car askew by 0.1 rad: front, the normal is 0.1 rad off ahead.
    let ego = motion((0.0, 0.0, 0.0), (2.0, 0.0, 0.0));
    let found = contact(&ego, standing(4.5, 1.5, -0.1)).unwrap();
    assert_eq!(found.side, Side::Front);
    // Its front left corner into the flank of a car that noses in from the left: left.
    let ego = motion((0.0, 0.0, 0.0), (0.5, 0.0, 0.0));
    let found = contact(&ego, motion((2.0, 2.35, -0.1), (2.4, 1.9, -0.1))).unwrap();
    assert_eq!(found.side, Side::Left);
    // Corner on corner, exactly: the faster approach decides.
    let ego = standing(0.0, 0.0, 0.0);
    assert_touch(
        &ego,
        motion((5.0, 2.5, 0.0), (3.0, 1.5, 0.0)),
        0.5,
        Side::Front,
    );
    assert_touch(
        &ego,
        motion((4.5, 3.0, 0.0), (3.5, 1.0, 0.0)),
        0.5,
        Side::Left,
    );
    assert_touch(
        &ego,
        motion((-5.0, -2.5, 0.0), (-3.0, -1.5, 0.0)),
        0.5,
        Side::Rear,
    );
    assert_touch(
        &ego,
        motion((-4.5, -3.0, 0.0), (-3.5, -1.0, 0.0)),
        0.5,
        Side::Right,
    );
}

#[test]
fn hand_a_near_miss_is_none() {
    // 1 cm between the flanks, at any speed; and through a gap between two cars.
    for distance in [0.3, 10.0, 300.0] {
        let ego = motion((0.0, 0.0, 0.0), (distance, 0.0, 0.0));
        assert_eq!(contact(&ego, standing(distance / 2.0, 2.01, 0.0)), None);
        assert_eq!(contact(&ego, standing(distance / 2.0, -2.01, PI)), None);
        assert_eq!(contact(&ego, standing(distance + 4.01, 0.0, 0.0)), None);
    }
    // The same while both turn by 1 mrad, on a road that leads north-east.
    let ego = motion((100.0, 100.0, 0.7), (100.2, 100.2, 0.701));
    let beside = Pose::new(100.0, 100.0, 0.7).offset(0.0, 2.01);
    let other = motion(
        (beside.x, beside.y, 0.7),
        (beside.x + 0.2, beside.y + 0.2, 0.701),
    );
    assert_eq!(contact(&ego, other), None);
}

#[test]
fn hand_turning_alone_touches() {
    // The corner of a box that turns by 0.1 rad swings out from 1 to 2 sin 0.1 + cos 0.1 = 1.195 m.
    let ego = motion((0.0, 0.0, 0.0), (0.0, 0.0, 0.1));
    let found = contact(&ego, standing(0.0, 2.19, 0.0)).unwrap();
    assert_eq!(found.side, Side::Left);
    assert!(found.fraction > 0.9, "{found:?}");
    assert_eq!(contact(&ego, standing(0.0, 2.2, 0.0)), None);
}

#[test]
fn hand_bodies_that_overlap_without_moving_touch() {
    let ego = standing(0.0, 0.0, 0.0);
    assert_eq!(
        contact(&ego, standing(3.9, 0.0, 0.0)).unwrap().side,
        Side::Front
    );
    assert_eq!(
        contact(&ego, standing(0.5, -1.9, 0.0)).unwrap().side,
        Side::Right
    );
}

#[test]
fn regress_boxes_that_part_from_an_overlap_touch_at_the_start() {
    // A standing lorry's corner 3.2 mm in the rear of an ego that leaves it at 27 m/s in a bend.
    let lorry = Footprint {
        length: 12.0,
        width: 2.55,
    };
    let car = Footprint {
        length: 4.8,
        width: 1.9,
    };
    let (there, here) = (
        Pose::new(0.0, 0.0, 0.050_374_6),
        Pose::new(8.388_803, 0.433_564, 0.052_911_3),
    );
    let ego = Motion {
        footprint: car,
        from: here,
        to: Pose::new(here.x + 0.2742, here.y + 0.0145, here.heading + 2e-4),
    };
    let standing = Motion {
        footprint: lorry,
        from: there,
        to: there,
    };
    let (along, across) = overlap((car, here), (lorry, there)).unwrap();
    assert!(
        (along - 0.003_2).abs() < 1e-4 && across > 2.2,
        "{along} {across}"
    );
    let found = contact(&ego, standing).unwrap();
    assert_eq!((found.fraction, found.side), (0.0, Side::Rear));
}

#[test]
fn law_no_tunnelling() {
    // A closing speed of 1,000 m/s, steps of 10 ms, then much more; a motorcycle's width across; turning or not.
    let thin = Footprint {
        length: 0.5,
        width: 0.1,
    };
    for closing in [1_000.0, 10_000.0, 1_000_000.0] {
        for turn in [0.0, 0.02, -0.3] {
            for place in 1..50 {
                let reach = closing * 0.01;
                let ego = motion((0.0, 0.0, 0.0), (0.0, 0.0, turn));
                let start = 2.25 + reach * f64::from(place) / 50.0;
                let other = Motion {
                    footprint: thin,
                    from: Pose::new(start, 0.2, 0.0),
                    to: Pose::new(start - reach, 0.2, turn),
                };
                let found =
                    contact(&ego, other).unwrap_or_else(|| panic!("tunnelled from {start} m"));
                assert_eq!(found.side, Side::Front);
                assert!(
                    (found.fraction - f64::from(place) / 50.0).abs() < 0.03 * 10.0 / reach + 1e-3
                );
            }
        }
    }
}

/// Numbers in [-1, 1), the same ones every time (Knuth's linear congruential generator).
pub(super) fn numbers() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A random pair near each other; every other one without turning.
fn pair(random: &mut impl FnMut() -> f64, turning: bool) -> (Motion, Motion) {
    let turn = if turning { 0.05 } else { 0.0 };
    let heading = PI * random();
    let ego = motion(
        (50.0, -20.0, heading),
        (50.0 + random(), -20.0 + random(), heading + turn * random()),
    );
    let from = Pose::new(50.0 + 7.0 * random(), -20.0 + 7.0 * random(), PI * random());
    let to = Pose::new(
        from.x + 4.0 * random(),
        from.y + 4.0 * random(),
        from.heading + turn * random(),
    );
    let footprint = Footprint {
        length: 3.0 + 2.0 * random(),
        width: 1.5 + random(),
    };
    (
        ego,
        Motion {
            footprint,
            from,
            to,
        },
    )
}

/// [m] the widest gap along an axis: negative when the boxes overlap.
pub(super) fn gap(ego: &Motion, other: &Motion, fraction: f64) -> f64 {
    let (here, there) = (ego.at(fraction), other.at(fraction));
    let centre = here.local(there.point());
    let mut widest = f64::NEG_INFINITY;
    for axis in axes(ego.footprint, other.footprint, there.heading - here.heading) {
        let gap = axis.along(centre).abs() - axis.reach;
        if gap > widest {
            widest = gap;
        }
    }
    widest
}

#[test]
fn law_agrees_with_a_dense_scan() {
    const TOLERANCE: f64 = 2e-5;
    let mut random = numbers();
    let (mut touches, mut misses) = (0, 0);
    for case in 0..4_000 {
        let (ego, other) = pair(&mut random, case % 2 == 1);
        let scanned = (0..=1_000)
            .map(|i| f64::from(i) / 1_000.0)
            .find(|f| gap(&ego, &other, *f) < -TOLERANCE);
        let found = contact(&ego, other);
        match (scanned, found) {
            (Some(scanned), Some(found)) => {
                touches += 1;
                assert!(
                    found.fraction <= scanned,
                    "{found:?} after {scanned}: {ego:?} {other:?}"
                );
                if found.fraction > 0.0 {
                    let gap = gap(&ego, &other, found.fraction);
                    assert!(
                        gap.abs() < TOLERANCE,
                        "{gap} m at {found:?}: {ego:?} {other:?}"
                    );
                }
            }
            (Some(scanned), None) => panic!("missed the touch at {scanned}: {ego:?} {other:?}"),
            (None, Some(found)) => {
                let gap = gap(&ego, &other, found.fraction);
                assert!(gap < TOLERANCE, "{gap} m at {found:?}: {ego:?} {other:?}");
            }
            (None, None) => misses += 1,
        }
    }
    assert!(
        touches > 1_000 && misses > 1_000,
        "{touches} touches, {misses} misses"
    );
}

#[test]
fn law_mirrored_motion_gives_the_mirrored_side() {
    let mirror = |m: Motion| {
        let pose = |p: Pose| Pose::new(p.x, -p.y, -p.heading);
        Motion {
            from: pose(m.from),
            to: pose(m.to),
            ..m
        }
    };
    let mut random = numbers();
    let mut seen = [0; 4];
    for case in 0..2_000 {
        let (ego, other) = pair(&mut random, case % 2 == 1);
        let (Some(found), Some(mirrored)) =
            (contact(&ego, other), contact(&mirror(ego), mirror(other)))
        else {
            continue;
        };
        assert!((found.fraction - mirrored.fraction).abs() < 1e-4);
        seen[found.side as usize] += 1;
        let expected = match found.side {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
            same => same,
        };
        assert_eq!(mirrored.side, expected, "{ego:?} {other:?}");
    }
    assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
}

#[test]
fn law_the_first_of_several_counts() {
    let ego = motion((0.0, 0.0, 0.0), (10.0, 0.0, 0.0));
    let others = [(2, 9.0), (0, 7.0), (1, 7.0), (3, 20.0)]
        .map(|(id, x)| (ActorId(id), standing(x, 0.0, 0.0)));
    let found = first_contact(&ego, others.into_iter()).unwrap();
    assert_eq!(found.actor, ActorId(0));
}
