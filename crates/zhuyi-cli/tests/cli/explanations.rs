//! `explain`: stages in order, metres that add up, changes that save the drive when they are typed.

use crate::Bench;
use serde_json::Value;

fn json(bench: &Bench, line: &str) -> Value {
    serde_json::from_str(&bench.out(&format!("{line} --json"))).unwrap()
}

/// Takes a line apart as a shell does that knows of single quotes alone.
fn shell_words(line: &str) -> Vec<String> {
    let parts = line.split('\'').enumerate();
    let mut words = Vec::new();
    for (place, part) in parts {
        if place % 2 == 1 {
            words.push(part.to_string());
        } else {
            words.extend(part.split_whitespace().map(String::from));
        }
    }
    words
}

/// Whether a command `zhuyi ..`, as told, collides.
fn collides(bench: &Bench, command: &str) -> bool {
    let words = shell_words(command);
    assert_eq!(words[0], "zhuyi");
    let mut zhuyi = bench.command("");
    let ran = zhuyi.args(&words[1..]).arg("--json").output().unwrap();
    let error = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "{command}: {error}");
    let summary: Value = serde_json::from_slice(&ran.stdout).unwrap();
    !summary["collision"].is_null()
}

#[test]
fn law_what_would_have_saved_a_drive_saves_it_when_typed() {
    let bench = Bench::new();
    let lines = [
        "cut-out-fast --fpr 5 --seed 1",
        "cut-out --fpr front=1,left=2 --seed 1",
        "challenging-cut-in --fpr 1 --seed 3 --set planner.time_headway_s=1",
        "cut-out-fast --policy uniform --budget-fps 25 --seed 1",
    ];
    for line in lines {
        assert!(collides(&bench, &format!("zhuyi run {line}")), "{line}");
        let explained = json(&bench, &format!("explain {line}"));
        let changes = explained["changes"].as_array().unwrap();
        let mut smallest = f64::INFINITY;
        for change in changes {
            let Some(to) = change["to"].as_f64() else {
                assert!(change["command"].is_null(), "{change}");
                continue;
            };
            let command = change["command"].as_str().unwrap();
            assert!(!collides(&bench, command), "{command}");
            let from = change["from"].as_f64().unwrap();
            let relative = change["relative"].as_f64().unwrap();
            assert!((relative - (to - from) / from).abs() < 1e-12, "{change}");
            smallest = smallest.min(relative.abs());
        }
        let best: Vec<&Value> = changes
            .iter()
            .filter(|change| change["best"] == true)
            .collect();
        assert_eq!(best.len(), 1, "{line}");
        assert_eq!(best[0]["relative"].as_f64().unwrap().abs(), smallest);
    }
}

#[test]
fn law_one_step_less_of_a_change_does_not_save_the_drive() {
    let bench = Bench::new();
    let explained = json(&bench, "explain cut-out --fpr 1 --seed 1");
    let changes = explained["changes"].as_array().unwrap();
    let to = |what: &str| {
        let change = changes
            .iter()
            .find(|change| change["what"] == what)
            .unwrap();
        change["to"].as_f64().unwrap()
    };
    // Less by one step is 45 + 5 % of the period of 1 s, and 5 % of the headway of 1.02 s.
    let latency = (10.0 * (to("the latency of all cameras") + 5.0)).round();
    let settings: Vec<String> = ["front_120", "front_60", "left", "right", "rear"]
        .iter()
        .map(|name| {
            format!(" --set 'perception.cameras.{name}.latency=Fixed(latency_ms: {latency})'")
        })
        .collect();
    assert!(collides(
        &bench,
        &format!("zhuyi run cut-out --fpr 1 --seed 1{}", settings.concat())
    ));
    let headway = to("the planner's time headway") - 0.05 * 1.02;
    let line =
        format!("zhuyi run cut-out --fpr 1 --seed 1 --set planner.time_headway_s={headway:.3}");
    assert!(collides(&bench, &line), "{line}");
}

