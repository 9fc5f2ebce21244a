//! What broken files are told: a file that passes, one change, and what is said to it.

use crate::texts::{self, SCENARIO, SYSTEM};
use zhuyi_scenario::{Invalid, Rule, Scenario, Setting, Source, System, Violation, load};

fn scenario(text: &str) -> Result<(), Invalid> {
    Scenario::read(&Source::new("scenario.ron", text), &texts::system(), &[]).map(|_| ())
}

fn system(text: &str) -> Result<(), Invalid> {
    System::read(&Source::new("system.ron", text), &[]).map(|_| ())
}

/// Line, column and rule of every violation, with what it may have meant.
fn digest(invalid: &Invalid) -> Vec<String> {
    let one = |violation: &Violation| {
        let ((line, column), rule) = (violation.line_column(), violation.rule());
        match rule {
            Rule::Unknown {
                nearest: Some(name),
                ..
            } => format!("{line}:{column} {rule} (did you mean `{name}`?)"),
            _ => format!("{line}:{column} {rule}"),
        }
    };
    invalid.violations().iter().map(one).collect()
}

/// Checks that a text passes, and that replacing the one place of `.0` by `.1` is told exactly `.2`.
fn check(read: fn(&str) -> Result<(), Invalid>, text: &str, changes: &[(&str, &str, &str)]) {
    read(text).unwrap_or_else(|invalid| panic!("{invalid}"));
    for (from, to, told) in changes {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        let invalid = read(&text.replace(from, to)).expect_err(to);
        assert_eq!(digest(&invalid), [*told], "{to}");
    }
}

#[test]
fn hand_syntax() {
    // RON's grammar stops at its first error.
    check(
        scenario,
        SCENARIO,
        &[
            (
                r#""A lead ahead","#,
                r#""A lead ahead,"#,
                "7:17 not valid RON: expected comma",
            ),
            ("lanes: 3", "lanes 3", "3:18 not valid RON: expected comma"),
            (
                "    duration_s: 30,\n",
                "    duration_s: 30\n",
                "6:5 not valid RON: expected comma",
            ),
            (
                "(\n    title",
                "#![enable(unwrap_newtypes)]\n(\n    title",
                "1:1 not valid RON: attributes such as `#![enable(..)]` have no use here",
            ),
        ],
    );
}

#[test]
fn hand_unknown_names() {
    check(
        scenario,
        SCENARIO,
        &[
            (
                "title:",
                "titel:",
                "2:5 unknown field `titel` (did you mean `title`?)",
            ),
            (
                "speed_mps: 20",
                "speed_mp: 20",
                "4:30 unknown field `speed_mp` (did you mean `speed_mph`?)",
            ),
            (
                "duration_s: 30,",
                "duration_s: 30, wind_mps: 3,",
                "5:21 unknown field `wind_mps`",
            ),
            (
                "Ahead(",
                "ahed(",
                "7:40 unknown start `ahed` (did you mean `Ahead`?)",
            ),
            (
                "Beside(offset_m: 20)",
                "Somewhere",
                "11:20 unknown start `Somewhere`",
            ),
            (
                "Time(at_s: 5)",
                r#"DistanceTo(actor: "led", distance_m: 9)"#,
                "13:51 unknown actor `led` (did you mean `lead`?)",
            ),
            (
                "manoeuvres: [",
                "behaviour: Folow, manoeuvres: [",
                "13:24 unknown behaviour `Folow` (did you mean `Follow`?)",
            ),
        ],
    );
}

