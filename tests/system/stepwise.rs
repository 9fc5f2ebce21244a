//! A run step by step from outside: observed and acted on it is the run of the built-in loop, and reset it is a new one.

use rayon::prelude::*;
use zhuyi_core::stages::{CameraState, Policy, Situation};
use zhuyi_core::{Command, Manoeuvre, SimTime};
use zhuyi_scenario::{System, embedded};
use zhuyi_scheduler::{Chip, Compute, POLICIES, policy};
use zhuyi_sim::{Action, RunRecord, RunSpec, Simulation, Waterfall, known_future};

use crate::read;

const BUDGET: f64 = 25.0;

/// Every built-in policy that is no program.
fn policies() -> impl Iterator<Item = &'static str> {
    POLICIES.into_iter().filter_map(|entry| match entry.id {
        "static:CAMERA=RATE,.." => Some("static:front=8,left=2"),
        "exec:COMMAND" => None,
        name => Some(name),
    })
}

fn assert_same(one: &RunRecord, other: &RunRecord, what: &str) {
    assert!(one.trace == other.trace, "{what}: the traces differ");
    assert_eq!(one.frames, other.frames, "{what}");
    assert_eq!(one.manoeuvres, other.manoeuvres, "{what}");
    assert!(
        one.decisions == other.decisions,
        "{what}: the decisions differ"
    );
    let (ends, other) = (format!("{:?}", one.outcome), format!("{:?}", other.outcome));
    assert_eq!(ends, other, "{what}");
}

/// A policy asked by a caller of its own, at every decision that is due.
fn driven_by_hand(spec: RunSpec, policy: &mut dyn Policy) -> RunRecord {
    let models: Vec<&str> = policy.demand_models().to_vec();
    let spec = spec.under_caller(BUDGET).expect("a budget");
    let mut simulation = Simulation::new(spec.with_demand_models(&models));
    let (scenario, system) = (
        simulation.spec().scenario().clone(),
        simulation.spec().system().clone(),
    );
    let (eyes, seed) = (&system.perception.eyes, simulation.spec().seed());
    while !simulation.is_over() {
        if simulation.decision_is_due() {
            let observed = simulation.observe();
            let states = eyes.iter().zip(observed.rates);
            let states: Vec<_> = states
                .map(|(eye, rate)| CameraState {
                    camera: &eye.camera,
                    rate: *rate,
                })
                .collect();
            let situation = Situation {
                scenario: &scenario.name,
                seed,
                time: observed.time.seconds(),
                budget: observed.budget.expect("it has one"),
                ego: observed.ego,
                tracks: observed.tracks,
                cameras: &states,
                demands: observed.demands,
            };
            let mut rates = vec![0.0; eyes.len()];
            situation.decided_by(policy, &mut rates).expect("an answer");
            simulation.act(Action::Rates(&rates)).expect("good rates");
        }
        simulation.step().expect("no policy of its own");
    }
    simulation.finish()
}

#[test]
fn law_a_policy_driven_by_hand_is_the_policy_in_the_loop() {
    let names: Vec<_> = embedded::names().collect();
    let all: Vec<(&str, u64)> = (names.iter())
        .flat_map(|name| (0..10).map(move |seed| (*name, seed)))
        .collect();
    assert_eq!((policies().count(), all.len()), (14, 90));
    all.into_par_iter().for_each(|(name, seed)| {
        let (scenario, system) = read(name, &[]);
        let spec = RunSpec::new(scenario, system).with_seed(seed);
        let full = spec.clone().at_rate(30.0);
        let (rates, run) = (full.first_rates(), full.run_fixed());
        let future = known_future(&run.trace, &spec.scenario().road, spec.system(), &rates);
        let spec = spec.with_known_future(future);
        for policy_name in policies() {
            let in_loop = spec
                .clone()
                .under_policy(policy_name, BUDGET)
                .expect("a policy");
            let in_loop = in_loop.run().expect("an answer");
            let mut asked = policy(policy_name).expect("a policy");
            let by_hand = driven_by_hand(spec.clone(), &mut *asked);
            assert_same(
                &in_loop,
                &by_hand,
                &format!("{policy_name}, {name}, {seed}"),
            );
        }
    });
}

