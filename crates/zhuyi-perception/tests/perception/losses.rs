//! Latencies that vary, and frames that are lost.

use crate::rig::{FRONT, World, body, draws, eye, millis, perception, scene};
use zhuyi_core::{CameraId, Frame, FrameRates, SimTime};
use zhuyi_perception::{Errors, Eye, Eyes, OwnErrors, Perception};

/// A rig of two cameras, the first with a latency of 20 ms.
fn rig() -> Perception {
    let quick = Eye {
        latency: Some(0.02),
        ..eye(0.0, 120.0)
    };
    Perception {
        errors: Errors {
            noise_along: 0.1,
            ..Errors::default()
        },
        ..perception(vec![quick, eye(0.0, 60.0)])
    }
}

/// What a rig that looks at a standing car delivers in 60 s, and its eyes.
fn seen(params: &Perception, hz: [f64; 2]) -> (Vec<Frame>, Eyes) {
    let mut frames = Vec::new();
    let mut world = World::new(params, &hz, 1, scene(vec![body(30.0, 0.0, 0.0)]));
    world.run(
        millis(60_000),
        |_| (),
        |frame, _| frames.push(frame.clone()),
    );
    (frames, world.eyes)
}

fn jittered(latency_jitter: f64) -> Perception {
    Perception {
        errors: Errors {
            latency_jitter,
            ..rig().errors
        },
        ..rig()
    }
}

fn losing(drop_rate: f64) -> Perception {
    Perception {
        errors: Errors {
            drop_rate,
            ..rig().errors
        },
        ..rig()
    }
}

fn exposures(frames: &[Frame], camera: CameraId) -> Vec<SimTime> {
    let of = frames.iter().filter(|frame| frame.camera == camera);
    of.map(|frame| frame.exposed).collect()
}

#[test]
fn law_latencies_are_uniform_between_the_latency_and_the_jitter_above_it() {
    // At 10 Hz 20 ms and at most 60 more overtake nobody.
    let (frames, eyes) = seen(&jittered(0.06), [10.0, 10.0]);
    let front = frames.iter().filter(|frame| frame.camera == FRONT);
    let late: Vec<f64> = front
        .map(|frame| (frame.ready - frame.exposed).seconds() - 0.02)
        .collect();
    let n = late.len() as f64;
    assert!(n >= 598.0 && eyes.frames_dropped(FRONT) == 0);
    assert!(late.iter().all(|late| (0.0..0.06).contains(late)));
    // A uniform number below J has the mean J/2 and the variance J²/12.
    let mean = late.iter().sum::<f64>() / n;
    assert!(
        (mean - 0.03).abs() < 4.0 * 0.06 / (12.0 * n).sqrt(),
        "{mean}"
    );
    let variance = late.iter().map(|late| (late - mean).powi(2)).sum::<f64>() / n;
    // Var((x - J/2)²) = J⁴/180.
    let off = (variance - 0.06_f64.powi(2) / 12.0).abs();
    assert!(
        off < 4.0 * 0.06_f64.powi(2) / (180.0 * n).sqrt(),
        "{variance}"
    );
}

#[test]
fn law_jitter_moves_neither_exposures_nor_what_they_show_and_grows_in_proportion() {
    let (calm, _) = seen(&rig(), [10.0, 10.0]);
    let (some, _) = seen(&jittered(0.03), [10.0, 10.0]);
    let (more, _) = seen(&jittered(0.06), [10.0, 5.0]);
    let front = |frames: &[Frame]| -> Vec<Frame> {
        let of = frames.iter().filter(|frame| frame.camera == FRONT);
        of.take(500).cloned().collect()
    };
    let all = [front(&calm), front(&some), front(&more)];
    for ((calm, some), more) in all[0].iter().zip(&all[1]).zip(&all[2]) {
        assert_eq!(
            (calm.exposed, &calm.detections),
            (some.exposed, &some.detections)
        );
        let late = |frame: &Frame| (frame.ready - calm.ready).nanos();
        assert!((2 * late(some) - late(more)).abs() <= 2);
    }
}

#[test]
fn law_what_is_overtaken_is_dropped_and_every_frame_is_accounted_for() {
    // At 100 Hz frames that take up to 50 ms longer overtake one another.
    let (frames, eyes) = seen(&jittered(0.05), [100.0, 10.0]);
    let front = exposures(&frames, FRONT);
    assert!(front.is_sorted() && eyes.frames_dropped(FRONT) > 1000);
    let waiting = eyes.in_flight();
    let waiting = waiting.filter(|frame| frame.camera == FRONT).count() as u64;
    assert_eq!(
        eyes.frames_exposed(FRONT),
        front.len() as u64 + eyes.frames_dropped(FRONT) + waiting
    );
}

