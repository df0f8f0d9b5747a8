//! Constants and indices that do not fit their words are mistakes.

use super::*;
use motion_rtl::sim::RunError;

/// Circuit with a constant in every place where one can be.
#[derive(Debug, Clone)]
struct Constants {
    /// Constant for all unsigned words.
    u: u64,
    /// Constant for all signed words.
    i: i64,
    /// Index for all words.
    index: usize,
    image: Image,
}

const CONSTANTS: u32 = line!();
signals! { for Constants as c;
    /// Ports in.
    pub struct ConstantsIn {
        /// A bit.
        go: Bit,
    }
    /// Registers.
    pub struct ConstantsReg {
        /// Unsigned.
        count: U(6) = c.u,
        /// Signed.
        shift: I(6) = c.i,
        /// Latest word.
        line: Shift(6, 4),
        /// A memory.
        store: Ram(2, 4) = &c.image,
    }
    /// The circuit inside.
    pub struct ConstantsParts {
        /// Memory with words of 4 bits.
        part: Part<Inside>(Inside { starts: c.u }),
    }
}

impl Circuit for Constants {
    const NAME: &'static str = "constants";
    const ABOUT: &'static str = "has a constant in every place";
    records!(ConstantsIn, ConstantsReg, Nothing, ConstantsParts);

    fn tick(
        &self,
        i: ConstantsIn,
        q: ConstantsReg,
        p: ConstantsParts,
    ) -> (Nothing, ConstantsReg<Edge>) {
        let count = (q.count + self.u) ^ (q.count & self.u);
        let count = count.below(self.u).mux(self.u, count);
        let count = count.equals(self.u).mux(count, self.u);
        let count = count | U::new(self.u, 6) | U::parameter("limit", self.u, 6);
        let shift = (q.shift - self.i).below(self.i).mux(self.i, q.shift);
        let shift = shift + I::new(self.i, 6);
        let bit = q.count.bit(self.index) & i.go;
        let slice = q.count.slice(self.index, 1).is_zero();
        let stage = q.line.stage(self.index);
        let rom = self.image.rom(q.count.slice(0, 2));
        p.part.settle(InsideIn { by: rom });
        let next = ConstantsReg {
            count: bit.mux(count, q.count),
            shift: slice.mux(shift, q.shift),
            line: q.line.shift(i.go, stage),
            store: q.store.keep(),
        };
        (Nothing, next)
    }
}

/// Circuit with a register whose power-on value the surrounding circuit gives.
#[derive(Debug, Clone)]
struct Inside {
    starts: u64,
}

signals! { for Inside as c;
    /// Ports in.
    pub struct InsideIn {
        /// Summand.
        by: U(4),
    }
    /// Registers.
    pub struct InsideReg {
        /// The sum.
        sum: U(6) = c.starts,
    }
}

impl Circuit for Inside {
    const NAME: &'static str = "adder";
    const ABOUT: &'static str = "adds up";
    records!(InsideIn, InsideReg, Nothing);

    fn tick(&self, i: InsideIn, q: InsideReg, _: Nothing) -> (Nothing, InsideReg<Edge>) {
        let sum = q.sum + i.by.resize(6);
        (Nothing, InsideReg { sum })
    }
}

fn constants(u: u64, i: i64, index: usize) -> Constants {
    let image = Image::new(2, 4);
    Constants { u, i, index, image }
}

#[test]
fn the_least_and_the_greatest_number_of_a_word_fit() {
    for (u, i, index) in [(0, -32, 0), (63, 31, 5)] {
        let mut simulator = Simulator::new(&constants(u, i, index)).unwrap();
        assert_eq!(simulator.see(|s| s.q.count), u);
        assert_eq!(simulator.see(|s| s.q.shift), i);
        assert_eq!(simulator.see(|s| s.p.part.q.sum), u);
    }
}

