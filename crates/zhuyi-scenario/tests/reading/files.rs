//! The files that come with the program: they pass, and what is shown of them reads back as the equal value.

use crate::texts::{self, SCENARIO, SYSTEM};
use zhuyi_scenario::{Kind, Scenario, Setting, Source, System, embedded, load};
use zhuyi_world::script::Place;

fn default_system() -> System {
    System::read(&Source::new("default.ron", embedded::system()), &[]).unwrap()
}

fn scenario(name: &str) -> Scenario {
    let text = embedded::scenario(name).unwrap();
    Scenario::read(
        &Source::new(format!("scenarios/{name}.ron"), text),
        &default_system(),
        &[],
    )
    .unwrap()
}

#[test]
fn embedded_files_pass_and_are_named_after_their_files() {
    for name in embedded::names() {
        assert_eq!(scenario(name).name, name);
        assert_eq!(
            Kind::of(&Source::new(name, embedded::scenario(name).unwrap())),
            Kind::Scenario
        );
    }
    assert_eq!(
        Kind::of(&Source::new("default.ron", embedded::system())),
        Kind::System
    );
    assert_eq!(embedded::scenario("cut-off"), None);
}

#[test]
fn first_comment_tells_the_row_of_the_table() {
    for name in embedded::names() {
        let text = embedded::scenario(name).unwrap();
        assert!(
            text.starts_with(&format!("// Row \"{name}\" of the paper's table")),
            "{name}"
        );
    }
}

#[test]
fn template_passes() {
    let source = Source::new("new.ron", embedded::template());
    Scenario::read(&source, &default_system(), &[]).unwrap();
}

#[test]
fn law_shown_reads_back_equal() {
    let system = default_system();
    let shown = Source::new("default.ron", system.to_ron());
    assert_eq!(System::read(&shown, &[]).unwrap(), system);
    for name in embedded::names() {
        let scenario = scenario(name);
        let shown = Source::new(format!("{name}.ron"), scenario.to_ron());
        assert_eq!(Scenario::read(&shown, &system, &[]).unwrap(), scenario);
        assert_eq!(shown.text(), scenario.to_ron(), "shown twice, {name}");
    }
}

#[test]
fn law_a_shown_ring_reads_back_equal() {
    let text = SCENARIO.replace(
        "[Line(length_m: 1000)]",
        "[Arc(length_m: 628.32, radius_m: 100)], closed: true",
    );
    let system = texts::system();
    let ring = Scenario::read(&Source::new("ring.ron", text), &system, &[]).unwrap();
    assert_eq!(ring.road.lap(), Some(628.32));
    let shown = Source::new("ring.ron", ring.to_ron());
    assert!(shown.text().contains("closed: true"), "{}", shown.text());
    assert_eq!(Scenario::read(&shown, &system, &[]).unwrap(), ring);
    // A road that is not closed says nothing of it, written out or not.
    let open = SCENARIO.replace("1000)]", "1000)], closed: false");
    let open = Scenario::read(&Source::new("open.ron", open), &system, &[]).unwrap();
    assert!(open.road.lap().is_none() && !open.to_ron().contains("closed"));
}

/// Everything that the embedded files leave out.
const EVERYTHING: &str = r#"(
    title: "Quotes \" and \\ and ü",
    road: (lanes: 4, lane_width_m: 3.25, segments: [
        Line(length_m: 1000), Arc(length_m: 200, radius_m: -333.3), Clothoid(length_m: 50, start_curvature_per_m: -0.003, end_curvature_per_m: 0.01),
    ]),
    ego: (lane: 2, s_m: 200.1, speed_mph: 33.3),
    duration_s: 12.3456789,
    actors: [
        (name: "truck", body: Truck, lane: 1, start: At(s_m: 150), speed_mph: 30, behaviour: Follow(desired_speed_mph: 45, exponent: 3)),
        (name: "bike", body: Box(length_m: 1.8, width_m: 0.6, mass_kg: 90), lane: 4, start: Behind(gap_m: 7.7), relative_mph: 3.3,
         manoeuvres: [
            (when: Time(at_s: 0), then: ReachSpeed(speed_mph: 17.7, accel_mps2: 0.7)),
            (when: TimeToCollision(time_s: 2.2), then: Behave(behaviour: Follow(min_gap_m: 1.1))),
            (when: DistanceTo(actor: "beside", distance_m: 3), then: Behave(behaviour: HoldBeside(offset_m: -3))),
            (when: Time(at_s: 9), then: Behave(behaviour: Cruise)),
            (when: GapToEgo(gap_m: 0), then: Brake(decel_mps2: 7)),
         ]),
        (name: "beside", lane: 3, start: Beside(offset_m: -1.1), relative_mps: 0, behaviour: HoldBeside(max_decel_mps2: 5)),
    ],
)"#;

