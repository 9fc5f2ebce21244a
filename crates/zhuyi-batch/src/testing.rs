//! Experiments for the tests.

use zhuyi_scenario::{Scenario, Source, System, embedded};

use crate::sweep::Experiment;

/// Some of the scenarios that come with the program, on the system that does.
pub struct Embedded {
    pub scenarios: Vec<Scenario>,
    pub system: System,
}

impl Embedded {
    pub fn new(names: &[&str]) -> Self {
        let source = Source::new("default.ron", embedded::system());
        let system = System::read(&source, &[]).unwrap();
        let scenario = |name: &&str| {
            let text = embedded::scenario(name).unwrap();
            Scenario::read(&Source::new(format!("{name}.ron"), text), &system, &[]).unwrap()
        };
        Self {
            scenarios: names.iter().map(scenario).collect(),
            system,
        }
    }

    pub fn experiment(&self) -> Experiment<'_> {
        Experiment {
            scenarios: &self.scenarios,
            system: &self.system,
            root_seed: 0,
        }
    }
}
