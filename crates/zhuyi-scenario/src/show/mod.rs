//! From meaning back to text: everything in the open that a file may leave to defaults.
//!
//! What is written reads back as the equal value: speeds and gaps in SI, other units by a number that converts exactly.

mod scenario;
mod system;
mod value;

use crate::model::{Scenario, System};
use value::Value;

impl Scenario {
    /// Its file, with nothing left to defaults and the gap that `Steady` stood for.
    pub fn to_ron(&self) -> String {
        scenario::scenario(self).to_string()
    }
}

impl System {
    /// Its file, with nothing left to defaults.
    pub fn to_ron(&self) -> String {
        system::system(self).to_string()
    }
}

/// A number in the unit of the file that `to_si` makes exactly `meant` of, with as few digits as do, near `guess`.
/// Where there is none, as for a value that no file gave, `guess`.
fn number_for(meant: f64, guess: f64, to_si: impl Fn(f64) -> f64) -> Value {
    let short = (0..=16).filter_map(|digits| format!("{guess:.digits$e}").parse().ok());
    let near = [
        guess.next_up(),
        guess.next_down(),
        guess.next_up().next_up(),
        guess.next_down().next_down(),
    ];
    Value::Number(
        short
            .chain(near)
            .find(|number| to_si(*number) == meant)
            .unwrap_or(guess),
    )
}

/// An angle in degrees.
fn degrees(angle: f64) -> Value {
    number_for(angle, angle.to_degrees(), f64::to_radians)
}
