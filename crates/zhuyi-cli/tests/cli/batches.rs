//! `sweep` in blocks: parameters varied, processes really killed, shards merged, folders lost.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::{Bench, Ran};

/// 40 drives: two scenarios, two values of a parameter each, two rates, five seeds; one in four is refused, as there is no
/// such value for it.
const LINE: &str = "sweep cut-in front-right-activity-2 --fpr 2,30 --seeds 5 --set planner.min_gap_m=2.5 \
     --vary perception.miss_rate=[0,0.02] --block 1";

/// 64 bits that look drawn, the same in every run of the test.
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }
}

fn begin(bench: &Bench, line: &str) -> Child {
    let mut command = bench.command(line);
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::piped());
    quiet.spawn().unwrap()
}

/// Waits until something is there.
fn await_path(bench: &Bench, name: &str) {
    let begun = Instant::now();
    while !bench.path(name).exists() {
        assert!(begun.elapsed() < Duration::from_mins(1), "no {name}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn refused(ran: &Ran, code: i32, told: &str) {
    assert_eq!(
        (ran.code, ran.out.as_str()),
        (Some(code), ""),
        "{}",
        ran.err
    );
    assert!(ran.err.contains(told), "{}", ran.err);
}

#[test]
fn law_a_sweep_killed_again_and_again_has_the_bytes_of_an_undisturbed_one() {
    let bench = Bench::new();
    bench.out(&format!("{LINE} --out whole"));
    let mut dice = Dice(1);
    let (mut kills, mut widest) = (0, 0);
    let finished = loop {
        let mut child = begin(&bench, &format!("{LINE} --out killed --resume"));
        // Wider and wider, so that it ends: from the start of the program to some blocks later.
        widest += 2;
        std::thread::sleep(Duration::from_millis(dice.below(10 + widest)));
        match child.try_wait().unwrap() {
            Some(status) => break status,
            None => child.kill().unwrap(),
        }
        let status = child.wait().unwrap();
        if status.success() {
            break status;
        }
        kills += 1;
        assert!(kills < 1000, "it never ends");
    };
    assert!(finished.success());
    eprintln!("{kills} kills");
    assert!(kills >= 20, "only {kills} kills: the test shows too little");
    for name in ["runs.csv", "plan.json"] {
        assert_eq!(
            bench.read(&format!("killed/{name}")),
            bench.read(&format!("whole/{name}")),
            "{name} after {kills} kills"
        );
    }
    assert_eq!(bench.names("killed"), ["plan.json", "runs.csv"]);
}

#[test]
fn law_a_kill_at_any_moment_of_a_short_sweep_loses_nothing_that_was_complete() {
    let bench = Bench::new();
    let line = "sweep cut-in --fpr 30 --seeds 4 --block 1";
    let begun = Instant::now();
    bench.out(&format!("{line} --out whole"));
    let undisturbed = begun.elapsed();
    let moments = 24;
    for moment in 0..moments {
        let out = format!("out-{moment}");
        let mut child = begin(&bench, &format!("{line} --out {out}"));
        std::thread::sleep(undisturbed * moment / moments);
        child.kill().unwrap();
        child.wait().unwrap();
        let blocks = format!("{out}/blocks");
        let complete: Vec<String> = if bench.path(&blocks).exists() {
            let names = bench.names(&blocks);
            names
                .into_iter()
                .filter(|name| !name.starts_with('.'))
                .collect()
        } else {
            Vec::new()
        };
        for name in &complete {
            let rows = bench.read(&format!("{blocks}/{name}"));
            assert_eq!(rows.lines().count(), 2, "{name} is complete");
        }
        bench.out(&format!("{line} --out {out} --resume"));
        assert_eq!(
            bench.read(&format!("{out}/runs.csv")),
            bench.read("whole/runs.csv"),
            "moment {moment}"
        );
        assert_eq!(bench.names(&out), ["plan.json", "runs.csv"]);
    }
}

#[test]
fn law_shards_merged_have_the_same_bytes_and_one_that_is_missing_is_told() {
    let bench = Bench::new();
    bench.out(&format!("{LINE} --out whole --jobs 1"));
    for shard in 1..=3 {
        let line = format!("{LINE} --shard {shard}/3 --out shard-{shard}");
        let out = bench.out(&line);
        assert!(
            out.starts_with(&format!("shard {shard} of 3 is complete")),
            "{out}"
        );
        assert_eq!(
            bench.names(&format!("shard-{shard}")),
            ["blocks", "plan.json"]
        );
    }
    let two = bench.zhuyi("merge shard-1 shard-3 --out merged");
    refused(
        &two,
        3,
        "error: 13 of 40 blocks are missing: 1, 4, 7, 10, 13, ..\n",
    );
    let twice = bench.zhuyi("merge shard-1 shard-2 shard-3 shard-1 --out merged");
    refused(&twice, 2, "block 0 is in shard-1 and in shard-1");
    assert!(!bench.path("merged/runs.csv").exists());
    let out = bench.out("merge shard-3 shard-1 shard-2 --out merged");
    assert!(out.ends_with("\n40 drives in merged/runs.csv\n"), "{out}");
    for name in ["runs.csv", "plan.json"] {
        let merged = bench.read(&format!("merged/{name}"));
        assert_eq!(merged, bench.read(&format!("whole/{name}")), "{name}");
    }
}

#[test]
fn law_a_folder_of_another_plan_or_with_something_to_lose_is_refused() {
    let bench = Bench::new();
    bench.out(&format!("{LINE} --shard 1/2 --out out"));
    let before = bench.names("out/blocks");
    let other = LINE.replace("--seeds 5", "--seeds 6");
    let ran = bench.zhuyi(&format!("{other} --out out --resume"));
    refused(
        &ran,
        2,
        "out holds another sweep; these parts of its plan differ: seeds",
    );
    let ran = bench.zhuyi(&format!("{LINE} --out out"));
    refused(
        &ran,
        4,
        "out holds 20 of 40 blocks of a sweep: --resume goes on with it",
    );
    let ran = bench.zhuyi("merge out --out out");
    refused(&ran, 4, "--resume goes on with it");
    assert_eq!(bench.names("out/blocks"), before);
    // A plan that was written over is none.
    let plan = bench.read("out/plan.json");
    bench.write(
        "out/plan.json",
        &plan.replace("\"seeds\": 5", "\"seeds\": 4"),
    );
    let ran = bench.zhuyi(&format!("{LINE} --out out --resume"));
    refused(
        &ran,
        2,
        "plan.json is not the plan of a sweep: it does not have its hash",
    );
    bench.write("out/plan.json", &plan);
    // So is a block.
    let block = bench.read("out/blocks/000002.csv");
    bench.write("out/blocks/000002.csv", &block.replace(",2,2,", ",2,3,"));
    let ran = bench.zhuyi(&format!("{LINE} --out out --resume"));
    refused(
        &ran,
        4,
        "its run 1 is another; remove it and go on with --resume",
    );
    fs::remove_file(bench.path("out/blocks/000002.csv")).unwrap();
    bench.out(&format!("{LINE} --out out --resume"));
    bench.out(&format!("{LINE} --out whole"));
    assert_eq!(bench.read("out/runs.csv"), bench.read("whole/runs.csv"));
    // A finished one has nothing missing.
    let again = bench.out(&format!("{LINE} --out out --resume"));
    assert!(again.ends_with("40 drives in out/runs.csv\n"), "{again}");
}

#[test]
fn law_a_lost_folder_is_told_and_what_was_complete_is_gone_on_with() {
    let bench = Bench::new();
    let line = "sweep cut-in --fpr 30 --seeds 400 --block 2";
    let child = begin(&bench, &format!("{line} --out out"));
    await_path(&bench, "out/blocks/000001.csv");
    fs::rename(bench.path("out"), bench.path("away")).unwrap();
    let ended = child.wait_with_output().unwrap();
    let err = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(4), "{err}");
    assert!(err.starts_with("error: cannot "), "{err}");
    assert!(!bench.path("out").exists());
    assert!(bench.path("away/blocks/000001.csv").exists());
    fs::rename(bench.path("away"), bench.path("out")).unwrap();
    bench.out(&format!("{line} --out out --resume"));
    bench.out(&format!("{line} --out whole"));
    assert_eq!(bench.read("out/runs.csv"), bench.read("whole/runs.csv"));
}

#[cfg(unix)]
#[test]
fn law_an_interrupted_sweep_says_how_it_goes_on_and_so_it_does() {
    let bench = Bench::new();
    let line = "sweep cut-in --fpr 30 --seeds 400 --block 2";
    let child = begin(&bench, &format!("{line} --out out"));
    await_path(&bench, "out/blocks/000001.csv");
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(signal.unwrap().success());
    let ended = child.wait_with_output().unwrap();
    let err = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(130), "{err}");
    assert!(err.contains("of 200 blocks are complete"), "{err}");
    let go_on = err.lines().last().unwrap().trim();
    assert_eq!(go_on, format!("zhuyi {line} --out out --resume"));
    bench.out(go_on.strip_prefix("zhuyi ").unwrap());
    bench.out(&format!("{line} --out whole"));
    assert_eq!(bench.read("out/runs.csv"), bench.read("whole/runs.csv"));
}

