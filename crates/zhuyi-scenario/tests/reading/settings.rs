//! `path=value`: values from elsewhere pass the same checks, and what is wrong with them is shown in their own text.

use crate::texts::{SCENARIO, SYSTEM};
use zhuyi_core::CameraId;
use zhuyi_estimator::Aggregation;
use zhuyi_scenario::{Invalid, Kind, Scenario, Setting, Source, System, load};
use zhuyi_world::script::{Action, Behaviour, Place};

/// The scenario and the system with settings.
fn read(arguments: &[&str]) -> Result<(Scenario, System), Invalid> {
    let settings: Vec<_> = arguments
        .iter()
        .map(|argument| Setting::parse(argument))
        .collect::<Result<_, _>>()?;
    load(
        &Source::new("scenario.ron", SCENARIO),
        &Source::new("system.ron", SYSTEM),
        &settings,
    )
}

/// What is drawn of a single setting.
fn drawn(argument: &str) -> String {
    format!("{}\n", read(&[argument]).expect_err(argument))
}

#[test]
fn hand_settings_change_what_they_name_and_nothing_else() {
    let (mut scenario, mut system) = read(&[]).unwrap();
    let changed = read(&[
        "ego.speed_mps = 25",
        "actors.lead.start=Steady",
        "actors.lead.behaviour=Follow(desired_speed_mps: 20)",
        "actors.cutter.manoeuvres.0.then.duration_s=2.5",
        "planner.time_headway_s=1.5",
        "perception.cameras.rear.fov_deg=90",
        "estimator.aggregation=Percentile(share: 0.5)",
    ]);
    scenario.ego.speed = 25.0;
    // s0 + T v = 3 m + 1.5 s * 25 m/s.
    scenario.actors[0].start.along = Place::Ahead(40.5);
    let Ok((Scenario { actors, .. }, _)) = &changed else {
        panic!("{changed:?}")
    };
    let Behaviour::Follow { driver, .. } = actors[0].behaviour else {
        panic!("{actors:?}")
    };
    assert_eq!(driver.desired_speed, 20.0);
    scenario.actors[0].behaviour = actors[0].behaviour;
    let Action::ChangeLane { duration, .. } = &mut scenario.actors[1].manoeuvres[0].then else {
        panic!("{actors:?}")
    };
    *duration = 2.5;
    system.planner.time_headway = 1.5;
    system.perception.eyes[1].camera.fov = std::f64::consts::FRAC_PI_2;
    system.estimator.aggregation = Aggregation::Percentile(0.5);
    assert_eq!(changed.unwrap(), (scenario, system));
}

#[test]
fn hand_the_errors_of_the_rig_are_those_of_every_camera_that_has_none_of_its_own() {
    let (_, usual) = read(&["perception.noise_along_m=0.2", "perception.miss_rate=0.1"]).unwrap();
    let (_, own) = read(&[
        "perception.noise_along_m=0.2",
        "perception.miss_rate=0.1",
        "perception.cameras.rear.noise_along_m=0.5",
        "perception.cameras.rear.latency_jitter_ms=20",
        "perception.cameras.rear.drop_rate=0.25",
    ])
    .unwrap();
    let of = |system: &System, camera: u8| system.perception.errors_of(CameraId(camera));
    assert_eq!(of(&usual, 0).noise_along, 0.2);
    assert_eq!(of(&usual, 0), of(&usual, 1));
    assert_eq!(of(&own, 0), of(&usual, 0));
    let mut rear = of(&usual, 1);
    (rear.noise_along, rear.latency_jitter, rear.drop_rate) = (0.5, 0.02, 0.25);
    assert_eq!(of(&own, 1), rear);
    // The same limits, and the same words, as for the rig.
    let refused = drawn("perception.cameras.rear.drop_rate=1.5");
    assert!(
        refused.contains("`drop_rate` must be 0 to 1, got 1.5"),
        "{refused}"
    );
}

#[test]
fn hand_a_whole_value_or_entry_can_be_set() {
    let (scenario, _) = read(&[
        "ego=(lane: 1, s_m: 100, speed_mps: 5)",
        r#"actors.lead=(name: "lead", lane: 3, start: Behind(gap_m: 50), speed_mps: 1)"#,
        "actors.lead.speed_mps=2",
    ])
    .unwrap();
    assert_eq!((scenario.ego.lane.0, scenario.ego.speed), (1, 5.0));
    assert_eq!(
        (scenario.actors[0].start.lane.0, scenario.actors[0].speed),
        (3, 2.0)
    );
}

