//! What `zhuyi sweep` varies: parameters with their values, and which combinations of them are meant.
//!
//! Listed values make every combination, the last parameter changing fastest. Drawn ones are drawn together, and the same
//! samples for each combination of the listed ones, so that these compare in pairs.

mod axis;
mod constraint;
mod typed;

use clap::Args;
use zhuyi_batch::choice::{Choice, is_named};
use zhuyi_batch::{Distribution, Sampling, samples};
use zhuyi_scenario::{Plan, did_you_mean};

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;
use crate::shell;
use axis::{Axis, Values};
use constraint::Constraint;
use typed::Typed;

/// The flag that says what varies.
pub const FLAG: &str = "--vary";

/// The most points.
const MOST_POINTS: usize = 100_000;

/// The flags, as typed.
#[derive(Args, Clone, Debug, Default)]
#[group(skip)]
pub struct Arguments {
    /// Vary a value of the scenario or the system file: from:to[:step] with both ends, [a,b,..], uniform(from,to) or
    /// normal(mean,deviation); may be given more than once, and then makes every combination
    #[arg(long, value_name = "PATH=VALUES", allow_hyphen_values = true)]
    vary: Vec<String>,
    /// Only combinations with a<b, a<=b, a>b or a>=b, each a varied parameter or a number; may be given more than once
    #[arg(
        long = "where",
        value_name = "COMPARISON",
        requires = "vary",
        allow_hyphen_values = true
    )]
    constraints: Vec<String>,
    /// How often uniform(..) and normal(..) are drawn
    #[arg(long, value_name = "COUNT", allow_hyphen_values = true)]
    samples: Option<String>,
    /// How they are drawn: random, latin-hypercube or halton [default: latin-hypercube]
    #[arg(long, value_name = "HOW")]
    sampling: Option<String>,
}

/// What varies, as typed in either way.
#[derive(Clone, Debug)]
struct Asked<'a> {
    axes: Vec<Typed<'a>>,
    constraints: Vec<Argument<'a>>,
    samples: Option<Argument<'a>>,
    sampling: Option<Argument<'a>>,
}

/// What varies, as meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varied {
    /// The paths.
    pub paths: Vec<String>,
    /// Points: a value for each path, as RON.
    pub points: Vec<Vec<String>>,
    /// The flags that say so, spelt in one way.
    pub typed: Vec<String>,
}

impl Arguments {
    /// What was typed, as meant, with all that is wrong noted.
    pub fn read(&self, root_seed: u64, problems: &mut Problems) -> Option<Varied> {
        let before = problems.len();
        let axes = self
            .vary
            .iter()
            .filter_map(|text| Typed::flag(text, problems));
        let asked = Asked {
            axes: axes.collect(),
            constraints: texts("--where", &self.constraints).collect(),
            samples: texts("--samples", &self.samples).next(),
            sampling: texts("--sampling", &self.sampling).next(),
        };
        let flags_are_sound = problems.len() == before;
        let read = asked.read(root_seed, flags_are_sound, problems);
        read.filter(|_| flags_are_sound)
    }

    /// Each flag that was typed, with its value.
    pub fn flags(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let vary = self.vary.iter().map(|typed| (FLAG, typed));
        let constraints = self.constraints.iter().map(|typed| ("--where", typed));
        let samples = self.samples.iter().map(|typed| ("--samples", typed));
        let sampling = self.sampling.iter().map(|typed| ("--sampling", typed));
        let all = vary.chain(constraints).chain(samples).chain(sampling);
        all.map(|(flag, typed)| (flag, typed.as_str()))
    }
}

/// The texts of a flag.
fn texts<'a>(
    flag: &'static str,
    typed: impl IntoIterator<Item = &'a String>,
) -> impl Iterator<Item = Argument<'a>> {
    let argument = |text: &'a String| Argument::new(flag, text);
    typed.into_iter().map(argument)
}

