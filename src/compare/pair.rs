//! Pairing of golden signals with signals of the other file.

use super::map::{Entry, Map};
use super::mapped::{by_name, golden_signal, ignored, scopes};
use super::names::{brackets, element, listed};
use super::ports::Ports;
use super::report::WidthDifference;
use super::scope;
use super::value::WIDEST;
use super::wave::Wave;
use crate::input::Fault;
use std::collections::HashSet;

/// Golden signal with the bits of the other file that correspond to it.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub golden: usize,
    pub other: usize,
    /// Lowest bit in the other signal.
    pub low: u32,
    pub width: u32,
    pub invert: bool,
    /// Delay of the other signal in ticks.
    pub delay: u64,
    /// Name of the other signal in the report.
    pub name: String,
}

/// Result for every golden signal.
#[derive(Debug, Default)]
pub(super) struct Pairing {
    pub pairs: Vec<Pair>,
    /// Scope that corresponds to golden's top, if one was needed.
    pub scope: Option<String>,
    pub ports: Ports,
    pub ignored: Vec<usize>,
    pub without_partner: Vec<usize>,
    pub too_wide: Vec<usize>,
    pub widths: Vec<WidthDifference>,
    /// Partners, in the other file, of the last two lists.
    not_compared: Vec<usize>,
}

/// Pairs the signals, without the clocks. Returns an error if no names match, unless `allowed`.
pub(super) fn pair(
    golden: &Wave,
    other: &Wave,
    clocks: (usize, usize),
    map: &Map,
    ports: Ports,
    wanted: Option<&str>,
    allowed: bool,
) -> Result<Pairing, Fault> {
    let clock = golden.variables[clocks.0].signal;
    let signals =
        (0..golden.variables.len()).filter(|&index| golden.variables[index].signal != clock);
    let ignored = ignored(golden, map)?;
    let (out, open): (Vec<usize>, Vec<usize>) = signals
        .filter(|index| !ports.left.contains(index))
        .partition(|index| ignored.contains(index));
    let mut pairing = Pairing {
        ignored: out,
        ports,
        ..Pairing::default()
    };

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
        let pair = by_name(other, map, entry, index)?;
        if !ignored.contains(&index) && !pairing.ports.left.contains(&index) {
            pairing.add(golden, pair);
        }
    }

    let scopes = scopes(golden, other, map)?;
    let mut rest = Vec::new();
    for index in open.into_iter().filter(|index| !named.contains(index)) {
        let path = &golden.variables[index].path;
        let below = |entry: &&Entry<String>| {
            let rest = path.strip_prefix(&entry.golden);
            rest.is_some_and(|rest| rest.starts_with(['.', '[']))
        };
        // The innermost scope decides.
        let entry = scopes
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

    // If the map names scopes, only these are searched, and no others.
    let scope = match scopes[..] {
        [_, ..] if wanted.is_none() => None,
        _ => {
            let paired = allowed || pairing.has_partners();
            scope::find(golden, other, clocks.1, &rest, wanted, paired)?
        }
    };
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
    /// Returns the signals of the other file that have no partner, compared or not; aliases once.
    pub fn free(&self, other: &Wave, clock: usize) -> Vec<usize> {
        let pairs = self.pairs.iter().map(|pair| pair.other);
        let pairs = pairs
            .chain(self.not_compared.iter().copied())
            .chain([clock]);
        let signal = |index: usize| other.variables[index].signal;
        let mut used: HashSet<_> = pairs.map(signal).collect();
        let all = 0..other.variables.len();
        all.filter(|&index| used.insert(signal(index))).collect()
    }

    /// True if a golden signal has a partner, compared or not.
    fn has_partners(&self) -> bool {
        !self.pairs.is_empty() || !self.not_compared.is_empty()
    }

    fn try_path(&mut self, golden: &Wave, other: &Wave, index: usize, name: &str) {
        let mut name = name.to_owned();
        loop {
            if let Some(pair) = partner(golden, other, index, &name) {
                return self.add(golden, pair);
            }
            // Verilog has no bundles: their names become prefixes of signal names.
            match name.rfind('.') {
                Some(dot) => name.replace_range(dot..=dot, "_"),
                None => return self.without_partner.push(index),
            }
        }
    }

    fn add(&mut self, golden: &Wave, pair: Pair) {
        let variable = &golden.variables[pair.golden];
        if pair.width != variable.width || pair.width > WIDEST {
            self.not_compared.push(pair.other);
        }
        if pair.width != variable.width {
            self.widths.push(WidthDifference {
                golden: variable.path.clone(),
                golden_bits: variable.width,
                other: pair.name,
                other_bits: pair.width,
            });
        } else if pair.width > WIDEST {
            self.too_wide.push(pair.golden);
        } else {
            self.pairs.push(pair);
        }
    }
}

/// Returns the signal with this path, or the bit of a vector for a word of one bit: some dumps
/// write a memory of single bits as a vector.
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

/// Returns an error if nothing is paired.
pub(super) fn nothing(golden: &Wave, other: &Wave, pairing: &Pairing) -> Option<Fault> {
    if !pairing.pairs.is_empty() || !pairing.widths.is_empty() {
        return None;
    }
    if !pairing.too_wide.is_empty() {
        let wide = pairing.too_wide.iter();
        let wide: Vec<_> = wide.map(|&index| &golden.variables[index].path).collect();
        let problem = format!("nothing pairs but signals of more than {WIDEST} bits");
        let allowed = format!("a narrower signal beside {}", listed(&wide));
        return Some(Fault::new(&other.file, 0, "file", problem, allowed));
    }
    let alone: Vec<_> = pairing
        .without_partner
        .iter()
        .map(|&index| &golden.variables[index].path)
        .collect();
    let allowed = match alone[..] {
        [] => "a map that leaves something to compare".to_owned(),
        _ => format!(
            "--scope or --map that pairs at least one of {}",
            listed(&alone)
        ),
    };
    Some(Fault::new(
        &other.file,
        0,
        "file",
        "no signal of the golden file has a partner here",
        allowed,
    ))
}
