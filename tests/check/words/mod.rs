//! Words and memories, run by the interpreter and compiled, against oracles that know nothing of
//! them: `i128` arithmetic for words, vectors for memories.

mod edges;
mod memories;
pub mod signed;
pub mod unsigned;

use motion_rtl::check::all;
use motion_rtl::prelude::*;
use std::fmt;
use std::sync::Arc;

/// A word that is made of others, and what it is in numbers.
#[derive(Clone)]
pub struct Operation<W> {
    name: String,
    pub width: usize,
    make: Arc<dyn Fn(&Words) -> W + Send + Sync>,
    number: Arc<dyn Fn(&Numbers) -> i128 + Send + Sync>,
}

impl<W> Operation<W> {
    /// Returns the result of these numbers, modulo 2^width.
    pub fn expected(&self, of: &Numbers) -> u64 {
        wrap((self.number)(of), self.width)
    }
}

impl Operation<U> {
    pub fn of(&self, words: &Words) -> U {
        (self.make)(words)
    }
}

impl<W> fmt::Debug for Operation<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} bits", self.name, self.width)
    }
}

/// Operations on two words.
#[derive(Debug, Clone)]
pub struct List<W>(pub Vec<Operation<W>>);

impl<W> List<W> {
    pub fn add(
        &mut self,
        name: impl Into<String>,
        width: usize,
        make: impl Fn(&Words) -> W + Send + Sync + 'static,
        number: impl Fn(&Numbers) -> i128 + Send + Sync + 'static,
    ) {
        let (make, number) = (Arc::new(make), Arc::new(number));
        let name = name.into();
        self.0.push(Operation {
            name,
            width,
            make,
            number,
        });
    }
}

impl List<U> {
    /// Adds an operation whose result is a bit.
    pub fn bit(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&Words) -> Bit + Send + Sync + 'static,
        holds: impl Fn(&Numbers) -> bool + Send + Sync + 'static,
    ) {
        self.add(name, 1, move |i| make(i).word(), move |v| holds(v).into());
    }
}

impl List<I> {
    /// The bits of the results.
    pub fn of_bits(self) -> impl Iterator<Item = Operation<U>> {
        self.0.into_iter().map(|one| Operation {
            name: one.name,
            width: one.width,
            make: Arc::new(move |words| (one.make)(words).unsigned()),
            number: one.number,
        })
    }
}

/// Operands: two words, and the same bits as signed ones.
#[derive(Debug)]
pub struct Words {
    pub a: U,
    pub b: U,
    pub s: I,
    pub t: I,
    pub choose: Bit,
}

/// Operands as numbers.
#[derive(Debug)]
pub struct Numbers {
    pub a: i128,
    pub b: i128,
    pub s: i128,
    pub t: i128,
    pub choose: bool,
}

impl Numbers {
    /// Creates the operands from the bits of two words.
    pub fn new((n, a): (usize, u64), (m, b): (usize, u64), choose: bool) -> Self {
        Numbers {
            a: a.into(),
            b: b.into(),
            s: wrap_signed(a.into(), n).into(),
            t: wrap_signed(b.into(), m).into(),
            choose,
        }
    }
}

/// Every operation on words of `n` and of `m` bits.
#[derive(Debug, Clone)]
struct Operations {
    n: usize,
    m: usize,
    unsigned: Vec<Operation<U>>,
    signed: Vec<Operation<I>>,
}

signals! { for Operations as c;
    struct In { a: U(c.n), b: U(c.m), choose: Bit }
    struct Net {
        unsigned: [U(c.unsigned[k].width); k in c.unsigned.len()],
        signed: [I(c.signed[k].width); k in c.signed.len()],
    }
}

impl Circuit for Operations {
    const NAME: &'static str = "operations";
    const ABOUT: &'static str = "does everything with two words";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let In { a, b, choose } = i;
        let words = Words {
            a,
            b,
            s: a.signed(),
            t: b.signed(),
            choose,
        };
        let unsigned = self.unsigned.iter().map(|one| (one.make)(&words));
        let signed = self.signed.iter().map(|one| (one.make)(&words));
        let (unsigned, signed) = (unsigned.collect(), signed.collect());
        (Net { unsigned, signed }, Nothing)
    }
}

