//! `sweep plan.ron`: the same sweep as by the equal flags, and what a broken plan is told.

use zhuyi_scenario::embedded;

use crate::{Bench, Ran, run};

/// Everything that a plan can say, with files of its own beside it.
const PLAN: &str = r#"(
    scenarios: ["mine.ron", "cut-in"],
    system: "car.ron",
    set: [(path: "planner.min_gap_m", value: 2.5), (path: "estimator.grid", value: Fps)],
    fpr: "2,30",
    seeds: 2,
    root_seed: 3,
    vary: [
        Range(path: "perception.visible_share", from: 0.4, to: 0.6, step: 0.2),
        List(path: "perception.miss_rate", values: [0, 0.02]),
        Uniform(path: "perception.phase_share", from: 0, to: 1),
        Normal(path: "actors.cutter.speed_mps", mean: 22, deviation: 1),
    ],
    where: ["actors.cutter.speed_mps <= 24", "perception.phase_share>0.1"],
    samples: 3,
    sampling: "halton",
)
"#;

/// The flags that say the same, some with blanks where they do not matter.
const FLAGS: [&str; 28] = [
    "sweep",
    "folder/mine.ron",
    "cut-in",
    "--system",
    "folder/car.ron",
    "--set",
    "planner.min_gap_m = 2.5",
    "--set",
    "estimator.grid=Fps",
    "--fpr",
    "30,2",
    "--seeds",
    "2",
    "--root-seed",
    "3",
    "--vary",
    "perception.visible_share=0.4:0.6:0.2",
    "--vary",
    "perception.miss_rate=[0, 0.02]",
    "--vary",
    "perception.phase_share=uniform( 0,1.0)",
    "--vary",
    "actors.cutter.speed_mps=normal(22,1)",
    "--where",
    "actors.cutter.speed_mps<=24",
    "--where",
    "perception.phase_share > 0.1",
    "--samples=3",
];

fn bench() -> Bench {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("folder")).unwrap();
    bench.write("folder/plan.ron", PLAN);
    bench.write("folder/mine.ron", embedded::scenario("cut-in").unwrap());
    bench.write("folder/car.ron", embedded::system());
    bench
}

fn refused(ran: &Ran, told: &[&str]) {
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{}", ran.err);
    for told in told {
        assert!(ran.err.contains(told), "{told} is not in\n{}", ran.err);
    }
}

#[test]
fn law_a_plan_and_the_equal_flags_are_one_sweep_wherever_it_lies() {
    let bench = bench();
    let by_plan = bench.out("sweep folder/plan.ron --out by-plan");
    let mut flags = bench.command("");
    flags
        .args(FLAGS)
        .args(["--sampling", "halton", "--out", "by-flags"]);
    let by_flags = run(&mut flags);
    assert_eq!((by_flags.code, by_flags.err.as_str()), (Some(0), ""));
    assert_eq!(by_flags.out.replace("by-flags", "by-plan"), by_plan);
    for name in ["plan.json", "runs.csv"] {
        assert_eq!(
            bench.read(&format!("by-plan/{name}")),
            bench.read(&format!("by-flags/{name}")),
            "{name}"
        );
    }
    // So one goes on with the other, and one whose file has changed does not.
    let mut flags = bench.command("");
    flags
        .args(FLAGS)
        .args(["--sampling", "halton", "--out", "by-plan", "--resume"]);
    assert_eq!(run(&mut flags).code, Some(0));
    bench.write("folder/plan.ron", &PLAN.replace("seeds: 2", "seeds: 3"));
    let ran = bench.zhuyi("sweep folder/plan.ron --out by-plan --resume");
    refused(&ran, &["these parts of its plan differ: seeds"]);
    // A row is made again from where the sweep was.
    let runs = bench.read("by-plan/runs.csv");
    let replay = runs
        .lines()
        .nth(1)
        .unwrap()
        .rsplit_once(",zhuyi ")
        .unwrap()
        .1;
    assert!(
        replay.starts_with(
            "run folder/mine.ron --fpr 2 --seed 0 --root-seed 3 --system folder/car.ron"
        )
    );
    bench.out(replay);
}

#[test]
fn hand_what_is_left_out_has_the_default_of_its_flag() {
    let bench = Bench::new();
    bench.write("plan.ron", "(scenarios: [\"cut-in\"])");
    let line = "--limit 3 --block 2";
    bench.out(&format!("sweep plan.ron {line} --out by-plan"));
    bench.out(&format!(
        "sweep cut-in {line} --system default --out by-flags"
    ));
    assert_eq!(
        bench.read("by-plan/plan.json"),
        bench.read("by-flags/plan.json")
    );
    let told = bench.out("sweep plan.ron --dry-run --limit 1");
    assert!(
        told.starts_with(
            "1 drive in 1 block: 1 scenario x 1 combination of values x 30 rates x 10 seeds (limited: the first of 300)\n"
        ),
        "{told}"
    );
}

