//! Memories of every kind, read and written in every way.

use motion_rtl::prelude::*;

/// Memories with these contents.
#[derive(Debug, Clone)]
pub struct Memories {
    pub power_on: Image,
    pub table: Image,
    pub other: Image,
    pub wide: Image,
}

impl Memories {
    pub fn new(seed: u64) -> Self {
        let words =
            |step: u64, width: usize| (0..8).map(move |word| (seed * 37 + word * step).cut(width));
        Memories {
            power_on: Image::of(3, 7, words(11, 7)),
            table: Image::of(3, 9, words(53, 9)),
            other: Image::of(3, 9, words(91, 9)),
            wide: Image::of(3, 12, words(53, 9)),
        }
    }
}

/// What the memory of flags holds.
fn flags() -> Image {
    Image::of(5, 1, (0..32).map(|word: u64| (word % 3).cut(1)))
}

/// What the memory holds that is never written.
fn fixed() -> Image {
    Image::of(1, 64, [u64::MAX, 0x0123_4567_89ab_cdef])
}

signals! { for Memories as c;
    /// Ports in.
    pub struct In {
        pub read: Bit,
        pub write: Bit,
        pub address: U(3) as Hex,
        pub other: U(5),
        pub data: U(33),
        pub tap: U(8),
    }
    /// Memories, and a register for what is read.
    pub struct Reg {
        /// Empty at power-on.
        empty: Ram(3, 33),
        /// Filled at power-on.
        filled: Ram(3, 7) = &c.power_on,
        /// Words of one bit.
        flags: Ram(5, 1) = &flags(),
        /// Never written.
        fixed: Ram(1, 64) = &fixed(),
        /// Written in every tick.
        steady: Ram(1, 4),
        /// Output register of the filled one.
        pub held: U(7) = 0x55,
        one: Shift(1, 3),
        two: Shift(2, 1),
        five: Shift(5, 33),
        eight: Shift(8, 4),
        /// Moves in every tick.
        turning: Shift(8, 2),
    }
    /// What is read.
    pub struct Net {
        pub read_empty: U(33),
        pub read_sum: U(33),
        pub read_low: U(7),
        pub flag: U(1),
        pub flag_fixed: Bit,
        pub read_fixed: U(64) as Hex,
        pub read_always: U(4),
        pub stage_one: U(3),
        pub stage_first: U(33),
        pub stage_last: U(33),
        pub stage_bit: Bit,
        pub tap_one: U(3),
        pub tap_two: U(1),
        pub tap_narrow: U(33),
        pub tap_exact: U(33),
        pub tap_wide: U(33),
        pub tap_all: U(4),
        pub tap_all_narrow: U(4),
        pub tap_all_wide: U(4),
        pub tap_sum: U(4),
        pub turned: U(2),
        pub rom_word: U(9),
        pub rom_other: U(9),
        pub rom_same: U(9),
        pub rom_zero: U(9),
        pub rom_wide: U(12),
    }
}

impl Circuit for Memories {
    const NAME: &'static str = "memories";
    const ABOUT: &'static str = "memories of every kind";
    records!(In, Reg, Net);

    fn tick(&self, i: In, q: Reg, _: Nothing) -> (Net, Reg<Edge>) {
        let low = i.tap.resize(2);
        let exact = i.tap.resize(3);
        let turned = q.turning.stage(7);
        let net = Net {
            read_empty: q.empty.read(i.address),
            read_sum: q.empty.read(i.address + 1) + q.empty.read(U::new(2, 3)),
            read_low: q.filled.read(i.other.resize(3)),
            flag: q.flags.read(i.other),
            flag_fixed: q.flags.read(U::new(3, 5)).bit(0),
            read_fixed: q.fixed.read(i.read.word()),
            read_always: q.steady.read(i.read.word() + i.write.word()),
            stage_one: q.one.stage(0),
            stage_first: q.five.stage(0),
            stage_last: q.five.stage(4),
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
            turned,
            rom_word: self.table.rom(i.address),
            rom_other: self.other.rom(i.address),
            rom_same: self.table.clone().rom(i.other.resize(3)),
            rom_zero: Image::new(3, 9).rom(i.address),
            rom_wide: self.wide.rom(i.address),
        };
        let low_data = |width| i.data.resize(width);
        let next = Reg {
            held: q.filled.read_when(i.read, i.address, q.held),
            empty: q.empty.write(i.write, i.address, i.data),
            filled: q
                .filled
                .write(i.write & !i.read, (i.other - 1).resize(3), low_data(7)),
            flags: q.flags.write(i.write, i.other + 9, i.read.word()),
            fixed: q.fixed.keep(),
            steady: q.steady.write(Bit::high(), i.write.word(), net.tap_all),
            one: q.one.shift(i.write, low_data(3)),
            two: q.two.shift(i.read, i.write.word()),
            five: q.five.shift(i.write | i.read, i.data),
            eight: q.eight.shift(net.flag_fixed, low_data(4)),
            turning: q.turning.shift(Bit::high(), turned + low_data(2)),
        };
        (net, next)
    }
}
