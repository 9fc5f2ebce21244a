//! A value that knows where it stands, and what can be read from it.
//!
//! Every reader reports what is wrong and gives `None`; its caller goes on with what stands beside it.

use crate::fields::Fields;
use crate::invalid::{Rule, Violation};
use crate::limits::Limits;
use crate::plan::Piece;
use crate::reading::{Reading, join};
use crate::source::Source;
use crate::syntax::{self, Parts};
use serde::de::Deserialize;
use std::ops::{Range, RangeInclusive};

/// A value, where it stands, and the path that leads to it.
#[derive(Clone)]
pub(crate) struct Node<'a> {
    reading: &'a Reading<'a>,
    source: &'a Source,
    value: &'a str,
    path: String,
}

/// Names of variants, each with what reads its fields.
pub(crate) type Variants<'a, 'b, T> = &'b [(&'static str, &'b dyn Fn(&Fields<'a>) -> Option<T>)];

impl<'a> Node<'a> {
    pub(crate) fn new(
        reading: &'a Reading<'a>,
        source: &'a Source,
        value: &'a str,
        path: String,
    ) -> Self {
        Self {
            reading,
            source,
            value,
            path,
        }
    }

    /// Whether both stand in the same text.
    pub(crate) fn is_beside(&self, other: &Node) -> bool {
        self.source == other.source
    }

    /// What a caret marks: the value, or the first word or bracket of one of many lines.
    fn mark(&self) -> Range<usize> {
        if self.value.contains('\n') {
            self.head()
        } else {
            self.source.span_of(self.value)
        }
    }

    /// Its first word or bracket.
    fn head(&self) -> Range<usize> {
        let word = self
            .value
            .find(|c: char| !c.is_alphanumeric() && c != '_')
            .unwrap_or(self.value.len());
        let first = self.value.chars().next().map_or(0, char::len_utf8);
        self.source.span_of(&self.value[..word.max(first)])
    }

    /// Reports that it breaks a rule.
    pub(crate) fn refuse(&self, rule: impl Into<Rule>) {
        self.report(self.mark(), rule.into());
    }

    /// Reports that it breaks a rule together with another value.
    pub(crate) fn refuse_beside(&self, rule: impl Into<Rule>, other: &Node) {
        let violation = Violation::new(self.source, self.mark(), rule.into());
        self.reading
            .report(violation.beside(other.source, other.mark(), "the other one"));
    }

    /// Reports that something about it as a whole breaks a rule.
    pub(crate) fn refuse_whole(&self, rule: impl Into<Rule>) {
        self.report(self.head(), rule.into());
    }

    /// Reports that the name of one of its fields breaks a rule.
    pub(crate) fn refuse_key(&self, key: &str, rule: Rule) {
        self.report(self.source.span_of(key), rule);
    }

    /// Reports that one of its fields is given again.
    pub(crate) fn refuse_again(&self, key: &str, first: &str) {
        let violation = Violation::new(
            self.source,
            self.source.span_of(key),
            Rule::Twice {
                name: key.to_string(),
            },
        );
        self.reading.report(violation.beside(
            self.source,
            self.source.span_of(first),
            "first given here",
        ));
    }

    fn report(&self, span: Range<usize>, rule: Rule) {
        self.take_down(Violation::new(self.source, span, rule));
    }

    /// Reports what something else has found in the same text.
    pub(crate) fn take_down(&self, violation: Violation) {
        self.reading.report(violation);
    }

    /// Reports that it is not what was expected, and gives up on what it holds.
    fn mismatch<T>(&self, expected: &'static str) -> Option<T> {
        self.refuse(Rule::Shape {
            expected,
            got: syntax::excerpt(self.value),
        });
        self.reading.give_up(&self.path);
        None
    }

