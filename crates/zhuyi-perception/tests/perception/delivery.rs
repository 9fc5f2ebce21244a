//! From exposure to delivery.

use crate::rig::{CAR_0, FRONT, Scenes, World, body, draws, eye, millis, perception, scene};
use std::iter;
use zhuyi_core::{CameraId, Detection, Frame, FrameRates, Scene, SimTime};
use zhuyi_perception::{Errors, Eye, Eyes, Perception};

/// All frames of a rig that looks at a standing car for a while, in the order of delivery.
fn frames(params: &Perception, hz: &[f64], to: SimTime) -> Vec<Frame> {
    let mut frames = Vec::new();
    World::new(params, hz, 1, scene(vec![body(30.0, 0.0, 0.0)])).run(
        to,
        |_| (),
        |frame, _| frames.push(frame.clone()),
    );
    frames
}

fn of(frames: &[Frame], camera: CameraId) -> Vec<&Frame> {
    frames
        .iter()
        .filter(|frame| frame.camera == camera)
        .collect()
}

#[test]
fn law_thirty_frames_a_second_are_a_thirtieth_apart_to_the_nanosecond() {
    let frames = frames(&perception(vec![eye(0.0, 120.0)]), &[30.0], millis(34_000));
    assert!(frames.len() > 1000);
    let first = frames[0].exposed.nanos();
    for (k, frame) in (0_i64..).zip(&frames) {
        assert_eq!(frame.exposed.nanos() - first, (k * 2_000_000_000 + 30) / 60);
        assert_eq!((frame.ready - frame.exposed).nanos(), 33_333_333);
    }
}

#[test]
fn law_the_scene_is_that_of_the_exposure() {
    let mut shown = Vec::new();
    let params = perception(vec![eye(0.0, 120.0)]);
    let mut world = World::new(&params, &[7.0], 1, scene(vec![body(20.0, 0.0, 10.0)]));
    world.run(
        millis(5000),
        |_| (),
        |frame, _| shown.push((frame.exposed, frame.detections[0].road.s)),
    );
    assert_eq!(shown.len(), 34);
    for (exposed, s) in shown {
        assert!((s - (20.0 + 10.0 * exposed.seconds())).abs() < 1e-12);
    }
}

#[test]
fn hand_latency_may_be_set_apart_from_the_period() {
    let late = Eye {
        latency: Some(0.25),
        ..eye(0.0, 120.0)
    };
    let frames = frames(&perception(vec![late]), &[20.0], millis(2000));
    assert!(frames.len() >= 34);
    assert!(
        frames
            .iter()
            .all(|frame| frame.ready - frame.exposed == millis(250))
    );
}

#[test]
fn hand_a_set_phase_replaces_the_drawn_one_and_moves_no_other() {
    let set = Eye {
        phase: Some(0.25),
        ..eye(0.0, 120.0)
    };
    let drawn = || eye(180.0, 120.0);
    let first = |frames: &[Frame], camera| of(frames, camera)[0].exposed;
    let some = frames(&perception(vec![set, drawn()]), &[20.0, 20.0], millis(200));
    // A quarter of 50 ms.
    assert_eq!(first(&some, CameraId(0)).nanos(), 12_500_000);
    let none = frames(
        &perception(vec![eye(0.0, 120.0), drawn()]),
        &[20.0, 20.0],
        millis(200),
    );
    assert_ne!(first(&none, CameraId(0)).nanos(), 12_500_000);
    assert_eq!(first(&some, CameraId(1)), first(&none, CameraId(1)));
}

#[test]
fn law_a_shift_moves_every_phase_by_the_same_share_and_goes_round() {
    let first = |phase_shift: f64| {
        let shifted = Perception {
            phase_shift,
            ..perception(vec![eye(0.0, 120.0), eye(180.0, 120.0)])
        };
        let frames = frames(&shifted, &[20.0, 10.0], millis(400));
        // Shares of 50 and of 100 ms.
        [(0, 20.0), (1, 10.0)]
            .map(|(camera, hz)| of(&frames, CameraId(camera))[0].exposed.seconds() * hz)
    };
    let drawn = first(0.0);
    for shift in [0.25, 0.5, 0.75] {
        for (moved, drawn) in first(shift).into_iter().zip(drawn) {
            assert!(
                (moved - (drawn + shift).fract()).abs() < 1e-6,
                "{moved} of {drawn}"
            );
        }
    }
}

