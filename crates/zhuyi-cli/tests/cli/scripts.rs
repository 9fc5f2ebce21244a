//! What a script's manoeuvres came to, and what else a run has to say of its actors.

use super::Bench;
use serde_json::Value;
use std::path::Path;

/// A car that cuts in at 1 s and brakes when the ego is 3 m behind it, which never happens; behind it one that turns back half-way.
const NEVER: &str =
    "(title: \"never\", road: (lanes: 3, lane_width_m: 3.5, segments: [Line(length_m: 3000)]),
 ego: (lane: 2, s_m: 100, speed_mps: 20), duration_s: 10, actors: [
 (name: \"cutter\", lane: 1, start: Ahead(gap_m: 60), speed_mps: 25, manoeuvres: [
  (when: Time(at_s: 1), then: ChangeLane(lane: 2, duration_s: 3)),
  (when: GapToEgo(gap_m: 3), then: Brake(decel_mps2: 3))]),
 (name: \"back\", lane: 3, start: Ahead(gap_m: 90), speed_mps: 25, manoeuvres: [
  (when: Time(at_s: 2), then: ChangeLane(lane: 2, duration_s: 4)),
  (when: Time(at_s: 4), then: ChangeLane(lane: 3, duration_s: 4)),
  (when: Time(at_s: 9), then: ReachSpeed(speed_mps: 30, accel_mps2: 1))])])";
/// The same in the column of a table.
const TOLD: &str = "cutter.1 ChangeLane 1.00-4.00; cutter.2 Brake never; back.1 ChangeLane 2.00-4.00 replaced; \
                    back.2 ChangeLane 4.00-8.00; back.3 ReachSpeed 9.00-";
