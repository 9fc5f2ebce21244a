//! RON by `ron`, one level at a time, as slices of the text.
//!
//! serde hands on no positions and stops at the first error; a slice ([`RawValue`]) has a position, its address, and
//! waits until somebody asks what it holds.

use crate::invalid::{Invalid, Rule, Violation};
use crate::source::Source;
use ron::error::Position;
use ron::value::RawValue;
use serde::de::{
    Deserialize, Deserializer, EnumAccess, Error, IgnoredAny, MapAccess, VariantAccess, Visitor,
};
use std::fmt;
use std::ops::Range;

/// The value that the rest of a source holds from a byte on, without what surrounds it.
///
/// # Errors
/// What RON's grammar says about it, alone: of a text that cannot be parsed nothing else is known.
pub(crate) fn root(source: &Source, from: usize) -> Result<&str, Invalid> {
    let text = source.text().get(from..).unwrap_or("");
    let refuse = |span: Range<usize>, message: String| {
        let last = source.text().trim_end().len();
        let span = (from + span.start).min(last)..(from + span.end).min(last);
        Invalid::from(Violation::new(source, span, Rule::Syntax(message)))
    };
    // The nesting that `ron` admits is limited; so are its recursion and ours.
    if let Err(error) = ron::from_str::<IgnoredAny>(text) {
        let span = byte_at(text, error.span.start)..byte_at(text, error.span.end);
        return Err(refuse(span, error.code.to_string()));
    }
    match RawValue::from_ron(text) {
        Ok(raw) => Ok(slice(raw)),
        Err(_) => Err(refuse(
            0..0,
            "attributes such as `#![enable(..)]` have no use here".to_string(),
        )),
    }
}

/// The byte at a line and column.
fn byte_at(text: &str, place: Position) -> usize {
    let line_start: usize = text
        .split_inclusive('\n')
        .take(place.line.saturating_sub(1))
        .map(str::len)
        .sum();
    let line = text.get(line_start..).unwrap_or("");
    line_start
        + line
            .chars()
            .take(place.col.saturating_sub(1))
            .map(char::len_utf8)
            .sum::<usize>()
}

/// A value without the space and comments around it.
fn slice(raw: &RawValue) -> &str {
    raw.trim().get_ron()
}

/// The entries of a list, if it is one.
pub(crate) fn entries(text: &str) -> Option<Vec<&str>> {
    let entries: Vec<&RawValue> = ron::from_str(text).ok()?;
    Some(entries.into_iter().map(slice).collect())
}

/// As much of a value as fits a message.
pub(crate) fn excerpt(text: &str) -> String {
    let line = text.lines().next().unwrap_or("");
    match line.char_indices().nth(40) {
        Some((end, _)) => format!("{} ..", &line[..end]),
        None if line.len() < text.len() => format!("{line} .."),
        None => line.to_string(),
    }
}

/// `(field: value, ..)`, `Name(field: value, ..)` or `Name`.
pub(crate) struct Parts<'de> {
    /// The name in front.
    pub(crate) name: Option<&'de str>,
    /// Names and values of the fields in the order of the text, with repetitions.
    pub(crate) fields: Vec<(&'de str, &'de str)>,
}

impl<'de> Parts<'de> {
    /// The parts of a value that neither begins nor ends with space, if it is of one of the three forms.
    pub(crate) fn of(text: &'de str) -> Option<Self> {
        if text.starts_with('(') {
            let Entries(fields) = ron::from_str(text).ok()?;
            Some(Self { name: None, fields })
        } else if text.ends_with(')') {
            let Variant(Name(name), Entries(fields)) = ron::from_str(text).ok()?;
            Some(Self {
                name: Some(name),
                fields,
            })
        } else {
            let Name(name) = ron::from_str(text).ok()?;
            Some(Self {
                name: Some(name),
                fields: Vec::new(),
            })
        }
    }

    /// The value of a field; the first, if there are more.
    pub(crate) fn field(&self, name: &str) -> Option<&'de str> {
        self.fields
            .iter()
            .find(|(key, _)| *key == name)
            .map(|(_, value)| *value)
    }

    /// The text of its field `name`.
    pub(crate) fn own_name(&self) -> Option<String> {
        ron::from_str(self.field("name")?).ok()
    }
}

/// An identifier.
struct Name<'de>(&'de str);

impl<'de> Deserialize<'de> for Name<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameVisitor;
        impl<'de> Visitor<'de> for NameVisitor {
            type Value = Name<'de>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a name")
            }

            fn visit_borrowed_str<E: Error>(self, name: &'de str) -> Result<Name<'de>, E> {
                Ok(Name(name))
            }
        }
        deserializer.deserialize_identifier(NameVisitor)
    }
}

/// The fields between the brackets of a struct.
struct Entries<'de>(Vec<(&'de str, &'de str)>);

impl<'de> Deserialize<'de> for Entries<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_struct("", &[], EntriesVisitor)
    }
}

struct EntriesVisitor;

impl<'de> Visitor<'de> for EntriesVisitor {
    type Value = Entries<'de>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("fields")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Entries<'de>, A::Error> {
        let mut fields = Vec::new();
        while let Some((Name(name), value)) = map.next_entry()? {
            fields.push((name, slice(value)));
        }
        Ok(Entries(fields))
    }
}

/// A name with fields.
struct Variant<'de>(Name<'de>, Entries<'de>);

impl<'de> Deserialize<'de> for Variant<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct VariantVisitor;
        impl<'de> Visitor<'de> for VariantVisitor {
            type Value = Variant<'de>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a name with fields")
            }

            fn visit_enum<A: EnumAccess<'de>>(self, access: A) -> Result<Variant<'de>, A::Error> {
                let (name, fields) = access.variant()?;
                Ok(Variant(name, fields.struct_variant(&[], EntriesVisitor)?))
            }
        }
        deserializer.deserialize_enum("", &[], VariantVisitor)
    }
}
