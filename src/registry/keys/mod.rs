//! Keys of circuits: how a circuit is made from its full or small value and `key=value` pairs.

mod example;

use super::entry::{Base, Entry, Made};
use super::reader::{Kind, Kinds, Misread};
use super::{listed, ranges};
use crate::engine::EngineError;
use crate::nearest::{self, nearest};
use crate::netlist::Wrong;
use crate::settings::{Pair, unread, value};
use crate::sim::Elaborated;
use toml::{Table, Value};

/// The largest width, or number of stages, axes and the like.
pub(super) const MOST: i64 = 1 << 12;

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
pub(super) const NO_VALUE: &str = "?";

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
    /// Type, in words.
    #[serde(rename = "type")]
    pub kind: String,
    /// `bits` of a width, or nothing.
    pub unit: &'static str,
    /// Least and largest value, or the names.
    pub range: String,
    /// Meaning.
    pub about: String,
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
#[non_exhaustive]
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
    let made = read_pairs(entry, base, pairs)?;
    if !pairs.is_empty() {
        elaborate_pairs(entry, &made, pairs)?;
    }
    Ok(made)
}

/// A circuit with some keys changed, elaborated.
pub(super) fn elaborated(entry: &Entry, base: Base, pairs: &[Pair]) -> Result<Elaborated, Refused> {
    elaborate_pairs(entry, &read_pairs(entry, base, pairs)?, pairs)
}

/// Elaborates a circuit; a size out of its range is the reason why that fails.
fn elaborate_pairs(entry: &Entry, made: &Made, pairs: &[Pair]) -> Result<Elaborated, Refused> {
    let outside = |pair: &Pair| {
        let number = value(&pair.value).as_integer()?;
        let (least, most) = ranges::of(entry.name, &pair.key)?;
        (!(least..=most).contains(&number)).then(|| WrongPair {
            pair: pair.clone(),
            problem: format!("is {number}"),
            allowed: format!("{least} to {most}"),
        })
    };
    elaborate(made).map_err(|error| {
        let wrong: Vec<_> = pairs.iter().filter_map(outside).collect();
        match wrong.is_empty() {
            true => error,
            false => Refused::Pairs(wrong),
        }
    })
}

pub(super) fn elaborate(made: &Made) -> Result<Elaborated, Refused> {
    let elaborated = made.model.model();
    elaborated.map_err(|error| Refused::Values(without_sites(&error)))
}

