//! What rests is passed over, and nothing is missing.

use super::zoo::{Part, PartIn, PartReg};
use super::{SEED, clock, reader};
use motion_rtl::check::Random;
use motion_rtl::kernel::{
    Circuit, Extent, Field, Instance, Make, Nothing, Signals, Simulator, Visit,
};
use motion_rtl::logic::{Bit, Logic, Ram, Signed, Sim, Unsigned};
use motion_rtl::signals;
use motion_rtl::trace::{Options, Vcd, replay};
use std::fs;
use std::sync::atomic::{AtomicU64, Ordering};

signals! { pub struct Way<L> { pub step: L::U<3>, pub up: L::Bit } }
signals! { pub struct TableIn<L> { pub address: L::U<3>, pub way: Way<L>, pub write: L::Bit } }
signals! { pub struct TableReg<L> { pub part: PartReg<L>, words: L::Ram<3, 4> } }
signals! {
    pub struct TableNet<L> { pub read: L::U<4>, pub part: Instance<Part, L>, pub odd: L::Bit }
}

/// A part and a memory, and ports that stand in a bundle.
#[derive(Debug, Clone)]
pub struct Table;

impl Circuit for Table {
    const NAME: &'static str = "table";
    const ABOUT: &'static str = "a circuit in the middle";
    type In<L: Logic> = TableIn<L>;
    type Reg<L: Logic> = TableReg<L>;
    type Net<L: Logic> = TableNet<L>;

    fn comb<L: Logic>(&self, q: &TableReg<L>, i: &TableIn<L>) -> TableNet<L> {
        let read = q.words.read(i.address);
        let ports = PartIn {
            step: i.way.step,
            up: i.way.up ^ read.bit(3),
        };
        let part = Instance::settle(&Part, &q.part, ports);
        let odd = read.bit(0) ^ part.w.wrapped;
        TableNet { read, part, odd }
    }

    fn next<L: Logic>(&self, q: TableReg<L>, w: &TableNet<L>, i: &TableIn<L>) -> TableReg<L> {
        TableReg {
            part: w.part.next(&Part, q.part),
            words: q.words.write(i.write, i.address, w.read + 3),
        }
    }
}

signals! { pub struct SumIn<L> { pub a: L::U<4>, pub b: L::U<4> } }
signals! { pub struct SumNet<L> { pub sum: L::U<4> } }

/// No registers.
#[derive(Debug, Clone)]
pub struct Sum;

impl Circuit for Sum {
    const NAME: &'static str = "sum";
    const ABOUT: &'static str = "a sum";
    type In<L: Logic> = SumIn<L>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = SumNet<L>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &SumIn<L>) -> SumNet<L> {
        SumNet { sum: i.a + i.b }
    }

    fn next<L: Logic>(&self, q: Nothing<L>, _: &SumNet<L>, _: &SumIn<L>) -> Nothing<L> {
        q
    }
}

signals! {
    pub struct Reg<L> { pub tables: [TableReg<L>; 2], pub there: PartReg<L>, pub sum: Nothing<L> }
}
signals! {
    pub struct Net<L> {
        pub tables: [Instance<Table, L>; 2],
        pub here: Instance<Part, L>,
        pub sum: Instance<Sum, L>,
        pub any: L::Bit,
    }
}

/// Two tables, a sum, and a part whose registers have another name than it.
#[derive(Debug, Clone)]
pub struct Whole;

impl Circuit for Whole {
    const NAME: &'static str = "whole";
    const ABOUT: &'static str = "circuits within circuits";
    type In<L: Logic> = TableIn<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &TableIn<L>) -> Net<L> {
        let other = TableIn {
            write: !q.there.level.is_negative() & i.write,
            ..i.clone()
        };
        let tables = Instance::settle_each(&[Table, Table], &q.tables, [i.clone(), other]);
        // Stands still, but goes up where both tables are odd.
        let up = tables[0].w.odd & tables[1].w.odd;
        let step = up.mux(1.into(), 0.into());
        let here = Instance::settle(&Part, &q.there, PartIn { step, up });
        let (a, b) = (tables[0].w.read, tables[1].w.read);
        let sum = Instance::settle(&Sum, &q.sum, SumIn { a, b });
        let any = here.w.wrapped | sum.w.sum.bit(2);
        Net {
            tables,
            here,
            sum,
            any,
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, _: &TableIn<L>) -> Reg<L> {
        Reg {
            tables: Instance::next_each(&w.tables, &[Table, Table], q.tables),
            there: w.here.next(&Part, q.there),
            sum: w.sum.next(&Sum, q.sum),
        }
    }
}

/// Ports in that stand still most of the time, and change one at a time.
fn slow(seed: u64) -> impl Iterator<Item = TableIn<Sim>> {
    let mut random = Random::new(seed);
    let mut ports: [u64; 4] = [0; 4];
    std::iter::from_fn(move || {
        if random.word().is_multiple_of(3) {
            ports[(random.word() % 4) as usize] = random.word();
        }
        let [step, up, address, write] = ports;
        Some(TableIn {
            way: Way {
                // Mostly 0, where the parts rest.
                step: (step % 5 / 3).into(),
                up: (up % 2 == 1).into(),
            },
            address: address.into(),
            write: write.is_multiple_of(8).into(),
        })
    })
}

/// A signal that is shown and not counted.
#[derive(Debug, Clone)]
pub struct Uncounted<L: Logic>(L::U<4>);

