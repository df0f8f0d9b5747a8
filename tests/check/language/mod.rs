//! All mistakes of a circuit are reported at once, with file, line and column.

use expect_test::{Expect, expect};
use motion_rtl::hdl::elaborate;
use motion_rtl::prelude::*;
use motion_rtl::sim::Beside;

/// Compares the mistakes of a circuit; lines are counted from `from`.
fn mistakes<C: Circuit>(circuit: &C, from: u32, expected: &Expect) {
    let wrong = elaborate(circuit).expect_err("something is wrong");
    let mut text = String::new();
    for mut mistake in wrong.0 {
        let (_, file) = mistake.site.file.rsplit_once('/').expect("a path");
        mistake.site.file = file;
        mistake.site.line = mistake.site.line.wrapping_sub(from);
        text += &format!("{mistake}\n");
    }
    expected.assert_eq(&text);
}

/// Load that moves beside a circuit.
#[derive(Clone)]
struct Load;

signals! { for Load as _c;
    /// Signals of the load.
    pub struct LoadSignals {
        /// Position.
        position: I(8),
    }
}

impl Beside for Load {
    const SCOPE: &'static str = "load";
    type Signals<V: View> = LoadSignals<V>;
}

/// A counter with a mistake of choice.
#[derive(Debug, Clone)]
pub struct Counter {
    width: usize,
    other: usize,
}

const COUNTER: u32 = line!();
signals! { for Counter as c;
    /// Ports in.
    pub struct In {
        /// Summand.
        by: U(c.other),
    }
    /// Registers.
    pub struct Reg {
        /// The sum.
        pub sum: U(c.width) = 3,
    }
    /// Nets.
    pub struct Net {
        /// The sum after this tick.
        pub next: U(c.width),
        /// A net that is no port.
        hidden: U(c.width),
    }
}

impl Circuit for Counter {
    const NAME: &'static str = "counter";
    const ABOUT: &'static str = "adds up";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let next = q.sum + i.by;
        let hidden = !next;
        (Net { next, hidden }, Reg { sum: next })
    }
}

/// Circuit with a duplicate name.
#[derive(Debug, Clone)]
struct Twice;

const TWICE: u32 = line!();
signals! { for Twice as _c;
    /// Ports in.
    pub struct TwiceIn {
        /// A bit.
        a: Bit,
    }
    /// Nets.
    pub struct TwiceNet {
        /// Its inverse.
        pub a: Bit,
    }
}

impl Circuit for Twice {
    const NAME: &'static str = "twice";
    const ABOUT: &'static str = "has two signals of one name";
    records!(TwiceIn, Nothing, TwiceNet);

    fn tick(&self, i: TwiceIn, _: Nothing, _: Nothing) -> (TwiceNet, Nothing) {
        (TwiceNet { a: !i.a }, Nothing)
    }
}

/// Circuit with a counter inside, and one fault of choice.
#[derive(Debug, Clone)]
pub struct Around {
    counter: Counter,
    fault: Fault,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault {
    None,
    Unsettled,
    Port,
    Net,
    Register,
    Swapped,
    Unmade,
    Hidden,
    Slice,
    Fields,
}

const AROUND: u32 = line!();
signals! { for Around as c;
    /// Ports in.
    pub struct AroundIn {
        /// Summand.
        by: U(4),
    }
    /// Registers.
    pub struct AroundReg {
        /// Latest word.
        last: U(4),
        /// One memory.
        one: Ram(2, 4),
        /// Another.
        other: Ram(2, 4),
    }
    /// The circuit inside.
    pub struct AroundParts {
        /// Counter.
        pub counter: Part<Counter>(c.counter.clone()),
    }
    /// Nets.
    pub struct AroundNet {
        /// The sum.
        pub sum: U(4),
        /// A word of each memory.
        pub words: [U(4); 2],
    }
}

impl Circuit for Around {
    const NAME: &'static str = "around";
    const ABOUT: &'static str = "a counter within";
    records!(AroundIn, AroundReg, AroundNet, AroundParts);

    fn objection(&self) -> Option<String> {
        (self.fault == Fault::Fields).then(|| "these fields do not go together".into())
    }

