//! JSON schemas of scenarios.

use motion_rtl::scenario::Runnable;
use motion_rtl::settings::{Defaults, Key, Shape};
use serde_json::{Map, Value, json};

/// The schema of a job's scenarios.
pub fn of(job: Runnable, keys: &[&'static Key], defaults: &Defaults) -> Value {
    let mut schema = table(keys, defaults);
    let root = schema.as_object_mut().into_iter();
    root.for_each(|root| {
        let name = job.name();
        root.insert(
            "$schema".to_owned(),
            json!("https://json-schema.org/draft/2020-12/schema"),
        );
        root.insert("title".to_owned(), json!(format!("scenario of {name}")));
    });
    schema["properties"]["circuit"] = json!({ "const": job.name() });
    schema
}

/// The schema of a table.
fn table(keys: &[&'static Key], defaults: &Defaults) -> Value {
    let defaults = json!(defaults);
    let properties = keys.iter().map(|key| {
        let mut schema = value(key.shape);
        if let Some(keys) = schema.as_object_mut() {
            keys.insert("description".to_owned(), json!(key.about.trim()));
            limit(keys, key);
            if let Some(default) = defaults.get(key.name).filter(|_| !key.required) {
                keys.insert("default".to_owned(), json!(default));
            }
        }
        (key.name.to_owned(), schema)
    });
    let required = keys.iter().filter(|key| key.required).map(|key| key.name);
    json!({
        "type": "object",
        "properties": properties.collect::<Map<_, _>>(),
        "required": required.collect::<Vec<_>>(),
        "additionalProperties": false,
    })
}

/// Adds a range to the schema of a number, or of the numbers of a list.
fn limit(schema: &mut Map<String, Value>, key: &Key) {
    let Some(range) = key.range.or(key.widest) else {
        return;
    };
    // Ends that no number of JSON can be are left to the run.
    let [least, most] = range().map(|end| end.parse::<serde_json::Number>().ok());
    let of = match schema.get_mut("items").and_then(Value::as_object_mut) {
        Some(items) => items,
        None => schema,
    };
    let ends = [("minimum", least), ("maximum", most)];
    for (name, end) in ends {
        of.extend(end.map(|end| (name.to_owned(), Value::Number(end))));
    }
}

/// The schema of a value.
pub fn value(shape: Shape) -> Value {
    match shape {
        Shape::Flag => json!({ "type": "boolean" }),
        Shape::Whole { least, most } => {
            json!({ "type": "integer", "minimum": least, "maximum": most })
        }
        Shape::Number => json!({ "type": "number" }),
        Shape::Text | Shape::Path => json!({ "type": "string" }),
        Shape::Choice(names) => json!({ "enum": names() }),
        Shape::List(of, None) => json!({ "type": "array", "items": value(*of) }),
        Shape::List(of, Some(length)) => json!({
            "type": "array",
            "items": value(*of),
            "minItems": length,
            "maxItems": length,
        }),
        Shape::PerAxis => json!({
            "type": ["number", "array"],
            "items": { "type": "number" },
        }),
        Shape::Point => json!({
            "type": "array",
            "items": { "type": "number" },
            "minItems": 3,
            "maxItems": 4,
        }),
        Shape::Table(keys, defaults) => {
            let keys: Vec<_> = keys.iter().copied().flatten().collect();
            table(&keys, &defaults())
        }
    }
}
