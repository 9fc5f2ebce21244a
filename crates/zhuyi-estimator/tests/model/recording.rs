//! The coarse view of a recording saves work and changes no answer: cases worked by hand. The law is in `tests/laws/fast.rs`.

use crate::scene::{CAR, Scene};
use zhuyi_core::{Along, Trajectory};
use zhuyi_estimator::{Estimator, Params, Recording};

/// Pieces that share one time have no duration to fit a curve to. A car stands 60 m ahead, noted 40 times at the start
/// and every second from then on.
#[test]
fn hand_pieces_without_duration_rule_nothing_out() {
    let scene = Scene::following(20.0, 60.0, 0.0);
    let note = |count: i32| Along {
        time: f64::from((count - 40).max(0)),
        ..scene.along[0]
    };
    let along = (0..100).map(note).collect();
    let recording = Recording::new(Trajectory {
        along,
        across: vec![scene.across[0]; 100],
        extents: Vec::new(),
        known_until: 20.0,
    });
    let estimator = Estimator::new(Params::default());
    let found = estimator.recorded(&scene.ego, CAR, &recording, 0.0, scene.current_latency);
    assert_eq!(found, scene.ask(&Params::default()));
    assert_eq!(found.latency, Some(0.109));
}

/// A car stands 44 m ahead of an ego at 20 m/s, too near for Eq. 1 (39.6 m) but not for braking at once (40.8 m), and
/// for one hundredth of a second at 6.5 s it is noted 20 m further. That is a t_n for the latencies that do not touch:
/// l = 0.043 (t_r = 0.092, 42.7 m), not 0.076 (0.289, 46.6 m).
#[test]
fn hand_a_moment_out_of_place_is_not_passed_over() {
    let mut scene = Scene::following(20.0, 44.0, 0.0);
    let standing = scene.along[0];
    let note = |count: i32| Along {
        time: f64::from(count) / 100.0,
        s: standing.s + if count == 650 { 20.0 } else { 0.0 },
        ..standing
    };
    scene.along = (0..2100).map(note).collect();
    let (along, across) = (scene.along.clone(), scene.across.clone());
    let recording = Recording::new(Trajectory {
        along,
        across,
        extents: Vec::new(),
        known_until: 20.0,
    });
    let estimator = Estimator::new(Params::default());
    let found = estimator.recorded(&scene.ego, CAR, &recording, 0.0, scene.current_latency);
    assert_eq!((found.latency, found.t_n), (Some(0.043), Some(6.5)));
    assert_eq!(found, scene.ask(&Params::default()));
}
