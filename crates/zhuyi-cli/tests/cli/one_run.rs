//! `run`: text, JSON, trace, rates, settings.

use crate::Bench;
use serde_json::Value;
use zhuyi_scenario::embedded;

fn json(bench: &Bench, line: &str) -> Value {
    serde_json::from_str(&bench.out(&format!("run {line} --json"))).unwrap()
}

/// The rate of every camera, in the order of the rig.
fn rates(bench: &Bench, fpr: &str) -> Vec<(String, f64)> {
    let document = json(bench, &format!("cut-in --set duration_s=1 --fpr {fpr}"));
    let cameras = document["cameras"].as_array().unwrap().iter();
    cameras
        .map(|camera| {
            (
                camera["name"].as_str().unwrap().to_string(),
                camera["rate_fpr"].as_f64().unwrap(),
            )
        })
        .collect()
}

#[test]
fn hand_the_summary_of_a_drive_without_collision() {
    let out = Bench::new().out("run front-right-activity-3");
    for told in [
        "front-right-activity-3, seed 0: ",
        "\nNo collision in ",
        "\n  smallest gap ",
        "\n  smallest TTC ",
        "\n  hardest braking ",
        "\n front_120*   30 FPR",
        "\n rear ",
        "* analysed: at most ",
        "\nDemand on each camera over time:\n front_120  ▁",
        " FPR; a column shows the highest demand within it\n",
        " from above, driving to the right; ",
        "\n  zhuyi run front-right-activity-3 --trace front-right-activity-3.csv ",
        "\n  zhuyi mrf front-right-activity-3 ",
    ] {
        assert!(out.contains(told), "{told} is not in\n{out}");
    }
    assert!(
        !out.contains("COLLISION") && !out.contains("up to the contact"),
        "{out}"
    );
}

#[test]
fn hand_the_summary_of_a_collision() {
    // An ego that hardly brakes runs into the standing obstacle, front first.
    let line = "cut-out-fast --set vehicle.friction=0.1 --fpr 2 --seed 3";
    let bench = Bench::new();
    let out = bench.out(&format!("run {line}"));
    for told in [
        "\nCOLLISION at ",
        ": the ego's front touched `obstacle`.\n",
        "\n  impact speed ",
        "\n  ego                delta-v ",
        "\n  obstacle           delta-v ",
        ", estimated up to the contact.\n",
        "\n  zhuyi run cut-out-fast --fpr 30 --seed 3 --set vehicle.friction=0.1 ",
    ] {
        assert!(out.contains(told), "{told} is not in\n{out}");
    }
    let document = json(&bench, line);
    let collision = &document["collision"];
    assert_eq!(
        (collision["actor"].as_str(), collision["side"].as_str()),
        (Some("obstacle"), Some("front"))
    );
    assert_eq!(document["end_s"], collision["time_s"]);
    assert_eq!(document["estimate"]["until_contact"], Value::Bool(true));
    let crash = &collision["crash"];
    assert!(crash["impact_speed_mps"].as_f64().unwrap() > 5.0, "{crash}");
    // The lighter obstacle is pushed on along the road, and by more than the ego is slowed.
    assert!(
        crash["other"]["delta_v_mps"].as_f64() > crash["ego"]["delta_v_mps"].as_f64(),
        "{crash}"
    );
    assert!(
        crash["other"]["s_m"].as_f64() > crash["ego"]["s_m"].as_f64(),
        "{crash}"
    );
}

#[test]
fn regress_the_names_of_the_document() {
    let document = json(&Bench::new(), "cut-in");
    let names = |value: &Value| {
        value
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<Vec<_>>()
            .join(" ")
    };
    // serde_json sorts the names of a document that is read.
    assert_eq!(
        names(&document),
        "alarms bytes_avoided cameras collision command end_s estimate evading_from_s frames_processed hard_braking_from_s hardest_braking_mps2 manoeuvres notes \
         root_seed scenario seed share_of_30_fpr smallest_gap_m smallest_ttc_s title version"
    );
    assert_eq!(
        names(&document["estimate"]),
        "alongside beyond_grid largest_fpr largest_sum_fpr standing unavoidable until_contact"
    );
    assert_eq!(
        names(&document["cameras"][0]),
        "analysed demand_actor demand_fpr demand_time_s frames_dropped frames_exposed frames_processed name rate_fpr \
         share_of_30_fpr transfers_avoided"
    );
    assert_eq!(document["collision"], Value::Null);
    assert_eq!(document["command"], "zhuyi run cut-in");
}

