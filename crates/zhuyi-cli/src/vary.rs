//! `--vary PATH=SPEC`: a parameter of the scenario or the system with the values that it takes.
//!
//! `planner.min_gap_m=2:4` are 2, 3 and 4, with a step behind another colon 2:4:0.5 every half, both ends included;
//! `estimator.grid=[Ms33,Fps]` are these values, as a file spells them. Several parameters make every combination, the last
//! one changing fastest.

use std::ops::Range;

use zhuyi_scenario::Setting;

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;

/// The flag.
const FLAG: &str = "--vary";

/// The most values of one parameter.
const MOST_VALUES: usize = 10_000;

/// The most points.
const MOST_POINTS: usize = 100_000;

/// [-] the numbers that an end of a range may be: those that a step can still be told from.
const NUMBERS: f64 = 1e9;

/// A parameter with its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// Its path.
    pub path: String,
    /// Its values, as RON.
    pub values: Vec<String>,
}

/// All parameters, as typed.
pub fn axes(typed: &[String], problems: &mut Problems) -> Option<Vec<Axis>> {
    let before = problems.len();
    let mut axes: Vec<Axis> = Vec::new();
    for typed in typed {
        let argument = Argument::new(FLAG, typed);
        let Some(axis) = axis(argument, problems) else {
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

/// Every combination of values, the last parameter's changing fastest; one empty point where there is no parameter.
pub fn points(axes: &[Axis], problems: &mut Problems) -> Option<Vec<Vec<String>>> {
    let count = axes
        .iter()
        .try_fold(1, |count: usize, axis| count.checked_mul(axis.values.len()));
    if count.is_none_or(|count| count > MOST_POINTS) {
        let all: Vec<&str> = axes.iter().map(|axis| axis.path.as_str()).collect();
        let all = all.join(", ");
        let argument = Argument::new(FLAG, &all);
        let most = MOST_POINTS;
        argument.refuse(&argument.all(), Fault::ManyPoints { most }, problems);
        return None;
    }
    let mut points = vec![Vec::new()];
    for axis in axes {
        let with = |point: &Vec<String>| {
            let longer = |value: &String| [point.as_slice(), std::slice::from_ref(value)].concat();
            axis.values.iter().map(longer).collect::<Vec<_>>()
        };
        points = points.iter().flat_map(with).collect();
    }
    Some(points)
}

/// Where the path stands.
fn path(argument: Argument<'_>) -> Range<usize> {
    argument.parts(&argument.all(), '=').swap_remove(0)
}

fn axis(argument: Argument<'_>, problems: &mut Problems) -> Option<Axis> {
    let whole = argument.all();
    let text = argument.at(&whole);
    let Some(equals) = text.find('=') else {
        argument.refuse(&whole, Fault::VaryForm(text.to_string()), problems);
        return None;
    };
    let place = path(argument);
    let spec = argument.trimmed(&(equals + 1..whole.end));
    let name = argument.at(&place).to_string();
    let values = if argument.at(&spec).starts_with('[') {
        // Read as a setting, so that an unknown path or what is no RON is told as everywhere.
        let setting = problems.take(Setting::parse_as(FLAG, text))?;
        let values = setting.entries()?;
        values.into_iter().map(String::from).collect()
    } else {
        let values = range(argument, &spec, problems)?;
        problems.take(Setting::parse_as(FLAG, &format!("{name}=0")))?;
        values
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
    Some(Axis { path: name, values })
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

#[cfg(test)]
mod tests {
    use super::*;

    fn read(typed: &[&str]) -> Result<Vec<Vec<String>>, String> {
        let typed: Vec<String> = typed.iter().map(ToString::to_string).collect();
        let mut problems = Problems::default();
        let points = axes(&typed, &mut problems).and_then(|axes| points(&axes, &mut problems));
        points.ok_or_else(|| problems.render(false))
    }

    #[test]
    fn hand_every_combination_with_the_last_changing_fastest() {
        let points = read(&["planner.min_gap_m=2:3:0.5", "estimator.grid=[Ms33, Fps]"]).unwrap();
        let points: Vec<String> = points.iter().map(|point| point.join(" ")).collect();
        let expected = ["2 Ms33", "2 Fps", "2.5 Ms33", "2.5 Fps", "3 Ms33", "3 Fps"];
        assert_eq!(points, expected);
        assert_eq!(read(&[]), Ok(vec![vec![]]));
    }

    #[test]
    fn hand_ends_are_met_and_values_stay_as_typed() {
        let values = |typed| read(&[typed]).unwrap().concat().join(" ");
        assert_eq!(values("perception.miss_rate=0.1:0.3:0.1"), "0.1 0.2 0.3");
        assert_eq!(values("planner.min_gap_m = -1:1"), "-1 0 1");
        assert_eq!(values("planner.min_gap_m=-0.5:0.1:0.5"), "-0.5 0");
        assert_eq!(values("planner.min_gap_m=[1.50, 2e0]"), "1.50 2e0");
        assert_eq!(
            values("ego=[(lane: 1), (lane: 2, s_m: 3)]"),
            "(lane: 1) (lane: 2, s_m: 3)"
        );
    }

    #[test]
    fn hand_what_is_no_variation_is_refused_at_its_place() {
        for (typed, told) in [
            (&["planner.min_gap_m"][..], "--vary:1:1"),
            (&["planner.min_gap_m=3"], "from:to[:step]"),
            (&["planner.min_gap_m="], "from:to[:step]"),
            (&["planner.min_gap_m=3:1"], "a range goes upwards"),
            (&["planner.min_gap_m=1:2:0"], "a step must be"),
            (&["planner.min_gap_m=1:x"], "--vary:1:21"),
            (&["planner.min_gap_m=1:NaN"], "a value must be"),
            (&["planner.min_gap_m=[]"], "at least one value"),
            (&["planner.min_gap_m=[1,2,1]"], "value `1` is given twice"),
            (&["planner.min_gap_m=[1,2"], "not valid RON"),
            (&["planer.min_gap_m=1:2"], "did you mean `planner`?"),
            (&["planner.min_gap_m=0:1:0.00001"], "at most 10000 numbers"),
            (
                &["planner.min_gap_m=1:2", "planner.min_gap_m=[3]"],
                "parameter `planner.min_gap_m` is given twice",
            ),
            (
                &["planner.min_gap_m=1:1000", "planner.exponent=1:1000"],
                "more than 100000 combinations",
            ),
        ] {
            let refused = read(typed).unwrap_err();
            assert!(refused.contains(told), "{typed:?}: {refused}");
        }
    }
}
