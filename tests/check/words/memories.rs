//! Memories against vectors.

use motion_rtl::check::Random;
use motion_rtl::kernel::{Bits, Words, pack, unpack};
use motion_rtl::logic::sim::{SimRam, SimShiftRegister, UInt};
use motion_rtl::logic::{Image, Ram, ShiftRegister, Sim};
use std::collections::VecDeque;

/// The low `D` bits.
fn cut<const D: usize>(word: u64) -> u64 {
    (u128::from(word) % (1 << D)) as u64
}

fn image<const A: usize, const D: usize>() {
    let len = 1usize << A;
    assert_eq!(Image::<A, D>::WORDS, len);
    let mut image = Image::<A, D>::zeroed();
    let mut oracle = vec![0; len];
    let mut random = Random::new(D as u64);
    for _ in 0..200 {
        let (address, word) = (random.word() as usize, random.word());
        image.set(address, word);
        oracle[address % len] = cut::<D>(word);
        for (address, word) in oracle.iter().enumerate() {
            assert_eq!(image.get(address), *word);
            assert_eq!(image.get(address + 3 * len), *word, "addresses wrap");
            let read = image.read::<Sim>((address as u64).into());
            assert_eq!(read.get(), *word);
        }
    }
    // A list that is too short is filled with zeros, of one that is too long the rest is left out.
    let words: Vec<_> = (0..len + 2).map(|_| random.word()).collect();
    let full = Image::<A, D>::new(words.iter().copied());
    let short = Image::<A, D>::new(words[..1].iter().copied());
    for (address, word) in words[..len].iter().enumerate() {
        assert_eq!(full.get(address), cut::<D>(*word));
        let expected = if address == 0 { cut::<D>(*word) } else { 0 };
        assert_eq!(short.get(address), expected);
    }
}

#[test]
fn images() {
    image::<1, 1>();
    image::<2, 3>();
    image::<3, 13>();
    image::<2, 63>();
    image::<2, 64>();
}

fn ram<const A: usize, const D: usize>() {
    let len = 1usize << A;
    let mut random = Random::new(A as u64);
    let words: Vec<_> = (0..len).map(|_| random.word()).collect();
    let mut oracle: Vec<_> = words.iter().map(|word| cut::<D>(*word)).collect();
    let mut ram = SimRam::<A, D>::from(Image::new(words));
    assert_eq!((ram.width(), ram.len(), ram.is_empty()), (D, len, false));
    let mut out = UInt::<D>::default();
    for _ in 0..500 {
        let (address, data, held): (UInt<A>, UInt<D>, UInt<D>) =
            (random.signals(), random.signals(), random.signals());
        let place = address.get() as usize;
        let write = random.word() & 1 == 1;

        assert_eq!(ram.read(address).get(), oracle[place]);
        assert_eq!(
            ram.read_when(true.into(), address, held).get(),
            oracle[place]
        );
        assert_eq!(ram.read_when(false.into(), address, held), held);

        // Read and write at the same address in one tick: the output takes the old word.
        let before = oracle[place];
        let next_out = ram.read_when(write.into(), address, out);
        ram = ram.write(write.into(), address, data);
        if write {
            oracle[place] = data.get();
            assert_eq!(next_out.get(), before);
        } else {
            assert_eq!(next_out, out);
        }
        out = next_out;
        let words: Vec<_> = (0..len).map(|index| ram.word(index)).collect();
        assert_eq!(words, oracle);
    }
    let packed = pack(&ram);
    assert_eq!(packed.len(), len * D);
    let again: SimRam<A, D> = unpack(&packed);
    assert!((0..len).all(|index| again.word(index) == oracle[index]));
}

#[test]
fn rams() {
    ram::<1, 1>();
    ram::<2, 3>();
    ram::<4, 13>();
    ram::<2, 63>();
    ram::<2, 64>();
}

fn shift_register<const K: usize, const D: usize>() {
    let mut random = Random::new(K as u64);
    let words: Vec<_> = (0..K + 2).map(|_| random.word()).collect();
    let mut oracle: VecDeque<_> = words[..K].iter().map(|word| cut::<D>(*word)).collect();
    let mut register = SimShiftRegister::<K, D>::new(words);
    assert_eq!(
        (register.width(), register.len(), register.is_empty()),
        (D, K, K == 0)
    );
    for _ in 0..500 {
        for (index, word) in oracle.iter().enumerate() {
            assert_eq!(register.stage(index).get(), *word);
            assert_eq!(register.word(index), *word);
            assert_eq!(register.tap(UInt::<5>::from(index as u64)).get(), *word);
        }
        for past in [K, K + 1, 2 * K + 1, 31] {
            assert_eq!(register.stage(past).get(), 0);
            assert_eq!(register.tap(UInt::<64>::from(past as u64)).get(), 0);
        }
        assert_eq!(register.stage(usize::MAX).get(), 0);
        assert_eq!(register.tap(UInt::<64>::from(u64::MAX)).get(), 0);

        let packed = pack(&register);
        assert_eq!(packed.len(), K * D);
        let again: SimShiftRegister<K, D> = unpack(&packed);
        assert!((0..K).all(|index| again.word(index) == oracle[index]));

        let input: UInt<D> = random.signals();
        let shift = !random.word().is_multiple_of(3);
        register = register.shift(shift.into(), input);
        if shift {
            oracle.push_front(input.get());
            oracle.truncate(K);
        }
    }
}

#[test]
fn shift_registers() {
    shift_register::<0, 3>();
    shift_register::<1, 1>();
    shift_register::<2, 5>();
    shift_register::<7, 13>();
    shift_register::<3, 64>();
}

#[test]
fn a_short_list_leaves_zeros_in_a_shift_register() {
    let register = SimShiftRegister::<3, 4>::new([17]);
    let stages: Vec<_> = (0..3).map(|index| register.word(index)).collect();
    assert_eq!(stages, [1, 0, 0]);
}

#[test]
fn missing_bits_read_zero() {
    let words: [UInt<4>; 3] = unpack(&Bits::from_element(0xfff)[..6]);
    assert_eq!(words.map(|word| word.get()), [15, 3, 0]);
}
