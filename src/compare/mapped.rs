//! What a map's lines mean in two files.

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
    golden: &Wave,
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
    let (found, low, width) = if let Some(found) = other.find(name) {
        (found, 0, other.variables[found].width)
    } else {
        let sliced =
            brackets(name).and_then(|(base, first, last)| Some((other.find(base)?, first, last)));
        let Some((found, first, last)) = sliced else {
            let problem = format!("no signal of the other file is called {name}");
            return Err(fault(problem, format!("a signal of {}", other.file)));
        };
        let variable = &other.variables[found];
        match (variable.place(first), variable.place(last)) {
            (Some(high), Some(low)) if high >= low => (found, low, high - low + 1),
            _ => {
                let allowed = format!("bits of {}{}", variable.path, variable.range());
                return Err(fault(format!("{name} is no part of the signal"), allowed));
            }
        }
    };
    let wanted = golden.variables[index].width;
    if width != wanted {
        let problem = format!("{name} has width {width}");
        return Err(fault(
            problem,
            format!("width {wanted}, as the golden signal has"),
        ));
    }
    Ok(Pair {
        golden: index,
        other: found,
        low,
        width,
        invert: *invert,
        delay: *delay,
        name: format!("{}{name}", if *invert { "!" } else { "" }),
    })
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

pub(super) fn check_scopes(golden: &Wave, other: &Wave, map: &Map) -> Result<(), Fault> {
    for entry in &map.scopes {
        for (wave, which, scope) in [
            (golden, "golden", &entry.golden),
            (other, "other", &entry.other),
        ] {
            if !wave.has_scope(scope) {
                return Err(no_scope(map, entry, wave, which, scope));
            }
        }
    }
    Ok(())
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
