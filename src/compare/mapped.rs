//! Meaning of a map's lines in two files.

use super::map::{Entry, Map, Partner};
use super::names::brackets;
use super::pair::Pair;
use super::wave::Wave;
use crate::input::Fault;
use std::collections::HashSet;

pub(super) fn golden_signal<T>(golden: &Wave, map: &Map, entry: &Entry<T>) -> Result<usize, Fault> {
    golden.find(&entry.golden).ok_or_else(|| {
        let allowed = format!("a signal of {}", golden.file);
        map.fault(
            entry.line,
            &entry.golden,
            "no signal of the golden file is called so",
            allowed,
        )
    })
}

pub(super) fn by_name(
    other: &Wave,
    map: &Map,
    entry: &Entry<Partner>,
    index: usize,
) -> Result<Pair, Fault> {
    let Partner {
        name,
        invert,
        delay,
    } = &entry.other;
    let fault =
        |problem: String, allowed: String| map.fault(entry.line, &entry.golden, problem, allowed);
    let by_end = |name: &str| {
        other.by_end(name).map_err(|ambiguous| {
            let (problem, allowed) = ambiguous.message("signal");
            fault(problem, allowed)
        })
    };
    let inverted = if *invert { "!" } else { "" };
    let pair = |found: usize, low: u32, width: u32, bits: &str| Pair {
        golden: index,
        other: found,
        low,
        width,
        invert: *invert,
        delay: *delay,
        name: format!("{inverted}{}{bits}", other.variables[found].path),
    };
    if let Some(found) = by_end(name)? {
        return Ok(pair(found, 0, other.variables[found].width, ""));
    }
    let sliced = match brackets(name) {
        Some((base, first, last)) => by_end(base)?.map(|found| (found, first, last)),
        None => None,
    };
    let Some((found, first, last)) = sliced else {
        let problem = format!("no signal of the other file is called {name}");
        return Err(fault(problem, format!("a signal of {}", other.file)));
    };
    let variable = &other.variables[found];
    match (variable.place(first), variable.place(last)) {
        (Some(high), Some(low)) if high >= low => {
            let bits = &name[name.rfind('[').unwrap_or(name.len())..];
            Ok(pair(found, low, high - low + 1, bits))
        }
        _ => {
            let allowed = format!("bits of {}{}", variable.path, variable.range());
            Err(fault(format!("{name} is no part of the signal"), allowed))
        }
    }
}

pub(super) fn ignored(golden: &Wave, map: &Map) -> Result<HashSet<usize>, Fault> {
    let mut ignored = HashSet::new();
    for entry in &map.ignore {
        let Some(scope) = entry.golden.strip_suffix(".*") else {
            ignored.insert(golden_signal(golden, map, entry).map_err(|mut fault| {
                fault.allowed.push_str(", or a scope as \"top.scope.*\"");
                fault
            })?);
            continue;
        };
        let below = |index: &usize| {
            let rest = golden.variables[*index].path.strip_prefix(scope);
            rest.is_some_and(|rest| rest.starts_with(['.', '[']))
        };
        let before = ignored.len();
        ignored.extend((0..golden.variables.len()).filter(below));
        if ignored.len() == before && !golden.has_scope(scope) {
            return Err(no_scope(map, entry, golden, "golden", scope));
        }
    }
    Ok(ignored)
}

/// Returns the map's scopes with the other file's in full.
pub(super) fn scopes(golden: &Wave, other: &Wave, map: &Map) -> Result<Vec<Entry<String>>, Fault> {
    let full = |entry: &Entry<String>| {
        if !golden.has_scope(&entry.golden) {
            return Err(no_scope(map, entry, golden, "golden", &entry.golden));
        }
        let found = other.scope_by_end(&entry.other).map_err(|ambiguous| {
            let (problem, allowed) = ambiguous.message("scope");
            map.fault(entry.line, &entry.golden, problem, allowed)
        })?;
        Ok(Entry {
            other: found.ok_or_else(|| no_scope(map, entry, other, "other", &entry.other))?,
            ..entry.clone()
        })
    };
    map.scopes.iter().map(full).collect()
}

fn no_scope<T>(map: &Map, entry: &Entry<T>, wave: &Wave, which: &str, scope: &str) -> Fault {
    let problem = format!("no scope of the {which} file is called {scope}");
    map.fault(
        entry.line,
        &entry.golden,
        problem,
        format!("a scope: {}", wave.scopes()),
    )
}
