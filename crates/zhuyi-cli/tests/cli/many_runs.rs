//! `mrf` with and without `--per-camera`, `sweep`, `reproduce`, `robustness`, `compare`, `beyond`, `figures`, with few runs.

use crate::Bench;
use zhuyi_scenario::embedded;

#[test]
fn hand_mrf_above_what_was_tested() {
    let bench = Bench::new();
    // Brakes of 1 m/s2 never do; a lone ego never collides.
    let out = bench.out("mrf cut-out-fast --fpr 3:5,9 --seeds 2 --set vehicle.friction=0.1");
    let row = out
        .lines()
        .find(|line| line.starts_with(" cut-out-fast"))
        .unwrap();
    assert!(
        row.contains(" >9 ") && row.contains("2 each at 3 to 9"),
        "{out}"
    );
    // 1 - 0.05^(1/2) = 0.776.
    assert!(
        out.contains("of the 4 tested, none of 2 seeds\ncollided.") && out.contains("below 78 %"),
        "{out}"
    );
    let out = bench.out("mrf vehicle-following --fpr 2 --seeds 1 --set actors=[]");
    let row = out
        .lines()
        .find(|line| line.starts_with(" vehicle-following"))
        .unwrap();
    assert!(row.contains(" <=2 ") && row.contains("none"), "{out}");
}

#[test]
fn law_a_search_per_camera_is_reproduced_and_a_changed_file_is_told() {
    let bench = Bench::new();
    let line = "mrf --per-camera challenging-cut-in vehicle-following --brute-force challenging-cut-in --fpr 1,3,30 --seeds 1 \
                --root-seed 0";
    let printed = bench.out(line);
    assert!(
        printed.starts_with(
            "rates 1, 3, 30 FPR on each of front_120, left and right (front_60 goes with"
        ),
        "{printed}"
    );
    for words in [
        "In challenging-cut-in every combination was tried: 27 in ",
        "Both agree on which of them are safe",
    ] {
        assert!(printed.contains(words), "{words} is not in\n{printed}");
    }
    assert_eq!(bench.names("."), [""; 0], "nothing is written");
    let out = bench.out(&format!("{line} --out out"));
    assert!(out.starts_with(printed.trim_end()), "{out}");
    assert_eq!(
        bench.names("out"),
        ["mrf_per_camera.csv", "mrf_per_camera.md"]
    );
    let page = bench.read("out/mrf_per_camera.md");
    let command = "zhuyi mrf --per-camera challenging-cut-in vehicle-following --brute-force challenging-cut-in --fpr 1,3,30 --seeds 1";
    assert!(
        page.contains(&format!("Written by `{command}`: ")),
        "{page}"
    );
    let replay = page
        .rsplit_once("One of the runs again: `zhuyi ")
        .unwrap()
        .1;
    let replay = replay.split_once('`').unwrap().0;
    let told = bench.out(&format!("{replay} --json"));
    assert!(told.contains("\"collision\": null"), "{replay}: {told}");
    let out = bench.out(&format!("{line} --out out --check"));
    assert!(out.contains("All 2 files in out are reproduced."), "{out}");
    bench.write("out/mrf_per_camera.md", "no camera is needed\n");
    let ran = bench.zhuyi(&format!("{line} --out out --check"));
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("mrf_per_camera.md:1: "), "{}", ran.err);
    assert_eq!(bench.read("out/mrf_per_camera.md"), "no camera is needed\n");
}

#[test]
fn hand_a_car_of_two_analysed_cameras_has_two_rates() {
    let bench = Bench::new();
    let out = bench.out(
        "mrf --per-camera vehicle-following --fpr 2:30:14 --seeds 1 --set perception.cameras.right.analysed=false",
    );
    assert!(
        out.starts_with("rates 2, 16, 30 FPR on each of front_120 and left (front_60 goes with front_120, right keeps 30 and is"),
        "{out}"
    );
}