impl Operations {
    fn new(n: usize, m: usize) -> Self {
        let (mut unsigned, mut signed) = (unsigned::of_two(n, m).0, signed::of_two(n, m).0);
        // Operations on one word are added once.
        if m == 1 {
            unsigned.extend(unsigned::of_one(n).0);
            signed.extend(signed::of_one(n).0);
        }
        Operations {
            n,
            m,
            unsigned,
            signed,
        }
    }

    /// Runs them on these words.
    fn hold(&self, cases: impl Iterator<Item = In<Value>>) {
        let mut interpreted = Simulator::new(self).unwrap_or_else(|wrong| panic!("{wrong}"));
        let mut compiled = interpreted.clone();
        interpreted.interpret();
        compiled.compile();
        for case in cases {
            let of = Numbers::new((self.n, case.a), (self.m, case.b), case.choose);
            for simulator in [&mut interpreted, &mut compiled] {
                simulator
                    .step_with(&case, |now| {
                        for (found, one) in now.w.unsigned.iter().zip(&self.unsigned) {
                            assert_eq!(*found, one.expected(&of), "{one:?} of {of:?}");
                        }
                        for (found, one) in now.w.signed.iter().zip(&self.signed) {
                            let expected = wrap_signed((one.number)(&of), one.width);
                            assert_eq!(*found, expected, "{one:?} of {of:?}");
                        }
                    })
                    .unwrap();
            }
        }
    }
}

/// `value` modulo 2^`width`, from 0 up.
fn wrap(value: i128, width: usize) -> u64 {
    value.rem_euclid(1 << width) as u64
}

/// `value` modulo 2^`width`, half of the range below 0.
fn wrap_signed(value: i128, width: usize) -> i64 {
    let value = value.rem_euclid(1 << width);
    let value = if value >= 1 << (width - 1) {
        value - (1 << width)
    } else {
        value
    };
    value as i64
}

/// Every word with every other.
#[test]
fn small_words() {
    for n in 1..=6 {
        for m in 1..=6 {
            let operations = Operations::new(n, m);
            operations.hold(all(&operations).unwrap());
        }
    }
}

/// Numbers that are cut on purpose are set as words of that width, signed ones too.
#[test]
fn numbers_beyond_the_width_are_cut_on_purpose() {
    #[derive(Debug, Clone)]
    struct Ports;

    signals! { for Ports as _c;
        struct PortsIn { word: U(3), number: I(4) }
        struct PortsNet { word_out: U(3), number_out: I(4), sum: I(5) }
    }

    impl Circuit for Ports {
        const NAME: &'static str = "ports";
        const ABOUT: &'static str = "shows its ports";
        records!(PortsIn, Nothing, PortsNet);

        fn tick(&self, i: PortsIn, _: Nothing, _: Nothing) -> (PortsNet, Nothing) {
            let net = PortsNet {
                word_out: i.word,
                number_out: i.number,
                sum: i.number.plus(i.word.signed()),
            };
            (net, Nothing)
        }
    }

    let mut simulator = Simulator::new(&Ports).unwrap();
    for number in -40..40i64 {
        let i = PortsIn {
            word: (number as u64).cut(3),
            number: number.cut(4),
        };
        let (word, four) = (wrap_signed(number.into(), 3), wrap_signed(number.into(), 4));
        let expected = (wrap(number.into(), 3), four, four + word);
        let seen = simulator
            .step_with(&i, |now| (now.w.word_out, now.w.number_out, now.w.sum))
            .unwrap();
        assert_eq!(seen, expected, "all at once");
        let word = (number + 1) as u64;
        simulator.set(|i| i.word, word.cut(3)).unwrap();
        simulator.set(|i| i.number, (number + 1).cut(4)).unwrap();
        let number = wrap_signed(i128::from(number) + 1, 4);
        assert_eq!(simulator.see(|s| s.w.number_out), number, "one by one");
    }
}
