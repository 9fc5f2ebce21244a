//! The largest demands of a run are those of taking every row, every camera and every actor one by one: what is carried over from row
//! to row (who covers whom, proofs of answers, rows at which nothing has changed) only saves work.

use zhuyi_core::{ActorId, FrameRates};
use zhuyi_estimator::{Estimator, Evasion, Params, PhantomParams, Solver, Watch};
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Hindsight, Peaks, RunRecord, RunSpec};

fn scenario(name: &str) -> (Scenario, System) {
    let text = embedded::scenario(name).expect("an embedded name");
    let system = Source::new("default.ron", embedded::system());
    load(&Source::new(format!("{name}.ron"), text), &system, &[]).expect("a valid scenario")
}

fn drive(scenario: &Scenario, system: &System, rates: &FrameRates) -> RunRecord {
    RunSpec::new(scenario.clone(), system.clone())
        .with_seed(3)
        .at_rates(rates.clone())
        .run_fixed()
}

/// Row by row, nothing remembered.
fn plainly(
    hindsight: &Hindsight<'_>,
    (run, system, rates): (&RunRecord, &System, &FrameRates),
    estimator: &Estimator,
) -> Peaks {
    let rig: Vec<_> = system.perception.eyes.iter().zip(rates.all()).collect();
    let rig: Vec<_> = rig
        .iter()
        .map(|(eye, hz)| Watch {
            camera: &eye.camera,
            current_latency: 1.0 / **hz,
        })
        .collect();
    let mut peaks = hindsight.no_peaks();
    for row in run.trace.rows() {
        let actors = (0..).map(ActorId).zip(row.actors);
        let answer = |actor, l_0| hindsight.estimate(estimator, &row, actor, l_0);
        let demands = estimator.demands(&rig, row.ego.pose, actors, answer);
        hindsight.add(&mut peaks, row.time, &demands);
    }
    peaks
}

#[test]
fn law_peaks_are_those_of_every_row() {
    let rates = [
        FrameRates::new(vec![30.0, 12.0, 7.0, 7.0, 3.0]),
        FrameRates::new(vec![6.0; 5]),
    ];
    for name in embedded::names() {
        let (scenario, system) = scenario(name);
        for rates in &rates {
            let run = drive(&scenario, &system, rates);
            let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, rates);
            for solver in [Solver::Exact, Solver::Paper] {
                let estimator = Estimator::new(Params {
                    solver,
                    ..system.estimator.clone()
                });
                let plain = plainly(&hindsight, (&run, &system, rates), &estimator);
                assert_eq!(hindsight.peaks(&estimator), plain, "{name} {solver:?}");
            }
        }
    }
}

#[test]
fn law_so_they_are_where_the_ego_may_evade() {
    let (scenario, system) = scenario("cut-out-fast");
    let rates = FrameRates::new(vec![30.0; 5]);
    let run = drive(&scenario, &system, &rates);
    let hindsight =
        Hindsight::new(&run.trace, &scenario.road, &system, &rates).with_evasion(&scenario.road);
    let estimator = Estimator::new(Params {
        evasion: Some(Evasion::default()),
        ..system.estimator.clone()
    });
    let plain = plainly(&hindsight, (&run, &system, &rates), &estimator);
    assert_eq!(hindsight.peaks(&estimator), plain);
}

#[test]
fn law_so_they_are_with_phantoms() {
    let (scenario, system) = scenario("cut-out-fast");
    let rates = FrameRates::new(vec![30.0; 5]);
    let run = drive(&scenario, &system, &rates);
    let params = PhantomParams::default();
    let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, &rates)
        .with_phantoms(&scenario.road, params);
    let estimator = Estimator::new(system.estimator.clone());
    let mut peaks = hindsight.no_peaks();
    for row in run.trace.rows() {
        let demands = hindsight.demands(&estimator, &row);
        hindsight.add(&mut peaks, row.time, &demands);
    }
    assert_eq!(hindsight.peaks(&estimator), peaks);
}
