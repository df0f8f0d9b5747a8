//! A value against a JSON schema, as far as our schemas go.

use serde_json::{Map, Value};

/// Keywords that are checked, and those that say nothing of a value.
const KEYWORDS: [&str; 20] = [
    "$ref",
    "additionalProperties",
    "anyOf",
    "const",
    "enum",
    "items",
    "maxItems",
    "maximum",
    "minItems",
    "minimum",
    "oneOf",
    "properties",
    "required",
    "type",
    "$comment",
    "$defs",
    "$schema",
    "default",
    "description",
    "title",
];

/// Returns what of a value a part of a schema does not allow, each with its place.
pub fn violations(root: &Value, schema: &Value, value: &Value, place: &str) -> Vec<String> {
    let Some(keys) = schema.as_object() else {
        panic!("{place}: {schema} is no schema");
    };
    for key in keys.keys() {
        assert!(
            KEYWORDS.contains(&key.as_str()),
            "{place}: {key} is no keyword"
        );
    }
    let mut found = Vec::new();
    let mut wrong = |what: &str| found.push(format!("{place}: {value} is not {what}"));
    let types = match &schema["type"] {
        Value::Array(types) => types.clone(),
        Value::Null => Vec::new(),
        one => vec![one.clone()],
    };
    if !types.is_empty() && !types.iter().any(|name| is_of(value, name, place)) {
        wrong(&format!("of type {}", schema["type"]));
    }
    if schema.get("const").is_some_and(|only| only != value) {
        wrong(&schema["const"].to_string());
    }
    let names = schema.get("enum").and_then(Value::as_array);
    if names.is_some_and(|names| !names.contains(value)) {
        wrong(&format!("one of {}", schema["enum"]));
    }
    let number = |key: &str| schema.get(key).and_then(Value::as_f64);
    if let Some(value) = value.as_f64() {
        if number("minimum").is_some_and(|least| value < least) {
            wrong(&format!("from {}", schema["minimum"]));
        }
        if number("maximum").is_some_and(|most| value > most) {
            wrong(&format!("up to {}", schema["maximum"]));
        }
    }
    if let Value::Array(list) = value {
        let length = list.len() as f64;
        if number("minItems").is_some_and(|least| length < least)
            || number("maxItems").is_some_and(|most| length > most)
        {
            wrong("a list of its length");
        }
        if let Some(items) = schema.get("items") {
            for (index, element) in list.iter().enumerate() {
                found.extend(violations(
                    root,
                    items,
                    element,
                    &format!("{place}[{index}]"),
                ));
            }
        }
    }
    if let Value::Object(table) = value {
        found.extend(table_violations(root, schema, table, place));
    }
    if let Some(path) = schema.get("$ref") {
        let path = path.as_str().and_then(|path| path.strip_prefix('#'));
        let of = path.and_then(|path| root.pointer(path));
        let of = of.unwrap_or_else(|| panic!("{place}: there is no {}", schema["$ref"]));
        found.extend(violations(root, of, value, place));
    }
    for (key, one) in [("anyOf", false), ("oneOf", true)] {
        let Some(choices) = schema.get(key).and_then(Value::as_array) else {
            continue;
        };
        let all = choices
            .iter()
            .map(|choice| violations(root, choice, value, place));
        let all: Vec<_> = all.collect();
        let fit = all.iter().filter(|found| found.is_empty()).count();
        if fit == 0 {
            found.extend(all.into_iter().min_by_key(Vec::len).unwrap_or_default());
        } else if one && fit > 1 {
            found.push(format!("{place}: {value} is {fit} of {key}"));
        }
    }
    found
}

fn is_of(value: &Value, name: &Value, place: &str) -> bool {
    match name.as_str().expect("a name of a type") {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "null" => value.is_null(),
        other => panic!("{place}: there is no type {other}"),
    }
}

fn table_violations(
    root: &Value,
    schema: &Value,
    table: &Map<String, Value>,
    place: &str,
) -> Vec<String> {
    let mut found = Vec::new();
    for key in schema["required"].as_array().into_iter().flatten() {
        if !table.contains_key(key.as_str().expect("a key")) {
            found.push(format!("{place}: {key} is missing"));
        }
    }
    let others = schema.get("additionalProperties");
    for (key, value) in table {
        let place_of = format!("{place}.{key}");
        match (schema["properties"].get(key), others) {
            (Some(schema), _) => found.extend(violations(root, schema, value, &place_of)),
            (None, Some(Value::Bool(false))) => {
                found.push(format!("{place}: there is no key {key}"));
            }
            (None, Some(schema @ Value::Object(_))) => {
                found.extend(violations(root, schema, value, &place_of));
            }
            (None, _) => {}
        }
    }
    found
}
