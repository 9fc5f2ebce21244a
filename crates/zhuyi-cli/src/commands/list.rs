//! `zhuyi list`: the scenarios that come with the program.

use zhuyi_scenario::{Scenario, embedded};

use super::Task;
use crate::answer::Answer;
use crate::error::Error;
use crate::inputs::{DEFAULT_SYSTEM, Inputs, Setup};
use crate::problems::Problems;
use crate::tables::table;

/// [m/s] one mile per hour.
const MPH: f64 = 0.447_04;

/// The scenarios to list.
#[derive(Debug)]
pub struct List(Vec<Scenario>);

impl List {
    /// All that are embedded.
    pub fn meant() -> Result<Self, Error> {
        let names: Vec<String> = embedded::names().map(String::from).collect();
        let mut problems = Problems::default();
        let scenarios = Inputs::read(&names, &Setup::default(), &mut problems).scenarios;
        problems.finish(scenarios.map(Self))
    }
}

impl Task for List {
    fn run(self: Box<Self>) -> Result<Answer, Error> {
        let mut list = table(&["name", "ego", "actors", "what happens"], &[1]);
        for scenario in &self.0 {
            let actors: Vec<&str> = scenario
                .actors
                .iter()
                .map(|actor| actor.name.as_str())
                .collect();
            list.add_row([
                scenario.name.clone(),
                format!("{:.0} mph", scenario.ego.speed / MPH),
                actors.join(", "),
                scenario.title.clone(),
            ]);
        }
        Ok(Answer::new(format!(
            "{}\n\nNext: zhuyi show cut-in, zhuyi run cut-in, zhuyi new. \
             Car, cameras, planner and estimator: zhuyi show {DEFAULT_SYSTEM}\n",
            list.trim_fmt()
        )))
    }
}
