//! What is played is what is asked anew at each step.

use crate::{Ego, Estimator, Future, Grid, Params, Recording, Solver, State, Uncertainty};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use zhuyi_core::{Across, Along, Extent, Footprint, Trajectory};

const CAR: Footprint = Footprint {
    length: 4.0,
    width: 2.0,
};

/// A lead, or one that changes lanes, that changes its acceleration now and then.
fn any_recording(rng: &mut ChaCha8Rng, turning: bool) -> Recording {
    let gap = rng.random_range(1.0..80.0);
    let speed = rng.random_range(0.0..30.0);
    let mut along = vec![Along::constant_accel(0.0, gap + CAR.length, speed, 0.0)];
    for _ in 0..rng.random_range(0..8) {
        let last = along[along.len() - 1];
        let time = last.time + rng.random_range(0.3..4.0);
        let v = last.v_at(time).max(0.0);
        let accel = rng.random_range(-6.0..3.0);
        let accel = if v == 0.0 {
            f64::max(accel, 0.0)
        } else {
            accel
        };
        along.push(Along::constant_accel(time, last.s_at(time), v, accel));
    }
    let mut lane = [0.0, 0.0, 3.5][rng.random_range(0..3)];
    let mut across = vec![Across {
        time: 0.0,
        d: lane,
        d_rate: 0.0,
    }];
    let mut time = 0.0;
    for _ in 0..[0, 0, 1, 1, 2, 3][rng.random_range(0..6)] {
        // Now and then one change follows at once on another.
        let pause = f64::max(rng.random_range(-2.0..5.0), 0.0);
        let (begin, to) = (
            time + pause + f64::from(u8::from(time == 0.0)) * 0.1,
            3.5 - lane,
        );
        let end = begin + rng.random_range(1.0..4.0);
        across.push(Across {
            time: begin,
            d: lane,
            d_rate: (to - lane) / (end - begin),
        });
        across.push(Across {
            time: end,
            d: to,
            d_rate: 0.0,
        });
        (time, lane) = (end, to);
    }
    Recording::new(Trajectory {
        along,
        across,
        extents: if turning {
            any_extents(rng)
        } else {
            Vec::new()
        },
        known_until: 20.0,
    })
}

/// Of a box that keeps aligned, that is turned, or that turns: by itself, or while it changes lanes.
fn any_extents(rng: &mut ChaCha8Rng) -> Vec<Extent> {
    let mut turned = |time: f64| Extent {
        time,
        ..Extent::held(CAR.turned([0.0, 0.2, 3.0][rng.random_range(0..3)] * rng.random::<f64>()))
    };
    let mut pieces = vec![
        turned(0.0),
        turned(1.0),
        turned(1.5),
        turned(4.0),
        turned(9.0),
    ];
    pieces.truncate([1, 2, 4, 5][rng.random_range(0..4)]);
    for place in 1..pieces.len() {
        let next = pieces[place];
        let before = &mut pieces[place - 1];
        let length = next.time - before.time;
        before.along_rate = (next.along - before.along) / length;
        before.across_rate = (next.across - before.across) / length;
    }
    pieces
}

fn any_params(rng: &mut ChaCha8Rng) -> Params {
    Params {
        c1: rng.random_range(0.5..1.0),
        c2: rng.random_range(0.5..1.0),
        c4: rng.random_range(0.8..1.3),
        horizon: [20.0, 20.0, 4.0][rng.random_range(0..3)],
        grid: [Grid::Ms33, Grid::Thirtieths, Grid::Fps][rng.random_range(0..3)],
        solver: [Solver::Exact, Solver::Exact, Solver::Paper][rng.random_range(0..3)],
        uncertainty: (rng.random_range(0..8) == 0).then(Uncertainty::example),
        ..Params::default()
    }
}

/// Asks twice, (now, s, v, a) each, of an actor that stands at `s` and moves across through (t, d); the answers as asked anew.
fn asked_twice(params: Params, s: f64, across: &[(f64, f64)], steps: [[f64; 4]; 2]) {
    let rate = |place: usize| match across.get(place + 1) {
        Some((next, d)) => (d - across[place].1) / (next - across[place].0),
        None => 0.0,
    };
    let pieces = across.iter().enumerate().map(|(place, (time, d))| Across {
        time: *time,
        d: *d,
        d_rate: rate(place),
    });
    let recording = Recording::new(Trajectory {
        along: vec![Along::constant_accel(0.0, s, 0.0, 0.0)],
        across: pieces.collect(),
        extents: Vec::new(),
        known_until: 20.0,
    });
    let estimator = Estimator::new(params);
    let mut playback = estimator.playback(&recording, CAR);
    for [now, s, speed, accel] in steps {
        let ego = Ego {
            s,
            d: 0.0,
            speed,
            accel,
            footprint: CAR,
        };
        let plain = estimator.recorded(&ego, CAR, &recording, now, 1.0 / 30.0);
        let played = playback.tolerance(&ego, now, 1.0 / 30.0);
        assert_eq!(played, plain.into(), "at {now}");
    }
}

#[test]
fn regress_a_second_stay_counts_later_though_it_did_not_before() {
    let swerves = [(0.0, 0.0), (1.0, 0.0), (2.0, 3.5), (6.0, 0.0)];
    let steps = [[0.0, 0.0, 10.0, 0.0], [0.2, 1.98, 9.8, -1.0]];
    asked_twice(Params::default(), 30.0, &swerves, steps);
}

