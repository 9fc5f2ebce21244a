//! Distances of a scenario, scaled: one factor on all that was free to choose in its geometry.

use zhuyi_scenario::Scenario;
use zhuyi_world::script::{Place, Trigger};

/// Returns a scenario with every distance scaled: the distances and times to collision that manoeuvres wait for, and gaps ahead at
/// the start.
pub fn scaled(scenario: &Scenario, factor: f64) -> Scenario {
    let mut scenario = scenario.clone();
    for actor in &mut scenario.actors {
        if let Place::Ahead(gap) = &mut actor.start.along {
            *gap *= factor;
        }
        for manoeuvre in &mut actor.manoeuvres {
            match &mut manoeuvre.when {
                Trigger::GapToEgo(distance) | Trigger::DistanceTo { distance, .. } => {
                    *distance *= factor;
                }
                Trigger::TimeToCollision(time) => *time *= factor,
                Trigger::Time(_) => {}
            }
        }
    }
    scenario
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Embedded;
    use zhuyi_scenario::Source;

    #[test]
    fn hand_distances_scale_and_times_stay() {
        let text = |gap: f64, near: f64, far: f64, time: f64| {
            format!(
                r#"(title: "t", road: (lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 900)]), duration_s: 30,
                ego: (lane: 1, s_m: 100, speed_mps: 20), actors: [
                    (name: "other", lane: 2, start: Beside(offset_m: 3), speed_mps: 20),
                    (name: "lead", lane: 1, start: Ahead(gap_m: {gap}), speed_mps: 10, manoeuvres: [
                        (when: Time(at_s: 2), then: Brake(decel_mps2: 2)),
                        (when: GapToEgo(gap_m: {near}), then: Brake(decel_mps2: 3)),
                        (when: DistanceTo(actor: "other", distance_m: {far}), then: Brake(decel_mps2: 4)),
                        (when: TimeToCollision(time_s: {time}), then: Brake(decel_mps2: 5)),
                    ]),
                ])"#
            )
        };
        let system = Embedded::new(&[]).system;
        let read =
            |text: String| Scenario::read(&Source::new("x.ron", text), &system, &[]).unwrap();
        let expected = read(text(60.0, 15.0, 30.0, 3.0));
        assert_eq!(scaled(&read(text(40.0, 10.0, 20.0, 2.0)), 1.5), expected);
    }
}
