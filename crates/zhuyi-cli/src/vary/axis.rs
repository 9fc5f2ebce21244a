//! `--vary PATH=SPEC`: a parameter of the scenario or the system with the values that it takes.
//!
//! `planner.min_gap_m=2:4` are 2, 3 and 4, with a step behind another colon 2:4:0.5 every half, both ends included;
//! `estimator.grid=[Ms33,Fps]` are these values, as a file spells them; `planner.min_gap_m=uniform(2,4)` and
//! `normal(3,0.5)` draw them.

use std::ops::Range;

use zhuyi_lab::batch::Distribution;
use zhuyi_scenario::Setting;

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// The flag.
pub const FLAG: &str = "--vary";

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
}

/// The values of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// These, as RON.
    Listed(Vec<String>),
    /// Some of these.
    Drawn(Distribution),
}

/// All parameters, as typed: paths, or what `is_named` knows.
pub fn axes(
    typed: &[String],
    is_named: fn(&str) -> bool,
    problems: &mut Problems,
) -> Option<Vec<Axis>> {
    let before = problems.len();
    let mut axes: Vec<Axis> = Vec::new();
    for typed in typed {
        let argument = Argument::new(FLAG, typed);
        let Some(axis) = axis(argument, is_named, problems) else {
            continue;
        };
        if axes.iter().any(|earlier| earlier.path == axis.path) {
            let what = "parameter";
            let name = axis.path.clone();
            argument.refuse(&path(argument), Fault::Twice { what, name }, problems);
        }
        axes.push(axis);
    }
    (problems.len() == before).then_some(axes)
}

/// Where the path stands.
fn path(argument: Argument<'_>) -> Range<usize> {
    argument.parts(&argument.all(), '=').swap_remove(0)
}

fn axis(
    argument: Argument<'_>,
    is_named: fn(&str) -> bool,
    problems: &mut Problems,
) -> Option<Axis> {
    let whole = argument.all();
    let text = argument.at(&whole);
    let Some(equals) = text.find('=') else {
        argument.refuse(&whole, Fault::VaryForm(text.to_string()), problems);
        return None;
    };
    let place = path(argument);
    let spec = argument.trimmed(&(equals + 1..whole.end));
    let name = argument.at(&place).to_string();
    let values: Vec<String> = if argument.at(&spec).starts_with('[') {
        // Read as a setting, so that an unknown path or what is no RON is told as everywhere.
        // What is no path stands for one here.
        let as_path = if is_named(&name) {
            format!("duration_s={}", argument.at(&spec))
        } else {
            text.to_string()
        };
        let setting = problems.take(Setting::parse_as(FLAG, &as_path))?;
        let values = setting.entries()?;
        values.into_iter().map(String::from).collect()
    } else {
        let drawn = argument.at(&spec).ends_with(')');
        let values = if drawn {
            Values::Drawn(distribution(argument, &spec, problems)?)
        } else {
            Values::Listed(range(argument, &spec, problems)?)
        };
        if !is_named(&name) {
            problems.take(Setting::parse_as(FLAG, &format!("{name}=0")))?;
        }
        return Some(Axis { path: name, values });
    };
    if values.is_empty() {
        argument.refuse(&spec, Fault::NoValue, problems);
        return None;
    }
    if let Some(value) = (1..values.len()).find(|i| values[..*i].contains(&values[*i])) {
        let (what, name) = ("value", values[value].clone());
        argument.refuse(&spec, Fault::Twice { what, name }, problems);
        return None;
    }
    Some(Axis {
        path: name,
        values: Values::Listed(values),
    })
}

/// `uniform(from, to)` or `normal(mean, deviation)`.
fn distribution(
    argument: Argument<'_>,
    place: &Range<usize>,
    problems: &mut Problems,
) -> Option<Distribution> {
    let text = argument.at(place);
    let name = text.split('(').next().unwrap_or(text);
    if name.len() == text.len() {
        argument.refuse(place, Fault::Distribution(text.to_string()), problems);
        return None;
    }
    let inside = place.start + name.len() + 1..place.end - 1;
    let parts = argument.parts(&inside, ',');
    let ([one, two], "uniform" | "normal") = (parts.as_slice(), name.trim_end()) else {
        argument.refuse(place, Fault::Distribution(text.to_string()), problems);
        return None;
    };
    let first = argument.number(one, "a value", -NUMBERS..=NUMBERS, problems);
    if name.trim_end() == "normal" {
        let deviation = argument.number(two, "a standard deviation", 0.0..=NUMBERS, problems);
        return Some(Distribution::Normal {
            mean: first?,
            deviation: deviation?,
        });
    }
    let to = argument.number(two, "a value", -NUMBERS..=NUMBERS, problems);
    let (from, to) = (first?, to?);
    if from > to {
        let (from, to) = (from.to_string(), to.to_string());
        argument.refuse(place, Fault::Reversed { from, to }, problems);
        return None;
    }
    Some(Distribution::Uniform { from, to })
}

/// The numbers of `from:to[:step]`.
fn range(
    argument: Argument<'_>,
    place: &Range<usize>,
    problems: &mut Problems,
) -> Option<Vec<String>> {
    let parts = argument.parts(place, ':');
    let mut number = |place| argument.number(place, "a value", -NUMBERS..=NUMBERS, problems);
    let (from, to, step) = match parts.as_slice() {
        [from, to] => (number(from), number(to), Some(1.0)),
        [from, to, step] => {
            let (from, to) = (number(from), number(to));
            let step = argument.number(step, "a step", 1e-6..=NUMBERS, problems);
            (from, to, step)
        }
        _ => {
            let got = argument.at(&argument.all()).to_string();
            argument.refuse(place, Fault::VaryForm(got), problems);
            return None;
        }
    };
    let (from, to, step) = (from?, to?, step?);
    if from > to {
        let (from, to) = (from.to_string(), to.to_string());
        argument.refuse(place, Fault::Reversed { from, to }, problems);
        return None;
    }
    // An end that is met but for rounding is met.
    let steps = ((to - from) / step + 1e-9).floor();
    if steps >= MOST_VALUES as f64 {
        let (most, got) = (MOST_VALUES, steps as usize + 1);
        argument.refuse(place, Fault::TooMany { most, got }, problems);
        return None;
    }
    Some(
        (0..=steps as u32)
            .map(|index| rounded(from + f64::from(index) * step))
            .collect(),
    )
}

/// To a millionth, so that 0.1 + 0.2 is 0.3; and 0 has no sign.
fn rounded(number: f64) -> String {
    ((number * 1e6).round() / 1e6 + 0.0).to_string()
}
