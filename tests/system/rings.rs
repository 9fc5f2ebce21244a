//! Closed roads.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use zhuyi_core::{FrameRates, LaneFrame};
use zhuyi_estimator::Estimator;
use zhuyi_scenario::{Scenario, Source, System, embedded, load};
use zhuyi_sim::{Hindsight, RunSpec};

use crate::{collisions, run};

fn read(text: &str) -> Result<(Scenario, System), String> {
    load(
        &Source::new("ring.ron", text),
        &Source::new("default.ron", embedded::system()),
        &[],
    )
    .map_err(|invalid| invalid.render(false))
}

/// An ego on one lane of a ring of 100 m radius, or on a straight road; a car stands behind it, or as far ahead as that is
/// round the ring.
fn text(ring: bool) -> String {
    let lap = 200.0 * PI;
    let (road, start) = if ring {
        let road = format!("segments: [Arc(length_m: {lap}, radius_m: 100)], closed: true");
        (road, "Behind(gap_m: 25)".to_string())
    } else {
        let gap = lap - 25.0 - 2.0 * 4.8;
        let road = "segments: [Line(length_m: 1500)]".to_string();
        (road, format!("Ahead(gap_m: {gap})"))
    };
    format!(
        "(title: \"one lap\", road: (lanes: 1, lane_width_m: 3.5, {road}), ego: (lane: 1, s_m: 60, speed_mps: 13), \
         duration_s: 80, actors: [(name: \"parked\", lane: 1, body: Box(length_m: 4.8, width_m: 1.85, mass_kg: 1600), \
         start: {start}, behaviour: Obstacle)])"
    )
}

/// [m] gap along the road at the end of a run, which has no collision.
fn last_gap(scenario: &Scenario, system: &System, fps: u32) -> f64 {
    let run = run(scenario, system, fps, 0);
    assert!(!run.collided(), "at {fps} FPR");
    let row = run.trace.row(run.trace.len() - 1);
    assert!(row.ego.speed < 0.1, "{} m/s", row.ego.speed);
    row.actors[0].rear() - row.ego.front()
}

#[test]
fn law_a_car_one_lap_ahead_is_braked_for_as_on_a_straight_road() {
    let (ring, system) = read(&text(true)).unwrap();
    let (straight, _) = read(&text(false)).unwrap();
    assert_eq!(system.vehicle.footprint.length, 4.8);
    for fps in [1, 2, 5, 30] {
        assert_eq!(collisions(&ring, &system, fps, 3), 0, "at {fps} FPR");
        let gaps = [&ring, &straight].map(|scenario| last_gap(scenario, &system, fps));
        assert!((gaps[0] - gaps[1]).abs() < 0.5 && gaps[0] > 1.0, "{gaps:?}");
    }
}

#[test]
fn law_a_car_one_lap_ahead_asks_for_what_it_asks_for_on_a_straight_road() {
    // Half a lap after the start the car is told in the next lap: its recorded future stays where it was, and every row asks
    // for what a look at that row alone asks for.
    let largest = [true, false].map(|ring| {
        let (scenario, system) = read(&text(ring)).unwrap();
        let run = run(&scenario, &system, 10, 0);
        let rates = FrameRates::new(vec![10.0; system.perception.eyes.len()]);
        let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, &rates);
        let estimator = Estimator::new(system.estimator.clone());
        let peaks = hindsight.peaks(&estimator);
        let mut alone = hindsight.no_peaks();
        for row in run.trace.rows() {
            let demands = hindsight.demands(&estimator, &row);
            hindsight.add(&mut alone, row.time, &demands);
        }
        assert_eq!(peaks.largest, alone.largest);
        assert_eq!(peaks.cameras, alone.cameras);
        peaks.largest
    });
    let [ring, straight] = largest;
    assert!(straight > 1.5, "{largest:?}");
    assert!((ring - straight).abs() < 0.1 * straight, "{largest:?}");
}

