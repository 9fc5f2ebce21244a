//! Each stage, replaced from outside, changes a result as predicted.

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.

use std::sync::{Arc, Mutex};

use zhuyi::prelude::*;
use zhuyi::stages::{Policy, PolicyError, Sensor, Situation, Truth};
use zhuyi_outside::observer::Rows;
use zhuyi_outside::planner::Timid;
use zhuyi_outside::policy::Nearest;
use zhuyi_outside::radar::Radar;
use zhuyi_outside::safety_model::HalfSecond;
use zhuyi_outside::tracker::Credulous;

fn spec(name: &str, settings: &[&str]) -> RunSpec {
    let settings = settings.iter().map(|set| Setting::parse(set));
    let settings: Vec<Setting> = settings.collect::<Result<_, _>>().expect("settings");
    let text = embedded::scenario(name).expect("an embedded scenario");
    let source = Source::new(format!("{name}.ron"), text);
    let system = Source::new("default.ron", embedded::system());
    let (scenario, system) = load(&source, &system, &settings).expect("a valid scenario");
    RunSpec::new(scenario, system)
}

/// [s] the step from which on an actor is tracked.
fn tracked_from(spec: RunSpec, name: &str) -> Option<f64> {
    let actors = spec.scenario().actors.iter();
    let place = actors.enumerate().find(|(_, actor)| actor.name == name);
    let (place, _) = place.expect("an actor of the scenario");
    let record = spec.witnessed().run().expect("rates that stay");
    let witness = record.witness.as_ref().expect("it was asked for");
    let known = |row: &usize| witness.beliefs(*row)[place].confirmed;
    let first = (0..record.trace.len()).find(known);
    first.map(|row| record.trace.row(row).time.seconds())
}

/// The lead brakes from 3 s on to a standstill, behind which the built-in planner stops. One that brakes for whatever is ahead from v
/// at b stands after v / b, a little later for the lag of its brakes.
#[test]
fn hand_a_timid_planner_stops_the_ego() {
    let spec = spec("vehicle-following", &["ego.speed_mps=24"]).at_rate(30.0);
    let stands = |record: &RunRecord| {
        let mut rows = record.trace.rows();
        let row = rows.find(|row| row.ego.speed == 0.0);
        row.map(|row| row.time.seconds())
    };
    let built_in = spec.clone().run().expect("rates that stay");
    assert!(stands(&built_in).is_some_and(|time| time > 10.0));
    let timid = spec.with_planner(|_| Timid { decel: 3.0 }).run();
    let time = stands(&timid.expect("rates that stay")).expect("it stops");
    assert!((8.0..8.6).contains(&time), "{time}");
}

/// K frames confirm, one is enough at first sight: K - 1 = 4 frames earlier at 5 FPR, 0.8 s.
#[test]
fn hand_a_credulous_tracker_knows_the_obstacle_four_frames_earlier() {
    let spec = spec("cut-out-fast", &["perception.miss_rate=0"]).at_rate(5.0);
    let built_in = tracked_from(spec.clone(), "obstacle").expect("it is confirmed");
    let credulous = spec.with_tracker(|_| Credulous::default());
    let credulous = tracked_from(credulous, "obstacle").expect("it is seen");
    let earlier = built_in - credulous;
    assert!((0.79..=0.81).contains(&earlier), "{built_in} {credulous}");
}

/// The obstacle is hidden behind the lead up to the cut-out; a radar knows it as soon as it is in range and five frames have shown it.
/// At 3 FPR that saves the ego.
#[test]
fn hand_a_radar_sees_the_obstacle_behind_the_lead() {
    let spec = spec("cut-out-fast", &[]).at_rate(3.0);
    let place = |name: &str| {
        let actors = spec.scenario().actors.iter();
        actors.enumerate().find(|(_, actor)| actor.name == name)
    };
    let (obstacle, _) = place("obstacle").expect("an obstacle");
    let with_radar = spec
        .clone()
        .with_sensor(CameraId(0), |_| Radar { range: 120.0 });
    let (seen, cameras) = (
        tracked_from(with_radar.clone(), "obstacle").expect("it comes into range"),
        tracked_from(spec.clone(), "obstacle"),
    );
    assert!(
        cameras.is_none_or(|time| time > seen + 1.0),
        "{cameras:?} {seen}"
    );
    let record = with_radar.run().expect("rates that stay");
    let mut rows = record.trace.rows();
    let in_range = rows.find(|row| row.actors[obstacle].road.s - row.ego.road.s <= 120.0);
    let since = seen - in_range.expect("it comes into range").time.seconds();
    // Up to a period to the first frame, four more, and the latency of one: 5 to 6 periods.
    assert!((5.0 / 3.0 - 0.02..=2.02).contains(&since), "{since}");
    assert!(!record.collided());
    assert!(spec.run().expect("rates that stay").collided());
}

