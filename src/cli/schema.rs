//! `schema`: a JSON schema of the summaries that `run --json` prints.

use super::{Failure, arc, machine, print, trajectory};
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

/// Settings of a run, whose own schema is that of the scenario.
pub type Settings = Map<String, Value>;

/// Prints the schema.
pub fn schema() -> Result<(), Failure> {
    print(&format!("{:#}\n", of_all()))
}

/// Returns the schema of every summary; each kind is one of its definitions.
fn of_all() -> Value {
    let kinds = [
        of::<arc::Summary>("arc_generator", "arc_generator"),
        of::<trajectory::Summary<'_>>("trajectory_controller", "trajectory_controller"),
        of::<machine::Summary>("machine", "machine"),
    ];
    let references = kinds
        .iter()
        .map(|(kind, _)| json!({ "$ref": format!("#/$defs/{kind}") }));
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "summary of a run",
        "anyOf": references.collect::<Vec<_>>(),
        "$defs": kinds.into_iter().collect::<Map<_, _>>(),
    })
}

/// Returns the name and the schema of a kind of summary, which `circuit` gives.
fn of<T: JsonSchema>(kind: &str, circuit: &str) -> (String, Value) {
    let settings = SchemaSettings::draft2020_12()
        .for_serialize()
        .with(|settings| {
            settings.definitions_path = format!("/$defs/{kind}/$defs").into();
            settings.meta_schema = None;
        });
    let settings = settings.with_transform(RecursiveTransform(close));
    let mut schema = settings
        .into_generator()
        .into_root_schema_for::<T>()
        .to_value();
    schema["properties"]["circuit"]["const"] = json!(circuit);
    schema["title"] = json!(kind.replace('_', " "));
    (kind.to_owned(), schema)
}

/// Allows no property but those of the schema, and drops formats, which a unit or a type says.
fn close(schema: &mut Schema) {
    schema.remove("format");
    if schema.get("properties").is_some() {
        schema.insert("additionalProperties".to_owned(), json!(false));
    }
}