#[test]
fn regress_a_ring_laid_over_itself_is_refused_by_its_name() {
    let road = |segments: &str, closed: &str| {
        let road = format!("segments: [{segments}]{closed}");
        text(true).replace(
            &format!(
                "segments: [Arc(length_m: {}, radius_m: 100)], closed: true",
                200.0 * PI
            ),
            &road,
        )
    };
    let arc = "Arc(length_m: 500, radius_m: 100), ";
    for closed in ["", ", closed: true"] {
        let told = read(&road(&arc.repeat(3), closed)).unwrap_err();
        assert!(told.contains("closed"), "{told}");
    }
    let told = read(&road(&arc.repeat(3), "")).unwrap_err();
    assert!(
        told.contains("a ring is one lap with `closed: true`"),
        "{told}"
    );
    read(&road(
        "Arc(length_m: 628.32, radius_m: 100)",
        ", closed: true",
    ))
    .unwrap();
}

#[test]
fn law_laps_change_no_belief_and_no_estimate() {
    // Cars stand in the lanes beside, on a ring that the ego drives round more than three times: believed places stay close
    // to the truth, also where that is told in the next lap, and the recorded future of one that stands is one piece.
    let text = text(true)
        .replace("lanes: 1", "lanes: 3")
        .replace("lane: 1, s_m: 60", "lane: 2, s_m: 60")
        .replace("duration_s: 80", "duration_s: 160")
        .replace("start: Behind(gap_m: 25)", "start: At(s_m: 620)");
    let other = "(name: \"other\", lane: 3, start: At(s_m: 5), behaviour: Obstacle)";
    let text = text.replace(
        "behaviour: Obstacle)])",
        &format!("behaviour: Obstacle), {other}])"),
    );
    let (scenario, system) = read(&text).unwrap();
    let rates = FrameRates::new(vec![10.0; system.perception.eyes.len()]);
    let run = RunSpec::new(scenario.clone(), system.clone())
        .with_seed(1)
        .at_rates(rates.clone())
        .witnessed()
        .run_fixed();
    assert!(!run.collided());
    let (witness, lap) = (run.witness.as_ref().unwrap(), scenario.road.length());
    let mut believed = 0;
    for (place, row) in run.trace.rows().enumerate() {
        for (actor, belief) in witness.beliefs(place).iter().enumerate() {
            let truth = row.actors[actor].road.s;
            if let (true, Some(track)) = (belief.confirmed, &belief.track) {
                believed += 1;
                assert!(
                    (track.road.s - truth).abs() < 3.0,
                    "{} s",
                    row.time.seconds()
                );
            }
        }
    }
    assert!(believed > 2_000, "{believed}");
    let last = run.trace.row(run.trace.len() - 1);
    assert!(last.ego.road.s > 3.0 * lap, "{}", last.ego.road.s);
    let lane = LaneFrame::at(&scenario.road, 0.0);
    for future in zhuyi_sim::recorded::futures(&run.trace, lane) {
        assert!(future.along.len() <= 2, "{:?}", future.along);
    }
    let hindsight = Hindsight::new(&run.trace, &scenario.road, &system, &rates);
    let estimator = Estimator::new(system.estimator.clone());
    assert!(
        hindsight.peaks(&estimator).largest <= 1.0,
        "nobody is in the way"
    );
}

#[test]
fn regress_the_shared_rings() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/faults");
    let texts =
        ["b4_ring.ron", "b4_ring_straight.ron"].map(|file| fs::read_to_string(folder.join(file)));
    let [Ok(ring), Ok(straight)] = texts else {
        println!("skipped: ../shared/data/faults/b4_ring.ron is not there");
        return;
    };
    let told = read(&ring).unwrap_err();
    assert!(told.contains("`closed: true`"), "{told}");
    let arcs = "[Arc(length_m:500,radius_m:100),Arc(length_m:500,radius_m:100),Arc(length_m:500,radius_m:100)]";
    assert!(ring.contains(arcs));
    let one_lap = format!("[Arc(length_m:{},radius_m:100)],closed:true", 200.0 * PI);
    let (ring, system) = read(&ring.replace(arcs, &one_lap)).unwrap();
    let (straight, _) = read(&straight).unwrap();
    for fps in [1, 2, 30] {
        assert_eq!(collisions(&ring, &system, fps, 3), 0, "at {fps} FPR");
        assert_eq!(collisions(&straight, &system, fps, 3), 0, "at {fps} FPR");
    }
}
