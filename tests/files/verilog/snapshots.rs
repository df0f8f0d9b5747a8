//! The whole text of some circuits, for readers. `UPDATE_EXPECT=1 cargo test --release --test files verilog`
//! writes it anew.

use expect_test::expect_file;
use motion_rtl::registry::find;

/// The sources of a circuit, one below the other.
fn text(name: &str, arguments: &[u64]) -> String {
    let circuit = (find(name).unwrap().model)(arguments).unwrap();
    let sources = circuit.verilog().unwrap().sources();
    let texts: Vec<String> = sources.into_iter().map(|source| source.text).collect();
    texts.join("\n")
}

#[test]
fn a_counter() {
    expect_file!["unit_time_counter.v"].assert_eq(&text("unit_time_counter", &[4]));
}

#[test]
fn a_sequencer() {
    expect_file!["address_sequencer.v"].assert_eq(&text("address_sequencer", &[4]));
}

#[test]
fn circuits_in_a_circuit() {
    expect_file!["axis.v"].assert_eq(&text("axis", &[4]));
}

#[test]
fn a_testbench() {
    let circuit = (find("unit_time_counter").unwrap().model)(&[4]).unwrap();
    let bench = circuit.verilog().unwrap().testbench().unwrap();
    expect_file!["unit_time_counter_tb.v"].assert_eq(&bench.text);
}
