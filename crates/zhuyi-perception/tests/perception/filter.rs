//! The Kalman filter.
//!
//! Its normalised errors are sums of squares of as many standard normal numbers as the state (3) or a measurement (2)
//! has entries: mean n, variance 2 n. The bounds are four standard deviations of the mean over all runs.

use crate::rig::{World, body, eye, millis, perception, scene};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Scene, SimTime};
use zhuyi_perception::axis::{Axis, FIRST_ACCEL_DEVIATION, Measurement};
use zhuyi_perception::normal;
use zhuyi_perception::{Errors, Eye, Perception};

const NOISE: (f64, f64) = (0.1, 0.05);
const JERK_DENSITY: f64 = 2.0;

fn normal(rng: &mut ChaCha8Rng) -> f64 {
    normal::normal(rng.random())
}

fn measure(truth: &Vector3<f64>, rng: &mut ChaCha8Rng) -> Measurement {
    Measurement {
        position: truth[0] + NOISE.0 * normal(rng),
        speed: truth[1] + NOISE.1 * normal(rng),
        position_deviation: NOISE.0,
        speed_deviation: NOISE.1,
    }
}

/// The square of the normalised innovation of a measurement, by the covariance of both entries at once.
fn innovation(axis: &Axis, measured: &Measurement) -> f64 {
    let difference = Vector2::new(
        measured.position - axis.mean[0],
        measured.speed - axis.mean[1],
    );
    let noise = Matrix2::from_diagonal(&Vector2::new(NOISE.0.powi(2), NOISE.1.powi(2)));
    let covariance: Matrix2<f64> = axis.covariance.fixed_view::<2, 2>(0, 0) + noise;
    (difference.transpose() * covariance.try_inverse().unwrap_or_default() * difference)[0]
}

/// A motion whose acceleration jumps when a frame interval begins and then holds.
fn wander(truth: Vector3<f64>, time: f64, rng: &mut ChaCha8Rng) -> Vector3<f64> {
    let [p, v, mut a]: [f64; 3] = truth.into();
    a += (JERK_DENSITY * time).sqrt() * normal(rng);
    Vector3::new(p + v * time + a * time * time / 2.0, v + a * time, a)
}

/// Tracks 400 random motions at a rate: the mean of the squared normalised error at the end, and of the innovations.
fn consistency(hz: f64) -> (f64, f64) {
    const RUNS: u32 = 400;
    const FRAMES: u32 = 30;
    let mut rng = ChaCha8Rng::seed_from_u64(7);

    let (mut errors, mut innovations) = (0.0, 0.0);
    for _ in 0..RUNS {
        let mut truth = Vector3::new(50.0, 20.0, FIRST_ACCEL_DEVIATION * normal(&mut rng));
        let mut axis = Axis::start(&measure(&truth, &mut rng));
        for _ in 0..FRAMES {
            truth = wander(truth, 1.0 / hz, &mut rng);
            axis = axis.predict(1.0 / hz, JERK_DENSITY);
            let measured = measure(&truth, &mut rng);
            innovations += innovation(&axis, &measured) / f64::from(RUNS * FRAMES);
            axis.measure(&measured);
        }
        let error = axis.mean - truth;
        let inverse = axis.covariance.try_inverse().unwrap_or_default();
        errors += (error.transpose() * inverse * error)[0] / f64::from(RUNS);
    }
    (errors, innovations)
}

#[test]
fn law_errors_are_as_large_as_the_covariance_says() {
    for hz in [1.0, 5.0, 30.0] {
        let (errors, innovations) = consistency(hz);
        assert!(
            (errors - 3.0).abs() < 4.0 * (6.0_f64 / 400.0).sqrt(),
            "squared error {errors} at {hz} Hz"
        );
        assert!(
            (innovations - 2.0).abs() < 4.0 * (4.0_f64 / 12_000.0).sqrt(),
            "innovation {innovations} at {hz} Hz"
        );
    }
}

#[test]
fn law_the_covariance_stays_symmetric_and_positive() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let truth = Vector3::new(10.0, 5.0, 0.0);
    let mut axis = Axis::start(&measure(&truth, &mut rng));
    for step in 0..20_000 {
        // between measurements of the same instant and a second
        let time = if step % 3 == 0 {
            0.0
        } else {
            rng.random::<f64>().powi(8)
        };
        axis = axis.predict(time, JERK_DENSITY);
        axis.measure(&measure(&truth, &mut rng));
        let asymmetry = (axis.covariance - axis.covariance.transpose()).abs().max();
        assert!(
            asymmetry <= 1e-12 * axis.covariance.max(),
            "asymmetry {asymmetry} after {step}"
        );
        assert!(
            axis.covariance.cholesky().is_some(),
            "not positive after {step}: {}",
            axis.covariance
        );
    }
}

#[test]
fn hand_one_update_weighs_by_variance() {
    // Prior and measurement equally sure: halfway, half the variance; the speed is known better (0.05 against 0.05).
    let seen = |position, speed| Measurement {
        position,
        speed,
        position_deviation: 0.1,
        speed_deviation: 0.05,
    };
    let mut axis = Axis::start(&seen(10.0, 4.0));
    axis.measure(&seen(11.0, 5.0));
    assert!((axis.mean - Vector3::new(10.5, 4.5, 0.0)).abs().max() < 1e-12);
    let wanted = Matrix3::from_diagonal(&Vector3::new(0.005, 0.001_25, 9.0));
    assert!((axis.covariance - wanted).abs().max() < 1e-12);
}

