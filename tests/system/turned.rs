//! Boxes that stand askew, and lanes in bends: what a run does with them and says of them.
//!
//! Beside each scene of our own its shared counterpart runs where `../shared/data/faults` is there.

use std::fs;
use std::path::Path;

use zhuyi_core::boxes::distance;
use zhuyi_core::{LaneFrame, Road};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Hindsight, RunRecord};

use crate::{collisions, run};

fn read(text: &str) -> (Scenario, System) {
    load(
        &Source::new("turned.ron", text),
        &Source::new("default.ron", embedded::system()),
        &[],
    )
    .unwrap_or_else(|invalid| panic!("{}", invalid.render(false)))
}

/// A scene of our own, and the shared one of this name where it is there.
fn scenes(own: &str, shared: &str) -> Vec<(Scenario, System)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../shared/data/faults")
        .join(shared);
    let shared_text = fs::read_to_string(&path).ok();
    if shared_text.is_none() {
        println!("skipped: ../shared/data/faults/{shared} is not there");
    }
    let texts = [Some(own.to_string()), shared_text].into_iter().flatten();
    texts.map(|text| read(&text)).collect()
}

/// A lorry begins to change into the ego's lane, stops at once and stands askew across it.
fn lorry(length: f64, gap: f64, ego: f64, speed: f64, brake: (f64, f64)) -> String {
    format!(
        "(title: \"askew\", road: (lanes: 2, lane_width_m: 3.5, segments: [Line(length_m: 3000)]),\n\
         ego: (lane: 2, s_m: 100, speed_mps: {ego}), duration_s: 20, actors: [(name: \"lorry\",\n\
         body: Box(length_m: {length}, width_m: 2.5, mass_kg: 16000), lane: 1, start: Ahead(gap_m: {gap}), speed_mps: {speed},\n\
         manoeuvres: [(when: Time(at_s: 0.5), then: ChangeLane(lane: 2, duration_s: 2)),\n\
         (when: Time(at_s: {}), then: Brake(decel_mps2: {}))])])",
        brake.0, brake.1
    )
}

/// [m] the least distance of the boxes of the ego and of an actor over all rows.
fn least_distance(run: &RunRecord) -> f64 {
    let of_row = |row: zhuyi_sim::trace::Row<'_>| {
        let ego = (row.ego.footprint, row.ego.pose);
        let distances = row
            .actors
            .iter()
            .map(move |a| distance(ego, (a.footprint, a.pose)));
        distances.fold(f64::INFINITY, f64::min)
    };
    run.trace.rows().map(of_row).fold(f64::INFINITY, f64::min)
}

/// A lorry that has stood askew across the lane in full sight for seconds used to be hit at every rate, with nothing asked.
#[test]
fn regress_a_lorry_that_stands_askew_is_braked_for() {
    let own = lorry(13.0, 75.0, 15.0, 5.5, (0.7, 6.0));
    for (scenario, system) in scenes(&own, "i2_askew_12.ron") {
        for fps in [1, 2, 30] {
            assert_eq!(collisions(&scenario, &system, fps, 5), 0, "{fps} FPR");
        }
        let run = run(&scenario, &system, 30, 0);
        let rates = zhuyi_core::FrameRates::new(vec![30.0; system.perception.eyes.len()]);
        let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, &rates);
        let peaks = hindsight.peaks(&Estimator::new(system.estimator.clone()));
        assert!(peaks.largest > 2.0, "{peaks:?}");
        assert_eq!(peaks.cameras[0].actor.map(|actor| actor.0), Some(0));
        let extremes = run.extremes(&scenario.road);
        assert!(
            extremes
                .time_to_collision
                .is_some_and(|ttc| ttc > 0.5 && ttc < 5.0)
        );
        assert!(extremes.gap.is_some_and(|gap| gap > 1.0), "{extremes:?}");
    }
}

/// The ego comes to rest beside the rear of a long lorry whose front stands in its lane: metres from it, where half a length
/// back from its middle it would seem to touch.
#[test]
fn regress_the_smallest_gap_is_the_least_distance_of_the_boxes() {
    let own = lorry(24.0, 62.0, 20.0, 4.2, (1.5, 8.0));
    for (scenario, system) in scenes(&own, "i1_stopped_across.ron") {
        let run = run(&scenario, &system, 30, 0);
        assert!(!run.collided());
        let (least, told) = (least_distance(&run), run.extremes(&scenario.road));
        assert!(least > 1.0, "{least}");
        assert!((told.gap.unwrap() - least).abs() < 1e-9, "{told:?} {least}");
        assert!(told.time_to_collision.unwrap() > 0.3, "{told:?}");
    }
}

#[test]
fn hand_a_contact_has_a_smallest_gap_of_0() {
    let (scenario, system) = crate::read("cut-out-fast", &[]);
    let run = run(&scenario, &system, 1, 0);
    assert!(run.collided());
    assert_eq!(run.extremes(&scenario.road).gap, Some(0.0));
}

/// A car stands 40 m ahead by the reference line in a bend of 20 m radius. Along the lanes, 23.5, 20 and 16.5 m from its
/// centre, the middles are 44.8 m and ∓ 44.8/20 x 3.5 = 7.84 m apart: less 4.8 m, gaps of 47.84, 40 and 32.16 m. An ego at
/// 8 m/s along its lane has 5.98, 5.00 and 4.02 s.
#[test]
fn regress_gaps_in_a_bend_are_those_along_the_lane() {
    for (lane, ttc) in [(1, 5.98), (2, 5.00), (3, 4.02)] {
        let own = format!(
            "(title: \"bend\", road: (lanes: 3, lane_width_m: 3.5,\n\
             segments: [Line(length_m: 20), Arc(length_m: 62, radius_m: 20), Line(length_m: 200)]),\n\
             ego: (lane: {lane}, s_m: 25, speed_mps: 8), duration_s: 12,\n\
             actors: [(name: \"parked\", lane: {lane}, start: Ahead(gap_m: 40), behaviour: Obstacle)])"
        );
        let shared = format!("h2_tight_lane{lane}.ron");
        for (scenario, system) in scenes(&own, &shared) {
            let run = run(&scenario, &system, 30, 0);
            assert!(!run.collided());
            let row = run.trace.row(0);
            let frame = LaneFrame::at(&scenario.road, row.ego.road.d);
            let (ego, car) = (frame.body(row.ego), frame.body(&row.actors[0]));
            let found = (car.rear() - ego.front()) / ego.s_rate;
            // The car starts up to 0.5 m off.
            assert!((found - ttc).abs() < 0.6 / 8.0, "lane {lane}: {found}");
            assert!((ego.s_rate - 8.0).abs() < 1e-9);
            comes_to_rest_behind(&run, &scenario.road);
        }
    }
}

/// The gap at the end is that which hard braking keeps, 2.5 m, whatever the lane.
fn comes_to_rest_behind(run: &RunRecord, road: &Road) {
    let last = run.trace.row(run.trace.len() - 1);
    assert!(last.ego.speed < 0.1, "{:?}", last.ego);
    let frame = LaneFrame::at(road, last.ego.road.d);
    let gap = frame.body(&last.actors[0]).rear() - frame.body(last.ego).front();
    assert!((gap - 2.5).abs() < 0.4, "{gap}");
}