#[test]
fn law_a_varied_drive_is_that_of_its_replay_and_a_refused_one_is_a_row() {
    let bench = Bench::new();
    let line = "sweep cut-in --fpr 30 --seeds 1 --vary actors.cutter.speed_mps=[20, 90] \
         --vary planner.min_gap_m=2:3 --out out";
    // A list with a blank in it, as a shell would hand it on.
    let words = ["actors.cutter.speed_mps=[20,", "90]"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_zhuyi"));
    let joined = line.replace(&words.join(" "), "LIST");
    let words = joined.split_whitespace().map(|word| match word {
        "LIST" => "actors.cutter.speed_mps=[20, 90]",
        word => word,
    });
    let ran = crate::run(command.args(words).current_dir(bench.path("")));
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
    assert!(ran.out.contains("2 refused and 0 failed"), "{}", ran.out);
    let runs = bench.read("out/runs.csv");
    let rows: Vec<&str> = runs.lines().collect();
    assert!(rows[0].starts_with(
        "scenario,part,fpr_hz,seed,actors.cutter.speed_mps,planner.min_gap_m,outcome,"
    ));
    assert!(rows[0].ends_with(",reason,replay"));
    assert_eq!(rows.len(), 5);
    let replay = rows[2].rsplit_once(",zhuyi ").unwrap().1;
    assert!(replay.ends_with("--set actors.cutter.speed_mps=20 --set planner.min_gap_m=3"));
    let json: serde_json::Value =
        serde_json::from_str(&bench.out(&format!("{replay} --json"))).unwrap();
    let gap = format!(",{:.4},", json["smallest_gap_m"].as_f64().unwrap());
    assert!(rows[2].contains(&gap), "{gap} is not in {}", rows[2]);
    assert!(
        rows[3].starts_with("cut-in,sweep,30,0,90,2,refused,"),
        "{}",
        rows[3]
    );
    assert!(
        rows[3].contains("`speed_mps` must be 0 to 80, got 90"),
        "{}",
        rows[3]
    );
    assert_eq!(
        bench.zhuyi(rows[3].rsplit_once(",zhuyi ").unwrap().1).code,
        Some(2)
    );
}

#[test]
fn hand_a_dry_run_counts_and_writes_nothing_and_a_limit_is_told() {
    let bench = Bench::new();
    let out = bench.out(&format!("{LINE} --dry-run --out out"));
    assert!(
        out.starts_with(
            "40 drives in 40 blocks: 2 scenarios x 2 combinations of values x 2 rates x 5 seeds\n  \
             zhuyi run cut-in --fpr 2 --seed 0 --set planner.min_gap_m=2.5 --set perception.miss_rate=0\n"
        ),
        "{out}"
    );
    assert!(!bench.path("out").exists());
    let out = bench.out(&format!("{LINE} --limit 7 --out out"));
    assert!(
        out.ends_with("7 drives in out/runs.csv (limited: the first of 40)\n"),
        "{out}"
    );
    let limited = bench.read("out/runs.csv");
    bench.out(&format!("{LINE} --out out"));
    assert!(bench.read("out/runs.csv").starts_with(&limited));
}

#[test]
fn hand_what_cannot_be_a_plan_is_refused_before_anything_is_made() {
    let bench = Bench::new();
    for (flags, told) in [
        ("--vary planner.min_gap=1:2", "did you mean `min_gap_m`?"),
        (
            "--vary actors.nobody.speed_mps=1:2",
            "unknown setting `nobody`",
        ),
        (
            "--vary planner.min_gap_m=1:2 --set planner.min_gap_m=3",
            "is given twice",
        ),
        ("--shard 3", "a shard has the form k/n"),
        ("--shard 0/3", "a shard must be 1 to 3, got 0"),
        ("--shard 4/3", "a shard must be 1 to 3, got 4"),
        ("--limit 0", "the number of drives must be 1 to"),
        ("--block 0", "the size of a block must be 1 to"),
        ("--jobs -1", "the number of threads must be 1 to"),
    ] {
        let ran = bench.zhuyi(&format!("sweep cut-in {flags} --out out"));
        refused(&ran, 2, told);
        assert!(!bench.path("out").exists(), "{flags}");
    }
    refused(
        &bench.zhuyi("merge nowhere --out out"),
        2,
        "there is no such file",
    );
}

#[test]
fn law_samples_are_drawn_alike_in_every_shard_and_a_replay_makes_the_same_drive() {
    let bench = Bench::new();
    let line = "sweep cut-in --fpr 4 --seeds 1 --vary perception.phase_share=uniform(0,1) \
         --vary actors.cutter.speed_mps=normal(22,1) --samples 8 --root-seed 3 --block 3";
    bench.out(&format!("{line} --out whole"));
    bench.out(&format!("{line} --shard 1/2 --out one"));
    bench.out(&format!("{line} --shard 2/2 --out two"));
    bench.out("merge one two --out merged");
    let runs = bench.read("whole/runs.csv");
    assert_eq!(bench.read("merged/runs.csv"), runs);
    let mut eighths = Vec::new();
    for row in runs.lines().skip(1) {
        let share: f64 = row.split(',').nth(4).unwrap().parse().unwrap();
        eighths.push((share * 8.0) as u32);
        let replay = row.rsplit_once(",zhuyi ").unwrap().1;
        let json: serde_json::Value =
            serde_json::from_str(&bench.out(&format!("{replay} --json"))).unwrap();
        let gap = format!(",{:.4},", json["smallest_gap_m"].as_f64().unwrap());
        assert!(row.contains(&gap), "{gap} is not in {row}");
    }
    // A Latin hypercube: each eighth of the phase once.
    eighths.sort_unstable();
    assert!(eighths.into_iter().eq(0..8));
    let other = line.replace("--samples 8", "--samples 9");
    let ran = bench.zhuyi(&format!("{other} --out one --resume"));
    refused(&ran, 2, "these parts of its plan differ: points, typed");
}

#[test]
fn law_what_changed_between_two_folders_is_told() {
    let bench = Bench::new();
    let line = "sweep cut-out-fast --fpr 2,30 --seeds 2";
    bench.out(&format!("{line} --out one"));
    bench.out(&format!("{line} --out same --block 3"));
    let same = bench.out("diff one same");
    assert_eq!(same, "one and same have the same results\n");
    bench.out(&format!(
        "{line} --out other --set planner.time_headway_s=4"
    ));
    let ran = bench.zhuyi("diff one other");
    assert_eq!(ran.code, Some(1));
    assert_eq!(ran.err, "error: one and other differ\n");
    assert!(ran.out.contains("smallest_gap_m differs in"), "{}", ran.out);
    assert_eq!(bench.zhuyi("diff one nowhere").code, Some(4));
}

#[test]
fn hand_parquet_stands_beside_the_csv_where_the_program_has_it_and_is_refused_where_not() {
    let bench = Bench::new();
    let line = "sweep cut-in --fpr 30 --seeds 2 --block 1";
    let ran = bench.zhuyi(&format!("{line} --out out --parquet"));
    if cfg!(not(feature = "parquet")) {
        refused(&ran, 2, "this zhuyi was built without Parquet");
        assert!(ran.err.contains("--features parquet"), "{}", ran.err);
        assert!(!bench.path("out").exists());
        return;
    }
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
    assert_eq!(
        bench.names("out"),
        ["plan.json", "runs.csv", "runs.parquet"]
    );
    // A finished sweep gets it too, and so does a merged one.
    for shard in 1..=2 {
        bench.out(&format!("{line} --shard {shard}/2 --out {shard}"));
    }
    bench.out("merge 1 2 --out merged");
    bench.out(&format!("{line} --out merged --resume --parquet"));
    bench.out("merge 1 2 --out again --parquet");
    let read = |folder: &str| fs::read(bench.path(folder).join("runs.parquet")).unwrap();
    let bytes = read("out");
    assert!(bytes.starts_with(b"PAR1") && bytes == read("merged") && bytes == read("again"));
}
