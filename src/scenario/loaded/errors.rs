//! All errors in the text of a scenario.

use std::ops::Range;

use serde_path_to_error::{Path, Segment};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::super::{Runnable, Scenario};
use super::{CIRCUIT, Located, MISSING, scenario};
use crate::input::{Fault, Faults};
use crate::nearest::did_you_mean;
use crate::settings::{self, ALLOWED, Key, Shape};

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
        let job = circuit.or_else(|| circuit_of(table.get_ref()));
        let fault = fault(file, text, error.inner());
        found.push(match missing(error.inner().message()) {
            Some(key) => Fault {
                allowed: allowed(job, error.path(), Some(key)),
                ..fault
            },
            None => refined(fault, job, &error),
        });
        let message = error.inner().message();
        let unknown = message.starts_with("unknown ") || message.contains(ALLOWED);
        match leave_out(&mut table, error.path(), unknown) {
            Some(key) => left_out.push(key),
            None => break,
        }
    }
    // A missing key may be a misspelt one: misspelt keys come first.
    found.sort_by_key(|fault| (fault.problem == MISSING, fault.line));
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

/// The circuit that a table names, if there is one of this name.
fn circuit_of(table: &DeTable<'_>) -> Option<Runnable> {
    let name = table.get(CIRCUIT)?.get_ref().as_str()?;
    Runnable::ALL.into_iter().find(|job| job.name() == name)
}

/// The key of a job that a path leads to, and true if it leads to an element of its list.
fn key_at(job: Option<Runnable>, path: &Path, last: Option<&str>) -> Option<(&'static Key, bool)> {
    let mut names: Vec<_> = Vec::new();
    let mut element = false;
    for segment in path {
        match segment {
            Segment::Map { key } => {
                names.push(key.as_str());
                element = false;
            }
            Segment::Seq { .. } => element = true,
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    names.extend(last);
    // The key that chooses the job is one of all jobs.
    let (keys, _) = job.unwrap_or(Runnable::Machine).keys();
    let key = settings::find(&keys, &names)?;
    Some((key, element && last.is_none()))
}

/// Values that a missing key takes.
pub(super) fn allowed(job: Option<Runnable>, path: &Path, missing: Option<&str>) -> String {
    let key = key_at(job, path, missing);
    let values = key.and_then(|(key, element)| settings::allowed(key, element));
    let tables = || {
        let name = missing.unwrap_or_default();
        of_lists(name, ", expected a sequence").map(|(_, allowed)| allowed)
    };
    let words = || match key?.0.shape {
        Shape::Text => Some(settings::kind(Shape::Text)),
        shape => Some(format!("a {}", settings::kind(shape))),
    };
    let values = values.or_else(tables).or_else(words);
    values.unwrap_or_else(|| "a value".to_owned())
}

/// Returns the fault of a value with the values that its key takes.
pub(super) fn refined(fault: Fault, job: Option<Runnable>, error: &Located) -> Fault {
    let message = error.inner().message();
    let of_value = ["invalid type", "invalid value", NO_NAME];
    if !of_value.iter().any(|start| message.starts_with(start)) {
        return fault;
    }
    let key = key_at(job, error.path(), None);
    let values = key.and_then(|(key, element)| settings::allowed(key, element));
    let problem = match fault.problem.strip_prefix("invalid value: integer `") {
        Some(number) => format!("is {}", number.trim_end_matches('`')),
        None if message == NO_NAME => "is not text".to_owned(),
        None => fault.problem,
    };
    Fault {
        problem,
        allowed: values.unwrap_or(fault.allowed),
        ..fault
    }
}

/// Message of the TOML reader about a name that is neither text nor a table.
const NO_NAME: &str = "wanted string or table";

/// The key that a message says is missing.
pub(super) fn missing(message: &str) -> Option<&str> {
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
    let of_name = message.strip_prefix("unknown variant `");
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
    let near = of_name.and_then(|name| name.split_once('`'));
    let names = allowed.split('`').skip(1).step_by(2);
    let near = near.map_or_else(String::new, |(name, _)| did_you_mean(name, names));
    (problem.replace(" as i128", "") + &near, allowed.to_owned())
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
        return Fault::new(file, line, key, MISSING, "a value");
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
