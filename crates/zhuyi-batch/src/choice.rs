//! One free choice at a time: a scenario and a system of which one thing is chosen otherwise.
//!
//! A choice is any value of the scenario or the system file by its path, or one of two that no single value of a file is:
//!
//! | name | values | what |
//! |---|---|---|
//! | `distances` | a factor | every gap, distance and time to collision that a manoeuvre waits for, and every gap ahead at the start |
//! | `second_front_camera` | `true`, `false` | `false` takes away every camera that is not analysed and looks the way of one that is |

use zhuyi_scenario::{Invalid, Scenario, Setting, Source, System, load};

use crate::distances::scaled;
use crate::rates::group;

/// The name of the factor on distances.
pub const DISTANCES: &str = "distances";
/// The name of the choice whether there is a second camera to the front.
pub const SECOND_FRONT_CAMERA: &str = "second_front_camera";

/// What is chosen from: scenarios and a system as they are read.
#[derive(Clone, Debug)]
pub struct Bench {
    /// The scenarios.
    pub scenarios: Vec<Source>,
    /// The system.
    pub system: Source,
    /// What is set whatever is chosen.
    pub settings: Vec<Setting>,
}

/// A choice with its values, as typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// A path, [`DISTANCES`] or [`SECOND_FRONT_CAMERA`].
    pub path: String,
    /// As RON.
    pub values: Vec<String>,
}

/// What a choice makes of a scenario and the system.
pub type Chosen = (Scenario, System);

/// A value that cannot be chosen.
#[derive(Debug)]
pub struct Refusal {
    /// Of which choice.
    pub path: String,
    /// As typed.
    pub value: String,
    /// Why.
    pub why: Refused,
}

/// Why a value cannot be chosen.
#[derive(Debug)]
pub enum Refused {
    /// What the reader of the files says.
    Reader(Invalid),
    /// What the value should be.
    Value(&'static str),
}

/// Whether a name is one of those that are no path.
pub fn is_named(path: &str) -> bool {
    [DISTANCES, SECOND_FRONT_CAMERA].contains(&path)
}

impl Bench {
    /// A scenario and the system with a value chosen.
    ///
    /// # Errors
    /// When there is no such value, or the files do not allow it.
    pub fn choose(&self, scenario: usize, path: &str, value: &str) -> Result<Chosen, Refused> {
        let mut settings = self.settings.clone();
        if !is_named(path) {
            let setting = Setting::parse_as("--vary", &format!("{path}={value}"));
            settings.push(setting.map_err(Refused::Reader)?);
        }
        let read = load(&self.scenarios[scenario], &self.system, &settings);
        let (mut scenario, mut system) = read.map_err(Refused::Reader)?;
        match path {
            DISTANCES => {
                let factor = value
                    .parse()
                    .ok()
                    .filter(|factor| (0.1..=10.0).contains(factor));
                let factor = factor.ok_or(Refused::Value("a factor from 0.1 to 10"))?;
                scenario = scaled(&scenario, factor);
            }
            SECOND_FRONT_CAMERA => match value {
                "true" => (),
                "false" => system = without_second_cameras(system),
                _ => return Err(Refused::Value("`true` or `false`")),
            },
            _ => (),
        }
        Ok((scenario, system))
    }

    /// All values of all choices: for each choice, of each scenario, in their order.
    ///
    /// # Errors
    /// All that are refused.
    pub fn choose_all(&self, choices: &[Choice]) -> Result<Vec<Vec<Chosen>>, Vec<Refusal>> {
        let (mut all, mut refused) = (Vec::new(), Vec::new());
        for Choice { path, values } in choices {
            for scenario in 0..self.scenarios.len() {
                let mut chosen = Vec::with_capacity(values.len());
                for value in values {
                    match self.choose(scenario, path, value) {
                        Ok(one) => chosen.push(one),
                        Err(why) => refused.push(Refusal {
                            path: path.clone(),
                            value: value.clone(),
                            why,
                        }),
                    }
                }
                all.push(chosen);
            }
        }
        if refused.is_empty() {
            Ok(all)
        } else {
            Err(refused)
        }
    }
}

/// Without the cameras that are not analysed and look the way of one that is.
fn without_second_cameras(mut system: System) -> System {
    let eyes = &system.perception.eyes;
    let leads = |name: &str| {
        let mut analysed = eyes.iter().filter(|eye| eye.camera.analysed);
        analysed.any(|eye| group(&eye.camera.name) == group(name))
    };
    let stays: Vec<bool> = eyes
        .iter()
        .map(|eye| eye.camera.analysed || !leads(&eye.camera.name))
        .collect();
    let mut places = stays.iter();
    system
        .perception
        .eyes
        .retain(|_| places.next() == Some(&true));
    let rates = system.default_rates.all().iter().zip(&stays);
    let rates = rates.filter(|(_, stays)| **stays).map(|(rate, _)| *rate);
    system.default_rates = zhuyi_core::FrameRates::new(rates.collect());
    system
}

#[cfg(test)]
mod tests {
    use super::*;
    use zhuyi_scenario::embedded;

    fn bench() -> Bench {
        let text = embedded::scenario("cut-out-fast").unwrap();
        Bench {
            scenarios: vec![Source::new("cut-out-fast.ron", text)],
            system: Source::new("default.ron", embedded::system()),
            settings: vec![Setting::parse("duration_s=5").unwrap()],
        }
    }

    #[test]
    fn hand_a_path_a_factor_and_a_camera_are_chosen() {
        let bench = bench();
        let (as_it_is, system) = bench.choose(0, DISTANCES, "1").unwrap();
        assert_eq!(as_it_is.duration.seconds(), 5.0);
        let (same, other) = bench.choose(0, "planner.min_gap_m", "2.5").unwrap();
        // What starts at the planner's steady gap starts elsewhere.
        assert!(same != as_it_is && other.planner.min_gap == 2.5);
        let (farther, same) = bench.choose(0, DISTANCES, "1.5").unwrap();
        assert!(farther != as_it_is && same == system);
        let (same, one) = bench.choose(0, SECOND_FRONT_CAMERA, "false").unwrap();
        let names: Vec<&str> = (one.perception.eyes.iter())
            .map(|eye| eye.camera.name.as_str())
            .collect();
        assert_eq!(names, ["front_120", "left", "right", "rear"]);
        assert_eq!((same, one.default_rates.all().len()), (as_it_is, 4));
    }

    #[test]
    fn hand_what_cannot_be_chosen_is_refused() {
        let bench = bench();
        for (path, value) in [
            (DISTANCES, "0"),
            (DISTANCES, "x"),
            (SECOND_FRONT_CAMERA, "1"),
        ] {
            assert!(matches!(
                bench.choose(0, path, value),
                Err(Refused::Value(_))
            ));
        }
        for (path, value) in [("perception.drop_rate", "2"), ("perception.drop", "0")] {
            assert!(matches!(
                bench.choose(0, path, value),
                Err(Refused::Reader(_))
            ));
        }
    }
}
