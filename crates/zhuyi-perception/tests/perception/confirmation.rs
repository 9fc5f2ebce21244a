//! Coming to believe in an actor, and losing it.

use crate::rig::{CAR_0, FRONT, World, body, eye, millis, perception, scene};
use zhuyi_core::{CameraId, Detection, Frame, Frenet, Pose, Scene, SimTime};
use zhuyi_perception::{Errors, Eye, Perception, visible_share};

/// Puts the car out of range of everything while `hidden`.
fn hide(hidden: impl Fn(SimTime) -> bool) -> impl FnMut(&mut Scene) {
    move |scene| {
        if hidden(scene.time) {
            scene.actors[0].pose.x = 5000.0;
        }
    }
}

/// The scene with the car out of range, so that it does not start confirmed.
fn unseen() -> Scene {
    let mut scene = scene(vec![body(30.0, 0.0, 0.0)]);
    scene.actors[0].pose.x = 5000.0;
    scene.actors[0].road.s = 5000.0;
    scene
}

/// Runs a world in which the car comes into sight at `appears`: the instants of its first exposure and confirmation.
fn first_seen_and_confirmed(
    params: &Perception,
    hz: &[f64],
    seed: u64,
    appears: SimTime,
    to: SimTime,
) -> (Option<SimTime>, Option<SimTime>) {
    let mut world = World::new(params, hz, seed, unseen());
    let appear = |scene: &mut Scene| {
        if scene.time >= appears {
            scene.actors[0] = body(30.0, 0.0, 0.0);
        }
    };
    let (mut seen, mut confirmed) = (None, None);
    world.run(to, appear, |frame, tracker| {
        if !frame.detections.is_empty() {
            seen.get_or_insert(frame.exposed);
        }
        if !tracker.tracks(frame.ready).is_empty() {
            confirmed.get_or_insert(frame.ready);
        }
    });
    (seen, confirmed)
}

#[test]
fn law_confirmation_takes_k_periods_from_the_first_exposure() {
    for hz in [1.0, 2.0, 5.0, 7.0, 30.0] {
        for k in [1, 3, 5] {
            for seed in 0..5 {
                let params = perception(vec![Eye {
                    confirm_frames: k,
                    ..eye(0.0, 120.0)
                }]);
                let (appears, to) = (millis(333), millis(8000));
                let (seen, confirmed) = first_seen_and_confirmed(&params, &[hz], seed, appears, to);
                let (periods, period) = (f64::from(k), 1.0 / hz);
                let from_exposure = (confirmed.unwrap() - seen.unwrap()).seconds();
                assert!(
                    (from_exposure - periods * period).abs() <= 2e-9,
                    "{from_exposure} s at {hz} Hz, K = {k}"
                );
                let from_sight = (confirmed.unwrap() - appears).seconds();
                assert!(
                    (periods * period - 2e-9..=(periods + 1.0) * period + 2e-9)
                        .contains(&from_sight)
                );
            }
        }
    }
}

#[test]
fn hand_a_set_latency_replaces_the_last_period() {
    // K - 1 = 4 periods of 100 ms, then 30 ms
    let params = perception(vec![Eye {
        latency: Some(0.03),
        ..eye(0.0, 120.0)
    }]);
    let (seen, confirmed) =
        first_seen_and_confirmed(&params, &[10.0], 1, millis(500), millis(3000));
    assert_eq!(confirmed.unwrap() - seen.unwrap(), millis(430));
}

#[test]
fn hand_a_frame_without_the_actor_starts_the_count_anew() {
    // At 10 Hz the car shows in frames 0 to 3, not in 4, and from 5 on: confirmed by frame 9, not by 5.
    let mut world = World::new(&perception(vec![eye(0.0, 120.0)]), &[10.0], 1, unseen());
    let mut frame_number = 0;
    let mut confirmed = None;
    let blink = |scene: &mut Scene| {
        if frame_number != 4 {
            scene.actors[0] = body(30.0, 0.0, 0.0);
        }
        frame_number += 1;
    };
    let mut processed = 0;
    world.run(millis(2000), blink, |frame, tracker| {
        if !tracker.tracks(frame.ready).is_empty() {
            confirmed.get_or_insert(processed);
        }
        processed += 1;
    });
    assert_eq!(confirmed, Some(9));
}

