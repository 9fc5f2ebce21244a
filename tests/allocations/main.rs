//! A run under way asks the heap for nothing: once its lists have grown, in its first second, no tick allocates but
//! those that first believe in one more actor than ever before, which make the lists of its forecast, and neither does the
//! offline estimate of a step.
//!
//! A binary of its own, since the allocator that counts is the whole binary's. A list that grows counts as one allocation.

use allocation_counter::measure;
use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, Setting, Source, System, embedded, load};
use zhuyi_sim::{Hindsight, RunSpec, STEP, Simulation};

const BENCH: (&str, &str) = (
    "cut-in-of-four",
    include_str!("../../benches/drive/cut-in-of-four.ron"),
);

const FIRST_SECOND: usize = 100;

/// The lists of a forecast: its trajectories, and the pieces of the one that it has, along and across.
const LISTS: u64 = 3;

fn read(name: &str, text: &str, settings: &[&str]) -> (Scenario, System) {
    let settings = settings.iter().map(|set| Setting::parse(set));
    let settings: Vec<_> = settings.collect::<Result<_, _>>().expect("settings");
    let system = Source::new("default.ron", embedded::system());
    load(
        &Source::new(format!("{name}.ron"), text),
        &system,
        &settings,
    )
    .expect("a valid scenario")
}

fn rates(system: &System) -> FrameRates {
    FrameRates::new(vec![30.0; system.perception.eyes.len()])
}

fn spec(scenario: &Scenario, system: &System) -> RunSpec {
    RunSpec::new(scenario.clone(), system.clone()).at_rates(rates(system))
}

/// How often each tick after the first second allocates.
fn of_ticks(scenario: &Scenario, system: &System) -> Vec<u64> {
    let mut simulation = Simulation::new(spec(scenario, system));
    let ticks = scenario.duration.nanos() / STEP.nanos();
    let mut tick = || {
        assert!(simulation.observe().budget.is_none());
        let contact = simulation.step().expect("rates that stay");
        assert!(contact.is_none(), "it collided");
    };
    let counts: Vec<u64> = (0..ticks).map(|_| measure(&mut tick).count_total).collect();
    counts[FIRST_SECOND..].to_vec()
}

#[test]
fn law_no_tick_allocates_but_to_believe_in_one_more_actor() {
    let paper = embedded::names().map(|name| (name, embedded::scenario(name).unwrap()));
    for (name, text) in paper.chain([BENCH]) {
        let (scenario, system) = read(name, text, &[]);
        let counts = of_ticks(&scenario, &system);
        let (total, ticks) = (counts.iter().sum::<u64>(), counts.len());
        let those = counts.iter().filter(|count| **count > 0).count();
        println!("{name}: {total} allocations in {those} of {ticks} ticks");
        let actors = scenario.actors.len() as u64;
        assert!(
            total <= LISTS * actors,
            "{name}: more than {LISTS} lists for {actors} actors"
        );
    }
}

/// How often all steps without a decision allocate after the first second, and how often one with a decision does.
fn under_policy(name: &str) -> (u64, u64) {
    let (scenario, system) = read(BENCH.0, BENCH.1, &[]);
    let spec = spec(&scenario, &system).under_policy(name, 60.0);
    let mut simulation = Simulation::new(spec.expect("a policy"));
    let (mut without, mut with) = (0, 0);
    for tick in 0..scenario.duration.nanos() / STEP.nanos() {
        let decides = simulation.decision_is_due();
        let step = || {
            let contact = simulation.step().expect("an answer");
            assert!(contact.is_none(), "it collided");
        };
        let count = measure(step).count_total;
        if tick as usize >= FIRST_SECOND {
            if decides {
                with = count.max(with);
            } else {
                without += count;
            }
        }
    }
    (without, with)
}

#[test]
fn law_under_a_policy_a_decision_allocates_and_other_steps_do_not() {
    for policy in ["uniform", "demand-first", "phantom", "rss"] {
        let (without, with) = under_policy(policy);
        println!("{policy}: {without} allocations in all steps, at most {with} in a decision");
        // Lists of frames that grow with the rate.
        assert!(without <= 8, "{policy}: {without}");
    }
}

#[test]
fn law_a_reset_takes_over_the_memory() {
    let (scenario, system) = read(BENCH.0, BENCH.1, &[]);
    let mut simulation = None;
    let new = measure(|| simulation = Some(Simulation::new(spec(&scenario, &system))));
    let mut simulation = simulation.expect("it has just been made");
    for _ in 0..500 {
        simulation.step().expect("rates that stay");
    }
    let reset = measure(|| simulation.reset(1));
    println!(
        "{} bytes for a new run, {} for a reset",
        new.bytes_total, reset.bytes_total
    );
    assert!(reset.bytes_total < new.bytes_total / 10);
}

#[test]
fn law_the_estimate_of_more_steps_allocates_no_more() {
    let count = |duration: &str| {
        let (scenario, system) = read(BENCH.0, BENCH.1, &[duration]);
        let run = spec(&scenario, &system).run_fixed();
        let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, &rates(&system));
        let estimator = Estimator::new(system.estimator.clone());
        measure(|| drop(hindsight.peaks(&estimator))).count_total
    };
    let (shorter, longer) = (count("duration_s=10"), count("duration_s=20"));
    println!("{shorter} allocations for 10 s, {longer} for 20 s");
    assert!(shorter > 0, "nothing was counted");
    assert_eq!(shorter, longer);
}
