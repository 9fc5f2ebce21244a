//! A RON value and its layout: on one line where it fits, else one field or entry per line.

use std::fmt::{self, Write};

/// A value to be written.
pub(super) enum Value {
    Number(f64),
    Whole(u32),
    Truth(bool),
    Text(String),
    List(Vec<Value>),
    Struct(Vec<(&'static str, Value)>),
    Variant(&'static str, Vec<(&'static str, Value)>),
}

/// Columns of a line.
const WIDTH: usize = 100;

impl Value {
    /// On one line.
    fn line(&self) -> String {
        let list = |entries: Vec<String>| entries.join(", ");
        match self {
            Self::Number(number) => number.to_string(),
            Self::Whole(number) => number.to_string(),
            Self::Truth(truth) => truth.to_string(),
            // The escapes of Rust's debug form are RON's.
            Self::Text(text) => format!("{text:?}"),
            Self::List(entries) => format!("[{}]", list(entries.iter().map(Self::line).collect())),
            Self::Variant(name, fields) if fields.is_empty() => (*name).to_string(),
            Self::Struct(fields) | Self::Variant(_, fields) => {
                let fields = fields
                    .iter()
                    .map(|(name, value)| format!("{name}: {}", value.line()));
                format!("{}({})", self.name(), list(fields.collect()))
            }
        }
    }

    fn name(&self) -> &str {
        if let Self::Variant(name, _) = self {
            name
        } else {
            ""
        }
    }

    /// From column `at` on, in lines indented by `indent`.
    fn write(&self, f: &mut fmt::Formatter, indent: usize, at: usize) -> fmt::Result {
        let line = self.line();
        let inner = indent + 4;
        match self {
            _ if at + line.len() < WIDTH && indent > 0 => f.write_str(&line),
            Self::List(entries) => {
                f.write_str("[\n")?;
                for entry in entries {
                    write!(f, "{:inner$}", "")?;
                    entry.write(f, inner, inner)?;
                    f.write_str(",\n")?;
                }
                write!(f, "{:indent$}]", "")
            }
            Self::Struct(fields) | Self::Variant(_, fields) if !fields.is_empty() => {
                writeln!(f, "{}(", self.name())?;
                for (name, value) in fields {
                    write!(f, "{:inner$}{name}: ", "")?;
                    value.write(f, inner, inner + name.len() + 2)?;
                    f.write_str(",\n")?;
                }
                write!(f, "{:indent$})", "")
            }
            _ => f.write_str(&line),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.write(f, 0, 0)?;
        f.write_char('\n')
    }
}
