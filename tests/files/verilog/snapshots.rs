//! The whole text of some circuits, for readers. `UPDATE_EXPECT=1 cargo test --release --test files verilog`
//! writes it anew.

use expect_test::expect_file;
use motion_rtl::circuits::blocks::EnableCounter;
use motion_rtl::circuits::pulse_interpolator::{AddressSequencer, Axis, PatternMemory, Variant};
use motion_rtl::prelude::*;
use motion_rtl::trace::Clock;
use motion_rtl::verilog::Verilog;

const COUNTER: EnableCounter = EnableCounter { width: 4 };

/// How far an input moves.
#[derive(Debug, Clone)]
struct Distance;

signals! { for Distance as _c;
    /// Ports in.
    pub struct In {
        /// A position.
        pub position: I(4),
    }
    /// Registers.
    pub struct Reg {
        /// The position a tick ago.
        pub old: I(4) = 0,
        /// By how much it moved.
        pub moved: I(5) = 0,
    }
}

impl Circuit for Distance {
    const NAME: &'static str = "distance";
    const ABOUT: &'static str = "how far a position moves in a tick";
    records!(In, Reg, Nothing);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Nothing, Reg<Edge>) {
        let next = Reg {
            old: i.position,
            moved: i.position.minus(q.old),
        };
        (Nothing, next)
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let (position, old) = (now.i.position, now.q.old);
        let moved = now.next.q.moved;
        // The same modulo 16.
        let wrapped = (position - old).unsigned();
        vec![
            Property::step(
                "from where it was to where it is",
                &["moved"],
                (old.resize(5) + moved).equals(position.resize(5)),
            ),
            Property::step(
                "a part of a difference is that of the exact one",
                &["moved"],
                wrapped.slice(1, 3).equals(moved.unsigned().slice(1, 3)),
            ),
        ]
    }
}

/// The sources of a circuit, one below the other.
fn text(circuit: &impl Circuit) -> String {
    let sources = Verilog::new(circuit).unwrap().sources();
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

/// Verilog takes no part of `$past`.
#[test]
fn parts_of_words_of_before_in_an_assertion() {
    expect_file!["distance.v"].assert_eq(&text(&Distance));
}

#[test]
fn a_testbench() {
    let bench = Verilog::new(&COUNTER)
        .unwrap()
        .testbench(Clock::default())
        .unwrap();
    expect_file!["enable_counter_tb.v"].assert_eq(&bench.text);
}
