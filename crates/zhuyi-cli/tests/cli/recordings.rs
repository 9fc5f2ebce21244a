//! `estimate`: a trace of a run gives what the run told, any vehicle can be the ego, bad rows are told.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::{Bench, Ran};
use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Source, embedded, load};
use zhuyi_sim::{Hindsight, RunSpec};

const HEADER: &str = "time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n";

/// Half a second at 10 m/s, 50 m behind a car that stands; a third vehicle appears behind at the end.
fn trace() -> String {
    let rows = (0..5).map(|step| {
        format!("0.{step},ego,{step},0,0,10,0,4,2\n0.{step},\"wreck, red\",54,0,0,0,0,4,2\n")
    });
    let late = "0.40,late,-20,0,0,9,0,4,2\n0.5,late,-19.1,0,0,9,0,4,2\n";
    format!("{HEADER}{}{late}", rows.collect::<String>())
}

/// Cells of a file, header first.
fn cells(text: &str) -> Vec<Vec<String>> {
    let row = |line: &str| line.split(',').map(String::from).collect();
    text.lines().map(row).collect()
}

/// [FPR] the demand on every camera at every step of a run, from the integrator's own pieces.
fn demands(name: &str) -> Vec<Vec<f64>> {
    let source = |name: &str, text: &str| Source::new(format!("{name}.ron"), text);
    let scenario = source(name, embedded::scenario(name).unwrap());
    let system = source("default", embedded::system());
    let (scenario, system) = load(&scenario, &system, &[]).unwrap();
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let run = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates.clone())
        .run_fixed();
    let estimator = Estimator::new(system.estimator.clone());
    let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, &rates);
    let rows = run.trace.rows().map(|row| {
        let demands = hindsight.demands(&estimator, &row);
        demands.iter().map(|demand| demand.fpr).collect()
    });
    rows.collect()
}

#[test]
fn law_a_trace_of_a_run_asks_for_what_the_run_asked_for() {
    let bench = Bench::new();
    let (mut all, mut asking, mut on_road, mut on_own_path) = (0, 0, 0, 0);
    for name in embedded::names() {
        bench.out(&format!("run {name} --trace t.csv"));
        bench.out(&format!("estimate t.csv --road {name} --out road"));
        let told = bench.out("estimate t.csv --out own");
        assert!(!told.contains("Note:"), "{told}");
        let expected = demands(name);
        for frame in ["road", "own"] {
            let cameras = cells(&bench.read(&format!("{frame}/cameras.csv")));
            assert_eq!(cameras.len() - 1, 5 * expected.len());
            for (row, expected) in cameras[1..].iter().zip(expected.iter().flatten()) {
                let got: f64 = row[3].parse().unwrap();
                all += 1;
                asking += u32::from(*expected > 1.0);
                let differs = u32::from((got - expected).abs() > 1e-6);
                if frame == "road" {
                    on_road += differs;
                } else {
                    // In a bend the box of the ego stands turned by its slip angle in the lane, and aligned on its own path.
                    assert!(differs == 0 || name.contains("curved"), "{name}");
                    assert!((got - expected).abs() < 0.15 * expected, "{row:?}");
                    on_own_path += differs;
                }
            }
        }
    }
    assert!(all == 260_000 && asking > 15_000, "{all} {asking}");
    assert_eq!(on_road, 0, "of {all} demands");
    assert!(on_own_path <= 4, "{on_own_path} of {all} demands");
}

#[test]
fn law_the_peaks_are_those_of_the_run() {
    let bench = Bench::new();
    let json = bench.out("run cut-in --seed 2 --trace t.csv --json");
    let document: serde_json::Value = serde_json::from_str(&json).unwrap();
    bench.out("estimate t.csv --road cut-in --out out");
    let rows = cells(&bench.read("out/cameras.csv"));
    for camera in document["cameras"].as_array().unwrap() {
        let own = rows[1..]
            .iter()
            .filter(|row| camera["name"] == row[1].as_str());
        let number = |row: &[String], place: usize| row[place].parse::<f64>().unwrap();
        let first = own.fold(None, |first: Option<&Vec<String>>, row| match first {
            Some(first) if number(first, 3) >= number(row, 3) => Some(first),
            _ => Some(row),
        });
        let first = first.unwrap();
        assert!((number(first, 3) - camera["demand_fpr"].as_f64().unwrap()).abs() < 1e-6);
        if let Some(time) = camera["demand_time_s"].as_f64() {
            assert_eq!(
                (number(first, 0), first[4].as_str()),
                (time, camera["demand_actor"].as_str().unwrap())
            );
        }
    }
}

