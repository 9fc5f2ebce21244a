//! The range that a number must lie in. NaN lies in none.

use std::fmt;

/// A range of numbers with both ends included, or with the lower one left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    pub(crate) low: f64,
    pub(crate) high: f64,
    above: bool,
}

/// `low` to `high`, both included.
pub(crate) const fn within(low: f64, high: f64) -> Limits {
    Limits {
        low,
        high,
        above: false,
    }
}

/// Above `low`, up to and with `high`.
pub(crate) const fn above(low: f64, high: f64) -> Limits {
    Limits {
        low,
        high,
        above: true,
    }
}

impl Limits {
    /// Whether a number lies within.
    pub(crate) fn contain(self, number: f64) -> bool {
        (if self.above {
            number > self.low
        } else {
            number >= self.low
        }) && number <= self.high
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { low, high, above } = self;
        if *above {
            write!(f, "above {low} and at most {high}")
        } else {
            write!(f, "{low} to {high}")
        }
    }
}
