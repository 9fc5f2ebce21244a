//! The rules for what is typed on the command line. Those of files are zhuyi-scenario's.

use std::ops::RangeInclusive;

/// What is wrong with a part of an argument.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// No policy.
    #[error("{0}")]
    Policy(zhuyi_scheduler::UnknownPolicy),
    /// No digits.
    #[error("expected a whole number, got `{0}`")]
    NotWhole(String),
    /// No number at all.
    #[error("expected a number, got `{0}`")]
    NotNumber(String),
    /// A number out of its range; NaN is in none.
    #[error("{what} must be {low} to {high}, got {got}")]
    Limits {
        /// What kind of number.
        what: &'static str,
        /// The least allowed.
        low: String,
        /// The largest allowed.
        high: String,
        /// What was typed.
        got: String,
    },
    /// Nothing where something belongs.
    #[error("expected {0}, got nothing")]
    Empty(&'static str),
    /// More than `from:to:step`.
    #[error("a range has the form from:to or from:to:step, got `{0}`")]
    RangeForm(String),
    /// From high to low.
    #[error("a range goes upwards, got {from} to {to}")]
    Reversed {
        /// Its beginning.
        from: String,
        /// Its end.
        to: String,
    },
    /// A range that stays where it is.
    #[error("the step of a range must be at least 1, got 0")]
    NoStep,
    /// A range of too many numbers.
    #[error("a range has at most {most} numbers, got {got}")]
    TooMany {
        /// The most allowed.
        most: usize,
        /// How many it has.
        got: usize,
    },
    /// A policy that does not fit the rig.
    #[error("{0}")]
    Unfit(String),
    /// Between two steps.
    #[error("{what} must be a multiple of {of}, got {got}")]
    NoMultiple {
        /// What kind of number.
        what: &'static str,
        /// Of what it must be a multiple.
        of: u64,
        /// What was typed.
        got: u64,
    },
    /// More combinations than can be kept, or none.
    #[error("{rates} rates on {cameras} analysed cameras must make 1 to {most} combinations")]
    ManyCombinations {
        /// How many rates.
        rates: usize,
        /// How many cameras have one each.
        cameras: usize,
        /// How many combinations there may be.
        most: usize,
    },
    /// More than one rate where one is meant.
    #[error("one run has one rate for all cameras, or one for each: `30` or `front=30,left=5`")]
    ManyRates,
    /// Neither a rate nor the rate of a camera.
    #[error("expected camera=rate, got `{0}`")]
    NoCamera(String),
    /// The same name again.
    #[error("{what} `{name}` is given twice")]
    Twice {
        /// What the name names.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A name that nothing has.
    #[error("unknown {what} `{got}`")]
    Unknown {
        /// What the name should name.
        what: &'static str,
        /// The name.
        got: String,
        /// What to do instead.
        hint: String,
    },
    /// A value of a scenario where no scenario is read.
    #[error("a value of a scenario can be set only where --road names one")]
    NoRoad,
    /// Not the form of a varied parameter.
    #[error("a varied parameter has the form path=from:to[:step] or path=[a,b,..], got `{0}`")]
    VaryForm(String),
    /// A value that a choice cannot have.
    #[error("`{path}` must be {wanted}, got `{got}`")]
    Choice {
        /// The choice.
        path: String,
        /// What it may be.
        wanted: &'static str,
        /// What was typed.
        got: String,
    },
    /// A choice of values that are drawn.
    #[error(
        "a choice has listed values, path=from:to[:step] or path=[a,b,..], and none that are drawn"
    )]
    DrawnChoice,
    /// A list of values without one.
    #[error("a varied parameter needs at least one value")]
    NoValue,
    /// Not the form of a distribution.
    #[error("a distribution is uniform(from,to) or normal(mean,deviation), got `{0}`")]
    Distribution(String),
    /// Something to draw, and not how many.
    #[error("`{0}` is drawn, so samples must say how often")]
    NoSamples(String),
    /// How many to draw, and nothing to draw.
    #[error("nothing is drawn: no parameter varies as uniform or normal")]
    NothingDrawn,
    /// More parameters than a sequence has bases for.
    #[error("halton draws at most {most} parameters, got {got}")]
    ManyDrawn {
        /// The most allowed.
        most: usize,
        /// How many there are.
        got: usize,
    },
    /// Not the form of a constraint.
    #[error("a constraint compares two varied parameters or numbers, as a<b or a>=3, got `{0}`")]
    Comparison(String),
    /// A constraint on a parameter that is no number.
    #[error("`{path}` is not only numbers: it has `{value}`")]
    Incomparable {
        /// The parameter.
        path: String,
        /// A value of it.
        value: String,
    },
    /// A constraint that nothing fulfils.
    #[error("no combination of values is left")]
    NoPoint,
    /// Not the form of a shard.
    #[error("a shard has the form k/n, got `{0}`")]
    ShardForm(String),
    /// More points than can be kept.
    #[error("the varied parameters make more than {most} combinations")]
    ManyPoints {
        /// The most allowed.
        most: usize,
    },
    /// A flag that means nothing for a table of runs.
    #[error("{0} is for traces, and this is a table of runs")]
    OfTraces(&'static str),
    /// A file that is no table of runs.
    #[error("`{path}` is no table of runs: {why}")]
    NoTable {
        /// Which.
        path: String,
        /// Why.
        why: zhuyi_report::sweep::table::InvalidTable,
    },
    /// A flag that says what the plan says.
    #[error("a plan says all that is driven: {0} cannot stand beside it")]
    BesidePlan(&'static str),
    /// Something else to drive beside a plan.
    #[error("a plan says all that is driven: it stands alone")]
    PlanAlone,
    /// A plan where no sweep is made.
    #[error("`{0}` is the plan of a sweep")]
    IsPlan(String),
    /// A program that was built without Parquet.
    #[error("this zhuyi was built without Parquet")]
    NoParquet,
    /// The name of a new scenario that cannot be one.
    #[error("a name is made of letters, digits, `_` and `-`, got `{0}`")]
    Name(String),
}

impl Fault {
    /// A number out of its range.
    pub fn limits<N: ToString>(what: &'static str, allowed: &RangeInclusive<N>, got: &str) -> Self {
        Self::Limits {
            what,
            low: allowed.start().to_string(),
            high: allowed.end().to_string(),
            got: got.to_string(),
        }
    }

    /// What stands beside the caret.
    pub fn hint(&self) -> Option<&str> {
        match self {
            Self::Unknown { hint, .. } => Some(hint),
            Self::NoParquet => {
                Some("cargo install --locked --path crates/zhuyi-cli --features parquet")
            }
            Self::BesidePlan(_) => Some("write it into the plan"),
            Self::IsPlan(_) => Some("zhuyi sweep and zhuyi check take it"),
            Self::ShardForm(_) => Some("the second of three is 2/3"),
            Self::Name(_) => Some("--output takes a path"),
            Self::Reversed { .. } => Some("the smaller number first"),
            Self::NoTable { .. } => Some("a folder that zhuyi sweep or reproduce wrote"),
            Self::ManyCombinations { cameras: 0, .. } => {
                Some("no camera of the system is analysed")
            }
            Self::ManyCombinations { .. } => Some("fewer rates, as 1:30:3"),
            Self::Policy(_) => Some("zhuyi help run lists them"),
            _ => None,
        }
    }
}