#[test]
fn hand_types() {
    check(
        scenario,
        SCENARIO,
        &[
            (
                "lanes: 3",
                "lanes: 3.0",
                "3:19 expected a whole number, got `3.0`",
            ),
            (
                "lanes: 3",
                r#"lanes: "three""#,
                r#"3:19 expected a whole number, got `"three"`"#,
            ),
            (
                "duration_s: 30",
                "duration_s: Some(30)",
                "5:17 expected a number, got `Some(30)`",
            ),
            (
                r#""A lead ahead""#,
                "lead",
                "2:12 expected a text in double quotes, got `lead`",
            ),
            (
                r#""A lead ahead""#,
                r#""""#,
                r#"2:12 expected one line of text, got `""`"#,
            ),
            (
                "[Line(length_m: 1000)]",
                "Line(length_m: 1000)",
                "3:51 expected a list `[..]`, got `Line(length_m: 1000)`",
            ),
            (
                "(lane: 2, s_m: 100, speed_mps: 20)",
                "(2, 100, 20)",
                "4:10 expected fields in brackets `(name: value, ..)`, got `(2, 100, 20)`",
            ),
            (
                "(lane: 2, s_m: 100, speed_mps: 20)",
                "Egg(lane: 2, s_m: 100, speed_mps: 20)",
                "4:10 expected fields in brackets `(name: value, ..)`, got `Egg(lane: 2, s_m: 100, speed_mps: 20)`",
            ),
            (
                "Ahead(gap_m: 30)",
                "Ahead(30)",
                "7:40 expected named fields in brackets, got `Ahead(30)`",
            ),
        ],
    );
}

#[test]
fn hand_ranges() {
    check(
        scenario,
        SCENARIO,
        &[
            (
                "duration_s: 30",
                "duration_s: 0",
                "5:17 `duration_s` must be 0.1 to 600, got 0",
            ),
            (
                "duration_s: 30",
                "duration_s: NaN",
                "5:17 `duration_s` must be 0.1 to 600, got NaN",
            ),
            (
                "duration_s: 30",
                "duration_s: inf",
                "5:17 `duration_s` must be 0.1 to 600, got inf",
            ),
            (
                "speed_mps: 20",
                "speed_mps: 120",
                "4:41 `speed_mps` must be 0 to 80, got 120",
            ),
            (
                "speed_mps: 20",
                "speed_mph: 200",
                "4:41 `speed_mph` must be 0 to 80 m/s, got 200 mph (89.408 m/s)",
            ),
            (
                "speed_mps: 15",
                "relative_mps: -20.5",
                "7:72 `relative_mps` must be -20 to 60, got -20.5",
            ),
            (
                "ego: (lane: 2",
                "ego: (lane: 4",
                "4:17 `lane` must be 1 to 3, got 4",
            ),
            (
                "ego: (lane: 2",
                "ego: (lane: -1",
                "4:17 `lane` must be 1 to 3, got -1",
            ),
            (
                "ChangeLane(lane: 2",
                "ChangeLane(lane: 0",
                "13:71 `lane` must be 1 to 3, got 0",
            ),
            (
                "lanes: 3",
                "lanes: 99",
                "3:19 `lanes` must be 1 to 12, got 99",
            ),
            (
                "[Line(length_m: 1000)]",
                "[]",
                "3:51 `segments` must have 1 to 1000 entries, got 0",
            ),
            (
                "Line(length_m: 1000)",
                "Arc(length_m: 1000, radius_m: -2)",
                "3:82 `radius_m` must be 5 or more to the left, -5 or less to the right, got -2",
            ),
            (
                "gap_m: 30",
                "gap_m: 0",
                "7:53 `gap_m` must be above 0 and at most 10000, got 0",
            ),
        ],
    );
}

#[test]
fn hand_missing_and_repeated_fields() {
    check(
        scenario,
        SCENARIO,
        &[
            (
                "    duration_s: 30,\n",
                "",
                "1:1 Scenario needs `duration_s`",
            ),
            ("duration_s: 3)", ")", "13:54 ChangeLane needs `duration_s`"),
            (
                ", speed_mps: 20",
                "",
                "4:10 give exactly one of `speed_mph`, `speed_mps`, got none",
            ),
            (
                "speed_mps: 20",
                "speed_mps: 20, speed_mph: 45",
                "4:41 give exactly one of `speed_mph`, `speed_mps`, got `speed_mph`, `speed_mps`",
            ),
            (
                "    duration_s: 30,\n",
                "    duration_s: 30,\n    duration_s: 20,\n",
                "6:5 `duration_s` is given twice",
            ),
        ],
    );
}

