//! `run --report` and `report`: the data in the page beside trace and table, its size, its bytes. The page at work is tested
//! in tests/browser.

use crate::Bench;
use serde_json::Value;
use zhuyi_scenario::embedded;

/// The document in a report.
pub fn data(page: &str) -> Value {
    let (_, behind) = page
        .split_once("<script type=\"application/json\" id=\"data\">")
        .unwrap();
    let (data, _) = behind.split_once("</script>").unwrap();
    serde_json::from_str(data).unwrap()
}

/// Words with how often each stands; none for `-`.
fn words(text: &str) -> Vec<(Option<f64>, usize)> {
    let word = |word: &str| {
        let (number, count) = word.split_once('*').unwrap_or((word, "1"));
        let number = (number != "-").then(|| number.parse().unwrap());
        (number, count.parse().unwrap())
    };
    text.split(' ').map(word).collect()
}

/// The numbers of a column of differences.
fn track(column: &Value) -> Vec<Option<f64>> {
    let (mut last, mut numbers) = (0.0, Vec::new());
    for (delta, count) in words(column["delta"].as_str().unwrap()) {
        for _ in 0..count {
            last = delta.map_or(0.0, |delta| last + delta);
            numbers.push(delta.map(|_| last / column["per"].as_f64().unwrap()));
        }
    }
    numbers
}

/// The numbers of a column of steps.
fn steps(column: &Value) -> Vec<Option<f64>> {
    let words = words(column.as_str().unwrap()).into_iter();
    words
        .flat_map(|(number, count)| vec![number; count])
        .collect()
}

#[test]
fn law_the_columns_of_a_report_are_the_trace_to_half_of_what_was_rounded() {
    let bench = Bench::new();
    // On a curve, so that no coordinate is idle.
    bench.out("run challenging-cut-in-curved --fpr 4 --report drive.html --trace drive.csv");
    let document = data(&bench.read("drive.html"));
    let trace = bench.read("drive.csv");
    let bodies = document["bodies"].as_array().unwrap();
    let rows = document["rows"].as_u64().unwrap() as usize;
    let lines: Vec<Vec<&str>> = trace
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(lines.len(), rows * bodies.len());
    let columns = [
        ("x_m", 2, 0.5e-3),
        ("y_m", 3, 0.5e-3),
        ("heading_rad", 4, 0.5e-5),
        ("speed_mps", 5, 0.5e-3),
        ("accel_mps2", 6, 0.5e-3),
    ];
    for (place, body) in bodies.iter().enumerate() {
        for (column, field, half) in columns {
            let numbers = track(&body[column]);
            assert_eq!(numbers.len(), rows);
            for (row, number) in numbers.iter().enumerate() {
                let fields = &lines[row * bodies.len() + place];
                assert_eq!(fields[1], body["name"].as_str().unwrap());
                let truth: f64 = fields[field].parse().unwrap();
                // The trace has six decimals of its own.
                let off = (number.unwrap() - truth).abs();
                assert!(off <= half + 1e-6, "{column} at {row}: {off}");
            }
        }
    }
}

#[test]
fn law_every_column_has_a_number_or_none_for_every_row() {
    let bench = Bench::new();
    bench.out("run cut-out-fast --policy demand-first --budget-fps 40 --report drive.html");
    let document = data(&bench.read("drive.html"));
    let rows = document["rows"].as_u64().unwrap() as usize;
    for camera in document["cameras"].as_array().unwrap() {
        for column in ["rate_fpr", "demand_fpr", "demand_actor", "online_fpr"] {
            assert_eq!(steps(&camera[column]).len(), rows, "{column}");
        }
        // Under a policy rates change, and stay within what there is.
        let rates = steps(&camera["rate_fpr"]);
        assert!(
            rates
                .iter()
                .flatten()
                .all(|rate| (0.1..=40.0).contains(rate))
        );
    }
    let front = steps(&document["cameras"][0]["rate_fpr"]);
    assert!(front.iter().any(|rate| *rate != front[0]));
    let models = document["models"].as_array().unwrap().len();
    for actor in document["actors"].as_array().unwrap() {
        for column in ["visible", "confirmed", "found"] {
            assert_eq!(steps(&actor[column]).len(), rows, "{column}");
        }
        for column in [
            "believed_x_m",
            "believed_y_m",
            "believed_speed_mps",
            "age_s",
            "gap_m",
            "ttc_s",
        ] {
            assert_eq!(track(&actor[column]).len(), rows, "{column}");
        }
        let latencies = actor["latency_s"].as_array().unwrap();
        assert_eq!(latencies.len(), models);
        assert!(latencies.iter().all(|column| steps(column).len() == rows));
        // Who is confirmed is believed to be somewhere, with an age.
        let age = track(&actor["age_s"]);
        let confirmed = steps(&actor["confirmed"]);
        assert!(
            confirmed
                .iter()
                .zip(&age)
                .all(|(confirmed, age)| *confirmed == Some(0.0) || age.is_some())
        );
    }
}

