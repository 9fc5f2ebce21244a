use rayon::ThreadPoolBuilder;
use zhuyi_batch::mrf::Mrf;
use zhuyi_batch::rates::uniform;
use zhuyi_batch::sweep::grid;
use zhuyi_core::{Across, Along, Footprint, SimTime};
use zhuyi_estimator::ego_motion::reaction_time;
use zhuyi_estimator::{Ego, Future};
use zhuyi_scenario::{Scenario, Source};
use zhuyi_sim::{RunSpec, Trace};
use zhuyi_studies::compare::audit::Moment;
use zhuyi_studies::compare::joint::Joint;
use zhuyi_studies::compare::models::Panel;
use zhuyi_studies::compare::{Compared, compared, scenes};
use zhuyi_studies::{Comparison, Plan, compare};

use crate::small::plan;

/// These embedded scenarios with few seeds.
fn comparison(names: &[&str], fpr: u32, seeds: u64) -> Comparison {
    let plan = plan(names, &[30], seeds);
    Comparison {
        scenarios: plan.scenarios,
        system: plan.system,
        root_seed: 0,
        fpr,
        seeds,
        every: 1,
        command: "zhuyi compare".to_string(),
    }
}

/// 20 m/s, a car stands 48 m ahead, and the run is over after 40 ms.
fn standing_car() -> Comparison {
    let system = Plan::embedded().unwrap().system;
    let text = r#"(title: "x", road: (lanes: 1, lane_width_m: 3.5, segments: [Line(length_m: 900)]),
        ego: (lane: 1, s_m: 9, speed_mps: 20), duration_s: 5, actors: [
            (name: "wreck", lane: 1, start: Ahead(gap_m: 48), behaviour: Obstacle)])"#;
    let mut scenario = Scenario::read(&Source::new("wreck.ron", text), &system, &[]).unwrap();
    scenario.duration = SimTime::from_millis(40);
    Comparison {
        scenarios: vec![scenario],
        system,
        root_seed: 0,
        fpr: 30,
        seeds: 1,
        every: 1,
        command: "zhuyi compare wreck.ron".to_string(),
    }
}

fn place(compared: &Compared, model: &str) -> usize {
    compared
        .models
        .iter()
        .position(|name| *name == model)
        .unwrap()
}

#[test]
fn hand_counts_of_asked_against_needed() {
    // 1, 2 and 4 FPR. Needed 4, asked 1 twice and 2 once: short by 3, 3, 2. Needed 2, asked 4: 2 more, needed 2, asked 2: none.
    // Needed 1, asked 4: 3 more, at a step that is not in need.
    let mut joint = Joint::new(&[1.0, 0.5, 0.25]);
    for (needed, asked) in [
        (0.25, 1.0),
        (0.25, 1.0),
        (0.25, 0.5),
        (0.5, 0.25),
        (0.5, 0.5),
        (1.0, 0.25),
    ] {
        joint.count(needed, asked);
    }
    assert_eq!((joint.steps(), joint.in_need(), joint.short()), (6, 5, 3));
    assert_eq!(joint.share_short(), Some(0.6));
    assert_eq!(joint.mean_shortfall(), Some(8.0 / 3.0));
    assert_eq!(joint.largest_shortfall(), Some(3.0));
    assert_eq!(joint.longest_over(), Some(0.75));
    assert_eq!(
        (joint.mean_excess(true), joint.median_excess(true)),
        (Some(1.0), Some(0.0))
    );
    assert_eq!(
        (joint.mean_excess(false), joint.median_excess(false)),
        (Some(5.0 / 3.0), Some(2.0))
    );
    assert_eq!(
        joint.mean_asked(),
        Some((1.0 + 1.0 + 2.0 + 4.0 + 2.0 + 4.0) / 6.0)
    );
    let mut twice = Joint::default();
    twice.add(&joint);
    twice.add(&joint);
    assert_eq!((twice.steps(), twice.short()), (12, 6));
    assert_eq!(twice.mean_shortfall(), joint.mean_shortfall());
}

