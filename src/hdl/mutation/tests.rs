//! Faults of a circuit as they are listed, and their places in its netlist.

use super::{Change, Mutation, Place, mutated, mutations};
use crate::hdl::*;
use expect_test::expect;

/// Adds up its input to a limit, and starts again at `clear`.
#[derive(Debug, Clone)]
pub(crate) struct Sum {
    pub width: usize,
}

signals! { for Sum as c;
    /// Ports in.
    pub struct In {
        /// Starts the sum again.
        clear: Bit,
        /// Adds `by`.
        add: Bit,
        /// Summand.
        by: I(c.width),
        /// Greatest sum.
        limit: I(c.width),
    }
    /// Registers.
    pub struct Reg {
        /// The sum.
        pub sum: I(c.width) = 2,
    }
    /// Nets.
    pub struct Net {
        /// High if the sum would pass the limit.
        pub over: Bit,
    }
}

impl Circuit for Sum {
    const NAME: &'static str = "adder";
    const ABOUT: &'static str = "adds up to a limit";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = q.sum.plus(i.by);
        let over = i.limit.below_any(next);
        let added = over.mux(i.limit, next.resize(self.width));
        let sum = i.clear.mux(2, i.add.mux(added, q.sum));
        (Net { over }, Reg { sum })
    }

    fn properties(&self, now: &Moment<Self>) -> Vec<Property> {
        let next = now.q.sum.plus(now.i.by);
        let over = now.i.limit.below_any(next);
        vec![Property::always(
            "over says so",
            &["over"],
            !(now.w.over ^ over),
        )]
    }
}

pub(crate) fn all(circuit: &Sum) -> Vec<Mutation> {
    mutations("adder", || elaborate(circuit)).1
}

#[test]
fn every_fault_of_a_circuit_is_listed() {
    let faults = all(&Sum { width: 4 });
    let faults: Vec<_> = faults.iter().map(short).collect();
    expect![[r#"
        43:26: extension: left out
        43:26: extension 2: left out
        43:26: sum: another operator
        44:28: extension: left out
        44:28: below: another operator
        44:28: below: operands exchanged
        45:44: slice: one bit more
        45:26: choice: always the first
        45:26: choice: always the second
        46:40: choice: always the first
        46:40: choice: always the second
        46:27: choice: always the first
        46:27: choice: always the second
        46:27: choice: the next choice comes first
        46:27: choice: constant 1 one more
        46:27: choice: constant 1 one less
        sum: another value at power-on
        over: low
    "#]]
    .assert_eq(&(faults.join("\n") + "\n"));
}

/// Returns the text of a fault without its file.
fn short(fault: &Mutation) -> String {
    let text = fault.to_string();
    text.replace("src/hdl/mutation/tests.rs:", "")
}

#[test]
fn a_fault_is_the_same_one_at_another_width() {
    let (narrow, wide) = (Sum { width: 4 }, Sum { width: 9 });
    assert_eq!(all(&narrow), all(&wide));
    for fault in all(&narrow) {
        let made = mutated(&fault, || elaborate(&wide)).expect("it has a place");
        assert_ne!(made, elaborate(&wide));
    }
}

#[test]
fn without_a_fault_a_circuit_is_as_before() {
    let sum = Sum { width: 4 };
    let before = elaborate(&sum).unwrap();
    for fault in all(&sum) {
        let _ = mutated(&fault, || elaborate(&sum));
        assert_eq!(elaborate(&sum).unwrap(), before);
    }
    let other = Mutation {
        circuit: "adder".to_owned(),
        place: Place::Signal("over".to_owned()),
        change: Change::PowerOn,
    };
    assert!(
        mutated(&other, || elaborate(&sum)).is_none(),
        "a net has no power-on"
    );
    let elsewhere = Mutation {
        circuit: "difference".to_owned(),
        ..all(&sum)[0].clone()
    };
    assert!(mutated(&elsewhere, || elaborate(&sum)).is_none());
}

/// Compares bit 1 of each of two words.
#[derive(Debug, Clone)]
pub(crate) struct Bits {
    widths: [usize; 2],
}

signals! { for Bits as c;
    /// Ports in.
    pub struct BitsIn {
        /// First word.
        a: U(c.widths[0]),
        /// Second word.
        b: U(c.widths[1]),
    }
    /// Nets.
    pub struct BitsNet {
        /// High if both bits are equal.
        pub same: Bit,
    }
}

impl Circuit for Bits {
    const NAME: &'static str = "bits";
    const ABOUT: &'static str = "compares bit 1 of each of two words";
    records!(BitsIn, Nothing, BitsNet);

    fn tick(&self, i: BitsIn, _: Nothing, _: Nothing) -> (BitsNet, Nothing) {
        let same = i.a.slice(1, 1).equals(i.b.slice(1, 1));
        (BitsNet { same }, Nothing)
    }
}

/// Passes its words on to a part.
#[derive(Debug, Clone)]
pub(crate) struct Around {
    widths: [usize; 2],
}

signals! { for Around as c;
    /// Ports in.
    pub struct AroundIn {
        /// First word.
        a: U(c.widths[0]),
        /// Second word.
        b: U(c.widths[1]),
    }
    /// Circuits inside.
    pub struct AroundParts {
        /// The comparison.
        pub bits: Part<Bits>(Bits { widths: c.widths }),
    }
    /// Nets.
    pub struct AroundNet {
        /// High if both bits are equal.
        pub same: Bit,
    }
}

impl Circuit for Around {
    const NAME: &'static str = "around";
    const ABOUT: &'static str = "passes its words on to a part";
    records!(AroundIn, Nothing, AroundNet, AroundParts);

    fn tick(&self, i: AroundIn, _: Nothing, p: AroundParts) -> (AroundNet, Nothing) {
        let same = p.bits.settle(BitsIn { a: i.a, b: i.b }).w.same;
        (AroundNet { same }, Nothing)
    }
}

#[test]
fn a_fault_has_no_place_where_widths_forbid_it() {
    let circuit = |a, b| Around { widths: [a, b] };
    for (name, end, forbidden) in [
        ("around", "bits.a: crossed with the next one", [4, 5]),
        ("bits", "slice: one bit more", [2, 3]),
    ] {
        let all = mutations(name, || elaborate(&circuit(4, 4))).1;
        let mut faults = all.iter().filter(|it| it.to_string().ends_with(end));
        let fault = faults.next().expect("it is possible with these widths");
        assert!(mutated(fault, || elaborate(&circuit(5, 5))).is_some());
        let [a, b] = forbidden;
        let made = mutated(fault, || elaborate(&circuit(a, b)));
        assert!(made.is_none(), "{fault}");
    }
}
