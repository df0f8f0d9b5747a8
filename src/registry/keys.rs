//! Keys of circuits: how a circuit is made from its full or small value and `key=value` pairs.

use super::entry::{Base, Entry, Made};
use crate::engine::EngineError;
use crate::nearest::nearest;
use crate::netlist::Wrong;
use crate::settings::{Pair, value};
use toml::de::DeTable;
use toml::{Table, Value};

/// The largest width, or number of stages, axes and the like.
const MOST: i64 = 1 << 12;

/// Sizes that count something else than the bits of a word.
const COUNTS: &[&str] = &[
    "axes",
    "first_axes",
    "records",
    "second_axes",
    "settings",
    "settling",
    "smoothing",
    "stages",
];

/// A value that no key takes.
const NO_VALUE: &str = "?";

/// Fault of a table, with its key.
pub type Source = serde_path_to_error::Error<toml::de::Error>;

/// A key of a circuit with its values.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Key {
    /// Dotted name.
    #[serde(rename = "key")]
    pub name: String,
    /// Value in the full circuit; `None` if it is not set.
    pub full: Option<String>,
    /// Value in the small circuit; `None` if it is not set.
    pub small: Option<String>,
}

/// A pair that a circuit does not take.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}: {problem}; allowed: {allowed}", pair.key)]
pub struct WrongPair {
    /// The pair.
    pub pair: Pair,
    /// Fault of the value or key.
    pub problem: String,
    /// Allowed keys or values.
    pub allowed: String,
}

/// Reasons why a circuit cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// Keys and values that it does not take, all of them.
    #[error("{}", lines(.0))]
    Pairs(Vec<WrongPair>),
    /// Values that do not go together, by the circuit's own words.
    #[error("{0}")]
    Values(String),
    /// The circuit is not proved, or not swept.
    #[error("it is not proved by exhaustion")]
    NoProof,
}

fn lines(wrong: &[WrongPair]) -> String {
    let lines = wrong.iter().map(WrongPair::to_string);
    lines.collect::<Vec<_>>().join("\n")
}

/// A circuit with some keys changed.
pub(super) fn made(entry: &Entry, base: Base, pairs: &[Pair]) -> Result<Made, Refused> {
    if pairs.is_empty() {
        return Ok(entry.maker.value(base));
    }
    let table = table(entry, base);
    let all = pairs.iter().fold(table.clone(), changed);
    let read = read(entry, &all);
    // Each by itself, so that all that is wrong is found.
    let wrong = pairs.iter().filter_map(|pair| match &read {
        Ok(_) if is_lost(entry, &table, pair) => Some(unknown(entry, &table, pair)),
        Ok(_) => too_large(entry, &all, pair),
        Err(_) => wrong(entry, &table, pair),
    });
    let wrong: Vec<_> = wrong.collect();
    match read {
        _ if !wrong.is_empty() => Err(Refused::Pairs(wrong)),
        Err(error) => {
            let (problem, allowed) = split(error.inner().message());
            let path = error.path();
            Err(Refused::Values(format!(
                "{path}: {problem}; allowed: {allowed}"
            )))
        }
        Ok(made) => match made.model.model() {
            Ok(_) => Ok(made),
            Err(error) => Err(Refused::Values(without_sites(&error))),
        },
    }
}

/// Most mistakes of a circuit that are listed.
const MOST_MISTAKES: usize = 4;

/// Lists the mistakes of a circuit without their places in the source: the caller changes keys, not code.
fn without_sites(error: &EngineError) -> String {
    let EngineError::Circuit(Wrong(mistakes)) = error else {
        return error.to_string();
    };
    let mut lines: Vec<String> = Vec::new();
    for mistake in mistakes {
        let line = format!("{}: {}", mistake.path, mistake.what);
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    let more = lines.len().saturating_sub(MOST_MISTAKES);
    lines.truncate(MOST_MISTAKES);
    match more {
        0 => lines.join("; "),
        more => format!("{}; and {more} more", lines.join("; ")),
    }
}

/// All keys of a circuit, by name.
pub(super) fn all(entry: &Entry) -> Vec<Key> {
    let [full, small] = [Base::Full, Base::Small].map(|base| table(entry, base));
    let names = names(entry, &full).into_iter().map(|name| Key {
        full: leaf(&full, &name).map(text),
        small: leaf(&small, &name).map(text),
        name,
    });
    names.collect()
}

/// The keys of widths and other sizes.
pub(super) fn sizes(entry: &Entry, base: Base, pairs: &[Pair]) -> Vec<(String, u64)> {
    let table = pairs.iter().fold(table(entry, base), changed);
    let sizes = names(entry, &table).into_iter().filter_map(|name| {
        let size = leaf(&table, &name)?.as_integer()?;
        is_size(entry, &table, &name).then_some((name, size.unsigned_abs()))
    });
    sizes.collect()
}

/// True for a size in bits.
pub(super) fn is_width(key: &str) -> bool {
    !COUNTS.contains(&key.rsplit('.').next().unwrap_or_default())
}

/// The table of a circuit's keys. Circuits are plain data: there is one.
fn table(entry: &Entry, base: Base) -> Table {
    entry.maker.table(base).unwrap_or_default()
}

fn read(entry: &Entry, table: &Table) -> Result<Made, Source> {
    let text = table.to_string();
    let (parsed, _) = DeTable::parse_recoverable(&text);
    entry.maker.read(parsed)
}

/// Returns the table with a pair's value; unchanged if a key on the way has no keys inside.
fn changed(mut table: Table, pair: &Pair) -> Table {
    fn put(table: &mut Table, key: &str, value: Value) {
        match key.split_once('.') {
            None => drop(table.insert(key.to_owned(), value)),
            Some((head, rest)) => {
                let inner = table.entry(head).or_insert_with(|| Table::new().into());
                if let Value::Table(inner) = inner {
                    put(inner, rest, value);
                }
            }
        }
    }
    put(&mut table, &pair.key, value(&pair.value));
    table
}

/// The value of a dotted key.
fn leaf<'t>(table: &'t Table, key: &str) -> Option<&'t Value> {
    match key.split_once('.') {
        None => table.get(key),
        Some((head, rest)) => leaf(table.get(head)?.as_table()?, rest),
    }
}

