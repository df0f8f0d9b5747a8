//! The whole text of some circuits, for readers. `UPDATE_EXPECT=1 cargo test --release --test files vhdl`
//! writes it anew.

use expect_test::expect_file;
use motion_rtl::circuits::blocks::{EnableCounter, MulDiv};
use motion_rtl::circuits::pulse_interpolator::{Axis, PatternMemory, Variant};
use motion_rtl::sim::Described;
use motion_rtl::trace::Clock;
use motion_rtl::vhdl::Vhdl;

const COUNTER: EnableCounter = EnableCounter { width: 4 };

/// The sources of a circuit, one below the other, and its map.
fn text(circuit: &impl Described) -> String {
    let vhdl = Vhdl::new(circuit).unwrap();
    let sources = vhdl.sources().into_iter().chain([vhdl.names()]);
    let texts: Vec<String> = sources.map(|source| source.text).collect();
    texts.join("\n")
}

#[test]
fn a_counter() {
    expect_file!["enable_counter.vhd"].assert_eq(&text(&COUNTER));
}

#[test]
fn circuits_in_a_circuit() {
    let mut memory = PatternMemory::new(4, 2, 3);
    memory.contents.half_periods.set(1, 9);
    let axis = Axis {
        memory,
        variant: Variant::Safe,
    };
    expect_file!["axis.vhd"].assert_eq(&text(&axis));
}

#[test]
fn states_and_choices() {
    expect_file!["mul_div.vhd"].assert_eq(&text(&MulDiv::new(4, 6)));
}

#[test]
fn a_testbench() {
    let bench = Vhdl::new(&COUNTER).unwrap().testbench(Clock::default());
    expect_file!["enable_counter_tb.vhd"].assert_eq(&bench.unwrap().text);
}

#[test]
fn half_a_period_of_every_clock() {
    for (hz, half) in [
        (1, "500 ms"),
        (7, "71428571428571 fs"),
        (1_000_000, "500 ns"),
        (3_000_000, "166666667 fs"),
        (50_000_000, "10 ns"),
        (Clock::MAX_HZ, "1 fs"),
    ] {
        let clock = Clock::from_hz(hz).unwrap();
        let bench = Vhdl::new(&COUNTER).unwrap().testbench(clock).unwrap();
        let line = format!("constant HALF_PERIOD : time := {half};");
        assert!(bench.text.contains(&line), "{hz} Hz: {}", bench.text);
    }
}
