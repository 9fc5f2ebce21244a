//! A sweep as a file says it: what is driven through, at which rates, with how many seeds, and what varies.
//!
//! A plan is read in two halves. Here its form: which fields there are, lists, kinds of values, and paths that some scenario or
//! system could have. What the words in it come to (names of scenarios, ranges, distributions, comparisons) is left to who reads
//! the same words on a command line, so that both have one meaning; each [`Piece`] knows where it stands, for what is wrong with it
//! then. Left out: where results go and how many processes make them, which is not what a sweep is.

use crate::invalid::Invalid;
use crate::read;
use crate::reading::Reading;
use crate::source::{Setting, Source};
use std::ops::Range;

/// A part of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    source: Source,
    span: Range<usize>,
}

impl Piece {
    pub(crate) fn new(source: &Source, span: Range<usize>) -> Self {
        Self {
            source: source.clone(),
            span,
        }
    }

    /// The file.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// Where in it, in bytes.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// What stands there.
    pub fn text(&self) -> &str {
        &self.source.text()[self.span.clone()]
    }
}

/// A sweep as written. What the file does not say is empty.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// Names or paths of scenarios.
    pub scenarios: Vec<Piece>,
    /// Name or path of the system.
    pub system: Option<Piece>,
    /// What is set in every run.
    pub settings: Vec<Setting>,
    /// Rates of all cameras, as `1:10,15,30`.
    pub rates: Option<Piece>,
    /// How many seeds.
    pub seeds: Option<Piece>,
    /// The root of all randomness.
    pub root_seed: Option<Piece>,
    /// What varies from run to run.
    pub varied: Vec<Varied>,
    /// Comparisons that the values of a run must fulfil.
    pub constraints: Vec<Piece>,
    /// How often values are drawn.
    pub samples: Option<Piece>,
    /// How they are drawn.
    pub sampling: Option<Piece>,
}

/// A value of the scenario or the system that varies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Varied {
    /// The path of it, as a setting that gives it the first value that is written.
    pub first: Setting,
    /// The path of it.
    pub path: Piece,
    /// The values that it takes.
    pub values: Values,
}

/// The values of what varies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Values {
    /// Both ends and every step between them.
    Range {
        /// The lower end.
        from: Piece,
        /// The upper end.
        to: Piece,
        /// The step.
        step: Option<Piece>,
    },
    /// These.
    List(Vec<Piece>),
    /// Drawn between two ends.
    Uniform {
        /// The lower end.
        from: Piece,
        /// The upper end.
        to: Piece,
    },
    /// Drawn around a mean.
    Normal {
        /// The mean.
        mean: Piece,
        /// The standard deviation.
        deviation: Piece,
    },
}

impl Plan {
    /// What can be read of the plan that a source holds, and all that is wrong with its form.
    ///
    /// ```
    /// use zhuyi_scenario::{Plan, Source};
    /// let text = r#"(scenarios: ["cut-in"], seeds: 5, vary: [Range(path: "planner.min_gap_m", from: 2, to: 3)])"#;
    /// let (plan, sound) = Plan::read(&Source::new("plan.ron", text));
    /// assert_eq!((plan.scenarios[0].text(), plan.seeds.unwrap().text()), ("cut-in", "5"));
    /// assert_eq!((plan.varied[0].first.path(), plan.varied[0].first.value()), ("planner.min_gap_m", "2"));
    /// assert!(sound.is_ok());
    /// let (_, sound) = Plan::read(&Source::new("plan.ron", text.replace("planner", "planer")));
    /// assert_eq!(sound.unwrap_err().brief(), "plan.ron:1:55: unknown setting `planer`");
    /// ```
    pub fn read(source: &Source) -> (Self, Result<(), Invalid>) {
        let reading = Reading::new(std::iter::empty());
        let plan = match reading.root(source) {
            Ok(root) => read::plan(&root),
            Err(invalid) => return (Self::default(), Err(invalid)),
        };
        let sound = reading.finish(Some(()));
        (plan.unwrap_or_default(), sound)
    }
}

impl Setting {
    /// A setting whose path and value stand in a plan.
    pub(crate) fn in_plan(path: &Piece, value: &Piece) -> Result<Self, Invalid> {
        Self::at(&path.source, path.span(), value.span())
    }
}