#[test]
fn hand_contradictions() {
    check(
        scenario,
        SCENARIO,
        &[
            (
                r#"name: "cutter""#,
                r#"name: "lead""#,
                "9:19 two actors are called `lead`",
            ),
            (
                r#"name: "cutter""#,
                r#"name: "ego""#,
                "9:19 the name `ego` belongs to the ego",
            ),
            (
                r#"name: "cutter""#,
                r#"name: "car 2""#,
                "9:19 a name is made of letters, digits, `_` and `-` and begins with a letter, got `car 2`",
            ),
            (
                "s_m: 100",
                "s_m: 1",
                "4:10 `ego` would stand from -1.40 to 3.40 m of a road of 1000 m",
            ),
            (
                "Ahead(gap_m: 30)",
                "At(s_m: 999)",
                "7:40 `lead` would stand from 996.70 to 1001.30 m of a road of 1000 m",
            ),
            (
                "Ahead(gap_m: 30)",
                "Beside(offset_m: -3)",
                "7:40 `lead` and `ego` would overlap at the start by 1.700 m along and 1.875 m across `lead`",
            ),
            ("lane: 1", "lane: 2", "13:54 the actor is in lane 2 already"),
            (
                "Line(length_m: 1000)",
                "Arc(length_m: 1000, radius_m: 5)",
                "3:52 curvature stays below 1/m 0.19047619047619047 in magnitude, where the inner edge of the road meets its centre, got 0.2",
            ),
            (
                "Line(length_m: 1000)",
                "Arc(length_m: 1000, radius_m: 100)",
                "3:52 a segment turns by at most one full circle, 6.283 rad, got 10",
            ),
            (
                "speed_mps: 15",
                "speed_mps: 15, behaviour: Obstacle",
                "7:69 an obstacle stands still, got 15 m/s",
            ),
            (
                "speed_mps: 10,",
                "behaviour: Obstacle,",
                "13:25 an obstacle stands still: it has no manoeuvres",
            ),
            (
                "speed_mps: 15",
                "speed_mps: 0, behaviour: Follow",
                "7:83 a follower that starts at rest needs a desired speed",
            ),
            (
                "speed_mps: 15",
                "speed_mps: 15, behaviour: HoldBeside",
                "7:84 `offset_m` may be left out only by an actor that starts `Beside` the ego",
            ),
            (
                "Time(at_s: 5)",
                r#"DistanceTo(actor: "cutter", distance_m: 9)"#,
                "13:51 an actor has no distance to itself",
            ),
            (
                "Time(at_s: 5)",
                r#"DistanceTo(actor: "ego", distance_m: 9)"#,
                "13:51 for the distance to the ego use `GapToEgo(gap_m: ..)`",
            ),
            (
                "ChangeLane(lane: 2",
                "ChangeLane(lane: 1",
                "13:54 the actor is in lane 1 already",
            ),
            (
                "at_s: 5",
                "at_s: 30",
                "13:33 the run is over at 30 s, got 30 s",
            ),
            (
                "[(when",
                "[(when: Time(at_s: 7), then: Brake(decel_mps2: 3)), (when",
                "13:84 manoeuvres begin in order, but 5 s comes before 7 s",
            ),
            (
                "ChangeLane(lane: 2, duration_s: 3)",
                "Behave(behaviour: Obstacle)",
                "13:72 unknown behaviour `Obstacle`",
            ),
        ],
    );
}

