//! The queue, by hand and against what is known of its disciplines.

use proptest::prelude::*;
use zhuyi_core::{CameraId, SimTime};
use zhuyi_scheduler::queue::{Processed, deadline};
use zhuyi_scheduler::{Accelerator, Chip, Discipline, Queued};

fn ms(millis: i64) -> SimTime {
    SimTime::from_millis(millis)
}

/// 10 ms per frame, 7 bytes each.
fn chip(discipline: Discipline, drop_stale: bool) -> Chip {
    Chip {
        tops: 50.0,
        gop_per_frame: 500.0,
        frame_bytes: 7,
        discipline,
        drop_stale,
    }
}

/// Frames `(camera, exposed, deadline)` in milliseconds, pushed at their exposures; all results, and the machine.
fn run(chip: Chip, frames: &[(u8, i64, i64)]) -> (Vec<Processed>, Accelerator) {
    let mut accelerator = Accelerator::new(chip).expect("a chip");
    for &(camera, exposed, deadline) in frames {
        let frame = Queued {
            camera: CameraId(camera),
            exposed: ms(exposed),
            deadline: ms(deadline),
        };
        accelerator.push(frame, ms(exposed), |_| ());
    }
    let mut done = Vec::new();
    while let Some(ready) = accelerator.next_ready() {
        let next = accelerator.take(ready).expect("what was announced");
        assert_eq!(next.ready, ready);
        done.push(next);
    }
    (done, accelerator)
}

/// `(camera, exposed, ready)` in milliseconds.
fn told(done: &[Processed]) -> Vec<(u8, i64, i64)> {
    done.iter()
        .map(|p| {
            (
                p.frame.camera.0,
                p.frame.exposed.nanos() / 1_000_000,
                p.ready.nanos() / 1_000_000,
            )
        })
        .collect()
}

/// While the first frame is under work, one with a late and one with an early deadline arrive.
const THREE: [(u8, i64, i64); 3] = [(0, 0, 100), (1, 2, 90), (2, 4, 30)];

#[test]
fn hand_first_come_first_served() {
    let (done, _) = run(chip(Discipline::Fifo, true), &THREE);
    assert_eq!(told(&done), [(0, 0, 10), (1, 2, 20), (2, 4, 30)]);
}

#[test]
fn hand_the_earliest_deadline_overtakes_but_does_not_interrupt() {
    let (done, _) = run(chip(Discipline::EarliestDeadline, true), &THREE);
    assert_eq!(told(&done), [(0, 0, 10), (2, 4, 20), (1, 2, 30)]);
    assert_eq!(done[1].latency(), ms(16));
    assert_eq!(done[1].late(), None);
}

#[test]
fn hand_a_newer_frame_drops_the_older_one_that_waits_but_not_the_one_under_work() {
    // Camera 0 every 3 ms: 0 is under work until 10; 3 and 6 are dropped for 9.
    let frames = [(0, 0, 50), (0, 3, 53), (0, 6, 56), (0, 9, 59)];
    let (done, accelerator) = run(chip(Discipline::Fifo, true), &frames);
    assert_eq!(told(&done), [(0, 0, 10), (0, 9, 20)]);
    let counts = accelerator.counts();
    assert_eq!((counts.pushed, counts.begun, counts.dropped), (4, 2, 2));
    assert_eq!(
        (accelerator.bytes_transferred(), accelerator.bytes_avoided()),
        (14, 14)
    );

    let (done, accelerator) = run(chip(Discipline::Fifo, false), &frames);
    assert_eq!(
        told(&done),
        [(0, 0, 10), (0, 3, 20), (0, 6, 30), (0, 9, 40)]
    );
    assert_eq!(accelerator.bytes_avoided(), 0);
}