#[test]
fn law_frames_are_lost_at_their_rate_and_leave_the_others_as_they_are() {
    let (all, _) = seen(&rig(), [50.0, 10.0]);
    let (most, eyes) = seen(&losing(0.1), [50.0, 10.0]);
    let (some, _) = seen(&losing(0.3), [50.0, 20.0]);
    // Who is lost at a tenth is lost at three tenths, whatever another camera does.
    let [all_at, most_at, some_at] = [&all, &most, &some].map(|frames| exposures(frames, FRONT));
    assert!(some_at.iter().all(|at| most_at.contains(at)));
    assert!(most.iter().all(|frame| all.contains(frame)));
    let n = all_at.len() as f64;
    for (rate, kept) in [(0.1, &most_at), (0.3, &some_at)] {
        let lost = 1.0 - kept.len() as f64 / n;
        let deviation = (rate * (1.0 - rate) / n).sqrt();
        assert!((lost - rate).abs() < 4.0 * deviation, "{lost}, not {rate}");
    }
    let exposed = eyes.frames_exposed(FRONT);
    assert_eq!(eyes.frames_lost(FRONT) + most_at.len() as u64, exposed - 1);
    let (none, eyes) = seen(&losing(1.0), [50.0, 10.0]);
    assert!(none.is_empty());
    assert_eq!(eyes.frames_lost(FRONT), exposed);
}

#[test]
fn hand_a_lost_frame_puts_confirmation_off_by_a_frame_and_a_miss_begins_it_anew() {
    // The car comes into sight at 2 s. Five frames with it confirm it: one lost among them makes it six exposures, one in which
    // it is missed up to ten.
    let confirmed = |params: &Perception| {
        let mut found = Vec::new();
        let mut world = World::new(params, &[10.0, 0.2], 1, scene(vec![body(30.0, 0.0, 0.0)]));
        let hide = |scene: &mut zhuyi_core::Scene| {
            if scene.time < millis(2000) {
                scene.actors[0].pose.x = 500.0;
            }
        };
        world.run(millis(5000), hide, |frame, tracker| {
            if frame.camera == FRONT && frame.exposed >= millis(2000) {
                found.push((frame.exposed, tracker.tracks(frame.ready).len()));
            }
        });
        let at = found.iter().position(|(_, tracks)| *tracks > 0).unwrap();
        let exposures = (found[at].0 - found[0].0).seconds() * 10.0;
        (at + 1, exposures.round() as usize + 1)
    };
    assert_eq!(confirmed(&rig()), (5, 5));
    let (processed, exposed) = confirmed(&losing(0.5));
    assert_eq!(processed, 5);
    assert!(exposed > 5, "of the frames at this seed none is lost");
    let missing = Perception {
        errors: Errors {
            miss_rate: 0.3,
            ..rig().errors
        },
        ..rig()
    };
    let (processed, _) = confirmed(&missing);
    assert!(
        processed > 5,
        "in the frames at this seed it is never missed"
    );
}

#[test]
fn hand_where_others_know_the_latency_only_jitter_is_left_of_it() {
    let start = scene(vec![body(30.0, 0.0, 0.0)]);
    let rates = FrameRates::new(vec![10.0, 10.0]);
    let ready = |params: &Perception| -> Vec<i64> {
        let mut eyes = Eyes::new(params, &rates, draws(1), start.actors.len()).without_latency();
        eyes.expose(millis(1000), &mut &start);
        let late = |frame: Frame| (frame.ready - frame.exposed).nanos();
        eyes.take_exposed().map(late).collect()
    };
    assert!(ready(&rig()).iter().all(|late| *late == 0));
    let late = ready(&jittered(0.05));
    assert!(late.len() == 20 && late.iter().all(|late| (0..50_000_000).contains(late)));
    assert!(late.iter().any(|late| *late > 25_000_000));
}

#[test]
fn hand_a_camera_with_errors_of_its_own_leaves_the_others_as_they_are() {
    // Two cameras at 10 Hz see the same car; the second misses it always, and loses half of its frames.
    let mut params = rig();
    params.eyes[1].own = OwnErrors {
        miss_rate: Some(1.0),
        drop_rate: Some(0.5),
        ..OwnErrors::default()
    };
    let (usual, _) = seen(&rig(), [10.0, 10.0]);
    let (own, eyes) = seen(&params, [10.0, 10.0]);
    let of = |frames: &[Frame], camera: u8| -> Vec<Frame> {
        let camera = CameraId(camera);
        let frames = frames.iter().filter(|frame| frame.camera == camera);
        frames.cloned().collect()
    };
    assert_eq!(of(&usual, 0), of(&own, 0));
    assert!(of(&own, 1).iter().all(|frame| frame.detections.is_empty()));
    let lost = eyes.frames_lost(CameraId(1)) as f64 / eyes.frames_exposed(CameraId(1)) as f64;
    assert!((0.3..0.7).contains(&lost), "{lost}");
    assert_eq!(eyes.frames_lost(CameraId(0)), 0);
}