/// Returns the names of all keys: those of the table, and those at its top that are not set.
fn names(entry: &Entry, table: &Table) -> Vec<String> {
    fn add(names: &mut Vec<String>, table: &Table, before: &str) {
        for (key, value) in table {
            match value {
                Value::Table(inner) => add(names, inner, &format!("{before}{key}.")),
                _ => names.push(format!("{before}{key}")),
            }
        }
    }
    let mut names = Vec::new();
    add(&mut names, table, "");
    // "unknown field `?`, expected one of `a`, `b`"
    let message = message(entry, table, NO_VALUE);
    let fields = message.split('`').skip(3).step_by(2);
    names.extend(
        fields
            .filter(|key| !table.contains_key(*key))
            .map(str::to_owned),
    );
    names.retain(|name| !entry.is_idle(name));
    names
}

/// Message of the reader for a value that no key takes.
fn message(entry: &Entry, table: &Table, key: &str) -> String {
    let table = changed(table.clone(), &Pair::new(key, NO_VALUE));
    let error = read(entry, &table).err();
    error.map_or(String::new(), |error| error.inner().message().to_owned())
}

/// True for a key of widths and other sizes, which are of the type `usize`.
fn is_size(entry: &Entry, table: &Table, key: &str) -> bool {
    message(entry, table, key).ends_with("expected usize")
}

/// True for a key that changes nothing.
fn is_lost(entry: &Entry, table: &Table, pair: &Pair) -> bool {
    entry.is_idle(&pair.key) || leaf(&changed(table.clone(), pair), &pair.key).is_none()
}

/// Refuses an unknown key.
fn unknown(entry: &Entry, table: &Table, pair: &Pair) -> WrongPair {
    let names = names(entry, table);
    WrongPair {
        pair: pair.clone(),
        problem: format!(
            "no key of {}{}",
            entry.name,
            meant(&pair.key, names.iter().map(String::as_str))
        ),
        allowed: match names.is_empty() {
            true => "none: it has no keys".to_owned(),
            false => names.join(", "),
        },
    }
}

/// The name that was meant, as the end of a problem; of a key what stands behind its last dot counts
/// too.
fn meant<'a>(given: &str, names: impl Iterator<Item = &'a str> + Clone) -> String {
    fn last(name: &str) -> &str {
        name.rsplit('.').next().unwrap_or(name)
    }
    let near = nearest(given, names.clone()).or_else(|| {
        let near = nearest(last(given), names.clone().map(last))?;
        names.clone().find(|name| last(name) == near)
    });
    near.map_or(String::new(), |near| format!("; did you mean `{near}`?"))
}

/// Refuses a width, or a number of things, that no circuit has.
fn too_large(entry: &Entry, table: &Table, pair: &Pair) -> Option<WrongPair> {
    let mut sizes = names(entry, table).into_iter().filter(|name| {
        let below = name.strip_prefix(&pair.key);
        let inside = below.is_some_and(|below| below.is_empty() || below.starts_with('.'));
        let number = leaf(table, name).and_then(Value::as_integer);
        inside && number.is_some_and(|number| number > MOST) && is_size(entry, table, name)
    });
    sizes.next().map(|_| WrongPair {
        pair: pair.clone(),
        problem: format!("is {}", pair.value),
        allowed: format!("0 to {MOST}"),
    })
}

/// Finds the fault of a pair by itself.
fn wrong(entry: &Entry, table: &Table, pair: &Pair) -> Option<WrongPair> {
    if is_lost(entry, table, pair) {
        return Some(unknown(entry, table, pair));
    }
    let error = read(entry, &changed(table.clone(), pair)).err()?;
    let (path, message) = (error.path().to_string(), error.inner().message());
    if message.starts_with("unknown field") && pair.key.starts_with(&path) {
        return Some(unknown(entry, table, pair));
    }
    // A number in place of a variant: the allowed names come from the message about a wrong name.
    let (problem, allowed) = match message {
        "wanted string or table" if path == pair.key => {
            let names = split(&self::message(entry, table, &path)).1;
            (format!("is {}", pair.value), names)
        }
        message => split(message),
    };
    let problem = match path == pair.key {
        true => problem,
        false => format!("{path}: {problem}"),
    };
    Some(WrongPair {
        problem: problem + &meant(&pair.value, allowed.split('`').skip(1).step_by(2)),
        pair: pair.clone(),
        allowed,
    })
}

/// A message of the reader as problem and what is allowed.
fn split(message: &str) -> (String, String) {
    let whole = "the key with all of its table, KEY={a=1, b=2}";
    let (problem, allowed) = message
        .split_once(", expected ")
        .unwrap_or((message, whole));
    let allowed = match allowed.strip_prefix("one of ").unwrap_or(allowed) {
        "usize" | "u64" => "a whole number from 0",
        "i64" => "a whole number",
        "a boolean" => "true or false",
        "a sequence" => "a list, [1, 2]",
        record if record.starts_with("struct ") => "a table, {key = value}",
        other => other,
    };
    (problem.to_owned(), allowed.to_owned())
}

/// Formats a value as in a pair.
fn text(value: &Value) -> String {
    match value {
        Value::String(word) => word.clone(),
        value => value.to_string(),
    }
}