/// 50 m bumper to bumper: by hand 0.604 s, as in the estimator's documentation. At 46 m 0.9 x 46 - 10.2 = 31.2 m are 3.12 s, and
/// (3.12 + 5/30) / 6 = 0.548 s; 0.538 on the grid.
#[test]
fn hand_the_files() {
    let bench = Bench::new();
    bench.write("t.csv", &trace());
    let told = bench.out("estimate t.csv --out new/out");
    assert_eq!(
        bench.names("new/out"),
        ["actors.csv", "cameras.csv", "criticality.csv"]
    );
    let actors = bench.read("new/out/actors.csv");
    let lines: Vec<&str> = actors.lines().collect();
    assert_eq!(
        lines[0],
        "time_s,actor,state,latency_s,t_n_s,binding,extrapolated_s,cameras"
    );
    assert_eq!(
        lines[1],
        "0.0,\"wreck, red\",tolerable,0.604000,5.498150,distance,19.600000,front_120;front_60"
    );
    assert_eq!(
        lines[5],
        "0.4,\"wreck, red\",tolerable,0.538000,5.102150,distance,20.000000,front_120;front_60"
    );
    // It was just behind, and falls back.
    assert_eq!(lines[6], "0.4,late,none,1.000000,,,19.900000,rear");
    assert_eq!(lines.len(), 7);
    let cameras = bench.read("new/out/cameras.csv");
    let lines: Vec<&str> = cameras.lines().collect();
    assert_eq!(
        lines[..2],
        [
            "time_s,camera,latency_s,fpr_hz,actor",
            "0.0,front_120,0.604000,1.655629,\"wreck, red\""
        ]
    );
    assert_eq!((lines[5], lines.len()), ("0.0,rear,1.000000,1.000000,", 26));
    // By hand: 50 m at 10 m/s are 5 s of TTC and THW; 10^2 / (2 x 50) = 1 m/s2, of 9 available; 5 - 10 / (2 x 9) = 4.44 s to
    // brake; an ego that goes on hits it.
    let criticality = bench.read("new/out/criticality.csv");
    let lines: Vec<&str> = criticality.lines().collect();
    assert_eq!(
        lines[..2],
        [
            "time_s,actor,ttc_s,ttc_2d_s,thw_s,drac_mps2,pet_s,ttb_s,btn,impact_mps",
            "0.0,\"wreck, red\",5.000000,5.000000,5.000000,1.000000,0.000000,4.444444,0.111111,0.000000",
        ]
    );
    assert_eq!(lines.len(), 7);
    for part in [
        "t.csv: ego `ego`, 5 of 6 steps evaluated, 1 without the ego skipped; 2 of 2 other vehicles met.",
        "Frame: the ego's own recorded path, 4.0 m, then straight on.",
        " none                1   16.7 %",
        " tolerable           5   83.3 %",
        "front_120*    30 FPR         1.86 FPR   0.3 s   wreck, red",
        "* analysed: at most 1.86 FPR for one of them, 3.86 FPR for all at one time.",
        "Wrote new/out/actors.csv, new/out/cameras.csv, new/out/criticality.csv",
        "  zhuyi estimate t.csv --criterion standstill --out new/out ",
    ] {
        assert!(told.contains(part), "{part} is not in\n{told}");
    }
}