/// A circuit with some keys changed, which may have mistakes.
fn read_pairs(entry: &Entry, base: Base, pairs: &[Pair]) -> Result<Made, Refused> {
    if pairs.is_empty() {
        return Ok(entry.maker.value(base));
    }
    let table = table(entry, base);
    let all = changed_by(entry, table.clone(), pairs);
    let read = read(entry, &all);
    // Each by itself, so that all that is wrong is found; of two values of a key the later counts.
    let wrong = pairs
        .iter()
        .enumerate()
        .filter_map(|(at, pair)| match &read {
            Ok(_) if is_lost(entry, &table, pair) => Some(unknown(entry, &table, pair)),
            Ok(_) if pairs[at + 1..].iter().any(|later| later.key == pair.key) => {
                wrong(entry, &table, pair)
            }
            Ok(_) => too_large(entry, &all, pair),
            Err(_) => wrong(entry, &table, pair),
        });
    let wrong: Vec<_> = wrong.collect();
    match read {
        _ if !wrong.is_empty() => Err(Refused::Pairs(wrong)),
        Err(error) => Err(Refused::Values(error.to_string())),
        Ok(made) => Ok(made),
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

/// All keys of a circuit, by name: also those of names that it does not have at present.
pub(super) fn all(entry: &Entry) -> Vec<Key> {
    let [full, small] = [Base::Full, Base::Small].map(|base| table(entry, base));
    let mut found = listed::keys(entry, &full);
    for key in listed::keys(entry, &small) {
        if !found.iter().any(|other| other.name == key.name) {
            found.push(key);
        }
    }
    found.retain(|key| !entry.is_idle(&key.name));
    found.sort_by(|a, b| a.name.cmp(&b.name));
    let is_unset = |name: &str| {
        [&full, &small]
            .iter()
            .all(|table| leaf(table, name).is_none())
    };
    let keys = found.into_iter().map(|key| Key {
        full: leaf(&full, &key.name).map(|value| shown(key.of, value)),
        small: leaf(&small, &key.name).map(|value| shown(key.of, value)),
        range: match key.of {
            // Of a name that neither circuit has: no circuit was elaborated with it.
            Kind::Size if is_unset(&key.name) => String::new(),
            _ => key.range(entry),
        },
        kind: key.kind,
        unit: match key.of {
            Kind::Size if is_width(&key.name) => "bits",
            _ => "",
        },
        about: key.about,
        name: key.name,
    });
    keys.collect()
}

/// The keys of widths and other sizes.
pub(super) fn sizes(entry: &Entry, base: Base, pairs: &[Pair]) -> Vec<(String, u64)> {
    let table = changed_by(entry, table(entry, base), pairs);
    let kinds = kinds(entry, &table);
    let sizes = names(entry, &table).into_iter().filter_map(|name| {
        let size = leaf(&table, &name)?.as_integer()?;
        is_size(&kinds, &name).then_some((name, size.unsigned_abs()))
    });
    sizes.collect()
}

/// True for a size in bits.
pub(super) fn is_width(key: &str) -> bool {
    !COUNTS.contains(&key.rsplit('.').next().unwrap_or_default())
}

/// The table of a circuit's keys. Circuits are plain data: there is one.
pub(super) fn table(entry: &Entry, base: Base) -> Table {
    entry.maker.table(base).unwrap_or_default()
}

pub(super) fn read(entry: &Entry, table: &Table) -> Result<Made, Misread> {
    entry.maker.read(table, &Kinds::default())
}

/// Kinds of the keys of a table, up to the first that is misread.
pub(super) fn kinds(entry: &Entry, table: &Table) -> Vec<(String, Kind)> {
    let kinds = Kinds::default();
    // A key that is misread has its kind too.
    let _ = entry.maker.read(table, &kinds);
    kinds.into_inner()
}

/// Kind of a key, set or not.
pub(super) fn kind(entry: &Entry, table: &Table, key: &str) -> Option<Kind> {
    let find = |kinds: &[(String, Kind)]| {
        let found = kinds.iter().find(|(name, _)| name == key);
        found.map(|(_, kind)| *kind)
    };
    let unset = || changed(entry, table.clone(), &Pair::new(key, NO_VALUE));
    find(&kinds(entry, table)).or_else(|| find(&kinds(entry, &unset())))
}

/// Returns the table with the values of some pairs, one after the other.
fn changed_by(entry: &Entry, table: Table, pairs: &[Pair]) -> Table {
    let change = |table, pair: &Pair| changed(entry, table, pair);
    pairs.iter().fold(table, change)
}

/// Returns the table with a pair's value; unchanged if a key on the way has no keys inside. A table
/// keeps the keys that the value does not give, but another name has keys of its own.
pub(super) fn changed(entry: &Entry, mut table: Table, pair: &Pair) -> Table {
    let kinds = kinds(entry, &table);
    let value = value(&pair.value);
    Change { kinds: &kinds }.put(&mut table, "", &pair.key, value);
    table
}

/// A change of a table whose keys have these kinds.
struct Change<'a> {
    kinds: &'a [(String, Kind)],
}

impl Change<'_> {
    fn put(&self, table: &mut Table, before: &str, key: &str, value: Value) {
        let (head, rest) = key.split_once('.').unwrap_or((key, ""));
        let path = format!("{before}{head}");
        let is_name =
            |(name, kind): &(String, Kind)| *name == path && matches!(kind, Kind::Name(_));
        let value = match (rest, value) {
            ("", value) => value,
            (rest, value) => {
                let mut inner = Value::Table(Table::new());
                if let Some(table) = inner.as_table_mut() {
                    Change { kinds: &[] }.put(table, "", rest, value);
                }
                inner
            }
        };
        let named = self.kinds.iter().any(is_name);
        match (table.get_mut(head), value) {
            (Some(Value::Table(own)), Value::Table(new))
                if !named || new.keys().all(|name| own.contains_key(name)) =>
            {
                for (name, value) in new {
                    self.put(own, &format!("{path}."), &name, value);
                }
            }
            // The name that it has, with its keys.
            (Some(Value::Table(own)), Value::String(name)) if named && own.contains_key(&name) => {}
            // Nothing is inside a number or a list.
            (Some(own), Value::Table(_)) if !own.is_table() && !named && !rest.is_empty() => {}
            (_, value) => drop(table.insert(head.to_owned(), value)),
        }
    }
}