#[test]
fn hand_one_unit_set_stands_above_the_other_in_the_file() {
    assert_eq!(read(&["ego.speed_mph=10"]).unwrap().0.ego.speed, 4.4704);
    let both = read(&["ego.speed_mph=10", "ego.speed_mps=4"])
        .unwrap_err()
        .to_string();
    assert!(
        both.starts_with(
            "error: give exactly one of `speed_mph`, `speed_mps`, got `speed_mph`, `speed_mps`"
        ),
        "{both}"
    );
}

#[test]
fn hand_a_setting_belongs_to_one_kind_of_file() {
    for (argument, kind) in [
        ("road.lanes=4", Kind::Scenario),
        ("duration_s=4", Kind::Scenario),
        ("prediction=ConstantVelocity", Kind::System),
        ("jitter.speed_mps=0", Kind::System),
    ] {
        assert_eq!(Setting::parse(argument).unwrap().kind(), kind);
    }
}

#[test]
fn hand_what_is_wrong_is_shown_in_the_argument() {
    let cases = [
        (
            "planner.time_headway_s=1e9",
            "\
error: `time_headway_s` must be 0 to 10, got 1000000000
 --> --set:1:24
  |
1 | planner.time_headway_s=1e9
  |                        ^^^
",
        ),
        (
            "planner.time_headwy_s=1",
            "\
error: unknown setting `time_headwy_s`
 --> --set:1:9
  |
1 | planner.time_headwy_s=1
  |         ^^^^^^^^^^^^^ did you mean `time_headway_s`?
",
        ),
        (
            "planer.time_headway_s=1",
            "\
error: unknown setting `planer`
 --> --set:1:1
  |
1 | planer.time_headway_s=1
  | ^^^^^^ did you mean `planner`?
",
        ),
        (
            "actors.truck.lane=1",
            "\
error: unknown setting `truck`
 --> --set:1:8
  |
1 | actors.truck.lane=1
  |        ^^^^^ known: cutter, lead
",
        ),
        (
            "perception.cameras.frnt.range_m=1",
            "\
error: unknown setting `frnt`
 --> --set:1:20
  |
1 | perception.cameras.frnt.range_m=1
  |                    ^^^^ did you mean `front`?
",
        ),
        (
            "ego.lane",
            "\
error: a setting has the form `path=value`
 --> --set:1:1
  |
1 | ego.lane
  | ^^^^^^^^
",
        ),
        (
            "ego.lane=(1",
            "\
error: not valid RON: expected comma
 --> --set:1:12
  |
1 | ego.lane=(1
  |            ^
",
        ),
        (
            "ego.lane=",
            "\
error: not valid RON: unexpected end of RON
 --> --set:1:10
  |
1 | ego.lane=
  |          ^
",
        ),
    ];
    for (argument, expected) in cases {
        assert_eq!(drawn(argument), expected);
    }
}

#[test]
fn hand_all_settings_are_told_in_their_order() {
    let settings = [
        "ego.lane=7",
        "duration_s=-1",
        "actors.led.lane=1",
        "ego.lane=2",
    ];
    let invalid = read(&settings).unwrap_err();
    let told: Vec<_> = invalid
        .violations()
        .iter()
        .map(|violation| violation.rule().to_string())
        .collect();
    assert_eq!(
        told,
        [
            "`lane` must be 1 to 3, got 7",
            "`duration_s` must be 0.1 to 600, got -1",
            "unknown setting `led`",
            "`ego.lane` is given twice",
        ]
    );
}

#[test]
fn hand_a_setting_below_a_broken_value_is_not_called_unknown() {
    let invalid = read(&[
        "actors.lead.start=Befor(gap_m: 3)",
        "actors.lead.start.gap_m=2",
    ])
    .unwrap_err();
    let told: Vec<_> = invalid
        .violations()
        .iter()
        .map(|violation| violation.rule().to_string())
        .collect();
    assert_eq!(told, ["unknown start `Befor`"]);
}
