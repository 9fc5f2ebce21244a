//! `runs.parquet`: the rows of `runs.csv` in typed columns, for tables of millions of rows.
//!
//! | CSV | Parquet |
//! |---|---|
//! | a text | `Utf8` |
//! | a whole number | `Int64` |
//! | a number | `Float64`, the decimals that the CSV has |
//! | `true`, `false` | `Boolean` |
//! | an empty field | null |
//!
//! It is made from the CSV and never in its place, so that both say the same. Columns have their unit and meaning as metadata; the
//! file has `zhuyi.schema`, the version of the columns, and `zhuyi.table`, all that `zhuyi schema DIR` tells. The same rows give the
//! same bytes. Left out: dictionaries of the environment, row groups by scenario.

use std::collections::HashMap;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use csv::StringRecord;
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;

use crate::BatchError;
use crate::blocks::{RUNS, flush_names};
use crate::columns::{Column, Kind, Table};
use crate::error::Attempt;
use crate::merge::damaged;
use crate::results::Draft;
use crate::table::table;

/// The file.
const PARQUET: &str = "runs.parquet";

/// How many rows are in memory together.
const ROWS: usize = 65_536;

/// Writes `runs.parquet` beside the `runs.csv` of a finished sweep.
///
/// # Errors
/// When there is no finished sweep, its table is damaged, or reading or writing fails.
pub fn write(dir: &Path) -> Result<(), BatchError> {
    let table = table(dir)?;
    let path = dir.join(RUNS);
    let file = File::open(&path).map_err(Attempt::Read.on(&path))?;
    let mut reader = csv::Reader::from_reader(file);
    let (draft, file) = Draft::begin(dir, PARQUET)?;
    let failed =
        |error: ParquetError| Attempt::Write.on(draft.path())(std::io::Error::other(error));
    let schema = Arc::new(Schema::new(
        table.columns.iter().map(field).collect::<Vec<_>>(),
    ));
    let writer = ArrowWriter::try_new(file, Arc::clone(&schema), Some(properties(&table)));
    let mut writer = writer.map_err(failed)?;
    let mut rows: Vec<StringRecord> = Vec::new();
    let mut records = reader.records();
    loop {
        let row = records.next().transpose();
        let row = row.map_err(|error| damaged(&path, &error.to_string()))?;
        let ended = row.is_none();
        rows.extend(row);
        if rows.len() == ROWS || ended && !rows.is_empty() {
            let batch = batch(&table, &schema, &rows);
            let batch = batch.map_err(|reason| damaged(&path, &reason))?;
            writer.write(&batch).map_err(failed)?;
            rows.clear();
        }
        if ended {
            break;
        }
    }
    let file = writer.into_inner().map_err(failed)?;
    file.sync_all().map_err(Attempt::Write.on(draft.path()))?;
    draft.rename(&dir.join(PARQUET))?;
    flush_names(dir);
    Ok(())
}

fn properties(table: &Table) -> WriterProperties {
    let pair = |key: &str, value: String| KeyValue::new(key.to_string(), value);
    let about = vec![
        pair("zhuyi.schema", table.version.to_string()),
        pair("zhuyi.table", table.schema().to_string()),
    ];
    WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::default()))
        .set_key_value_metadata(Some(about))
        .build()
}

fn field(column: &Column) -> Field {
    let kind = match column.kind {
        Kind::Text => DataType::Utf8,
        Kind::Whole => DataType::Int64,
        Kind::Number => DataType::Float64,
        Kind::Truth => DataType::Boolean,
    };
    let about = [("unit", column.unit), ("description", &column.meaning)];
    let about = about.map(|(key, value)| (key.to_string(), value.to_string()));
    Field::new(column.name.as_ref(), kind, true).with_metadata(HashMap::from(about))
}

/// Some rows, column by column.
fn batch(
    table: &Table,
    schema: &Arc<Schema>,
    rows: &[StringRecord],
) -> Result<RecordBatch, String> {
    let columns: Result<Vec<ArrayRef>, String> = (0..)
        .zip(&table.columns)
        .map(|(place, column)| array(column, rows.iter().map(|row| &row[place])))
        .collect();
    RecordBatch::try_new(Arc::clone(schema), columns?)
        .map_err(|error: ArrowError| error.to_string())
}

/// A column.
fn array<'a>(column: &Column, fields: impl Iterator<Item = &'a str>) -> Result<ArrayRef, String> {
    let fields = fields.map(|field| Some(field).filter(|field| !field.is_empty()));
    Ok(match column.kind {
        Kind::Text => Arc::new(fields.collect::<StringArray>()),
        Kind::Whole => Arc::new(parsed::<i64, Int64Array>(column, fields)?),
        Kind::Number => Arc::new(parsed::<f64, Float64Array>(column, fields)?),
        Kind::Truth => Arc::new(parsed::<bool, BooleanArray>(column, fields)?),
    })
}