#[test]
fn law_the_highest_demand_of_a_column_is_the_one_of_the_summary() {
    let bench = Bench::new();
    bench.out("run cut-in --report drive.html");
    let document = data(&bench.read("drive.html"));
    let summary = document["summary"]["cameras"].as_array().unwrap();
    for (camera, told) in document["cameras"].as_array().unwrap().iter().zip(summary) {
        let demands = steps(&camera["demand_fpr"]);
        let highest = demands
            .iter()
            .flatten()
            .fold(0.0_f64, |most, fpr| fpr.max(most));
        let told = told["demand_fpr"].as_f64().unwrap();
        assert!((highest - told).abs() <= 0.5e-3, "{highest} and {told}");
    }
    assert!(document["explanation"].is_null());
}

#[test]
fn law_a_report_has_less_than_a_megabyte_and_the_same_bytes_again() {
    let bench = Bench::new();
    for name in embedded::names() {
        bench.out(&format!("run {name} --report {name}.html"));
        let page = bench.read(&format!("{name}.html"));
        assert!(page.len() < 1_000_000, "{name}: {}", page.len());
    }
    let first = bench.read("cut-in.html");
    bench.out("run cut-in --report cut-in.html");
    assert_eq!(bench.read("cut-in.html"), first);
}

#[test]
fn hand_a_report_that_cannot_be_written_is_refused_before_the_drive() {
    let ran = Bench::new().zhuyi("run cut-in --report nowhere/drive.html");
    assert_eq!(ran.code, Some(4));
    assert!(
        ran.err.contains("cannot write `nowhere/drive.html`"),
        "{}",
        ran.err
    );
}

#[test]
fn law_a_report_of_a_sweep_has_all_its_runs_and_replays_that_end_as_they_did() {
    let bench = Bench::new();
    bench.zhuyi("sweep cut-out-fast cut-in --fpr 4:6 --seeds 3 --out out");
    let told = bench.out("report out -o sweep.html");
    assert!(
        told.starts_with("18 runs of 2 scenarios, 3 replays\n"),
        "{told}"
    );
    let document = data(&bench.read("sweep.html"));
    let rows = bench.read("out/runs.csv");
    let collided = |scenario: &str, fpr: u64| {
        let start = format!("{scenario},sweep,{fpr},");
        let rows = rows.lines().filter(|line| line.starts_with(&start));
        rows.filter(|line| line.contains(",collision,")).count() as u64
    };
    let mrf: Value = serde_json::from_str("[\"6\", \"<=4\"]").unwrap();
    for (place, scenario) in document["scenarios"].as_array().unwrap().iter().enumerate() {
        assert_eq!(scenario["mrf"], mrf[place]);
        for rate in scenario["rates"].as_array().unwrap() {
            let (name, fpr) = (
                scenario["name"].as_str().unwrap(),
                rate["fpr"].as_u64().unwrap(),
            );
            assert_eq!(
                rate["collided"].as_u64().unwrap(),
                collided(name, fpr),
                "{name} {fpr}"
            );
            assert_eq!(rate["cells"].as_array().unwrap().len(), 3);
        }
    }
    for drive in document["drives"].as_array().unwrap() {
        assert!(drive["note"].is_null(), "{}", drive["note"]);
        let summary = &drive["document"]["summary"];
        let hit = drive["told"].as_str().unwrap().starts_with("touched");
        assert_eq!(summary["collision"].is_null(), !hit);
        assert_eq!(summary["seed"], drive["seed"]);
        // Why it crashed is told where it did.
        assert_eq!(drive["document"]["explanation"].is_null(), !hit);
    }
}

/// A table of one run with a command.
fn table(outcome: &str, command: &str) -> String {
    format!(
        "scenario,part,fpr_hz,seed,outcome,collision_time_s,collision_actor,impact_speed_mps,smallest_gap_m,smallest_ttc_s,\
         largest_estimate_fpr,replay\ncut-in,sweep,30,0,{outcome},2.5,,,\"{command}\"\n"
    )
}

#[test]
fn hand_a_table_starts_no_program_and_nothing_but_drives() {
    let bench = Bench::new();
    for (command, note) in [
        (
            "zhuyi run cut-in --policy 'exec:touch here' --budget-fps 30",
            "no replay: its command would start a program",
        ),
        (
            "zhuyi sweep cut-in --out here",
            "no replay: its command is no zhuyi run",
        ),
        ("rm -r here", "no replay: its command is none of zhuyi"),
        (
            "zhuyi run 'cut-in",
            "no replay: a quote in its command is open",
        ),
    ] {
        bench.write("runs.csv", &table("completed,,,", command));
        let told = bench.out("report . -o report.html");
        assert!(
            told.contains("1 runs of 1 scenarios, 0 replays\n") && told.contains(note),
            "{told}"
        );
        assert!(!bench.path("here").exists(), "{command}");
        let document = data(&bench.read("report.html"));
        assert!(document["drives"][0]["document"].is_null());
    }
    // A trace that a command would write is not written.
    bench.write(
        "runs.csv",
        &table("completed,,,", "zhuyi run cut-in --trace here"),
    );
    assert!(bench.out("report . -o report.html").contains("1 replays"));
    assert!(!bench.path("here").exists());
}

