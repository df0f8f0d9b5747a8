//! The whole text of some circuits, for readers. `UPDATE_EXPECT=1 cargo test --release --test files verilog`
//! writes it anew.

use expect_test::expect_file;
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::circuits::pulse_interpolator::{AddressSequencer, Axis, PatternMemory, Variant};
use motion_rtl::hdl::Circuit;
use motion_rtl::verilog::Verilog;

const COUNTER: EnableCounter = EnableCounter { width: 4 };

/// The sources of a circuit, one below the other.
fn text(circuit: &impl Circuit) -> String {
    let sources = Verilog::of(circuit).unwrap().sources();
    let texts: Vec<String> = sources.into_iter().map(|source| source.text).collect();
    texts.join("\n")
}

#[test]
fn a_counter() {
    expect_file!["enable_counter.v"].assert_eq(&text(&COUNTER));
}

#[test]
fn a_sequencer() {
    expect_file!["address_sequencer.v"].assert_eq(&text(&AddressSequencer { width: 4 }));
}

#[test]
fn circuits_in_a_circuit() {
    let axis = Axis {
        memory: PatternMemory::new(4, 1, 0),
        variant: Variant::Safe,
    };
    expect_file!["axis.v"].assert_eq(&text(&axis));
}

#[test]
fn a_testbench() {
    let bench = Verilog::of(&COUNTER).unwrap().testbench().unwrap();
    expect_file!["enable_counter_tb.v"].assert_eq(&bench.text);
}
