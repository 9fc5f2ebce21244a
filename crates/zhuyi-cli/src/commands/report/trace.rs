//! The report of a recorded trace.

use std::sync::Arc;

use zhuyi_core::{ActorId, FrameRates, Road};
use zhuyi_log::Log;
use zhuyi_report::Recording;
use zhuyi_scenario::{Kind, Setting, System};

use super::Arguments;
use crate::argument::Argument;
use crate::fault::Fault;
use crate::inputs::{Inputs, Setup};
use crate::problems::Problems;
use crate::rates::Rates;

/// The ego of our own traces.
const DEFAULT_EGO: &str = "ego";

/// A trace and all that it is seen with.
#[derive(Debug)]
pub struct Trace {
    name: String,
    text: String,
    log: Log,
    ego: ActorId,
    road: Option<Arc<Road>>,
    system: System,
    rates: FrameRates,
}

impl Trace {
    /// What was typed, with the text of the trace. Notes all that is wrong.
    pub fn read(typed: &Arguments, text: String, problems: &mut Problems) -> Option<Self> {
        let ego = typed.ego.as_deref().unwrap_or(DEFAULT_EGO);
        let log = match Log::read(&text, Some(ego)) {
            Ok(log) => Some(log),
            Err(invalid) => {
                problems.refuse_trace(&typed.of.display().to_string(), &invalid);
                None
            }
        };
        let setup = Setup {
            system: typed.rig.clone(),
            settings: typed.settings.clone(),
        };
        let read = Inputs::read_from("--road", typed.road.as_slice(), &setup, problems);
        if typed.road.is_none() {
            refuse_settings_of_scenarios(&typed.settings, problems);
        }
        let rates = Rates::read(typed.fpr.as_deref(), problems);
        let rates = rates.zip(read.system.as_ref());
        let rates = rates.and_then(|(rates, system)| rates.of(system, problems));
        let mut scenarios = read.scenarios?;
        let log = log?;
        let name = typed.of.file_name().unwrap_or(typed.of.as_os_str());
        Some(Self {
            name: name.to_string_lossy().into_owned(),
            ego: log.find(ego)?,
            text,
            log,
            road: scenarios.pop().map(|scenario| scenario.road),
            system: read.system?,
            rates: rates?,
        })
    }

    /// The page, and what is to be said of it on the terminal.
    pub fn page(&self, command: String) -> (String, String) {
        let recording = Recording {
            name: self.name.clone(),
            log: &self.log,
            ego: self.ego,
            road: self.road.as_deref(),
            system: &self.system,
            rates: &self.rates,
            version: env!("CARGO_PKG_VERSION"),
            command,
            text: &self.text,
        };
        let document = recording.document();
        let told = format!(
            "{} steps of `{}`, {} of {} other vehicles\n",
            document.rows,
            self.log.vehicle(self.ego).id,
            document.actors.len(),
            self.log.vehicles().len() - 1
        );
        let title = format!("{}: zhuyi", self.name);
        (zhuyi_report::page(&title, &document), told)
    }
}

/// Without a scenario nothing would look at its settings.
fn refuse_settings_of_scenarios(settings: &[String], problems: &mut Problems) {
    let of_scenario = |typed: &&String| {
        Setting::parse(typed).is_ok_and(|setting| setting.kind() == Kind::Scenario)
    };
    for typed in settings.iter().filter(of_scenario) {
        let argument = Argument::new("--set", typed);
        argument.refuse(&argument.all(), Fault::NoRoad, problems);
    }
}