#[test]
fn hand_a_standing_car_is_audited_as_by_hand() {
    // Braking by 4.9 m/s2 takes 40.8 m and leaves 7.18 m, 0.359 s: l = (0.359 + 5/30) / 6 = 0.088, 0.076 on the grid. By 6 m/s2 it
    // takes 33.3 m and leaves 0.733 s: 0.150, 0.142 on the grid. In 40 ms both times shrink by 40 ms: to 0.081 and 0.143, the
    // same on the grid. TTC less 2 s is 0.4 s, Pylot's deadline 0.3 s: 0.094 and 0.078, 0.076 both.
    let compared = compared(&standing_car(), &());
    let audited = &compared.scenarios[0];
    assert_eq!((audited.runs, audited.apart.total()), ((1, 0), 0));
    let (needed, asked) = (1.0 / 0.076, 1.0 / 0.142);
    let steps = audited.models[0].joint.in_need();
    assert!(
        (4..=5).contains(&steps),
        "every 10 ms of 40 ms, got {steps}"
    );
    for model in ["visibility", "sff", "r157-cut-in"] {
        let tally = &audited.models[place(&compared, model)];
        let joint = &tally.joint;
        assert_eq!(
            (joint.steps(), joint.in_need(), joint.short()),
            (3 * steps, steps, steps),
            "{model}"
        );
        assert_eq!(joint.largest_shortfall(), Some(needed - asked), "{model}");
        assert!((joint.longest_over().unwrap() - 0.066).abs() < 1e-12);
        assert_eq!((tally.causes.brakes, tally.causes.future), (steps, 0));
        assert_eq!(tally.share_short_with_harder_brakes(), Some(0.0));
        let worst = tally.worst.as_ref().unwrap();
        assert_eq!((worst.time, worst.seed), (SimTime::ZERO, 0));
        assert_eq!(
            (worst.needed, worst.asked),
            ((0.076, needed), (0.142, asked))
        );
        // The actor's start is jittered by up to 0.5 m (reading R18), which is far from a step of the grid.
        assert!((worst.gap - 48.0).abs() < 0.5, "{}", worst.gap);
    }
    for model in ["ttc", "pylot", "zhuyi-standstill"] {
        let tally = &audited.models[place(&compared, model)];
        assert_eq!((tally.joint.short(), &tally.worst), (0, &None), "{model}");
        assert_eq!(tally.joint.mean_excess(true), Some(0.0), "{model}");
    }
}

#[test]
fn law_the_same_bytes_at_one_and_two_threads() {
    let mut comparison = comparison(&["cut-out", "front-right-activity-2"], 30, 2);
    for scenario in &mut comparison.scenarios {
        scenario.duration = SimTime::from_millis(3000);
    }
    let at = |threads: usize| {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| compare(&comparison, &()))
    };
    let results = at(1);
    assert_eq!(results, at(2));
    let names: Vec<_> = results.files.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["compare.md", "compare.csv", "compare_demand.csv"]);
    for (name, text) in &results.files {
        assert!(text.ends_with('\n') && !text.contains("NaN"), "{name}");
    }
    let mut reader = csv::Reader::from_reader(results.files[1].1.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let of_ttc = |scenario: &str| {
        let of = |row: &&csv::StringRecord| row[0] == *scenario && row[1] == *"ttc";
        rows.iter().filter(of).count()
    };
    assert_eq!((of_ttc("cut-out"), of_ttc("all")), (19 + 6 + 3, 19));
    let mut reader = csv::Reader::from_reader(results.files[2].1.as_bytes());
    // 2 scenarios, 3 cameras, 11 models: each has its first sample at least.
    let first = reader
        .records()
        .map(Result::unwrap)
        .filter(|row| row[2] == *"0.0");
    assert_eq!(first.count(), 2 * 3 * 11);
}

#[test]
fn law_fewer_steps_are_asked_about_with_a_longer_wait() {
    let mut comparison = standing_car();
    let steps = |every: usize| {
        comparison.every = every;
        compared(&comparison, &()).scenarios[0].models[0]
            .joint
            .steps()
    };
    let [all, second, one] = [1, 2, 100].map(steps);
    assert_eq!((second, one), (3 * (all / 3).div_ceil(2), 3));
}

