//! What commands work on: scenarios and systems by name or path, with single values set on the command line.

use std::fs;
use std::path::{MAIN_SEPARATOR, Path};

use clap::Args;
use zhuyi_scenario::{Scenario, Setting, Source, System, did_you_mean, embedded, load};

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::{Problem, Problems};
use crate::shell;

/// Name of the system that comes with the program.
pub const DEFAULT_SYSTEM: &str = "default";

/// The flags that change what is run, as typed.
#[derive(Args, Clone, Debug, Default)]
#[group(skip)]
pub struct Setup {
    /// Another car, cameras, planner or estimator: a system file [default: the built-in `default`]
    #[arg(long, value_name = "FILE")]
    pub system: Option<String>,
    /// Set one value of the scenario or the system file, as planner.time_headway_s=1.2 or
    /// actors.lead.speed_mps=12; may be given more than once
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub settings: Vec<String>,
}

/// Scenarios and the system that drives through them, each if it could be read.
#[derive(Debug)]
pub struct Inputs {
    /// The scenarios, in the order of being named; all or none.
    pub scenarios: Option<Vec<Scenario>>,
    /// The ego.
    pub system: Option<System>,
    /// What both were read from.
    pub texts: Option<Texts>,
}

/// What scenarios and a system are read from.
#[derive(Clone, Debug)]
pub struct Texts {
    /// The scenarios, in the order of being named.
    pub scenarios: Vec<Source>,
    /// The system.
    pub system: Source,
    /// Its name or path on a command line, if one was given.
    pub system_named: Option<String>,
    /// What is set in all of them.
    pub settings: Vec<Setting>,
}

impl Texts {
    /// The flags that say the same on another command line, spelt in one way.
    pub fn options(&self) -> String {
        let is_named = |path: &&String| *path != DEFAULT_SYSTEM;
        let system = self.system_named.iter().filter(is_named);
        let system = system.map(|path| shell::line(["--system", path]));
        let settings = self.settings.iter().map(|setting| {
            let typed = format!("{}={}", setting.path(), setting.value());
            shell::line(["--set", &typed])
        });
        let all: Vec<String> = system.chain(settings).collect();
        all.join(" ")
    }
}

impl Inputs {
    /// Reads scenarios by name or path. Notes all that is wrong with any of them, the system and the settings.
    pub fn read(typed: &[String], setup: &Setup, problems: &mut Problems) -> Self {
        Self::read_from("SCENARIO", typed, setup, problems)
    }

    /// The same for scenarios that another argument names.
    pub fn read_from(
        argument: &'static str,
        typed: &[String],
        setup: &Setup,
        problems: &mut Problems,
    ) -> Self {
        let settings = setup.settings(problems);
        let arguments: Vec<Argument<'_>> = typed
            .iter()
            .map(|typed| Argument::new(argument, typed))
            .collect();
        let sources = arguments
            .iter()
            .map(|argument| scenario_source(*argument, argument.typed(), problems));
        let sources: Vec<Option<Source>> = sources.collect();
        let system = (setup.system.clone(), setup.system_source(problems));
        Self::from_texts(&arguments, sources, system, settings, problems)
    }