    fn tick(&self, i: AroundIn, q: AroundReg, p: AroundParts) -> (AroundNet, AroundReg<Edge>) {
        let address = q.last.slice(0, 2);
        let words = vec![q.one.read(address), q.other.read(address)];
        let words = match self.fault {
            Fault::Unmade => words[..1].to_vec(),
            _ => words,
        };
        let before = p.counter.q.sum;
        let next = match self.fault {
            Fault::Unsettled => before,
            Fault::Port => {
                p.counter
                    .settle(In {
                        by: i.by.slice(0, 3),
                    })
                    .w
                    .next
            }
            Fault::Hidden => p.counter.settle(In { by: i.by }).w.hidden,
            _ => p.counter.settle(In { by: i.by }).w.next,
        };
        let sum = match self.fault {
            Fault::Net => next.plus(i.by),
            Fault::Slice => next.slice(2, 4),
            _ => next,
        };
        let high = Bit::high();
        let (one, other) = (
            q.one.write(high, address, i.by),
            q.other.write(high, address, i.by),
        );
        let (one, other) = match self.fault {
            Fault::Swapped => (other, one),
            _ => (one, other),
        };
        let last = match self.fault {
            Fault::Register => next.bit(0).word(),
            _ => next,
        };
        (AroundNet { sum, words }, AroundReg { last, one, other })
    }
}

/// Circuit whose names collide with names that Verilog derives, and with a name inside its part.
#[derive(Debug, Clone)]
struct Made;

const MADE: u32 = line!();
signals! { for Made as _c;
    /// Registers.
    pub struct MadeReg {
        /// Delay line.
        line: Shift(2, 4),
        /// A memory.
        store: Ram(2, 4),
        /// A port out.
        pub held: Bit,
    }
    /// The circuits inside.
    pub struct MadeParts {
        /// Part with the name of one of its ports.
        pub sum: Part<Counter>(Counter { width: 4, other: 4 }),
    }
    /// Nets.
    pub struct MadeNet {
        /// Port with the name that Verilog derives.
        sum_next: U(4),
        /// Another such port.
        sum_sum: U(4),
        /// Names of loops over words, of their wires, of a file, and of a port's register.
        loops: [Bit; 7] as Elements(&[
            "line_shift", "line_to", "store_word", "STORE", "store_at", "line_words", "held_reg",
        ]),
        /// Name of words that nobody declares.
        rom: U(4),
    }
}

impl Circuit for Made {
    const NAME: &'static str = "made";
    const ABOUT: &'static str = "has names that Verilog takes besides";
    records!(Nothing, MadeReg, MadeNet, MadeParts);