/// Whether the ego touches the actor of a moment when it holds its acceleration for t_r, then brakes: 1 ms steps over the rows of
/// the run, the actor at its last speed behind the last.
fn touches(trace: &Trace, moment: &Moment, latency: f64) -> bool {
    let first = trace
        .rows()
        .position(|row| row.time == moment.time)
        .unwrap();
    let start = trace.row(first);
    let (speed, accel) = moment.ego;
    let decel = if accel < 0.0 {
        (1.1 * -accel).max(4.9)
    } else {
        4.9
    };
    let reaction = reaction_time(latency, 1.0 / 30.0, 5);
    let (mut s, mut v) = (start.ego.road.s, speed);
    for ms in 0..20_000_u32 {
        let time = f64::from(ms) / 1000.0;
        let at = first as f64 + time / 0.01;
        let before = (at as usize).min(trace.len() - 1);
        let (row, next) = (
            trace.row(before),
            trace.row((before + 1).min(trace.len() - 1)),
        );
        let (body, next) = (
            &row.actors[moment.actor.index()],
            &next.actors[moment.actor.index()],
        );
        let part = at - before as f64;
        let (actor_s, actor_d) = if before == trace.len() - 1 {
            (body.road.s + body.s_rate * 0.01 * part, body.road.d)
        } else {
            let between = |a: f64, b: f64| a + (b - a) * part;
            (
                between(body.road.s, next.road.s),
                between(body.road.d, next.road.d),
            )
        };
        let (own, other) = (start.ego.footprint, body.footprint);
        let along = (actor_s - s).abs() < f64::midpoint(own.length, other.length);
        let across = (actor_d - start.ego.road.d).abs() < f64::midpoint(own.width, other.width);
        if along && across {
            return true;
        }
        let a = if time < reaction { accel } else { -decel };
        let faster = (v + a * 0.001).max(0.0);
        s += f64::midpoint(v, faster) * 0.001;
        v = faster;
    }
    false
}

#[test]
fn law_every_worst_moment_ends_in_a_contact_at_what_was_asked_and_not_at_what_was_needed() {
    let comparison = comparison(
        &["cut-out-fast", "challenging-cut-in", "vehicle-following"],
        30,
        1,
    );
    let compared = compared(&comparison, &());
    let mut replayed = 0;
    for (scenario, audited) in comparison.scenarios.iter().zip(&compared.scenarios) {
        let rates = uniform(&comparison.system, comparison.fpr);
        let run = RunSpec::new(scenario.clone(), comparison.system.clone())
            .at_rates(rates.clone())
            .run_fixed();
        for (name, tally) in compared.models.iter().zip(&audited.models) {
            let Some(worst) = &tally.worst else { continue };
            assert!(
                touches(&run.trace, worst, worst.asked.0),
                "{name} {worst:?}"
            );
            assert!(
                !touches(&run.trace, worst, worst.needed.0),
                "{name} {worst:?}"
            );
            replayed += 1;
        }
    }
    assert!(replayed >= 10, "{replayed}");
}

#[test]
fn law_trials_are_the_runs_at_these_rates() {
    let comparison = comparison(&["cut-out-fast"], 30, 2);
    let compared = compared(&comparison, &());
    let Mrf::Rate(mrf) = compared.closed_loop.required[0].mrf else {
        panic!("{:?}", compared.closed_loop.required[0])
    };
    let trials = &compared.closed_loop.trials[0];
    assert_eq!(trials.iter().flatten().count(), compared.models.len());
    for trial in trials.iter().flatten() {
        let rate = trial.asked.ceil();
        assert_eq!(trial.largest.rates.all(), [rate; 5]);
        assert!(
            rate < f64::from(mrf) || trial.largest.collisions == 0,
            "{trial:?}"
        );
        for tried in [&trial.largest, &trial.own] {
            let cells = grid(1, std::slice::from_ref(&tried.rates), 0..2);
            let records = comparison.experiment().run(&cells, |_| &[], || ());
            let found = records.iter().filter(|record| record.collision.is_some());
            assert_eq!(found.count() as u32, tried.collisions, "{tried:?}");
        }
    }
}

