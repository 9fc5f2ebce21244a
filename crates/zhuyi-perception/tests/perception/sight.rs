//! Angular widths and occlusion.

use crate::rig::{CAR, body, camera, scene};
use parry2d::math::{Pose as Pose2, Vector};
use parry2d::query::{Ray, RayCast};
use parry2d::shape::Cuboid;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{PI, TAU};
use zhuyi_core::{ActorId, Camera, Footprint, Pose, Scene};
use zhuyi_perception::{View, visible_share};

fn shares(camera: &Camera, scene: &Scene) -> Vec<f64> {
    (0..scene.actors.len())
        .map(|index| visible_share(camera, scene, ActorId(index as u32)))
        .collect()
}

fn sees(camera: &Camera, scene: &Scene, actor: usize) -> bool {
    let mut view = View::default();
    view.look(camera, scene);
    view.sees(actor, 0.5)
}

#[test]
fn hand_a_car_right_behind_another_is_hidden() {
    // Half widths atan(1/8) and atan(1/18).
    assert_eq!(
        shares(
            &camera(0.0, 120.0),
            &scene(vec![body(20.0, 0.0, 0.0), body(10.0, 0.0, 0.0)])
        ),
        [0.0, 1.0]
    );
}

#[test]
fn regress_a_wide_field_sees_what_reaches_into_it_over_its_back() {
    // All but 45 degrees behind are in view. A car 10 to 14 m behind there comes in where its side is 10 tan(22.5 degrees)
    // = 4.142 m to the left or the right.
    let wide = camera(0.0, 315.0);
    for (y, seen) in [(3.1, false), (3.2, true), (-3.1, false), (-3.2, true)] {
        let mut view = View::default();
        view.look(&wide, &scene(vec![body(-12.0, y, 0.0)]));
        assert_eq!(view.sees(0, 0.0), seen, "{y}");
        assert_eq!(view.share(0) > 0.0, seen, "{y}");
    }
}

#[test]
fn hand_half_a_car_appears_where_its_bisector_meets_the_corner_of_the_one_before_it() {
    // The lead's rear left corner is at (8, 1). Behind it a car at (20, y) spans from atan((y-1)/22), its front right
    // corner, to atan((y+1)/18). The bisector lies on the lead's corner when the sum of both is 2 atan(1/8), of
    // tangent 16/63: 63 (40 y + 4) = 16 (397 - y²), y = (√6 740 800 - 2520) / 32.
    let y = (6_740_800_f64.sqrt() - 2520.0) / 32.0;
    let shifted = |y: f64| scene(vec![body(20.0, y, 0.0), body(10.0, 0.0, 0.0)]);
    let front = camera(0.0, 120.0);
    assert!((shares(&front, &shifted(y))[0] - 0.5).abs() < 1e-12);
    assert!(sees(&front, &shifted(y + 1e-6), 0));
    assert!(!sees(&front, &shifted(y - 1e-6), 0));
    assert!((shares(&front, &shifted(-y))[0] - 0.5).abs() < 1e-12);
}

#[test]
fn hand_a_long_lorry_alongside_does_not_hide_the_car_before_it() {
    // The lorry's nearest point is 4 m away, the car's 8.06 m, yet every ray that meets both meets the car first.
    let mut lorry = body(20.0, 5.25, 0.0);
    lorry.footprint = Footprint {
        length: 40.0,
        width: 2.5,
    };
    let both = scene(vec![lorry, body(10.0, 2.0, 0.0)]);
    let shares = shares(&camera(0.0, 180.0), &both);
    assert_eq!(shares[1], 1.0);
    // The car spans atan(1/12) to atan(3/8), the lorry from atan(4/40) on: of its quarter turn left in view
    // atan(4/40)..π/2 the car hides all below atan(3/8); the lorry goes on to the right angle exactly.
    let lorry = (PI / 2.0, 0.1_f64.atan(), 0.375_f64.atan());
    assert!(
        (shares[0] - (lorry.0 - lorry.2) / (lorry.0 - lorry.1)).abs() < 1e-12,
        "{}",
        shares[0]
    );
}