#[test]
fn hand_the_flags_reach_the_estimator() {
    let bench = Bench::new();
    bench.write("t.csv", &trace());
    let first = |flags: &str| {
        bench.out(&format!("estimate t.csv {flags} --out o"));
        let row = |file: &str| {
            bench
                .read(file)
                .lines()
                .nth(1)
                .unwrap()
                .replace("wreck, red", "wreck")
        };
        let actors: Vec<String> = row("o/actors.csv").split(',').map(String::from).collect();
        let cameras: Vec<String> = row("o/cameras.csv").split(',').map(String::from).collect();
        (actors[3].clone(), actors[4].clone(), cameras[2].clone())
    };
    let latency = |flags: &str| first(flags).0;
    // l + 5 (l - 1/5) <= 3.48 at 5 FPR, on the grid.
    assert_eq!(latency("--fpr 5"), "0.736000");
    // The actor's is the smallest of its cameras, the camera's its own.
    let (actor, _, camera) = first("--fpr front_60=30,front_120=5");
    assert_eq!((actor.as_str(), camera.as_str()), ("0.604000", "0.736000"));
    assert_eq!(
        latency("--set estimator.current_latency=Fixed(latency_ms:200)"),
        "0.736000"
    );
    // Without a margin 50 m are left: 3.98 s, and l <= 0.691.
    assert_eq!(latency("--set estimator.c1=1.0"), "0.670000");
    // No t_n, and no margin either.
    let (actor, t_n, _) = first("--criterion standstill");
    assert_eq!((actor.as_str(), t_n.as_str()), ("0.670000", ""));
    bench.write(
        "rig.ron",
        &embedded::system()
            .replace("c1: 0.9", "c1: 1.0")
            .replace("front_120", "nose"),
    );
    assert_eq!(latency("--rig rig.ron"), "0.670000");
    assert!(bench.read("o/cameras.csv").contains("0.0,nose,"));
    assert_eq!(latency("--rig rig.ron --set estimator.c1=0.9"), "0.604000");
}

/// The paper's jumps find another t_n, and never tolerate more than the exact solver.
#[test]
fn law_the_solvers_differ_to_one_side() {
    let bench = Bench::new();
    bench.out("run cut-in --trace t.csv");
    let answers = |solver: &str| {
        bench.out(&format!("estimate t.csv --solver {solver} --out o"));
        cells(&bench.read("o/actors.csv"))
    };
    let (exact, paper) = (answers("exact"), answers("paper"));
    let rows = || exact[1..].iter().zip(&paper[1..]);
    let other = rows().filter(|(exact, paper)| exact[4] != paper[4]).count();
    assert!(other > 100, "another t_n in {other} rows");
    let latency = |row: &[String]| row[3].parse().unwrap_or(0.0);
    let more = rows().filter(|(exact, paper)| latency(paper) > latency(exact));
    assert_eq!(more.count(), 0);
}

/// A car stands on an arc of 100 m radius, 60 m ahead along it and 18 m beside the straight: in the ego's way on the road
/// alone. In one row there is no path but the heading.
#[test]
fn hand_a_road_gives_the_frame() {
    let bench = Bench::new();
    let bend =
        embedded::template().replace("Line(length_m: 2000)", "Arc(length_m: 500, radius_m: 100)");
    assert_ne!(bend, embedded::template());
    bench.write("bend.ron", &bend);
    let (sin, cos) = 0.6_f64.sin_cos();
    let wreck = format!(
        "0,wreck,{},{},0.6,0,0,4,2\n",
        100.0 * sin,
        100.0 * (1.0 - cos)
    );
    bench.write("t.csv", &format!("{HEADER}0,ego,0,0,0,10,0,4,2\n{wreck}"));
    let state = |flags: &str| {
        let told = bench.out(&format!("estimate t.csv {flags} --out o"));
        (cells(&bench.read("o/actors.csv"))[1][2..4].join(" "), told)
    };
    let (answer, told) = state("--road bend.ron");
    // 56 m bumper to bumper: 0.9 x 56 - 10.2 = 40.2 m, 4.02 s, (4.02 + 5/30) / 6 = 0.698 s.
    assert_eq!(answer, "tolerable 0.670000");
    assert!(told.contains("Frame: the road of bend.ron.\n"), "{told}");
    let (answer, told) = state("");
    assert_eq!(answer, "none 1.000000");
    assert!(
        told.contains("Frame: the ego's own recorded path, 0.0 m, then straight on.\n"),
        "{told}"
    );
    // A value of the scenario may be set: the other way round.
    let (answer, _) =
        state("--road bend.ron --set road.segments=[Arc(length_m:500,radius_m:-100)]");
    assert_eq!(answer, "none 1.000000");
}

