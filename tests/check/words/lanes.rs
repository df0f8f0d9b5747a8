//! Words and memories in lanes against the simulated ones, which have oracles of their own.

use super::small_widths;
use motion_rtl::check::Random;
use motion_rtl::kernel::{Bits, Circuit, pack as pack_one, unpack as unpack_one};
use motion_rtl::linear_interpolator::{Integrator, Rule};
use motion_rtl::logic::lanes::{
    Element, LaneBit, LaneInt, LaneRam, LaneShiftRegister, LaneUInt, lane, pack, spread, unpack,
};
use motion_rtl::logic::sim::{Int, SimRam, SimShiftRegister, UInt, Wire};
use motion_rtl::logic::{Bit, Image, Lanes, Logic, Ram, ShiftRegister, Signed, Sim, Unsigned};

/// Lanes of the tests: an odd number, so that no width of a vector fits it.
const K: usize = 5;

/// Everything that two words and a number of bits can be made to, in words of any meaning.
fn unsigned<L: Logic, const N: usize>(
    x: L::U<N>,
    y: L::U<N>,
    choose: L::Bit,
    bits: usize,
    constant: u64,
    seen: &mut impl Seen<L>,
) {
    for word in [
        x + y,
        x - y,
        x + constant,
        x - constant,
        !x,
        x & y,
        x | y,
        x ^ y,
    ] {
        seen.unsigned(word);
    }
    seen.unsigned(x.shift_left(bits));
    seen.unsigned(x.shift_right(bits));
    seen.unsigned(choose.mux(x, y));
    seen.unsigned::<N>(constant.into());
    seen.unsigned(x.resize::<1>());
    seen.unsigned(x.resize::<4>());
    seen.unsigned(x.resize::<8>());
    seen.unsigned(x.times::<N, 8>(y));
    seen.unsigned(x.times::<N, 3>(y));
    seen.unsigned(x.join::<N, 8>(y));
    seen.unsigned(x.join::<N, 3>(y));
    seen.unsigned(x.resize::<2>().join::<8, 8>(y.resize()));
    seen.signed(x.signed());
    for bit in [x.equals(y), x.below(y), x.is_zero(), x.bit(bits), x.bit(0)] {
        seen.bit(bit);
    }
    wires::<L>(choose, x.bit(0), seen);
}

fn signed<L: Logic, const N: usize>(
    x: L::I<N>,
    y: L::I<N>,
    choose: L::Bit,
    bits: usize,
    constant: i64,
    seen: &mut impl Seen<L>,
) {
    for word in [x + y, x - y, x + constant, x - constant, -x] {
        seen.signed(word);
    }
    seen.signed(x.shift_left(bits));
    seen.signed(x.shift_right(bits));
    seen.signed(choose.mux(x, y));
    seen.signed::<N>(constant.into());
    seen.signed(x.resize::<1>());
    seen.signed(x.resize::<4>());
    seen.signed(x.resize::<8>());
    seen.signed(x.times::<N, 8>(y));
    seen.signed(x.times::<N, 3>(y));
    seen.unsigned(x.magnitude());
    seen.unsigned(x.unsigned());
    for bit in [x.equals(y), x.below(y), x.is_zero(), x.is_negative()] {
        seen.bit(bit);
    }
}

fn wires<L: Logic>(a: L::Bit, b: L::Bit, seen: &mut impl Seen<L>) {
    for bit in [
        !a,
        a & b,
        a | b,
        a ^ b,
        a.mux(b, !b),
        true.into(),
        false.into(),
    ] {
        seen.bit(bit);
    }
    seen.unsigned(a.word());
}

/// Takes down results.
trait Seen<L: Logic> {
    fn bit(&mut self, bit: L::Bit);
    fn unsigned<const N: usize>(&mut self, word: L::U<N>);
    fn signed<const N: usize>(&mut self, word: L::I<N>);
}

/// Numbers, those of a lane.
#[derive(Default, Debug, PartialEq)]
struct Numbers {
    lane: usize,
    numbers: Vec<i128>,
}

impl Seen<Sim> for Numbers {
    fn bit(&mut self, bit: Wire) {
        self.numbers.push(bit.get().into());
    }
    fn unsigned<const N: usize>(&mut self, word: UInt<N>) {
        self.numbers.push(word.get().into());
    }
    fn signed<const N: usize>(&mut self, word: Int<N>) {
        self.numbers.push(word.get().into());
    }
}

impl<E: Element> Seen<Lanes<K, E>> for Numbers {
    fn bit(&mut self, bit: LaneBit<K, E>) {
        self.numbers.push(bit.get(self.lane).into());
        // Held as all ones or zero, or a choice by it would mix.
        assert_eq!(bit, LaneBit::each(|k| bit.get(k)));
    }
    fn unsigned<const N: usize>(&mut self, word: LaneUInt<K, E, N>) {
        self.numbers.push(word.get(self.lane).into());
    }
    fn signed<const N: usize>(&mut self, word: LaneInt<K, E, N>) {
        self.numbers.push(word.get(self.lane).into());
    }
}