#[test]
fn law_a_reset_run_is_a_new_run() {
    for name in embedded::names() {
        let (scenario, system) = read(name, &[]);
        let spec = RunSpec::new(scenario, system);
        let mut slow = System::clone(spec.system());
        slow.compute = Compute::Accelerator(Chip::default());
        let queued = RunSpec::new(spec.scenario().clone(), slow).at_rate(8.0);
        for spec in [
            queued,
            spec.clone()
                .under_policy("phantom", BUDGET)
                .expect("a policy"),
            spec.clone().at_rate(4.0).witnessed(),
            spec.under_policy("demand-hysteresis", BUDGET)
                .expect("a policy"),
        ] {
            let mut simulation = Simulation::new(spec.clone());
            for seed in [5, 1] {
                for _ in 0..700 {
                    simulation.step().expect("an answer");
                }
                simulation.reset(seed);
                while !simulation.is_over() {
                    simulation.step().expect("an answer");
                }
                let reset = simulation.finish();
                let new = spec.clone().with_seed(seed).run().expect("an answer");
                assert_eq!(reset.witness, new.witness);
                assert_same(&reset, &new, &format!("{name}, {seed}"));
                simulation.reset(seed + 1);
            }
        }
    }
}

#[test]
fn law_who_only_observes_changes_nothing() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let spec = RunSpec::new(scenario, system);
    for spec in [
        spec.clone().at_rate(6.0),
        spec.under_policy("phantom", BUDGET).expect("a policy"),
    ] {
        let mut simulation = Simulation::new(spec.clone());
        while !simulation.is_over() {
            let observed = simulation.observe();
            assert_eq!(observed.tracks.len(), observed.forecasts.len());
            simulation.step().expect("an answer");
        }
        let plain = spec.run().expect("an answer");
        assert_same(&simulation.finish(), &plain, "observed");
    }
}

/// A caller that brakes at 3 m/s2 from 20 m/s stands after v / b = 6.7 s, a little later for the lag of the brakes.
#[test]
fn hand_a_commanded_ego_does_as_it_is_told() {
    let (scenario, system) = read("vehicle-following", &["ego.speed_mps=20"]);
    let mut simulation = Simulation::new(RunSpec::new(scenario, system));
    let mut stands = None;
    while !simulation.is_over() && stands.is_none() {
        let command = Command {
            accel: -3.0,
            curvature: 0.0,
            manoeuvre: Manoeuvre::Brake,
        };
        simulation
            .act(Action::Command(command))
            .expect("any command");
        simulation.step().expect("rates that stay");
        let observed = simulation.observe();
        stands = (observed.ego.speed == 0.0).then_some(observed.time.seconds());
    }
    assert!(
        stands.is_some_and(|time| (6.67..7.2).contains(&time)),
        "{stands:?}"
    );
}

#[test]
fn hand_rates_of_a_caller_are_checked() {
    let (scenario, system) = read("cut-in", &[]);
    let spec = RunSpec::new(scenario, system).with_seed(7);
    let refused = |spec: &RunSpec, rates: &[f64]| {
        let mut simulation = Simulation::new(spec.clone());
        let refused = simulation.act(Action::Rates(rates));
        refused.expect_err("refused").to_string()
    };
    let limited = spec.clone().under_caller(20.0).expect("a budget");
    for (rates, told) in [
        (
            &[5.0; 5][..],
            "`the caller` gives 25 frames per second altogether, with a budget of 20",
        ),
        (
            &[f64::NAN; 5],
            "`the caller` gives `front_120` NaN frames per second, outside 1 to 30",
        ),
        (&[5.0; 4], "4 places for the rates of 5 cameras"),
    ] {
        assert_eq!(
            refused(&limited, rates),
            format!("cut-in, seed 7, at 0.000 s: {told}")
        );
    }
    assert_eq!(
        refused(&spec, &[31.0; 5]),
        "cut-in, seed 7, at 0.000 s: `the caller` gives `front_120` 31 frames per second, outside 1 to 30"
    );
    for budget in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(spec.clone().under_caller(budget).is_err());
        assert!(spec.clone().under_policy("uniform", budget).is_err());
    }
}

