//! What varies, as typed: on the command line by `--vary path=..`, or in a plan.

use zhuyi_scenario::{Piece, Setting, Values, Varied};

use super::FLAG;
use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// A parameter with its values, as typed.
#[derive(Clone, Debug)]
pub struct Typed<'a> {
    /// Its path.
    pub path: Argument<'a>,
    /// Its values.
    pub values: Spec<'a>,
}

/// Values, as typed.
#[derive(Clone, Debug)]
pub enum Spec<'a> {
    /// `from:to:step`.
    Range {
        /// All of it, or the part of it that comes nearest.
        all: Argument<'a>,
        /// The lower end.
        from: Argument<'a>,
        /// The upper end.
        to: Argument<'a>,
        /// The step.
        step: Option<Argument<'a>>,
    },
    /// `[a,b]`: all of it, and the entries as RON.
    List(Argument<'a>, Vec<String>),
    /// `uniform(from,to)`.
    Uniform {
        /// All of it, or the part of it that comes nearest.
        all: Argument<'a>,
        /// The lower end.
        from: Argument<'a>,
        /// The upper end.
        to: Argument<'a>,
    },
    /// `normal(mean,deviation)`.
    Normal {
        /// The mean.
        mean: Argument<'a>,
        /// The standard deviation.
        deviation: Argument<'a>,
    },
}

impl<'a> Typed<'a> {
    /// What a plan says.
    pub fn written(varied: &'a Varied) -> Self {
        let values = match &varied.values {
            Values::Range { from, to, step } => Spec::Range {
                all: Argument::of(to),
                from: Argument::of(from),
                to: Argument::of(to),
                step: step.as_ref().map(Argument::of),
            },
            Values::List(values) => {
                let texts = values.iter().map(|value| value.text().to_string());
                Spec::List(Argument::of(&varied.path), texts.collect())
            }
            Values::Uniform { from, to } => Spec::Uniform {
                all: Argument::of(to),
                from: Argument::of(from),
                to: Argument::of(to),
            },
            Values::Normal { mean, deviation } => {
                let [mean, deviation]: [&Piece; 2] = [mean, deviation];
                let (mean, deviation) = (Argument::of(mean), Argument::of(deviation));
                Spec::Normal { mean, deviation }
            }
        };
        Self {
            path: Argument::of(&varied.path),
            values,
        }
    }

    /// What a flag says.
    pub fn flag(text: &'a str, problems: &mut Problems) -> Option<Self> {
        Self::named_flag(text, |_| false, problems)
    }

    /// The same where what `is_named` knows may stand in place of a path.
    pub fn named_flag(
        text: &'a str,
        is_named: fn(&str) -> bool,
        problems: &mut Problems,
    ) -> Option<Self> {
        let argument = Argument::new(FLAG, text);
        let whole = argument.all();
        let Some(equals) = text.find('=') else {
            argument.refuse(&whole, Fault::VaryForm(text.to_string()), problems);
            return None;
        };
        let path = argument.within(&argument.trimmed(&(0..equals)));
        let spec = argument.within(&argument.trimmed(&(equals + 1..whole.end)));
        if spec.typed().starts_with('[') {
            // Read as a setting, so that an unknown path or what is no RON is told as everywhere. What is no path stands
            // for one here.
            let as_path = if is_named(path.typed()) {
                format!("duration_s={}", spec.typed())
            } else {
                text.to_string()
            };
            let setting = problems.take(Setting::parse_as(FLAG, &as_path))?;
            let entries = setting.entries()?.into_iter().map(String::from).collect();
            let values = Spec::List(spec, entries);
            return Some(Self { path, values });
        }
        let values = if spec.typed().ends_with(')') {
            distribution(spec, problems)?
        } else {
            range(argument, spec, problems)?
        };
        if !is_named(path.typed()) {
            let probe = format!("{}=0", path.typed());
            problems.take(Setting::parse_as(FLAG, &probe))?;
        }
        Some(Self { path, values })
    }
}

/// `uniform(from, to)` or `normal(mean, deviation)`.
fn distribution<'a>(spec: Argument<'a>, problems: &mut Problems) -> Option<Spec<'a>> {
    let (text, place) = (spec.typed(), spec.all());
    let Some((name, _)) = text.split_once('(') else {
        spec.refuse(&place, Fault::Distribution(text.to_string()), problems);
        return None;
    };
    let inside = place.start + name.len() + 1..place.end - 1;
    let parts = spec.parts(&inside, ',');
    let part = |index: usize| spec.within(&parts[index]);
    match (parts.len(), name.trim_end()) {
        (2, "uniform") => Some(Spec::Uniform {
            all: spec,
            from: part(0),
            to: part(1),
        }),
        (2, "normal") => Some(Spec::Normal {
            mean: part(0),
            deviation: part(1),
        }),
        _ => {
            spec.refuse(&place, Fault::Distribution(text.to_string()), problems);
            None
        }
    }
}

/// `from:to[:step]`.
fn range<'a>(
    argument: Argument<'a>,
    spec: Argument<'a>,
    problems: &mut Problems,
) -> Option<Spec<'a>> {
    let parts = spec.parts(&spec.all(), ':');
    let part = |index: usize| spec.within(&parts[index]);
    if !(2..=3).contains(&parts.len()) {
        let got = argument.typed().to_string();
        spec.refuse(&spec.all(), Fault::VaryForm(got), problems);
        return None;
    }
    Some(Spec::Range {
        all: spec,
        from: part(0),
        to: part(1),
        step: (parts.len() == 3).then(|| part(2)),
    })
}
