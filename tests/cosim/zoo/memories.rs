//! Memories of every kind, read and written in every way.

use motion_rtl::kernel::Circuit;
use motion_rtl::logic::sim::SimShiftRegister;
use motion_rtl::logic::{Bit, Image, Logic, Ram, ShiftRegister, Sim, Unsigned};
use motion_rtl::signals;

signals! {
    /// Ports in.
    pub struct In<L> {
        pub read: L::Bit,
        pub write: L::Bit,
        pub address: L::U<3> as Hex,
        pub other: L::U<5>,
        pub data: L::U<33>,
        pub tap: L::U<8>,
    }
}

signals! {
    /// Memories, and a register for what is read.
    pub struct Reg<L> {
        /// Empty at power-on.
        empty: L::Ram<3, 33>,
        /// Filled at power-on.
        filled: L::Ram<3, 7>,
        /// Words of one bit.
        flags: L::Ram<5, 1>,
        /// Never written.
        fixed: L::Ram<1, 64>,
        /// Written in every tick.
        steady: L::Ram<1, 4>,
        /// Output register of the filled one.
        pub held: L::U<7>,
        one: L::ShiftRegister<1, 3>,
        two: L::ShiftRegister<2, 1>,
        five: L::ShiftRegister<5, 33>,
        eight: L::ShiftRegister<8, 4>,
        /// Filled at power-on, moves in every tick.
        turning: L::ShiftRegister<8, 2>,
    }
}

signals! {
    /// What is read.
    pub struct Net<L> {
        pub read_empty: L::U<33>,
        pub read_sum: L::U<33>,
        pub read_low: L::U<7>,
        pub flag: L::U<1>,
        pub flag_fixed: L::Bit,
        pub read_fixed: L::U<64> as Hex,
        pub read_always: L::U<4>,
        pub stage_one: L::U<3>,
        pub stage_first: L::U<33>,
        pub stage_last: L::U<33>,
        pub stage_over: L::U<33>,
        pub stage_bit: L::Bit,
        pub tap_one: L::U<3>,
        pub tap_two: L::U<1>,
        pub tap_narrow: L::U<33>,
        pub tap_exact: L::U<33>,
        pub tap_wide: L::U<33>,
        pub tap_all: L::U<4>,
        pub tap_all_narrow: L::U<4>,
        pub tap_all_wide: L::U<4>,
        pub tap_sum: L::U<4>,
        pub turned: L::U<2>,
        pub rom_word: L::U<9>,
        pub rom_other: L::U<9>,
        pub rom_same: L::U<9>,
        pub rom_zero: L::U<9>,
        pub rom_wide: L::U<12>,
    }
}

/// Memories with these contents.
#[derive(Debug)]
pub struct Memories {
    pub power_on: Image<3, 7>,
    pub table: Image<3, 9>,
    pub other: Image<3, 9>,
    pub wide: Image<3, 12>,
}

impl Memories {
    pub fn new(seed: u64) -> Self {
        let words = |step: u64| (0..8).map(move |word| seed * 37 + word * step);
        Memories {
            power_on: Image::new(words(11)),
            table: Image::new(words(53)),
            other: Image::new(words(91)),
            wide: Image::new(words(53).map(|word| word & 511)),
        }
    }
}

impl Circuit for Memories {
    const NAME: &'static str = "memories";
    const ABOUT: &'static str = "memories of every kind";
    type In<L: Logic> = In<L>;
    type Reg<L: Logic> = Reg<L>;
    type Net<L: Logic> = Net<L>;

    fn comb<L: Logic>(&self, q: &Reg<L>, i: &In<L>) -> Net<L> {
        let low: L::U<2> = i.tap.resize();
        let exact: L::U<3> = i.tap.resize();
        Net {
            read_empty: q.empty.read(i.address),
            read_sum: q.empty.read(i.address + 1) + q.empty.read(2.into()),
            read_low: q.filled.read(i.other.resize()),
            flag: q.flags.read(i.other),
            flag_fixed: q.flags.read(3.into()).bit(0),
            read_fixed: q.fixed.read(i.read.word()),
            read_always: q.steady.read(i.read.word() + i.write.word()),
            stage_one: q.one.stage(0),
            stage_first: q.five.stage(0),
            stage_last: q.five.stage(4),
            stage_over: q.five.stage(5),
            stage_bit: q.two.stage(1).bit(0),
            tap_one: q.one.tap(exact),
            tap_two: q.two.tap(i.read.word()),
            tap_narrow: q.five.tap(low),
            tap_exact: q.five.tap(exact),
            tap_wide: q.five.tap(i.tap),
            tap_all: q.eight.tap(exact),
            tap_all_narrow: q.eight.tap(low),
            tap_all_wide: q.eight.tap(i.tap),
            tap_sum: q.eight.tap(i.tap - 3),
            turned: q.turning.stage(7),
            rom_word: self.table.read::<L>(i.address),
            rom_other: self.other.read::<L>(i.address),
            rom_same: self.table.clone().read::<L>(i.other.resize()),
            rom_zero: Image::<3, 9>::zeroed().read::<L>(i.address),
            rom_wide: self.wide.read::<L>(i.address),
        }
    }

    fn next<L: Logic>(&self, q: Reg<L>, w: &Net<L>, i: &In<L>) -> Reg<L> {
        let turned = q.turning.stage(7);
        Reg {
            held: q.filled.read_when(i.read, i.address, q.held),
            empty: q.empty.write(i.write, i.address, i.data),
            filled: q
                .filled
                .write(i.write & !i.read, (i.other - 1).resize(), i.data.resize()),
            flags: q.flags.write(i.write, i.other + 9, i.read.word()),
            fixed: q.fixed,
            steady: q.steady.write(true.into(), i.write.word(), w.tap_all),
            one: q.one.shift(i.write, i.data.resize()),
            two: q.two.shift(i.read, i.write.word()),
            five: q.five.shift(i.write | i.read, i.data),
            eight: q.eight.shift(w.flag_fixed, i.data.resize()),
            turning: q.turning.shift(true.into(), turned),
        }
    }

    fn power_on(&self) -> Reg<Sim> {
        Reg {
            empty: Image::zeroed().into(),
            filled: self.power_on.clone().into(),
            flags: Image::new((0..32).map(|word| word % 3)).into(),
            fixed: Image::new([u64::MAX, 0x0123_4567_89ab_cdef]).into(),
            steady: Image::zeroed().into(),
            held: 0x55.into(),
            one: SimShiftRegister::new([5]),
            two: SimShiftRegister::new([]),
            five: SimShiftRegister::new([]),
            eight: SimShiftRegister::new(1..),
            turning: SimShiftRegister::new([3, 1, 2]),
        }
    }
}