#[test]
fn law_the_same_command_gives_the_same_bytes_and_another_seed_does_not() {
    let bench = Bench::new();
    let line = "run cut-out --fpr 4 --seed 7";
    let first = (
        bench.out(&format!("{line} --trace a.csv --json")),
        bench.read("a.csv"),
    );
    let second = (
        bench.out(&format!("{line} --trace b.csv --json")),
        bench.read("b.csv"),
    );
    assert!(first == second, "two runs of {line} differ");
    bench.out("run cut-out --fpr 4 --seed 8 --trace c.csv");
    bench.out("run cut-out --fpr 4 --seed 7 --root-seed 1 --trace d.csv");
    assert!(first.1 != bench.read("c.csv") && first.1 != bench.read("d.csv"));
}

#[test]
fn law_the_command_in_the_document_makes_the_same_document() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("sub")).unwrap();
    bench.write("sub/mine.ron", embedded::scenario("cut-in").unwrap());
    let first = json(
        &bench,
        "sub/mine.ron --fpr front=6.5,left=2 --seed 4 --root-seed 2 --set planner.min_gap_m=2.5",
    );
    let command = first["command"].as_str().unwrap();
    let again = json(&bench, command.strip_prefix("zhuyi run ").unwrap());
    assert_eq!(first, again);
}

#[test]
fn hand_a_setting_changes_the_outcome() {
    let bench = Bench::new();
    assert_eq!(json(&bench, "vehicle-following")["collision"], Value::Null);
    // The lead is there at once, ten metres ahead, and stands.
    let near = "--set actors.lead.start=Ahead(gap_m:10) --set actors.lead.speed_mps=0";
    let mut command = bench.command("run vehicle-following --json");
    command.args([
        "--set",
        "actors.lead.start=Ahead(gap_m: 10)",
        "--set",
        "actors.lead.speed_mps=0",
    ]);
    let document: Value = serde_json::from_str(&crate::run(&mut command).out).unwrap();
    assert_eq!(document["collision"]["actor"], "lead");
    assert_eq!(
        document["command"],
        "zhuyi run vehicle-following --set 'actors.lead.start=Ahead(gap_m: 10)' --set actors.lead.speed_mps=0"
    );
    assert_eq!(
        json(&bench, &format!("vehicle-following {near}"))["collision"],
        document["collision"]
    );
}

#[test]
fn hand_rates_by_name() {
    let bench = Bench::new();
    let by_name = |rates: [f64; 5]| -> Vec<(String, f64)> {
        ["front_120", "front_60", "left", "right", "rear"]
            .map(String::from)
            .into_iter()
            .zip(rates)
            .collect()
    };
    assert_eq!(rates(&bench, "12.5"), by_name([12.5; 5]));
    assert_eq!(
        rates(&bench, "front=10,left=5"),
        by_name([10.0, 10.0, 5.0, 30.0, 30.0])
    );
    // The longer name decides, in any order.
    assert_eq!(
        rates(&bench, "front_60=3,front=10"),
        by_name([10.0, 3.0, 30.0, 30.0, 30.0])
    );
    assert_eq!(
        rates(&bench, "front=10,front_60=3"),
        by_name([10.0, 3.0, 30.0, 30.0, 30.0])
    );
    // What is not named keeps the system's rate.
    let document = json(
        &bench,
        "cut-in --fpr left=5 --set perception.cameras.rear.rate_hz=8",
    );
    assert_eq!(document["cameras"][4]["rate_fpr"], 8.0);
}

