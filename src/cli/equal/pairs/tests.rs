//! Tests of pairing, and netlists for tests.

use super::*;
use motion_rtl::Model;

/// Returns a design clocked by `clk`: `i` is an input, `o` an output, `r` a register, `w` a net.
pub fn design(nets: &[(&str, usize, char)]) -> Netlist {
    let (mut ports, mut cells, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let mut bit = 2;
    for (name, width, kind) in [("clk", 1, 'i')].iter().chain(nets) {
        let bits: Vec<String> = (bit..bit + width).map(|bit| bit.to_string()).collect();
        let bits = format!("[{}]", bits.join(","));
        bit += width;
        let direction = match kind {
            'i' => "input",
            'o' => "output",
            _ => "",
        };
        if !direction.is_empty() {
            ports.push(format!(
                r#""{name}": {{"direction": "{direction}", "bits": {bits}}}"#
            ));
        }
        if *kind == 'r' {
            cells.push(format!(
                r#""{name}": {{"type": "$dff", "parameters": {{"CLK_POLARITY": "1"}},
                "connections": {{"CLK": [2], "Q": {bits}}}}}"#
            ));
        }
        names.push(format!(r#""{name}": {{"hide_name": 0, "bits": {bits}}}"#));
    }
    let text = format!(
        r#"{{"modules": {{"design": {{"ports": {{{}}}, "cells": {{{}}}, "netnames": {{{}}}}}}}}}"#,
        ports.join(","),
        cells.join(","),
        names.join(",")
    );
    Netlist::read(&text, "design", "clk").unwrap()
}

/// Returns a circuit's own netlist, as far as pairs need it.
pub fn golden(signals: &[SignalInfo]) -> Netlist {
    let nets: Vec<(&str, usize, char)> = signals
        .iter()
        .map(|signal| {
            let kind = match (signal.port, signal.role) {
                (Some(PortDirection::In), _) => 'i',
                (Some(PortDirection::Out), _) => 'o',
                (None, Role::Register) => 'r',
                (None, _) => 'w',
            };
            (&*signal.verilog, signal.width(), kind)
        })
        .collect();
    design(&nets)
}

/// Pairs a circuit with a design; returns lines of `path = [!]net[low+width]` and the paths of
/// ports without partner.
fn pairs(
    circuit: &str,
    keys: &[&str],
    nets: &[(&str, usize, char)],
    map: &str,
) -> Result<(Vec<String>, Vec<String>), String> {
    let keys: Vec<_> = keys.iter().map(|key| key.parse().unwrap()).collect();
    let signals = Model::new(circuit, &keys).unwrap().signals();
    let map = Map::parse("m.toml", map).unwrap();
    let sides = Sides {
        circuit,
        signals: &signals,
        golden: &golden(&signals),
        design: &design(nets),
        reserved: [Some("clk"), Some("rst")],
        map: &map,
    };
    let pairs = sides.pairs().map_err(|fault| fault.to_string())?;
    let line = |pair: &Pair| {
        let Part {
            net,
            low,
            width,
            invert,
        } = &pair.part;
        let invert = if *invert { "!" } else { "" };
        format!(
            "{} = {invert}{net}[{low}+{width}]",
            signals[pair.signal].path
        )
    };
    let lines = pairs.inputs.iter().chain(&pairs.held).map(line).collect();
    let path = |index: &usize| {
        let path = &signals[*index].path;
        let mut others = pairs.other_widths.iter();
        match others.find(|pair| pair.signal == *index) {
            Some(pair) => format!("{path}, not of {}", bits(pair.part.width)),
            None => path.clone(),
        }
    };
    Ok((lines, pairs.ports_without.iter().map(path).collect()))
}

#[test]
fn registers_and_ports_pair_by_name_and_width() {
    let nets = [
        ("rst", 1, 'i'),
        ("half_period", 4, 'i'),
        ("Period", 4, 'i'),
        ("step", 1, 'o'),
        ("counter_count", 4, 'r'),
        // Another width, and no register.
        ("held_period", 5, 'r'),
        ("generator.count", 4, 'w'),
    ];
    let (lines, without) = pairs("unit_law", &["width=4"], &nets, "").unwrap();
    let expected = [
        "half_period = half_period[0+4]",
        "period = Period[0+4]",
        "counter.count = counter_count[0+4]",
        "step = step[0+1]",
    ];
    assert_eq!(lines, expected);
    assert!(without.is_empty());
    // A port of another width is no partner, unlike one of the width with a name as good.
    let nets = [
        ("half_period", 5, 'i'),
        ("period", 5, 'i'),
        ("Period", 4, 'i'),
    ];
    let (lines, without) = pairs("unit_law", &["width=4"], &nets, "").unwrap();
    assert_eq!(lines, ["period = Period[0+4]"]);
    assert_eq!(without, ["half_period, not of 5 bits", "step"]);
    // A net is no port, and the reset is no partner.
    let nets = [("rst", 1, 'i'), ("period", 4, 'w'), ("step", 1, 'w')];
    let (lines, without) = pairs("unit_law", &["width=4"], &nets, "").unwrap();
    assert_eq!(lines, ["step = step[0+1]"]);
    assert_eq!(without, ["half_period", "period"]);
}

#[test]
fn two_registers_of_one_name_pair_with_none_unless_one_is_exact() {
    let mut nets = vec![
        ("half_period", 4, 'i'),
        ("period", 4, 'i'),
        ("step", 1, 'o'),
        ("counter_count", 4, 'r'),
        ("COUNTER.count", 4, 'r'),
    ];
    let ambiguous = pairs("unit_law", &["width=4"], &nets, "").unwrap().0;
    assert_eq!(ambiguous.len(), 3);
    nets.push(("counter.count", 4, 'r'));
    let exact = pairs("unit_law", &["width=4"], &nets, "").unwrap().0;
    assert!(exact.contains(&"counter.count = counter.count[0+4]".to_owned()));
}

const BENCH: [(&str, usize, char); 5] = [
    ("bus", 8, 'i'),
    ("line_n", 1, 'o'),
    ("u_timer.cnt", 4, 'r'),
    ("u_edges.cnt", 4, 'r'),
    ("u_edges.count", 4, 'r'),
];

const MAP: &str = "\
    [scopes]\n\"unit_law.generator\" = \"tb.dut.u_edges\"\n[signals]\n\
    \"unit_law.half_period\" = \"tb.dut.bus[7:4]\"\n\"unit_law.period\" = \"bus[3:0]\"\n\
    \"unit_law.step\" = \"!tb.dut.line_n\"\n\"counter.count\" = \"tb.dut.u_timer.cnt\"\n";

#[test]
fn a_map_pairs_parts_inverted_signals_and_scopes() {
    let (lines, without) = pairs("unit_law", &["width=4"], &BENCH, MAP).unwrap();
    let expected = [
        "half_period = bus[4+4]",
        "period = bus[0+4]",
        "counter.count = u_timer.cnt[0+4]",
        "generator.count = u_edges.count[0+4]",
        "step = !line_n[0+1]",
    ];
    assert_eq!(lines, expected);
    assert!(without.is_empty());
    let left = MAP.replace("[scopes]", "leave = [\"unit_law.period\"]\n[scopes]");
    let left = left.replace("\"unit_law.period\" = \"bus[3:0]\"\n", "");
    let (lines, without) = pairs("unit_law", &["width=4"], &BENCH, &left).unwrap();
    assert_eq!((lines.len(), without.len()), (4, 0));
}

#[test]
fn wrong_lines_of_a_map_are_refused() {
    let refusal = |from: &str, to: &str| {
        assert!(MAP.contains(from), "{from}");
        pairs("unit_law", &["width=4"], &BENCH, &MAP.replace(from, to)).unwrap_err()
    };
    assert_eq!(
        refusal("tb.dut.bus[7:4]", "tb.dut.bus[7:3]"),
        "m.toml:4: unit_law.half_period: tb.dut.bus[7:3] has 5 bits; allowed: 4 bits, as \
         half_period has"
    );
    assert_eq!(
        refusal("tb.dut.bus[7:4]", "tb.dut.bus[8:5]"),
        "m.toml:4: unit_law.half_period: tb.dut.bus[8:5] is no part of the signal; allowed: 8 \
         bits of bus"
    );
    assert_eq!(
        refusal("tb.dut.bus[7:4]", "u_timer.cnt"),
        "m.toml:4: unit_law.half_period: u_timer.cnt is no input port of the design; allowed: \
         bus, clk"
    );
    assert_eq!(
        refusal("\"tb.dut.u_timer.cnt\"", "\"cnt\""),
        "m.toml:7: counter.count: cnt is the end of several names; allowed: u_edges.cnt, \
         u_timer.cnt"
    );
    assert_eq!(
        refusal("tb.dut.u_edges", "tb.dut.u_none"),
        "m.toml:2: unit_law.generator: no scope of the design is called tb.dut.u_none; allowed: \
         u_edges, u_timer"
    );
    let unknown = refusal("unit_law.step", "unit_law.stp");
    let start = "m.toml:6: unit_law.stp: no signal of unit_law is called so; allowed: a signal";
    assert!(unknown.starts_with(start), "{unknown}");
}

#[test]
fn a_line_for_a_memory_pairs_its_words() {
    let nets = [
        ("store[0]", 4, 'r'),
        ("store[1]", 4, 'r'),
        ("store[2]", 4, 'r'),
    ];
    let map = "[signals]\n\"record_memory.records[1]\" = \"store[2]\"\n";
    let keys = ["data=4", "record=1"];
    let (lines, _) = pairs("record_memory", &keys, &nets, map).unwrap();
    assert_eq!(lines, ["records[1] = store[2][0+4]"]);
    // The design has three of the words.
    let map = "[signals]\n\"record_memory.records\" = \"dut.store\"\n";
    let refusal = pairs("record_memory", &keys, &nets, map).unwrap_err();
    assert!(
        refusal.contains("no signal of the design is called dut.store"),
        "{refusal}"
    );
}
