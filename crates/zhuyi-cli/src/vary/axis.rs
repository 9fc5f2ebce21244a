//! A varied parameter with the values that it takes.
//!
//! `planner.min_gap_m=2:4` are 2, 3 and 4, with a step behind another colon 2:4:0.5 every half, both ends included;
//! `estimator.grid=[Ms33,Fps]` are these values, as a file spells them; `planner.min_gap_m=uniform(2,4)` and
//! `normal(3,0.5)` draw them.

use zhuyi_batch::Distribution;

use super::typed::{Spec, Typed};
use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// The most values of one parameter.
const MOST_VALUES: usize = 10_000;

/// [-] the numbers that an end of a range may be: those that a step can still be told from.
const NUMBERS: f64 = 1e9;

/// A parameter with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its path.
    pub path: String,
    /// Its values.
    pub values: Values,
    /// The values as a flag says them, spelt in one way: `2:4:0.5`.
    pub spelt: String,
}

/// The values of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// These, as RON.
    Listed(Vec<String>),
    /// Some of these.
    Drawn(Distribution),
}

/// All parameters.
pub fn axes(typed: &[Typed<'_>], problems: &mut Problems) -> Option<Vec<Axis>> {
    let before = problems.len();
    let mut axes: Vec<Axis> = Vec::new();
    for typed in typed {
        let Some(axis) = axis(typed, problems) else {
            continue;
        };
        if axes.iter().any(|earlier| earlier.path == axis.path) {
            let what = "parameter";
            let name = axis.path.clone();
            refuse(typed.path, Fault::Twice { what, name }, problems);
        }
        axes.push(axis);
    }
    (problems.len() == before).then_some(axes)
}

fn axis(typed: &Typed<'_>, problems: &mut Problems) -> Option<Axis> {
    let (values, spelt) = match &typed.values {
        Spec::List(all, values) => {
            let values = listed(*all, values, problems)?;
            let spelt = format!("[{}]", values.join(","));
            (Values::Listed(values), spelt)
        }
        Spec::Range {
            all,
            from,
            to,
            step,
        } => {
            let ends = (number(*from, problems), number(*to, problems));
            let step = step.map_or(Some(1.0), |step| {
                step.number(&step.all(), "a step", 1e-6..=NUMBERS, problems)
            });
            range(*all, (ends.0?, ends.1?), step?, problems)?
        }
        Spec::Uniform { all, from, to } => {
            let (from, to) = (number(*from, problems), number(*to, problems));
            let (from, to) = upwards(*all, (from?, to?), problems)?;
            let of = Distribution::Uniform { from, to };
            (Values::Drawn(of), format!("uniform({from},{to})"))
        }
        Spec::Normal { mean, deviation } => {
            let mean = number(*mean, problems);
            let all = deviation.all();
            let what = "a standard deviation";
            let deviation = deviation.number(&all, what, 0.0..=NUMBERS, problems);
            let (mean, deviation) = (mean?, deviation?);
            let of = Distribution::Normal { mean, deviation };
            (Values::Drawn(of), format!("normal({mean},{deviation})"))
        }
    };
    Some(Axis {
        path: typed.path.typed().to_string(),
        values,
        spelt,
    })
}

fn refuse(argument: Argument<'_>, fault: Fault, problems: &mut Problems) {
    argument.refuse(&argument.all(), fault, problems);
}

fn number(argument: Argument<'_>, problems: &mut Problems) -> Option<f64> {
    argument.number(&argument.all(), "a value", -NUMBERS..=NUMBERS, problems)
}

/// At least one value, and each once.
fn listed(all: Argument<'_>, values: &[String], problems: &mut Problems) -> Option<Vec<String>> {
    if values.is_empty() {
        refuse(all, Fault::NoValue, problems);
        return None;
    }
    if let Some(value) = (1..values.len()).find(|i| values[..*i].contains(&values[*i])) {
        let (what, name) = ("value", values[value].clone());
        refuse(all, Fault::Twice { what, name }, problems);
        return None;
    }
    Some(values.to_vec())
}

fn upwards(
    all: Argument<'_>,
    (from, to): (f64, f64),
    problems: &mut Problems,
) -> Option<(f64, f64)> {
    if from > to {
        let (from, to) = (from.to_string(), to.to_string());
        refuse(all, Fault::Reversed { from, to }, problems);
        return None;
    }
    Some((from, to))
}

/// Both ends and every step between them.
fn range(
    all: Argument<'_>,
    ends: (f64, f64),
    step: f64,
    problems: &mut Problems,
) -> Option<(Values, String)> {
    let (from, to) = upwards(all, ends, problems)?;
    // An end that is met but for rounding is met.
    let steps = ((to - from) / step + 1e-9).floor();
    if steps >= MOST_VALUES as f64 {
        let (most, got) = (MOST_VALUES, steps as usize + 1);
        refuse(all, Fault::TooMany { most, got }, problems);
        return None;
    }
    let value = |index| rounded(from + f64::from(index) * step);
    let spelt = if step == 1.0 {
        format!("{from}:{to}")
    } else {
        format!("{from}:{to}:{step}")
    };
    let values = (0..=steps as u32).map(value).collect();
    Some((Values::Listed(values), spelt))
}

/// To a millionth, so that 0.1 + 0.2 is 0.3; and 0 has no sign.
fn rounded(number: f64) -> String {
    ((number * 1e6).round() / 1e6 + 0.0).to_string()
}
