//! Notes on a run, and contacts from behind, each by a scene of its own.

use zhuyi_core::{ActorId, FrameRates, SimTime};
use zhuyi_scenario::{Source, embedded, load};
use zhuyi_sim::notes::{Note, Subject, notes};
use zhuyi_sim::{Outcome, RunRecord, RunSpec};

/// The run of a scene at 30 FPR without jitter, and its notes.
fn run(road: &str, ego: &str, seconds: u32, actors: &str) -> (RunRecord, Vec<Note>) {
    let text = format!(
        "(title: \"t\", road: {road}, ego: {ego}, duration_s: {seconds}, actors: [{actors}])"
    );
    let settings = ["jitter.position_m=0", "jitter.speed_mps=0"]
        .map(|set| zhuyi_scenario::Setting::parse(set).unwrap_or_else(|e| panic!("{e}")));
    let system = Source::new("default.ron", embedded::system());
    let (scenario, system) = load(&Source::new("scene", text), &system, &settings)
        .unwrap_or_else(|invalid| panic!("{invalid}"));
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let run = RunSpec::new(scenario.clone(), system.clone())
        .at_rates(rates.clone())
        .run_fixed();
    let notes = notes(&run.trace, &scenario.road);
    (run, notes)
}

const ROAD: &str = "(lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 3000)])";

fn near(time: SimTime, seconds: f64) -> bool {
    (time.seconds() - seconds).abs() < 0.011
}

/// `fast` at 20 m/s drives through `slow` at 10 m/s: 40 - 4.6 m apart bumper to bumper, their boxes of 4.6 m overlap from
/// 35.4 / 10 = 3.54 s to 44.6 / 10 = 4.46 s.
#[test]
fn regress_actors_that_drive_through_each_other_are_noted() {
    let actors = "(name: \"slow\", lane: 1, start: At(s_m: 200), speed_mps: 10),\
                  (name: \"fast\", lane: 1, start: At(s_m: 160), speed_mps: 20)";
    let ego = "(lane: 2, s_m: 100, speed_mps: 20)";
    let (run, notes) = run(ROAD, ego, 8, actors);
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert_eq!(notes[0].subject, Subject::Through(ActorId(0), ActorId(1)));
    assert!(
        near(notes[0].from, 3.54) && near(notes[0].until, 4.46),
        "{notes:?}"
    );
    let text = notes[0].text(run.trace.names());
    assert!(
        text.starts_with("`slow` and `fast` drive through each other from 3.5"),
        "{text}"
    );
}

/// The ego at 20 m/s, 2.4 m long ahead of its centre, passes the end of 200 m at (200 - 102.4) / 20 = 4.88 s; an actor that begins
/// 20 m ahead (centres 24.7 m) 1.235 s before, less what it is shorter.
#[test]
fn regress_the_end_of_the_road_is_noted() {
    let road = "(lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 200)])";
    let actor = "(name: \"a\", lane: 1, start: Ahead(gap_m: 20), speed_mps: 20)";
    let (_, notes) = run(road, "(lane: 2, s_m: 100, speed_mps: 20)", 6, actor);
    let subjects: Vec<Subject> = notes.iter().map(|note| note.subject).collect();
    let actor = Subject::PastEnd(Some(ActorId(0)));
    assert_eq!(subjects, [actor, Subject::PastEnd(None)]);
    let half = 2.3;
    assert!(
        near(notes[0].from, (200.0 - 124.7 - half) / 20.0),
        "{notes:?}"
    );
    assert!(near(notes[1].from, 4.88), "{notes:?}");
    assert!(near(notes[1].until, 5.99), "{notes:?}");
}

/// A car that turns back from a fast lane change passes its lane and the edge of the road, and is noted; one that keeps its lane is
/// not.
#[test]
fn hand_who_leaves_the_road_sideways_is_noted() {
    let actor = |changes: &str| {
        format!(
            "(name: \"a\", lane: 1, start: Ahead(gap_m: 60), speed_mps: 20, manoeuvres: [{changes}])"
        )
    };
    let ego = "(lane: 1, s_m: 100, speed_mps: 10)";
    let left = "(when: Time(at_s: 1), then: ChangeLane(lane: 2, duration_s: 1)),";
    let back = "(when: Time(at_s: 1.5), then: ChangeLane(lane: 1, duration_s: 4)),";
    let (_, kept) = run(ROAD, ego, 8, &actor(left));
    assert_eq!(kept, []);
    let (run, notes) = run(ROAD, ego, 8, &actor(&format!("{left}{back}")));
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert_eq!(notes[0].subject, Subject::OffRoad(Some(ActorId(0))));
    // While it is noted, and only then, half of its width of 1.85 m and its turn reach beyond 3.5 m.
    for row in run.trace.rows() {
        let during = notes[0].from <= row.time && row.time <= notes[0].until;
        let (d, half) = (row.actors[0].road.d, 1.85 / 2.0);
        assert!(during || d + half <= 3.5, "{:?} {d}", row.time);
        assert!(!during || d + half + 0.8 > 3.5, "{:?} {d}", row.time);
    }
}

/// A follower at 20 m/s runs into the ego at 15 m/s: from behind, by an actor that the rear camera had confirmed. The ego that runs
/// into a car that stands is not struck.
#[test]
fn regress_a_contact_from_behind_is_told_apart() {
    let road = "(lanes: 1, lane_width_m: 3.5, segments: [Line(length_m: 3000)])";
    let fast = "(name: \"fast\", lane: 1, start: Behind(gap_m: 60), speed_mps: 20)";
    let collision = |run: RunRecord| match run.outcome {
        Outcome::Collision(collision) => collision,
        Outcome::Completed => panic!("no contact"),
    };
    let (struck, _) = run(road, "(lane: 1, s_m: 300, speed_mps: 15)", 30, fast);
    let struck = collision(struck);
    assert!(struck.from_behind && struck.confirmed, "{struck:?}");
    assert!((struck.time.seconds() - 12.0).abs() < 0.3, "{struck:?}");
    let wall = "(name: \"wall\", lane: 1, start: Ahead(gap_m: 3), behaviour: Obstacle)";
    let (run, _) = run(road, "(lane: 1, s_m: 300, speed_mps: 20)", 5, wall);
    assert!(!collision(run).from_behind);
}