#[test]
fn law_shown_reads_back_equal_with_every_variant_and_odd_numbers() {
    let arguments = [
        "prediction=ConstantAcceleration",
        "estimator=(aggregation: Worst, grid: Fps, solver: Paper, criterion: Standstill, current_latency: Fixed(latency_ms: 137), \
         uncertainty: Track(sigmas: 2, position_m: 0.013, speed_mps: 0.035, accel_mps2: 0.47, jerk_density_m2ps5: 3), evasion: LaneChange(lateral_accel_mps2: 4.5, window_s: 3))",
        "perception.cameras.front.latency=Fixed(latency_ms: 33.3)",
        "perception.cameras.front.fov_deg=99.9",
        "perception.cameras.rear.confirm_frames=3",
        "perception.phase_share=0.25",
        "perception.latency_jitter_ms=33.3",
        "perception.drop_rate=0.015",
        "perception.phase_shift=0.125",
        "perception.cameras.rear.phase_share=0.5",
        "perception.cameras.rear.rate_hz=12.5",
        "perception.cameras.rear.noise_along_m=0.11",
        "perception.cameras.rear.noise_across_m=0.22",
        "perception.cameras.rear.noise_speed_mps=0.33",
        "perception.cameras.rear.noise_heading_rad=0.044",
        "perception.cameras.rear.miss_rate=0.055",
        "perception.cameras.rear.latency_jitter_ms=6.6",
        "perception.cameras.rear.drop_rate=0.077",
        "vehicle.max_steering_deg=33.3",
    ];
    let settings = arguments.map(|argument| Setting::parse(argument).unwrap());
    let (scenario, system) = load(
        &Source::new("all.ron", EVERYTHING),
        &Source::new("system.ron", SYSTEM),
        &settings,
    )
    .unwrap();
    let shown = (
        Source::new("all.ron", scenario.to_ron()),
        Source::new("system.ron", system.to_ron()),
    );
    assert_eq!(
        load(&shown.0, &shown.1, &[]).unwrap(),
        (scenario, system.clone())
    );
    // The rig's phase is that of the cameras that have none of their own.
    let phases = system.perception.eyes.iter().map(|eye| eye.phase);
    assert_eq!(phases.collect::<Vec<_>>(), [Some(0.25), Some(0.5)]);
    // Angles and radii come back as typed, not as 33.29999999999999.
    for typed in [
        "max_steering_deg: 33.3,",
        "fov_deg: 99.9,",
        "latency_ms: 33.3)",
        "latency_jitter_ms: 33.3,",
        "drop_rate: 0.015,",
        "position_m: 0.013,",
        "accel_mps2: 0.47,",
        "radius_m: -333.3)",
        "12.3456789,",
    ] {
        assert!(
            shown.0.text().contains(typed) || shown.1.text().contains(typed),
            "{typed}"
        );
    }
}

#[test]
fn hand_steady_start_is_the_gap_of_the_planner() {
    let text = SCENARIO
        .replace("Ahead(gap_m: 30)", "Steady")
        .replace("speed_mps: 20", "speed_mph: 40");
    let scenario = Scenario::read(&Source::new("steady.ron", text), &texts::system(), &[]).unwrap();
    // s0 + T v = 3 m + 1 s * 17.8816 m/s.
    let Place::Ahead(gap) = scenario.actors[0].start.along else {
        panic!("{scenario:?}")
    };
    assert!((gap - 20.8816).abs() < 1e-12, "{gap}");
    assert!((scenario.ego.speed - 17.8816).abs() < 1e-12);
}

#[test]
fn hand_line_ends_and_byte_order_mark_of_other_editors() {
    let read =
        |text: &str| Scenario::read(&Source::new("lead.ron", text), &texts::system(), &[]).unwrap();
    let foreign = format!("\u{feff}{}// end", SCENARIO.replace('\n', "\r\n"));
    assert_eq!(read(&foreign), read(SCENARIO));
}
