//! `list`, `show`, `check`, `new`.

use crate::Bench;
use zhuyi_scenario::embedded;

#[test]
fn law_list_names_every_scenario_in_the_order_of_the_table() {
    let out = Bench::new().out("list");
    let places: Vec<usize> = embedded::names()
        .map(|name| out.find(&format!("\n {name} ")).unwrap())
        .collect();
    assert!(places.is_sorted(), "{out}");
    let cut_in = out
        .lines()
        .find(|line| line.starts_with(" cut-in "))
        .unwrap();
    assert!(
        cut_in.contains("70 mph") && cut_in.contains("cutter"),
        "{cut_in}"
    );
}

#[test]
fn law_what_is_shown_is_a_file_that_shows_the_same() {
    let bench = Bench::new();
    for name in embedded::names().chain(["default"]) {
        let shown = bench.out(&format!("show {name}"));
        let file = format!("{name}.ron");
        bench.write(&file, &shown);
        assert_eq!(
            bench.out(&format!("check ./{file}")),
            format!("./{file}: ok\n")
        );
        assert_eq!(bench.out(&format!("show ./{file}")), shown);
        assert!(
            shown.lines().all(|line| line.chars().count() <= 105),
            "{shown}"
        );
    }
}

#[test]
fn hand_the_start_from_above() {
    let bench = Bench::new();
    // 1 m per column from -8 m on: the ego's box from -2.4 to 2.4 m, the van's from 12.4 to 18.4 m, the wreck's of 4.6 m from 62.4 m on.
    bench.write(
        "two.ron",
        r#"(title: "Two", road: (lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 500)]),
        ego: (lane: 1, s_m: 50, speed_mps: 20), duration_s: 5, actors: [
            (name: "van", body: Box(length_m: 6, width_m: 2, mass_kg: 2000), lane: 2, start: Ahead(gap_m: 10), speed_mps: 15),
            (name: "wreck", lane: 1, start: Ahead(gap_m: 60), behaviour: Obstacle),
        ])"#,
    );
    let shown = bench.out("show two.ron");
    let expected = "\
// The start from above, driving to the right; metres ahead of the ego's centre, 1 m per column
//                 0         10        20        30        40        50        60        70
//         ================================================================================
//                             van
// lane 2                      =======
//         -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -  -
//              ego                                                              wreck
// lane 1       >>>>>>                                                           ######
//         ================================================================================
// >> the ego, == moves, ## stands still
";
    let drawn: Vec<&str> = shown.lines().take(10).collect();
    assert_eq!(drawn.join("\n") + "\n", expected);
}

#[test]
fn hand_settings_reach_what_is_shown() {
    let bench = Bench::new();
    let shown =
        bench.out("show vehicle-following --set actors.lead.speed_mps=12.5 --set ego.lane=1");
    assert!(
        shown.contains("speed_mps: 12.5") && shown.contains("lane: 1"),
        "{shown}"
    );
    let shown = bench.out("show default --set perception.cameras.left.rate_hz=7");
    assert!(shown.contains("rate_hz: 7,"), "{shown}");
}

#[test]
fn hand_check_tells_every_violation_of_every_file() {
    let bench = Bench::new();
    let road =
        "(title: \"x\", road: (lanes: 3, lane_width_m: 3.5, segments: [Line(length_m: 900)]),";
    let good =
        format!("{road}\n  ego: (lane: 2, s_m: 9, speed_mph: 60), duration_s: 20, actors: [])");
    bench.write("good.ron", &good);
    bench.write(
        "bad.ron",
        &good.replace("3.5", "NaN").replace("duration_s", "duration"),
    );
    bench.write(
        "car.ron",
        &embedded::system().replace("mass_kg: 1800", "mass_kg: -1800"),
    );
    bench.write("broken.ron", "(title: \"x\"");
    std::fs::write(bench.path("bytes.ron"), [0xff, 0xfe]).unwrap();
    let ran = bench.zhuyi("check good.ron bad.ron car.ron broken.ron bytes.ron");
    assert_eq!(ran.code, Some(2));
    assert_eq!(
        ran.out,
        "good.ron: ok\nbad.ron: not ok\ncar.ron: not ok\nbroken.ron: not ok\nbytes.ron: not ok\n"
    );
    for told in [
        "bad.ron:1:45",
        "got NaN",
        "bad.ron:2:42",
        "did you mean `duration_s`?",
        "car.ron:",
        "got -1800",
        "broken.ron:1:",
        "bytes.ron",
    ] {
        assert!(ran.err.contains(told), "{told} is not in\n{}", ran.err);
    }
    // A file that is not there is told beside the others, and weighs more.
    let ran = bench.zhuyi("check bad.ron nowhere.ron good.ron");
    assert_eq!(
        (ran.code, ran.out.as_str()),
        (
            Some(4),
            "bad.ron: not ok\nnowhere.ron: not ok\ngood.ron: ok\n"
        )
    );
    assert!(
        ran.err.contains("got NaN") && ran.err.contains("cannot read `nowhere.ron`"),
        "{}",
        ran.err
    );
}

#[test]
fn hand_check_takes_the_system_that_is_named() {
    let bench = Bench::new();
    bench.write(
        "car.ron",
        &embedded::system().replace("length_m: 4.8", "length_m: 4.8x"),
    );
    let ran = bench.zhuyi("check cut-in --system car.ron");
    // The system's fault is not held against the scenario.
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), "cut-in: ok\n"));
    assert!(ran.err.contains("car.ron:"), "{}", ran.err);
}

#[test]
fn hand_new_writes_once() {
    let bench = Bench::new();
    let out = bench.out("new");
    assert!(
        out.starts_with("Wrote my-scenario.ron. Next:\n  zhuyi check my-scenario.ron\n"),
        "{out}"
    );
    assert_eq!(bench.read("my-scenario.ron"), embedded::template());
    bench.write("my-scenario.ron", "mine");
    let ran = bench.zhuyi("new");
    assert_eq!((ran.code, ran.out.as_str()), (Some(4), ""));
    assert_eq!(
        ran.err,
        "error: `my-scenario.ron` exists already, and nothing is overwritten\n"
    );
    assert_eq!(bench.read("my-scenario.ron"), "mine");
    assert_eq!(bench.names("."), ["my-scenario.ron"]);
}

#[test]
fn hand_new_copies_what_comes_with_the_program() {
    let bench = Bench::new();
    bench.out("new mine --from cut-in");
    bench.out("new ignored -o car.ron --from default");
    assert_eq!(
        bench.read("mine.ron"),
        embedded::scenario("cut-in").unwrap()
    );
    assert_eq!(bench.read("car.ron"), embedded::system());
    let json = bench.out("run mine.ron --system car.ron --json");
    assert!(json.contains("\"scenario\": \"mine\""), "{json}");
}
