//! What the columns of a table are, and the same as JSON: a Frictionless Table Schema.
//!
//! Units stand in the names of the columns too (`_s`, `_mps`, `_fpr`); here they can be read by a program. A field that is empty has
//! no value. Source: Data Package 2.0, Table Schema (datapackage.org); `unit` and `version` are properties of our own, as it admits.

use std::borrow::Cow;

use serde_json::{Value, json};

/// The type of a column's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Any text.
    Text,
    /// A whole number.
    Whole,
    /// A number with decimals.
    Number,
    /// `true` or `false`.
    Truth,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Its name in the header.
    pub name: Cow<'static, str>,
    /// The type of its values.
    pub kind: Kind,
    /// Their unit, `-` for a number that has none; empty for texts.
    pub unit: &'static str,
    /// What they say.
    pub meaning: Cow<'static, str>,
}

/// A table: what it is, and its columns in their order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Its name, and that of its file.
    pub name: &'static str,
    /// The version of its columns.
    pub version: u32,
    /// What a row is.
    pub meaning: Cow<'static, str>,
    /// The columns.
    pub columns: Vec<Column>,
}

impl Kind {
    /// As a Table Schema calls it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "string",
            Self::Whole => "integer",
            Self::Number => "number",
            Self::Truth => "boolean",
        }
    }

    /// Whether a field that is not empty is of it.
    ///
    /// ```
    /// use zhuyi_batch::columns::Kind;
    /// assert!(Kind::Whole.admits("30") && !Kind::Whole.admits("30.5"));
    /// assert!(Kind::Number.admits("30.5") && !Kind::Number.admits("inf"));
    /// assert!(Kind::Truth.admits("false") && !Kind::Truth.admits("0"));
    /// ```
    pub fn admits(self, field: &str) -> bool {
        match self {
            Self::Text => true,
            Self::Whole => field.parse::<i64>().is_ok(),
            Self::Number => field.parse::<f64>().is_ok_and(f64::is_finite),
            Self::Truth => field.parse::<bool>().is_ok(),
        }
    }

    /// The narrowest of which all fields are.
    pub fn of(fields: &[&str]) -> Self {
        let all = [Self::Whole, Self::Number, Self::Truth];
        let fits = |kind: &Self| fields.iter().all(|field| kind.admits(field));
        all.into_iter().find(fits).unwrap_or(Self::Text)
    }
}

impl Column {
    /// A column of which all is known beforehand.
    pub const fn fixed(
        name: &'static str,
        kind: Kind,
        unit: &'static str,
        meaning: &'static str,
    ) -> Self {
        Self {
            name: Cow::Borrowed(name),
            kind,
            unit,
            meaning: Cow::Borrowed(meaning),
        }
    }
}

impl Table {
    /// The table's schema as JSON.
    ///
    /// ```
    /// use zhuyi_batch::columns::{Column, Kind, Table};
    /// let gap = Column::fixed("smallest_gap_m", Kind::Number, "m", "the smallest gap");
    /// let table = Table { name: "runs", version: 1, meaning: "one row per run".into(), columns: vec![gap] };
    /// let field = &table.schema()["fields"][0];
    /// assert_eq!((field["type"].as_str(), field["unit"].as_str()), (Some("number"), Some("m")));
    /// ```
    pub fn schema(&self) -> Value {
        let field = |column: &Column| {
            let mut field = json!({
                "name": column.name,
                "type": column.kind.name(),
                "description": column.meaning,
            });
            if !column.unit.is_empty() {
                field["unit"] = column.unit.into();
            }
            field
        };
        json!({
            "$schema": "https://datapackage.org/profiles/2.0/tableschema.json",
            "name": self.name,
            "version": self.version,
            "description": self.meaning,
            "missingValues": [""],
            "fields": self.columns.iter().map(field).collect::<Vec<_>>(),
        })
    }
}
