//! Random scenes with random faults: NaN, infinite and huge numbers, empty and unsorted lists, choices out of range.

use crate::scene::{CAR, Future, Scene};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use zhuyi_c::{
    Across, Aggregation, Along, Camera, Demand, Ego, Estimate, Extent, Pose, Sample, State, Status,
    zhuyi_params_default,
};

const SCENES: usize = 20_000;

/// Numbers at which arithmetic goes wrong, within the limits and beyond.
const ODD: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    1e13,
    1e12,
    -1e12,
    1e6,
    -1e6,
    1e-300,
    5e-324,
    0.0,
    -0.0,
    -1.0,
    f64::EPSILON,
];

fn futures(random: &mut ChaCha8Rng) -> Vec<Future> {
    let count = random.random_range(1..4);
    (0..count)
        .map(|_| {
            let pieces = random.random_range(1..6);
            let (mut along, mut across) = (Vec::new(), Vec::new());
            let (mut time, mut s, mut v) = (
                random.random_range(-3.0..1.0),
                random.random_range(-20.0..80.0),
                random.random_range(-2.0..30.0),
            );
            for _ in 0..pieces {
                let accel: f64 = random.random_range(-8.0..3.0);
                along.push(Along {
                    time,
                    s,
                    s_rate: v,
                    s_half_accel: accel / 2.0,
                    v,
                    v_rate: accel,
                });
                across.push(Across {
                    time,
                    d: random.random_range(-5.0..5.0),
                    d_rate: random.random_range(-2.0..2.0),
                });
                let step: f64 = random.random_range(0.0..2.0);
                s += step * (v + step * accel / 2.0);
                v += step * accel;
                time += step;
            }
            let turns = random.random_range(0..3);
            let extents = (0..turns).map(|piece| Extent {
                time: f64::from(piece),
                along: random.random_range(0.9..6.0),
                along_rate: 0.0,
                across: random.random_range(0.9..6.0),
                across_rate: random.random_range(0.0..0.5),
            });
            let extents = extents.collect();
            Future {
                weight: random.random_range(0.01..1.0),
                along,
                across,
                extents,
                known_until: time,
            }
        })
        .collect()
}

fn scene(random: &mut ChaCha8Rng) -> Scene {
    let mut params = zhuyi_params_default();
    params.solver = random.random_range(0..2);
    params.criterion = random.random_range(0..2);
    params.aggregation = random.random_range(0..3);
    params.grid = random.random_range(0..3);
    let mut time = 0.0;
    let samples = (0..random.random_range(1..5))
        .map(|_| {
            time += random.random_range(0.01..1.0);
            Sample {
                time,
                s: random.random_range(0.0..100.0),
                d: random.random_range(-5.0..5.0),
                v: random.random_range(0.0..30.0),
            }
        })
        .collect();
    let cameras = (0..random.random_range(1..4))
        .map(|_| Camera {
            forward: 1.8,
            left: 0.0,
            yaw: random.random_range(-3.0..3.0),
            fov: random.random_range(0.5..3.0),
            range: 100.0,
            current_latency: random.random_range(0.03..1.0),
        })
        .collect();
    Scene {
        params,
        ego: Ego {
            s: 0.0,
            d: random.random_range(-1.0..1.0),
            speed: random.random_range(0.0..40.0),
            accel: random.random_range(-6.0..3.0),
            footprint: CAR,
        },
        pose: Pose {
            x: 0.0,
            y: 0.0,
            heading: random.random_range(-3.0..3.0),
        },
        actor: CAR,
        futures: futures(random),
        samples,
        cameras,
        now: random.random_range(0.0..2.0),
        current_latency: random.random_range(0.03..1.0),
    }
}

/// Every number of the scene.
fn numbers(scene: &mut Scene) -> Vec<&mut f64> {
    let (params, ego) = (&mut scene.params, &mut scene.ego);
    let mut all = vec![
        &mut params.c1,
        &mut params.c2,
        &mut params.c3,
        &mut params.c4,
        &mut params.horizon,
        &mut params.lateral_margin,
        &mut params.percentile,
        &mut ego.s,
        &mut ego.d,
        &mut ego.speed,
        &mut ego.accel,
        &mut ego.footprint.length,
        &mut ego.footprint.width,
        &mut scene.pose.x,
        &mut scene.pose.y,
        &mut scene.pose.heading,
        &mut scene.actor.length,
        &mut scene.actor.width,
        &mut scene.now,
        &mut scene.current_latency,
    ];
    for future in &mut scene.futures {
        all.extend([&mut future.weight, &mut future.known_until]);
        for piece in &mut future.along {
            all.extend([&mut piece.time, &mut piece.s, &mut piece.s_rate]);
            all.extend([&mut piece.s_half_accel, &mut piece.v, &mut piece.v_rate]);
        }
        for piece in &mut future.across {
            all.extend([&mut piece.time, &mut piece.d, &mut piece.d_rate]);
        }
        for piece in &mut future.extents {
            all.extend([&mut piece.time, &mut piece.along, &mut piece.along_rate]);
            all.extend([&mut piece.across, &mut piece.across_rate]);
        }
    }
    for sample in &mut scene.samples {
        all.extend([&mut sample.time, &mut sample.s]);
        all.extend([&mut sample.d, &mut sample.v]);
    }
    for camera in &mut scene.cameras {
        all.extend([&mut camera.forward, &mut camera.left, &mut camera.yaw]);
        all.extend([
            &mut camera.fov,
            &mut camera.range,
            &mut camera.current_latency,
        ]);
    }
    all
}