#[test]
fn hand_overlapping_shadows_count_once() {
    // Two leads one behind the other hide the right half of a car at (20, 0): both fill the angles below 0.
    let mut near = body(8.0, -2.0, 0.0);
    let mut mid = body(13.0, -3.0, 0.0);
    near.footprint.width = 4.0;
    mid.footprint.width = 6.0;
    let shares = shares(
        &camera(0.0, 120.0),
        &scene(vec![body(20.0, 0.0, 0.0), near, mid]),
    );
    assert!((shares[0] - 0.5).abs() < 1e-12, "{}", shares[0]);
}

#[test]
fn hand_the_edge_of_the_field_of_view_cuts_a_body_in_half() {
    // A car at bearing 60° and heading 60°, so that its box is symmetric about the edge of a field of 120°.
    let mut car = body(0.0, 0.0, 0.0);
    let (sin, cos) = (PI / 3.0).sin_cos();
    car.pose = Pose::new(20.0 * cos, 20.0 * sin, PI / 3.0);
    let cut = scene(vec![car]);
    assert!((shares(&camera(0.0, 120.0), &cut)[0] - 0.5).abs() < 1e-12);
    assert!(sees(&camera(0.0, 120.1), &cut, 0));
    assert!(!sees(&camera(0.0, 119.9), &cut, 0));
}

#[test]
fn hand_a_body_that_fills_the_picture_is_seen() {
    // A car 0.2 m before a camera of 60° spans 2 atan(1/0.2) = 157°.
    assert!((shares(&camera(0.0, 60.0), &scene(vec![body(2.2, 0.0, 0.0)]))[0] - 1.0).abs() < 1e-12);
}

#[test]
fn hand_the_view_behind_has_no_seam() {
    let behind = scene(vec![
        body(-10.0, 0.0, 0.0),
        body(-20.0, 0.0, 0.0),
        body(-20.0, 20.0, 0.0),
    ]);
    for camera in [
        camera(180.0, 90.0),
        camera(-180.0, 90.0),
        camera(0.0, 360.0),
        camera(90.0, 360.0),
    ] {
        let shares = shares(&camera, &behind);
        assert!((shares[0] - 1.0).abs() < 1e-12, "{shares:?}");
        assert!(shares[1].abs() < 1e-12, "{shares:?}");
    }
    // All round but for 6° behind: the car at -10 m spans 2 atan(1/8) and shows on both sides of the gap.
    let width = 2.0 * 0.125_f64.atan();
    let wanted = (width - 6_f64.to_radians()) / width;
    assert!((shares(&camera(0.0, 354.0), &behind)[0] - wanted).abs() < 1e-12);
}

#[test]
fn hand_range_is_to_the_nearest_point() {
    let front = camera(0.0, 120.0);
    assert!(sees(&front, &scene(vec![body(102.0, 0.0, 0.0)]), 0));
    assert!(!sees(&front, &scene(vec![body(102.001, 0.0, 0.0)]), 0));
}

#[test]
fn hand_what_is_out_of_view_is_not_seen_whatever_the_share_asked_for() {
    let mut view = View::default();
    view.look_at_boxes(
        &camera(0.0, 120.0),
        Pose::default(),
        [(CAR, Pose::new(-10.0, 0.0, 0.0))],
    );
    assert!(!view.sees(0, 0.0));
}

#[test]
fn hand_a_camera_inside_a_box_sees_that_box_alone() {
    let inside = scene(vec![body(1.0, 0.0, 0.0), body(20.0, 0.0, 0.0)]);
    let shares = shares(&camera(0.0, 120.0), &inside);
    assert!(
        (shares[0] - 1.0).abs() < 1e-12 && shares[1] == 0.0,
        "{shares:?}"
    );
}

