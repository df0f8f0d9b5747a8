//! Partners that a map names, and signals that it leaves out.

use super::{Part, Sides, bits, is_end, listed};
use motion_rtl::compare::{Entry, Partner, brackets};
use motion_rtl::input::Fault;
use motion_rtl::sim::{PortDirection, SignalInfo};
use std::collections::{BTreeMap, BTreeSet};

impl Sides<'_> {
    /// Returns the indices of a signal, or of the words of a memory, by its name in a map.
    fn find(&self, name: &str) -> Vec<usize> {
        let below = name.strip_prefix(self.circuit);
        let below = below.and_then(|name| name.strip_prefix('.'));
        let of = |name: &str| -> Vec<usize> {
            let is = |path: &str| match path.strip_prefix(name) {
                Some(rest) => rest.is_empty() || rest.starts_with('[') && !name.ends_with(']'),
                None => false,
            };
            let signals = self.signals.iter().enumerate();
            let found = signals.filter(|(_, signal)| is(&signal.path) || is(&signal.verilog));
            found.map(|(index, _)| index).collect()
        };
        match of(name) {
            none if none.is_empty() => below.map(of).unwrap_or_default(),
            found => found,
        }
    }

    fn named<T>(&self, entry: &Entry<T>) -> Result<Vec<usize>, Fault> {
        let found = self.find(&entry.golden);
        if !found.is_empty() {
            return Ok(found);
        }
        let problem = format!("no signal of {} is called so", self.circuit);
        let allowed = format!("a signal that `motion-rtl list {}` shows", self.circuit);
        Err(self.map.fault(entry.line, &entry.golden, problem, allowed))
    }

    /// Returns the signals that the map leaves out.
    pub(super) fn left_out(&self) -> Result<BTreeSet<usize>, Fault> {
        let mut left = BTreeSet::new();
        for entry in self.map.left_out() {
            let Some(scope) = entry.golden.strip_suffix(".*") else {
                left.extend(self.named(entry)?);
                continue;
            };
            let below = scope.strip_prefix(self.circuit).unwrap_or(scope);
            let below = below.strip_prefix('.').unwrap_or(below);
            let signals = self.signals.iter().enumerate();
            let inside = signals.filter(|(_, signal)| {
                let rest = signal.path.strip_prefix(below);
                below.is_empty() || rest.is_some_and(|rest| rest.starts_with(['.', '[']))
            });
            left.extend(inside.map(|(index, _)| index));
        }
        Ok(left)
    }

    /// Returns the partners that the map names.
    pub(super) fn mapped(&self) -> Result<BTreeMap<usize, Part>, Fault> {
        let mut mapped = BTreeMap::new();
        for entry in self.map.signals() {
            let signals = self.named(entry)?;
            for index in signals {
                let signal = &self.signals[index];
                let part = self.part(entry, signal)?;
                mapped.insert(index, part);
            }
        }
        Ok(mapped)
    }

    /// Returns the partner of one signal that a line of the map names.
    fn part(&self, entry: &Entry<Partner>, signal: &SignalInfo) -> Result<Part, Fault> {
        let Partner {
            name,
            invert,
            delay,
        } = &entry.other;
        let fault = |problem: String, allowed: String| {
            self.map.fault(entry.line, &entry.golden, problem, allowed)
        };
        if *delay > 0 {
            let problem = format!("a delay of {delay}, which a proof does not have");
            return Err(fault(problem, "a signal without delay".to_owned()));
        }
        // A word of a memory whose name is in the map.
        let name = match (signal.path.rfind('['), entry.golden.ends_with(']')) {
            (Some(at), false) => format!("{name}{}", &signal.path[at..]),
            _ => name.clone(),
        };
        let whole = self
            .net(&name)
            .map_err(|(problem, allowed)| fault(problem, allowed))?;
        let (net, low, width) = match (whole, brackets(&name)) {
            (Some(net), _) => (net, 0, self.design.nets[net].width()),
            (None, Some((base, first, last))) => {
                let net = self
                    .net(base)
                    .map_err(|(problem, allowed)| fault(problem, allowed))?;
                let net = net.ok_or_else(|| fault(self.no_net(base), self.nets()))?;
                let of = &self.design.nets[net];
                match (of.place(first), of.place(last)) {
                    (Some(high), Some(low)) if high >= low => (net, low, high - low + 1),
                    _ => {
                        let problem = format!("{name} is no part of the signal");
                        return Err(fault(problem, format!("{} bits of {net}", of.width())));
                    }
                }
            }
            (None, None) => return Err(fault(self.no_net(&name), self.nets())),
        };
        if width != signal.width() {
            let problem = format!("{name} has {}", bits(width));
            let allowed = format!("{}, as {} has", bits(signal.width()), signal.path);
            return Err(fault(problem, allowed));
        }
        if signal.port == Some(PortDirection::In) && !self.design.inputs.contains_key(net) {
            let problem = format!("{net} is no input port of the design");
            let inputs = self.design.inputs.keys().map(String::as_str);
            return Err(fault(problem, listed(inputs)));
        }
        Ok(Part {
            net: net.to_owned(),
            low,
            width,
            invert: *invert,
        })
    }

    fn no_net(&self, name: &str) -> String {
        format!("no signal of the design is called {name}")
    }

    /// Lists registers and ports of the design for a message.
    fn nets(&self) -> String {
        let nets = self.design.nets.iter();
        let nets = nets.filter(|(name, net)| net.is_register || self.is_port(name));
        listed(nets.map(|(name, _)| name.as_str()))
    }

    /// Returns the design's net that a path of a dump names: scopes of a bench may stand before it,
    /// or it may be the end of the net's path.
    fn net(&self, path: &str) -> Result<Option<&str>, (String, String)> {
        let nets = || self.design.nets.keys().map(String::as_str);
        let above = nets().filter(|net| is_end(path, net));
        if let Some(net) = above.max_by_key(|net| net.len()) {
            return Ok(Some(net));
        }
        let ends: Vec<&str> = nets().filter(|net| is_end(net, path)).collect();
        let first = ends.first().copied();
        let same = |net: &&str| {
            let bits = |net: &str| &self.design.nets[net].bits;
            first.is_some_and(|first| bits(first) == bits(net))
        };
        match ends.iter().all(same) {
            true => Ok(first),
            false => Err((
                format!("{path} is the end of several names"),
                listed(ends.into_iter()),
            )),
        }
    }

    /// Returns the scopes of the map, below the circuit, with those of the design.
    pub(super) fn scopes(&self) -> Result<Vec<(String, String)>, Fault> {
        let mut known = BTreeSet::new();
        for net in self.design.nets.keys() {
            let dots = net.match_indices('.');
            known.extend(dots.map(|(at, _)| &net[..at]));
        }
        let scope = |entry: &Entry<String>| {
            let own = entry.golden.strip_prefix(self.circuit);
            let own = own.and_then(|rest| match rest {
                "" => Some(""),
                rest => rest.strip_prefix('.'),
            });
            let own = own.unwrap_or(&entry.golden);
            let other = entry.other.as_str();
            let fits = |scope: &&&str| is_end(other, scope) || is_end(scope, other);
            let found = known.iter().filter(fits).max_by_key(|scope| scope.len());
            match found {
                Some(found) => Ok((own.to_owned(), format!("{found}."))),
                // The bench's instance of the whole design.
                None if own.is_empty() => Ok((String::new(), String::new())),
                None => {
                    let problem = format!("no scope of the design is called {other}");
                    let allowed = listed(known.iter().copied());
                    Err(self.map.fault(entry.line, &entry.golden, problem, allowed))
                }
            }
        };
        let mut scopes: Vec<_> = self
            .map
            .scopes()
            .iter()
            .map(scope)
            .collect::<Result<_, _>>()?;
        // The innermost scope counts.
        scopes.sort_by_key(|(own, _)| std::cmp::Reverse(own.len()));
        Ok(scopes)
    }
}
