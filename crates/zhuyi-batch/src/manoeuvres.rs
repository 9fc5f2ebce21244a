//! Manoeuvres of many runs: how a table spells when each began and ended, and which began in none.
//!
//! ```text
//!  cutter.1 ChangeLane 2.31-5.31; cutter.2 Brake never        one that is under way at the end: 7.00-
//! ```
//!
//! A manoeuvre is named by its actor, its place in the actor's script, from 1, and its action. Times are in seconds of the run. One
//! that another of its kind has replaced before it reached its goal ends in ` replaced`.

use std::collections::BTreeMap;

use zhuyi_core::SimTime;
use zhuyi_scenario::Scenario;
use zhuyi_sim::RunRecord;
use zhuyi_world::Progress;

/// The column of `runs.csv` that tells of them.
pub const COLUMN: &str = "manoeuvres";

/// The word for one that has not begun.
const NEVER: &str = "never";
/// Between two manoeuvres.
const BETWEEN: &str = "; ";

/// The names of the manoeuvres of a scenario, in the order of its actors.
pub fn names(scenario: &Scenario) -> impl Iterator<Item = String> {
    scenario.actors.iter().flat_map(|actor| {
        let numbered = (1..).zip(&actor.manoeuvres);
        numbered
            .map(|(place, manoeuvre)| format!("{}.{place} {}", actor.name, manoeuvre.then.name()))
    })
}

/// When each began and ended, as `runs.csv` spells it; `progress` stands in the order of [`names`].
pub fn spelt(scenario: &Scenario, progress: &[Progress]) -> String {
    let told = names(scenario)
        .zip(progress)
        .map(|(name, progress)| format!("{name} {}", times(*progress)));
    told.collect::<Vec<_>>().join(BETWEEN)
}

fn times(progress: Progress) -> String {
    let seconds = |time: SimTime| format!("{:.2}", time.seconds());
    match progress {
        Progress::Waiting => NEVER.to_string(),
        Progress::UnderWay { began } => format!("{}-", seconds(began)),
        Progress::Ended { began, ended } => format!("{}-{}", seconds(began), seconds(ended)),
        Progress::Replaced { began, ended } => {
            format!("{}-{} replaced", seconds(began), seconds(ended))
        }
    }
}

/// Which manoeuvres of a run began, in the order of [`names`].
pub fn began(run: &RunRecord) -> Vec<bool> {
    let all = run.manoeuvres.iter().flatten();
    all.map(|progress| progress.began().is_some()).collect()
}

/// Adds which manoeuvres began in other runs to those of some.
pub fn join(some: &mut Vec<bool>, others: &[bool]) {
    if some.len() < others.len() {
        some.resize(others.len(), false);
    }
    for (one, other) in some.iter_mut().zip(others) {
        *one |= other;
    }
}

/// The names of the manoeuvres that began in no run; `began` stands in the order of [`names`].
pub fn never(scenario: &Scenario, began: &[bool]) -> Vec<String> {
    let all = names(scenario).zip(began);
    all.filter_map(|(name, began)| (!began).then_some(name))
        .collect()
}

/// Which manoeuvres began in any of the rows of a table, by the column that tells of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Seen(BTreeMap<String, bool>);

impl Seen {
    /// A row's field; what is not spelt as [`spelt`] does is passed over.
    pub fn add(&mut self, field: &str) {
        for told in field.split(BETWEEN) {
            let mut words = told.splitn(3, ' ');
            let (Some(actor), Some(action), Some(times)) =
                (words.next(), words.next(), words.next())
            else {
                continue;
            };
            let began = times != NEVER;
            let name = format!("{actor} {action}");
            *self.0.entry(name).or_default() |= began;
        }
    }

    /// The names of those that began in no row, in their order.
    pub fn never(&self) -> impl Iterator<Item = &str> {
        let all = self.0.iter();
        all.filter_map(|(name, began)| (!began).then_some(name.as_str()))
    }
}

/// A note of the manoeuvres of a scenario that began in no run; none where there is none.
///
/// ```
/// let never = ["cutter.1 ChangeLane".to_string()];
/// let note = zhuyi_batch::manoeuvres::note("cut-in", never.iter().map(String::as_str));
/// assert_eq!(note.unwrap(), "`cut-in`: began in no drive: cutter.1 ChangeLane");
/// ```
pub fn note<'a>(scenario: &str, never: impl Iterator<Item = &'a str>) -> Option<String> {
    let never: Vec<&str> = never.collect();
    (!never.is_empty()).then(|| format!("`{scenario}`: began in no drive: {}", never.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_times_are_spelt_and_read_again() {
        let (began, ended) = (SimTime::from_millis(2310), SimTime::from_millis(5310));
        let all = [
            (Progress::Waiting, "never"),
            (Progress::UnderWay { began }, "2.31-"),
            (Progress::Ended { began, ended }, "2.31-5.31"),
            (Progress::Replaced { began, ended }, "2.31-5.31 replaced"),
        ];
        for (progress, told) in all {
            assert_eq!(times(progress), told);
            let mut seen = Seen::default();
            seen.add(&format!("a.1 Brake {told}; b.1 ChangeLane never"));
            seen.add("b.1 ChangeLane never; a.1 Brake never");
            seen.add("");
            let never: Vec<&str> = seen.never().collect();
            if progress == Progress::Waiting {
                assert_eq!(never, ["a.1 Brake", "b.1 ChangeLane"]);
            } else {
                assert_eq!(never, ["b.1 ChangeLane"]);
            }
        }
    }
}