#[test]
fn unsigned_numbers_fit() {
    mistakes(
        &constants(64, 0, 0),
        CONSTANTS,
        &expect![[r#"
            constants.rs:1:1: constants: `count` at power-on: 64 does not fit 6 bits: 0 to 63
            constants.rs:36:21: constants: beside `count`, the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:36:42: constants: beside `count`, the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:37:27: constants: beside a bitwise operation, the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:37:41: constants: beside a bitwise operation, the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:38:27: constants: beside a choice, the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:38:42: constants: beside a choice, the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:39:29: constants: the constant 64 does not fit 6 bits: 0 to 63
            constants.rs:39:49: constants: parameter `limit`: 64 does not fit 6 bits: 0 to 63
            constants.rs:63:1: constants.part: `sum` at power-on: 64 does not fit 6 bits: 0 to 63
        "#]],
    );
}

#[test]
fn signed_numbers_fit() {
    mistakes(
        &constants(0, 32, 0),
        CONSTANTS,
        &expect![[r#"
            constants.rs:1:1: constants: `shift` at power-on: 32 does not fit 6 bits: -32 to 31
            constants.rs:40:21: constants: beside `shift`, the constant 32 does not fit 6 bits: -32 to 31
            constants.rs:40:40: constants: beside a difference, the constant 32 does not fit 6 bits: -32 to 31
            constants.rs:40:54: constants: beside `shift`, the constant 32 does not fit 6 bits: -32 to 31
            constants.rs:41:29: constants: the constant 32 does not fit 6 bits: -32 to 31
        "#]],
    );
    mistakes(
        &constants(0, -33, 0),
        CONSTANTS,
        &expect![[r#"
            constants.rs:1:1: constants: `shift` at power-on: -33 does not fit 6 bits: -32 to 31
            constants.rs:40:21: constants: beside `shift`, the constant -33 does not fit 6 bits: -32 to 31
            constants.rs:40:40: constants: beside a difference, the constant -33 does not fit 6 bits: -32 to 31
            constants.rs:40:54: constants: beside `shift`, the constant -33 does not fit 6 bits: -32 to 31
            constants.rs:41:29: constants: the constant -33 does not fit 6 bits: -32 to 31
        "#]],
    );
}

#[test]
fn indices_are_there() {
    mistakes(
        &constants(0, 0, 6),
        CONSTANTS,
        &expect![[r#"
            constants.rs:42:27: constants: bit 6 of `count`, which has 6 bits
            constants.rs:43:29: constants: bits 6 down to 6 of `count`, which has 6 bits
            constants.rs:44:28: constants: stage 6 of `line`, which has 0 to 5
        "#]],
    );
}

#[test]
fn a_negative_power_on_value_is_none_of_an_unsigned_word() {
    #[derive(Debug, Clone)]
    struct Negative;
    signals! { for Negative as _c; pub struct NegativeReg { count: U(64) = -1 } }
    impl Circuit for Negative {
        const NAME: &'static str = "negative";
        const ABOUT: &'static str = "begins below zero";
        records!(Nothing, NegativeReg, Nothing);
        fn tick(&self, _: Nothing, q: NegativeReg, _: Nothing) -> (Nothing, NegativeReg<Edge>) {
            (Nothing, NegativeReg { count: q.count })
        }
    }
    let wrong = elaborate(&Negative).unwrap_err().to_string();
    let what = "`count` at power-on: -1 does not fit 64 bits: 0 to 18446744073709551615";
    assert!(wrong.ends_with(what), "{wrong}");
}

const IMAGES: u32 = line!();
fn images() -> [Image; 4] {
    let mut set = Image::new(2, 4);
    set.set(3, 15);
    set.set(2, 16);
    let mut out = Image::new(2, 4);
    out.set(4, 1);
    let made = Image::from_fn(2, 4, |word| 7 * word as u64);
    let of = Image::of(2, 4, [1, 2, 3, 4, 5]);
    [set, out, made, of]
}

#[test]
fn contents_of_memories_fit() {
    let expected = [
        expect![[r#"
            constants.rs:4:9: constants: memory `store` at power-on: word 2: 16 does not fit 4 bits: 0 to 15
            constants.rs:4:9: constants: contents of a ROM: word 2: 16 does not fit 4 bits: 0 to 15
        "#]],
        expect![[r#"
            constants.rs:6:9: constants: memory `store` at power-on: word 4: there are 4 words, counted from 0
            constants.rs:6:9: constants: contents of a ROM: word 4: there are 4 words, counted from 0
        "#]],
        expect![[r#"
            constants.rs:7:16: constants: memory `store` at power-on: word 3: 21 does not fit 4 bits: 0 to 15
            constants.rs:7:16: constants: contents of a ROM: word 3: 21 does not fit 4 bits: 0 to 15
        "#]],
        expect![[r#"
            constants.rs:8:14: constants: memory `store` at power-on: word 4: there are 4 words, counted from 0
            constants.rs:8:14: constants: contents of a ROM: word 4: there are 4 words, counted from 0
        "#]],
    ];
    for (image, expected) in images().into_iter().zip(expected) {
        let circuit = Constants {
            image,
            ..constants(0, 0, 0)
        };
        mistakes(&circuit, IMAGES, &expected);
    }
    let fits = Image::from_fn(2, 4, |word| 5 * word as u64);
    let image = Image::of(2, 4, fits.iter());
    assert_eq!((image.get(3), image.get(4)), (Some(15), None));
    elaborate(&Constants {
        image,
        ..constants(0, 0, 0)
    })
    .unwrap();
}

#[test]
fn numbers_are_cut_on_purpose() {
    assert_eq!([100u64.cut(6), 63u64.cut(6), 64u64.cut(6)], [36, 63, 0]);
    assert_eq!(
        [u64::MAX.cut(64), u64::MAX.cut(1), 5u64.cut(0)],
        [u64::MAX, 1, 0]
    );
    assert_eq!(
        [32i64.cut(6), -33i64.cut(6), -1i64.cut(6)],
        [-32, -33i64.cut(6), -1]
    );
    assert_eq!((-33i64).cut(6), 31);
    assert_eq!(
        [i64::MIN.cut(64), 1i64.cut(1), 1i64.cut(0)],
        [i64::MIN, -1, 0]
    );
    elaborate(&constants(100u64.cut(6), 100i64.cut(6), 5)).unwrap();
}

#[test]
fn all_mistakes_are_printed_a_line_each() {
    let error = elaborate(&constants(64, 32, 6)).unwrap_err();
    let lines = error.0.len();
    assert!(lines > 10);
    let text = error.to_string();
    assert_eq!(text.lines().count(), lines);
    assert_eq!(format!("{error:?}"), text);
    let error = Simulator::new(&constants(64, 32, 6)).unwrap_err();
    assert_eq!(format!("{error:?}"), text);
    // `main` returns such a box, and `unwrap` prints it.
    let boxed: Box<dyn std::error::Error> = RunError::from(error).into();
    assert_eq!(format!("{boxed:?}"), text);
}

/// Circuit with names that Verilog or SystemVerilog reserves.
#[derive(Debug, Clone)]
struct Reserved;

const RESERVED: u32 = line!();
signals! { for Reserved as c;
    /// A bundle.
    pub struct ReservedBundle {
        /// Field whose flat name is a keyword.
        or: Bit,
    }
    /// Ports in.
    pub struct ReservedIn {
        /// Keyword of Verilog.
        pub wire: Bit,
        /// Reserved for the clock.
        pub clk: Bit,
        /// No keyword, but one after its scope is stripped.
        pub this_: ReservedBundle(c),
        /// Array whose elements have names.
        pub several: [Bit; 2] as Elements(&["one", "xor"]),
    }
    /// Registers.
    pub struct ReservedReg {
        /// Keyword of SystemVerilog.
        before: Bit,
        /// A memory.
        buf: Ram(2, 4),
    }
    /// The circuit inside.
    pub struct ReservedParts {
        /// A part.
        cell: Part<Inside>(Inside { starts: 0 }),
    }
    /// Nets.
    pub struct ReservedNet {
        /// Signal with the name of its circuit.
        module: Bit,
        /// A name without fault.
        fine: Bit,
    }
}

impl Circuit for Reserved {
    const NAME: &'static str = "module";
    const ABOUT: &'static str = "is called as Verilog calls something else";
    records!(ReservedIn, ReservedReg, ReservedNet, ReservedParts);

    fn tick(
        &self,
        i: ReservedIn,
        q: ReservedReg,
        p: ReservedParts,
    ) -> (ReservedNet, ReservedReg<Edge>) {
        let by = q.buf.read(U::new(0, 2));
        p.cell.settle(InsideIn { by });
        let net = ReservedNet {
            module: i.wire,
            fine: i.clk,
        };
        let next = ReservedReg {
            before: q.before,
            buf: q.buf.keep(),
        };
        (net, next)
    }
}

#[test]
fn words_of_verilog_are_no_names() {
    mistakes(
        &Reserved,
        RESERVED,
        &expect![[r#"
            constants.rs:1:1: module: `module` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: `wire` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: `clk` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: `xor` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: `before` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: `buf` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: `cell` is a word of Verilog or SystemVerilog, or kept for clock and reset
            constants.rs:1:1: module: the name `module` is used twice
        "#]],
    );
}