#[test]
fn hand_systems() {
    check(
        system,
        SYSTEM,
        &[
            (
                "fov_deg: 120",
                "fov_deg: 361",
                "9:54 `fov_deg` must be 1 to 360, got 361",
            ),
            (
                "miss_rate: 0,",
                "miss_rate: 0, drop_rate: 1.5,",
                "13:99 `drop_rate` must be 0 to 1, got 1.5",
            ),
            (
                "miss_rate: 0,",
                "miss_rate: 0, latency_jitter_ms: -1,",
                "13:107 `latency_jitter_ms` must be 0 to 10000, got -1",
            ),
            (
                r#"name: "rear""#,
                r#"name: "front""#,
                "10:20 two cameras are called `front`",
            ),
            (
                "forward_m: -2.3",
                "forward_m: -2.5",
                "10:39 a camera is mounted on the vehicle, at most 2.4 m from its centre, got -2.5",
            ),
            (
                "analysed: true",
                "analysed: yes",
                "9:83 expected `true` or `false`, got `yes`",
            ),
            (
                "analysed: true",
                "latency: Fixed(latency_ms: 0)",
                "9:100 `latency_ms` must be 0.1 to 10000, got 0",
            ),
            (
                "wheelbase_m: 2.8",
                "wheelbase_m: 5",
                "3:66 `wheelbase_m` must be at most `length_m`, got 5 and 4.8",
            ),
            (
                "release_below_mps2: 1",
                "release_below_mps2: 4.5",
                "19:79 `release_below_mps2` must be at most `brake_above_mps2`, got 4.5 and 4",
            ),
            (
                "max_decel_mps2: 5",
                "max_decel_mps2: 9.5",
                "19:98 `max_decel_mps2` must be at most `vehicle.max_decel_mps2`, got 9.5 and 9",
            ),
            (
                "prediction: ConstantVelocity",
                "prediction: Constant",
                "16:17 unknown prediction `Constant`",
            ),
            (
                "estimator: ()",
                "estimator: (aggregation: Percentile(share: 99))",
                "23:48 `share` must be above 0 and at most 1, got 99",
            ),
            (
                "estimator: ()",
                "estimator: (current_latency: Fixed(latency_ms: 0))",
                "23:52 `latency_ms` must be 0.1 to 10000, got 0",
            ),
            (
                "estimator: ()",
                "estimator: (uncertainty: Track(sigmas: -1, position_m: 1, speed_mps: 1, accel_mps2: 1, \
                 jerk_density_m2ps5: 1))",
                "23:44 `sigmas` must be 0 to 10, got -1",
            ),
            (
                "estimator: ()",
                "estimator: (evasion: LaneChange(lateral_accel_mps2: 0, window_s: 4))",
                "23:57 `lateral_accel_mps2` must be above 0 and at most 20, got 0",
            ),
            (
                "estimator: ()",
                "estimator: (c3: 4.9)",
                "23:17 unknown field `c3` (did you mean `c3_mps2`?)",
            ),
            ("    estimator: (),\n", "", "1:1 System needs `estimator`"),
        ],
    );
}

/// What is drawn when a place of the scenario is replaced.
fn drawn(from: &str, to: &str) -> String {
    assert_eq!(SCENARIO.matches(from).count(), 1, "{from}");
    format!("{}\n", scenario(&SCENARIO.replace(from, to)).expect_err(to))
}

#[test]
fn hand_a_caret_marks_the_value() {
    let expected = "\
error: `speed_mph` must be 0 to 80 m/s, got 200 mph (89.408 m/s)
 --> scenario.ron:4:41
  |
4 |     ego: (lane: 2, s_m: 100, speed_mph: 200),
  |                                         ^^^
";
    assert_eq!(drawn("speed_mps: 20", "speed_mph: 200"), expected);
}

#[test]
fn hand_a_suggestion_or_the_known_names_stand_beside_the_caret() {
    let expected = "\
error: unknown field `titel`
 --> scenario.ron:2:5
  |
2 |     titel: \"A lead ahead\",
  |     ^^^^^ did you mean `title`?
";
    assert_eq!(drawn("title", "titel"), expected);
    let expected = "\
error: unknown start `Somewhere`
  --> scenario.ron:11:20
   |
11 |             start: Somewhere,
   |                    ^^^^^^^^^ known: Ahead, Behind, Beside, At, Steady
";
    assert_eq!(drawn("Beside(offset_m: 20)", "Somewhere"), expected);
}