/// 10 m/s along y past a car 60 m ahead. 90 rad are 14 turns and 116.6 degrees, 26.6 from y and 116.6 from x; 36 km/h are
/// 10 m/s.
#[test]
fn hand_wrong_units_are_noted() {
    let bench = Bench::new();
    let told = |along_y: bool, heading: &str, speed: f64, flags: &str| {
        let mut text = HEADER.to_string();
        for step in 0..5 {
            for (id, ahead, speed) in [("ego", f64::from(step), speed), ("wreck", 60.0, 0.0)] {
                let (x, y) = if along_y { (0.0, ahead) } else { (ahead, 0.0) };
                writeln!(text, "0.{step},{id},{x},{y},{heading},{speed},0,4,2").unwrap();
            }
        }
        bench.write("t.csv", &text);
        bench.out(&format!("estimate t.csv --out o {flags}"))
    };
    let fine = told(true, "1.5707963", 10.0, "");
    assert!(!fine.contains("Note:"), "{fine}");
    // It reverses.
    let fine = told(true, "-1.5707963", -10.0, "");
    assert!(!fine.contains("Note:"), "{fine}");
    let askew = "Note: `heading_rad` does not fit the positions: in 4 of 4 places the ego drives elsewhere, mostly by";
    let noted = told(false, "90", 10.0, "");
    assert!(
        noted.contains(&format!("{askew} 117 degrees. It")),
        "{noted}"
    );
    let noted = told(true, "90", 10.0, "");
    assert!(
        noted.contains(&format!("{askew} 27 degrees. It")),
        "{noted}"
    );
    let noted = told(true, "1.5707963", 36.0, "");
    assert!(
        noted.contains("in 4 of 4 places the ego drives mostly 0.278 times as far."),
        "{noted}"
    );
    let noted = told(true, "90", 36.0, "--all-egos");
    for part in [
        "Note: `heading_rad` (radians, anticlockwise from x) does not fit the positions of `ego`.\n",
        "Note: `speed_mps` does not fit the positions (metres) and times (seconds) of `ego`.\n",
    ] {
        assert!(noted.contains(part), "{noted}");
    }
}

#[test]
fn hand_every_vehicle_as_the_ego() {
    let bench = Bench::new();
    bench.write("t.csv", &trace());
    let told = bench.out("estimate t.csv --all-egos --out o");
    assert_eq!(bench.names("o"), ["egos.csv"]);
    let expected = "\
ego,steps,actors,none,tolerable,beyond_grid,unavoidable,alongside,standing,fpr_hz,camera,time_s,actor,extrapolated_share
ego,5,2,1,5,0,0,0,0,1.858736,front_120,0.3,\"wreck, red\",0.990833
\"wreck, red\",5,2,6,0,0,0,0,0,1.000000,,,,0.990833
late,2,2,0,2,0,0,0,0,1.000000,front_120,0.4,ego,1.000000
";
    assert_eq!(bench.read("o/egos.csv"), expected);
    assert!(
        told.contains("t.csv: each of 3 vehicles as the ego, 6 steps in the file, 14 answers."),
        "{told}"
    );
    let ran = bench.zhuyi("estimate t.csv --all-egos --ego late --out o");
    assert_eq!(ran.code, Some(2));
}

#[test]
fn law_the_help_names_all_states() {
    let names = zhuyi_estimator::State::ALL.map(zhuyi_estimator::State::name);
    let (last, others) = names.split_last().unwrap();
    let help = Bench::new().out("estimate --help");
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let list = format!("of each state {} and {last},", others.join(", "));
    assert!(words.contains(&list), "{words}");
}

