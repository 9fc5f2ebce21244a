//! What is wrong with a file: every violation with its place, drawn with a caret.

use crate::conflict::Conflict;
use crate::source::Source;
use crate::suggestion::did_you_mean;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use std::fmt;
use std::ops::Range;

/// All that is wrong with what was read: by file, then by place.
#[derive(Clone, Debug, PartialEq)]
pub struct Invalid {
    violations: Vec<Violation>,
}

impl Invalid {
    pub(crate) fn new(violations: Vec<Violation>) -> Self {
        Self { violations }
    }

    /// Every violation.
    pub fn violations(&self) -> &[Violation] {
        &self.violations
    }

    /// The violations of both.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.violations.extend(other.violations);
        self
    }

    /// Every violation on one line, as a field of a table has room for: `default.ron:36:9: planner needs `min_gap_m``.
    pub fn brief(&self) -> String {
        let brief: Vec<String> = self
            .violations
            .iter()
            .map(|violation| {
                let (line, column) = violation.line_column();
                format!(
                    "{}:{line}:{column}: {}",
                    violation.source_name(),
                    violation.rule
                )
            })
            .collect();
        brief.join("; ").replace(['\n', '\r'], " ")
    }

    /// Every violation with its line and a caret; coloured for terminals if wanted. [`fmt::Display`] is the plain form.
    pub fn render(&self, coloured: bool) -> String {
        let renderer = if coloured {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let drawn: Vec<String> = self
            .violations
            .iter()
            .map(|violation| violation.render(&renderer))
            .collect();
        drawn.join("\n\n")
    }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Invalid {}

impl From<Violation> for Invalid {
    fn from(violation: Violation) -> Self {
        Self::new(vec![violation])
    }
}

/// One broken rule and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    source: Source,
    span: Range<usize>,
    rule: Rule,
    beside: Option<(Range<usize>, &'static str)>,
}

impl Violation {
    pub(crate) fn new(source: &Source, span: Range<usize>, rule: Rule) -> Self {
        Self {
            source: source.clone(),
            span,
            rule,
            beside: None,
        }
    }

    /// With another place that has to do with it, when that is in the same text.
    pub(crate) fn beside(
        mut self,
        source: &Source,
        span: Range<usize>,
        label: &'static str,
    ) -> Self {
        self.beside = (*source == self.source).then_some((span, label));
        self
    }

    /// What is broken.
    pub fn rule(&self) -> &Rule {
        &self.rule
    }

    /// The name of the source that it stands in.
    pub fn source_name(&self) -> &str {
        self.source.name()
    }

    /// Line and column, from 1.
    pub fn line_column(&self) -> (usize, usize) {
        self.source.line_column(self.span.start)
    }

    /// The byte at which it begins.
    pub(crate) fn start(&self) -> usize {
        self.span.start
    }

    pub(crate) fn is_in(&self, source: &Source) -> bool {
        self.source == *source
    }

    fn render(&self, renderer: &Renderer) -> String {
        let title = self.rule.to_string();
        let caret = AnnotationKind::Primary
            .span(self.span.clone())
            .label(self.rule.hint());
        let mut snippet = Snippet::source(self.source.text())
            .path(self.source.name())
            .annotation(caret);
        if let Some((span, label)) = &self.beside {
            snippet = snippet.annotation(AnnotationKind::Context.span(span.clone()).label(*label));
        }
        let group: Group = Level::ERROR.primary_title(&title).element(snippet);
        renderer.render(&[group])
    }
}

/// A rule that a file breaks.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Rule {
    /// The text is no RON.
    #[error("not valid RON: {}", lower_case(_0))]
    Syntax(String),
    /// A setting without `=`.
    #[error("a setting has the form `path=value`")]
    NoEquals,
    /// A value of another type.
    #[error("expected {expected}, got `{got}`")]
    Shape {
        /// What belongs here.
        expected: &'static str,
        /// What stands here.
        got: String,
    },
    /// A number out of its range.
    #[error("`{name}` must be {limits}, got {got}")]
    Range {
        /// The field.
        name: String,
        /// The range.
        limits: String,
        /// The number.
        got: String,
    },
    /// A list with too few or too many entries.
    #[error("`{name}` must have {limits} entries, got {got}")]
    Count {
        /// The list.
        name: String,
        /// How many it may have.
        limits: String,
        /// How many it has.
        got: usize,
    },
    /// A field that is not there.
    #[error("{of} needs `{name}`")]
    Missing {
        /// The field.
        name: String,
        /// Of what.
        of: String,
    },
    /// Not exactly one of fields that exclude each other.
    #[error("give exactly one of {}, got {}", list(names), list(got))]
    OneOf {
        /// The fields.
        names: Vec<String>,
        /// Those that are there.
        got: Vec<String>,
    },
    /// Given more than once.
    #[error("`{name}` is given twice")]
    Twice {
        /// What.
        name: String,
    },
    /// A name that is not known.
    #[error("unknown {what} `{got}`")]
    Unknown {
        /// What kind of name.
        what: &'static str,
        /// The name.
        got: String,
        /// The known name that comes nearest.
        nearest: Option<String>,
        /// All known names.
        known: Vec<String>,
    },
    /// Anything that holds between values.
    #[error(transparent)]
    Between(#[from] Conflict),
}

impl Rule {
    /// An unknown name with what is known there.
    pub(crate) fn unknown<'a>(
        what: &'static str,
        got: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<&str> = known.into_iter().collect();
        Self::misspelt(what, got, did_you_mean(got, known.iter().copied()), known)
    }

    /// An unknown name with what it may have meant and what is known there.
    pub(crate) fn misspelt<'a>(
        what: &'static str,
        got: &str,
        nearest: Option<&str>,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let nearest = nearest.map(ToString::to_string);
        let known = known.into_iter().map(ToString::to_string).collect();
        Self::Unknown {
            what,
            got: got.to_string(),
            nearest,
            known,
        }
    }

    /// Fields that exclude each other, of which none or more than one is there.
    pub(crate) fn one_of<'a>(names: &[&str], got: impl IntoIterator<Item = &'a str>) -> Self {
        let owned = |name: &str| name.to_string();
        Self::OneOf {
            names: names.iter().copied().map(owned).collect(),
            got: got.into_iter().map(owned).collect(),
        }
    }

    /// What stands beside the caret.
    fn hint(&self) -> Option<String> {
        match self {
            Self::Unknown {
                nearest: Some(name),
                ..
            } => Some(format!("did you mean `{name}`?")),
            Self::Unknown { known, .. } if !known.is_empty() => {
                Some(format!("known: {}", known.join(", ")))
            }
            _ => None,
        }
    }
}

fn list(names: &[String]) -> String {
    match names {
        [] => "none".to_string(),
        names => names
            .iter()
            .map(|name| format!("`{name}`"))
            .collect::<Vec<_>>()
            .join(", "),
    }
}

/// Without the capital that begins RON's own messages.
fn lower_case(message: &str) -> String {
    let mut rest = message.chars();
    rest.next().map_or_else(String::new, |first| {
        first.to_lowercase().chain(rest).collect()
    })
}
