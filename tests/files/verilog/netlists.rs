//! Every netlist of the catalogue does what its circuit does.

use super::interpreter::Instance;
use super::{circuits, flat, models};
use motion_rtl::check::Drive;
use motion_rtl::netlist::Role;
use motion_rtl::registry::{AnyModel, CATALOGUE};
use motion_rtl::trace::Clock;
use rayon::prelude::*;
use std::collections::HashMap;
use vcd::{Command, IdCode, Parser, ScopeItem, Value};

const TICKS: u64 = 1_500;

/// The names of the variables of a dump.
pub(super) fn names(
    items: &[ScopeItem],
    around: &[&str],
    names: &mut HashMap<IdCode, Vec<String>>,
) {
    for item in items {
        match item {
            ScopeItem::Scope(scope) => {
                let around = [around, &[&scope.identifier]].concat();
                self::names(&scope.items, &around, names);
            }
            ScopeItem::Var(var) => {
                let path = [around, &[&var.reference]].concat();
                names.entry(var.code).or_default().push(path.join("_"));
            }
            _ => {}
        }
    }
}

/// The bits from `low` of a word of hexadecimal digits.
fn bits(digits: &str, low: usize, width: usize) -> u64 {
    let bit = |index: usize| {
        let place = digits.len().checked_sub(1 + index / 4)?;
        let digit = u64::from_str_radix(&digits[place..=place], 16).ok()?;
        Some(digit >> (index % 4) & 1)
    };
    (0..width).fold(0, |bits, index| {
        bits | bit(low + index).unwrap_or(0) << index
    })
}

/// Runs circuit and netlist side by side; returns the ticks that were compared.
fn hold(circuit: &dyn AnyModel, seed: u64) -> u64 {
    let (mut waves, mut stimulus, mut outputs) = (Vec::new(), Vec::new(), Vec::new());
    let drive = Drive {
        seed,
        ticks: TICKS,
        resets: true,
        bounded: false,
        clock: Clock::default(),
    };
    let driven = circuit.drive(&drive, &mut waves, &mut stimulus, &mut outputs);
    driven.unwrap();
    let [stimulus, outputs] = [stimulus, outputs].map(|text| String::from_utf8(text).unwrap());
    let verilog = circuit.verilog().unwrap();
    let design = verilog.design();
    let mut instance = Instance::new(design);
    let top = design.modules.last().unwrap();
    let inputs = top.signals.iter();
    let widths: Vec<usize> = inputs
        .filter(|signal| signal.role == Role::Input)
        .map(|signal| signal.shape.width)
        .collect();

    let mut parser = Parser::new(&waves[..]);
    let header = parser.parse_header().unwrap();
    let mut variables = HashMap::new();
    names(&header.items, &[], &mut variables);
    let clock = format!("{}_clk", circuit.name());
    let leaves = circuit.outline().leaves.len();
    let ports: Vec<(String, usize)> = top
        .outputs()
        .map(|port| {
            (
                format!("{}_{}", circuit.name(), port.name),
                port.shape.width,
            )
        })
        .collect();
    let mut lines = stimulus.lines().zip(outputs.lines());
    assert_eq!(outputs.lines().count() as u64, TICKS);
    let mut ticks = 0;
    let shown = instance.names(circuit.name());
    assert_eq!(shown.len(), leaves, "{}", circuit.name());
    let named: HashMap<_, usize> = shown.iter().zip(0..).collect();
    let places: HashMap<IdCode, (bool, Vec<usize>)> = variables
        .iter()
        .map(|(code, names)| {
            let shown = names.iter().filter_map(|name| named.get(name).copied());
            (*code, (names.contains(&clock), shown.collect()))
        })
        .collect();
    let mut golden = vec![None; leaves];
    let mut values = Vec::new();
    for command in parser {
        let (code, value) = match command.unwrap() {
            Command::ChangeScalar(code, value) => (code, u64::from(value == Value::V1)),
            Command::ChangeVector(code, vector) => {
                let bits = vector
                    .iter()
                    .fold(0, |bits, value| bits << 1 | u64::from(value == Value::V1));
                (code, bits)
            }
            _ => continue,
        };
        let (clocks, places) = &places[&code];
        for &place in places {
            golden[place] = Some(value);
        }
        // When the clock falls, everything of the tick has been said.
        if !clocks || value == 1 {
            continue;
        }
        let Some((line, outputs)) = lines.next() else {
            break;
        };
        let mut low = 0;
        let mut port = |width: usize| {
            low += width;
            bits(line, low - width, width)
        };
        let inputs = widths.iter().map(|width| port(*width)).collect();
        let reset = port(1) == 1;
        instance.settle(inputs);
        values.clear();
        instance.values(&mut values);
        for ((value, golden), name) in values.iter().zip(&golden).zip(&shown) {
            assert_eq!(golden.as_ref(), Some(value), "{name} in tick {ticks}");
        }
        let mut low = 0;
        for (name, width) in &ports {
            let expected = bits(outputs, low, *width);
            assert_eq!(values[named[name]], expected, "{name} in tick {ticks}");
            low += width;
        }
        instance.edge(reset);
        ticks += 1;
    }
    ticks
}

#[test]
fn every_netlist_runs_as_its_circuit() {
    // The large ones first, so that the last ones are short.
    let entries = CATALOGUE.par_iter().enumerate().rev().with_max_len(1);
    entries.for_each(|(seed, entry)| {
        for circuit in models(entry) {
            let ticks = hold(&*circuit, seed as u64);
            assert_eq!(ticks, TICKS, "{}", circuit.name());
        }
    });
}

#[test]
fn paths_are_joined_as_the_dump_joins_them() {
    for circuit in circuits() {
        let verilog = circuit.verilog().unwrap();
        let mut names = Instance::new(verilog.design()).names(circuit.name());
        let mut declared: Vec<String> = circuit.outline().leaves.iter().map(flat).collect();
        names.sort();
        declared.sort();
        assert_eq!(names, declared);
    }
}
