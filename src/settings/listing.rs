//! Lists of keys for people.

use super::key::{Defaults, Key, Shape};
use toml::{Table, Value};

/// A key as text.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Row {
    /// Name; of a key in a table `table.key`.
    pub key: String,
    /// Type of the value.
    pub kind: String,
    /// Unit; empty without one.
    pub unit: &'static str,
    /// Value where the key is not given.
    pub default: String,
    /// Values that are accepted; empty where the type says it.
    pub range: String,
    /// Meaning.
    pub about: String,
}

/// Lists keys, those of tables behind the table's own.
#[must_use]
pub fn rows(keys: &[&'static Key], defaults: &Defaults) -> Vec<Row> {
    let mut rows = Vec::new();
    add("", keys, &defaults.0, &mut rows);
    rows
}

fn add(table: &str, keys: &[&'static Key], defaults: &Table, rows: &mut Vec<Row>) {
    for key in keys {
        let name = format!("{table}{}", key.name);
        let default = match (key.required, defaults.get(key.name)) {
            (true, _) => "required".to_owned(),
            (_, None) => "none".to_owned(),
            (_, Some(Value::Array(list))) if list.is_empty() => "none".to_owned(),
            (_, Some(Value::Table(table))) if initial(key.shape).as_ref() == Some(table) => {
                "those of its keys".to_owned()
            }
            (_, Some(value)) => value.to_string(),
        };
        rows.push(Row {
            key: name.clone(),
            kind: kind(key.shape),
            unit: unit(key.name),
            default,
            range: range(key),
            about: key.about.trim().to_owned(),
        });
        if let Shape::Table(keys, defaults) | Shape::List(&Shape::Table(keys, defaults), _) =
            key.shape
        {
            let keys: Vec<_> = keys.iter().copied().flatten().collect();
            add(&format!("{name}."), &keys, &defaults().0, rows);
        }
    }
}

/// The defaults of a table's keys.
fn initial(shape: Shape) -> Option<Table> {
    match shape {
        Shape::Table(_, defaults) => Some(defaults().0),
        _ => None,
    }
}

/// A type in words.
pub(crate) fn kind(shape: Shape) -> String {
    let plain = match shape {
        Shape::Flag => "true or false",
        Shape::Whole { .. } => "whole number",
        Shape::Number => "number",
        Shape::Text => "text",
        Shape::Path => "path",
        Shape::Choice(_) => "name",
        Shape::PerAxis => "number, or list of one per axis",
        Shape::Point => "list of X, Y, Z, or of X, Y, Z, W",
        Shape::Table(..) => "table",
        Shape::List(Shape::Table(..), _) => "tables",
        Shape::List(of, length) => {
            let of = match kind(*of) {
                one if one == "text" => "texts".to_owned(),
                one => format!("{one}s"),
            };
            return match length {
                Some(length) => format!("list of {length} {of}"),
                None => format!("list of {of}"),
            };
        }
    };
    plain.to_owned()
}

/// The values that are accepted.
fn range(key: &Key) -> String {
    let ends = key.range.or(key.widest.filter(|_| key.allowed.is_none()));
    let range = match (ends, key.shape) {
        (Some(ends), _) => ends().join(" to "),
        (None, Shape::Choice(names)) => {
            let names = names().iter().map(|name| format!("\"{name}\""));
            names.collect::<Vec<_>>().join(", ")
        }
        _ => String::new(),
    };
    let parts = [range.as_str(), key.allowed.unwrap_or_default()];
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("; ")
}

/// Returns the key that a dotted path leads to.
pub(crate) fn find(keys: &[&'static Key], path: &[&str]) -> Option<&'static Key> {
    let (name, inside) = path.split_first()?;
    let key = *keys.iter().find(|key| key.name == *name)?;
    match (inside, key.shape) {
        ([], _) => Some(key),
        (_, Shape::Table(keys, _) | Shape::List(&Shape::Table(keys, _), _)) => {
            let keys: Vec<_> = keys.iter().copied().flatten().collect();
            find(&keys, inside)
        }
        _ => None,
    }
}

/// Returns the values that a key takes, as an error says them; of an element of a list those of the
/// element.
pub(crate) fn allowed(key: &Key, element: bool) -> Option<String> {
    let shape = match key.shape {
        Shape::List(of, _) if element => *of,
        Shape::PerAxis | Shape::Point if element => Shape::Number,
        shape => shape,
    };
    match shape {
        Shape::Whole { .. } | Shape::Number => {}
        Shape::Choice(names) => {
            let names: Vec<_> = names().iter().map(|name| format!("`{name}`")).collect();
            return Some(format!("one of {}", names.join(", ")));
        }
        Shape::Flag => return Some(kind(shape)),
        _ => return None,
    }
    let number = format!("a {}", kind(shape));
    Some(match (key.range.or(key.widest), shape) {
        (Some(ends), _) => format!("{number} from {}", ends().join(" to ")),
        (None, Shape::Whole { least: 0, most }) => match most {
            i64::MAX => format!("{number} from 0"),
            most => format!("{number} from 0 to {most}"),
        },
        _ => number,
    })
}

/// Endings of names, the longest first, and the units that they stand for.
const UNITS: [(&str, &str); 28] = [
    ("_nm_s_per_rad", "N·m·s/rad"),
    ("_nm_per_rad", "N·m/rad"),
    ("_counts_per_s2", "counts/s²"),
    ("_counts_per_s", "counts/s"),
    ("counts_per_rev", "counts/rev"),
    ("counts_per_mm", "counts/mm"),
    ("steps_per_rev", "steps/rev"),
    ("steps_per_mm", "steps/mm"),
    ("_rev_per_min", "rev/min"),
    ("_mm_per_s2", "mm/s²"),
    ("_mm_per_min", "mm/min"),
    ("_mm_per_s", "mm/s"),
    ("mm_per_rev", "mm/rev"),
    ("_per_s", "1/s"),
    ("_kg_m2", "kg·m²"),
    ("_nm_s", "N·m·s"),
    ("_nm", "N·m"),
    ("_rad", "rad"),
    ("_deg", "°"),
    ("_ppm", "ppm"),
    ("_mm", "mm"),
    ("_ms", "ms"),
    ("_hz", "Hz"),
    ("_ticks", "ticks"),
    ("_tick", "ticks"),
    ("_counts", "counts"),
    ("target", "counts"),
    ("_s", "s"),
];

/// The unit of a key, which its name ends in.
fn unit(name: &str) -> &'static str {
    let found = UNITS.iter().find(|(end, _)| name.ends_with(end));
    found.map_or("", |(_, unit)| unit)
}