#[test]
fn law_a_sweep_has_one_row_per_run_and_its_command_makes_it_again() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("mine")).unwrap();
    bench.write(
        "mine/near.ron",
        embedded::scenario("vehicle-following").unwrap(),
    );
    let line = "sweep cut-out-fast mine/near.ron --fpr 1:30:29 --seeds 2 --root-seed 5 --set planner.min_gap_m=2.5 --out made/here";
    let out = bench.out(line);
    assert!(out.contains("8 drives in made/here/runs.csv"), "{out}");
    assert_eq!(bench.names("made/here"), ["plan.json", "runs.csv"]);
    let runs = bench.read("made/here/runs.csv");
    let rows: Vec<&str> = runs.lines().collect();
    assert_eq!(rows.len(), 1 + 8);
    assert!(rows[0].starts_with("scenario,"), "{}", rows[0]);
    assert!(rows[8].ends_with(
        "zhuyi run mine/near.ron --fpr 30 --seed 1 --root-seed 5 --set planner.min_gap_m=2.5"
    ));
    for row in [rows[1], rows[8]] {
        let replay = row.rsplit_once(",zhuyi ").unwrap().1;
        let json: serde_json::Value =
            serde_json::from_str(&bench.out(&format!("{replay} --json"))).unwrap();
        let collided = row.contains(",collision,");
        assert_eq!(collided, !json["collision"].is_null(), "{row}");
        let gap = format!("{:.4}", json["smallest_gap_m"].as_f64().unwrap());
        assert!(row.contains(&gap), "{gap} is not in {row}");
    }
    bench.out(line);
    assert_eq!(bench.read("made/here/runs.csv"), runs);
}

#[test]
fn law_results_are_reproduced_and_a_changed_one_is_told() {
    let bench = Bench::new();
    let line = "reproduce --fpr 2,30 --seeds 1 --out out";
    let out = bench.out(line);
    assert!(out.contains("Wrote out/"), "{out}");
    let names = bench.names("out");
    for name in ["claims.md", "runs.csv", "table1.csv", "table1.md"] {
        assert!(
            names.iter().any(|made| made == name),
            "{name} is not in {names:?}"
        );
    }
    let out = bench.out(&format!("{line} --check"));
    assert!(out.contains("files in out are reproduced"), "{out}");
    bench.write("out/claims.md", "all is well\n");
    std::fs::remove_file(bench.path("out/table1.csv")).unwrap();
    let ran = bench.zhuyi(&format!("{line} --check"));
    assert_eq!(ran.code, Some(1));
    assert!(
        ran.err.starts_with("error: not reproduced in out:\n"),
        "{}",
        ran.err
    );
    assert!(
        ran.err.contains("claims.md:1: ") && ran.err.contains("table1.csv: missing"),
        "{}",
        ran.err
    );
    // Nothing was written.
    assert_eq!(bench.read("out/claims.md"), "all is well\n");
}

#[test]
fn hand_beyond_writes_its_file_and_its_figures() {
    let bench = Bench::new();
    let out = bench.out("beyond --fpr 30 --seeds 1 --out out");
    assert!(out.ends_with("out/figures/beyond-evasion.svg\n"), "{out}");
    assert_eq!(bench.names("out"), ["beyond.md", "figures"]);
    let figures = [
        "beyond-evasion.svg",
        "beyond-phantom.svg",
        "beyond-uncertainty.svg",
    ];
    assert_eq!(bench.names("out/figures"), figures);
    bench.out("beyond --fpr 30 --seeds 1 --out out --check");
}

#[test]
fn law_figures_are_drawn_of_results_that_are_there_and_reproduced() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("out")).unwrap();
    let ran = bench.zhuyi("figures --out out");
    assert_eq!(ran.code, Some(4));
    for told in [
        "`out/table1.csv` is missing; `zhuyi reproduce` makes it",
        "`out/allocation.csv` is missing; `zhuyi allocate --out results` makes it",
        "`out/mrf_per_camera.csv` is missing; `zhuyi mrf --per-camera --out results` makes it",
    ] {
        assert!(ran.err.contains(told), "{}", ran.err);
    }
    bench.write(
        "out/table1.csv",
        "scenario,quantity,solver,ours,paper\ncut-in,mrf,,1,1\ncut-in,est_2,exact,1.9,3.9\n",
    );
    bench.write(
        "out/allocation.csv",
        "scenario,policy,drives,collisions,budget_fps\nall,uniform,90,forty,5\n",
    );
    bench.write(
        "out/mrf_per_camera.csv",
        "scenario,method,quantity,front_120_hz,left_hz,right_hz,value\ncut-in,search,mrf_hz,,,,1\n\
         cut-in,search,frontier,1,1,1,3\n",
    );
    let ran = bench.zhuyi("figures --out out");
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.err
            .contains("line 2: `forty` is no number for `collisions`"),
        "{}",
        ran.err
    );
    let good = bench.read("out/allocation.csv").replace("forty", "40");
    bench.write("out/allocation.csv", &good);
    let out = bench.out("figures --out out");
    assert!(out.starts_with("9 figures, each with its CSV\n"), "{out}");
    assert_eq!(bench.names("out/figures").len(), 18);
    bench.out("figures --out out --check");
    bench.write("out/allocation.csv", &good.replace("40", "41"));
    let ran = bench.zhuyi("figures --out out --check");
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("figures/budget.csv:2"), "{}", ran.err);
}

