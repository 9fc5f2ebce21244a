//! Text with a name: a file, or the argument of `--set`.

use crate::invalid::{Invalid, Rule, Violation};
use crate::syntax::{self, Parts};
use std::ffi::OsStr;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// A text to be read and the name that errors call it by. Cheap to clone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source(Arc<Inner>);

#[derive(Debug, PartialEq, Eq)]
struct Inner {
    name: String,
    text: String,
}

impl Source {
    /// A source. A line end is added where the last line has none, so that a comment may stand there; the byte order
    /// mark that some editors write first is dropped.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let (name, mut text) = (name.into(), text.into());
        if text.starts_with('\u{feff}') {
            text.remove(0);
        }
        if !text.ends_with('\n') {
            text.push('\n');
        }
        Self(Arc::new(Inner { name, text }))
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Its name without folder and ending.
    pub fn stem(&self) -> &str {
        Path::new(self.name())
            .file_stem()
            .and_then(OsStr::to_str)
            .unwrap_or(self.name())
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// Where `part`, a slice of this text, stands in it.
    pub(crate) fn span_of(&self, part: &str) -> Range<usize> {
        let start = part
            .as_ptr()
            .addr()
            .saturating_sub(self.text().as_ptr().addr())
            .min(self.text().len());
        start..(start + part.len()).min(self.text().len())
    }

    /// Line and column, from 1, of a byte; the column counts characters.
    pub fn line_column(&self, byte: usize) -> (usize, usize) {
        let before = self.text().get(..byte).unwrap_or(self.text());
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        (
            before.matches('\n').count() + 1,
            before[line_start..].chars().count() + 1,
        )
    }
}

/// One of the three kinds of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Road, ego's start, actors.
    Scenario,
    /// The ego's hardware and software.
    System,
    /// What a sweep is made of.
    Plan,
}

impl Kind {
    /// What a source looks like: a plan or a system when any of its fields is one of those.
    pub fn of(source: &Source) -> Self {
        let parts = syntax::root(source, 0).ok().and_then(Parts::of);
        let has_any_of = |names: &[&str]| {
            let mut fields = parts.iter().flat_map(|parts| &parts.fields);
            fields.any(|(key, _)| names.contains(key))
        };
        if has_any_of(&PLAN_FIELDS) {
            Self::Plan
        } else if has_any_of(&SYSTEM_FIELDS) {
            Self::System
        } else {
            Self::Scenario
        }
    }
}

/// Names of the fields at the top of a scenario file. No system file has any of them.
pub(crate) const SCENARIO_FIELDS: [&str; 5] = ["title", "road", "ego", "duration_s", "actors"];
/// Names of the fields at the top of a system file.
pub(crate) const SYSTEM_FIELDS: [&str; 8] = [
    "vehicle",
    "perception",
    "prediction",
    "planner",
    "estimator",
    "compute",
    "online",
    "jitter",
];

/// Names of the fields at the top of a plan. No other file has any of them.
const PLAN_FIELDS: [&str; 10] = [
    "scenarios",
    "system",
    "set",
    "fpr",
    "seeds",
    "root_seed",
    "vary",
    "where",
    "samples",
    "sampling",
];

/// `path=value`: one value of a scenario or system file given elsewhere, as by `--set planner.time_headway_s=1.2`.
///
/// The path names fields from the top of the file, separated by dots; an actor or camera by its name, an entry of
/// another list by its place from 0, and the fields of a variant like those of its field:
/// `actors.lead.manoeuvres.0.then.duration_s`. The value is RON and passes the same checks as one in the file.
///
/// ```
/// use zhuyi_scenario::{Kind, Setting};
/// assert_eq!(Setting::parse("actors.lead.speed_mps=12")?.kind(), Kind::Scenario);
/// assert_eq!(Setting::parse("planner.min_gap_m=3")?.kind(), Kind::System);
/// assert!(Setting::parse("planer.min_gap_m=3").is_err());
/// # Ok::<(), zhuyi_scenario::Invalid>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    source: Source,
    path: Range<usize>,
    value: Range<usize>,
    kind: Kind,
}

impl Setting {
    /// The name that errors call it by.
    const SOURCE: &str = "--set";

    /// A setting from `path=value`.
    ///
    /// # Errors
    /// When there is no `=`, the path belongs to neither kind of file, or the value is no RON.
    pub fn parse(argument: &str) -> Result<Self, Invalid> {
        Self::parse_as(Self::SOURCE, argument)
    }

    /// The same where errors call it by another name, as `--vary`.
    ///
    /// # Errors
    /// As [`Setting::parse`].
    pub fn parse_as(name: &str, argument: &str) -> Result<Self, Invalid> {
        let source = Source::new(name, argument);
        let text = source.text();
        let Some(equals) = text.find('=') else {
            return Err(Violation::new(&source, 0..argument.len(), Rule::NoEquals).into());
        };
        let path = source.span_of(text[..equals].trim());
        let value = source.span_of(syntax::root(&source, equals + 1)?);
        Self::at(&source, path, value)
    }

    /// A setting whose path and value stand somewhere in a source.
    pub(crate) fn at(
        source: &Source,
        path: Range<usize>,
        value: Range<usize>,
    ) -> Result<Self, Invalid> {
        let top = &source.text()[path.clone()];
        let top = top.split_once('.').map_or(top, |(top, _)| top);
        let kind = if SCENARIO_FIELDS.contains(&top) {
            Kind::Scenario
        } else if SYSTEM_FIELDS.contains(&top) {
            Kind::System
        } else {
            let known = SCENARIO_FIELDS.into_iter().chain(SYSTEM_FIELDS);
            let rule = Rule::unknown("setting", top, known);
            let span = path.start..path.start + top.len();
            return Err(Violation::new(source, span, rule).into());
        };
        Ok(Self {
            source: source.clone(),
            path,
            value,
            kind,
        })
    }

    /// Which kind of file it belongs to; never a plan.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    pub(crate) fn source(&self) -> &Source {
        &self.source
    }

    /// Which value it is.
    pub fn path(&self) -> &str {
        &self.source.text()[self.path.clone()]
    }

    /// The value, as RON.
    pub fn value(&self) -> &str {
        &self.source.text()[self.value.clone()]
    }

    /// The entries of the value, as RON, if it is a list.
    ///
    /// ```
    /// use zhuyi_scenario::Setting;
    /// let grids = Setting::parse("estimator.grid=[Ms33, Fps]")?;
    /// assert_eq!(grids.entries().unwrap(), ["Ms33", "Fps"]);
    /// assert!(Setting::parse("estimator.grid=Fps")?.entries().is_none());
    /// # Ok::<(), zhuyi_scenario::Invalid>(())
    /// ```
    pub fn entries(&self) -> Option<Vec<&str>> {
        syntax::entries(self.value())
    }

    pub(crate) fn path_span(&self) -> Range<usize> {
        self.path.clone()
    }
}