#[test]
fn regress_boxes_that_only_a_bend_brings_together() {
    // 4.9 m from centre to centre along the middle of the road are 4.3 m along the inner lane of a bend of 30 m, too few for
    // two boxes of 4.8 and 4.6 m.
    let at = |gap| {
        SCENARIO
            .replace(
                "Line(length_m: 1000)",
                "Arc(length_m: 120, radius_m: 30), Line(length_m: 880)",
            )
            .replace("Ahead(gap_m: 30)", &format!("Ahead(gap_m: {gap})"))
            .replace("lane: 2, s_m: 100", "lane: 3, s_m: 100")
            .replace("lead\", lane: 2", "lead\", lane: 3")
    };
    let told = digest(&scenario(&at(0.2)).unwrap_err());
    assert!(
        told[0].contains("`lead` and `ego` would overlap at the start by 0.5"),
        "{told:?}"
    );
    scenario(&at(2.0)).unwrap();
}

#[test]
fn hand_roads_that_lie_over_themselves_and_rings_that_do_not_close() {
    check(
        scenario,
        SCENARIO,
        &[
            (
                "[Line(length_m: 1000)]",
                "[Line(length_m: 200), Arc(length_m: 150, radius_m: 30), Line(length_m: 200)]",
                "3:107 the road lies over itself: 10.5 m wide, its middle at 372.41 m (segment 3) comes within 0.00 m of its middle \
                 at 177.59 m (segment 1)",
            ),
            (
                "Line(length_m: 1000)",
                "Arc(length_m: 1000, radius_m: 159.155)",
                "3:52 the road lies over itself: 10.5 m wide, its middle at 1000.00 m (segment 1) comes within 0.00 m of its \
                 middle at 0.00 m (segment 1); it comes back to its start at 1000.000 m: a ring is one lap with `closed: true`",
            ),
            (
                "[Line(length_m: 1000)]",
                "[Line(length_m: 1000)], closed: true",
                "3:83 a closed road ends where it starts, to within 0.01 m and 0.001 rad: its end lies 1000.0000 m past and \
                 0.0000 m to the left of its start and is turned by 0.00000 rad",
            ),
            (
                "[Line(length_m: 1000)]",
                "[Arc(length_m: 999.9, radius_m: 159.155)], closed: true",
                "3:102 a closed road ends where it starts, to within 0.01 m and 0.001 rad: its end lies 0.1004 m before and \
                 0.0000 m to the left of its start and is turned by -0.00063 rad",
            ),
            (
                "[Line(length_m: 1000)]",
                "[Line(length_m: 1000)], closed: yes",
                "3:83 expected `true` or `false`, got `yes`",
            ),
        ],
    );
}

#[test]
fn hand_starts_on_a_ring_lie_within_a_lap() {
    let ring = SCENARIO.replace(
        "[Line(length_m: 1000)]",
        "[Arc(length_m: 1000, radius_m: 159.155)], closed: true",
    );
    // Across the seam, ahead and behind; boxes may stand over it.
    scenario(&ring.replace("s_m: 100", "s_m: 1")).unwrap();
    scenario(&ring.replace("s_m: 100", "s_m: 990")).unwrap();
    scenario(&ring.replace("Ahead(gap_m: 30)", "Behind(gap_m: 600)")).unwrap();
    check(
        scenario,
        &ring,
        &[
            (
                "s_m: 100",
                "s_m: 1001",
                "4:10 `ego` would stand 1001.00 m from the start of the road, and a lap of the road has 1000 m",
            ),
            (
                "Ahead(gap_m: 30)",
                "Ahead(gap_m: 1008)",
                "7:40 `lead` would stand 1012.70 m from the ego, and a lap of the road has 1000 m",
            ),
            (
                "Ahead(gap_m: 30)",
                "Ahead(gap_m: 993)",
                "7:40 `lead` and `ego` would overlap at the start by 2.414 m along and 1.893 m across `lead`",
            ),
        ],
    );
}