#[test]
fn hand_robustness_writes_its_file() {
    let bench = Bench::new();
    let out = bench.out("robustness --fpr 30 --seeds 1 --out out");
    assert!(out.ends_with("Wrote out/robustness.md\n"), "{out}");
    assert_eq!(bench.names("out"), ["robustness.md"]);
}

#[test]
fn law_a_comparison_is_reproduced_and_a_changed_file_is_told() {
    let bench = Bench::new();
    let line = "compare cut-out-fast front-right-activity-1 --seeds 1 --every-ms 100 --set planner.min_gap_m=2.5";
    let printed = bench.out(line);
    assert!(
        printed.starts_with("30 FPR, 1 seed, root seed 0, models asked every 100 ms\n"),
        "{printed}"
    );
    assert_eq!(bench.names("."), [""; 0], "nothing is written");
    let out = bench.out(&format!("{line} --out out"));
    assert!(out.starts_with(printed.trim_end()), "{out}");
    assert_eq!(
        bench.names("out"),
        ["compare.csv", "compare.md", "compare_demand.csv"]
    );
    let page = bench.read("out/compare.md");
    assert!(
        page.contains(&format!("Written by `zhuyi {line}`: ")),
        "{page}"
    );
    assert!(page.contains("Peaks are sharp"), "{page}");
    let demand = bench.read("out/compare_demand.csv");
    let header = "scenario,seed,time_s,camera,model,fpr_hz\ncut-out-fast,0,0.0,front_120,zhuyi,";
    assert!(demand.starts_with(header), "{demand}");
    assert!(
        bench
            .read("out/compare.csv")
            .contains("\nall,rss,share_at_30,")
    );
    let out = bench.out(&format!("{line} --out out --check"));
    assert!(out.contains("All 3 files in out are reproduced."), "{out}");
    bench.write("out/compare.md", "all are safe\n");
    let ran = bench.zhuyi(&format!("{line} --out out --check"));
    assert_eq!(ran.code, Some(1));
    assert!(ran.err.contains("compare.md:1: "), "{}", ran.err);
    assert_eq!(bench.read("out/compare.md"), "all are safe\n");
}

#[test]
fn hand_mrf_tells_how_sure_it_is() {
    let bench = Bench::new();
    let line = "mrf cut-out-fast --fpr 3:7 --seeds 4";
    let out = bench.out(&format!("{line} --by-rate"));
    // 4 of 4 has the Wilson interval z²/(n + z²) = 0.49 from above: 0.51 to 1.
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let told = |row: &str| out.lines().any(|line| words(line) == row);
    assert!(told("cut-out-fast 3 4 4 1.000 0.510 to 1.000"), "{out}");
    assert!(
        out.contains("a chance of a collision of P = 0.4899 is allowed"),
        "{out}"
    );
    let document = |options: &str| -> serde_json::Value {
        serde_json::from_str(&bench.out(&format!("{line} {options} --json"))).unwrap()
    };
    let (all, early) = (document(""), document("--early-stop"));
    let found = |document: &serde_json::Value, what: &str| document["scenarios"][0][what].clone();
    assert_eq!(found(&all, "mrf"), found(&early, "mrf"));
    assert_eq!(all["interval"], "wilson");
    assert_eq!(early["interval"], "robbins");
    let rates = |document: &serde_json::Value| found(document, "rates").as_array().unwrap().clone();
    assert_eq!(rates(&all)[0]["drives"], 4);
    assert_eq!(
        (&rates(&early)[0]["drives"], &rates(&early)[0]["collided"]),
        (&1.into(), &1.into())
    );
    let replay = "zhuyi run cut-out-fast --fpr 3 --seed 0";
    assert_eq!(rates(&early)[0]["replay"], replay);
    // Stratified: twice the drives, and the replay sets every camera's phase.
    let strata = document("--phases 2");
    let rate = &rates(&strata)[0];
    assert_eq!(rate["drives"], 8);
    let replay = rate["replay"].as_str().unwrap();
    assert_eq!(replay.matches(".phase_share=0.").count(), 5, "{replay}");
    let ran = bench.out(replay.strip_prefix("zhuyi ").unwrap());
    assert!(ran.contains("ollision"), "{ran}");
    // 1 / (3 · 0.1²) = 33 after a block of two clean drives; 1 / (9 · 0.9^8) = 0.3 after eight collisions.
    let decided = document("--early-stop --at-most 0.9 --phases 2");
    let drives = |place: usize| rates(&decided)[place]["drives"].as_u64().unwrap();
    assert_eq!((drives(0), drives(4)), (8, 2));
}
