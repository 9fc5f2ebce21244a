//! What is wrong with a trace: every violation with its line, its column and the rule.

use std::fmt;
use std::ops::Range;

/// All that is wrong with a trace, in the order of its lines; not empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Invalid {
    violations: Vec<Violation>,
}

/// One broken rule and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Number of the line, from 1.
    pub line: usize,
    /// The line.
    pub text: String,
    /// What of the line breaks the rule, in bytes.
    pub place: Range<usize>,
    /// What is broken.
    pub rule: Rule,
    /// How often the same is broken further on, which is not told.
    pub more: usize,
}

/// A rule for traces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Rule {
    /// An empty file.
    #[error("a trace begins with a line of column names, got nothing")]
    NoHeader,
    /// Names and nothing below them.
    #[error("a trace needs at least one row below the column names")]
    NoRows,
    /// No column of ours at all.
    #[error("none of the columns of a trace is there")]
    NoColumn,
    /// A column that is not there.
    #[error("the column `{0}` is missing")]
    MissingColumn(&'static str),
    /// A column that is there twice.
    #[error("the column `{0}` is there twice")]
    ColumnTwice(String),
    /// A row that is longer or shorter than the header.
    #[error("a row has as many fields as there are columns, {expected}, got {got}")]
    Fields {
        /// Number of columns.
        expected: usize,
        /// Number of fields.
        got: usize,
    },
    /// No number where one belongs.
    #[error("`{column}` must be a number, got {}", quoted(.got))]
    NotNumber {
        /// The column.
        column: &'static str,
        /// What stands there.
        got: String,
    },
    /// NaN, infinite, or so large that it is no measurement.
    #[error("`{column}` must be a number from -1e12 to 1e12, got {got}")]
    NotFinite {
        /// The column.
        column: &'static str,
        /// What stands there.
        got: String,
    },
    /// A box without extent.
    #[error("`{column}` must be above 0, got {got}")]
    NotPositive {
        /// The column.
        column: &'static str,
        /// What stands there.
        got: String,
    },
    /// A vehicle without a name.
    #[error("`id` must not be empty")]
    NoId,
    /// A row that is earlier than the one before it.
    #[error("time goes backwards, from {before} to {got} s")]
    Backwards {
        /// The time before.
        before: String,
        /// The time.
        got: String,
    },
    /// Two times that are hardly apart: speeds between them would mean nothing.
    #[error("two times are the same or at least 1e-6 s apart, got {before} and {got} s")]
    TooClose {
        /// The time before.
        before: String,
        /// The time.
        got: String,
    },
    /// Two rows of one vehicle at one time.
    #[error("`{id}` is there twice at {time} s, first in line {first}")]
    Twice {
        /// The vehicle.
        id: String,
        /// The time.
        time: String,
        /// The line of its first row.
        first: usize,
    },
    /// An ego that never occurs.
    #[error("no row has the id of the ego, `{ego}`")]
    NoEgo {
        /// The id looked for.
        ego: String,
        /// Those that occur.
        known: Vec<String>,
    },
    /// A field that begins with a quote and does not end with one where it should.
    #[error("a quote is not closed")]
    OpenQuote,
    /// A record that is no CSV.
    #[error("not valid CSV: {0}")]
    Csv(String),
}

/// Places told at most of one broken rule.
pub const MOST: usize = 20;

/// Ids told at most, where one is not found.
const TOLD: usize = 12;

impl Rule {
    /// What stands beside the caret.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoEgo { known, .. } if !known.is_empty() => {
                let more = known.len().saturating_sub(TOLD);
                let told = known[..known.len() - more].join(", ");
                Some(match more {
                    0 => format!("known: {told}"),
                    more => format!("known: {told} and {more} more"),
                })
            }
            Self::NoColumn => Some("is it separated by commas?".to_string()),
            Self::OpenQuote => Some("opened here".to_string()),
            Self::Backwards { .. } => Some("rows stand in the order of time".to_string()),
            _ => None,
        }
    }
}

impl Violation {
    /// What stands below, where more of the same is not told.
    ///
    /// ```
    /// use zhuyi_log::Log;
    /// let header = "time_s,id,x_m,y_m,heading_rad,speed_mps,accel_mps2,length_m,width_m\n";
    /// let rows: Vec<String> = (0..2020).map(|time| format!("{time},a,0,0,0,fast,0,4,2\n")).collect();
    /// let invalid = Log::read(&(header.to_string() + &rows.concat()), Some("a")).unwrap_err();
    /// let last = invalid.violations().last().unwrap();
    /// assert_eq!((last.line, last.rest().as_deref()), (21, Some("and 2,000 more like this")));
    /// ```
    pub fn rest(&self) -> Option<String> {
        (self.more > 0).then(|| format!("and {} more like this", grouped(self.more)))
    }

    /// Column of the place, from 1, in characters.
    pub fn column(&self) -> usize {
        let before = self.text.get(..self.place.start).unwrap_or(&self.text);
        before.chars().count() + 1
    }
}

impl Invalid {
    pub(crate) fn new(mut violations: Vec<Violation>) -> Self {
        violations.sort_by_key(|violation| violation.line);
        Self { violations }
    }

    /// Every violation, but of one rule at most [`MOST`].
    pub fn violations(&self) -> &[Violation] {
        &self.violations
    }
}

/// One line per violation, `line:column: rule`, and one more where more of the same is not told.
impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (index, violation) in self.violations.iter().enumerate() {
            let end = if index == 0 { "" } else { "\n" };
            let (line, column) = (violation.line, violation.column());
            write!(f, "{end}{line}:{column}: {}", violation.rule)?;
            if let Some(rest) = violation.rest() {
                write!(f, "\n{rest}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Invalid {}

/// With commas between thousands.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

fn quoted(text: &str) -> String {
    if text.is_empty() {
        "nothing".to_string()
    } else {
        format!("`{text}`")
    }
}
