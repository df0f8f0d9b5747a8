//! Sweeps of everything that words can be made to do, against plain arithmetic: `run` by gates,
//! `run_simulated` by the engine.

use crate::words::{List, Numbers, Operation, Words, signed, unsigned};
use motion_rtl::check::{Law, sweep};
use motion_rtl::prelude::*;

/// Does some things with two words; results have 16 bits.
#[derive(Debug, Clone)]
struct Operations {
    width: usize,
    list: Vec<Operation<U>>,
}

signals! { for Operations as c;
    struct In { x: U(c.width), y: U(c.width), choose: Bit }
    struct Net { pub results: [U(16); c.list.len()] }
}

impl Operations {
    /// Returns the results by arithmetic with numbers.
    fn expected(&self, x: u64, y: u64, choose: bool) -> Vec<u64> {
        let of = Numbers::new((self.width, x), (self.width, y), choose);
        let list = self.list.iter();
        list.map(|one| one.expected(&of) & 0xffff).collect()
    }
}

impl Circuit for Operations {
    const NAME: &'static str = "operations";
    const ABOUT: &'static str = "does everything with two words";
    records!(In, Nothing, Net);

    fn tick(&self, i: In, _: Nothing, _: Nothing) -> (Net, Nothing) {
        let In { x, y, choose } = i;
        let words = Words {
            a: x,
            b: y,
            s: x.signed(),
            t: y.signed(),
            choose,
        };
        let results = self.list.iter().map(|one| one.of(&words).resize(16));
        let results = results.collect();
        (Net { results }, Nothing)
    }
}

/// Two of them with different parameters and tables, the second on words the other way round: what
/// they give now, and what they gave before.
#[derive(Debug, Clone)]
struct Twice {
    one: Operations,
    other: Operations,
}

signals! { for Twice as c;
    struct Case { x: U(c.one.width), y: U(c.one.width), choose: Bit }
    struct Reg {
        held_x: U(c.one.width) = 1,
        held_y: U(c.one.width),
        held_choose: Bit = 1,
        before: [U(16); c.one.list.len()],
    }
    struct Parts {
        one: Part<Operations>(c.one.clone()),
        other: Part<Operations>(c.other.clone()),
    }
    struct Seen { seen: [U(16); c.one.list.len()] }
}

impl Circuit for Twice {
    const NAME: &'static str = "twice";
    const ABOUT: &'static str = "does it twice";
    records!(Case, Reg, Seen, Parts);

    fn tick(&self, i: Case, q: Reg, p: Parts) -> (Seen, Reg<Edge>) {
        let (x, y, choose) = (q.held_x, q.held_y, q.held_choose);
        let one = p.one.settle(In { x, y, choose });
        let other = p.other.settle(In {
            x: y,
            y: x,
            choose: !choose,
        });
        let results = one.w.results.iter().zip(&other.w.results);
        let both = results.map(|(one, other)| *one ^ other.shift_left(3));
        let seen = both.zip(&q.before);
        let seen: Vec<U> = seen
            .map(|(both, before)| before.shift_left(1) + both)
            .collect();
        let next = Reg {
            held_x: i.x,
            held_y: i.choose.mux(i.y, y),
            held_choose: i.choose,
            before: seen.clone(),
        };
        (Seen { seen }, next)
    }
}

