//! Vehicles that stand or move across the ego's path: boxes as they stand (reading R7).

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use zhuyi_core::FrameRates;
use zhuyi_estimator::{Estimator, State};
use zhuyi_log::{Answer, Log, Replay, evaluate_with_criticality};
use zhuyi_metrics::criticality::Limits;

use crate::{rig, system};

/// The answer for the only other vehicle at the first step.
fn first_answer(trace: &str) -> Answer {
    let (log, system) = (Log::read(trace, Some("ego")).unwrap(), system());
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let replay = Replay::new(&log, log.find("ego").unwrap(), None, 20.0);
    let estimator = Estimator::new(system.estimator.clone());
    let rig = rig(&system, &rates);
    let mut steps = evaluate_with_criticality(&replay, &estimator, &rig, &Limits::default()).steps;
    steps.swap_remove(0).actors.swap_remove(0)
}

/// 4 s of an ego of 4.5 m x 1.8 m at 10 m/s and of another at heading `heading` from (x, y) on, which moves where it points.
fn trace(size: (f64, f64), (x, y, heading): (f64, f64, f64), speed: f64) -> String {
    let mut text =
        String::from("time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n");
    for step in 0..=40 {
        let t = f64::from(step) / 10.0;
        let (sin, cos) = libm::sincos(heading);
        let (x, y) = (x + speed * t * cos, y + speed * t * sin);
        let _ = writeln!(text, "{t},ego,{},0,0,10,0,4.5,1.8", 10.0 * t);
        let _ = writeln!(
            text,
            "{t},other,{x},{y},{heading},{speed},0,{},{}",
            size.0, size.1
        );
    }
    text
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

fn near(found: Option<f64>, expected: f64) -> bool {
    found.is_some_and(|found| (found - expected).abs() < 1e-3)
}

/// (50 - 1.25 - 2.25) / 10 = 4.65 s, and asked for as a car that stands 46.5 m ahead.
fn is_a_bus_across(trace_of_bus: &str) {
    let bus = first_answer(trace_of_bus);
    let found = bus.criticality.unwrap();
    assert!(
        near(found.ttc, 4.65) && near(found.ttc_2d, 4.65),
        "{found:?}"
    );
    let car = first_answer(&trace((4.5, 1.8), (51.0, 0.0, 0.0), 0.0));
    assert_eq!(bus.estimate.state, State::Tolerable);
    assert_eq!(bus.estimate.latency, car.estimate.latency);
}

/// It leaves after (10 + 2.25 + 0.9) / 4 = 3.2875 s, and the ego's front is there after (60 - 0.9 - 2.25) / 10 = 5.685 s.
fn crosses(trace: &str) {
    let found = first_answer(trace).criticality.unwrap();
    assert!(near(found.pet, 5.685 - 3.2875), "{found:?}");
}

#[test]
fn hand_a_bus_across_the_lane_is_an_obstacle() {
    is_a_bus_across(&trace((12.0, 2.5), (50.0, 5.0, FRAC_PI_2), 0.0));
    if let Some(trace) = shared("P_bus_across.csv") {
        is_a_bus_across(&trace);
    }
}

#[test]
fn hand_who_crosses_is_as_wide_as_it_is_long() {
    crosses(&trace((4.5, 1.8), (60.0, -10.0, FRAC_PI_2), 4.0));
    if let Some(trace) = shared("P_cross.csv") {
        crosses(&trace);
    }
}
