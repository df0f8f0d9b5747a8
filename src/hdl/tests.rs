//! What is wrong with a circuit is told all at once, with file, line and column.

use super::prelude::*;
use super::{At, Beside, Nothing, elaborate};
use crate::check::{Law, Lockstep, Pair, sweep};
use expect_test::{Expect, expect};

/// The mistakes of a circuit, lines counted from that of `from`.
fn mistakes<C: Circuit>(circuit: &C, from: u32, expected: &Expect) {
    let wrong = elaborate(circuit).expect_err("something is wrong");
    let mut text = String::new();
    for mut mistake in wrong.0 {
        assert_eq!(mistake.site.file, file!());
        mistake.site.file = "tests.rs";
        mistake.site.line = mistake.site.line.wrapping_sub(from);
        text += &format!("{mistake}\n");
    }
    expected.assert_eq(&text);
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
        /// Added.
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
        /// Nobody else's concern.
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

/// A name that stands twice.
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

/// A counter within, and what else can be wrong.
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
        /// Added.
        by: U(4),
    }
    /// Registers.
    pub struct AroundReg {
        /// Seen last.
        last: U(4),
        /// One memory.
        one: Ram(2, 4),
        /// Another.
        other: Ram(2, 4),
    }
    /// The circuit inside.
    pub struct AroundParts {
        /// It.
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
        tests.rs:27:20: counter: sum of `sum` (4 bits) and `by` (5 bits)
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
        tests.rs:140:28: around: port `by` has 5 bits, `by` has 4 bits
        tests.rs:27:20: around.counter: sum of `sum` (4 bits) and `by` (5 bits)
        tests.rs:143:32: around: net `sum` has 4 bits, a sum has 5 bits
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
        tests.rs:1:1: counter: `by` has 65 bits; a word has 1 to 64
        tests.rs:1:1: counter: `sum` has 0 bits; a word has 1 to 64
    "#]],
    );
}

