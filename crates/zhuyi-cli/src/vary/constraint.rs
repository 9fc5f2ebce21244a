//! `a<b`, by `--where` or in a plan: which combinations of values are meant.

use std::ops::Range;

use super::axis::{Axis, Values};
use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// Whether two numbers compare as they must.
type Compare = fn(&f64, &f64) -> bool;

/// How two numbers can compare; the longer signs first, as each begins with a shorter one.
const COMPARISONS: [(&str, Compare); 4] = [
    ("<=", f64::le),
    (">=", f64::ge),
    ("<", f64::lt),
    (">", f64::gt),
];

/// A comparison of two numbers of a point.
#[derive(Clone, Debug)]
pub struct Constraint {
    left: Operand,
    compare: Compare,
    right: Operand,
    /// As a flag says it, spelt in one way: `a<b`.
    pub spelt: String,
}

/// What is compared.
#[derive(Clone, Copy, Debug)]
enum Operand {
    Number(f64),
    /// The value at this place of a point.
    Parameter(usize),
}

/// All constraints, as typed.
pub fn constraints(
    typed: &[Argument<'_>],
    axes: &[Axis],
    problems: &mut Problems,
) -> Option<Vec<Constraint>> {
    let read: Vec<Option<Constraint>> = typed
        .iter()
        .map(|typed| constraint(*typed, axes, problems))
        .collect();
    read.into_iter().collect()
}

fn constraint(
    argument: Argument<'_>,
    axes: &[Axis],
    problems: &mut Problems,
) -> Option<Constraint> {
    let all = argument.all();
    let text = argument.at(&all);
    let found = COMPARISONS
        .iter()
        .find_map(|(sign, compare)| Some((text.find(sign)?, *sign, *compare)));
    let Some((at, sign, compare)) = found else {
        argument.refuse(&all, Fault::Comparison(text.to_string()), problems);
        return None;
    };
    let at = all.start + at;
    let places = [all.start..at, at + sign.len()..all.end];
    let [left, right] = places
        .clone()
        .map(|place| operand(argument, &place, axes, problems));
    let [one, two] = places.map(|place| argument.at(&place).trim());
    Some(Constraint {
        left: left?,
        compare,
        right: right?,
        spelt: format!("{one}{sign}{two}"),
    })
}

fn operand(
    argument: Argument<'_>,
    place: &Range<usize>,
    axes: &[Axis],
    problems: &mut Problems,
) -> Option<Operand> {
    let place = argument.trimmed(place);
    let text = argument.at(&place);
    let Some(found) = axes.iter().position(|axis| axis.path == text) else {
        return match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Some(Operand::Number(number)),
            _ => {
                let known: Vec<&str> = axes.iter().map(|axis| axis.path.as_str()).collect();
                let fault = Fault::Unknown {
                    what: "varied parameter",
                    got: text.to_string(),
                    hint: format!("varied: {}; or a number", known.join(", ")),
                };
                argument.refuse(&place, fault, problems);
                None
            }
        };
    };
    if let Values::Listed(values) = &axes[found].values {
        let is_number = |value: &&String| value.parse::<f64>().is_ok_and(f64::is_finite);
        if let Some(value) = values.iter().find(|value| !is_number(value)) {
            let (path, value) = (text.to_string(), value.clone());
            argument.refuse(&place, Fault::Incomparable { path, value }, problems);
            return None;
        }
    }
    Some(Operand::Parameter(found))
}

impl Constraint {
    /// Whether a point fulfils it.
    pub fn holds(&self, point: &[String]) -> bool {
        let number = |operand: Operand| match operand {
            Operand::Number(number) => Some(number),
            Operand::Parameter(place) => point.get(place)?.parse().ok(),
        };
        let (left, right) = (number(self.left), number(self.right));
        matches!((left, right), (Some(left), Some(right)) if (self.compare)(&left, &right))
    }
}