/// The operands of every lane.
type Operands = [(u64, u64, bool); K];

fn compare<E: Element, const N: usize>(operands: &Operands, bits: usize, constant: u64) {
    let chosen = LaneBit::<K, E>::each(|k| operands[k].2);
    let (x, y) = (
        LaneUInt::<K, E, N>::each(|k| operands[k].0),
        LaneUInt::each(|k| operands[k].1),
    );
    let (a, b) = (
        LaneInt::<K, E, N>::each(|k| operands[k].0 as i64),
        LaneInt::each(|k| operands[k].1 as i64),
    );
    for (k, &(one, other, choose)) in operands.iter().enumerate() {
        let mut expected = Numbers::default();
        let mut seen = Numbers {
            lane: k,
            ..Numbers::default()
        };
        let (of, to) = (UInt::<N>::from(one), UInt::from(other));
        unsigned::<Sim, N>(of, to, choose.into(), bits, constant, &mut expected);
        unsigned::<Lanes<K, E>, N>(x, y, chosen, bits, constant, &mut seen);
        let (of, to) = (Int::<N>::from(one as i64), Int::from(other as i64));
        let constant = constant as i64;
        signed::<Sim, N>(of, to, choose.into(), bits, constant, &mut expected);
        signed::<Lanes<K, E>, N>(a, b, chosen, bits, constant, &mut seen);
        assert_eq!(seen.numbers, expected.numbers, "{one}, {other}, {bits}");
    }
}

