//! One case: a scenario, a system and rates, and the command that drives it again.

use std::fmt;

use zhuyi_core::FrameRates;
use zhuyi_scenario::{Invalid, Scenario, Setting, Source, System, embedded};

use crate::draw::{Draw, Thing};
use crate::{scenario, system};

/// A case as typed.
pub struct Case {
    /// Its scenario.
    pub scenario: String,
    /// What is set in the system.
    pub settings: Vec<String>,
    /// How it is driven.
    pub drive: Drive,
    /// The seed of the run.
    pub seed: u64,
}

/// Who sets the rates.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// Nobody: [Hz] one rate for each camera.
    Fixed([f64; 5]),
    /// A policy, within a budget [Hz].
    Policy(&'static str, f64),
}

/// The policies that need nothing but the drive.
const POLICIES: [&str; 11] = [
    "uniform",
    "proportional",
    "demand-first",
    "demand-hysteresis",
    "demand-only",
    "phantom",
    "phantom-only",
    "importance",
    "rss",
    "ttc",
    "edf",
];

/// How many cases in a row have the same system: reading one takes longer than a drive.
pub const SHARING: u64 = 8;

/// A valid system, and how it was come by.
pub struct Ego {
    /// What is set in it.
    pub settings: Vec<String>,
    /// As meant.
    pub system: System,
    /// What was wrong with those that the reader has refused before it.
    pub refused: Vec<String>,
}

impl Ego {
    /// The one of case `number`.
    pub fn of(number: u64) -> Self {
        let mut draw = Draw::of(Thing::System, number / SHARING);
        let source = Source::new("default.ron", embedded::system());
        let mut refused = Vec::new();
        loop {
            let settings = system::settings(&mut draw);
            let parsed: Result<Vec<_>, _> = settings.iter().map(|s| Setting::parse(s)).collect();
            match parsed.and_then(|parsed| System::read(&source, &parsed)) {
                Ok(system) => {
                    return Self {
                        settings,
                        system,
                        refused,
                    };
                }
                Err(invalid) => refused.push(first_rule(&invalid)),
            }
        }
    }
}

impl Case {
    /// The valid case of a number, the scenario as meant, and what was wrong with those that the reader has refused before it.
    pub fn of(number: u64, ego: &Ego) -> (Self, Scenario, Vec<String>) {
        let mut draw = Draw::of(Thing::Case, number);
        let mut refused = Vec::new();
        loop {
            let case = Self::drawn(&mut draw, ego);
            let source = Source::new("drawn.ron", case.scenario.as_str());
            match Scenario::read(&source, &ego.system, &[]) {
                Ok(scenario) => return (case, scenario, refused),
                Err(invalid) => refused.push(first_rule(&invalid)),
            }
        }
    }

    /// The next of the draws, which the reader may refuse.
    fn drawn(draw: &mut Draw, ego: &Ego) -> Self {
        let scenario = scenario::text(draw);
        let mut rate = || draw.number((0.5, 40.0), (0.1, 1_000.0));
        let all = rate();
        let drive = match rate() {
            odd if odd < 12.0 => Drive::Fixed([all, rate(), odd, rate(), rate()]),
            _ => Drive::Fixed([all; 5]),
        };
        let drive = if draw.chance(4) {
            Drive::Policy(
                draw.one(&POLICIES),
                draw.number((5.0, 150.0), (5.0, 1_000.0)),
            )
        } else {
            drive
        };
        Self {
            scenario,
            settings: ego.settings.clone(),
            drive,
            seed: draw.seed(),
        }
    }

    /// [Hz] the rates at its start.
    pub fn rates(&self) -> FrameRates {
        match self.drive {
            Drive::Fixed(rates) => FrameRates::new(rates.to_vec()),
            Drive::Policy(_, budget) => FrameRates::new(vec![(budget / 5.0).min(30.0); 5]),
        }
    }
}

/// The kind of the first rule that is broken.
fn first_rule(invalid: &Invalid) -> String {
    let rule = format!("{:?}", invalid.violations()[0].rule());
    let words = rule.split(|c: char| !c.is_alphanumeric());
    let words: Vec<_> = words.filter(|word| !word.is_empty()).take(2).collect();
    words.join(" ")
}

/// The file and the command that drives it.
impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "drawn.ron:\n{}", self.scenario)?;
        write!(f, "zhuyi run drawn.ron --seed {}", self.seed)?;
        match &self.drive {
            Drive::Fixed([a, b, c, d, e]) => write!(
                f,
                " --fpr front_120={a},front_60={b},left={c},right={d},rear={e}"
            )?,
            Drive::Policy(policy, budget) => {
                write!(f, " --policy {policy} --budget-fps {budget}")?;
            }
        }
        for setting in &self.settings {
            write!(f, " --set '{setting}'")?;
        }
        Ok(())
    }
}
