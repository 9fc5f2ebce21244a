//! Rates that change while driving: every policy drives, keeps its budget, and where it matters saves or costs the car.

use zhuyi_core::FrameRates;
use zhuyi_scenario::{Scenario, System};
use zhuyi_scheduler::POLICIES;
use zhuyi_sim::{Asked, RunRecord, RunSpec, known_future};

use crate::read;

fn drive(
    scenario: &Scenario,
    system: &System,
    name: &str,
    budget: f64,
    seed: u64,
) -> (RunRecord, Vec<Asked>) {
    let spec = RunSpec::new(scenario.clone(), system.clone()).with_seed(seed);
    let spec = spec.under_policy(name, budget).expect("a policy");
    let mut run = spec.run().expect("no program is asked");
    let decisions = std::mem::take(&mut run.decisions);
    (run, decisions)
}

/// Every policy that needs neither a program nor the future.
fn policies() -> impl Iterator<Item = &'static str> {
    POLICIES.into_iter().filter_map(|entry| match entry.id {
        "static:CAMERA=RATE,.." => Some("static:front=10,left=1,right=1,rear=1"),
        "exec:COMMAND" | "clairvoyant" => None,
        name => Some(name),
    })
}

/// A policy answers at 10 Hz; from its first answer on the rates are its own. The frames of a second are at most the
/// budget, and one more per camera for the exposures at both ends.
#[test]
fn law_every_policy_drives_within_its_budget() {
    let (scenario, system) = read("cut-in", &["duration_s=6"]);
    let budget = 25.0;
    for name in policies() {
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
        // Who saves processes less than the budget, but never less than one frame a second on each camera.
        let least = if name.ends_with("-only") {
            24.0
        } else {
            4.0 * budget
        };
        assert!(frames as f64 >= least, "{name}: {frames} frames");
    }
}

/// Who knows the future gets by with fifteen frames a second in this drive; who shares by the demand of what is seen and
/// expected does not.
#[test]
fn hand_the_clairvoyant_gets_by_with_fifteen_frames() {
    let (scenario, system) = read("cut-out-fast", &[]);
    let rates = |hz: f64| FrameRates::new(vec![hz; system.perception.eyes.len()]);
    let full = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates(30.0).clone())
        .run_fixed();
    let future = known_future(&full.trace, &scenario.road, &system, &rates(30.0));
    let drive = |name: &str| {
        let spec = RunSpec::new(scenario.clone(), system.clone());
        let spec = spec.under_policy(name, 15.0).expect("a policy");
        let run = spec.with_known_future(future.clone()).run();
        run.expect("the future is known")
    };
    let (knows, guesses) = (drive("clairvoyant"), drive("demand-first"));
    assert!(!knows.collided() && guesses.collided());
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
    let plain = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates.clone())
        .run_fixed();
    let spec = RunSpec::new(scenario.clone(), system.clone());
    let watched = spec.at_rates(rates).estimated().run_fixed();
    let asked = &watched.decisions;
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

/// A budget in equal parts is the same run as that rate on every camera, exposures and all.
#[test]
fn law_a_uniform_budget_is_a_fixed_rate() {
    let (scenario, system) = read("cut-out-fast", &["duration_s=9"]);
    let rates = FrameRates::new(vec![6.0; system.perception.eyes.len()]);
    let fixed = RunSpec::new(scenario.clone(), system.clone())
        .with_seed(1)
        .at_rates(rates.clone())
        .run_fixed();
    for policy in ["uniform", "static:front=6,left=6,right=6,rear=6"] {
        let (shared, _) = drive(&scenario, &system, policy, 30.0, 1);
        assert_eq!(fixed.trace, shared.trace, "{policy}");
        assert_eq!(fixed.frames, shared.frames, "{policy}");
    }
}

/// The frames of a stack that is asked for more than its accelerator can do wait for each other, and the ego sees the
/// obstacle of cut-out-fast too late; with enough of it waiting and service stay below the frame period.
#[test]
fn hand_an_overloaded_accelerator_is_late_by_itself() {
    let collides = |tops: &str| {
        let compute = format!("compute=Accelerator(tops:{tops},drop_stale:false)");
        let (scenario, system) = read("cut-out-fast", &[&compute]);
        let rates = FrameRates::new(vec![10.0; system.perception.eyes.len()]);
        let run = RunSpec::new(scenario.clone(), system.clone())
            .at_rates(rates.clone())
            .run_fixed();
        let processed: u64 = run.frames.iter().map(|frames| frames.processed).sum();
        (
            run.collided(),
            processed as f64 / (0.01 * run.trace.len() as f64),
        )
    };
    // 50 frames a second are 26 TOPS. At 20.8 TOPS, 40 a second, ten more wait after every second, and nothing is dropped.
    let (enough, fewer) = (collides("27"), collides("20.8"));
    assert!(!enough.0 && (49.0..=50.5).contains(&enough.1), "{enough:?}");
    assert!(fewer.0 && (39.0..=40.5).contains(&fewer.1), "{fewer:?}");
}

/// The three answers of the paper to an alarm, each in a drive in which the alarm alone does not help: at 25 frames a
/// second in equal parts the ego collides in cut-out-fast.
#[test]
fn hand_each_response_to_an_alarm_does_what_it_says() {
    let drive = |response: &str| {
        let setting = format!("online.response={response}");
        let (scenario, system) = read("cut-out-fast", &[&setting]);
        drive(&scenario, &system, "uniform", 25.0, 1)
    };
    let (nothing, asked) = drive("Record");
    assert!(nothing.collided());
    let first = asked
        .iter()
        .find(|asked| asked.alarms.contains(&true))
        .expect("an alarm");
    let accel = |run: &RunRecord, after: f64| {
        let mut rows = run.trace.rows();
        let row = rows.find(|row| row.time >= first.time && row.time.seconds() > after);
        row.expect("a row").ego.accel
    };

    let (braked, _) = drive("EmergencyBackup");
    let soon = first.time.seconds() + 1.0;
    assert!(accel(&braked, soon) < -4.0, "{}", accel(&braked, soon));
    assert!(accel(&nothing, soon) > -1.0, "{}", accel(&nothing, soon));

    let (_, raised) = drive("RaiseRates");
    let at = |asked: &[Asked]| asked[0].granted.clone();
    // The fronts get what the others have above their floor of demand; together they are the same budget.
    assert!(at(&asked).iter().all(|rate| *rate == 5.0));
    assert!(
        at(&raised)[0] > 6.0 && at(&raised)[2] < 5.0,
        "{:?}",
        at(&raised)
    );
    assert!((at(&raised).iter().sum::<f64>() - 25.0).abs() < 1e-9);

    let (slower, limited) =
        drive("LimitedFunctionality(freed_share:0.2,lower_speed_mps:5,longer_headway_s:0.5)");
    // From the decision after the first alarm on there are 30 frames a second.
    assert!(
        limited[1]
            .granted
            .iter()
            .all(|rate| (rate - 6.0).abs() < 1e-9)
    );
    let speed = |run: &RunRecord| run.trace.rows().nth(300).expect("3 s").ego.speed;
    assert!(speed(&slower) < speed(&nothing) - 2.0);
}
