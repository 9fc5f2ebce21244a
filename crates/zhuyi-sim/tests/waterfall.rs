//! Why collisions happened, told of the scenarios that come with the program.

#![expect(clippy::unwrap_used, reason = "a test may")]

use zhuyi_core::{FrameRates, SimTime};
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Cause, Outcome, RunRecord, RunSpec, Stage, Waterfall};

fn meant(name: &str) -> (Scenario, System) {
    let scenario = Source::new(format!("{name}.ron"), embedded::scenario(name).unwrap());
    load(
        &scenario,
        &Source::new("default.ron", embedded::system()),
        &[],
    )
    .unwrap()
}

fn drive(scenario: &Scenario, system: &System, fpr: f64, seed: u64) -> RunRecord {
    let rates = FrameRates::new(vec![fpr; system.perception.eyes.len()]);
    RunSpec::new(scenario.clone(), system.clone())
        .with_seed(seed)
        .at_rates(rates.clone())
        .witnessed()
        .run_fixed()
}

/// Every collision at a low rate of the nine scenarios.
fn collisions(mut look: impl FnMut(&Scenario, &System, f64, &RunRecord, &Waterfall)) -> usize {
    let mut count = 0;
    for name in embedded::names() {
        let (scenario, system) = meant(name);
        for fpr in [1.0, 2.0, 3.0, 4.0, 5.0] {
            for seed in 0..5 {
                let run = drive(&scenario, &system, fpr, seed);
                if let Some(waterfall) = Waterfall::of(&scenario, &system, &run) {
                    count += 1;
                    look(&scenario, &system, fpr, &run, &waterfall);
                }
            }
        }
    }
    count
}

#[test]
fn law_stages_come_in_order_and_their_metres_are_the_way_from_exposed_to_contact() {
    let count = collisions(|scenario, _, fpr, run, waterfall| {
        let name = format!("{} at {fpr}: {waterfall:?}", scenario.name);
        let times: Vec<SimTime> = waterfall
            .steps
            .iter()
            .filter_map(|step| step.time)
            .collect();
        assert!(times.is_sorted(), "{name}");
        assert!(
            waterfall.steps.iter().all(|step| step.metres >= 0.0),
            "{name}"
        );
        let Outcome::Collision(collision) = &run.outcome else {
            panic!("{name}")
        };
        assert_eq!(waterfall.steps[6].time, Some(collision.time));
        // On roads as straight as these the way is the difference in s, of rows and of the last part of a step.
        let Some(exposed) = waterfall.steps[0].time else {
            return;
        };
        let s = |time: SimTime| {
            let before = run
                .trace
                .rows()
                .filter(|row| row.time <= time)
                .last()
                .unwrap();
            let rest = (time - before.time).seconds();
            before.ego.road.s + before.ego.s_rate * rest + before.ego.accel * rest * rest / 2.0
        };
        let way = s(collision.time) - s(exposed);
        assert!(
            (waterfall.metres() - way).abs() < 0.02 * way + 0.01,
            "{way}, {name}"
        );
    });
    assert!(count >= 30, "{count}");
}

#[test]
fn law_the_frames_that_a_waterfall_tells_of_are_frames_of_the_run() {
    let mut by_sight = 0;
    collisions(|scenario, system, fpr, run, waterfall| {
        let name = format!("{} at {fpr}: {waterfall:?}", scenario.name);
        if waterfall.cause != Cause::Sight {
            return;
        }
        by_sight += 1;
        let time = |stage: Stage| waterfall.steps[stage as usize].time;
        let (Some(exposed), Some(captured), Some(processed)) = (
            time(Stage::Exposed),
            time(Stage::Captured),
            time(Stage::Processed),
        ) else {
            return;
        };
        // No camera waits longer than its period to take a picture, and a picture takes a period and what is left of a step.
        let period = 1.0 / fpr;
        assert!((captured - exposed).seconds() < period + 0.01, "{name}");
        let latency = (processed - captured).seconds();
        assert!(
            (-1e-9..0.01).contains(&(latency - period)),
            "{latency} {name}"
        );
        let frames = run.witness.as_ref().unwrap().frames();
        assert!(
            frames
                .iter()
                .any(|frame| frame.exposed == captured && frame.shows(waterfall.actor)),
            "{name}"
        );
        if let Some(confirmed) = time(Stage::Confirmed) {
            let frames = f64::from(system.perception.eyes[0].confirm_frames);
            // K - 1 periods behind the first at the least, where one camera finds it in every frame.
            let wait = (confirmed - processed).seconds() / period;
            assert!(wait > frames - 2.0, "{wait} {name}");
        }
    });
    assert!(by_sight >= 10, "{by_sight}");
}

#[test]
fn law_a_run_with_a_witness_is_the_run_without() {
    let (scenario, system) = meant("cut-out-fast");
    let rates = FrameRates::new(vec![5.0; system.perception.eyes.len()]);
    let without = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates.clone())
        .run_fixed();
    let with = drive(&scenario, &system, 5.0, 0);
    assert_eq!(without.trace, with.trace);
    assert_eq!(without.frames, with.frames);
    assert!(without.witness.is_none());
    // The frames are those that were counted.
    let frames = with.witness.as_ref().unwrap().frames();
    let counted = |camera: usize| {
        frames
            .iter()
            .filter(move |frame| frame.camera.index() == camera)
    };
    for (camera, count) in with.frames.iter().enumerate() {
        assert_eq!(counted(camera).count() as u64, count.exposed);
        let taken = counted(camera).filter(|frame| frame.taken.is_some());
        assert_eq!(taken.count() as u64, count.processed);
    }
}

#[test]
fn law_there_is_nothing_to_tell_where_nothing_was_hit() {
    let (scenario, system) = meant("cut-out-fast");
    let run = drive(&scenario, &system, 30.0, 0);
    assert!(!run.collided());
    assert_eq!(Waterfall::of(&scenario, &system, &run), None);
}
