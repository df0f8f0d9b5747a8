//! Sweeps of everything that words can be made to do, against the meaning `Sim`, which has oracles of
//! its own: `run` by gates, `run_simulated` by the engine.

use motion_rtl::check::{Law, sweep};
use motion_rtl::kernel::{Circuit, Instance, Moment};
use motion_rtl::logic::{Bit, Image, Logic, Ram, ShiftRegister, Signed, Sim, Unsigned};
use motion_rtl::signals;

/// Results of a circuit.
const RESULTS: usize = 48;

signals! { pub struct In<L, const N: usize> { x: L::U<N>, y: L::U<N>, choose: L::Bit } }
signals! { pub struct Reg<L, const N: usize> { x: L::U<N> = 1, y: L::U<N>, choose: L::Bit = 1 } }
signals! { pub struct Net<L> { pub results: [L::U<16>; RESULTS] } }

/// Does everything with two words, one tick later, and with a parameter and a table.
struct Operations<const N: usize> {
    offset: u64,
    table: Image<2, 5>,
}

fn unsigned<L: Logic, const N: usize>(x: L::U<N>, y: L::U<N>, choose: L::Bit) -> Vec<L::U<16>> {
    let words = [x + y, x - y, x + 5, x - 9, !x, x & y, x | y, x ^ y];
    let mut results: Vec<L::U<16>> = words.into_iter().map(Unsigned::resize).collect();
    for bits in [0, 1, N - 1, N] {
        results.push(x.shift_left(bits).resize());
        results.push(x.shift_right(bits).resize());
    }
    results.push(choose.mux(x, y).resize());
    results.push(x.resize::<3>().resize());
    results.push(x.times::<N, 16>(y));
    results.push(x.times::<N, 7>(y).resize());
    results.push(x.join::<N, 16>(y));
    results.push(x.resize::<3>().join::<N, 5>(y).resize());
    for bit in [x.equals(y), x.below(y), x.is_zero(), x.bit(N / 2), x.bit(N)] {
        results.push(bit.word().resize());
    }
    results.push((choose ^ x.bit(0) | !choose & y.bit(0)).word().resize());
    results
}

fn signed<L: Logic, const N: usize>(x: L::I<N>, y: L::I<N>, choose: L::Bit) -> Vec<L::U<16>> {
    let words = [x + y, x - y, x + -3, x - 7, -x, choose.mux(x, y)];
    let shifted = [1, N - 1, N].map(|bits| x.shift_right(bits));
    let words = words.into_iter().chain(shifted);
    let mut results: Vec<L::U<16>> = words.map(|word| word.resize::<16>().unsigned()).collect();
    results.push(x.times::<N, 16>(y).unsigned());
    results.push(x.magnitude().resize());
    results.push(x.resize::<3>().resize::<16>().unsigned());
    for bit in [x.equals(y), x.below(y), x.is_negative()] {
        results.push(bit.word().resize());
    }
    results
}

impl<const N: usize> Circuit for Operations<N> {
    const NAME: &'static str = "operations";
    const ABOUT: &'static str = "does everything with two words";
    type In<L: Logic> = In<L, N>;
    type Reg<L: Logic> = Reg<L, N>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L, N>, _: &In<L, N>) -> Net<L> {
        let mut results = unsigned::<L, N>(q.x, q.y, q.choose);
        results.extend(signed::<L, N>(q.x.signed(), q.y.signed(), q.choose));
        results.push(L::parameter::<16>("offset", self.offset) + q.x.resize());
        results.push(L::rom(&self.table, q.y.resize()).resize());
        results.resize(RESULTS, 0.into());
        let results = results.try_into().expect("as many");
        Net { results }
    }

    fn next<L: Logic>(&self, q: Reg<L, N>, _: &Net<L>, i: &In<L, N>) -> Reg<L, N> {
        Reg {
            x: i.x,
            y: i.choose.mux(i.y, q.y),
            choose: i.choose,
        }
    }
}

signals! { pub struct TwoReg<L, const N: usize> { one: Reg<L, N>, other: Reg<L, N> } }
signals! {
    pub struct TwoNet<L, const N: usize> {
        one: Instance<Operations<N>, L>,
        other: Instance<Operations<N>, L>,
    }
}

/// Two of them with different parameters and tables, the second on words the other way round.
struct Two<const N: usize> {
    one: Operations<N>,
    other: Operations<N>,
}

impl<const N: usize> Circuit for Two<N> {
    const NAME: &'static str = "two";
    const ABOUT: &'static str = "does it twice";
    type In<L: Logic> = In<L, N>;
    type Reg<L: Logic> = TwoReg<L, N>;
    type Net<L: Logic> = TwoNet<L, N>;

    fn comb<L: Logic>(&self, q: &TwoReg<L, N>, i: &In<L, N>) -> TwoNet<L, N> {
        let turned = In {
            x: i.y,
            y: i.x,
            choose: !i.choose,
        };
        TwoNet {
            one: Instance::settle(&self.one, &q.one, i.clone()),
            other: Instance::settle(&self.other, &q.other, turned),
        }
    }

    fn next<L: Logic>(&self, q: TwoReg<L, N>, w: &TwoNet<L, N>, _: &In<L, N>) -> TwoReg<L, N> {
        TwoReg {
            one: w.one.next(&self.one, q.one),
            other: w.other.next(&self.other, q.other),
        }
    }
}

signals! {
    /// Four results.
    pub struct Seen<L> { results: [L::U<16>; 4] }
}

/// Four results from `first` on are those of `Sim`: of the first tick that sees the case, and what
/// has been seen at power-on and of the second circuit added.
struct OfSim<const N: usize> {
    circuit: Two<N>,
    first: usize,
}