/// Every word with every other, neighbours in the lanes.
fn exhaustive<const N: usize>() {
    let all = 1u64 << (2 * N);
    for first in (0..all).step_by(K) {
        let operands = std::array::from_fn(|k| {
            let case = first + k as u64;
            (case >> N, case, k % 2 == 0)
        });
        let bits = first as usize % (N + 2);
        compare::<u8, N>(&operands, bits, first.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    }
}

#[test]
fn every_word_of_few_bits() {
    small_widths!(exhaustive);
}

fn at_random<E: Element, const N: usize>() {
    let mut random = Random::new(N as u64);
    for round in 0..400 {
        // Now and then the ends of the range.
        let mut word = || match random.word() % 4 {
            0 => [0, 1, u64::MAX, 1 << (N - 1), (1 << (N - 1)) - 1][random.word() as usize % 5],
            _ => random.word(),
        };
        let operands = std::array::from_fn(|_| (word(), word(), word() & 1 == 1));
        for bits in [0, 1, N - 1, N, N + 1, round % 70, usize::MAX] {
            compare::<E, N>(&operands, bits, word());
        }
    }
}

#[test]
fn every_element_and_the_widest_words_of_it() {
    at_random::<u8, 8>();
    at_random::<u16, 8>();
    at_random::<u16, 15>();
    at_random::<u16, 16>();
    at_random::<u32, 17>();
    at_random::<u32, 32>();
    at_random::<u64, 33>();
    at_random::<u64, 63>();
    at_random::<u64, 64>();
}

/// A memory in lanes does what one does in each.
fn ram<E: Element, const A: usize, const D: usize>() {
    type L<E> = Lanes<K, E>;
    let mut random = Random::new(7);
    let words: Vec<u64> = (0..1 << A).map(|_| random.word()).collect();
    let image = Image::<A, D>::new(words);
    let mut one: [SimRam<A, D>; K] = std::array::from_fn(|_| image.clone().into());
    let mut lanes: LaneRam<K, E, A, D> = spread(&one[0]);
    for _ in 0..300 {
        let operands: [(u64, u64, bool); K] =
            std::array::from_fn(|_| (random.word(), random.word(), random.word() & 1 == 1));
        let enable = LaneBit::each(|k| operands[k].2);
        let address = LaneUInt::each(|k| operands[k].0);
        let data = LaneUInt::each(|k| operands[k].1);
        let read = Ram::<L<E>, A, D>::read(&lanes, address);
        let held = lanes.read_when(enable, address, data);
        let fixed = image.read::<L<E>>(address);
        for (k, ram) in one.iter().enumerate() {
            let place = UInt::from(operands[k].0);
            assert_eq!(read.get(k), ram.read(place).get());
            let kept = ram.read_when(operands[k].2.into(), place, operands[k].1.into());
            assert_eq!(held.get(k), kept.get());
            assert_eq!(fixed.get(k), image.read::<Sim>(place).get());
        }
        lanes = lanes.write(enable, address, data);
        for (k, ram) in one.iter_mut().enumerate() {
            let place = UInt::from(operands[k].0);
            *ram = ram
                .clone()
                .write(operands[k].2.into(), place, operands[k].1.into());
            let whole = pack_one(ram);
            let words = whole.chunks(D).map(|word| number(word.iter().by_vals()));
            assert_eq!(lane(&lanes, k), words.collect::<Vec<_>>());
        }
    }
}

/// The number that bits are, the lowest first.
fn number(bits: impl DoubleEndedIterator<Item = bool>) -> u64 {
    bits.rev().fold(0, |word, bit| word << 1 | u64::from(bit))
}

#[test]
fn rams() {
    ram::<u8, 1, 1>();
    ram::<u16, 3, 13>();
    ram::<u64, 2, 64>();
}

fn shift_register<E: Element, const S: usize, const D: usize>() {
    let mut random = Random::new(9);
    let words: Vec<u64> = (0..S).map(|_| random.word()).collect();
    let mut one: [_; K] = std::array::from_fn(|_| SimShiftRegister::<S, D>::new(words.clone()));
    let mut lanes: LaneShiftRegister<K, E, S, D> = spread(&one[0]);
    for round in 0..300 {
        // In some ticks no lane shifts, in some all.
        let operands: [(u64, u64, bool); K] = std::array::from_fn(|_| {
            let enable = [false, true, random.word() & 1 == 1][round % 3];
            (random.word(), random.word() % (S as u64 + 2), enable)
        });
        let enable = LaneBit::each(|k| operands[k].2);
        let tap = LaneUInt::<K, E, 4>::each(|k| operands[k].1);
        let tapped = lanes.tap(tap);
        for (k, register) in one.iter().enumerate() {
            let tap = UInt::<4>::from(operands[k].1);
            assert_eq!(tapped.get(k), register.tap(tap).get());
            for index in [0, 1, S - 1, S, usize::MAX] {
                assert_eq!(lanes.stage(index).get(k), register.stage(index).get());
            }
        }
        lanes = lanes.shift(enable, LaneUInt::each(|k| operands[k].0));
        for (k, register) in one.iter_mut().enumerate() {
            *register = register
                .clone()
                .shift(operands[k].2.into(), operands[k].0.into());
            for (index, word) in lane(&lanes, k).into_iter().enumerate() {
                assert_eq!(word, register.stage(index).get());
            }
        }
    }
}

#[test]
fn shift_registers() {
    shift_register::<u8, 1, 1>();
    shift_register::<u16, 7, 13>();
    shift_register::<u64, 3, 64>();
}

motion_rtl::signals! {
    /// Leaves of every kind.
    struct Leaves<L> {
        wire: L::Bit,
        words: [L::U<5>; 2],
        signed: L::I<7>,
    }
}

#[test]
fn a_bundle_is_packed_in_every_lane_as_it_is_alone() {
    let mut random = Random::new(3);
    for _ in 0..100 {
        let words: [u64; K] = std::array::from_fn(|_| random.word() & 0x3_ffff);
        let lanes: Leaves<Lanes<K, u8>> = unpack(words);
        assert_eq!(pack(&lanes), words);
        for (k, word) in words.into_iter().enumerate() {
            let one: Leaves<Sim> = unpack_one(&Bits::from_element(word));
            assert_eq!(pack_one(&one).into_vec(), [word]);
            let again: Leaves<Lanes<K, u8>> = spread(&one);
            assert_eq!(pack(&again), [word; K]);
            assert_eq!(lanes.signed.get(k), one.signed.get());
            assert_eq!(lanes.wire.get(k), one.wire.get());
            assert_eq!(lanes.words[1].get(k), one.words[1].get());
        }
    }
    let wide: LaneUInt<K, u64, 64> = unpack([u64::MAX, 0, 1, 2, 1 << 63]);
    assert_eq!(pack(&wide), [u64::MAX, 0, 1, 2, 1 << 63]);
}

type Alone = <Integrator<4, 8> as Circuit>::Reg<Sim>;
type Beside = <Integrator<4, 8> as Circuit>::Reg<Lanes<K, u8>>;

/// What rests in one lane goes on in another.
#[test]
fn a_circuit_in_lanes_that_are_out_of_step_is_in_each_as_it_is_alone() {
    const START: u64 = 1 << 9;
    let circuit = Integrator::<4, 8>::new(Rule::Floor);
    let mut random = Random::new(5);
    let mut alone: [Alone; K] = std::array::from_fn(|_| circuit.power_on());
    let mut beside: Beside = spread(&alone[0]);
    let mut starts = [0; K];
    for tick in 0..3_000 {
        // Now and then a start, and a clear still more rarely.
        let ports: [u64; K] = std::array::from_fn(|_| match random.word() % 64 {
            0 => random.word() & 0x3fff,
            1..8 => random.word() & 0x3ffe | START,
            _ => random.word() & 0x3ffe & !START,
        });
        let i = unpack(ports);
        let w = circuit.comb(&beside, &i);
        beside = circuit.next(beside, &w, &i);
        for (k, q) in alone.iter_mut().enumerate() {
            let i = unpack_one(&Bits::from_element(ports[k]));
            let w = circuit.comb(q, &i);
            *q = circuit.next(q.clone(), &w, &i);
            let expected: Beside = spread(q);
            assert_eq!(
                lane(&beside, k),
                lane(&expected, k),
                "lane {k}, tick {tick}"
            );
            starts[k] += u64::from(ports[k] & START != 0);
        }
    }
    assert!(starts.iter().all(|&starts| starts > 200), "{starts:?}");
}
