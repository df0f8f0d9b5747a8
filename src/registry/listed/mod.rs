//! Keys of a circuit as they are listed: type, range and meaning of each.

use super::entry::Entry;
use super::keys::{changed, kind, kinds, leaf};
use super::reader::Kind;
use super::{Pair, ranges};
use toml::Table;

/// Documentation of the fields that are keys: a line with the name of a struct and those of its
/// fields, then a line for each field.
const MEANINGS: &str = include_str!("meanings.txt");

/// A key as it is listed.
pub(super) struct Listed {
    pub name: String,
    pub of: Kind,
    /// Type, in words.
    pub kind: String,
    /// Meaning.
    pub about: String,
}

impl Listed {
    /// Returns the least and the largest value, or the names.
    pub fn range(&self, entry: &Entry) -> String {
        match self.of {
            Kind::Size => {
                let range = ranges::of(entry.name, &self.name);
                range.map_or_else(String::new, |(least, most)| format!("{least} to {most}"))
            }
            Kind::Whole => "from 0".to_owned(),
            Kind::Name(names) => names.join(", "),
            Kind::Table(_, keys) => keys.join(", "),
            Kind::Signed | Kind::Flag | Kind::List => String::new(),
        }
    }
}

/// Returns all keys that a table of a circuit can have, those of other names too.
pub(super) fn keys(entry: &Entry, table: &Table) -> Vec<Listed> {
    let mut found = Vec::new();
    if let Some((_, root)) = kinds(entry, table)
        .into_iter()
        .find(|(key, _)| key.is_empty())
    {
        add_inside(entry, table, "", root, &mut found);
    }
    found
}

/// Adds the keys of a table.
fn add_inside(entry: &Entry, table: &Table, key: &str, of: Kind, found: &mut Vec<Listed>) {
    let Kind::Table(name, fields) = of else {
        return;
    };
    for (at, field) in fields.iter().enumerate() {
        let path = join(key, field);
        if let Some(kind) = kind(entry, table, &path) {
            add(entry, table, path, kind, meaning(name, fields, at), found);
        }
    }
}

fn add(
    entry: &Entry,
    table: &Table,
    name: String,
    of: Kind,
    about: String,
    found: &mut Vec<Listed>,
) {
    let is_set = leaf(table, &name).is_some();
    let inside = match of {
        Kind::Table(..) => {
            add_inside(entry, table, &name, of, found);
            is_set
        }
        Kind::Name(variants) => {
            let own = leaf(table, &name).and_then(|value| value.as_table());
            for variant in variants {
                let path = join(&name, variant);
                let other = match own.is_some_and(|own| own.contains_key(*variant)) {
                    true => table.clone(),
                    false => with_variant(entry, table, &name, variant),
                };
                let mut kinds = kinds(entry, &other).into_iter();
                if let Some((_, kind)) = kinds.find(|(key, _)| *key == path) {
                    add_inside(entry, &other, &path, kind, found);
                }
            }
            false
        }
        _ => false,
    };
    // A table that is set is said by its keys.
    if !inside {
        found.push(Listed {
            kind: words(entry, table, &name, of),
            name,
            of,
            about,
        });
    }
}

/// Returns a table in which a key has another name, without the keys inside it.
fn with_variant(entry: &Entry, table: &Table, key: &str, variant: &str) -> Table {
    let value = format!("{{{variant} = {{}}}}");
    changed(entry, table.clone(), &Pair::new(key, value))
}

fn join(key: &str, field: &str) -> String {
    match key {
        "" => field.to_owned(),
        key => format!("{key}.{field}"),
    }
}

/// Returns a type in words.
fn words(entry: &Entry, table: &Table, key: &str, of: Kind) -> String {
    let plain = match of {
        Kind::Size | Kind::Whole | Kind::Signed => "whole number",
        Kind::Flag => "true or false",
        Kind::Name(_) => "name",
        Kind::Table(..) => "table",
        Kind::List => return format!("list of {}", elements(entry, table, key, 1)),
    };
    plain.to_owned()
}

/// Lists in lists that circuits have.
const DEEPEST: usize = 3;

/// Returns the type of a list's elements, in words.
fn elements(entry: &Entry, table: &Table, key: &str, depth: usize) -> String {
    let value = format!("{}\"?\"{}", "[".repeat(depth), "]".repeat(depth));
    let table = changed(entry, table.clone(), &Pair::new(key, value));
    let element = format!("{key}{}", "[0]".repeat(depth));
    let mut kinds = kinds(entry, &table).into_iter();
    let kind = kinds
        .find(|(name, _)| *name == element)
        .map(|(_, kind)| kind);
    match kind {
        Some(Kind::Size | Kind::Whole | Kind::Signed) => "whole numbers".to_owned(),
        Some(Kind::Flag) => "true or false".to_owned(),
        Some(Kind::Name(names)) => format!("names: {}", names.join(", ")),
        Some(Kind::Table(_, fields)) => format!("tables: {}", fields.join(", ")),
        Some(Kind::List) if depth < DEEPEST => {
            let inner = elements(entry, &table, key, depth + 1);
            format!("lists of {inner}")
        }
        Some(Kind::List) | None => "values".to_owned(),
    }
}

/// Returns the documentation of a field.
fn meaning(of: &str, fields: &[&str], at: usize) -> String {
    let head = [&[of], fields].concat().join(" ");
    let mut lines = MEANINGS.lines();
    let found = lines.find(|line| *line == head);
    let line = found.and_then(|_| lines.nth(at));
    line.unwrap_or_default().trim().to_owned()
}

#[cfg(test)]
mod tests;
