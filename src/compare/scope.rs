//! Search for the scope of the other file that corresponds to golden's top.

use super::names::listed;
use super::pair::partner;
use super::wave::Wave;
use crate::input::Fault;
use std::collections::{HashMap, HashSet};

/// Returns the path of a golden signal without the top scope.
pub(super) fn relative(golden: &Wave, index: usize) -> &str {
    let path = &golden.variables[index].path;
    path.split_once('.').map_or(path, |(_, below)| below)
}

/// Returns a path below a scope; an empty scope is the file itself.
pub(super) fn below(scope: &str, path: &str) -> String {
    match scope {
        "" => path.to_owned(),
        scope => format!("{scope}.{path}"),
    }
}

/// Returns the wanted scope, or the one with the most partners. If there is none, returns an error
/// unless something is paired already.
pub(super) fn find(
    golden: &Wave,
    other: &Wave,
    clock: usize,
    signals: &[usize],
    wanted: Option<&str>,
    paired: bool,
) -> Result<Option<String>, Fault> {
    let fault =
        |problem: String, allowed: String| Fault::new(&other.file, 0, "--scope", problem, allowed);
    if let Some(wanted) = wanted {
        let found = other.scope_by_end(wanted).map_err(|ambiguous| {
            let (problem, allowed) = ambiguous.message("scope");
            fault(problem, allowed)
        })?;
        let none = || {
            let problem = format!("there is no {wanted}");
            fault(problem, format!("a scope: {}", other.scopes()))
        };
        return found.map(Some).ok_or_else(none);
    }
    if signals.is_empty() {
        return Ok(None);
    }
    let top = |index: &usize| golden.variables[*index].path.split('.').next();
    let first = signals.first().and_then(top);
    if let Some(second) = signals.iter().map(top).find(|&scope| scope != first) {
        let tops = listed(&[first.unwrap_or(""), second.unwrap_or("")]);
        let problem = format!("more than one outermost scope: {tops}");
        return Err(Fault::new(
            &golden.file,
            0,
            "file",
            problem,
            "one scope that holds all signals",
        ));
    }
    let best = candidates(golden, other, clock, signals);
    let shown: Vec<_> = best
        .iter()
        .map(|scope| match scope.as_str() {
            "" => "(no scope)",
            scope => scope,
        })
        .collect();
    match &best[..] {
        [one] => Ok(Some(one.clone())),
        _ if paired => Ok(None),
        [] => Err(Fault::new(
            &other.file,
            0,
            "names",
            "no golden signal has a partner of the same name in any scope",
            "--map, which pairs other names; `compare --template` begins one",
        )),
        _ => Err(fault(
            format!(
                "{} scopes have the same number of signals of the golden file's",
                best.len()
            ),
            format!("one of {}", listed(&shown)),
        )),
    }
}

/// Returns the scopes with the most partners. Scopes that contain the same signals by other names
/// count as one.
fn candidates(golden: &Wave, other: &Wave, clock: usize, signals: &[usize]) -> Vec<String> {
    let wanted: HashSet<_> = signals
        .iter()
        .map(|&index| other.key(relative(golden, index)))
        .collect();
    let clock = other.variables[clock].signal;
    let mut counts: HashMap<String, usize> = HashMap::new();
    for variable in other
        .variables
        .iter()
        .filter(|variable| variable.signal != clock)
    {
        let path = other.key(&variable.path);
        if wanted.contains(&path) {
            *counts.entry(String::new()).or_default() += 1;
        }
        for (place, _) in path.match_indices('.') {
            if wanted.contains(&path[place + 1..]) {
                // Scope as written in the file.
                let scope = &variable.path[..place];
                *counts.entry(scope.to_owned()).or_default() += 1;
            }
        }
    }
    let most = counts.values().copied().max().unwrap_or(0);
    let mut best: Vec<_> = counts
        .into_iter()
        .filter(|(_, count)| *count == most)
        .map(|(scope, _)| scope)
        .collect();
    // The innermost one represents them.
    best.sort_by(|a, b| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
    let mut seen = HashSet::new();
    best.retain(|scope| {
        let partners = |&index: &usize| {
            let pair = partner(golden, other, index, &below(scope, relative(golden, index)))?;
            Some(other.variables[pair.other].signal)
        };
        seen.insert(signals.iter().map(partners).collect::<Vec<_>>())
    });
    best
}