#[test]
fn hand_the_order_of_pushes_at_one_instant_does_not_matter() {
    let frames = [(1, 0, 40), (2, 0, 30), (0, 0, 50)];
    let mut turned = frames;
    turned.reverse();
    for (discipline, cameras) in [
        (Discipline::Fifo, [0, 1, 2]),
        (Discipline::EarliestDeadline, [2, 1, 0]),
    ] {
        for frames in [frames, turned] {
            let (done, _) = run(chip(discipline, true), &frames);
            assert_eq!(
                done.iter().map(|p| p.frame.camera.0).collect::<Vec<_>>(),
                cameras
            );
        }
    }
}

#[test]
fn hand_a_frame_that_comes_when_the_accelerator_becomes_free_is_in_the_choice() {
    let (done, _) = run(
        chip(Discipline::EarliestDeadline, true),
        &[(0, 0, 99), (1, 5, 90), (2, 10, 30)],
    );
    assert_eq!(told(&done), [(0, 0, 10), (2, 10, 20), (1, 5, 30)]);
}

#[test]
fn hand_an_idle_accelerator_waits_for_work() {
    let (done, _) = run(chip(Discipline::Fifo, true), &[(0, 0, 99), (0, 25, 99)]);
    assert_eq!(told(&done), [(0, 0, 10), (0, 25, 35)]);
    assert_eq!(done[1].started, ms(25));
}

#[test]
fn hand_a_chip_without_speed_or_work_is_refused() {
    for (tops, gop_per_frame) in [
        (0.0, 1.0),
        (f64::NAN, 1.0),
        (1.0, -1.0),
        (1.0, f64::INFINITY),
    ] {
        let chip = Chip {
            tops,
            gop_per_frame,
            ..Chip::default()
        };
        assert!(
            Accelerator::new(chip)
                .unwrap_err()
                .to_string()
                .contains("must be positive")
        );
    }
    let slow = Chip {
        tops: 1e-9,
        ..Chip::default()
    };
    assert!(
        Accelerator::new(slow)
            .unwrap_err()
            .to_string()
            .starts_with("the time per frame of the accelerator must be at most 3600 s, got 5")
    );
}

#[test]
fn hand_a_camera_of_which_nothing_is_asked_has_a_second() {
    for demand in [1.0, 0.5, 0.0] {
        assert_eq!(deadline(ms(40), demand), ms(1040));
    }
}

#[test]
fn paper_twelve_cameras_at_thirty_need_more_than_a_xavier_and_less_than_an_orin() {
    // The first figure of the paper.
    let needed = 12.0 * 30.0;
    let with = |tops| {
        Chip {
            tops,
            ..Chip::default()
        }
        .capacity()
    };
    assert!(with(30.0) < needed && needed < with(275.0));
    assert!((needed * Chip::default().gop_per_frame / 1e3 - 187.0).abs() < 0.5);
}

/// The largest lateness [ms] of frames processed in this order from 0 on, 10 ms each; negative when all are early.
fn lateness<'a>(deadlines: impl IntoIterator<Item = &'a i64>) -> i64 {
    (1..)
        .zip(deadlines)
        .map(|(place, deadline)| 10 * place - deadline)
        .max()
        .expect("at least one")
}

/// All orders of a list.
fn orders(list: &[i64]) -> Vec<Vec<i64>> {
    if list.is_empty() {
        return vec![vec![]];
    }
    let mut all = Vec::new();
    for i in 0..list.len() {
        let rest = [&list[..i], &list[i + 1..]].concat();
        all.extend(
            orders(&rest)
                .into_iter()
                .map(|tail| [&[list[i]], &tail[..]].concat()),
        );
    }
    all
}

