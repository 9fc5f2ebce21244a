//! What `zhuyi sweep` varies: parameters with their values, and which combinations of them are meant.
//!
//! Listed values make every combination, the last parameter changing fastest. Drawn ones are drawn together, and the same
//! samples for each combination of the listed ones, so that these compare in pairs.

mod axis;
mod constraint;
mod typed;

use clap::Args;
use zhuyi_lab::batch::{Distribution, Sampling, samples};
use zhuyi_lab::choice::{Choice, is_named};
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
            sampling: Some("halton".to_string()),
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
                "samples must say how often",
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