/// Rates may change at every step, also where no decision is due and none is made.
#[test]
fn hand_rates_of_a_caller_hold_from_the_step_on() {
    let (scenario, system) = read("cut-in", &["duration_s=2"]);
    let mut simulation = Simulation::new(RunSpec::new(scenario, system).at_rate(10.0));
    while !simulation.is_over() {
        if simulation.time() == SimTime::from_millis(1030) {
            simulation
                .act(Action::Rates(&[30.0, 10.0, 10.0, 10.0, 10.0]))
                .expect("good rates");
        }
        simulation.step().expect("rates that stay");
    }
    let frames: Vec<u64> = simulation
        .finish()
        .frames
        .iter()
        .map(|of| of.exposed)
        .collect();
    assert!(
        (38..=41).contains(&frames[0]) && frames[1..].iter().all(|of| (19..=21).contains(of)),
        "{frames:?}"
    );
}

/// The caller's rates stand in place of the policy's, for that decision alone.
#[test]
fn hand_a_caller_may_decide_in_place_of_a_policy() {
    let (scenario, system) = read("cut-in", &["duration_s=6"]);
    let spec = RunSpec::new(scenario, system).under_policy("uniform", BUDGET);
    let mut simulation = Simulation::new(spec.expect("a policy"));
    for decision in 0..3 {
        if decision != 1 {
            simulation
                .act(Action::Rates(&[1.0; 5]))
                .expect("good rates");
        }
        for _ in 0..10 {
            simulation.step().expect("an answer");
        }
    }
    let granted = simulation.finish().decisions;
    let granted: Vec<f64> = granted.iter().map(|decision| decision.granted[4]).collect();
    assert_eq!(granted, [1.0, 5.0, 1.0]);
}

#[test]
fn hand_a_run_whose_record_is_taken_is_over() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let mut simulation = Simulation::new(RunSpec::new(scenario, system));
    simulation.step().expect("rates that stay");
    assert_eq!(simulation.finish().trace.len(), 1);
    assert!(simulation.is_over() && !simulation.decision_is_due());
    assert_eq!(simulation.step().expect("nothing to do"), None);
    assert_eq!(simulation.time(), SimTime::from_millis(10));
    simulation.reset(0);
    assert!(!simulation.is_over());
}

#[test]
fn hand_commands_that_are_no_numbers_are_refused() {
    let (scenario, system) = read("cut-in", &[]);
    let mut simulation = Simulation::new(RunSpec::new(scenario, system));
    let command = |accel: f64, curvature: f64| Command {
        accel,
        curvature,
        manoeuvre: Manoeuvre::Follow,
    };
    for (command, what) in [
        (command(f64::NAN, 0.0), "commanded acceleration"),
        (command(0.0, f64::INFINITY), "commanded curvature"),
    ] {
        let refused = simulation
            .act(Action::Command(command))
            .expect_err("refused");
        let told = format!("cut-in, seed 0, at 0.000 s: the {what} must be finite, got ");
        assert!(refused.to_string().starts_with(&told), "{refused}");
    }
}

/// Without a trace the rest of the record is the same.
#[test]
fn law_a_run_without_a_trace_is_the_same_run() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let spec = RunSpec::new(scenario, system).at_rate(3.0).witnessed();
    let (with, without) = (
        spec.clone().run_fixed(),
        spec.clone().untraced().run_fixed(),
    );
    assert!(with.collided() && without.trace.is_empty());
    assert_eq!(with.frames, without.frames);
    assert_eq!(
        format!("{:?}", with.outcome),
        format!("{:?}", without.outcome)
    );
    let explained = |run: &RunRecord| Waterfall::of(spec.scenario(), spec.system(), run);
    assert!(explained(&with).is_some() && explained(&without).is_none());
}

/// Where the period is no multiple of a step, a decision comes with the first step behind it; so does what the clairvoyant knows of it.
#[test]
fn law_the_known_future_is_that_of_the_decisions() {
    let (scenario, system) = read("cut-in", &["online.every_ms=25", "duration_s=8"]);
    let spec = RunSpec::new(scenario, system).at_rate(30.0).estimated();
    let (rates, run) = (spec.first_rates(), spec.clone().run_fixed());
    let future = known_future(&run.trace, &spec.scenario().road, spec.system(), &rates);
    assert_eq!((future.len(), run.decisions.len()), (320, 320));
}
