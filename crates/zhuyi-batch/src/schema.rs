//! What a JSON document is made of, as JSON Schema (draft 2020-12): from the very types that are written, so that it cannot say
//! anything else. Descriptions are the comments of their fields, with the units.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::Value;

/// Version of `plan.json`, of `manifest.json` and of the columns of `runs.csv`.
pub const SCHEMA: u32 = 1;

/// The schema of a document that is written as `T`, under a name and a version.
///
/// ```
/// #[derive(serde::Serialize, schemars::JsonSchema)]
/// struct Drive {
///     /// [s] when it ended.
///     end_s: f64,
/// }
/// let schema = zhuyi_batch::schema::document::<Drive>("drive", 1);
/// assert_eq!(schema["$id"], "urn:zhuyi:schema:drive:1");
/// assert_eq!(schema["properties"]["end_s"]["description"], "[s] when it ended.");
/// assert_eq!(schema["required"][0], "end_s");
/// ```
pub fn document<T: JsonSchema>(name: &str, version: u32) -> Value {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    schema.insert(
        "$id".to_string(),
        format!("urn:zhuyi:schema:{name}:{version}").into(),
    );
    schema.insert("title".to_string(), name.into());
    schema.to_value()
}
