//! All errors in the text of a scenario.

use std::ops::Range;

use serde_path_to_error::{Path, Segment};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::super::{Runnable, Scenario};
use super::{CIRCUIT, NO_DEFAULT, scenario};
use crate::input::{Fault, Faults};
use crate::settings::ALLOWED;

/// Most faults that are looked for: more than a shipped scenario has keys.
const MOST_FOUND: usize = 100;

/// Reads the keys of a scenario, of another circuit than its own if `circuit` says one. What is
/// wrong with a key is reported, and the key left out to find what else is.
///
/// # Errors
///
/// Text that is no TOML; keys that there are not, are missing, or have a value of a wrong type. Keys
/// that another circuit misses are no errors, as overrides may have them: there is no scenario yet.
pub(super) fn read(
    file: &str,
    text: &str,
    circuit: Option<Runnable>,
) -> Result<Option<Scenario>, Fault> {
    let (mut table, errors) = DeTable::parse_recoverable(text);
    if let (Some(circuit), Some(own)) = (circuit, table.get_mut().get_mut(CIRCUIT)) {
        *own.get_mut() = DeValue::String(circuit.name().into());
    }
    let mut found: Vec<Fault> = errors
        .iter()
        .map(|error| fault(file, text, error))
        .collect();
    let mut left_out: Vec<String> = Vec::new();
    while found.len() == left_out.len() && found.len() < MOST_FOUND {
        let error = match scenario(&table) {
            Ok(scenario) if found.is_empty() => return Ok(Some(scenario)),
            Ok(_) => break,
            Err(error) => error,
        };
        match missing(error.inner().message()) {
            Some(_) if circuit.is_some() && found.is_empty() => return Ok(None),
            Some(_) if circuit.is_some() => break,
            Some(key) if left_out.iter().any(|out| out == key) => break,
            _ => {}
        }
        found.push(fault(file, text, error.inner()));
        let message = error.inner().message();
        let unknown = message.starts_with("unknown ") || message.contains(ALLOWED);
        match leave_out(&mut table, error.path(), unknown) {
            Some(key) => left_out.push(key),
            None => break,
        }
    }
    // A missing key may be a misspelt one: misspelt keys come first.
    found.sort_by_key(|fault| (fault.problem == "missing", fault.line));
    let mut faults = Faults::default();
    // All of them: a scenario that moves to another circuit has many keys that do not apply.
    for fault in found {
        faults.add(fault);
    }
    // There is a fault, or the scenario would have been returned.
    faults.or(|| {
        Err(Fault::new(
            file,
            0,
            "file",
            "is no scenario",
            "a scenario in TOML",
        ))
    })
}

/// The key that a message says is missing.
fn missing(message: &str) -> Option<&str> {
    let key = message.strip_prefix("missing field `")?;
    Some(key.trim_end_matches('`'))
}

/// Takes out the key that a path leads to or into, and gives its name. Where that is in a row of a
/// list, and is not unknown there, the row goes: it may not do without the key.
fn leave_out(table: &mut Spanned<DeTable<'_>>, path: &Path, unknown: bool) -> Option<String> {
    let mut keys = Vec::new();
    for segment in path {
        match segment {
            Segment::Map { key } => keys.push((key.as_str(), None)),
            Segment::Seq { index } => keys.last_mut()?.1 = Some(*index),
            Segment::Enum { .. } | Segment::Unknown => break,
        }
    }
    let ((last, _), within) = keys.split_last()?;
    let mut inner = table.get_mut();
    for (key, index) in within {
        inner = match (inner.get_mut(*key)?.get_mut(), index) {
            (DeValue::Table(table), None) => table,
            (DeValue::Array(rows), Some(index)) if !unknown => {
                let others = rows.iter().enumerate().filter(|(at, _)| at != index);
                *rows = others.map(|(_, row)| row.clone()).collect();
                return Some(format!("row of {key}"));
            }
            (DeValue::Array(rows), Some(index)) => match rows.get_mut(*index)?.get_mut() {
                DeValue::Table(table) => table,
                _ => return None,
            },
            _ => return None,
        };
    }
    inner.remove(*last).map(|_| (*last).to_owned())
}