    /// The same for scenarios of which the texts are read, each if it could be, with what names them, and for a system that is
    /// called so on a command line.
    pub fn from_texts(
        arguments: &[Argument<'_>],
        sources: Vec<Option<Source>>,
        (system_named, system): (Option<String>, Option<Source>),
        settings: Vec<Setting>,
        problems: &mut Problems,
    ) -> Self {
        let Some(of_system) = system else {
            return Self {
                scenarios: None,
                system: None,
                texts: None,
            };
        };
        let sources: Vec<Source> = sources.into_iter().flatten().collect();
        let system = problems.take(System::read(&of_system, &settings));
        let scenarios: Vec<Scenario> = sources
            .iter()
            .filter_map(|source| problems.take(load(source, &of_system, &settings)))
            .map(|(scenario, _)| scenario)
            .collect();
        let whole = scenarios.len() == arguments.len();
        if whole {
            refuse_namesakes(arguments, &scenarios, problems);
        }
        Self {
            scenarios: whole.then_some(scenarios),
            system,
            texts: Some(Texts {
                scenarios: sources,
                system: of_system,
                system_named,
                settings,
            }),
        }
    }
}

/// Two scenarios of one name would share their draws and their rows.
fn refuse_namesakes(arguments: &[Argument<'_>], scenarios: &[Scenario], problems: &mut Problems) {
    for (index, scenario) in scenarios.iter().enumerate() {
        if scenarios[..index]
            .iter()
            .any(|earlier| earlier.name == scenario.name)
        {
            let argument = arguments[index];
            let fault = Fault::Twice {
                what: "scenario",
                name: scenario.name.clone(),
            };
            argument.refuse(&argument.all(), fault, problems);
        }
    }
}

impl Setup {
    /// The system file.
    pub fn system_source(&self, problems: &mut Problems) -> Option<Source> {
        match self.system.as_deref() {
            None | Some(DEFAULT_SYSTEM) => Some(default_system()),
            Some(path) => read(path, problems),
        }
    }

    /// The values set on the command line.
    pub fn settings(&self, problems: &mut Problems) -> Vec<Setting> {
        let parsed = self.settings.iter().map(|setting| Setting::parse(setting));
        parsed.filter_map(|read| problems.take(read)).collect()
    }

    /// The words that say the same on another command line.
    pub fn words(&self) -> impl Iterator<Item = &str> {
        let system = self.system.iter().flat_map(|path| ["--system", path]);
        let settings = self.settings.iter().flat_map(|setting| ["--set", setting]);
        system.chain(settings)
    }
}

/// The system that comes with the program.
pub fn default_system() -> Source {
    Source::new(format!("{DEFAULT_SYSTEM}.ron"), embedded::system())
}

/// A scenario by name or path; `argument` is where errors say that it was named.
pub fn scenario_source(
    argument: Argument<'_>,
    named: &str,
    problems: &mut Problems,
) -> Option<Source> {
    let known: Vec<&str> = embedded::names().collect();
    source(argument, named, &known, problems)
}

/// A scenario or system by name or path.
pub fn any_source(argument: Argument<'_>, problems: &mut Problems) -> Option<Source> {
    if argument.at(&argument.all()) == DEFAULT_SYSTEM {
        return Some(default_system());
    }
    let known: Vec<&str> = embedded::names().chain([DEFAULT_SYSTEM]).collect();
    source(argument, argument.typed(), &known, problems)
}

fn source(
    argument: Argument<'_>,
    typed: &str,
    known: &[&str],
    problems: &mut Problems,
) -> Option<Source> {
    if let Some(text) = embedded::scenario(typed) {
        return Some(Source::new(format!("{typed}.ron"), text));
    }
    if is_path(typed) {
        return read(typed, problems);
    }
    let hint = match did_you_mean(typed, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("known: {}; or the path of a .ron file", known.join(", ")),
    };
    let fault = Fault::Unknown {
        what: "scenario",
        got: typed.to_string(),
        hint,
    };
    argument.refuse(&argument.all(), fault, problems);
    None
}

/// Whether a word is meant as a path: it has a folder or an ending, or there is such a file.
pub fn is_path(typed: &str) -> bool {
    typed.contains(['/', MAIN_SEPARATOR])
        || Path::new(typed).extension().is_some()
        || Path::new(typed).exists()
}

pub fn read(path: &str, problems: &mut Problems) -> Option<Source> {
    match fs::read_to_string(path) {
        Ok(text) => Some(Source::new(path, text)),
        Err(source) => {
            problems.push(Problem::Read {
                path: path.into(),
                source,
            });
            None
        }
    }
}