#[test]
fn law_each_camera_counts_for_itself_and_the_first_to_reach_k_confirms() {
    // Two front cameras of independent phase: K + min(U1, U2) periods after it came into sight (reading R19).
    let params = perception(vec![eye(0.0, 120.0), eye(0.0, 60.0)]);
    for seed in 0..10 {
        let (seen, confirmed) =
            first_seen_and_confirmed(&params, &[10.0, 10.0], seed, millis(500), millis(3000));
        assert_eq!(confirmed.unwrap() - seen.unwrap(), millis(500));
        assert!(seen.unwrap() - millis(500) <= millis(100));
    }
}

#[test]
fn hand_a_camera_that_should_see_but_cannot_does_not_hinder_confirmation_and_loses_the_track() {
    // A fast camera 6 m to the left looks at the back of a van where the slow one sees the car: confirmed after five
    // slow frames, lost five fast ones later, and confirmed anew after five more slow ones.
    let mut aside = eye(0.0, 120.0);
    aside.camera.left = 6.0;
    let params = perception(vec![eye(0.0, 120.0), aside]);
    let mut start = unseen();
    start.actors.push(body(10.0, 4.0, 0.0));
    let mut world = World::new(&params, &[2.0, 30.0], 1, start);
    let (mut seen, mut confirmed) = (None, Vec::new());
    let mut believed = false;
    let show = |scene: &mut Scene| scene.actors[0] = body(30.0, 0.0, 0.0);
    world.run(millis(7000), show, |frame, tracker| {
        if frame
            .detections
            .iter()
            .any(|detection| detection.actor == CAR_0)
        {
            assert_eq!(frame.camera, FRONT);
            seen.get_or_insert(frame.exposed);
        }
        let before = believed;
        believed = tracker
            .tracks(frame.ready)
            .iter()
            .any(|track| track.actor == CAR_0);
        if believed && !before {
            confirmed.push(frame.ready - seen.unwrap());
        }
    });
    assert_eq!(confirmed, [millis(2500), millis(5000)]);
}

#[test]
fn hand_a_change_of_rate_keeps_the_count() {
    // Three frames at 10 Hz, then the rate rises to 20 Hz: two more frames confirm.
    let mut world = World::new(&perception(vec![eye(0.0, 120.0)]), &[10.0], 1, unseen());
    let show = |scene: &mut Scene| scene.actors[0] = body(30.0, 0.0, 0.0);
    let mut ready = Vec::new();
    let mut confirmed = None;
    let mut to = SimTime::ZERO;
    while confirmed.is_none() && to < millis(3000) {
        to += millis(10);
        world.run(to, show, |frame, tracker| {
            ready.push(frame.ready);
            if !tracker.tracks(frame.ready).is_empty() {
                confirmed = Some(ready.len());
            }
        });
        if ready.len() == 3 {
            world.eyes.set_rate(FRONT, 20.0, to);
        }
    }
    assert_eq!(confirmed, Some(5));
    // The fourth was in flight, at 10 Hz; the fifth was exposed 50 ms after it and ready within 50 ms.
    assert_eq!(ready[4] - ready[3], SimTime::ZERO);
}

#[test]
fn hand_the_first_glance_misses_nothing() {
    let blind = Perception {
        errors: Errors {
            miss_rate: 1.0,
            ..Errors::default()
        },
        ..perception(vec![eye(0.0, 120.0)])
    };
    let mut world = World::new(&blind, &[10.0], 1, scene(vec![body(30.0, 0.0, 0.0)]));
    assert_eq!(world.tracker.tracks(SimTime::ZERO).len(), 1);
}

#[test]
fn hand_what_is_in_sight_at_the_start_is_believed_at_once() {
    let start = scene(vec![
        body(30.0, 0.0, 12.0),
        body(-30.0, 3.5, 8.0),
        body(0.0, -60.0, 0.0),
    ]);
    let params = perception(vec![eye(0.0, 120.0), eye(180.0, 120.0)]);
    let mut world = World::new(&params, &[10.0, 10.0], 1, start);
    let tracks = world.tracker.tracks(millis(500));
    let believed: Vec<_> = tracks
        .iter()
        .map(|track| (track.actor.0, track.road.s, track.s_rate))
        .collect();
    // 30 + 0.5 · 12 and -30 + 0.5 · 8; nobody looks to the right
    assert_eq!(believed, [(0, 36.0, 12.0), (1, -26.0, 8.0)]);
}