    fn parse<T: Deserialize<'a>>(&self, expected: &'static str) -> Option<T> {
        ron::from_str(self.value)
            .ok()
            .or_else(|| self.mismatch(expected))
    }

    /// The last name of its path.
    fn name(&self) -> String {
        self.path
            .rsplit('.')
            .next()
            .unwrap_or(&self.path)
            .to_string()
    }

    /// Reports a number that lies outside its range.
    fn out_of<T>(&self, limits: String, got: String) -> Option<T> {
        self.refuse(Rule::Range {
            name: self.name(),
            limits,
            got,
        });
        None
    }

    /// Its number, within limits.
    pub(crate) fn number(&self, limits: Limits) -> Option<f64> {
        let number: f64 = self.parse("a number")?;
        // Adding 0 makes 0 of -0, a sign that nobody could see.
        if limits.contain(number) {
            Some(number + 0.0)
        } else {
            self.out_of(limits.to_string(), number.to_string())
        }
    }

    /// [m/s] its number of miles per hour, within limits in metres per second.
    pub(crate) fn miles_per_hour(&self, limits: Limits) -> Option<f64> {
        /// [m/s] one mile per hour, exactly.
        const MILE_PER_HOUR: f64 = 0.447_04;
        let number: f64 = self.parse("a number")?;
        let speed = number * MILE_PER_HOUR;
        if limits.contain(speed) {
            Some(speed + 0.0)
        } else {
            self.out_of(
                format!("{limits} m/s"),
                format!("{number} mph ({speed:.3} m/s)"),
            )
        }
    }

    /// Its whole number, within limits.
    pub(crate) fn whole(&self, limits: RangeInclusive<u32>) -> Option<u32> {
        let number: i64 = self.parse("a whole number")?;
        let within = u32::try_from(number)
            .ok()
            .filter(|number| limits.contains(number));
        within.or_else(|| {
            self.out_of(
                format!("{} to {}", limits.start(), limits.end()),
                number.to_string(),
            )
        })
    }

    /// Its text.
    pub(crate) fn text(&self) -> Option<String> {
        self.parse("a text in double quotes")
    }

    /// Its text, of one line that is not empty.
    pub(crate) fn line(&self) -> Option<String> {
        let is_line = |text: &String| !text.trim().is_empty() && !text.contains(char::is_control);
        self.text().and_then(|text| {
            if is_line(&text) {
                Some(text)
            } else {
                self.mismatch("one line of text")
            }
        })
    }

    /// All of it, which must stand on one line.
    pub(crate) fn one_line(&self) -> Option<Piece> {
        if self.value.contains(['\n', '\r']) {
            self.mismatch("a value on one line")
        } else {
            Some(Piece::new(self.source, self.source.span_of(self.value)))
        }
    }

    /// Its text where that stands between the quotes as it is meant: on one line, and without escapes.
    pub(crate) fn words(&self) -> Option<Piece> {
        let text = self.text()?;
        let inside = self.value.find('"').map_or(0, |quote| quote + 1);
        let rest = self.value.get(inside..).unwrap_or("");
        let is_plain = rest.strip_prefix(text.as_str());
        if is_plain.is_none_or(|rest| !rest.starts_with('"')) || text.contains(['\n', '\r']) {
            return self.mismatch("one line of text without escapes");
        }
        let span = self.source.span_of(&rest[..text.len()]);
        Some(Piece::new(self.source, span))
    }

    /// Its truth value.
    pub(crate) fn truth(&self) -> Option<bool> {
        self.parse("`true` or `false`")
    }

    /// The entries of a list, each found under its place, or under its `name` where it has one.
    pub(crate) fn list(&self, limits: RangeInclusive<usize>) -> Option<Vec<Node<'a>>> {
        let entries = syntax::entries(self.value).or_else(|| self.mismatch("a list `[..]`"))?;
        if !limits.contains(&entries.len()) {
            self.reading.give_up(&self.path);
            let limits = format!("{} to {}", limits.start(), limits.end());
            self.refuse(Rule::Count {
                name: self.name(),
                limits,
                got: entries.len(),
            });
            return None;
        }
        let nodes = entries
            .into_iter()
            .enumerate()
            .filter_map(|(index, entry)| {
                let name = Parts::of(entry)
                    .and_then(|parts| parts.own_name())
                    .unwrap_or_else(|| index.to_string());
                self.reading
                    .look_up(join(&self.path, &name), self.source, Some(entry))
            });
        Some(nodes.collect())
    }

    /// Whether the variant of this name stands here.
    pub(crate) fn is(&self, variant: &str) -> bool {
        Parts::of(self.value).is_some_and(|parts| parts.name == Some(variant))
    }

    /// The text of its field `name`.
    pub(crate) fn own_name(&self) -> Option<String> {
        Parts::of(self.value)?.own_name()
    }

    /// A field of the struct that stands here, if the file or a setting has it.
    pub(crate) fn field(&self, name: &str) -> Option<Node<'a>> {
        self.below(
            name,
            Parts::of(self.value).and_then(|parts| parts.field(name)),
        )
    }

    /// What stands at a name below: a setting's value, or else this one.
    pub(crate) fn below(&self, name: &str, value: Option<&'a str>) -> Option<Node<'a>> {
        self.reading
            .look_up(join(&self.path, name), self.source, value)
    }

    /// What `read` makes of the fields of this struct, which may carry its name: `(..)` or `Name(..)`.
    pub(crate) fn structure<T>(
        &self,
        name: &'static str,
        read: impl FnOnce(&Fields<'a>) -> Option<T>,
    ) -> Option<T> {
        match Parts::of(self.value) {
            Some(parts) if parts.name.is_none_or(|own| own == name) => {
                Fields::read(self, name, parts, read)
            }
            _ => self.mismatch("fields in brackets `(name: value, ..)`"),
        }
    }

    /// What the reader of the variant that stands here makes of its fields.
    pub(crate) fn variant<T>(
        &self,
        what: &'static str,
        variants: Variants<'a, '_, T>,
    ) -> Option<T> {
        let parts = Parts::of(self.value);
        let name = parts
            .as_ref()
            .map_or(self.value, |parts| parts.name.unwrap_or(self.value));
        match (variants.iter().find(|(known, _)| *known == name), parts) {
            (Some((name, read)), Some(parts)) => Fields::read(self, name, parts, read),
            (None, None) if self.value.ends_with(')') => self.mismatch("named fields in brackets"),
            _ => {
                let known = variants.iter().map(|(known, _)| *known);
                self.refuse_whole(Rule::unknown(what, &syntax::excerpt(name), known));
                self.reading.give_up(&self.path);
                None
            }
        }
    }
}