#[test]
fn hand_real_traffic() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/traces");
    let bench = Bench::new();
    for file in ["us101-4_1.csv", "us101-5_1.csv"] {
        let Ok(text) = fs::read_to_string(folder.join(file)) else {
            println!("skipped: ../shared/data/traces/{file} is not there");
            continue;
        };
        bench.write(file, &text);
        let told = bench.out(&format!("estimate {file} --all-egos --out o"));
        assert!(!told.contains("Note:"), "{told}");
        for row in &cells(&bench.read("o/egos.csv"))[1..] {
            let told = bench.out(&format!("estimate {file} --ego {} --out o", row[0]));
            assert!(
                told.contains(&format!(
                    "ego `{}`, {} of 101 steps evaluated",
                    row[0], row[1]
                )),
                "{told}"
            );
            let count: usize = row[3..3 + zhuyi_estimator::State::ALL.len()]
                .iter()
                .map(|cell| cell.parse::<usize>().unwrap())
                .sum();
            assert_eq!(bench.read("o/actors.csv").lines().count() - 1, count);
            assert_eq!(
                bench.read("o/cameras.csv").lines().count() - 1,
                5 * row[1].parse::<usize>().unwrap()
            );
        }
    }
}

fn refused(trace: &str, flags: &str) -> Ran {
    let bench = Bench::new();
    bench.write("t.csv", trace);
    let ran = bench.zhuyi(&format!("estimate t.csv --out new/out {flags}"));
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{}", ran.err);
    // Nothing is left behind.
    assert_eq!(bench.names("."), ["t.csv"]);
    ran
}

#[test]
fn hand_bad_rows() {
    for (rows, told) in [
        (
            "0.0,ego,0,0,nan,1,0,4,2\n",
            "\
error: `heading_rad` must be a number from -1e12 to 1e12, got nan
 --> t.csv:2:13
  |
2 | 0.0,ego,0,0,nan,1,0,4,2
  |             ^^^
",
        ),
        (
            "0.1,ego,0,0,0,1,0,4,2\n0.0,ego,0,0,0,1,0,4,2\n",
            "\
error: time goes backwards, from 0.1 to 0.0 s
 --> t.csv:3:1
  |
3 | 0.0,ego,0,0,0,1,0,4,2
  | ^^^ rows stand in the order of time
",
        ),
        (
            "0.0,ego,0,0,0,1,0,4,2\n0.0,ego,1,0,0,1,0,4,2\n",
            "\
error: `ego` is there twice at 0.0 s, first in line 2
 --> t.csv:3:5
  |
3 | 0.0,ego,1,0,0,1,0,4,2
  |     ^^^
",
        ),
        (
            "0.0,a,0,0,0,1,0,4,2\n0.0,b,9,0,0,1,0,4,2\n",
            "\
error: no row has the id of the ego, `ego`
 --> t.csv:1:8
  |
1 | time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m
  |        ^^ known: a, b
  |
  = help: name one with --ego, or take all with --all-egos
",
        ),
        (
            "0.0,ego,0,0\n",
            "\
error: a row has as many fields as there are columns, 9, got 4
 --> t.csv:2:12
  |
2 | 0.0,ego,0,0
  |            ^
",
        ),
        ("", "t.csv:1:1"),
    ] {
        let ran = refused(&format!("{HEADER}{rows}"), "");
        assert!(
            ran.err.starts_with(told) || !told.contains('\n') && ran.err.contains(told),
            "{}",
            ran.err
        );
    }
    let ran = refused(
        "time_s,id,x_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n0.0,ego,0,0,1,0,4,2\n",
        "",
    );
    assert!(
        ran.err
            .starts_with("error: the column `y_m` is missing\n --> t.csv:1:1\n"),
        "{}",
        ran.err
    );
}

#[test]
fn hand_a_bad_road_and_many_bad_rows() {
    let ran = refused(&trace(), "--road nope");
    assert!(
        ran.err
            .starts_with("error: unknown scenario `nope`\n --> --road:1:1\n"),
        "{}",
        ran.err
    );
    let rows: Vec<String> = (0..1000)
        .map(|time| format!("{time},ego,0,0,0,fast,0,4,2\n"))
        .collect();
    let ran = refused(&format!("{HEADER}{}", rows.concat()), "");
    assert_eq!(ran.err.matches("error: `speed_mps` must be").count(), 20);
    assert!(
        ran.err.contains("\n\nand 980 more like this\n"),
        "{}",
        ran.err
    );
}

