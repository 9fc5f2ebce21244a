use super::{Ahead, Path};
use rand::RngExt;
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
use std::f64::consts::FRAC_PI_2;
use zhuyi_core::{Point, Pose};

/// A path of a vehicle that always moves.
fn path(poses: &[Pose]) -> Path {
    Path::new(poses.iter().map(|pose| (*pose, 1.0)))
}

fn from(path: &Path, row: usize) -> Ahead<'_> {
    path.from(row).unwrap()
}

/// s from the first row on, d and the heading of the path at the foot of a point.
fn seen(ahead: &Ahead<'_>, x: f64, y: f64) -> (f64, f64, f64) {
    let foot = ahead.foot(Point::new(x, y), None);
    let s = foot.s + ahead.path.length();
    (s, foot.d, foot.direction.1.atan2(foot.direction.0))
}

fn close(got: (f64, f64, f64), expected: (f64, f64, f64)) {
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let all = near(got.0, expected.0) && near(got.1, expected.1) && near(got.2, expected.2);
    assert!(all, "{got:?}, expected {expected:?}");
}

#[test]
fn hand_a_straight_path_goes_on_at_both_ends() {
    let poses: Vec<Pose> = (0..6).map(|x| Pose::new(f64::from(x), 0.0, 0.0)).collect();
    let path = path(&poses);
    let ahead = from(&path, 2);
    // s counts back from the end of the path.
    assert_eq!((ahead.s(), path.length()), (-3.0, 5.0));
    close(seen(&ahead, 3.5, 2.0), (3.5, 2.0, 0.0));
    close(seen(&ahead, 40.0, -1.0), (40.0, -1.0, 0.0));
    // Behind the ego at t_0.
    close(seen(&ahead, -3.0, 0.5), (-3.0, 0.5, 0.0));
    // 10 m/s at 60 degrees to the path.
    let (along, across) = ahead
        .foot(Point::new(3.0, 1.0), None)
        .along_across(10.0, 1.0_f64.acos() + 60_f64.to_radians());
    assert!((along - 5.0).abs() < 1e-12 && (across - 75_f64.sqrt()).abs() < 1e-12);
}

/// From the corner on the path leads north; what lies west of it was passed on the way, but not from t_0 on.
#[test]
fn hand_the_past_does_not_count() {
    let corner = [
        (0.0, 0.0, 0.0),
        (10.0, 0.0, 0.0),
        (20.0, 0.0, FRAC_PI_2),
        (20.0, 10.0, FRAC_PI_2),
        (20.0, 20.0, FRAC_PI_2),
    ];
    let poses = corner.map(|(x, y, heading)| Pose::new(x, y, heading));
    let path = path(&poses);
    close(seen(&from(&path, 0), 5.0, -1.0), (5.0, -1.0, 0.0));
    // Straight back from (20, 0) heading north: 1 m behind, 15 m to the left.
    close(seen(&from(&path, 2), 5.0, -1.0), (19.0, 15.0, FRAC_PI_2));
}

/// Round a square of 20 m and back past the start: a follower 10 m behind at t_0 and 2 m aside is nearer to the line on
/// which the ego came than to the last leg, which will pass 5 m aside of it.
#[test]
fn hand_who_follows_before_a_loop_is_behind() {
    let mut poses = Vec::new();
    let legs = [
        (0.0, 0.0, 0.0),
        (20.0, 0.0, 1.0),
        (20.0, 20.0, 2.0),
        (-20.0, 20.0, 3.0),
    ];
    for (x, y, quarters) in legs {
        let start = Pose::new(x, y, quarters * FRAC_PI_2);
        let length = if quarters == 2.0 { 40 } else { 20 };
        poses.extend((0..length).map(|step| {
            let point = start.offset(f64::from(step), 0.0);
            Pose::new(point.x, point.y, start.heading)
        }));
    }
    poses.extend((0..30).map(|step| Pose::new(-20.0 + f64::from(step), -3.0, 0.0)));
    let path = path(&poses);
    let ahead = from(&path, 0);
    close(seen(&ahead, -10.0, 2.0), (-10.0, 2.0, 0.0));
    // On the other side of that line the last leg is nearer, and counts.
    assert!(seen(&ahead, -10.0, -2.5).0 > 90.0);
    // What holds from the first row on does not hold here.
    let later = from(&path, 5);
    let foot = ahead.foot(Point::new(-10.0, -2.5), None);
    assert!(later.shares(&foot, Point::new(-10.0, -2.5)));
    assert!(!later.shares(&foot, Point::new(-10.0, 0.1)));
}

#[test]
fn hand_corners() {
    let corner = [(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 10.0, FRAC_PI_2)];
    let poses = corner.map(|(x, y, heading)| Pose::new(x, y, heading));
    let path = path(&poses);
    let ahead = from(&path, 0);
    // Outside, 3 m east and 4 m south of the corner: 5 m to the right, the path heads square to that.
    close(seen(&ahead, 13.0, -4.0), (10.0, -5.0, 3.0_f64.atan2(4.0)));
    // Inside the nearer leg counts.
    close(seen(&ahead, 8.0, 1.0), (8.0, 1.0, 0.0));
    close(seen(&ahead, 9.0, 2.0), (12.0, 1.0, FRAC_PI_2));
    // On both equally near the first.
    close(seen(&ahead, 8.0, 2.0), (8.0, 2.0, 0.0));
}

