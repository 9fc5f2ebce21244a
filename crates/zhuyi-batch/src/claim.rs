//! A claim of the paper's and its verdict.

use std::fmt;

/// A claim and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Its number in the reading's section 4, with a letter where it says several things: `1`, `2a`, `2b`.
    pub number: &'static str,
    /// What is claimed.
    pub title: &'static str,
    /// What became of it.
    pub verdict: Verdict,
    /// The figures, in one sentence without its full stop.
    pub figures: String,
    /// All that is to be told, in Markdown.
    pub details: String,
}

/// What became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds.
    Holds,
    /// It does not.
    Fails,
    /// A figure to look at, without a bound to hold.
    FigureOnly,
}

impl Verdict {
    /// Returns whether it holds.
    pub fn holds_if(condition: bool) -> Self {
        if condition { Self::Holds } else { Self::Fails }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::FigureOnly => "figure only",
        })
    }
}