#[test]
fn law_without_noise_the_track_of_a_braking_car_is_the_car() {
    // 20 m/s, braking at 3 m/s2, at 10 Hz: after a second the believed state is the true one, and so is its future.
    let params = Perception {
        jerk_density_along: 20.0,
        ..perception(vec![eye(0.0, 120.0)])
    };
    let mut world = World::new(&params, &[10.0], 1, scene(vec![body(20.0, 2.0, 20.0)]));
    let truth = |at: SimTime| {
        let t = at.seconds();
        (20.0 + 20.0 * t - 1.5 * t * t, 20.0 - 3.0 * t, 2.0 + 0.5 * t)
    };
    let brake = |scene: &mut Scene| {
        let (s, speed, d) = truth(scene.time);
        scene.actors[0] = body(s, d, speed);
        scene.actors[0].d_rate = 0.5;
    };
    world.run(millis(3000), brake, |_, _| ());
    let track = world.tracker.tracks(millis(3000))[0];
    let (s, speed, d) = truth(millis(3000));
    assert!((track.s_accel + 3.0).abs() < 1e-3, "{track:?}");
    assert!(
        (track.road.s - s).abs() < 1e-3 && (track.s_rate - speed).abs() < 1e-3,
        "{track:?}"
    );
    assert!(
        (track.road.d - d).abs() < 1e-3 && (track.d_rate - 0.5).abs() < 1e-3,
        "{track:?}"
    );
    assert!(track.seen > millis(2799) && track.time == millis(3000));
}

#[test]
fn law_a_braking_car_is_never_believed_to_reverse() {
    // It stands after 2 s; with noise, at 1 Hz, whoever asks at any time hears of a speed of at least 0.
    let noisy = Perception {
        errors: Errors {
            noise_along: 0.1,
            noise_across: 0.05,
            noise_speed: 0.2,
            ..Errors::default()
        },
        ..perception(vec![Eye {
            latency: None,
            ..eye(0.0, 120.0)
        }])
    };
    let mut world = World::new(&noisy, &[1.0], 3, scene(vec![body(20.0, 0.0, 12.0)]));
    let brake = |scene: &mut Scene| {
        let t = scene.time.seconds().min(2.0);
        scene.actors[0] = body(20.0 + 12.0 * t - 3.0 * t * t, 0.0, 12.0 - 6.0 * t);
    };
    let mut to = SimTime::ZERO;
    while to < millis(15_000) {
        to += millis(10);
        world.run(to, brake, |_, _| ());
        let track = world.tracker.tracks(to)[0];
        assert!(track.s_rate >= 0.0, "{track:?}");
        if to >= millis(6000) {
            assert!(
                (track.road.s - 32.0).abs() < 4.0 * track.s_deviation,
                "{track:?}"
            );
        }
    }
}

#[test]
fn law_deviations_grow_while_nothing_is_seen() {
    let mut world = World::new(
        &perception(vec![eye(0.0, 120.0)]),
        &[10.0],
        1,
        scene(vec![body(30.0, 0.0, 10.0)]),
    );
    world.run(millis(500), |_| (), |_, _| ());
    let mut previous = (0.0, 0.0);
    for at in 50..100 {
        let track = world.tracker.tracks(millis(10 * at))[0];
        assert!(track.s_deviation > previous.0 && track.d_deviation > previous.1);
        previous = (track.s_deviation, track.d_deviation);
    }
}

#[test]
fn law_an_actor_is_carried_on_straight_across_the_road() {
    // It swerves with 1 m/s2 sideways; what is believed of the future has its last sideways speed alone.
    let mut world = World::new(
        &perception(vec![eye(0.0, 120.0)]),
        &[10.0],
        1,
        scene(vec![body(30.0, 0.0, 10.0)]),
    );
    let swerve = |scene: &mut Scene| {
        let t = scene.time.seconds();
        scene.actors[0] = body(30.0 + 10.0 * t, t * t / 2.0, 10.0);
        scene.actors[0].d_rate = t;
    };
    world.run(millis(1000), swerve, |_, _| ());
    let [at_once, later] = [1000, 3000].map(|at| world.tracker.tracks(millis(at))[0]);
    assert!(
        (at_once.d_rate - at_once.seen.seconds()).abs() < 1e-2,
        "{at_once:?}"
    );
    assert!(
        (later.road.d - at_once.road.d - 2.0 * at_once.d_rate).abs() < 1e-12,
        "{later:?}"
    );
}

#[test]
fn law_each_direction_has_its_own_jerk() {
    let deviations = |along: f64, across: f64| {
        let params = Perception {
            jerk_density_along: along,
            jerk_density_across: across,
            ..perception(vec![eye(0.0, 120.0)])
        };
        let mut world = World::new(&params, &[10.0], 1, scene(vec![body(30.0, 0.0, 10.0)]));
        let track = world.tracker.tracks(millis(1000))[0];
        (track.s_deviation, track.d_deviation)
    };
    let calm = deviations(0.0, 0.0);
    let (along, across) = (deviations(8.0, 0.0), deviations(0.0, 8.0));
    assert!(along.0 > calm.0 && along.1 == calm.1);
    assert!(across.0 == calm.0 && across.1 > calm.1);
    // A jump of variance 8 over 1 s adds 8 (1/2)^2 m2.
    assert!((along.0.powi(2) - calm.0.powi(2) - 2.0).abs() < 1e-12);
}