#[test]
fn hand_a_run_that_collides_is_not_audited_and_asks_for_nothing() {
    let comparison = comparison(&["cut-out-fast"], 1, 1);
    let compared = compared(&comparison, &());
    assert_eq!(compared.scenarios[0].runs, (0, 1));
    assert!(compared.closed_loop.trials[0].iter().all(Option::is_none));
    let results = compare(&comparison, &());
    assert!(
        results.files[0].1.contains("| N/A "),
        "{}",
        results.files[0].1
    );
}

#[test]
fn hand_the_smallest_scenes_show_what_they_are_for() {
    let plan = Plan::embedded().unwrap();
    let answered = scenes::answered(&plan.system);
    let names = compared(&standing_car(), &()).models;
    let asked = |scene: &str, model: &str| {
        let scene = answered.iter().find(|one| one.scene.name == scene).unwrap();
        let model = names.iter().position(|name| *name == model).unwrap();
        scene.answers[model].unwrap().latency
    };
    // The lead of reading.md: equal speeds say no danger, the paper's criterion stops before the lead has slowed.
    for model in ["ttc", "r157-cut-in", "r157-driver"] {
        assert_eq!(asked("lead will brake", model), Some(1.0), "{model}");
        assert_eq!(asked("lead brakes", model), Some(1.0), "{model}");
    }
    assert!(asked("lead will brake", "zhuyi") > asked("lead will brake", "zhuyi-standstill"));
    // 30 m/s: braking takes 91.8 m of 105 m, the other 13.2 m are 0.439 s: 0.101. TTC less 2 s is 1.5 s: 0.278.
    assert_eq!(asked("fast ego", "zhuyi-standstill"), Some(0.076));
    assert_eq!(asked("fast ego", "ttc"), Some(0.274));
    // 10 m/s: 10.2 m of 12 m, the other 1.8 m are 0.18 s: 0.0577. Pylot's 0.4 s: 0.094.
    assert_eq!(asked("slow ego", "zhuyi-standstill"), Some(0.043));
    assert_eq!(asked("slow ego", "pylot"), Some(0.076));
    // Who only looks at t_0 does not see a cut-in before it begins.
    for model in ["ttc", "r157-cut-in", "r157-driver", "visibility", "sff"] {
        assert_eq!(asked("cut-in to come", model), Some(1.0), "{model}");
    }
    assert_eq!(asked("cut-in to come", "zhuyi-standstill"), Some(0.175));
}

/// A car comes towards the ego at 10 m/s: models whose source does not speak of it have no answer, which is neither 1 FPR nor 30.
#[test]
fn hand_a_model_has_no_answer_for_whom_it_does_not_speak_of() {
    let panel = Panel::new(&Plan::embedded().unwrap().system);
    let car = Footprint {
        length: 4.0,
        width: 2.0,
    };
    let ego = Ego {
        s: 0.0,
        d: 0.0,
        speed: 10.0,
        accel: 0.0,
        footprint: car,
    };
    let answers = |speed: f64, d_rate: f64| {
        let along = [Along::constant_accel(0.0, 80.0, speed, 0.0)];
        let across = [Across {
            time: 0.0,
            d: -8.0,
            d_rate,
        }];
        let future = Future {
            along: &along,
            across: &across,
            extents: &[],
            known_until: 20.0,
            now: 0.0,
        };
        let answers = panel.answers(&ego, car, &future, 1.0 / 30.0);
        let none = panel.names().into_iter().zip(answers);
        let none = none.filter(|(_, answer)| answer.is_none());
        none.map(|(name, _)| name).collect::<Vec<_>>()
    };
    assert_eq!(answers(10.0, 1.0), [""; 0]);
    assert_eq!(answers(-10.0, 1.0), ["sff", "r157-cut-in", "r157-driver"]);
    let crossing = ["rss", "rss-capped", "sff", "r157-cut-in", "r157-driver"];
    assert_eq!(answers(0.0, 2.0), crossing);
}