/// What fields come to, each a value of the column's kind or nothing.
fn parsed<'a, T: std::str::FromStr, A: FromIterator<Option<T>>>(
    column: &Column,
    fields: impl Iterator<Item = Option<&'a str>>,
) -> Result<A, String> {
    let value = |field: &str| {
        let parsed = field.parse();
        parsed.map_err(|_| {
            format!(
                "`{field}` in the column {} is no {}",
                column.name,
                column.kind.name()
            )
        })
    };
    fields.map(|field| field.map(value).transpose()).collect()
}

#[cfg(test)]
mod tests {
    use arrow_array::Array;
    use arrow_array::cast::AsArray;
    use arrow_array::types::{Float64Type, Int64Type};
    use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

    use super::*;
    use crate::runs::Columns;
    use crate::{Plan, plan::tests::small};

    /// A finished sweep of two drives, one of which was refused, with what it varies as a number and as a text.
    fn sweep(dir: &Path) -> (Plan, String) {
        let plan = Plan {
            varied: vec!["planner.min_gap_m".into(), "estimator.grid".into()],
            points: vec![
                vec!["2".into(), "Ms33".into()],
                vec!["2.5".into(), "Fps".into()],
            ],
            ..small()
        };
        let columns = Columns {
            cameras: vec!["front".into()],
            varied: plan.varied_columns(),
            of_sweep: true,
        };
        let runs = columns.header()
            + "a,sweep,30,0,2,Ms33,collision,7.2500,\"le,ad\",front,3.100,1.500,,7.25,0.0000,0.0000,0.2404,217,0.9977,,,,,,,zhuyi run a\n"
            + "a,sweep,30,1,2.5,Fps,refused,,,,,,,,,,,,,,,,,,why,zhuyi run b\n"
            + "a,sweep,1,2,2.5,Fps,completed,,,,,,,20.0000,3.1250,1.5000,4.9000,20,0.0333,9.1743,11.1743,true,false,false,,zhuyi run c\n";
        std::fs::write(dir.join("plan.json"), plan.json()).unwrap();
        std::fs::write(dir.join(RUNS), &runs).unwrap();
        (plan, runs)
    }

    /// A cell as a text again.
    fn told(column: &ArrayRef, row: usize) -> String {
        if column.is_null(row) {
            return String::new();
        }
        match column.data_type() {
            DataType::Utf8 => column.as_string::<i32>().value(row).to_string(),
            DataType::Int64 => column.as_primitive::<Int64Type>().value(row).to_string(),
            DataType::Float64 => column.as_primitive::<Float64Type>().value(row).to_string(),
            DataType::Boolean => column.as_boolean().value(row).to_string(),
            other => panic!("{other}"),
        }
    }

    #[test]
    fn law_the_parquet_file_says_what_the_csv_says_in_typed_columns() {
        let dir = tempfile::tempdir().unwrap();
        let (_, runs) = sweep(dir.path());
        write(dir.path()).unwrap();
        let bytes = std::fs::read(dir.path().join(PARQUET)).unwrap();
        write(dir.path()).unwrap();
        assert!(bytes == std::fs::read(dir.path().join(PARQUET)).unwrap());
        let file = File::open(dir.path().join(PARQUET)).unwrap();
        let reader = ParquetRecordBatchReaderBuilder::try_new(file).unwrap();
        let about = reader.metadata().file_metadata().key_value_metadata();
        let version = about
            .unwrap()
            .iter()
            .find(|pair| pair.key == "zhuyi.schema");
        assert_eq!(version.unwrap().value.as_deref(), Some("1"));
        let field = reader.schema().field_with_name("impact_speed_mps").unwrap();
        assert_eq!(field.metadata()["unit"], "m/s");
        let types = [
            "fpr_hz",
            "planner.min_gap_m",
            "estimator.grid",
            "beyond_grid",
        ];
        let types = types.map(|name| {
            reader
                .schema()
                .field_with_name(name)
                .unwrap()
                .data_type()
                .clone()
        });
        let expected = [
            DataType::Int64,
            DataType::Float64,
            DataType::Utf8,
            DataType::Boolean,
        ];
        assert_eq!(types, expected);
        let batch = reader.build().unwrap().next().unwrap().unwrap();
        let mut csv = csv::Reader::from_reader(runs.as_bytes());
        let mut cells = 0;
        for (row, record) in csv.records().enumerate() {
            for (column, field) in batch.columns().iter().zip(&record.unwrap()) {
                let told = told(column, row);
                let same = told == field || told.parse::<f64>().ok() == field.parse().ok();
                assert!(same, "`{told}` for `{field}`");
                cells += 1;
            }
        }
        assert_eq!(cells, 3 * 27);
        assert_eq!(batch.num_rows(), 3);
    }

    #[test]
    fn hand_a_field_that_is_none_is_refused_with_its_column() {
        let dir = tempfile::tempdir().unwrap();
        let (_, runs) = sweep(dir.path());
        std::fs::write(dir.path().join(RUNS), runs.replace(",217,", ",2l7,")).unwrap();
        let refused = write(dir.path()).unwrap_err().to_string();
        assert!(
            refused.contains("`2l7` in the column front_frames is no integer"),
            "{refused}"
        );
        assert!(!dir.path().join(PARQUET).exists());
    }
}
