//! The frame rates of one run: `30` for all cameras, or `front=30,left=5` by name.
//!
//! A name sets the camera of that name and all whose names begin with it and `_`, so `front` sets `front_120` and `front_60`;
//! the longest name that fits a camera decides. A camera that none fits keeps the rate of the system file.

use zhuyi_core::FrameRates;
use zhuyi_scenario::{System, did_you_mean};

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// [Hz] slowest and fastest camera, as in system files.
const LIMITS: std::ops::RangeInclusive<f64> = 0.1..=1000.0;

/// Rates as typed, with numbers read but names not yet looked up.
#[derive(Debug)]
pub enum Rates<'a> {
    /// Those of the system file.
    Default,
    /// [Hz] the same for all.
    Uniform(f64),
    /// By name.
    Named(Argument<'a>, Vec<Named<'a>>),
}

/// One camera, or several, and a rate.
#[derive(Debug)]
pub struct Named<'a> {
    place: std::ops::Range<usize>,
    name: &'a str,
    rate: f64,
}

impl<'a> Rates<'a> {
    /// Reads what was typed.
    pub fn read(typed: Option<&'a str>, problems: &mut Problems) -> Option<Self> {
        let Some(text) = typed else {
            return Some(Self::Default);
        };
        let argument = Argument::new("--fpr", text);
        let all = argument.all();
        if !text.contains('=') {
            if text.contains([',', ':']) {
                argument.refuse(&all, Fault::ManyRates, problems);
                return None;
            }
            let only = &argument.parts(&all, ',')[0];
            let rate = argument.number(only, "a frame rate", LIMITS, problems)?;
            return Some(Self::Uniform(rate));
        }
        let before = problems.len();
        let mut entries: Vec<Named<'a>> = Vec::new();
        for place in argument.parts(&all, ',') {
            let Some(entry) = Named::read(argument, &place, problems) else {
                continue;
            };
            if entries.iter().any(|earlier| earlier.name == entry.name) {
                let fault = Fault::Twice {
                    what: "camera",
                    name: entry.name.to_string(),
                };
                argument.refuse(&entry.place, fault, problems);
            }
            entries.push(entry);
        }
        (problems.len() == before).then_some(Self::Named(argument, entries))
    }

    /// The rates of a system's cameras.
    pub fn of(&self, system: &System, problems: &mut Problems) -> Option<FrameRates> {
        let names = || {
            system
                .perception
                .eyes
                .iter()
                .map(|eye| eye.camera.name.as_str())
        };
        match self {
            Self::Default => Some(system.default_rates.clone()),
            Self::Uniform(rate) => Some(FrameRates::new(names().map(|_| *rate).collect())),
            Self::Named(argument, entries) => {
                let before = problems.len();
                for entry in entries {
                    if !names().any(|name| entry.fits(name)) {
                        argument.refuse(&entry.place, unknown(entry.name, names()), problems);
                    }
                }
                let longest = |name: &str| {
                    let fitting = entries.iter().filter(|entry| entry.fits(name));
                    fitting
                        .max_by_key(|entry| entry.name.len())
                        .map(|entry| entry.rate)
                };
                let rates = names().zip(system.default_rates.all());
                let rates = rates.map(|(name, default)| longest(name).unwrap_or(*default));
                (problems.len() == before).then(|| FrameRates::new(rates.collect()))
            }
        }
    }
}

impl<'a> Named<'a> {
    fn read(
        argument: Argument<'a>,
        place: &std::ops::Range<usize>,
        problems: &mut Problems,
    ) -> Option<Self> {
        let parts = argument.parts(place, '=');
        let [name, rate] = parts.as_slice() else {
            argument.refuse(
                place,
                Fault::NoCamera(argument.at(place).to_string()),
                problems,
            );
            return None;
        };
        Some(Self {
            place: name.clone(),
            name: argument.at(name),
            rate: argument.number(rate, "a frame rate", LIMITS, problems)?,
        })
    }

    fn fits(&self, camera: &str) -> bool {
        let rest = camera.strip_prefix(self.name);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    }
}

fn unknown<'n>(got: &str, names: impl Iterator<Item = &'n str> + Clone) -> Fault {
    let known: Vec<&str> = names.clone().collect();
    let nearest =
        did_you_mean(got, names).map_or(String::new(), |name| format!("did you mean `{name}`? "));
    Fault::Unknown {
        what: "camera",
        got: got.to_string(),
        hint: format!("{nearest}known: {}", known.join(", ")),
    }
}
