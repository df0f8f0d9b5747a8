//! `schema`: a JSON schema of the summaries of `run`, the reports of `check` and of a single fault, and errors.

use super::{
    Failure, arc, check, errors, json as output, keys, lead_angle, linear, machine, mutate, pulse,
    to_standard_output, trajectory, waves_of,
};
use motion_rtl::settings;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::marker::PhantomData;

/// Settings in a summary: every key of the scenario's settings with its value, or `null` if it is
/// not set.
pub struct Settings<T>(PhantomData<T>);

impl<T: settings::Value> JsonSchema for Settings<T> {
    fn schema_name() -> Cow<'static, str> {
        "Settings".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut schema = keys::schema::value(T::SHAPE);
        complete(&mut schema);
        Schema::try_from(schema).unwrap_or_default()
    }
}

/// Turns the schema of tables that are read into that of tables that are written: none of their
/// keys is left out, and a key that has neither a value nor a default is `null`.
fn complete(schema: &mut Value) {
    if let Some(items) = schema.get_mut("items") {
        complete(items);
    }
    let required = schema.get("required").and_then(Value::as_array);
    let required = required.cloned().unwrap_or_default();
    let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) else {
        return;
    };
    for (key, property) in properties.iter_mut() {
        complete(property);
        let Some(table) = property.as_object_mut() else {
            continue;
        };
        let is_set = table.remove("default").is_some() || required.contains(&json!(key));
        if !is_set {
            let description = table.remove("description");
            *property = json!({ "anyOf": [property, { "type": "null" }] });
            property["description"] = json!(description);
        }
    }
    let keys: Vec<_> = properties.keys().cloned().collect();
    schema["required"] = json!(keys);
}

/// Prints the schema.
pub fn schema() -> Result<(), Failure> {
    to_standard_output(&format!("{:#}\n", of_all()))
}

/// Returns the schema of all of them; each kind is one of its definitions.
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
        of::<check::Report>("check", None),
        of::<check::FullReport>("check_full", None),
        of::<mutate::SingleReport>("fault", None),
        of::<errors::Output<'_>>("error", None),
    ];
    let references = kinds
        .iter()
        .map(|(kind, _)| json!({ "$ref": format!("#/$defs/{kind}") }));
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "summary of a run, report of a check or of a fault, or error",
        "anyOf": references.collect::<Vec<_>>(),
        "$defs": kinds.into_iter().collect::<Map<_, _>>(),
    })
}

/// Returns the name and the schema of a kind; a summary is of one circuit or of any.
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
    schema["properties"]["version"] = json!({
        "description": "Version of the keys.",
        "const": output::VERSION,
    });
    if let Some(required) = schema["required"].as_array_mut() {
        required.retain(|key| key != "version");
        required.push(json!("version"));
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
