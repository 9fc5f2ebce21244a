//! What `zhuyi sweep` varies: parameters with their values, and which combinations of them are meant.
//!
//! Listed values make every combination, the last parameter changing fastest. Drawn ones are drawn together, and the same
//! samples for each combination of the listed ones, so that these compare in pairs.

mod axis;
mod constraint;

use clap::Args;
use zhuyi_lab::batch::{Distribution, Sampling, samples};
use zhuyi_lab::choice::{Choice, is_named};
use zhuyi_scenario::did_you_mean;

use crate::argument::Argument;
use crate::fault::Fault;
use crate::problems::Problems;
use crate::shell;
use axis::{Axis, FLAG, Values};

/// The most points.
const MOST_POINTS: usize = 100_000;

/// The flags, as typed.
#[derive(Args, Clone, Debug)]
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
    /// How they are drawn: random, latin-hypercube or halton
    #[arg(long, value_name = "HOW", default_value = "latin-hypercube")]
    sampling: String,
}

/// What varies, as meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varied {
    /// The paths.
    pub paths: Vec<String>,
    /// Points: a value for each path, as RON.
    pub points: Vec<Vec<String>>,
    /// The flags that say so.
    pub typed: Vec<String>,
}

impl Arguments {
    /// What was typed, as meant, with all that is wrong noted.
    pub fn read(&self, root_seed: u64, problems: &mut Problems) -> Option<Varied> {
        let sampling = self.sampling(problems);
        let count = self.count(problems);
        let axes = axis::axes(&self.vary, |_| false, problems)?;
        let drawn = drawn(&axes);
        if let ([(path, _), ..], None) = (drawn.as_slice(), &self.samples) {
            let fault = Fault::NoSamples((*path).to_string());
            refuse_all(FLAG, &self.vary.join(" "), fault, problems);
        }
        if let ([], Some(typed)) = (drawn.as_slice(), &self.samples) {
            refuse_all("--samples", typed, Fault::NothingDrawn, problems);
        }
        let (most, got) = (Sampling::MOST, drawn.len());
        if got > most && sampling == Some(Sampling::Halton) {
            let fault = Fault::ManyDrawn { most, got };
            refuse_all("--sampling", &self.sampling, fault, problems);
            return None;
        }
        let constraints = constraint::constraints(&self.constraints, &axes, problems)?;
        let samples = samples(sampling?, root_seed, &drawn, count?);
        let points = points(&axes, &samples, problems)?;
        let points: Vec<Vec<String>> = points
            .into_iter()
            .filter(|point| constraints.iter().all(|constraint| constraint.holds(point)))
            .collect();
        if points.is_empty() {
            let all = self.constraints.join(" ");
            refuse_all("--where", &all, Fault::NoPoint, problems);
            return None;
        }
        Some(Varied {
            paths: axes.into_iter().map(|axis| axis.path).collect(),
            points,
            typed: self.words(),
        })
    }

    fn sampling(&self, problems: &mut Problems) -> Option<Sampling> {
        let names = || Sampling::ALL.iter().map(|(name, _)| *name);
        let found = Sampling::ALL
            .iter()
            .find(|(name, _)| *name == self.sampling);
        if found.is_none() {
            let hint = did_you_mean(&self.sampling, names()).map_or_else(
                || format!("known: {}", names().collect::<Vec<_>>().join(", ")),
                |name| format!("did you mean `{name}`?"),
            );
            let fault = Fault::Unknown {
                what: "sampling",
                got: self.sampling.clone(),
                hint,
            };
            refuse_all("--sampling", &self.sampling, fault, problems);
        }
        found.map(|(_, sampling)| *sampling)
    }

    /// How many samples; one that is empty where nothing is drawn.
    fn count(&self, problems: &mut Problems) -> Option<u64> {
        let Some(typed) = &self.samples else {
            return Some(1);
        };
        let argument = Argument::new("--samples", typed);
        let most = MOST_POINTS as u64;
        argument.whole(&argument.all(), "the number of samples", 1..=most, problems)
    }

    /// Each flag that was typed, with its value.
    fn words(&self) -> Vec<String> {
        let vary = self.vary.iter().map(|typed| [FLAG, typed]);
        let constraints = self.constraints.iter().map(|typed| ["--where", typed]);
        let samples = self.samples.iter().map(|typed| ["--samples", typed]);
        let sampling = self.samples.iter().map(|_| ["--sampling", &self.sampling]);
        let all = vary.chain(constraints).chain(samples).chain(sampling);
        all.map(shell::line).collect()
    }
}

/// Choices with the values that each is to have, one at a time; some have a name in place of a path.
pub fn choices(typed: &[String], problems: &mut Problems) -> Option<Vec<Choice>> {
    let before = problems.len();
    let axes = axis::axes(typed, is_named, problems)?;
    let mut choices = Vec::new();
    for (axis, typed) in axes.into_iter().zip(typed) {
        match axis.values {
            Values::Listed(values) => choices.push(Choice {
                path: axis.path,
                values,
            }),
            Values::Drawn(_) => refuse_all(FLAG, typed, Fault::DrawnChoice, problems),
        }
    }
    (problems.len() == before).then_some(choices)
}