#[test]
fn hand_all_that_is_wrong_with_a_plan_is_told_at_once_each_at_its_place() {
    let bench = bench();
    let broken = PLAN
        .replace("\"cut-in\"", "\"cut-inn\"")
        .replace("min_gap_m", "min_gap")
        .replace("value: Fps", "value: Fsp")
        .replace("\"2,30\"", "\"2,0:30\"")
        .replace("seeds: 2", "seds: 2")
        .replace("root_seed: 3", "root_seed: -3")
        .replace("from: 0.4", "from: 0.8")
        .replace("[0, 0.02]", "[0, 0]")
        .replace("Uniform", "Unifrom")
        .replace("halton", "haltom");
    bench.write("folder/plan.ron", &broken);
    let told = [
        "folder/plan.ron:2:30",
        "did you mean `cut-in`?",
        "unknown setting `min_gap`",
        "did you mean `min_gap_m`?",
        "folder/plan.ron:4:27",
        "folder/plan.ron:4:82",
        "a frame rate must be 1 to 1000, got 0",
        "folder/plan.ron:5:13",
        "did you mean `seeds`?",
        "folder/plan.ron:7:16",
        "a seed must be 0 to",
        "folder/plan.ron:9:64",
        "a range goes upwards, got 0.8 to 0.6",
        "value `0` is given twice",
        "folder/plan.ron:11:9",
        "did you mean `Uniform`?",
        "did you mean `halton`?",
    ];
    refused(&bench.zhuyi("sweep folder/plan.ron --out out"), &told);
    assert!(!bench.path("out").exists());
    // `check` says the same.
    let ran = bench.zhuyi("check folder/plan.ron cut-in");
    assert_eq!(
        (ran.code, ran.out.as_str()),
        (Some(2), "folder/plan.ron: not ok\ncut-in: ok\n")
    );
    assert!(
        told.iter().all(|told| ran.err.contains(told)),
        "{}",
        ran.err
    );
}

#[test]
fn hand_what_fits_no_scenario_is_told_where_the_plan_has_it() {
    let bench = bench();
    for (from, to, told) in [
        (
            "actors.cutter",
            "actors.cuter",
            ["folder/plan.ron:12:30", "did you mean `cutter`?"],
        ),
        (
            "actors.cutter.speed_mps <=",
            "actors.cutter <=",
            ["folder/plan.ron:14:14", "varied: perception."],
        ),
        (
            "samples: 3,",
            "",
            ["folder/plan.ron:11:24", "samples must say how often"],
        ),
        (
            "samples: 3",
            "samples: 3.5",
            [
                "folder/plan.ron:15:14",
                "expected a whole number, got `3.5`",
            ],
        ),
        (
            "perception.miss_rate",
            "planner.min_gap_m",
            [
                "folder/plan.ron:10:21",
                "`planner.min_gap_m` is given twice",
            ],
        ),
        (
            "car.ron",
            "lorry.ron",
            ["cannot read `folder/lorry.ron`", ""],
        ),
        (
            "\"cut-in\"",
            "\"mine.ron\"",
            ["folder/plan.ron:2:30", "scenario `mine` is given twice"],
        ),
    ] {
        assert!(PLAN.contains(from), "{from}");
        bench.write("folder/plan.ron", &PLAN.replace(from, to));
        let ran = bench.zhuyi("sweep folder/plan.ron --dry-run");
        assert_eq!(ran.out, "", "{from} -> {to}");
        for told in told {
            assert!(ran.err.contains(told), "{told} is not in\n{}", ran.err);
        }
    }
}

#[test]
fn hand_flags_that_say_what_is_driven_cannot_stand_beside_a_plan() {
    let bench = bench();
    let ran = bench.zhuyi(
        "sweep folder/plan.ron --dry-run cut-out --seeds 10 --set planner.exponent=4 --samples 3",
    );
    refused(
        &ran,
        &[
            "a plan says all that is driven: it stands alone",
            "SCENARIO:1:1",
            "a plan says all that is driven: --seeds cannot stand beside it",
            "write it into the plan",
            "--set:1:1",
            "--samples:1:1",
        ],
    );
    refused(
        &bench.zhuyi("show folder/plan.ron"),
        &["is the plan of a sweep"],
    );
}

#[test]
fn hand_a_plan_comes_with_the_program() {
    let bench = Bench::new();
    let out = bench.out("new mine --from plan");
    assert_eq!(
        out,
        "Wrote mine.ron. Next:\n  zhuyi check mine.ron\n  zhuyi sweep mine.ron --dry-run\n  zhuyi sweep mine.ron --out out\n"
    );
    assert_eq!(bench.read("mine.ron"), embedded::plan());
    assert_eq!(bench.out("check mine.ron"), "mine.ron: ok\n");
    // Its first comment says how many drives it makes.
    let dry = bench.out("sweep mine.ron --dry-run");
    let drives: u32 = dry.split(' ').next().unwrap().parse().unwrap();
    let spelt = format!("{},{:03} drives", drives / 1000, drives % 1000);
    assert!(
        embedded::plan().lines().next().unwrap().contains(&spelt),
        "{spelt}"
    );
}
