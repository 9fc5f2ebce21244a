//! Recordings, from the text of a trace to the answers.
//!
//! | file | what it shows |
//! |---|---|
//! | `across` | boxes that stand or move across the path |
//! | `bad_rows` | every rule for traces: line, column, reason |
//! | `coverage` | which cameras an actor counts for |
//! | `cuts` | rows before t_0 change no answer |
//! | `laws` | what changes no answer: the place, the direction and the handedness of the world, the cutting into steps |
//! | `plain` | the same questions asked one by one, in the plainest way |
//! | `standing` | an ego that stands: its state, and the heading that bends nothing |
//! | `on_roads` | places on hairpins and rings |
//! | `recordings` | real traffic, every vehicle as the ego, and the figures of the crate's page |

#![allow(clippy::disallowed_methods)] // Of the standard library: no result depends on these.
#![expect(clippy::unwrap_used, reason = "a test may")]

mod across;
mod bad_rows;
mod coverage;
mod cuts;
mod laws;
mod on_roads;
mod plain;
mod recordings;
mod standing;

use std::fmt::Write;
use zhuyi_core::FrameRates;
use zhuyi_estimator::Watch;
use zhuyi_scenario::{Source, System, embedded};

/// The columns of a trace.
const HEADER: &str = "time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n";

/// The car and cameras that come with the program.
fn system() -> System {
    System::read(&Source::new("default.ron", embedded::system()), &[]).unwrap()
}

/// Its cameras at these rates.
fn rig<'a>(system: &'a System, rates: &FrameRates) -> Vec<Watch<'a>> {
    let eyes = system.perception.eyes.iter().zip(rates.all());
    eyes.map(|(eye, hz)| Watch {
        camera: &eye.camera,
        current_latency: 1.0 / hz,
    })
    .collect()
}

/// One row of a trace, as exact as a number can be.
fn row(text: &mut String, time: f64, id: &str, numbers: [f64; 5]) {
    let [x, y, heading, speed, accel] = numbers;
    writeln!(
        text,
        "{time:?},{id},{x:?},{y:?},{heading:?},{speed:?},{accel:?},4.6,1.9"
    )
    .unwrap();
}

/// Says that a file beside the repository is missing.
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn skipped(file: &str) {
    println!("skipped: ../shared/data/{file} is not there");
}