const NOTE: &str = "`never`: began in no drive: cutter.2 Brake";
/// A follower that runs into the ego.
const REAR_END: &str =
    "(title: \"rear\", road: (lanes: 1, lane_width_m: 3.5, segments: [Line(length_m: 3000)]),
 ego: (lane: 1, s_m: 300, speed_mps: 15), duration_s: 20, actors: [
 (name: \"fast\", lane: 1, start: Behind(gap_m: 30), speed_mps: 20)])";

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// The field of a column in each row of a table.
fn column(table: &str, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let place = reader.headers().unwrap().iter().position(|one| one == name);
    let place = place.unwrap();
    let records = reader.records();
    records.map(|row| row.unwrap()[place].to_string()).collect()
}

#[test]
fn hand_a_run_says_when_each_manoeuvre_began_and_ended() {
    let bench = Bench::new();
    bench.write("never.ron", NEVER);
    let text = bench.out("run never.ron");
    for line in [
        "  cutter.1           ChangeLane  1.00 to 4.00 s\n",
        "  cutter.2           Brake       never began\n",
        "  back.1             ChangeLane  2.00 to 4.00 s, replaced\n",
        "  back.2             ChangeLane  4.00 to 8.00 s\n",
        "  back.3             ReachSpeed  from 9.00 s, not ended\n",
    ] {
        assert!(text.contains(line), "{line}{text}");
    }
    let document = json(&bench.out("run never.ron --json --report drive.html"));
    let of = &document["manoeuvres"];
    assert_eq!(of.as_array().unwrap().len(), 5);
    let expected = serde_json::json!({
        "actor": "back", "place": 1, "action": "ChangeLane", "began_s": 2.0, "ended_s": 4.0, "replaced": true
    });
    assert_eq!(of[2], expected);
    assert_eq!(
        (&of[1]["began_s"], &of[4]["ended_s"]),
        (&Value::Null, &Value::Null)
    );
    assert!(bench.read("drive.html").contains("\"began_s\":2.0"));
}

#[test]
fn regress_a_manoeuvre_that_never_begins_is_told() {
    let bench = Bench::new();
    bench.write("never.ron", NEVER);
    let text = bench.out("mrf never.ron --fpr 5,30 --seeds 2");
    assert!(text.contains(&format!("\n{NOTE}\n")), "{text}");
    let ran = bench.zhuyi("mrf never.ron --fpr 5,30 --seeds 2 --json");
    assert_eq!((ran.code, ran.err), (Some(0), format!("note: {NOTE}\n")));
    assert_eq!(
        json(&ran.out)["scenarios"][0]["never_began"][0],
        "cutter.2 Brake"
    );

    let text = bench.out("sweep never.ron --fpr 5,30 --seeds 2 --out out");
    assert!(text.contains(&format!("\n{NOTE}\n")), "{text}");
    assert_eq!(column(&bench.read("out/runs.csv"), "manoeuvres"), [TOLD; 4]);
    // Told again from the table.
    assert_eq!(
        bench.out("sweep never.ron --fpr 5,30 --seeds 2 --out out --resume"),
        text
    );

    let line = "map never.ron --vary perception.confirm_frames=3:4 --fpr 5,30 --seeds 1";
    let text = bench.out(line);
    assert!(text.contains(NOTE), "{text}");
    // Where all begin nothing is told.
    let text = bench.out("mrf cut-in --fpr 30 --seeds 1");
    assert!(!text.contains("began"), "{text}");
}

#[test]
fn regress_contacts_from_behind_are_told_apart() {
    let bench = Bench::new();
    bench.write("rear.ron", REAR_END);
    let told = bench.out("mrf rear.ron --fpr 1,30 --seeds 2");
    let line = "rear at 30 FPR: 2 struck from behind; more frames cannot help; MRF without contacts from behind: 1\n";
    assert!(told.contains(line), "{told}");
    // The default counts any contact, as the paper does.
    assert!(told.contains(">30"), "{told}");
    let document = json(&bench.out("mrf rear.ron --fpr 1,30 --seeds 2 --json"));
    let of = &document["scenarios"][0];
    assert_eq!(of["mrf"], ">30");
    assert_eq!(of["mrf_without_struck_from_behind"], "1");
    assert_eq!(of["more_frames"], "cannot");
    assert_eq!(of["rates"][1]["struck_from_behind"], 2);
    // With drives left out it is not known.
    let told = bench.out("mrf rear.ron --fpr 1,30 --seeds 2 --early-stop");
    assert!(!told.contains("without contacts"), "{told}");

    bench.out("sweep rear.ron --fpr 30 --seeds 2 --out out");
    let table = bench.read("out/runs.csv");
    assert_eq!(column(&table, "struck_from_behind"), ["true"; 2]);
    let text = bench.out("run rear.ron");
    assert!(text.contains("Struck from behind"), "{text}");
    let collision = &json(&bench.out("run rear.ron --json"))["collision"];
    assert_eq!(collision["struck_from_behind"], true);
    assert_eq!(collision["actor_confirmed"], true);

    // A wall right ahead is known, and too near for any brakes.
    let wall = "(name: \"wall\", lane: 1, start: Ahead(gap_m: 4), behaviour: Obstacle)";
    let (head, _) = REAR_END.split_once("(name").unwrap();
    bench.write("wall.ron", &format!("{head}{wall}])"));
    let told = bench.out("mrf wall.ron --fpr 30 --seeds 2");
    let line = "wall at 30 FPR: 2 with a confirmed actor; more frames help only if";
    assert!(
        told.contains(line) && !told.contains("without contacts"),
        "{told}"
    );
    let table = bench.out("sweep wall.ron --fpr 30 --seeds 1 --out wall");
    assert!(!table.is_empty());
    assert_eq!(
        column(&bench.read("wall/runs.csv"), "struck_from_behind"),
        ["false"]
    );
}

#[test]
fn regress_a_run_notes_what_its_actors_did() {
    let bench = Bench::new();
    let ghost =
        "(title: \"ghost\", road: (lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 200)]),
 ego: (lane: 2, s_m: 100, speed_mps: 20), duration_s: 6, actors: [
 (name: \"slow\", lane: 1, start: Ahead(gap_m: 20), speed_mps: 10),
 (name: \"fast\", lane: 1, start: Behind(gap_m: 1), speed_mps: 20)])";
    bench.write("ghost.ron", ghost);
    let text = bench.out("run ghost.ron --set jitter.position_m=0 --set jitter.speed_mps=0");
    let line = "Note: `slow` and `fast` drive through each other from 2.";
    assert!(text.contains(line), "{text}");
    assert!(
        text.contains("Note: `ego` is past the end of the road from 4.89 to 5.99 s."),
        "{text}"
    );
    let document = json(&bench.out("run ghost.ron --json --report drive.html"));
    let notes = document["notes"].as_array().unwrap().iter();
    let kinds: Vec<&str> = notes.map(|note| note["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["actors_in_each_other", "past_end", "past_end"]);
    assert!(
        bench
            .read("drive.html")
            .contains("drive through each other")
    );
    assert_eq!(
        json(&bench.out("run cut-in --json"))["notes"],
        Value::Array(Vec::new())
    );
}

/// 30 parked cars a millimetre apart find no place with 5 m of jitter.
#[test]
fn hand_a_start_without_a_place_is_refused() {
    let bench = Bench::new();
    let cars: Vec<String> = (0..30)
        .map(|place| {
            let s = 200.0 + 4.601 * f64::from(place);
            format!("(name: \"p{place}\", lane: 1, start: At(s_m: {s}), behaviour: Obstacle)")
        })
        .collect();
    let text = format!(
        "(title: \"row\", road: (lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 3000)]),\n\
         ego: (lane: 2, s_m: 100, speed_mps: 20), duration_s: 5, actors: [{}])",
        cars.join(",")
    );
    bench.write("row.ron", &text);
    let set = "--set jitter.position_m=5";
    for line in [
        "run row.ron --seed 3",
        "explain row.ron --seed 3",
        "mrf row.ron --fpr 30 --seeds 2",
        "map row.ron --fpr 30 --seeds 2 --vary perception.confirm_frames=3:4",
        "compare row.ron --seeds 2",
        "allocate row.ron --seeds 2",
    ] {
        let ran = bench.zhuyi(&format!("{line} {set}"));
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{line}");
        let seed = if line.contains("--seed 3") { 3 } else { 0 };
        let told = format!(
            "of `row` start inside each other with seed {seed} in all of 100 draws of their jitter"
        );
        assert!(ran.err.contains(&told), "{line}: {}", ran.err);
    }
    bench.out(&format!("sweep row.ron --fpr 30 --seeds 1 --out out {set}"));
    let table = bench.read("out/runs.csv");
    assert_eq!(column(&table, "outcome"), ["refused"]);
    assert!(column(&table, "reason")[0].contains("start inside each other"));
}

/// A scenario of `../shared/data/faults` in a bench of its own, where it exists.
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn shared(name: &str) -> Option<Bench> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/faults");
    let Ok(text) = std::fs::read_to_string(root.join(name)) else {
        println!("skipped: ../shared/data/faults/{name} is not there");
        return None;
    };
    let bench = Bench::new();
    bench.write(name, &text);
    Some(bench)
}

/// The inputs that these rules come from.
#[test]
fn regress_the_shared_scripts() {
    if let Some(bench) = shared("a1.ron") {
        bench.out("run a1.ron --trace trace.csv");
        let table = bench.read("trace.csv");
        let of = |name| column(&table, name).into_iter();
        let rows = of("id").zip(of("heading_rad")).zip(of("d_m"));
        let of_c = rows.filter(|((id, _), _)| id == "c");
        let of_c: Vec<(f64, f64)> = of_c
            .map(|((_, heading), d)| (heading.parse().unwrap(), d.parse().unwrap()))
            .collect();
        let moved: Vec<f64> = of_c.windows(2).map(|pair| pair[1].1 - pair[0].1).collect();
        // 1.64 m/s to the side at 4 s.
        assert!((moved[400] - 0.0164).abs() < 2e-4, "{}", moved[400]);
        for (pair, ways) in of_c.windows(2).zip(moved.windows(2)) {
            assert!((pair[1].0 - pair[0].0).abs() < 2e-3);
            assert!((ways[1] - ways[0]).abs() < 3e-4);
        }
    }
    if let Some(bench) = shared("ped.ron") {
        let ran = bench.zhuyi("check ped.ron");
        assert_eq!(ran.code, Some(2));
        assert!(ran.err.contains("the actor stands"), "{}", ran.err);
    }
    for (name, note) in [
        (
            "never.ron",
            "began in no drive: cutter.1 ChangeLane, cutter.2 Brake",
        ),
        ("g4_never.ron", "began in no drive: c.1 ChangeLane"),
    ] {
        if let Some(bench) = shared(name) {
            let text = bench.out(&format!("mrf {name} --fpr 30 --seeds 2"));
            assert!(text.contains(note), "{text}");
            assert!(bench.out(&format!("run {name}")).contains("never began"));
        }
    }
    if let Some(bench) = shared("g3_ghost.ron") {
        let set = "--set jitter.position_m=0 --set jitter.speed_mps=0";
        let document = json(&bench.out(&format!("run g3_ghost.ron --json {set}")));
        let note = &document["notes"][0];
        let seconds = |name: &str| note[name].as_f64().unwrap();
        assert!(
            (seconds("from_s") - 3.66).abs() < 0.15 && (seconds("until_s") - 4.56).abs() < 0.15,
            "{note}"
        );
    }
    if let Some(bench) = shared("d5_ttc_beside.ron") {
        let document = json(&bench.out("run d5_ttc_beside.ron --json"));
        assert_eq!(document["manoeuvres"][0]["began_s"], Value::Null);
    }
    if let Some(bench) = shared("c1_rearend.ron") {
        let document = json(&bench.out("mrf c1_rearend.ron --fpr 1,30 --seeds 3 --json"));
        assert_eq!(document["scenarios"][0]["mrf"], ">30");
        assert_eq!(document["scenarios"][0]["more_frames"], "cannot");
        assert_eq!(
            document["scenarios"][0]["rates"][1]["struck_from_behind"],
            3
        );
    }
    if let Some(bench) = shared("g1_jitter.ron") {
        for seed in 0..20 {
            let line = format!("run g1_jitter.ron --seed {seed} --json");
            assert_eq!(json(&bench.out(&line))["notes"], Value::Array(Vec::new()));
        }
    }
}