#[test]
fn law_shares_agree_with_a_fan_of_rays() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut partly, mut compared) = (0, 0);
    for _ in 0..400 {
        let eye = Camera {
            fov: rng.random_range(0.5..TAU),
            ..camera(rng.random_range(-180.0..180.0), 0.0)
        };
        let scene = random_scene(&mut rng);
        for (index, share) in shares(&eye, &scene).into_iter().enumerate() {
            let (reference, resolution) = fan(&eye, &scene, index);
            assert!(
                (share - reference).abs() < 4.0 * resolution,
                "{share} and by rays {reference} in {scene:?}"
            );
            compared += 1;
            partly += u32::from((0.02..0.98).contains(&share));
        }
    }
    assert!(
        compared > 1000 && partly > 200,
        "{partly} of {compared} are partly visible"
    );
}

/// Disjoint boxes around an ego whose cameras are in none of them.
fn random_scene(rng: &mut ChaCha8Rng) -> Scene {
    let mut scene = scene(Vec::new());
    scene.ego.pose.heading = rng.random_range(-PI..PI);
    for _ in 0..8 {
        let mut car = body(0.0, 0.0, 0.0);
        let mut between = |from, to| rng.random_range(from..to);
        car.footprint = Footprint {
            length: between(1.0, 12.0),
            width: between(0.5, 3.0),
        };
        car.pose = Pose::new(between(-25.0, 25.0), between(-25.0, 25.0), between(-PI, PI));
        let apart = |pose: Pose, radius: f64| {
            let (x, y) = (pose.x - car.pose.x, pose.y - car.pose.y);
            x.hypot(y) > radius + car.footprint.radius()
        };
        if apart(scene.ego.pose, 0.1)
            && scene
                .actors
                .iter()
                .all(|other| apart(other.pose, other.footprint.radius()))
        {
            scene.actors.push(car);
        }
    }
    scene
}

/// A body's visible share by counting rays, and the share that one ray stands for.
fn fan(eye: &Camera, scene: &Scene, which: usize) -> (f64, f64) {
    const RAYS: u32 = 2000;
    let from = eye.pose(scene.ego.pose);
    let body = &scene.actors[which];
    let (x, y) = (body.pose.x - from.x, body.pose.y - from.y);
    let (towards, half) = (y.atan2(x), (body.footprint.radius() / x.hypot(y)).asin());
    let step = 2.0 * half / f64::from(RAYS);
    let (mut width, mut visible) = (0.0, 0.0);
    for ray in 0..RAYS {
        let angle = towards - half + (f64::from(ray) + 0.5) * step;
        let Some(distance) = cast(from, angle, body.footprint, body.pose) else {
            continue;
        };
        width += 1.0;
        let axis = angle - from.heading;
        let in_view = axis.sin().atan2(axis.cos()).abs() <= eye.fov / 2.0;
        let hidden = scene.actors.iter().enumerate().any(|(index, other)| {
            index != which
                && cast(from, angle, other.footprint, other.pose)
                    .is_some_and(|other| other < distance)
        });
        visible += f64::from(in_view && !hidden);
    }
    let whole = f64::min(width, eye.fov / step);
    (visible / whole, 1.0 / whole)
}

fn cast(from: Pose, angle: f64, footprint: Footprint, pose: Pose) -> Option<f32> {
    let (sin, cos) = angle.sin_cos();
    let ray = Ray::new(
        Vector::new(from.x as f32, from.y as f32),
        Vector::new(cos as f32, sin as f32),
    );
    let at = Pose2::new(
        Vector::new(pose.x as f32, pose.y as f32),
        pose.heading as f32,
    );
    let half = Vector::new(footprint.length as f32 / 2.0, footprint.width as f32 / 2.0);
    Cuboid::new(half).cast_ray(&at, &ray, 1000.0, true)
}