/// The value of a dotted key.
pub(super) fn leaf<'t>(table: &'t Table, key: &str) -> Option<&'t Value> {
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
    let top = kinds(entry, table)
        .into_iter()
        .find_map(|(_, kind)| match kind {
            Kind::Table(_, keys) => Some(keys),
            _ => None,
        });
    let unset = top.into_iter().flatten();
    let unset = unset.filter(|key| !table.contains_key(**key));
    names.extend(unset.map(|key| (*key).to_owned()));
    names.retain(|name| !entry.is_idle(name));
    names
}

/// True for a key of widths and other sizes.
fn is_size(kinds: &[(String, Kind)], key: &str) -> bool {
    kinds
        .iter()
        .any(|(name, kind)| name == key && *kind == Kind::Size)
}

/// True for a key that changes nothing.
fn is_lost(entry: &Entry, table: &Table, pair: &Pair) -> bool {
    entry.is_idle(&pair.key) || leaf(&changed(entry, table.clone(), pair), &pair.key).is_none()
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
    nearest::meant(near)
}

/// Refuses a width, or a number of things, that no circuit has.
fn too_large(entry: &Entry, table: &Table, pair: &Pair) -> Option<WrongPair> {
    let kinds = kinds(entry, table);
    let mut sizes = names(entry, table).into_iter().filter(|name| {
        let below = name.strip_prefix(&pair.key);
        let inside = below.is_some_and(|below| below.is_empty() || below.starts_with('.'));
        let number = leaf(table, name).and_then(Value::as_integer);
        inside && number.is_some_and(|number| number > MOST) && is_size(&kinds, name)
    });
    sizes.next().map(|name| {
        let (least, most) = ranges::of(entry.name, &name).unwrap_or((0, MOST));
        WrongPair {
            pair: pair.clone(),
            problem: format!("is {}", pair.value),
            allowed: format!("{least} to {most}"),
        }
    })
}

/// Finds the fault of a pair by itself.
fn wrong(entry: &Entry, table: &Table, pair: &Pair) -> Option<WrongPair> {
    if is_lost(entry, table, pair) {
        return Some(unknown(entry, table, pair));
    }
    let error = read(entry, &changed(entry, table.clone(), pair)).err()?;
    if error.unknown && pair.key.starts_with(&error.key) {
        return Some(unknown(entry, table, pair));
    }
    let problem = match error.key == pair.key {
        true => error.problem,
        false => format!("{}: {}", error.key, error.problem),
    };
    let names = error.allowed.split('`').skip(1).step_by(2);
    let number = unread(&pair.value)
        .filter(|_| kind(entry, table, &error.key) == Some(Kind::Size))
        .and_then(|_| ranges::of(entry.name, &error.key));
    Some(WrongPair {
        problem: problem + &meant(&pair.value, names),
        pair: pair.clone(),
        allowed: match (number, error.bare) {
            (Some((least, most)), _) => format!("{least} to {most}"),
            (None, true) => example::of_name(entry, table, pair).unwrap_or(error.allowed),
            (None, false) => error.allowed,
        },
    })
}

/// Formats the value of a key; of a name with keys inside, which are listed by themselves, the name.
fn shown(of: Kind, value: &Value) -> String {
    match (of, value.as_table().and_then(|table| table.keys().next())) {
        (Kind::Name(_), Some(name)) => name.clone(),
        _ => text(value),
    }
}

/// Formats a value as in a pair.
fn text(value: &Value) -> String {
    match value {
        Value::String(word) => word.clone(),
        value => value.to_string(),
    }
}

#[cfg(test)]
mod tests;