#[test]
fn a_part_is_settled() {
    mistakes(
        &around(Fault::Unsettled),
        AROUND,
        &expect![[r#"
        tests.rs:1:1: around: part `counter` is never settled
    "#]],
    );
}

#[test]
fn ports_nets_and_registers_have_their_widths() {
    mistakes(
        &around(Fault::Port),
        AROUND,
        &expect![[r#"
        tests.rs:51:22: around: port `by` has 4 bits, an operand has 3 bits
    "#]],
    );
    mistakes(
        &around(Fault::Net),
        AROUND,
        &expect![[r#"
        tests.rs:61:32: around: net `sum` has 4 bits, a sum has 5 bits
    "#]],
    );
    mistakes(
        &around(Fault::Register),
        AROUND,
        &expect![[r#"
        tests.rs:75:44: around: register `last` has 4 bits, an operand has 1 bit
    "#]],
    );
}

#[test]
fn a_memory_becomes_what_was_made_of_it() {
    mistakes(
        &around(Fault::Swapped),
        AROUND,
        &expect![[r#"
        tests.rs:1:1: around: memory `one` becomes what was made of `other`
        tests.rs:1:1: around: memory `other` becomes what was made of `one`
    "#]],
    );
}

#[test]
fn arrays_have_their_length() {
    mistakes(
        &around(Fault::Unmade),
        AROUND,
        &expect![[r#"
        tests.rs:1:1: around: net `words1` is given nothing
    "#]],
    );
}

#[test]
fn slices_are_within_the_word() {
    mistakes(
        &around(Fault::Slice),
        AROUND,
        &expect![[r#"
        tests.rs:62:34: around: bits 5 down to 2 of a port of `counter`, which has 4 bits
    "#]],
    );
}

#[test]
fn fields_go_together() {
    mistakes(
        &around(Fault::Fields),
        AROUND,
        &expect![[r#"
        tests.rs:1:1: around: these fields do not go together
    "#]],
    );
}

#[test]
fn what_is_no_port_is_not_read() {
    mistakes(
        &around(Fault::Hidden),
        AROUND,
        &expect![[r#"
        tests.rs:57:40: around: `counter.hidden` is read, but is no port: it is not declared pub
    "#]],
    );
}

#[test]
fn a_name_stands_once() {
    mistakes(
        &Twice,
        TWICE,
        &expect![[r#"
        tests.rs:1:1: twice: the name `a` is used twice
    "#]],
    );
}

/// Circuits whose code panics.
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

#[test]
fn a_simulator_is_set_stepped_and_asked() {
    let mut simulator = Simulator::new(&around(Fault::None)).unwrap();
    simulator.set(|i| i.by, 0x15);
    for tick in 0..9 {
        let before = (3 + 5 * tick) % 16;
        assert_eq!(simulator.see(|s| s.p.counter.q.sum), before, "{tick}");
        assert_eq!(simulator.see(|s| s.w.sum), (before + 5) % 16);
        assert_eq!(simulator.now(|now| now.i.by), 5);
        simulator.step();
    }
    simulator.now(|now| {
        let last = (3 + 5 * 9) % 16;
        assert_eq!((now.q.last, now.w.words.len()), (last, 2));
        assert_eq!(now.p.counter.w.next, (last + 5) % 16);
        assert_eq!(now.next().p.counter.q.sum, (last + 5) % 16);
        assert!(now.q.one.iter().any(|word| *word != 0), "{:?}", now.q.one);
    });
    simulator.reset();
    assert_eq!(simulator.registers().p.counter.q.sum, 3);
    assert_eq!(simulator.tick(), 10);
}

/// Something that moves beside a circuit.
#[derive(Clone)]
struct Load;

signals! { for Load as _c;
    /// It.
    pub struct LoadSignals {
        /// Where it is.
        position: I(8),
    }
}

impl Beside for Load {
    const SCOPE: &'static str = "load";
    type Signals<V: View> = LoadSignals<V>;
}

#[test]
fn what_stands_beside_a_circuit_stands_in_its_waves() {
    let circuit = Counter { width: 4, other: 4 };
    let watch = |watch: &super::Watcher<'_, Counter>| watch.at(watch.q.sum);
    let (mut simulator, sum): (_, At<u64>) =
        Simulator::watching_beside(&circuit, &Load, true, watch).unwrap();
    let model = super::model_beside(&circuit, &Load).unwrap();
    let paths: Vec<_> = model
        .declarations()
        .leaves
        .iter()
        .map(|leaf| leaf.path())
        .collect();
    assert_eq!(
        paths[..3],
        ["counter.by", "counter.load.position", "counter.sum"]
    );
    simulator.set(|i| i.by, 1);
    simulator.show::<Load>(&LoadSignals { position: -3 });
    simulator.step();
    assert_eq!((simulator.get(sum), simulator.engine().port(1)), (4, 0xfd));
}

#[test]
fn circuits_are_held_side_by_side() {
    let pair = |other| Pair {
        left: Counter { width: 4, other: 4 },
        right: Counter {
            width: other,
            other: 4,
        },
    };
    let same = pair(4);
    let lockstep = Lockstep::by_name(&same).unwrap();
    let agree = Invariants::new().always("agree", |now| lockstep.compare(now));
    let proof = reach(&same, &agree)
        .run()
        .unwrap()
        .proof()
        .expect("a proof");
    assert_eq!((proof.states, proof.transitions), (16, 256));
    let wrong = elaborate(&pair(5)).unwrap_err().to_string();
    assert!(
        wrong.contains("pair.right: sum of `sum` (5 bits) and `by` (4 bits)"),
        "{wrong}"
    );
}

/// Two additions by one counter, as a law.
#[derive(Debug, Clone)]
struct Adds {
    wrong_at: Option<u64>,
}

signals! { for Adds as _c;
    /// A case.
    pub struct AddsIn {
        /// Added.
        by: U(6),
    }
    /// What is counted with.
    pub struct AddsParts {
        /// It.
        counter: Part<Counter>(Counter { width: 6, other: 6 }),
    }
    /// What is seen.
    pub struct AddsNet {
        /// The sum.
        sum: U(6),
    }
}

impl Circuit for Adds {
    const NAME: &'static str = "adds";
    const ABOUT: &'static str = "adds a number twice";
    records!(AddsIn, Nothing, AddsNet, AddsParts);

    fn tick(&self, i: AddsIn, _: Nothing, p: AddsParts) -> (AddsNet, Nothing) {
        let counter = p.counter.settle(In { by: i.by });
        (
            AddsNet {
                sum: counter.w.next,
            },
            Nothing,
        )
    }
}

impl Law for Adds {
    fn law(&self) -> &str {
        "twice is twice"
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn expected(&self, case: &AddsIn<Value>) -> Option<AddsNet<Value>> {
        let wrong = u64::from(self.wrong_at == Some(case.by));
        (case.by != 7).then_some(AddsNet {
            sum: (3 + 2 * case.by + wrong) % 64,
        })
    }
}

#[test]
fn a_law_is_swept() {
    let law = Adds { wrong_at: None };
    assert_eq!(sweep(&law).run().unwrap().held(), Some(63));
    assert_eq!(sweep(&law).run_simulated().unwrap().held(), Some(63));
    let law = Adds { wrong_at: Some(21) };
    for found in [sweep(&law).run(), sweep(&law).run_simulated()] {
        let found = found.unwrap().counterexample().expect("a case");
        let message = "sum is 45, not 46 with by = 21 (case 21)";
        assert_eq!((found.message.as_str(), found.tick), (message, 1));
    }
}
