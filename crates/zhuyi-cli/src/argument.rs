//! One argument of the command line, or what stands for it in a plan, of which parts can be pointed at.

use std::ops::{Range, RangeInclusive};

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use zhuyi_scenario::Piece;

use crate::fault::Fault;
use crate::problems::Problems;

/// An argument by the name that errors call it by, as `--fpr`, and its text: all of what was typed, or a part of it or of a file.
#[derive(Clone, Copy, Debug)]
pub struct Argument<'a> {
    name: &'a str,
    text: &'a str,
    start: usize,
    end: usize,
}

impl<'a> Argument<'a> {
    /// An argument.
    pub const fn new(name: &'a str, text: &'a str) -> Self {
        let (start, end) = (0, text.len());
        Self {
            name,
            text,
            start,
            end,
        }
    }

    /// What stands in a file.
    pub fn of(piece: &'a Piece) -> Self {
        let whole = Self::new(piece.source().name(), piece.source().text());
        whole.within(&piece.span())
    }

    /// A part of it.
    #[must_use]
    pub fn within(self, place: &Range<usize>) -> Self {
        let Range { start, end } = *place;
        Self { start, end, ..self }
    }

    /// Where all of it stands.
    pub const fn all(self) -> Range<usize> {
        self.start..self.end
    }

    /// All of it.
    pub fn typed(self) -> &'a str {
        self.at(&self.all())
    }

    /// The text at a place.
    pub fn at(self, place: &Range<usize>) -> &'a str {
        &self.text[place.clone()]
    }

    /// The parts of a place between separators, without the blanks around them.
    pub fn parts(self, place: &Range<usize>, separator: char) -> Vec<Range<usize>> {
        let mut next = place.start;
        let mut trimmed = |part: &str| {
            let start = next + (part.len() - part.trim_start().len());
            next += part.len() + separator.len_utf8();
            start..start + part.trim().len()
        };
        self.at(place).split(separator).map(&mut trimmed).collect()
    }

    /// A place without the blanks around it.
    pub fn trimmed(self, place: &Range<usize>) -> Range<usize> {
        let text = self.at(place);
        let start = place.start + (text.len() - text.trim_start().len());
        start..start + text.trim().len()
    }

    /// A whole number within limits.
    pub fn whole(
        self,
        place: &Range<usize>,
        what: &'static str,
        limits: RangeInclusive<u64>,
        problems: &mut Problems,
    ) -> Option<u64> {
        let text = self.at(place);
        let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
        let fault = if text.is_empty() {
            Fault::Empty("a whole number")
        } else if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            Fault::NotWhole(text.to_string())
        } else {
            match text.parse() {
                Ok(number) if limits.contains(&number) => return Some(number),
                _ => Fault::limits(what, &limits, text),
            }
        };
        self.refuse(place, fault, problems);
        None
    }

    /// A number within limits.
    pub fn number(
        self,
        place: &Range<usize>,
        what: &'static str,
        limits: RangeInclusive<f64>,
        problems: &mut Problems,
    ) -> Option<f64> {
        let text = self.at(place);
        let fault = match text.parse::<f64>() {
            Ok(number) if limits.contains(&number) => return Some(number),
            Ok(_) => Fault::limits(what, &limits, text),
            Err(_) if text.is_empty() => Fault::Empty("a number"),
            Err(_) => Fault::NotNumber(text.to_string()),
        };
        self.refuse(place, fault, problems);
        None
    }

    /// Notes a fault of a part.
    pub fn refuse(self, place: &Range<usize>, fault: Fault, problems: &mut Problems) {
        problems.push(Misreading {
            name: self.name.to_string(),
            text: self.text.to_string(),
            place: place.clone(),
            fault,
        });
    }
}

/// A part of an argument that cannot be taken as meant.
#[derive(Clone, Debug, PartialEq)]
pub struct Misreading {
    name: String,
    text: String,
    place: Range<usize>,
    fault: Fault,
}

impl Misreading {
    /// The argument with a caret, drawn like a violation in a file.
    pub fn render(&self, renderer: &Renderer) -> String {
        let title = self.fault.to_string();
        // A line end behind the text, where a caret may stand for what is missing.
        let line = format!("{}\n", self.text);
        let caret = AnnotationKind::Primary
            .span(self.place.clone())
            .label(self.fault.hint());
        let snippet = Snippet::source(line).path(&self.name).annotation(caret);
        renderer.render(&[Level::ERROR.primary_title(&title).element(snippet)])
    }
}