impl Law for Twice {
    fn law(&self) -> &str {
        "it does what plain arithmetic does"
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn expected(&self, case: &Case<Value>) -> Option<Seen<Value>> {
        let later = (case.x, if case.choose { case.y } else { 0 }, case.choose);
        let mut seen = vec![0; self.one.list.len()];
        for (x, y, choose) in [(1, 0, true), later] {
            let one = self.one.expected(x, y, choose);
            let other = self.other.expected(y, x, !choose);
            for ((seen, one), other) in seen.iter_mut().zip(one).zip(other) {
                *seen = ((*seen << 1) + (one ^ other << 3 & 0xffff)) & 0xffff;
            }
        }
        Some(Seen { seen })
    }
}

/// All there is to do with words of a width, with a parameter and a table.
fn operations(width: usize, offset: u64, table: [u64; 4]) -> Vec<Operation<U>> {
    let mut list = List(Vec::new());
    let parameter = move |i: &Words| U::parameter("offset", offset, 16) + i.a.resize(16);
    list.add("a parameter", 16, parameter, move |v| {
        v.a + i128::from(offset)
    });
    let image = Image::of(2, 5, table);
    let read = move |i: &Words| image.rom(i.b.resize(2));
    list.add("a table", 5, read, move |v| {
        table[(v.b & 3) as usize].into()
    });
    for more in [unsigned::of_one(width), unsigned::of_two(width, width)] {
        list.0.extend(more.0);
    }
    for more in [signed::of_one(width), signed::of_two(width, width)] {
        list.0.extend(more.of_bits());
    }
    list.0
}

fn every_result_is_right(width: usize) {
    let list = operations(width, 7, [3, 30, 17, 8]);
    let others = operations(width, 0x1234, [1, 0, 21, 31]);
    for (list, others) in list.chunks(4).zip(others.chunks(4)) {
        let operations = |list: &[_]| Operations {
            width,
            list: list.to_vec(),
        };
        let law = Twice {
            one: operations(list),
            other: operations(others),
        };
        let all = 1u64 << (2 * width + 1);
        // The first cases, those around the sign of y, and the last ones.
        for begin in [0, all / 4, all / 2, all] {
            let cases = begin.saturating_sub(700)..(begin + 700).min(all);
            let many = cases.end - cases.start;
            let swept = sweep(&law).range(cases.clone()).run().unwrap();
            assert_eq!(swept.held(), Some(many), "{width} bits: {swept:?}");
            let few = cases.start..cases.end.min(cases.start + 20);
            let many = few.end - few.start;
            let swept = sweep(&law).range(few).run_simulated().unwrap();
            assert_eq!(swept.held(), Some(many), "{width} bits: {swept:?}");
        }
    }
}

#[test]
#[ignore = "takes long"]
fn words_side_by_side_do_what_one_does() {
    for width in [1, 2, 3, 5, 8, 11, 16] {
        every_result_is_right(width);
    }
}

/// Law that a stored word is read; wrong for `wrong`, where another word is expected.
#[derive(Debug, Clone)]
struct Stores {
    wrong: u64,
}

signals! { for Stores as _c;
    struct StoreIn { word: U(6), address: U(2) }
    struct StoreReg { tick: U(6), ram: Ram(2, 6), stages: Shift(2, 6) }
    struct StoreNet { read: U(6), stage: U(6) }
}

impl Circuit for Stores {
    const NAME: &'static str = "stores";
    const ABOUT: &'static str = "stores words, each tick another";
    records!(StoreIn, StoreReg, StoreNet);

    fn tick(&self, i: StoreIn, q: StoreReg, _: Nothing) -> (StoreNet, StoreReg<Edge>) {
        let net = StoreNet {
            read: q.ram.read(i.address),
            stage: q.stages.stage(1),
        };
        let word = i.word + q.tick;
        let next = StoreReg {
            tick: q.tick + 1,
            ram: q.ram.write(Bit::high(), i.address, word),
            stages: q.stages.shift(Bit::high(), word),
        };
        (net, next)
    }
}

impl Law for Stores {
    fn law(&self) -> &str {
        "it stores"
    }
    fn ticks(&self) -> u64 {
        3
    }
    fn expected(&self, case: &StoreIn<Value>) -> Option<StoreNet<Value>> {
        let word = case.word;
        Some(StoreNet {
            read: (word + 1 + u64::from(word == self.wrong)) % 64,
            stage: word,
        })
    }
}

#[test]
fn a_circuit_with_memories_is_swept_too() {
    let swept = sweep(&Stores { wrong: 64 }).run().unwrap();
    assert_eq!(swept.held(), Some(1 << 8));
    let swept = sweep(&Stores { wrong: 9 }).run().unwrap();
    let found = swept.counterexample().expect("it is wrong");
    assert_eq!(
        found.message,
        "read is 10, not 11 with word = 9, address = 0 (case 9)"
    );
}