#[test]
fn hand_two_places_are_drawn_together() {
    let expected = "\
error: `lead` and `ego` would overlap at the start by 1.700 m along and 1.875 m across `lead`
 --> scenario.ron:7:40
  |
4 |     ego: (lane: 2, s_m: 100, speed_mps: 20),
  |          ---------------------------------- the other one
...
7 |         (name: \"lead\", lane: 2, start: Beside(offset_m: -3), speed_mps: 15),
  |                                        ^^^^^^^^^^^^^^^^^^^^
";
    assert_eq!(drawn("Ahead(gap_m: 30)", "Beside(offset_m: -3)"), expected);
    let expected = "\
error: `duration_s` is given twice
 --> scenario.ron:6:5
  |
5 |     duration_s: 30,
  |     ---------- first given here
6 |     duration_s: 20,
  |     ^^^^^^^^^^
";
    assert_eq!(
        drawn("30,\n    actors", "30,\n    duration_s: 20,\n    actors"),
        expected
    );
}

#[test]
fn hand_syntax_is_drawn_with_the_words_of_ron() {
    let expected = "\
error: not valid RON: unclosed block comment
  --> scenario.ron:16:5
   |
16 | ) /* end
   |     ^^^^
";
    assert_eq!(drawn(",\n)\n", ",\n) /* end"), expected);
}

#[test]
fn hand_six_errors_are_six_violations() {
    let changes = [
        ("lane_width_m: 3.5", "lane_width_m: 35"),
        ("speed_mps: 20", "speed_mps: NaN"),
        ("duration_s: 30", "duration: 30"),
        ("Ahead(gap_m: 30)", "At(s_m: -5)"),
        ("lane: 1", "lane: 5"),
        ("ChangeLane(", "ChangLane("),
    ];
    let broken = changes
        .iter()
        .fold(SCENARIO.to_string(), |text, (from, to)| {
            text.replace(from, to)
        });
    let told = [
        "3:36 `lane_width_m` must be 2 to 6, got 35",
        "4:41 `speed_mps` must be 0 to 80, got NaN",
        "5:5 unknown field `duration` (did you mean `duration_s`?)",
        "7:48 `s_m` must be 0 to 100000, got -5",
        "10:19 `lane` must be 1 to 3, got 5",
        "13:54 unknown action `ChangLane` (did you mean `ChangeLane`?)",
    ];
    assert_eq!(digest(&scenario(&broken).unwrap_err()), told);
}

#[test]
fn hand_scenario_system_and_settings_are_told_in_one_go() {
    let sources = [
        Source::new("scenario.ron", SCENARIO.replace("lanes: 3", "lanes: 0")),
        Source::new(
            "system.ron",
            SYSTEM.replace("min_gap_m: 3", "min_gap_m: -3"),
        ),
    ];
    let settings = ["ego.speed_mps=90", "planner.exponent=x"]
        .map(|argument| Setting::parse(argument).unwrap());
    let invalid = load(&sources[0], &sources[1], &settings).unwrap_err();
    let told = [
        "3:19 `lanes` must be 1 to 12, got 0",
        "1:15 `speed_mps` must be 0 to 80, got 90",
        "18:39 `min_gap_m` must be above 0 and at most 50, got -3",
        "1:18 expected a number, got `x`",
    ];
    assert_eq!(digest(&invalid), told);
    let names: Vec<_> = invalid
        .violations()
        .iter()
        .map(Violation::source_name)
        .collect();
    assert_eq!(names, ["scenario.ron", "--set", "system.ron", "--set"]);
}

#[test]
fn hand_what_depends_on_a_broken_system_goes_unchecked() {
    // Whether the lead overlaps the ego, nobody can say before the ego has a length.
    let overlapping = Source::new(
        "scenario.ron",
        SCENARIO.replace("Ahead(gap_m: 30)", "Beside(offset_m: 0)"),
    );
    let broken = Source::new(
        "system.ron",
        SYSTEM.replace("length_m: 4.8", "length_m: 480"),
    );
    let invalid = load(&overlapping, &broken, &[]).unwrap_err();
    assert_eq!(
        digest(&invalid),
        ["3:19 `length_m` must be 1 to 30, got 480"]
    );
}