impl<L: Logic> Signals<L> for Uncounted<L> {
    const EXTENT: Extent = Extent::NONE;
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        visitor.unsigned(field, self.0);
    }
    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self {
        Uncounted(maker.unsigned(field))
    }
}

signals! { pub struct Counted<L> { pub count: L::U<4>, pub hidden: Uncounted<L> } }

#[derive(Debug, Clone)]
pub struct Miscounted;

impl Circuit for Miscounted {
    const NAME: &'static str = "miscounted";
    const ABOUT: &'static str = "has more signals than it says";
    type In<L: Logic> = Nothing<L>;
    type Reg<L: Logic> = Counted<L>;
    type Net<L: Logic> = Nothing<L>;

    fn comb<L: Logic>(&self, _: &Counted<L>, _: &Nothing<L>) -> Nothing<L> {
        Nothing::new()
    }

    fn next<L: Logic>(&self, q: Counted<L>, _: &Nothing<L>, _: &Nothing<L>) -> Counted<L> {
        q
    }
}

#[test]
fn signals_that_are_not_counted_are_an_error() {
    let mut vcd = Vcd::new(Vec::new(), &Miscounted, clock(), &Options::default()).unwrap();
    let run = Simulator::new(&Miscounted).run(1, |_, _| Nothing::new(), &mut vcd);
    let error = run.unwrap_err().to_string();
    assert!(
        error.contains("miscounted: a walk shows more or less"),
        "{error}"
    );
}

#[test]
fn what_rests_is_passed_over_and_nothing_is_missing() {
    let directory = tempfile::tempdir().unwrap();
    for seed in SEED..SEED + 20 {
        let inputs: Vec<_> = slow(seed).take(2_000).collect();
        let every = inputs.iter().cloned();
        let paths = replay(&Whole, every, clock(), directory.path(), "whole").unwrap();
        let every_leaf = fs::read(&paths[0]).unwrap();

        let mut vcd = Vcd::new(Vec::new(), &Whole, clock(), &Options::default()).unwrap();
        let ports = |tick, _: &_| inputs[tick as usize].clone();
        Simulator::new(&Whole).run(2_000, ports, &mut vcd).unwrap();
        assert!(vcd.finish().unwrap() == every_leaf, "{seed}");

        // And they do something.
        let dump = reader::read(&every_leaf);
        for path in ["whole.any", "whole.there.level", "whole.tables1.part.level"] {
            let changes = dump.variables[path].changes.len();
            assert!((20..1_990).contains(&changes), "{path}: {changes}");
        }
    }
}

static LOOKS: AtomicU64 = AtomicU64::new(0);

/// A signal that counts how often it is looked at.
#[derive(Debug, Clone)]
pub struct Watched<L: Logic>(L::U<4>);

impl<L: Logic> Signals<L> for Watched<L> {
    const EXTENT: Extent = Extent::LEAF;
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        LOOKS.fetch_add(1, Ordering::Relaxed);
        visitor.unsigned(field, self.0);
    }
    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self {
        Watched(maker.unsigned(field))
    }
}

signals! { pub struct WatchedNet<L> { pub sum: Watched<L> } }

/// As [`Sum`].
#[derive(Debug, Clone)]
pub struct WatchedSum;

impl Circuit for WatchedSum {
    const NAME: &'static str = "watched_sum";
    const ABOUT: &'static str = "a sum that knows how often it is looked at";
    type In<L: Logic> = SumIn<L>;
    type Reg<L: Logic> = Nothing<L>;
    type Net<L: Logic> = WatchedNet<L>;

    fn comb<L: Logic>(&self, _: &Nothing<L>, i: &SumIn<L>) -> WatchedNet<L> {
        let sum = Watched(i.a + i.b);
        WatchedNet { sum }
    }

    fn next<L: Logic>(&self, q: Nothing<L>, _: &WatchedNet<L>, _: &SumIn<L>) -> Nothing<L> {
        q
    }
}

signals! { pub struct AroundReg<L> { pub inner: Nothing<L>, pub ticks: L::U<8> } }
signals! { pub struct AroundNet<L> { pub inner: Instance<WatchedSum, L> } }

/// A sum beside a register that changes in every tick.
#[derive(Debug, Clone)]
pub struct Around;

impl Circuit for Around {
    const NAME: &'static str = "around";
    const ABOUT: &'static str = "a sum and a counter";
    type In<L: Logic> = SumIn<L>;
    type Reg<L: Logic> = AroundReg<L>;
    type Net<L: Logic> = AroundNet<L>;

    fn comb<L: Logic>(&self, q: &AroundReg<L>, i: &SumIn<L>) -> AroundNet<L> {
        let inner = Instance::settle(&WatchedSum, &q.inner, i.clone());
        AroundNet { inner }
    }

    fn next<L: Logic>(&self, q: AroundReg<L>, w: &AroundNet<L>, _: &SumIn<L>) -> AroundReg<L> {
        AroundReg {
            inner: w.inner.next(&WatchedSum, q.inner),
            ticks: q.ticks + 1,
        }
    }
}

#[test]
fn what_rests_is_not_even_looked_at() {
    let mut vcd = Vcd::new(Vec::new(), &Around, clock(), &Options::default()).unwrap();
    let begin = LOOKS.load(Ordering::Relaxed);
    let ports = |tick: u64, _: &_| SumIn {
        a: (tick / 40).into(),
        b: (tick / 40).into(),
    };
    Simulator::new(&Around).run(100, ports, &mut vcd).unwrap();
    // In ticks 0, 40 and 80.
    assert_eq!(LOOKS.load(Ordering::Relaxed) - begin, 3);
}