proptest! {
    #[test]
    fn law_earliest_deadline_first_is_late_by_the_least_that_any_order_allows(
        deadlines in prop::collection::vec(0..100_i64, 1..6),
    ) {
        let frames: Vec<_> = (0..).zip(&deadlines).map(|(camera, deadline)| (camera, 0, *deadline)).collect();
        let (done, _) = run(chip(Discipline::EarliestDeadline, true), &frames);
        let ours = done.iter().map(|p| (p.ready - p.frame.deadline).nanos() / 1_000_000).max().unwrap();
        prop_assert_eq!(ours, orders(&deadlines).iter().map(lateness).min().unwrap());
    }

    /// Liu & Layland's bound, with the one frame of blocking that work without interruption adds.
    #[test]
    fn law_up_to_full_load_no_frame_is_late_by_more_than_another_frame(
        periods in prop::collection::vec((20..200_i64, 0..200_i64), 1..8),
    ) {
        let load: f64 = periods.iter().map(|(period, _)| 10.0 / *period as f64).sum();
        prop_assume!(load <= 1.0);
        let mut frames: Vec<_> = (0_u8..)
            .zip(&periods)
            .flat_map(|(camera, &(period, phase))| (0..40).map(move |k| (camera, phase + k * period, phase + (k + 1) * period)))
            .collect();
        frames.sort_by_key(|(camera, exposed, _)| (*exposed, *camera));
        let (done, accelerator) = run(chip(Discipline::EarliestDeadline, false), &frames);
        prop_assert_eq!(done.len(), frames.len());
        prop_assert_eq!(accelerator.counts().dropped, 0);
        for processed in done {
            prop_assert!(processed.late().is_none_or(|late| late <= ms(10)), "{processed:?}");
        }
    }

    #[test]
    fn law_nothing_is_lost_nothing_overlaps_and_nobody_idles_while_frames_wait(
        mut frames in prop::collection::vec((0..5_u8, 0..300_i64, 0..400_i64), 1..60),
        earliest: bool,
        drop_stale: bool,
    ) {
        frames.sort_by_key(|(_, exposed, _)| *exposed);
        let discipline = if earliest { Discipline::EarliestDeadline } else { Discipline::Fifo };
        let (done, accelerator) = run(chip(discipline, drop_stale), &frames);
        let counts = accelerator.counts();
        prop_assert_eq!(counts.pushed, frames.len() as u64);
        prop_assert_eq!(counts.begun, done.len() as u64);
        prop_assert_eq!(counts.pushed, counts.begun + counts.dropped);
        prop_assert_eq!(accelerator.waiting(), 0);
        let mut free = SimTime::ZERO;
        for (count, processed) in done.iter().enumerate() {
            prop_assert_eq!(processed.ready - processed.started, ms(10));
            // It begins when the accelerator is free and a frame is there: at once, or when the first of the rest came.
            let there = done[count..].iter().map(|p| p.frame.exposed).min().unwrap();
            prop_assert!(processed.started >= free.max(processed.frame.exposed));
            prop_assert!(processed.started == free.max(there) || drop_stale);
            free = processed.ready;
        }
    }

    #[test]
    fn law_asking_in_between_changes_nothing(
        mut frames in prop::collection::vec((0..5_u8, 0..300_i64, 0..400_i64), 1..40),
        step in 1..40_i64,
        drop_stale: bool,
    ) {
        // Within one instant the camera's own frames come in the order of the list in both runs.
        frames.sort_by_key(|(_, exposed, _)| *exposed);
        frames.dedup_by_key(|(_, exposed, _)| *exposed);
        let chip = chip(Discipline::EarliestDeadline, drop_stale);
        let (at_the_end, _) = run(chip, &frames);
        let mut accelerator = Accelerator::new(chip).unwrap();
        let (mut done, mut left) = (Vec::new(), &frames[..]);
        let mut now = 0;
        while now < 2000 {
            while let Some(((camera, exposed, deadline), rest)) = left.split_first().filter(|(f, _)| f.1 <= now) {
                let frame = Queued { camera: CameraId(*camera), exposed: ms(*exposed), deadline: ms(*deadline) };
                accelerator.push(frame, ms(*exposed), |_| ());
                left = rest;
            }
            while let Some(processed) = accelerator.take(ms(now)) {
                done.push(processed);
            }
            now += step;
        }
        prop_assert_eq!(done, at_the_end);
    }
}