#[test]
fn law_frames_are_counted_against_thirty_per_second() {
    let document = json(
        &Bench::new(),
        "vehicle-following --set duration_s=10 --fpr front=30,left=3,right=10",
    );
    for camera in document["cameras"].as_array().unwrap() {
        let (rate, share) = (
            camera["rate_fpr"].as_f64().unwrap(),
            camera["share_of_30_fpr"].as_f64().unwrap(),
        );
        // 10 s: of the frames taken, at most two are still on their way.
        assert!((share - rate / 30.0).abs() <= 2.0 / 300.0, "{camera}");
    }
}

#[test]
fn law_a_trace_has_one_row_per_time_and_vehicle() {
    let bench = Bench::new();
    bench.out("run cut-in --trace t.csv --set duration_s=3");
    let trace = bench.read("t.csv");
    let mut lines = trace.lines();
    let header = lines.next().unwrap();
    assert_eq!(
        header,
        "time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m,s_m,d_m,lane"
    );
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 300 * 2);
    assert!(rows.iter().all(|row| row.len() == 12));
    assert_eq!(
        (rows[0][0], rows[0][1], rows[1][1]),
        ("0.000000", "ego", "cutter")
    );
    assert_eq!((rows[598][0], rows[599][1]), ("2.990000", "cutter"));
    // 70 mph in lane 2.
    assert_eq!((rows[0][5], rows[0][11]), ("31.292800", "2"));
}

#[test]
fn law_text_and_document_agree_on_braking_and_evasion() {
    let bench = Bench::new();
    let text = embedded::scenario("cut-out-fast").unwrap();
    let beside = |line: &&str| line.contains("\"left\"") || line.contains("\"right\"");
    let alone: Vec<&str> = text.lines().filter(|line| !beside(line)).collect();
    bench.write("alone.ron", &alone.join("\n"));
    let mut braked = 0;
    for line in [
        "cut-out-fast",
        "alone.ron --fpr 3",
        "alone.ron --fpr 1",
        "front-right-activity-1",
    ] {
        let (document, text) = (json(&bench, line), bench.out(&format!("run {line}")));
        let brakes = !document["hard_braking_from_s"].is_null();
        assert_eq!(brakes, text.contains("braking hard from"), "{text}");
        assert_eq!(
            !document["evading_from_s"].is_null(),
            text.contains("\n  evasion "),
            "{text}"
        );
        braked += u32::from(brakes);
    }
    assert!((1..4).contains(&braked), "both cases are to be seen");
}

#[test]
fn hand_the_estimate_in_the_loop_beside_the_one_in_hindsight() {
    let bench = Bench::new();
    bench.out("run cut-in --set duration_s=2 --online online.csv");
    let text = bench.read("online.csv");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "time_s,camera,rate_fps,online_fps,online_actor,offline_fps,offline_actor,granted_fps,alarm"
    );
    // Five cameras, every 100 ms.
    assert_eq!(lines.len(), 1 + 5 * 20);
    assert!(
        lines[1].starts_with("0.000000,front_120,30.000000,"),
        "{}",
        lines[1]
    );
    assert!(
        lines[100].starts_with("1.900000,rear,30.000000,"),
        "{}",
        lines[100]
    );
}

/// 10.392 TOPS at 519.6 GOP a frame are 20 frames a second. All cameras at 30 ask for 150: in 4 s of 600 pictures most are
/// dropped before they are transferred, and 80 are processed, less what is under work.
#[test]
fn hand_an_accelerator_takes_what_it_can() {
    let bench = Bench::new();
    let shared = json(
        &bench,
        "cut-in --set duration_s=4 --policy edf --budget-tops 10.392",
    );
    let sum = |document: &Value, what: &str| -> u64 {
        let cameras = document["cameras"].as_array().unwrap().iter();
        cameras.map(|camera| camera[what].as_u64().unwrap()).sum()
    };
    assert!((70..=80).contains(&sum(&shared, "frames_processed")));
    assert_eq!(shared["alarms"]["checks"], 40);
    let flooded = json(
        &bench,
        "cut-in --set duration_s=4 --set compute=Accelerator(tops:10.392)",
    );
    let (exposed, dropped) = (
        sum(&flooded, "frames_exposed"),
        sum(&flooded, "frames_dropped"),
    );
    assert!((598..=602).contains(&exposed) && (515..=525).contains(&dropped));
    let avoided = sum(&flooded, "transfers_avoided");
    assert_eq!(
        avoided * 4_320_000,
        flooded["bytes_avoided"].as_u64().unwrap()
    );
    assert_eq!(flooded["alarms"], Value::Null);
}