#[test]
fn hand_everything_at_once() {
    let rows = "0.0,a,0,0,0,1,0,4,2\n0.0,a,0,0,zero,1,0,4,-2\n";
    let flags = "--fpr lefd=3 --solver exakt --criterion none --rig rig.ron --set actors.a.speed_mps=3 --set estimator.c1=2";
    let bench = Bench::new();
    bench.write("t.csv", &format!("{HEADER}{rows}"));
    bench.write(
        "rig.ron",
        &embedded::system().replace("c3_mps2: 4.9", "c3_mps2: NaN"),
    );
    let ran = bench.zhuyi(&format!("estimate t.csv --out o {flags}"));
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""));
    for told in [
        "no row has the id of the ego, `ego`",
        "t.csv:3:11",
        "t.csv:3:22",
        "`a` is there twice at 0.0 s, first in line 2",
        "unknown solver `exakt`",
        "^^^^^ known: exact, paper",
        "unknown criterion `none`",
        "known: paper, standstill",
        "rig.ron:",
        "got NaN",
        "a value of a scenario can be set only where --road names one",
    ] {
        assert!(ran.err.contains(told), "{told} is not in\n{}", ran.err);
    }
    assert_eq!(bench.names("."), ["rig.ron", "t.csv"]);
    // The name of a camera is looked up in the rig, once that can be read.
    let ran = bench.zhuyi("estimate t.csv --out o --fpr lefd=3");
    assert!(ran.err.contains("unknown camera `lefd`"), "{}", ran.err);
}

#[test]
fn hand_places_that_cannot_be_written_or_read() {
    let bench = Bench::new();
    bench.write("t.csv", &trace());
    bench.write("file", "mine");
    for (line, told) in [
        ("estimate t.csv --out file", "cannot write `file`: "),
        (
            "estimate t.csv --out file/deeper",
            "cannot write `file/deeper`: ",
        ),
        (
            "estimate missing.csv --out o",
            "cannot read `missing.csv`: ",
        ),
        (
            "estimate t.csv --rig missing.ron --out o",
            "cannot read `missing.ron`: ",
        ),
    ] {
        let ran = bench.zhuyi(line);
        assert_eq!(
            (ran.code, ran.out.as_str()),
            (Some(4), ""),
            "{line}\n{}",
            ran.err
        );
        assert!(ran.err.contains(told), "{line}\n{}", ran.err);
    }
    // Both files are tried before either is written.
    fs::create_dir_all(bench.path("o/cameras.csv")).unwrap();
    bench.write("o/actors.csv", "mine");
    assert_eq!(bench.zhuyi("estimate t.csv --out o").code, Some(4));
    assert_eq!(
        (bench.read("o/actors.csv"), bench.read("file")),
        ("mine".into(), "mine".into())
    );
    fs::write(bench.path("bytes.csv"), [0xff, 0xfe]).unwrap();
    let ran = bench.zhuyi("estimate bytes.csv --out new");
    assert_eq!(ran.code, Some(2), "{}", ran.err);
    assert_eq!(bench.names("."), ["bytes.csv", "file", "o", "t.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn hand_a_full_disk_leaves_both_files_as_they_were() {
    let bench = Bench::new();
    bench.write("t.csv", &trace());
    fs::create_dir(bench.path("o")).unwrap();
    bench.write("o/actors.csv", "mine");
    std::os::unix::fs::symlink("/dev/full", bench.path("o/cameras.csv")).unwrap();
    let ran = bench.zhuyi("estimate t.csv --out o");
    assert_eq!((ran.code, ran.out.as_str()), (Some(4), ""));
    assert!(
        ran.err
            .starts_with("error: cannot write `o/cameras.csv`: No space left"),
        "{}",
        ran.err
    );
    assert_eq!(bench.read("o/actors.csv"), "mine");
    assert_eq!(bench.names("o"), ["actors.csv", "cameras.csv"]);
}

/// A trace of the curve on a straight road: nobody would be in the ego's way there.
#[test]
fn hand_another_road_is_noted() {
    let bench = Bench::new();
    bench.out("run challenging-cut-in-curved --trace t.csv");
    let told = bench.out("estimate t.csv --road cut-in --out o");
    let note = "Note: the ego is beside the road of cut-in in ";
    assert!(told.contains(note), "{told}");
    let told = bench.out("estimate t.csv --road challenging-cut-in-curved --out o");
    assert!(!told.contains("Note:"), "{told}");
}