#[test]
fn law_frames_come_in_order_of_ready_then_camera() {
    let slow = Eye {
        latency: Some(0.3),
        ..eye(0.0, 60.0)
    };
    let params = perception(vec![slow, eye(0.0, 120.0), eye(180.0, 120.0)]);
    let start = scene(vec![body(30.0, 0.0, 0.0)]);
    let mut eyes = Eyes::new(
        &params,
        &FrameRates::new(vec![30.0, 10.0, 4.0]),
        draws(1),
        start.actors.len(),
    );
    eyes.expose(millis(4000), &mut &start);
    let frames: Vec<_> = iter::from_fn(|| eyes.deliver(millis(3000))).collect();
    assert!(frames.is_sorted_by_key(|frame| (frame.ready, frame.camera)));
    // all that are ready, and no other: exposed up to 2.7, 2.9 and 2.75 s
    assert_eq!(
        [0, 1, 2].map(|camera| of(&frames, CameraId(camera)).len()),
        [81, 29, 11]
    );
}

#[test]
fn hand_a_frame_overtaken_after_a_change_of_rate_is_dropped() {
    // At 1 Hz a frame in flight keeps its latency of 1 s. Two periods after it the rate rises to 10 Hz: later frames
    // are ready before it.
    let params = perception(vec![eye(0.0, 120.0)]);
    let start = scene(vec![body(30.0, 0.0, 0.0)]);
    let mut eyes = Eyes::new(
        &params,
        &FrameRates::new(vec![1.0]),
        draws(1),
        start.actors.len(),
    );
    let mut first = None;
    let mut seen = Vec::new();
    let mut now = SimTime::ZERO;
    while now < millis(3000) {
        now += millis(10);
        let mut truth = Scenes {
            scene: start.clone(),
            evaluate: |at, _: &mut Scene| {
                first.get_or_insert(at);
            },
        };
        eyes.expose(now, &mut truth);
        if first.is_some_and(|first| now >= first + millis(200)) {
            eyes.set_rate(FRONT, 10.0, now);
        }
        while let Some(frame) = eyes.deliver(now) {
            seen.push(frame);
        }
    }
    let first = first.unwrap();
    assert_eq!(eyes.rate(FRONT), 10.0);
    assert_eq!(eyes.frames_dropped(FRONT), 1);
    assert_eq!(eyes.frames_processed(FRONT), seen.len() as u64);
    assert!(
        seen.iter()
            .all(|frame| frame.exposed > first && frame.ready - frame.exposed == millis(100))
    );
    // max(now, first + 100 ms) = now, the first step that is 200 ms past the first exposure
    let change = seen[0].exposed;
    assert!(
        change.nanos() % 10_000_000 == 0
            && change >= first + millis(200)
            && change < first + millis(210)
    );
    assert!(
        (0_i64..)
            .zip(&seen)
            .all(|(k, frame)| frame.exposed == change + millis(100 * k))
    );
    let in_flight =
        eyes.frames_exposed(FRONT) - eyes.frames_processed(FRONT) - eyes.frames_dropped(FRONT);
    assert_eq!(in_flight, 1);
}