#[test]
fn hand_the_stages_of_the_cut_out_at_five_frames_per_second() {
    let bench = Bench::new();
    let explained = json(&bench, "explain cut-out-fast --fpr 5 --seed 1");
    let waterfall = &explained["waterfall"];
    assert_eq!(waterfall["cause"], "came_into_sight");
    assert_eq!(waterfall["actor"], "obstacle");
    assert!(waterfall["evading_from_s"].is_null());
    let stages = waterfall["stages"].as_array().unwrap();
    let names: Vec<&str> = stages
        .iter()
        .map(|stage| stage["stage"].as_str().unwrap())
        .collect();
    let wanted = [
        "exposed",
        "captured",
        "processed",
        "confirmed",
        "planned",
        "brake_on",
        "contact",
    ];
    assert_eq!(names, wanted);
    let took = |stage: usize| stages[stage]["took_s"].as_f64().unwrap();
    // A period of 200 ms and what is left of a step; four more frames.
    assert!((0.2..0.21).contains(&took(2)), "{}", took(2));
    assert!((took(3) - 0.8).abs() < 1e-9, "{}", took(3));
    // The obstacle stands: what the ego drove is the gap that it had when the obstacle came into sight.
    let metres: f64 = stages
        .iter()
        .map(|stage| stage["metres_m"].as_f64().unwrap())
        .sum();
    assert!((metres - waterfall["metres_m"].as_f64().unwrap()).abs() < 1e-9);
    assert!(
        (metres - waterfall["gap_m"].as_f64().unwrap()).abs() < 0.05,
        "{waterfall}"
    );
    let text = bench.out("explain cut-out-fast --fpr 5 --seed 1");
    for told in [
        "cut-out-fast, seed 1: COLLISION at ",
        "`obstacle` came into sight at ",
        " confirmed ",
        "frames in a row ",
        "What would have saved it, one thing changed at a time",
        " the rate of left               5 FPR   none up to 30 FPR ",
        "* the smallest in relation to what it was:\n  zhuyi run cut-out-fast --fpr 5 --seed 1 ",
    ] {
        assert!(text.contains(told), "{told} is not in\n{text}");
    }
}

#[test]
fn law_an_evasion_that_failed_is_told_with_the_time_of_the_run() {
    let bench = Bench::new();
    let line = "challenging-cut-in --fpr 1 --seed 2";
    let run = json(&bench, &format!("run {line}"));
    let explained = json(&bench, &format!("explain {line}"));
    let from = &explained["waterfall"]["evading_from_s"];
    assert!(from.is_f64() && *from == run["evading_from_s"], "{from}");
    let told = explained["told"].as_str().unwrap();
    assert!(
        told.contains("became dangerous") && told.contains("left its lane to evade"),
        "{told}"
    );
    // What was decided on is one thing, how it was carried out another: braking gave way to the evasion.
    assert_eq!(explained["waterfall"]["stages"][5]["time_s"], Value::Null);
    assert_eq!(
        explained["waterfall"]["stages"][4]["time_s"],
        run["hard_braking_from_s"]
    );
}

#[test]
fn hand_without_a_collision_there_is_nothing_to_explain_but_how_close_it_was() {
    let bench = Bench::new();
    let text = bench.out("explain cut-in");
    assert!(text.starts_with("cut-in, seed 0: no collision, so there is nothing to explain.\nHow close it was: smallest gap "), "{text}");
    let explained = json(&bench, "explain cut-in");
    assert!(explained["collision"].is_null() && explained["waterfall"].is_null());
    assert_eq!(explained["changes"].as_array().unwrap().len(), 0);
    assert!(explained["smallest_gap_m"].as_f64().unwrap() > 0.0);
}

#[test]
fn hand_what_cannot_be_meant_is_refused() {
    for (line, told) in [
        ("explain cut-ni", "did you mean `cut-in`?"),
        ("explain cut-in --fpr middle=5", "middle"),
        ("explain cut-in --seed -1", "--seed"),
        ("explain cut-in --policy nobody --budget-fps 30", "nobody"),
    ] {
        let ran = Bench::new().zhuyi(line);
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{line}");
        assert!(ran.err.contains(told), "{line}: {}", ran.err);
    }
}