/// Returns the range of the value that a line, numbered from 1, gives to its key; the whole line if
/// there is none.
pub(super) fn value_in(text: &str, line: usize) -> Option<Range<usize>> {
    let before = line.checked_sub(1)?;
    let mut lines = text.split_inclusive('\n');
    let begin: usize = lines.by_ref().take(before).map(str::len).sum();
    let written = lines.next()?.trim_end();
    let from = written.find('=').map_or(0, |at| at + 1);
    let value = written.get(from..)?;
    // A comment, unless in a string.
    let end = match value.contains(['"', '\'']) {
        true => value.len(),
        false => value.find('#').unwrap_or(value.len()),
    };
    let value = value.get(..end)?;
    let first = begin + from + (value.len() - value.trim_start().len());
    Some(first..first + value.trim().len())
}

/// The key that a line gives a value to; the line where it gives none.
pub(super) fn key_of(line: &str) -> &str {
    let key = line.split('=').next().unwrap_or(line);
    key.trim().trim_matches(['"', '\''])
}

fn line_at(text: &[u8], place: usize) -> usize {
    let before = &text[..place.min(text.len())];
    before.iter().filter(|&&byte| byte == b'\n').count() + 1
}

/// Problem and what is allowed of a key whose value is a list, but not of numbers.
pub(super) fn of_lists(key: &str, message: &str) -> Option<(String, String)> {
    let (problem, _) = message.split_once(", expected a sequence")?;
    let allowed = match key {
        "step" | "piece" | "axis" | "load_torque" | "pattern" => format!("tables [[{key}]]"),
        "play" => "a list of names of patterns".to_owned(),
        _ => return None,
    };
    Some((problem.to_owned(), allowed))
}

/// A message of the TOML reader as problem and what is allowed.
pub(super) fn split(message: &str) -> (String, String) {
    if let Some((problem, allowed)) = message.split_once(ALLOWED) {
        return (problem.to_owned(), allowed.to_owned());
    }
    // If the text is not TOML, the token that the parser expects next is rarely the one meant.
    let of_a_value = message.starts_with("invalid ") || message.starts_with("unknown ");
    let (problem, allowed) = message
        .split_once(", expected ")
        .filter(|_| of_a_value)
        .unwrap_or((message, "lines of key = value, in TOML"));
    let allowed = match allowed {
        "u64" => "a whole number from 0",
        "u32" => "a whole number from 0 to 4294967295",
        "i64" => "a whole number",
        "f64" => "a number",
        "a boolean" => "true or false",
        "an array of length 2" => "a list of two numbers, of X and of Y",
        "an array of length 3" => "a list of three numbers, of X, Y and Z",
        "an array of length 3 or 4" => "a list of three numbers, of X, Y and Z, or of four with W",
        "a sequence" => "a list of numbers, one for each axis",
        "path string" => "a path",
        record if record.starts_with("struct ") => "a table of keys and values",
        other => other,
    };
    (problem.replace(" as i128", ""), allowed.to_owned())
}

/// Returns an error of the TOML reader as a fault with its line.
pub(super) fn fault(file: &str, text: &str, error: &toml::de::Error) -> Fault {
    let message = error.message();
    if let Some(key) = message.strip_prefix("missing field `") {
        let key = key.trim_end_matches('`');
        // A key missing from a table is reported at the table's start, others for the whole file.
        let place = error.span().map_or(0, |span| span.start);
        let line = match place {
            0 => 0,
            place => line_at(text.as_bytes(), place),
        };
        return Fault::new(file, line, key, "missing", NO_DEFAULT);
    }
    let line = line_at(text.as_bytes(), error.span().map_or(0, |span| span.start));
    let mut upwards = text
        .lines()
        .take(line)
        .collect::<Vec<_>>()
        .into_iter()
        .rev();
    let written = upwards.clone().next().unwrap_or("");
    let written = match message.starts_with("invalid ") {
        // A value of the wrong type may stand lines below its key.
        true => upwards.find(|line| line.contains('=')).unwrap_or(written),
        false => written,
    };
    let field = match key_of(written) {
        "" => "file",
        key => key,
    };
    let (problem, allowed) = of_lists(field, message).unwrap_or_else(|| split(message));
    let fault = Fault::new(file, line, field, problem, allowed);
    match error.span() {
        Some(span) => fault.marked(text.as_bytes(), &span),
        None => fault,
    }
}