#[test]
fn regress_a_second_stay_comes_into_the_horizon() {
    let params = Params {
        horizon: 4.0,
        ..Params::default()
    };
    let swerves = [(0.0, 0.0), (0.6, 0.0), (1.1, 5.0), (1.6, 0.0)];
    let steps = [[0.0, 0.0, 30.0, 0.0], [0.09, 2.7, 30.0, 0.0]];
    asked_twice(params, 89.0, &swerves, steps);
}

#[test]
fn regress_an_ego_that_jumps_back() {
    let steps = [[0.0, 0.0, 10.0, 0.0], [0.01, -14.894, 12.391, 0.0]];
    asked_twice(Params::default(), 85.8759, &[(0.0, 0.0)], steps);
}

/// How many questions were asked, answered tolerable or standing, and answered by a proof made before.
#[derive(Debug, Default)]
struct Counts {
    asked: u32,
    tolerable: u32,
    standing: u32,
    by_proof: u32,
    standing_by_proof: u32,
}

fn play(recordings: u32, turning: bool) -> Counts {
    let mut rng = ChaCha8Rng::seed_from_u64(2022);
    let mut counts = Counts::default();
    for _ in 0..recordings {
        let estimator = Estimator::new(any_params(&mut rng));
        let recording = any_recording(&mut rng, turning);
        let mut playback = estimator.playback(&recording, CAR);
        let mut ego = Ego {
            s: 0.0,
            d: 0.0,
            speed: rng.random_range(0.0..35.0),
            accel: rng.random_range(-3.0..2.0),
            footprint: CAR,
        };
        // How restless the ego is: mostly as in a drive, now and then by jumps.
        let restless = [0.0, 0.02, 0.5, 5.0][rng.random_range(0..4)];
        // Of no such steps as put the ego on the very border of the corridor.
        let drift = [0.0, 0.0, 5.1e-4, -0.021_37][rng.random_range(0..4)];
        // In a bend it turns against the road, and with it its box.
        let (mut car, mut yaw) = (CAR, 0.0);
        let yaw_rate = [0.0, 0.0, 1e-3, -0.05][rng.random_range(0..4)];
        // Now and then it creeps, at the border of standing.
        if rng.random_range(0..8) == 0 {
            ego.speed = rng.random_range(0.0..0.2);
        }
        let (mut now, mut current_latency) = (0.0, 1.0 / 30.0);
        for _ in 0..400 {
            let plain = estimator.recorded(&ego, CAR, &recording, now, current_latency);
            if now < 1.0 {
                let future = Future::new(recording.trajectory(), now);
                let unrecorded = estimator.trajectory(&ego, CAR, &future, current_latency);
                assert_eq!(unrecorded, plain, "{ego:?} at {now}");
            }
            let before = playback.proof;
            let played = playback.tolerance(&ego, now, current_latency);
            assert_eq!(
                played,
                plain.into(),
                "{:?} {ego:?} at {now}",
                estimator.params()
            );
            counts.asked += 1;
            counts.tolerable += u32::from(plain.state == State::Tolerable);
            counts.standing += u32::from(plain.state == State::Standing);
            if before.is_some() && before == playback.proof {
                counts.by_proof += 1;
                counts.standing_by_proof += u32::from(plain.state == State::Standing);
            }
            let step = if rng.random_range(0..50) == 0 {
                0.3
            } else {
                0.01
            };
            now += step;
            ego.s += step * (ego.speed + step * ego.accel / 2.0).max(0.0);
            ego.speed = (ego.speed + step * ego.accel).max(0.0);
            ego.d += drift * step / 0.01;
            yaw += yaw_rate * step;
            ego.footprint = car.turned(yaw);
            ego.accel = (ego.accel + restless * rng.random_range(-1.0..1.0)).clamp(-8.0, 3.0);
            match rng.random_range(0..400) {
                0 => ego.d = rng.random_range(-1.0..1.0),
                1 => ego.s += rng.random_range(-1.0..1.0),
                2 => ego.speed += rng.random_range(0.0..1.0),
                4 => {
                    ego.s -= rng.random_range(0.0..15.0);
                    ego.speed += rng.random_range(0.0..3.0);
                }
                5 => car.length = rng.random_range(3.0..12.0),
                6 => ego.speed = rng.random_range(0.0..0.2),
                3 => current_latency = rng.random_range(0.02..0.5),
                _ => {}
            }
        }
    }
    counts
}

#[test]
fn law_what_is_played_is_what_is_asked_at_each_step() {
    let counts = play(4_000, false);
    assert!(counts.tolerable > 300_000, "{counts:?}");
    assert!(
        counts.standing > 100_000 && counts.standing_by_proof > 100,
        "{counts:?}"
    );
    assert!(
        counts.by_proof > 50_000 && counts.by_proof < counts.tolerable,
        "{counts:?}"
    );
}

#[test]
fn law_the_same_of_a_box_that_turns() {
    let counts = play(2_000, true);
    assert!(counts.tolerable > 100_000, "{counts:?}");
    assert!(
        counts.by_proof > 15_000 && counts.by_proof < counts.tolerable,
        "{counts:?}"
    );
}