/// The frames of each camera after the car has vanished at 1 s until its track is gone.
fn frames_to_loss(
    params: &Perception,
    hz: &[f64],
    vanished: impl Fn(SimTime) -> bool,
) -> Option<Vec<u32>> {
    let mut world = World::new(params, hz, 2, scene(vec![body(30.0, 0.0, 0.0)]));
    let mut frames = vec![0; hz.len()];
    let mut lost = None;
    world.run(millis(12_000), hide(vanished), |frame, tracker| {
        frames[frame.camera.index()] += 1;
        if !frame.detections.is_empty() {
            frames.fill(0);
        }
        if tracker.tracks(frame.ready).is_empty() && lost.is_none() {
            lost = Some(frames.clone());
        }
    });
    lost
}

#[test]
fn law_a_track_is_lost_after_m_frames_at_any_rate() {
    for hz in [1.0, 4.0, 30.0] {
        for m in [1, 2, 5] {
            let params = Perception {
                lost_frames: m,
                ..perception(vec![eye(0.0, 120.0)])
            };
            assert_eq!(
                frames_to_loss(&params, &[hz], |at| at >= millis(1000)),
                Some(vec![m])
            );
        }
    }
}

#[test]
fn hand_fewer_frames_without_it_do_not_lose_a_track() {
    // 10 Hz, gone from 1 s to 1.4 s: four frames. A fifth would lose it.
    let params = perception(vec![eye(0.0, 120.0)]);
    let gone = |until: i64| move |at: SimTime| at >= millis(1000) && at < millis(until);
    assert_eq!(frames_to_loss(&params, &[10.0], gone(1400)), None);
    assert_eq!(frames_to_loss(&params, &[10.0], gone(1500)), Some(vec![5]));
}

#[test]
fn hand_a_single_detection_forgives_all_misses() {
    // 10 Hz, shown in every fifth frame only.
    let mut frame_number = 0;
    let mut world = World::new(
        &perception(vec![eye(0.0, 120.0)]),
        &[10.0],
        1,
        scene(vec![body(30.0, 0.0, 0.0)]),
    );
    let blink = |scene: &mut Scene| {
        frame_number += 1;
        if frame_number % 5 != 0 {
            scene.actors[0].pose.x = 5000.0;
        }
    };
    world.run(millis(6000), blink, |frame, tracker| {
        assert_eq!(tracker.tracks(frame.ready).len(), 1);
    });
}

#[test]
fn hand_a_camera_that_looks_elsewhere_does_not_lose_a_track() {
    // The rear camera at 30 Hz has no say: the front camera at 2 Hz has to miss it five times.
    let params = perception(vec![eye(0.0, 120.0), eye(180.0, 120.0)]);
    let frames = frames_to_loss(&params, &[2.0, 30.0], |at| at >= millis(1000)).unwrap();
    assert_eq!(frames[0], 5);
    assert!(frames[1] > 60);
    assert_eq!(frames_to_loss(&params, &[2.0, 30.0], |_| false), None);
}

#[test]
fn hand_a_lost_track_must_be_confirmed_anew() {
    let mut world = World::new(
        &perception(vec![eye(0.0, 120.0)]),
        &[10.0],
        1,
        scene(vec![body(30.0, 0.0, 0.0)]),
    );
    let mut back = None;
    let mut believed_again = None;
    let gone = |at: SimTime| at >= millis(1000) && at < millis(2000);
    world.run(millis(4000), hide(gone), |frame, tracker| {
        if frame.exposed >= millis(2000) {
            back.get_or_insert(frame.exposed);
            if !tracker.tracks(frame.ready).is_empty() {
                believed_again.get_or_insert(frame.ready);
            }
        }
    });
    assert_eq!(believed_again.unwrap() - back.unwrap(), millis(500));
}

#[test]
fn hand_what_nobody_can_see_coasts_for_m_frames_of_the_slowest_camera() {
    // The ego drives up to a standing car and stops beside it: front at 10 Hz, rear at 2 Hz, no camera sideways.
    let params = perception(vec![eye(0.0, 60.0), eye(180.0, 60.0)]);
    let mut world = World::new(&params, &[10.0, 2.0], 2, scene(vec![body(20.0, 3.5, 0.0)]));
    let mut last_seen = None;
    let mut slow_frames = 0;
    let mut lost = None;
    let drive = |scene: &mut Scene| {
        scene.ego.pose.x = 10.0 * scene.time.seconds().min(2.0);
        scene.ego.road.s = scene.ego.pose.x;
    };
    world.run(millis(8000), drive, |frame, tracker| {
        slow_frames += u32::from(frame.camera == CameraId(1));
        if !frame.detections.is_empty() {
            last_seen = Some(frame.ready);
            slow_frames = 0;
        }
        if tracker.tracks(frame.ready).is_empty() && lost.is_none() {
            lost = Some((frame.camera, slow_frames, frame.ready));
        }
    });
    let (camera, frames, at) = lost.unwrap();
    assert_eq!((camera, frames), (CameraId(1), 5));
    assert!(at - last_seen.unwrap() > millis(2000) && at - last_seen.unwrap() <= millis(2500));
}