fn refuse_all(name: &'static str, text: &str, fault: Fault, problems: &mut Problems) {
    let argument = Argument::new(name, text);
    argument.refuse(&argument.all(), fault, problems);
}

/// The parameters that are drawn.
fn drawn(axes: &[Axis]) -> Vec<(&str, Distribution)> {
    let drawn = axes.iter().filter_map(|axis| match axis.values {
        Values::Drawn(of) => Some((axis.path.as_str(), of)),
        Values::Listed(_) => None,
    });
    drawn.collect()
}

/// Every combination of listed values with every sample, the samples changing fastest and of the others the last.
fn points(
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
        let all: Vec<&str> = axes.iter().map(|axis| axis.path.as_str()).collect();
        let most = MOST_POINTS;
        refuse_all(FLAG, &all.join(", "), Fault::ManyPoints { most }, problems);
        return None;
    }
    let mut combinations: Vec<Vec<&String>> = vec![Vec::new()];
    for values in listed() {
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
    Some(combinations.iter().flat_map(with_samples).collect())
}

/// A drawn number, of which seven digits are enough; what is driven is what is spelt.
fn spelt(number: f64) -> String {
    let short = format!("{number:.6e}").parse::<f64>();
    (short.unwrap_or(number) + 0.0).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(typed: &[&str], samples: Option<&str>) -> Result<Vec<Vec<String>>, String> {
        let typed: Vec<String> = typed.iter().map(ToString::to_string).collect();
        let mut problems = Problems::default();
        let arguments = Arguments {
            vary: typed
                .iter()
                .filter(|typed| !typed.contains('<'))
                .cloned()
                .collect(),
            constraints: typed
                .iter()
                .filter(|typed| typed.contains('<'))
                .cloned()
                .collect(),
            samples: samples.map(String::from),
            sampling: "halton".to_string(),
        };
        let varied = arguments.read(0, &mut problems);
        problems
            .finish(varied)
            .map(|varied| varied.points)
            .map_err(|error| error.to_string())
    }

    fn read(typed: &[&str]) -> Result<Vec<Vec<String>>, String> {
        drawn(typed, None)
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
    fn hand_samples_are_the_same_for_every_listed_value_and_constraints_leave_some_out() {
        let typed = [
            "planner.brake_above_mps2=uniform(2, 6)",
            "planner.exponent=[4,2]",
            "planner.min_gap_m=normal(3,0.5)",
        ];
        let points = drawn(&typed, Some("5")).unwrap();
        assert_eq!(points.len(), 10);
        for (four, two) in points[..5].iter().zip(&points[5..]) {
            assert_eq!((four[1].as_str(), two[1].as_str()), ("4", "2"));
            assert_eq!((&four[0], &four[2]), (&two[0], &two[2]));
            let brake: f64 = four[0].parse().unwrap();
            assert!((2.0..6.0).contains(&brake));
        }
        let number = |point: &Vec<String>, place: usize| point[place].parse::<f64>().unwrap();
        let kept = [
            &typed[..],
            &["planner.brake_above_mps2 < 4", "2<planner.exponent"],
        ]
        .concat();
        let kept = drawn(&kept, Some("5")).unwrap();
        let meant = |point: &&Vec<String>| number(point, 0) < 4.0 && number(point, 1) > 2.0;
        assert_eq!(
            kept,
            points.iter().filter(meant).cloned().collect::<Vec<_>>()
        );
        assert!((1..5).contains(&kept.len()));
    }

    #[test]
    fn hand_what_cannot_be_drawn_or_compared_is_refused() {
        for (typed, samples, told) in [
            (
                &["planner.exponent=uniform(1,2)"][..],
                None,
                "--samples must say how often",
            ),
            (&["planner.exponent=[1]"], Some("3"), "nothing is drawn"),
            (
                &["planner.exponent=uniform(1,2)"],
                Some("0"),
                "the number of samples must be 1 to",
            ),
            (
                &["planner.exponent=uniform(2,1)"],
                Some("3"),
                "a range goes upwards",
            ),
            (
                &["planner.exponent=uniform(2)"],
                Some("3"),
                "a distribution is uniform(from,to)",
            ),
            (
                &["planner.exponent=gamma(2,1)"],
                Some("3"),
                "a distribution is uniform(from,to)",
            ),
            (
                &["planner.exponent=)"],
                Some("3"),
                "a distribution is uniform(from,to)",
            ),
            (
                &["planner.exponent=normal(2,-1)"],
                Some("3"),
                "a standard deviation must be",
            ),
            (
                &["planner.exponent=[1]", "planner.min_gap_m<3"],
                None,
                "varied: planner.exponent",
            ),
            (
                &["planner.exponent=[1]", "planner.exponent<1"],
                None,
                "no combination of values is left",
            ),
            (
                &["estimator.grid=[Fps]", "estimator.grid<1"],
                None,
                "it has `Fps`",
            ),
        ] {
            let refused = drawn(typed, samples).unwrap_err();
            assert!(refused.contains(told), "{typed:?}: {refused}");
        }
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