#[test]
fn hand_a_run_that_ends_otherwise_than_its_table_says_so() {
    let bench = Bench::new();
    bench.write(
        "runs.csv",
        &table("collision,5.0,cutter,2.0", "zhuyi run cut-in"),
    );
    let told = bench.out("report . -o report.html");
    assert!(
        told.contains("driven again it ends otherwise than the table tells"),
        "{told}"
    );
}

#[test]
fn hand_what_is_no_table_of_runs_is_refused() {
    let bench = Bench::new();
    let ran = bench.zhuyi("report nowhere -o report.html");
    assert_eq!(ran.code, Some(4));
    assert!(ran.err.contains("cannot read `nowhere`"), "{}", ran.err);
    bench.write("runs.csv", "scenario,part\ncut-in,sweep\n");
    let ran = bench.zhuyi("report . -o report.html");
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("it has no column `fpr_hz`"), "{}", ran.err);
    assert!(!bench.path("report.html").exists());
}

#[test]
fn law_the_report_of_a_trace_tells_what_that_of_its_drive_does() {
    let bench = Bench::new();
    bench.out("run cut-in --fpr 4 --report drive.html --trace drive.csv");
    let told = bench.out("report drive.csv --road cut-in --fpr 4 -o trace.html");
    assert_eq!(
        told,
        "3000 steps of `ego`, 1 of 1 other vehicles\nWrote trace.html\n"
    );
    let (drive, trace) = (
        data(&bench.read("drive.html")),
        data(&bench.read("trace.html")),
    );
    assert_eq!(drive["rows"], trace["rows"]);
    assert_eq!(
        (&drive["believes"], &trace["believes"]),
        (&true.into(), &false.into())
    );
    let times = track(&trace["times_s"]);
    assert!(
        times
            .iter()
            .enumerate()
            .all(|(row, time)| (time.unwrap() - row as f64 / 100.0).abs() < 1e-9)
    );
    // Where everyone was is the same to the millimetre, rounded twice.
    for (one, other) in drive["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .zip(trace["bodies"].as_array().unwrap())
    {
        assert_eq!(one["name"], other["name"]);
        for column in ["x_m", "y_m", "speed_mps"] {
            let (one, other) = (track(&one[column]), track(&other[column]));
            let off =
                |(one, other): (&Option<f64>, &Option<f64>)| (one.unwrap() - other.unwrap()).abs();
            assert!(
                one.iter().zip(&other).map(off).all(|off| off < 1.1e-3),
                "{column}"
            );
        }
    }
    let sight = |of: &Value| steps(&of["actors"][0]["visible"]);
    assert_eq!(sight(&drive), sight(&trace));
    // The six decimals of a trace may move an answer by a step of the grid now and then, not more.
    let demands = |of: &Value| steps(&of["cameras"][0]["demand_fpr"]);
    let (one, other) = (demands(&drive), demands(&trace));
    let same = one
        .iter()
        .zip(&other)
        .filter(|(one, other)| one == other)
        .count();
    assert!(same * 100 >= 99 * one.len(), "{same} of {}", one.len());
}

#[test]
fn hand_what_cannot_be_a_trace_is_refused() {
    let bench = Bench::new();
    bench.write("drive.csv", "time_s,id\n0,ego\n");
    let ran = bench.zhuyi("report drive.csv -o report.html");
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("x_m"), "{}", ran.err);
    bench.out("run cut-in --set duration_s=1 --trace drive.csv");
    for (line, told) in [
        (
            "report drive.csv --ego nobody -o report.html",
            "no row has the id of the ego, `nobody`",
        ),
        (
            "report drive.csv --set ego.lane=1 -o report.html",
            "only where --road names one",
        ),
        (
            "report drive.csv --road cut-ni -o report.html",
            "did you mean `cut-in`?",
        ),
    ] {
        let ran = bench.zhuyi(line);
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{line}");
        assert!(ran.err.contains(told), "{line}: {}", ran.err);
    }
    bench.write("runs.csv", &table("completed,,,", "zhuyi run cut-in"));
    let ran = bench.zhuyi("report . --fpr 4 -o report.html");
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.err
            .contains("--fpr is for traces, and this is a table of runs"),
        "{}",
        ran.err
    );
    assert!(!bench.path("report.html").exists());
}
