//! Rates that change while driving: every policy drives, keeps its budget, and where it matters saves or costs the car.

use zhuyi_core::FrameRates;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::policy;
use zhuyi_sim::{Allocation, Asked, Draws, Run, Scheduled, Simulation, known_future};

use crate::read;

fn drive(
    scenario: &Scenario,
    system: &System,
    name: &str,
    budget: f64,
    seed: u64,
) -> (Run, Vec<Asked>) {
    let cameras = system.perception.eyes.len();
    let rates = FrameRates::new(vec![(budget / cameras as f64).min(30.0); cameras]);
    let draws = Draws {
        root: 0,
        scenario: &scenario.name,
        seed,
    };
    let simulation = Simulation::new(scenario, system, &rates, draws);
    let policy = policy(name).expect("a policy");
    let allocation = Some(Allocation { policy, budget });
    Scheduled::new(simulation, scenario, system, allocation)
        .run()
        .expect("no program is asked")
}

const POLICIES: [&str; 10] = [
    "uniform",
    "proportional",
    "demand-first",
    "demand-hysteresis",
    "importance",
    "rss",
    "ttc",
    "pylot",
    "edf",
    "static:front=10,left=1,right=1,rear=1",
];

/// A policy answers at 10 Hz; from its first answer on the rates are its own. The frames of a second are at most the
/// budget, and one more per camera for the exposures at both ends.
#[test]
fn law_every_policy_drives_within_its_budget() {
    let (scenario, system) = read("cut-in", &["duration_s=6"]);
    let budget = 25.0;
    for name in POLICIES {
        let (run, asked) = drive(&scenario, &system, name, budget, 0);
        assert_eq!(asked.len(), 60, "{name}");
        for asked in &asked {
            let sum: f64 = asked.rates.iter().sum();
            assert!(sum <= budget + 1e-9, "{name}: {:?}", asked.rates);
        }
        let frames: u64 = run.frames.iter().map(|frames| frames.exposed).sum();
        assert!(
            frames as f64 <= 6.0 * budget + 10.0,
            "{name}: {frames} frames"
        );
        assert!(frames as f64 >= 4.0 * budget, "{name}: {frames} frames");
    }
}

/// Who knows the future gets by with fifteen frames a second in this drive; who shares by the demand of what is seen and
/// expected does not.
#[test]
fn hand_the_clairvoyant_gets_by_with_fifteen_frames() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let rates = |hz: f64| FrameRates::new(vec![hz; system.perception.eyes.len()]);
    let draws = Draws {
        root: 0,
        scenario: &scenario.name,
        seed: 0,
    };
    let full = Simulation::new(&scenario, &system, &rates(30.0), draws).run();
    let future = known_future(&full.trace, &system, &rates(30.0));
    let drive = |name: &str| {
        let policy = policy(name).expect("a policy");
        let allocation = Some(Allocation {
            policy,
            budget: 15.0,
        });
        let simulation = Simulation::new(&scenario, &system, &rates(3.0), draws);
        Scheduled::new(simulation, &scenario, &system, allocation)
            .with_known_future(future.clone())
            .run()
            .expect("the future is known")
    };
    let (knows, guesses) = (drive("clairvoyant"), drive("demand-first"));
    assert!(!knows.0.collided() && guesses.0.collided());
}

/// In cut-out-fast the minimum required rate is 6. Three frames a second on each camera are too few; the same fifteen,
/// spent on the front cameras from the start, are enough in this drive. A demand that comes only with the confirmed
/// obstacle comes too late: what the front cameras then get, they needed before.
#[test]
fn hand_fifteen_frames_a_second_in_the_right_place() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let collides = |name: &str| drive(&scenario, &system, name, 15.0, 0).0.collided();
    assert!(collides("uniform"));
    assert!(!collides("static:front=6,left=1,right=1,rear=1"));
    assert!(collides("demand-first"));
}

/// The estimate in the loop does not touch the drive, and knows of nobody whom no camera has confirmed.
#[test]
fn law_the_estimate_alone_changes_nothing() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let draws = Draws {
        root: 0,
        scenario: &scenario.name,
        seed: 0,
    };
    let simulation = || Simulation::new(&scenario, &system, &rates, draws);
    let plain = simulation().run();
    let (watched, asked) = Scheduled::new(simulation(), &scenario, &system, None)
        .run()
        .expect("no policy");
    assert_eq!(plain.trace, watched.trace);
    // Hidden behind the lead, the obstacle asks for nothing; later it does.
    let obstacle = scenario
        .actors
        .iter()
        .position(|actor| actor.name == "obstacle")
        .expect("it is there");
    let asks = |asked: &Asked| {
        let mut actors = asked.demands.iter().filter_map(|demand| demand.actor);
        actors.any(|actor| actor.index() == obstacle)
    };
    let first = asked
        .iter()
        .find(|asked| asks(asked))
        .expect("it is seen in the end")
        .time;
    assert!(first.seconds() > 5.0, "{first:?}");
}