#[test]
fn hand_a_hidden_actor_is_lost_like_a_vanished_one() {
    // A second car cuts in before the first at 1 s and hides it.
    let params = perception(vec![eye(0.0, 120.0)]);
    let start = scene(vec![body(30.0, 0.0, 0.0), body(15.0, 8.0, 0.0)]);
    let mut world = World::new(&params, &[10.0], 1, start);
    let cut_in = |scene: &mut Scene| {
        if scene.time >= millis(1000) {
            scene.actors[1] = body(15.0, 0.0, 0.0);
        }
    };
    world.run(millis(3000), cut_in, |_, _| ());
    let believed: Vec<_> = world
        .tracker
        .tracks(millis(3000))
        .iter()
        .map(|track| track.actor.0)
        .collect();
    assert_eq!(believed, [1]);
}

#[test]
fn hand_a_miss_at_the_edge_of_the_picture_is_no_miss() {
    // 40 % of a car is in view of the front camera, at 30 Hz; the left camera, at 1 Hz, sees it whole and keeps it.
    let params = perception(vec![eye(0.0, 120.0), eye(90.0, 120.0)]);
    let mut world = World::new(&params, &[30.0, 1.0], 1, scene(vec![body(3.0, 6.0, 0.0)]));
    let share = visible_share(&params.eyes[0].camera, &world.start, CAR_0);
    assert!((0.3..0.5).contains(&share), "{share}");
    world.run(
        millis(6000),
        |_| (),
        |frame, tracker| assert_eq!(tracker.tracks(frame.ready).len(), 1),
    );
}

#[test]
fn hand_an_error_at_the_edge_of_the_picture_is_no_miss() {
    // Less than half of a car is in view of the front camera, more than half of where it is believed to be, 0.5 m ahead.
    let params = perception(vec![eye(0.0, 120.0), eye(90.0, 120.0)]);
    let mut start = scene(vec![body(3.3, 6.0, 0.0)]);
    let share = visible_share(&params.eyes[0].camera, &start, CAR_0);
    let believed = visible_share(
        &params.eyes[0].camera,
        &scene(vec![body(3.8, 6.0, 0.0)]),
        CAR_0,
    );
    assert!(share < 0.5 && believed > 0.5, "{share} {believed}");
    start.actors[0].road.s = 3.8;
    let mut world = World::new(&params, &[30.0, 1.0], 1, start);
    let keep_apart = |scene: &mut Scene| scene.actors[0].pose.x = 3.3;
    world.run(millis(6000), keep_apart, |frame, tracker| {
        assert_eq!(tracker.tracks(frame.ready).len(), 1, "at {:?}", frame.ready);
    });
}

#[test]
fn hand_an_older_exposure_that_arrives_later_changes_no_belief() {
    let params = perception(vec![eye(0.0, 120.0), eye(0.0, 60.0)]);
    let mut world = World::new(
        &params,
        &[10.0, 10.0],
        1,
        scene(vec![body(30.0, 0.0, 10.0)]),
    );
    world.run(millis(1000), |_| (), |_, _| ());
    let before = world.tracker.tracks(millis(1000))[0];
    let strange = Detection {
        actor: CAR_0,
        road: Frenet { s: 90.0, d: 3.0 },
        turn: 0.0,
        s_rate: 0.0,
        d_rate: 1.0,
        footprint: before.footprint,
    };
    let mut late = Frame {
        camera: CameraId(1),
        exposed: before.seen - SimTime::from_nanos(1),
        ready: millis(1000),
        detections: vec![strange],
        ego: Pose::default(),
    };
    world.tracker.update(&late, &world.road);
    assert_eq!(world.tracker.tracks(millis(1000))[0], before);
    // One of the same instant counts.
    late.exposed = before.seen;
    world.tracker.update(&late, &world.road);
    assert!(world.tracker.tracks(millis(1000))[0].road.s > before.road.s + 1.0);
}
