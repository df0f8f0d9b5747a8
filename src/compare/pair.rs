//! Which signal of the other file stands for which of the golden one.

use super::map::{Entry, Map, Partner};
use super::names::{brackets, element, listed};
use super::report::WidthDifference;
use super::scope;
use super::value::WIDEST;
use super::wave::Wave;
use crate::input::Fault;
use std::collections::HashSet;

/// A golden signal and the bits of the other file that stand for it.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub golden: usize,
    pub other: usize,
    /// The lowest bit of the other signal.
    pub low: u32,
    pub width: u32,
    pub invert: bool,
    /// Ticks by which the other one is later.
    pub delay: u64,
    /// The other one as the report calls it.
    pub name: String,
}

/// What became of every golden signal.
#[derive(Debug, Default)]
pub(super) struct Pairing {
    pub pairs: Vec<Pair>,
    /// The scope that stands for golden's top, where it was needed.
    pub scope: Option<String>,
    pub ignored: Vec<usize>,
    pub without_partner: Vec<usize>,
    pub too_wide: Vec<usize>,
    pub widths: Vec<WidthDifference>,
    /// Partners, in the other file, of the last two.
    not_compared: Vec<usize>,
}

/// Pairs the signals. The clocks are no pair.
pub(super) fn pair(
    golden: &Wave,
    other: &Wave,
    clocks: (usize, usize),
    map: &Map,
    wanted: Option<&str>,
) -> Result<Pairing, Fault> {
    let clock = golden.variables[clocks.0].signal;
    let signals =
        (0..golden.variables.len()).filter(|&index| golden.variables[index].signal != clock);
    let mut pairing = Pairing::default();
    let ignored = ignored(golden, map)?;
    let (out, open): (Vec<usize>, Vec<usize>) = signals.partition(|index| ignored.contains(index));
    pairing.ignored = out;

    let mut named = HashSet::new();
    for entry in &map.signals {
        let index = golden_signal(golden, map, entry)?;
        if index == clocks.0 || golden.variables[index].signal == clock {
            return Err(map.fault(
                entry.line,
                &entry.golden,
                "is the clock",
                "--other-clock for the other file's clock",
            ));
        }
        if !named.insert(index) {
            return Err(map.fault(
                entry.line,
                &entry.golden,
                "is given twice",
                "one line for a golden signal",
            ));
        }
        let pair = by_name(golden, other, map, entry, index)?;
        if !ignored.contains(&index) {
            pairing.add(golden, other, pair);
        }
    }

    check_scopes(golden, other, map)?;
    let mut rest = Vec::new();
    for index in open.into_iter().filter(|index| !named.contains(index)) {
        let path = &golden.variables[index].path;
        let below = |entry: &&Entry<String>| {
            let rest = path.strip_prefix(&entry.golden);
            rest.is_some_and(|rest| rest.starts_with(['.', '[']))
        };
        // The innermost scope decides.
        let entry = map
            .scopes
            .iter()
            .filter(below)
            .max_by_key(|entry| entry.golden.len());
        match entry {
            Some(entry) => {
                let name = format!("{}{}", entry.other, &path[entry.golden.len()..]);
                pairing.try_path(golden, other, index, &name);
            }
            None => rest.push(index),
        }
    }

    let scope = scope::find(
        golden,
        other,
        clocks.1,
        &rest,
        wanted,
        !pairing.pairs.is_empty(),
    )?;
    for index in rest {
        match &scope {
            Some(scope) => {
                let name = scope::below(scope, scope::relative(golden, index));
                pairing.try_path(golden, other, index, &name);
            }
            None => pairing.without_partner.push(index),
        }
    }
    pairing.scope = scope;
    pairing.pairs.sort_by_key(|pair| pair.golden);
    Ok(pairing)
}

impl Pairing {
    /// Every variable of the other file that is a partner, compared or not.
    pub fn used_others(&self) -> impl Iterator<Item = usize> {
        let pairs = self.pairs.iter().map(|pair| pair.other);
        pairs.chain(self.not_compared.iter().copied())
    }

    fn try_path(&mut self, golden: &Wave, other: &Wave, index: usize, name: &str) {
        match partner(golden, other, index, name) {
            Some(pair) => self.add(golden, other, pair),
            None => self.without_partner.push(index),
        }
    }

    fn add(&mut self, golden: &Wave, other: &Wave, pair: Pair) {
        let variable = &golden.variables[pair.golden];
        if pair.width != variable.width || pair.width > WIDEST {
            self.not_compared.push(pair.other);
        }
        if pair.width != variable.width {
            self.widths.push(WidthDifference {
                golden: variable.path.clone(),
                golden_bits: variable.width,
                other: other.variables[pair.other].path.clone(),
                other_bits: pair.width,
            });
        } else if pair.width > WIDEST {
            self.too_wide.push(pair.golden);
        } else {
            self.pairs.push(pair);
        }
    }
}

/// The signal of this path, or the bit of a vector that stands for a word of one bit: some
/// dumps write a memory of single bits as a vector.
pub(super) fn partner(golden: &Wave, other: &Wave, index: usize, name: &str) -> Option<Pair> {
    let whole = |found: usize| Pair {
        golden: index,
        other: found,
        low: 0,
        width: other.variables[found].width,
        invert: false,
        delay: 0,
        name: other.variables[found].path.clone(),
    };
    if let Some(found) = other.find(name) {
        return Some(whole(found));
    }
    if golden.variables[index].width != 1 {
        return None;
    }
    let element = element(name);
    let (base, number, last) = brackets(&element)?;
    let found = other.find(base).filter(|_| number == last)?;
    Some(Pair {
        low: other.variables[found].place(number)?,
        width: 1,
        name: element.clone(),
        ..whole(found)
    })
}

fn golden_signal<T>(golden: &Wave, map: &Map, entry: &Entry<T>) -> Result<usize, Fault> {
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

fn by_name(
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
        let problem = format!("{name} has a width of {width} bits");
        return Err(fault(
            problem,
            format!("{wanted} bits, as the golden signal has"),
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

fn ignored(golden: &Wave, map: &Map) -> Result<HashSet<usize>, Fault> {
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

fn check_scopes(golden: &Wave, other: &Wave, map: &Map) -> Result<(), Fault> {
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

/// Where nothing is paired there is nothing to compare.
pub(super) fn nothing(golden: &Wave, other: &Wave, pairing: &Pairing) -> Option<Fault> {
    if !pairing.pairs.is_empty() || !pairing.widths.is_empty() {
        return None;
    }
    let alone: Vec<_> = pairing
        .without_partner
        .iter()
        .map(|&index| &golden.variables[index].path)
        .collect();
    let allowed = format!(
        "--scope or --map that pairs at least one of {}",
        listed(&alone)
    );
    Some(Fault::new(
        &other.file,
        0,
        "file",
        "no signal of the golden file has a partner here",
        allowed,
    ))
}
