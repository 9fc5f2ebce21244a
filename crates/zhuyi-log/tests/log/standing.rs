//! An ego that stands (reading R8b), and headings that bend nothing while it does (reading R7).

use std::fs;
use std::path::Path;

use zhuyi_core::FrameRates;
use zhuyi_estimator::{Estimator, State};
use zhuyi_log::{Answers, Log, Replay, evaluate_with_criticality};
use zhuyi_metrics::criticality::Limits;

use crate::laws::{Numbers, text};
use crate::{rig, system};

fn evaluated(trace: &str) -> (Log, Vec<Answers>) {
    let (log, system) = (Log::read(trace, Some("ego")).unwrap(), system());
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let replay = Replay::new(&log, log.find("ego").unwrap(), None, 20.0);
    let (estimator, rig) = (
        Estimator::new(system.estimator.clone()),
        rig(&system, &rates),
    );
    let steps = evaluate_with_criticality(&replay, &estimator, &rig, &Limits::default()).steps;
    (log, steps)
}

/// A file of `../shared/data/faults` beside the repository, if it is there.
fn shared(file: &str) -> Option<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/faults");
    let text = fs::read_to_string(folder.join(file)).ok();
    if text.is_none() {
        crate::skipped(&format!("faults/{file}"));
    }
    text
}

/// An ego stands; one comes towards it at 10 m/s and passes with 2 m between the centres of both.
fn oncoming() -> String {
    let rows = (0..41).flat_map(|step| {
        let t = f64::from(step) / 10.0;
        [
            (t, "ego", [0.0; 5]),
            (
                t,
                "on",
                [45.0 - 10.0 * t, 2.0, std::f64::consts::PI, 10.0, 0.0],
            ),
        ]
    });
    text(&rows.collect::<Vec<(f64, &str, Numbers)>>())
}

fn asks_for_nothing(trace: &str) {
    let (_, steps) = evaluated(trace);
    let mut standing = 0;
    for step in &steps {
        for answer in &step.actors {
            assert!(
                matches!(answer.estimate.state, State::Standing | State::None),
                "{answer:?}"
            );
            assert_eq!(answer.estimate.fpr(), Some(1.0));
            standing += usize::from(answer.estimate.state == State::Standing);
        }
        for demand in &step.demands {
            assert_eq!((demand.fpr, demand.actor), (1.0, None));
        }
    }
    let first = &steps[0];
    assert_eq!(first.actors[0].estimate.state, State::Standing);
    assert!(first.demands.iter().any(|demand| demand.standing == 1));
    assert!(standing >= 40, "{standing} of {}", steps.len());
}

#[test]
fn hand_a_standing_ego_is_asked_for_nothing_by_who_passes() {
    asks_for_nothing(&oncoming());
    if let Some(trace) = shared("stand.csv") {
        asks_for_nothing(&trace);
    }
}

/// The ego brakes at 3 m/s2 from 15 m/s, stands after 5 s and 37.5 m, and 3 m before a wreck; standing, it heads
/// elsewhere.
fn stops(heading: impl Fn(i32) -> f64) -> String {
    let rows = (0..81).flat_map(|step| {
        let t = f64::from(step) / 10.0;
        let x = t.min(5.0);
        let (speed, accel) = (15.0 - 3.0 * x, if t < 5.0 { -3.0 } else { 0.0 });
        let heading = if t < 5.0 { 0.0 } else { heading(step) };
        [
            (
                t,
                "ego",
                [15.0 * x - 1.5 * x * x, 0.0, heading, speed, accel],
            ),
            (t, "wreck", [45.0, 0.0, 0.0, 0.0, 0.0]),
        ]
    });
    text(&rows.collect::<Vec<(f64, &str, Numbers)>>())
}

