//! Circuits of no use that have what no circuit of the catalogue has.

mod memories;
mod names;
mod signed;
mod structure;
mod unsigned;

use super::ghdl;
use super::simulators::{hold, lint};
use super::tools::Simulator;
use memories::Memories;
use motion_rtl::registry::AnyModel;
use names::Outer;
use signed::SignedWords;
use structure::{Free, Tree};
use unsigned::UnsignedWords;

const TICKS: u64 = 10_000;

/// Holds a circuit against its Verilog in Icarus, and asks Verilator for its opinion;
/// returns how many ticks had a reset.
fn check(circuit: &dyn AnyModel, seed: u64) -> u64 {
    lint(circuit);
    hold(circuit, Simulator::Icarus, seed, TICKS)
}

/// Widths of words, of others, of products.
const WIDTHS: [(usize, usize, usize); 10] = [
    (1, 1, 2),
    (1, 3, 3),
    (2, 3, 5),
    (3, 2, 4),
    (31, 32, 63),
    (32, 31, 33),
    (33, 31, 64),
    (63, 1, 64),
    (64, 64, 64),
    (64, 3, 1),
];

#[test]
#[ignore = "needs Icarus Verilog and Verilator"]
fn signed_words() {
    for (n, k, p) in WIDTHS {
        check(&SignedWords { n, k, p }, n as u64);
    }
}

#[test]
#[ignore = "needs Icarus Verilog and Verilator"]
fn unsigned_words() {
    for (n, k, p) in WIDTHS {
        check(&UnsignedWords { n, k, p }, n as u64);
    }
}

#[test]
#[ignore = "needs Icarus Verilog and Verilator"]
fn memories_of_every_kind() {
    assert!(check(&Memories::new(3), 1) > 0);
}

#[test]
#[ignore = "needs Icarus Verilog and Verilator"]
fn a_circuit_without_inputs() {
    assert!(check(&Free, 1) > 0);
}

#[test]
#[ignore = "needs Icarus Verilog and Verilator"]
fn circuits_in_circuits() {
    assert!(check(&Tree::new(), 1) > 0);
    assert!(hold(&Tree::new(), Simulator::Verilator, 1, TICKS) > 0);
}

#[test]
#[ignore = "needs Verilator"]
fn wide_words_in_verilator() {
    let (n, k, p) = (33, 31, 64);
    hold(&SignedWords { n, k, p }, Simulator::Verilator, 3, TICKS);
    hold(&UnsignedWords { n, k, p }, Simulator::Verilator, 3, TICKS);
}

/// One tick of GHDL for so many of Icarus.
const SLOWER: u64 = 10;

#[test]
#[ignore = "needs GHDL"]
fn words_in_vhdl() {
    for (n, k, p) in WIDTHS {
        ghdl::hold(&SignedWords { n, k, p }, n as u64, TICKS / SLOWER);
        ghdl::hold(&UnsignedWords { n, k, p }, n as u64, TICKS / SLOWER);
    }
}

#[test]
#[ignore = "needs GHDL"]
fn memories_and_circuits_in_vhdl() {
    assert!(ghdl::hold(&Memories::new(3), 1, TICKS / SLOWER) > 0);
    assert!(ghdl::hold(&Free, 1, TICKS / SLOWER) > 0);
    assert!(ghdl::hold(&Tree::new(), 1, TICKS / SLOWER) > 0);
}

#[test]
#[ignore = "needs GHDL"]
fn names_that_vhdl_does_not_take() {
    assert!(ghdl::hold(&Outer, 1, TICKS / SLOWER) > 0);
}