/// Finds what another sensor does, backwards and twice, and somebody who is not there.
struct Babbling(Radar);

impl Sensor for Babbling {
    fn sense(&mut self, truth: &dyn Truth, detections: &mut Vec<Detection>) {
        self.0.sense(truth, detections);
        detections.reverse();
        detections.extend_from_within(..);
        let ghost = detections.first().copied();
        detections.extend(ghost.map(|found| Detection {
            actor: ActorId(99),
            ..found
        }));
    }
}

/// The order in which a sensor tells does not matter, nor do repetitions and actors that there are not.
#[test]
fn law_a_sensor_may_tell_in_any_order() {
    let spec = spec("cut-out-fast", &[]).at_rate(6.0);
    let radar = || Radar { range: 120.0 };
    let plain = spec.clone().with_sensor(CameraId(0), move |_| radar());
    let babbling = spec.with_sensor(CameraId(0), move |_| Babbling(radar()));
    let (plain, babbling) = (plain.run_fixed(), babbling.run_fixed());
    assert!(plain.trace == babbling.trace);
}

/// In vehicle-following the lead is nearest throughout: the first camera, which looks ahead, gets what the floors of the others leave.
#[test]
fn hand_a_policy_by_tracks_gives_all_to_the_camera_before_the_nearest() {
    let spec = spec("vehicle-following", &[]);
    let spec = spec.under(Arc::new(|| Box::new(Nearest)), 20.0);
    let record = spec.expect("a budget").run().expect("an answer");
    assert_eq!(record.decisions.len(), 300);
    for decision in &record.decisions {
        assert_eq!(decision.granted, [16.0, 1.0, 1.0, 1.0, 1.0]);
        // It looks at no demands: beside the paper's, on which alarms depend, none are computed.
        let models = decision.by_model.iter().map(|of| of.model.as_str());
        assert_eq!(models.collect::<Vec<_>>(), ["zhuyi"]);
    }
}

/// A row per step of 10 ms, with what the trace holds.
#[test]
fn hand_an_observer_writes_a_row_per_step() {
    let text = Arc::new(Mutex::new(String::new()));
    let rows = text.clone();
    let spec = spec("cut-in", &["duration_s=3"]).at_rate(10.0);
    let spec = spec.with_observer(move |_| Rows(rows.clone()));
    let record = spec.run().expect("rates that stay");
    let text = text.lock().expect("nobody panics").clone();
    assert_eq!(text.lines().count(), 300);
    for (line, row) in text.lines().zip(record.trace.rows()) {
        let fields: Vec<f64> = line
            .split(',')
            .map(|field| field.parse().unwrap())
            .collect();
        let [time, speed, actors, tracks, accel] = fields[..] else {
            panic!("{line}")
        };
        assert_eq!((time, speed), (row.time.seconds(), row.ego.speed));
        assert_eq!(
            (actors, accel),
            (row.actors.len() as f64, row.command.accel)
        );
        assert!(tracks <= actors);
    }
}

/// Demand first by the demands of `half-second`.
struct ByHalfSecond;

impl Policy for ByHalfSecond {
    fn name(&self) -> &'static str {
        "by-half-second"
    }

    fn demand_models(&self) -> &[&str] {
        &["half-second"]
    }

    fn decide(&mut self, situation: &Situation<'_>, rates: &mut [f64]) -> Result<(), PolicyError> {
        rates.copy_from_slice(situation.demands("half-second")?);
        Ok(())
    }
}

/// Half a second is l = (0.5 + 5/30) / 6 = 0.111 s with l_0 = 1/30 s and K = 5; the next lower latency of the grid is 1/10 s or
/// above.
#[test]
fn hand_a_safety_model_is_a_demand_model() {
    let spec = spec("vehicle-following", &["duration_s=4"]);
    let spec = spec.under(Arc::new(|| Box::new(ByHalfSecond)), 60.0);
    let spec = spec.expect("a budget");
    let record = spec.clone().with_safety_model(|_| HalfSecond).run();
    let record = record.expect("an answer");
    let ahead = record.decisions[0].granted[0];
    assert!((9.0..=10.0).contains(&ahead), "{ahead}");
    for decision in &record.decisions {
        let [zhuyi, half_second] = &decision.by_model[..] else {
            panic!("{decision:?}")
        };
        assert_eq!(
            (&*zhuyi.model, &*half_second.model),
            ("zhuyi", "half-second")
        );
        assert_eq!(decision.granted, half_second.of_cameras);
        // Whom a camera covers: 1 FPR without anybody.
        assert!(
            decision
                .granted
                .iter()
                .all(|rate| *rate == 1.0 || *rate == ahead)
        );
    }
    let unknown = spec.run().expect_err("there is no such model").to_string();
    assert_eq!(
        unknown,
        "vehicle-following, seed 0, at 0.000 s: the run has no demands by `half-second`; it has those by zhuyi"
    );
}