    fn tick(&self, _: Nothing, q: MadeReg, p: MadeParts) -> (MadeNet, MadeReg<Edge>) {
        let by = U::parameter("at", 1, 4) + U::parameter("at", 2, 5).resize(4);
        let counter = p.sum.settle(In { by });
        let net = MadeNet {
            sum_next: counter.w.next,
            sum_sum: counter.w.next,
            loops: vec![Bit::low(); 7],
            rom: Image::from_fn(4, 4, |word| word as u64).rom(by),
        };
        let (line, store) = (q.line.shift(Bit::high(), by), q.store.keep());
        let held = q.held;
        (net, MadeReg { line, store, held })
    }
}

fn around(fault: Fault) -> Around {
    Around {
        counter: Counter { width: 4, other: 4 },
        fault,
    }
}

#[test]
fn nothing_is_wrong() {
    elaborate(&Counter { width: 4, other: 4 }).unwrap();
    elaborate(&around(Fault::None)).unwrap();
}

#[test]
fn operands_have_one_width() {
    let circuit = Counter { width: 4, other: 5 };
    mistakes(
        &circuit,
        COUNTER,
        &expect![[r#"
        mod.rs:27:20: counter: sum of `sum` (4 bits) and `by` (5 bits)
    "#]],
    );
}

#[test]
fn mistakes_of_a_part_come_with_those_around_it() {
    let mut circuit = around(Fault::Net);
    circuit.counter.other = 5;
    mistakes(
        &circuit,
        COUNTER,
        &expect![[r#"
            mod.rs:140:28: around: port `counter.by` has 5 bits, `by` has 4 bits
            mod.rs:27:20: around.counter: sum of `sum` (4 bits) and `by` (5 bits)
            mod.rs:143:32: around: net `sum` has 4 bits, a sum has 5 bits
            mod.rs:140:28: around: `counter` is Counter { width: 4, other: 5 }
        "#]],
    );
}

#[test]
fn a_word_has_1_to_64_bits() {
    let circuit = Counter {
        width: 0,
        other: 65,
    };
    mistakes(
        &circuit,
        COUNTER,
        &expect![[r#"
        mod.rs:1:1: counter: `by` has 65 bits; a word has 1 to 64
        mod.rs:1:1: counter: `sum` has 0 bits; a word has 1 to 64
    "#]],
    );
}

#[test]
fn a_part_is_settled() {
    mistakes(
        &around(Fault::Unsettled),
        AROUND,
        &expect![[r#"
        mod.rs:1:1: around: part `counter` is never settled
    "#]],
    );
}

#[test]
fn ports_nets_and_registers_have_their_widths() {
    mistakes(
        &around(Fault::Port),
        AROUND,
        &expect![[r#"
            mod.rs:51:22: around: port `counter.by` has 4 bits, a slice of `by` has 3 bits
            mod.rs:51:22: around: `counter` is Counter { width: 4, other: 4 }
        "#]],
    );
    mistakes(
        &around(Fault::Net),
        AROUND,
        &expect![[r#"
        mod.rs:61:32: around: net `sum` has 4 bits, a sum has 5 bits
    "#]],
    );
    mistakes(
        &around(Fault::Register),
        AROUND,
        &expect![[r#"
            mod.rs:75:44: around: register `last` has 4 bits, bit 0 of `counter.next` has 1 bit
            mod.rs:58:28: around: `counter` is Counter { width: 4, other: 4 }
        "#]],
    );
}

#[test]
fn a_memory_becomes_what_was_made_of_it() {
    mistakes(
        &around(Fault::Swapped),
        AROUND,
        &expect![[r#"
        mod.rs:1:1: around: memory `one` becomes what was made of `other`
        mod.rs:1:1: around: memory `other` becomes what was made of `one`
    "#]],
    );
}

#[test]
fn arrays_have_their_length() {
    mistakes(
        &around(Fault::Unmade),
        AROUND,
        &expect![[r#"
        mod.rs:1:1: around: net `words1` is given nothing
    "#]],
    );
}

#[test]
fn slices_are_within_the_word() {
    mistakes(
        &around(Fault::Slice),
        AROUND,
        &expect![[r#"
            mod.rs:62:34: around: bits 5 down to 2 of `counter.next`, which has 4 bits
            mod.rs:58:28: around: `counter` is Counter { width: 4, other: 4 }
        "#]],
    );
}

#[test]
fn fields_go_together() {
    mistakes(
        &around(Fault::Fields),
        AROUND,
        &expect![[r#"
        mod.rs:1:1: around: these fields do not go together
    "#]],
    );
}

#[test]
fn what_is_no_port_is_not_read() {
    mistakes(
        &around(Fault::Hidden),
        AROUND,
        &expect![[r#"
        mod.rs:57:40: around: `counter.hidden` is read, but is no port: it is not declared pub
    "#]],
    );
}

#[test]
fn a_name_stands_once() {
    mistakes(
        &Twice,
        TWICE,
        &expect![[r#"
        mod.rs:1:1: twice: the name `a` is used twice
    "#]],
    );
}

#[test]
fn what_verilog_makes_stands_once() {
    mistakes(
        &Made,
        MADE,
        &expect![[r#"
        mod.rs:1:1: made: the name `AT` is used twice: Verilog makes it of `at` (4 bits) and of `at` (5 bits)
        mod.rs:1:1: made: the name `STORE` is used twice: Verilog makes it of `store`
        mod.rs:1:1: made: the name `held_reg` is used twice: Verilog makes it of `held`
        mod.rs:1:1: made: the name `line_shift` is used twice: Verilog makes it of `line`
        mod.rs:1:1: made: the name `line_to` is used twice: Verilog makes it of `line`
        mod.rs:1:1: made: the name `line_words` is used twice: Verilog makes it of `line`
        mod.rs:1:1: made: the name `rom` is used twice: Verilog makes it of a ROM
        mod.rs:1:1: made: the name `store_at` is used twice: Verilog makes it of `store`
        mod.rs:1:1: made: the name `store_word` is used twice: Verilog makes it of `store`
        mod.rs:1:1: made: the name `sum_sum` is used twice: Verilog makes it of `sum.sum`
        mod.rs:38:29: made: part `sum` has the name of a signal of `counter`, inside it
    "#]],
    );
}

#[test]
fn a_panic_of_the_circuits_own_code_is_told() {
    #[derive(Debug, Clone)]
    struct Panics;

    impl Circuit for Panics {
        const NAME: &'static str = "panics";
        const ABOUT: &'static str = "gives up";
        records!(Nothing, Nothing, Nothing);

        fn tick(&self, _: Nothing, _: Nothing, _: Nothing) -> (Nothing, Nothing) {
            let none: [usize; 0] = [];
            let first = none.first().copied();
            (Nothing, first.map(|_| Nothing).expect("a first"))
        }
    }
    let wrong = elaborate(&Panics).unwrap_err().to_string();
    assert!(
        wrong.ends_with(": panics: its code panics: a first"),
        "{wrong}"
    );
    elaborate(&Counter { width: 4, other: 4 }).unwrap();
}

mod constants;
mod described;
mod inputs;
mod optional;
mod running;