/// What a plan varies, as meant, with all that is wrong noted.
pub fn of_plan(plan: &Plan, root_seed: u64, problems: &mut Problems) -> Option<Varied> {
    let asked = Asked {
        axes: plan.varied.iter().map(Typed::written).collect(),
        constraints: plan.constraints.iter().map(Argument::of).collect(),
        samples: plan.samples.as_ref().map(Argument::of),
        sampling: plan.sampling.as_ref().map(Argument::of),
    };
    asked.read(root_seed, true, problems)
}

impl Asked<'_> {
    /// What is meant. Where not all axes are there, nothing is said of what depends on them.
    fn read(self, root_seed: u64, whole: bool, problems: &mut Problems) -> Option<Varied> {
        let sampling = self.sampling(problems);
        let count = self.count(problems);
        let axes = axis::axes(&self.axes, problems).filter(|_| whole)?;
        let drawn = drawn(&axes);
        self.check_drawn(&drawn, sampling, problems)?;
        let constraints = constraint::constraints(&self.constraints, &axes, problems)?;
        let count = count?;
        let samples = samples(sampling?, root_seed, &drawn, count);
        let points = self.points(&axes, &samples, problems)?;
        let points: Vec<Vec<String>> = points
            .into_iter()
            .filter(|point| constraints.iter().all(|constraint| constraint.holds(point)))
            .collect();
        if let (true, Some(last)) = (points.is_empty(), self.constraints.last()) {
            last.refuse(&last.all(), Fault::NoPoint, problems);
            return None;
        }
        Some(Varied {
            typed: self.words(&axes, &constraints, count),
            paths: axes.into_iter().map(|axis| axis.path).collect(),
            points,
        })
    }

    /// Whether it is said how often to draw where something is drawn, and not more than can be.
    fn check_drawn(
        &self,
        drawn: &[(&str, Distribution)],
        sampling: Option<Sampling>,
        problems: &mut Problems,
    ) -> Option<()> {
        let before = problems.len();
        match (drawn, self.samples) {
            ([(path, _), ..], None) => {
                let fault = Fault::NoSamples((*path).to_string());
                let at = self.axes.iter().find(|axis| axis.path.typed() == *path)?;
                at.path.refuse(&at.path.all(), fault, problems);
            }
            ([], Some(samples)) => {
                samples.refuse(&samples.all(), Fault::NothingDrawn, problems);
            }
            _ => {}
        }
        let (most, got) = (Sampling::MOST, drawn.len());
        if let (true, Some(Sampling::Halton), Some(at)) = (got > most, sampling, self.sampling) {
            at.refuse(&at.all(), Fault::ManyDrawn { most, got }, problems);
        }
        (problems.len() == before).then_some(())
    }

    fn sampling(&self, problems: &mut Problems) -> Option<Sampling> {
        let Some(argument) = self.sampling else {
            return Some(Sampling::LatinHypercube);
        };
        let (names, typed) = (
            || Sampling::ALL.iter().map(|(name, _)| *name),
            argument.typed(),
        );
        let found = Sampling::ALL.iter().find(|(name, _)| *name == typed);
        if found.is_none() {
            let hint = did_you_mean(typed, names()).map_or_else(
                || format!("known: {}", names().collect::<Vec<_>>().join(", ")),
                |name| format!("did you mean `{name}`?"),
            );
            let fault = Fault::Unknown {
                what: "sampling",
                got: typed.to_string(),
                hint,
            };
            argument.refuse(&argument.all(), fault, problems);
        }
        found.map(|(_, sampling)| *sampling)
    }

    /// How many samples; one that is empty where nothing is drawn.
    fn count(&self, problems: &mut Problems) -> Option<u64> {
        let Some(argument) = self.samples else {
            return Some(1);
        };
        let most = MOST_POINTS as u64;
        argument.whole(&argument.all(), "the number of samples", 1..=most, problems)
    }

    /// The flags that say so, each with its value, spelt in one way.
    fn words(&self, axes: &[Axis], constraints: &[Constraint], samples: u64) -> Vec<String> {
        let vary = axes
            .iter()
            .map(|axis| (FLAG, format!("{}={}", axis.path, axis.spelt)));
        let constraints = constraints
            .iter()
            .map(|constraint| ("--where", constraint.spelt.clone()));
        let samples = self.samples.map(|_| {
            let sampling = self.sampling.map_or("latin-hypercube", Argument::typed);
            [
                ("--samples", samples.to_string()),
                ("--sampling", sampling.to_string()),
            ]
        });
        let all = vary.chain(constraints).chain(samples.into_iter().flatten());
        all.map(|(flag, value)| shell::line([flag, value.as_str()]))
            .collect()
    }

    /// Every combination of listed values with every sample, the samples changing fastest and of the others the last.
    fn points(
        &self,
        axes: &[Axis],
        samples: &[Vec<f64>],
        problems: &mut Problems,
    ) -> Option<Vec<Vec<String>>> {
        let listed = || {
            axes.iter().filter_map(|axis| match &axis.values {
                Values::Listed(values) => Some(values),
                Values::Drawn(_) => None,
            })
        };
        let count = listed().try_fold(samples.len(), |count, values| {
            count.checked_mul(values.len())
        });
        if count.is_none_or(|count| count > MOST_POINTS) {
            let (at, most) = (self.axes.last()?.path, MOST_POINTS);
            at.refuse(&at.all(), Fault::ManyPoints { most }, problems);
            return None;
        }
        Some(combined(axes, &listed().collect::<Vec<_>>(), samples))
    }
}