fn break_somewhere(scene: &mut Scene, random: &mut ChaCha8Rng) {
    match random.random_range(0..12) {
        0 => scene.futures.clear(),
        1 => scene.futures[0].along.clear(),
        2 => scene.futures[0].across.clear(),
        3 => scene.samples.clear(),
        4 => scene.cameras.clear(),
        5 => scene.samples.reverse(),
        6 => {
            scene.futures[0].along.reverse();
            scene.futures[0].extents.reverse();
        }
        7 => scene.params.grid = random.random(),
        8 => scene.params.max_steps = random.random(),
        _ => {
            let mut all = numbers(scene);
            let place = random.random_range(0..all.len());
            *all[place] = ODD[random.random_range(0..ODD.len())];
        }
    }
}

fn check_estimate(estimate: &Estimate) {
    assert_eq!(estimate.has_latency, !estimate.latency.is_nan());
    assert_eq!(estimate.has_fpr, !estimate.fpr.is_nan());
    assert_eq!(estimate.has_t_n, !estimate.t_n.is_nan());
    assert_eq!(estimate.has_fpr, estimate.state != State::Alongside);
    assert!(!estimate.has_latency || (0.033..=1.0).contains(&estimate.latency));
    assert!(!estimate.has_fpr || (1.0..=30.0).contains(&estimate.fpr));
    assert!((0.0..=100.0).contains(&estimate.extrapolated));
}

fn check_demand(demand: &Demand, actors: usize) {
    assert!((0.033..=1.0).contains(&demand.latency) && (1.0..=30.0).contains(&demand.fpr));
    assert!(demand.actor < actors.max(1) && (demand.has_actor || demand.actor == 0));
}

#[test]
fn law_no_number_goes_unchecked() {
    let mut whole = scene(&mut ChaCha8Rng::seed_from_u64(7));
    // A percentile is looked at where one is asked for.
    whole.params.aggregation = Aggregation::Percentile as u32;
    for place in 0..numbers(&mut whole).len() {
        for (odd, expected) in [
            (f64::NAN, Status::NotFinite),
            (f64::NEG_INFINITY, Status::NotFinite),
            (1.1e12, Status::OutOfRange),
        ] {
            let mut broken = whole.clone();
            *numbers(&mut broken)[place] = odd;
            let statuses = broken.ask().statuses();
            assert!(
                statuses.contains(&expected),
                "number {place} = {odd}: {statuses:?}"
            );
        }
    }
}

#[test]
fn law_whatever_is_broken_gets_a_status_and_no_panic() {
    let mut random = ChaCha8Rng::seed_from_u64(20_260);
    let mut seen: BTreeMap<u32, usize> = BTreeMap::new();
    for number in 0..SCENES {
        let mut scene = scene(&mut random);
        let faults = random.random_range(0..3);
        for _ in 0..faults {
            // A list that is already gone cannot be broken further.
            if !scene.futures.is_empty() {
                break_somewhere(&mut scene, &mut random);
            }
        }
        let answers = scene.ask();
        for status in answers.statuses() {
            *seen.entry(status as u32).or_default() += 1;
            assert_ne!(status, Status::Internal, "scene {number}: {scene:?}");
            assert!(
                faults > 0 || status == Status::Ok,
                "scene {number}: {scene:?} {answers:?}"
            );
        }
        if let Some(estimate) = &answers.trajectory.1 {
            check_estimate(estimate);
        }
        if let Some(aggregated) = &answers.forecast.1 {
            check_estimate(&aggregated.estimate);
            assert!(aggregated.trajectory < scene.futures.len());
        }
        for demand in &answers.demands.1 {
            check_demand(demand, scene.futures.len());
        }
        if let Some(sampled) = &answers.sampled.1 {
            assert_eq!(sampled.along_count, scene.samples.len());
            assert_eq!(sampled.across_count, scene.samples.len());
        }
    }
    // Every status but Internal came up often, so the faults were faults.
    for status in 0..Status::Internal as u32 {
        assert!(
            seen.get(&status).is_some_and(|count| *count > 100),
            "{seen:?}"
        );
    }
}
