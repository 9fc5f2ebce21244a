//! Real traffic from `../shared/data/traces` beside the repository, where it exists: every vehicle as the ego, and the
//! figures of the crate's page.

use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use zhuyi_core::{ActorId, FrameRates};
use zhuyi_estimator::{Estimator, State};
use zhuyi_log::{Consistency, Log, Replay, Summary, evaluate};

use crate::plain::{Differences, Frame, compare};

pub const FILES: [&str; 2] = ["us101-4_1.csv", "us101-5_1.csv"];

pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/traces")
}

/// A recording, if it is there.
fn recording(file: &str) -> Option<Log> {
    let Ok(text) = fs::read_to_string(folder().join(file)) else {
        crate::skipped(&format!("traces/{file}"));
        return None;
    };
    Some(Log::read(&text, None).unwrap())
}

/// The row of every vehicle as the ego, as `zhuyi estimate --all-egos` tells it.
fn egos(log: &Log) -> String {
    let system = crate::system();
    let estimator = Estimator::new(system.estimator.clone());
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let rig = crate::rig(&system, &rates);
    let mut text = String::new();
    for (place, vehicle) in log.vehicles().iter().enumerate() {
        let replay = Replay::new(log, ActorId(place as u32), None, 20.0);
        let evaluation = evaluate(&replay, &estimator, &rig);
        let rows = vehicle.rows.len();
        assert_eq!(
            (evaluation.steps.len(), evaluation.skipped),
            (rows, log.steps().len() - rows)
        );
        let summary = Summary::new(log, &evaluation, &rig, 20.0);
        let states = summary
            .states
            .map(|answers| answers.to_string())
            .join(" | ");
        let (camera, peak) = summary.highest(&rig).unwrap();
        let (id, fpr) = (&vehicle.id, peak.fpr);
        let share = 100.0 * summary.extrapolated.unwrap();
        write!(text, "| {id} | {rows} | {states} | {fpr:.2} |").unwrap();
        match peak.asked {
            Some((step, actor)) => {
                let (time, whom) = (&log.steps()[step].text, &log.vehicle(actor).id);
                write!(text, " {} | {time} | {whom} |", rig[camera].camera.name).unwrap();
            }
            None => text += " | | |",
        }
        writeln!(text, " {share:.1} |").unwrap();
    }
    text
}

fn choice(what: &str, found: &Differences) -> String {
    let share = |part: usize| format!("{:.1}", 100.0 * part as f64 / found.all as f64);
    let Differences {
        all,
        conflict,
        differ,
        by_two,
    } = *found;
    format!(
        "| {what} | {all} | {conflict} ({}) | {differ} ({}) | {by_two} |\n",
        share(conflict),
        share(differ)
    )
}

/// What other readings of the frame would change.
fn choices(log: &Log) -> String {
    let choices = [
        (
            Frame::Whole,
            "the recorded past behind the ego, not straight back",
        ),
        (
            Frame::LastLeg,
            "straight on along the last leg, not the last heading",
        ),
        (
            Frame::EveryPosition,
            "every recorded position, straight on along the last leg",
        ),
        (Frame::Heading, "straight along the heading at t_0"),
    ];
    choices
        .iter()
        .map(|(frame, what)| choice(what, &compare(log, *frame, 5)))
        .collect()
}

/// The page has these blocks, or the test shows what they should be.
fn has(blocks: impl Iterator<Item = String>) {
    let page = include_str!("../../src/recordings.md");
    let missing: Vec<String> = blocks.filter(|block| !page.contains(block)).collect();
    assert!(
        missing.is_empty(),
        "src/recordings.md lacks these blocks:\n{}",
        missing.join("\n")
    );
}

#[test]
fn regress_every_vehicle_as_the_ego_and_the_page_tells_what_came_out() {
    has(FILES
        .iter()
        .filter_map(|file| Some(egos(&recording(file)?))));
}

#[test]
fn regress_the_page_tells_what_other_readings_would_change() {
    has(FILES
        .iter()
        .filter_map(|file| Some(choices(&recording(file)?))));
}

#[test]
fn law_each_question_alone_has_the_same_answer() {
    for log in FILES.iter().filter_map(|file| recording(file)) {
        let found = compare(&log, Frame::Ahead, 1);
        assert!(found.all > 10_000 && found.differ == 0, "{found:?}");
    }
}

/// Vehicle 427 stops behind 422 at 6.2 s; 422 leaves the record at the same time.
#[test]
fn hand_past_the_last_row_a_future_is_extrapolated() {
    let Some(log) = recording(FILES[0]) else {
        return;
    };
    let replay = Replay::new(&log, log.find("427").unwrap(), None, 20.0);
    let system = crate::system();
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let rig = crate::rig(&system, &rates);
    let evaluation = evaluate(&replay, &Estimator::new(system.estimator.clone()), &rig);
    let lead = log.find("422").unwrap();
    let ego = log.vehicle(replay.ego());
    for step in &evaluation.steps {
        let time = log.steps()[step.step].time;
        let answer = step.actors.iter().find(|answer| answer.actor == lead);
        assert_eq!(answer.is_some(), time <= 6.2);
        if let Some(answer) = answer {
            assert!((answer.estimate.extrapolated - (20.0 - (6.2 - time))).abs() < 1e-9);
            // Behind 422, which stands, it creeps up and stands at last (reading R8b).
            let row = ego.rows.iter().find(|row| row.step == step.step).unwrap();
            let stands = row.speed < 0.1 && (row.accel <= 0.0 || row.speed <= 0.0);
            let expected = if stands {
                State::Standing
            } else {
                State::Tolerable
            };
            assert_eq!(answer.estimate.state, expected, "{time}");
        }
    }
}

/// Every vehicle drives where it heads and as fast as it says; in degrees or km/h it does not.
#[test]
fn law_wrong_units_give_themselves_away_and_right_ones_do_not() {
    for file in FILES {
        let Some(log) = recording(file) else {
            continue;
        };
        for (place, vehicle) in log.vehicles().iter().enumerate() {
            let found = Consistency::new(&log, ActorId(place as u32));
            assert!(
                found.direction.is_none() && found.speed.is_none(),
                "{file} {}: {found:?}",
                vehicle.id
            );
        }
        // Rows are rewritten field by field: the heading in degrees, the speed in km/h.
        let text = fs::read_to_string(folder().join(file)).unwrap();
        let changed = |column: usize, factor: f64| {
            let rows = text.lines().enumerate().map(|(line, row)| {
                let mut cells: Vec<String> = row.split(',').map(String::from).collect();
                if line > 0 {
                    let number: f64 = cells[column].parse().unwrap();
                    cells[column] = (number * factor).to_string();
                }
                cells.join(",") + "\n"
            });
            Log::read(&rows.collect::<String>(), None).unwrap()
        };
        let (degrees, kmh) = (changed(4, 180.0 / PI), changed(5, 3.6));
        let (mut moving, mut turned, mut faster) = (0, 0, 0);
        for place in 0..log.vehicles().len() {
            let ego = ActorId(place as u32);
            let found = Consistency::new(&degrees, ego);
            moving += usize::from(found.stretches > 0);
            turned += usize::from(found.direction.is_some());
            faster += usize::from(Consistency::new(&kmh, ego).speed.is_some());
        }
        assert_eq!((turned, faster), (moving, moving), "{file}");
    }
}
