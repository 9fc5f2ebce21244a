//! What reads as a recording must be told of: its evaluation, the files that tell it, and its report.

use zhuyi_core::Road;
use zhuyi_estimator::{Estimator, Watch};
use zhuyi_log::files::{actors_csv, cameras_csv, criticality_csv};
use zhuyi_log::{Consistency, Log, Replay, Summary, evaluate_with_criticality};
use zhuyi_metrics::criticality::Limits;

use zhuyi_report::Recording;

use crate::SYSTEM;

/// Rows up to which a recording is evaluated.
const ROWS: usize = 60;

/// Evaluates a recording for its first vehicle, along its own path and on a straight road.
pub fn evaluate(log: &Log, text: &str) {
    let straight = Road::straight(2_000.0, 3, 3.5).ok();
    for road in [None, straight.as_ref()] {
        evaluate_on(log, text, road);
    }
}

fn evaluate_on(log: &Log, text: &str, road: Option<&Road>) {
    let rows: usize = log
        .vehicles()
        .iter()
        .map(|vehicle| vehicle.rows.len())
        .sum();
    let Some(ego) = log.vehicles().first().and_then(|first| log.find(&first.id)) else {
        return;
    };
    if rows > ROWS {
        return;
    }
    let system = &*SYSTEM;
    let rig: Vec<Watch<'_>> = (system.perception.eyes.iter())
        .map(|eye| Watch {
            camera: &eye.camera,
            current_latency: 1.0 / 30.0,
        })
        .collect();
    let limits = Limits {
        max_decel: system.vehicle.max_decel,
        lateral_margin: system.estimator.lateral_margin,
        horizon: system.estimator.horizon,
    };
    let estimator = Estimator::new(system.estimator.clone());
    let horizon = estimator.params().horizon;
    let replay = Replay::new(log, ego, road, horizon);
    let evaluation = evaluate_with_criticality(&replay, &estimator, &rig, &limits);
    let _ = Summary::new(log, &evaluation, &rig, horizon);
    let _ = Consistency::new(log, ego);
    for text in [
        actors_csv(log, &evaluation, &rig),
        cameras_csv(log, &evaluation, &rig),
        criticality_csv(log, &evaluation),
    ] {
        assert!(!text.contains("NaN"), "{text}");
    }
    let recording = Recording {
        name: "fuzzed".to_string(),
        log,
        ego,
        road,
        system,
        rates: &system.default_rates,
        version: "0",
        command: String::new(),
        text,
    };
    assert!(serde_json::to_string(&recording.document()).is_ok());
}