impl<const N: usize> Law for OfSim<N> {
    type Circuit = Two<N>;
    type Case<L: Logic> = In<L, N>;
    type Seen<L: Logic> = Seen<L>;

    fn name(&self) -> &str {
        "it does what Sim does"
    }
    fn circuit(&self) -> &Two<N> {
        &self.circuit
    }
    fn ticks(&self) -> u64 {
        2
    }
    fn input<L: Logic>(&self, case: &In<L, N>, _: u64) -> In<L, N> {
        case.clone()
    }
    fn see<L: Logic>(&self, seen: Seen<L>, _: u64, now: &Moment<'_, Two<N>, L>) -> Seen<L> {
        let (one, other) = (&now.w.one.w.results, &now.w.other.w.results);
        let results = std::array::from_fn(|k| {
            let result = self.first + k;
            seen.results[k].shift_left(1) + (one[result] ^ other[result].shift_left(3))
        });
        Seen { results }
    }
    fn expected(&self, case: &In<Sim, N>) -> Option<Seen<Sim>> {
        let mut seen = Seen {
            results: [0.into(); 4],
        };
        let mut q = self.circuit.power_on();
        for tick in 0..self.ticks() {
            let w = self.circuit.comb::<Sim>(&q, case);
            let now = Moment {
                i: case,
                q: &q,
                w: &w,
            };
            seen = self.see(seen, tick, &now);
            q = self.circuit.next::<Sim>(q, &w, case);
        }
        Some(seen)
    }
}

fn every_result_is_that_of_sim<const N: usize>() {
    let operations = |offset, table: [u64; 4]| Operations {
        offset,
        table: Image::new(table),
    };
    for first in (0..RESULTS).step_by(4) {
        let law = OfSim::<N> {
            circuit: Two {
                one: operations(7, [3, 30, 17, 8]),
                other: operations(0x1234, [1, 0, 21, 31]),
            },
            first,
        };
        let all = 1u64 << (2 * N + 1);
        // The first cases, those around the sign of y, and the last ones.
        for begin in [0, all / 4, all / 2, all] {
            let cases = begin.saturating_sub(700)..(begin + 700).min(all);
            let many = cases.end - cases.start;
            let swept = sweep(&law).range(cases.clone()).run().unwrap();
            assert_eq!(swept.held(), Some(many), "{N} bits: {swept:?}");
            let few = cases.start..cases.end.min(cases.start + 20);
            let many = few.end - few.start;
            let swept = sweep(&law).range(few).run_simulated().unwrap();
            assert_eq!(swept.held(), Some(many), "{N} bits: {swept:?}");
        }
    }
}

#[test]
fn words_side_by_side_do_what_one_does() {
    every_result_is_that_of_sim::<1>();
    every_result_is_that_of_sim::<2>();
    every_result_is_that_of_sim::<3>();
    every_result_is_that_of_sim::<5>();
    every_result_is_that_of_sim::<8>();
    every_result_is_that_of_sim::<11>();
    every_result_is_that_of_sim::<16>();
}

signals! { pub struct StoreIn<L> { word: L::U<6>, address: L::U<2> } }
signals! { pub struct StoreReg<L> { ram: L::Ram<2, 6>, stages: L::ShiftRegister<2, 6> } }
signals! { pub struct StoreNet<L> { pub read: L::U<6>, pub stage: L::U<6> } }

/// Stores words.
struct Store;

impl Circuit for Store {
    const NAME: &'static str = "store";
    const ABOUT: &'static str = "stores words";
    type In<L: Logic> = StoreIn<L>;
    type Reg<L: Logic> = StoreReg<L>;
    type Net<L: Logic> = StoreNet<L>;

    fn comb<L: Logic>(&self, q: &StoreReg<L>, i: &StoreIn<L>) -> StoreNet<L> {
        StoreNet {
            read: q.ram.read(i.address),
            stage: q.stages.stage(1),
        }
    }
    fn next<L: Logic>(&self, q: StoreReg<L>, _: &StoreNet<L>, i: &StoreIn<L>) -> StoreReg<L> {
        StoreReg {
            ram: q.ram.write(true.into(), i.address, i.word),
            stages: q.stages.shift(true.into(), i.word),
        }
    }
}

signals! {
    /// Two words.
    pub struct StoreSeen<L> { read: L::U<6>, stage: L::U<6> }
}

/// What was stored is read; wrong is it to expect another word for `wrong`.
struct Stores {
    wrong: u64,
}

impl Law for Stores {
    type Circuit = Store;
    type Case<L: Logic> = StoreIn<L>;
    type Seen<L: Logic> = StoreSeen<L>;

    fn name(&self) -> &str {
        "it stores"
    }
    fn circuit(&self) -> &Store {
        &Store
    }
    fn ticks(&self) -> u64 {
        3
    }
    fn input<L: Logic>(&self, case: &StoreIn<L>, tick: u64) -> StoreIn<L> {
        StoreIn {
            word: case.word + tick,
            address: case.address,
        }
    }
    fn see<L: Logic>(&self, _: StoreSeen<L>, _: u64, now: &Moment<'_, Store, L>) -> StoreSeen<L> {
        StoreSeen {
            read: now.w.read,
            stage: now.w.stage,
        }
    }
    fn expected(&self, case: &StoreIn<Sim>) -> Option<StoreSeen<Sim>> {
        let word = case.word.get();
        Some(StoreSeen {
            read: (word + 1 + u64::from(word == self.wrong)).into(),
            stage: word.into(),
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
