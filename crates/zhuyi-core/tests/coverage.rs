//! Evidence for the coverage of cameras: boxes against fields of view of every width, as their points say.
#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use zhuyi_core::{Camera, Footprint, Point, Pose};

fn camera(yaw: f64, fov: f64, range: f64) -> Camera {
    Camera {
        name: String::new(),
        forward: 0.0,
        left: 0.0,
        yaw,
        fov,
        range,
        analysed: true,
    }
}

fn covers(camera: &Camera, (length, width): (f64, f64), pose: (f64, f64, f64)) -> bool {
    let (x, y, heading) = pose;
    camera.covers_box(
        Pose::default(),
        Footprint { length, width },
        Pose::new(x, y, heading),
    )
}

#[test]
fn hand_a_flank_fills_the_view() {
    // 25 m long, from 6.5 m behind to 18.5 m ahead, 1.75 m to the left: its corners are 75 and 85 degrees off the axis, its
    // centre 63.
    let truck = ((25.0, 2.5), (6.0, 3.0, 0.0));
    let left = camera(FRAC_PI_2, TAU / 3.0, 80.0);
    assert!(covers(&left, truck.0, truck.1));
    let right = camera(-FRAC_PI_2, TAU / 3.0, 80.0);
    assert!(!covers(&right, truck.0, truck.1));
    // In a range of 1.7 m it is not, in one of 1.8 m it is.
    assert!(!covers(
        &camera(FRAC_PI_2, TAU / 3.0, 1.7),
        truck.0,
        truck.1
    ));
    assert!(covers(&camera(FRAC_PI_2, TAU / 3.0, 1.8), truck.0, truck.1));
}

#[test]
fn hand_edges_at_the_border_and_the_arc() {
    let ahead = camera(0.0, FRAC_PI_2, 10.0);
    // A wall across, 4 m ahead, from 5 m to 25 m on the left: beyond the border, which is 4 m on the left there.
    assert!(!covers(&ahead, (0.2, 20.0), (4.0, 15.0, 0.0)));
    // From 3 m on.
    assert!(covers(&ahead, (0.2, 20.0), (4.0, 13.0, 0.0)));
    // A wide wall across, 9.9 and 10.1 m ahead.
    assert!(covers(&ahead, (0.1, 40.0), (9.95, 0.0, 0.0)));
    assert!(!covers(&ahead, (0.1, 40.0), (10.15, 0.0, 0.0)));
    // A wall along the back of the camera, and one around it.
    assert!(!covers(&ahead, (0.1, 40.0), (-0.1, 0.0, 0.0)));
    assert!(covers(&ahead, (0.3, 40.0), (-0.1, 0.0, 0.0)));
    // 270 degrees: only what is wholly in the quarter behind is not seen.
    let wide = camera(0.0, 1.5 * PI, 10.0);
    assert!(!covers(&wide, (2.0, 2.0), (-4.0, 0.0, 0.0)));
    assert!(covers(&wide, (2.0, 7.0), (-4.0, 0.0, 0.0)));
    assert!(covers(&wide, (2.0, 20.0), (-4.0, 11.0, 0.0)));
    // All around.
    let around = camera(0.0, TAU, 10.0);
    assert!(covers(&around, (2.0, 40.0), (-9.0, 0.0, 0.0)));
    assert!(!covers(&around, (2.0, 40.0), (-11.1, 0.0, 0.0)));
}

/// [m] distance of a point from the sector of a camera at the origin.
fn distance(camera: &Camera, point: Point) -> f64 {
    let (bearing, far) = (point.y.atan2(point.x), point.x.hypot(point.y));
    let off = (bearing - camera.yaw).rem_euclid(TAU);
    if off.min(TAU - off) <= camera.fov / 2.0 {
        return (far - camera.range).max(0.0);
    }
    let from_border = |side: f64| {
        let (sin, cos) = (camera.yaw + side * camera.fov / 2.0).sin_cos();
        let along = (point.x * cos + point.y * sin).clamp(0.0, camera.range);
        (point.x - along * cos).hypot(point.y - along * sin)
    };
    from_border(-1.0).min(from_border(1.0))
}

#[test]
fn law_a_box_is_covered_where_a_point_of_it_is() {
    const GRID: u32 = 40;
    // Numbers in [0, 1), the same ones every time (Knuth's linear congruential generator).
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut covered, mut between) = (0, 0);
    for case in 0..6_000 {
        let fov = [0.02 + 3.1 * random(), 0.02 + (TAU - 0.02) * random(), TAU][case % 12 / 5];
        let camera = camera(TAU * random() - PI, fov, 2.0 + 30.0 * random());
        let size = (1.0 + 24.0 * random(), 0.3 + 3.0 * random());
        let (x, y) = (50.0 * random() - 25.0, 50.0 * random() - 25.0);
        let pose = Pose::new(x, y, TAU * random());
        let spacing = size.0.hypot(size.1) / f64::from(GRID);
        let part = |k: u32| f64::from(k) / f64::from(GRID) - 0.5;
        let least = (0..=GRID)
            .flat_map(|i| (0..=GRID).map(move |j| (i, j)))
            .map(|(i, j)| distance(&camera, pose.offset(part(i) * size.0, part(j) * size.1)))
            .fold(f64::INFINITY, f64::min);
        let found = covers(&camera, size, (pose.x, pose.y, pose.heading));
        if found {
            assert!(
                least <= spacing,
                "{least} m off: {camera:?} {size:?} {pose:?}"
            );
            let corners = Footprint {
                length: size.0,
                width: size.1,
            }
            .corners(pose);
            let held = |point: Point| distance(&camera, point) == 0.0;
            covered += 1;
            between += u32::from(!held(pose.point()) && !corners.into_iter().any(held));
        } else {
            assert!(least > 0.0, "missed: {camera:?} {size:?} {pose:?}");
        }
    }
    assert!((1_000..5_000).contains(&covered), "{covered}");
    assert!(
        between > 100,
        "{between} with neither centre nor corner inside"
    );
}
