//! Lane changes that their actor is too slow for.

use crate::texts;
use zhuyi_scenario::{Rule, Scenario, Source};

/// What is said of an actor with this motion and these manoeuvres; none where it passes.
fn told(motion: &str, manoeuvres: &str) -> Option<(usize, String)> {
    let text = format!(
        "(title: \"t\", road: (lanes: 3, lane_width_m: 3.5, segments: [Line(length_m: 1000)]),\n\
         ego: (lane: 2, s_m: 100, speed_mps: 20), duration_s: 30, actors: [\n\
         (name: \"a\", lane: 1, start: Ahead(gap_m: 60), {motion}, manoeuvres: [\n{manoeuvres}])])"
    );
    let source = Source::new("scenario.ron", text);
    let invalid = Scenario::read(&source, &texts::system(), &[]).err()?;
    let [violation] = invalid.violations() else {
        panic!("{invalid}");
    };
    assert!(matches!(violation.rule(), Rule::Between(_)), "{invalid}");
    Some((violation.line_column().0, violation.rule().to_string()))
}

const CHANGE: &str = "(when: GapToEgo(gap_m: 45), then: ChangeLane(lane: 2, duration_s: 2.5)),";

/// A pedestrian at a standstill was told to cross, and never moved.
#[test]
fn regress_a_lane_change_of_an_actor_that_stands_is_refused() {
    let stands = Some((
        4,
        "the actor stands: below 5 m/s a lane change goes by the way, and this one never moves"
            .to_string(),
    ));
    assert_eq!(told("speed_mps: 0", CHANGE), stands);
    let brakes = format!("(when: Time(at_s: 1), then: Brake(decel_mps2: 3)), {CHANGE}");
    assert_eq!(told("speed_mps: 0", &brakes), stands);
    // 8 m/s at 4 m/s2 stand after 2 s, and so at 3 s.
    let stood = "(when: Time(at_s: 0), then: Brake(decel_mps2: 4)),\n\
                 (when: Time(at_s: 3), then: ChangeLane(lane: 2, duration_s: 2.5))";
    assert_eq!(
        told("speed_mps: 8", stood).map(|(line, told)| (line - 1, told)),
        stands
    );
}

/// 2 m/s take 5 / 2 times as long.
#[test]
fn hand_a_lane_change_of_a_slow_actor_is_refused_with_the_time_it_takes() {
    let slow = |takes: &str| {
        let told = format!(
            "at 2 m/s a lane change of 2.5 s takes {takes} s: below 5 m/s it goes by the way"
        );
        Some((4, told))
    };
    assert_eq!(told("speed_mps: 2", CHANGE), slow("6.25"));
    // It may have sped up before: 2 m/s is then the most.
    let slower = format!(
        "(when: GapToEgo(gap_m: 50), then: ReachSpeed(speed_mps: 2, accel_mps2: 1)), {CHANGE}"
    );
    assert_eq!(told("speed_mps: 1", &slower), slow("6.25"));
}

#[test]
fn hand_what_a_script_does_not_tell_is_not_refused() {
    for motion in [
        "speed_mps: 5",
        "speed_mps: 2, behaviour: Follow(desired_speed_mps: 20)",
        "speed_mps: 2, behaviour: HoldBeside(offset_m: 5)",
    ] {
        assert_eq!(told(motion, CHANGE), None, "{motion}");
    }
    let faster = "(when: Time(at_s: 9), then: ReachSpeed(speed_mps: 8, accel_mps2: 1)),";
    let at_once = faster.replace("accel_mps2: 1", "accel_mps2: 6");
    let gap_faster = "(when: GapToEgo(gap_m: 9), then: ReachSpeed(speed_mps: 8, accel_mps2: 1)),";
    let change =
        |at: f64| format!("(when: Time(at_s: {at}), then: ChangeLane(lane: 2, duration_s: 2.5)),");
    let follow = "(when: Time(at_s: 1), then: Behave(behaviour: Follow(desired_speed_mps: 9))),";
    for passes in [
        // It gets going before it changes, at its change, and while it changes.
        format!("{gap_faster} {CHANGE}"),
        format!("{faster} {}", change(15.0)),
        format!("{} {at_once}", change(8.0)),
        format!("{CHANGE} {gap_faster}"),
        format!("{follow} {}", change(3.0)),
    ] {
        assert_eq!(told("speed_mps: 0", &passes), None, "{passes}");
    }
    // A car that brakes to a stop half-way across is a scene of its own.
    let halts = format!("{CHANGE} (when: Time(at_s: 1), then: Brake(decel_mps2: 8))");
    assert_eq!(told("speed_mps: 8", &halts), None);
    // So is a slow one that is told to stop on the way, but not one that stands from the start.
    let stops = format!(
        "{} (when: Time(at_s: 1.5), then: Brake(decel_mps2: 8))",
        change(0.5)
    );
    assert_eq!(told("speed_mps: 4", &stops), None);
    assert!(told("speed_mps: 0", &stops).is_some());
    // In the time that it takes, not the one that it is given, and where a trigger does not tell when.
    let late = format!(
        "{} (when: Time(at_s: 3.2), then: ReachSpeed(speed_mps: 0, accel_mps2: 4))",
        change(0.5)
    );
    assert_eq!(told("speed_mps: 4", &late), None);
    let some_time = format!("{CHANGE} (when: GapToEgo(gap_m: 20), then: Brake(decel_mps2: 8))");
    assert_eq!(told("speed_mps: 4", &some_time), None);
    let later = format!(
        "{} (when: Time(at_s: 4), then: Brake(decel_mps2: 8))",
        change(0.5)
    );
    assert!(told("speed_mps: 4", &later).is_some());
    // From 0 m/s at 9 s to 5 m/s takes until 14 s: at 10 s it is too early by half a second of a lane change of 3.5 s.
    let early = |duration: f64| {
        let change =
            format!("(when: Time(at_s: 10), then: ChangeLane(lane: 2, duration_s: {duration})),");
        told("speed_mps: 0", &format!("{faster} {change}")).map(|(_, told)| told)
    };
    let too_early =
        "at 4.5 m/s a lane change of 3.5 s takes 3.89 s: below 5 m/s it goes by the way";
    assert_eq!(early(3.5).as_deref(), Some(too_early));
    assert_eq!(early(4.5), None);
    // What begins after its end does not help.
    let late = format!("{} {faster}", change(6.5));
    assert!(told("speed_mps: 0", &late).is_some());
}
