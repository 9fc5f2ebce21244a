//! Which cameras an actor counts for (reading R14): those whose sector its box meets.

use std::path::Path;

use zhuyi_core::FrameRates;
use zhuyi_estimator::Estimator;
use zhuyi_log::files::actors_csv;
use zhuyi_log::{Log, Replay, evaluate};

use crate::{HEADER, rig, system};

/// The cameras of the first actor at the first time.
fn cameras(text: &str) -> String {
    let (system, log) = (system(), Log::read(text, Some("ego")).unwrap());
    let rates = FrameRates::new(vec![30.0; system.perception.eyes.len()]);
    let rig = rig(&system, &rates);
    let replay = Replay::new(&log, log.find("ego").unwrap(), None, 20.0);
    let evaluation = evaluate(&replay, &Estimator::new(system.estimator.clone()), &rig);
    let rows = actors_csv(&log, &evaluation, &rig);
    let first = rows.lines().nth(1).unwrap();
    first.rsplit(',').next().unwrap().to_owned()
}

/// A truck from 8.5 m behind to 16.5 m ahead, its flank 1.75 m to the left and 0.85 m from the left camera, whose view of 100
/// degrees ends 1 m ahead and 1 m behind there.
#[test]
fn hand_a_truck_alongside_counts_for_the_camera_that_its_flank_fills() {
    let text = format!(
        "{HEADER}0,ego,0,0,0,20,0,4.5,1.8\n0,truck,4,3,0,20,0,25,2.5\n\
         0.1,ego,2,0,0,20,0,4.5,1.8\n0.1,truck,6,3,0,20,0,25,2.5\n"
    );
    assert_eq!(cameras(&text), "front_120;front_60;left;rear");
}

/// The same truck in a recording by others: `../shared/data` beside the repository, where it exists.
#[test]
fn paper_a_truck_alongside_in_a_recording() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/faults/L16_truck.csv");
    let Ok(text) = std::fs::read_to_string(path) else {
        println!("skipped: ../shared/data/faults/L16_truck.csv is not there");
        return;
    };
    assert_eq!(cameras(&text), "front_120;front_60;left;rear");
}