#[test]
fn hand_a_policy_shares_a_budget() {
    let bench = Bench::new();
    let document = json(
        &bench,
        "cut-in --set duration_s=4 --policy demand-first --budget-fps 20",
    );
    // Four seconds of twenty frames, and one more per camera at the ends.
    let frames = document["frames_processed"].as_u64().unwrap();
    assert!((60..=85).contains(&frames), "{frames}");
    assert_eq!(document["cameras"][0]["rate_fpr"], 4.0);
    assert!(
        document["command"]
            .as_str()
            .unwrap()
            .ends_with("--set duration_s=4")
            || document["command"]
                .as_str()
                .unwrap()
                .contains("--policy demand-first --budget-fps 20")
    );
    for policy in [
        "uniform",
        "clairvoyant",
        "static:front=5,left=2,right=2,rear=2",
    ] {
        bench.out(&format!(
            "run cut-in --set duration_s=1 --policy {policy} --budget-fps 20"
        ));
    }
}

#[test]
fn hand_policies_that_cannot_be_meant_and_programs_that_fail() {
    let bench = Bench::new();
    for (line, told) in [
        (
            "run cut-in --policy fair --budget-fps 20",
            "there is no policy `fair`",
        ),
        (
            "run cut-in --policy uniform --budget-fps 0",
            "a budget must be 0.1 to 10000, got 0",
        ),
        (
            "run cut-in --policy uniform --budget-fps x",
            "expected a number, got `x`",
        ),
        ("run cut-in --policy uniform", "--budget-fps"),
        ("run cut-in --budget-fps 20", "--policy"),
        (
            "run cut-in --policy uniform --budget-fps 20 --fpr 5",
            "--fpr",
        ),
    ] {
        let ran = bench.zhuyi(line);
        assert_eq!(
            (ran.code, ran.out.as_str()),
            (Some(2), ""),
            "{line}\n{}",
            ran.err
        );
        assert!(ran.err.contains(told), "{line}\n{}", ran.err);
    }
    let ran = bench.zhuyi("run cut-in --policy exec:false --budget-fps 20 --trace t.csv");
    assert_eq!((ran.code, ran.out.as_str()), (Some(4), ""), "{}", ran.err);
    assert!(
        ran.err.starts_with("error: the policy failed: "),
        "{}",
        ran.err
    );
    assert_eq!(bench.names("."), Vec::<String>::new());
}

/// Lost frames are told as dropped, and were never sent to an accelerator; jitter makes frames late, not fewer.
#[test]
fn law_lost_frames_are_counted_as_dropped() {
    let bench = Bench::new();
    let front = |settings: &str| {
        let document = json(&bench, &format!("cut-in --set duration_s=4 {settings}"));
        let camera = &document["cameras"][0];
        ["exposed", "processed", "dropped"]
            .map(|what| camera[format!("frames_{what}")].as_u64().unwrap())
    };
    let [exposed, processed, dropped] = front("");
    assert!(dropped == 0 && exposed - processed <= 2);
    let [same, fewer, dropped] = front("--set perception.drop_rate=0.25");
    assert!(same == exposed && exposed - fewer - dropped <= 2);
    assert!((15..=45).contains(&dropped), "{dropped} of {exposed}");
    let [same, all, dropped] = front("--set perception.latency_jitter_ms=30");
    assert!(same == exposed && exposed - all <= 3 && dropped == 0);
}
