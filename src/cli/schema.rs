//! `schema`: a JSON schema of the summaries that `run --json` prints.

use super::{Failure, arc, lead_angle, linear, machine, print, pulse, trajectory, waves_of};
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
        of::<pulse::Summary>("pulse_interpolator", Some("pulse_interpolator")),
        of::<pulse::patterns::Summary>("patterns", Some("pulse_interpolator")),
        of::<pulse::patterns::groups::Summary>("groups", Some("pulse_interpolator_groups")),
        of::<linear::Summary>("linear_interpolator", Some("linear_interpolator")),
        of::<lead_angle::Summary>("lead_angle", Some("lead_angle")),
        of::<lead_angle::log::Summary>("position_log", Some("lead_angle")),
        of::<arc::Summary>("arc_generator", Some("arc_generator")),
        of::<trajectory::Summary<'_>>("trajectory_controller", Some("trajectory_controller")),
        of::<machine::Summary>("machine", Some("machine")),
        of::<waves_of::Summary>("waves_of", None),
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

/// Returns the name and the schema of a kind of summary; of one circuit or of any.
fn of<T: JsonSchema>(kind: &str, circuit: Option<&str>) -> (String, Value) {
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
    // The generator puts definitions where the whole has them.
    schema["$defs"] = schema["$defs"][kind]["$defs"].take();
    if let Some(name) = circuit {
        schema["properties"]["circuit"]["const"] = json!(name);
    }
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