/// The rows that the path from one on runs through.
fn kept(path: &Path, row: usize) -> Vec<usize> {
    let next = |row: &usize| (!path.chain.is_root(*row)).then(|| path.chain.at(*row).next);
    std::iter::successors(Some(row), next).collect()
}

/// A quarter circle of 50 m radius in 90 legs: a chord strays from it by 50 (1 - cos 0.5 degrees) = 1.9 mm.
#[test]
fn hand_an_arc() {
    let radius = 50.0;
    let pose = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Pose::new(radius * sin, radius * (1.0 - cos), degrees.to_radians())
    };
    let poses: Vec<Pose> = (0..=90).map(|step| pose(f64::from(step))).collect();
    let path = path(&poses);
    let ahead = from(&path, 10);
    for degrees in [12.3, 45.0, 89.5] {
        for left in [-20.0, 0.0, 5.0, 30.0] {
            let point = pose(degrees).offset(0.0, left);
            let (s, d, heading) = seen(&ahead, point.x, point.y);
            let arc = radius * f64::to_radians(degrees);
            // Beside it a foot runs ahead on a leg and waits at a corner, by at most half a leg, 0.44 m, per radius.
            let slack = 0.01 + 0.44 * left.abs() / (radius - left.max(0.0));
            assert!(
                (s - arc).abs() < slack && (d - left).abs() < 0.002,
                "{degrees} {left}: {s} {d}"
            );
            assert!(
                (heading - degrees.to_radians()).abs() < 0.01,
                "{degrees} {left}: {heading}"
            );
        }
    }
    // Straight on behind its end.
    let point = pose(90.0).offset(25.0, 3.0);
    close(
        seen(&ahead, point.x, point.y),
        (path.length() + 25.0, 3.0, FRAC_PI_2),
    );
}

/// It stands, jittering by some centimetres and to all sides, drives 20 m and stands again.
#[test]
fn hand_a_standing_vehicle_has_no_path_of_its_jitter() {
    let mut draws = ChaCha8Rng::seed_from_u64(2);
    let mut jitter = |x: f64| {
        Pose::new(
            x + draws.random_range(-0.1..0.1),
            draws.random_range(-0.1..0.1),
            0.0,
        )
    };
    let xs = (0..50)
        .map(|_| 0.0)
        .chain((0..20).map(f64::from))
        .chain((0..50).map(|_| 20.0));
    let poses: Vec<Pose> = xs.map(&mut jitter).collect();
    let path = path(&poses);
    assert!(path.length() < 22.0, "{}", path.length());
    for (row, pose) in poses.iter().enumerate().take(70) {
        // A car 10 m ahead of where it will be stays where it is, whatever t_0.
        let ahead = from(&path, row);
        let foot = ahead.foot(Point::new(30.0, 3.5), None);
        assert!(
            (foot.s - ahead.s() - (30.0 - pose.x)).abs() < 1.0 && (foot.d - 3.5).abs() < 0.2,
            "{row} {foot:?}"
        );
    }
    assert!(path.from(75).is_none() && path.from(119).is_none());
}

#[test]
fn law_the_foot_is_the_nearest_point_from_whatever_hint() {
    let mut draws = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..300 {
        let (mut pose, mut poses) = (Pose::default(), Vec::new());
        let turn = draws.random_range(-0.1..0.1);
        for _ in 0..draws.random_range(3..80) {
            poses.push(pose);
            let ahead = pose.offset(draws.random_range(0.1..3.0), 0.0);
            pose = Pose::new(
                ahead.x,
                ahead.y,
                pose.heading + turn + draws.random_range(-0.3..0.3),
            );
        }
        let path = path(&poses);
        let row = draws.random_range(0..poses.len() - 1);
        let Some(ahead) = path.from(row) else {
            continue;
        };
        for _ in 0..20 {
            let point = Point::new(
                draws.random_range(-60.0..100.0),
                draws.random_range(-60.0..60.0),
            );
            let foot = ahead.foot(point, None);
            let hint = draws.random_range(-20.0..120.0);
            assert_eq!(ahead.foot(point, Some(hint)), foot);
            // No recorded position ahead, and none of the straight beyond, is nearer.
            let kept = kept(&path, row);
            let end = path.chain.at(kept[kept.len() - 1]).point;
            let (cos, sin) = ahead.end;
            let beyond = (0..50)
                .map(f64::from)
                .map(|metres| Point::new(end.x + metres * cos, end.y + metres * sin));
            let later = kept.iter().map(|place| path.chain.at(*place).point);
            for other in later.chain(beyond).chain([poses[row].point()]) {
                let distance = (other.x - point.x).hypot(other.y - point.y);
                assert!(
                    foot.d.abs() <= distance + 1e-9,
                    "{point:?} {foot:?} {distance}"
                );
            }
        }
    }
}