/// Choices with the values that each is to have, one at a time; some have a name in place of a path.
pub fn choices(typed: &[String], problems: &mut Problems) -> Option<Vec<Choice>> {
    let before = problems.len();
    let typed = typed.iter();
    let typed: Vec<_> = typed
        .filter_map(|text| Typed::named_flag(text, is_named, problems))
        .collect();
    let axes = axis::axes(&typed, problems)?;
    let mut choices = Vec::new();
    for (axis, typed) in axes.into_iter().zip(&typed) {
        match axis.values {
            Values::Listed(values) => choices.push(Choice {
                path: axis.path,
                values,
            }),
            Values::Drawn(_) => {
                let path = typed.path;
                path.refuse(&path.all(), Fault::DrawnChoice, problems);
            }
        }
    }
    (problems.len() == before).then_some(choices)
}

/// The parameters that are drawn.
fn drawn(axes: &[Axis]) -> Vec<(&str, Distribution)> {
    let drawn = axes.iter().filter_map(|axis| match axis.values {
        Values::Drawn(of) => Some((axis.path.as_str(), of)),
        Values::Listed(_) => None,
    });
    drawn.collect()
}

/// Every combination of listed values with every sample.
fn combined(axes: &[Axis], listed: &[&Vec<String>], samples: &[Vec<f64>]) -> Vec<Vec<String>> {
    let mut combinations: Vec<Vec<&String>> = vec![Vec::new()];
    for values in listed {
        let longer = |combination: &Vec<_>| {
            let with = |value| [combination.as_slice(), &[value]].concat();
            values.iter().map(with).collect::<Vec<_>>()
        };
        combinations = combinations.iter().flat_map(longer).collect();
    }
    let point = |combination: &[&String], sample: &[f64]| {
        let (mut listed, mut drawn) = (combination.iter(), sample.iter());
        let value = |axis: &Axis| match axis.values {
            Values::Listed(_) => listed.next().map(|value| (*value).clone()),
            Values::Drawn(_) => drawn.next().map(|value| spelt(*value)),
        };
        axes.iter().filter_map(value).collect()
    };
    let with_samples = |combination: &Vec<&String>| {
        let points = samples.iter().map(|sample| point(combination, sample));
        points.collect::<Vec<Vec<String>>>()
    };
    combinations.iter().flat_map(with_samples).collect()
}

/// A drawn number, of which seven digits are enough; what is driven is what is spelt.
fn spelt(number: f64) -> String {
    let short = format!("{number:.6e}").parse::<f64>();
    (short.unwrap_or(number) + 0.0).to_string()
}

#[cfg(test)]
mod tests;