/// The answers while the ego moves are those of an ego that heads straight on.
fn bends_nothing(spun: &str, straight: &str) {
    let ((log, spun), (_, straight)) = (evaluated(spun), evaluated(straight));
    let moves = |step: &Answers| {
        let rows = &log.vehicle(log.find("ego").unwrap()).rows;
        let at = rows.iter().find(|row| row.step == step.step);
        at.is_some_and(|row| row.speed >= 0.1)
    };
    let mut compared = 0;
    for (one, other) in spun.iter().zip(&straight) {
        if moves(one) {
            assert_eq!(one, other);
            compared += 1;
        }
    }
    assert!(compared >= 49, "{compared}");
}

/// At 0 s the wreck is 45 - 4.6 = 40.4 m ahead: TTC 2.693 s, DRAC 225 / 80.8 = 2.785 m/s2. The ego stands after 37.5 m
/// by itself, more than the 0.9 x 40.4 = 36.4 m of Eq. 1; it brakes at 4.9 m/s2 after t_r: 15 t_r - 1.5 t_r^2 + (15 - 3
/// t_r)^2 / 9.8 <= 36.36 gives t_r <= 3.602 s, and 6 l - 1/6 <= 3.602 makes it l <= 0.628, on the grid 0.604 s.
#[test]
fn hand_the_heading_of_a_standing_ego_bends_nothing() {
    let straight = stops(|_| 0.0);
    let quarter = |_| 1.57;
    let spins = |step: i32| f64::from(step % 7) - 3.0;
    for spun in [stops(quarter), stops(spins)] {
        bends_nothing(&spun, &straight);
    }
    let (_, steps) = evaluated(&stops(quarter));
    let answer = &steps[0].actors[0];
    assert_eq!(
        (answer.estimate.state, answer.estimate.latency),
        (State::Tolerable, Some(0.604))
    );
    let found = answer.criticality.unwrap();
    assert!((found.ttc.unwrap() - 40.4 / 15.0).abs() < 1e-9);
    assert!((found.drac.unwrap() - 225.0 / 80.8).abs() < 1e-9);
}

/// The same on the files that show it.
#[test]
fn hand_spun_and_straight_records_agree() {
    let (Some(spun), Some(straight)) = (shared("L1_spin.csv"), shared("L1_ok.csv")) else {
        return;
    };
    bends_nothing(&spun, &straight);
    let (_, steps) = evaluated(&spun);
    let answer = &steps[0].actors[0];
    assert_eq!(answer.estimate.latency, Some(0.637));
    let found = answer.criticality.unwrap();
    assert!(
        (found.ttc.unwrap() - 2.70).abs() < 0.005 && (found.drac.unwrap() - 2.78).abs() < 0.005
    );
}

/// An ego that stands askew, then drives off along x: the path comes along the heading with which it moves first, so who is
/// behind it is behind.
#[test]
fn hand_an_ego_that_drives_off_comes_from_where_it_drives_to() {
    let trace = |askew: f64| {
        let rows = (0..60).flat_map(|step| {
            let t = f64::from(step) / 10.0;
            let x = (t - 2.0).max(0.0);
            let (heading, accel) = if t < 2.05 { (askew, 0.0) } else { (0.0, 2.0) };
            [
                (t, "ego", [x * x, 0.0, heading, 2.0 * x, accel]),
                (t, "behind", [-30.0 + 5.0 * t, 0.0, 0.0, 5.0, 0.0]),
                (t, "ahead", [80.0, 0.3, 0.0, 0.0, 0.0]),
            ]
        });
        let trace = text(&rows.collect::<Vec<(f64, &str, Numbers)>>());
        let (_, steps) = evaluated(&trace);
        let answers = steps.iter().flat_map(|step| &step.actors);
        let told = answers.map(|answer| (answer.estimate, answer.criticality));
        told.collect::<Vec<_>>()
    };
    let straight = trace(0.0);
    assert!(
        straight
            .iter()
            .any(|(estimate, _)| estimate.state == State::Standing)
    );
    assert_eq!(trace(1.57), straight);
}