#[test]
fn law_detections_scatter_as_their_deviations_say() {
    let noisy = Perception {
        errors: Errors {
            noise_along: 0.1,
            noise_across: 0.05,
            noise_speed: 0.2,
            ..Errors::default()
        },
        ..perception(vec![Eye {
            latency: Some(0.0),
            ..eye(0.0, 120.0)
        }])
    };
    let frames = frames(&noisy, &[100.0], millis(100_000));
    let n = frames.len() as f64;
    assert_eq!(n, 10_000.0);
    let errors =
        |of: fn(&Detection) -> f64| frames.iter().map(move |frame| of(&frame.detections[0]));
    let check = |of: fn(&Detection) -> f64, truth: f64, deviation: f64| -> Vec<f64> {
        let mean = errors(of).sum::<f64>() / n;
        let variance = errors(of).map(|value| (value - truth).powi(2)).sum::<f64>() / n;
        assert!(
            (mean - truth).abs() < 4.0 * deviation / n.sqrt(),
            "mean {mean}, not {truth}"
        );
        assert!(
            (variance.sqrt() / deviation - 1.0).abs() < 4.0 / (2.0 * n).sqrt(),
            "deviation {}",
            variance.sqrt()
        );
        errors(of)
            .map(|value| (value - truth) / deviation)
            .collect()
    };
    let normalised = [
        check(|seen| seen.road.s, 30.0, 0.1),
        check(|seen| seen.road.d, 0.0, 0.05),
        check(|seen| seen.s_rate, 0.0, 0.2),
        check(|seen| seen.d_rate, 0.0, 0.2),
    ];
    for (i, a) in normalised.iter().enumerate() {
        for b in &normalised[..i] {
            let correlation = a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / n;
            assert!(
                correlation.abs() < 4.0 / n.sqrt(),
                "correlation {correlation}"
            );
        }
    }
}

#[test]
fn law_misses_come_at_their_rate_and_do_not_shift_the_noise() {
    let noisy = Perception {
        errors: Errors {
            noise_along: 0.1,
            ..Errors::default()
        },
        ..perception(vec![eye(0.0, 120.0)])
    };
    let missing = Perception {
        errors: Errors {
            miss_rate: 0.1,
            ..noisy.errors
        },
        ..noisy.clone()
    };
    let (all, some) = (
        frames(&noisy, &[50.0], millis(60_000)),
        frames(&missing, &[50.0], millis(60_000)),
    );
    let found: Vec<_> = some
        .iter()
        .zip(&all)
        .filter(|(seen, _)| !seen.detections.is_empty())
        .collect();
    assert!(found.iter().all(|(seen, reference)| seen == reference));
    let n = all.len() as f64;
    let missed = 1.0 - found.len() as f64 / n;
    assert!(
        (missed - 0.1).abs() < 4.0 * (0.09 / n).sqrt(),
        "{missed} missed"
    );
}

#[test]
fn law_the_jth_frame_has_the_same_luck_at_any_rate_of_any_camera() {
    let noisy = Perception {
        errors: Errors {
            noise_along: 0.1,
            noise_across: 0.05,
            noise_speed: 0.2,
            miss_rate: 0.2,
            ..Errors::default()
        },
        ..perception(vec![eye(0.0, 120.0), eye(0.0, 60.0)])
    };
    let luck = |hz: [f64; 2], camera: CameraId| -> Vec<Vec<Detection>> {
        let frames = frames(&noisy, &hz, millis(6000));
        of(&frames, camera)
            .into_iter()
            .take(20)
            .map(|frame| frame.detections.clone())
            .collect()
    };
    let reference = luck([5.0, 5.0], FRONT);
    assert_eq!(reference.len(), 20);
    assert_eq!(reference, luck([5.0, 30.0], FRONT));
    assert_eq!(reference, luck([30.0, 5.0], FRONT));
    assert_ne!(reference, luck([5.0, 5.0], CameraId(1)));
}

#[test]
fn law_an_actor_out_of_sight_uses_up_its_luck() {
    let noisy = Perception {
        errors: Errors {
            noise_along: 0.1,
            ..Errors::default()
        },
        ..perception(vec![eye(0.0, 120.0)])
    };
    let run = |hidden_until: SimTime| {
        let mut frames = Vec::new();
        let mut world = World::new(&noisy, &[10.0], 1, scene(vec![body(30.0, 0.0, 0.0)]));
        let hide = |scene: &mut zhuyi_core::Scene| {
            if scene.time < hidden_until {
                scene.actors[CAR_0.index()].pose.x = 500.0;
            }
        };
        world.run(millis(3000), hide, |frame, _| frames.push(frame.clone()));
        frames
    };
    let (always, late) = (run(SimTime::ZERO), run(millis(1500)));
    assert!(late[5].detections.is_empty());
    assert_eq!(always[20], late[20]);
}
