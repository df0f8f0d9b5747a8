//! Constants in VHDL.

use super::expression::{Rank, Text};
use crate::netlist::{Kind, Shape};

/// Returns the number of a constant, if VHDL has it as an integer.
pub(super) fn number(bits: u64, shape: Shape) -> Option<i64> {
    let unused = 64 - shape.width.clamp(1, 64);
    let number = match shape.kind {
        Kind::Bit => return None,
        Kind::Unsigned => i64::try_from(bits).ok()?,
        Kind::Signed => (bits << unused).cast_signed() >> unused,
    };
    // The least integer of some tools is above -2^31.
    (number.unsigned_abs() <= i32::MAX as u64).then_some(number)
}

/// Returns the bits of a word as a string.
pub(super) fn string(bits: u64, width: usize) -> String {
    let digits = width.div_ceil(4);
    match width % 4 {
        0 => format!("x\"{bits:0digits$x}\""),
        _ => format!("{width}x\"{bits:0digits$x}\""),
    }
}

/// Returns a constant with its type.
pub(super) fn typed(bits: u64, shape: Shape) -> Text {
    let Shape { kind, width } = shape;
    Text::atom(match (kind, number(bits, shape)) {
        (Kind::Bit, _) => format!("'{bits}'"),
        (Kind::Unsigned, Some(number)) => format!("to_unsigned({number}, {width})"),
        (Kind::Signed, Some(number)) => format!("to_signed({number}, {width})"),
        (Kind::Unsigned, None) => format!("unsigned'({})", string(bits, width)),
        (Kind::Signed, None) => format!("signed'({})", string(bits, width)),
    })
}

/// Returns a constant that a signal of its shape takes.
pub(super) fn assigned(bits: u64, shape: Shape) -> String {
    match (shape.kind, bits) {
        (Kind::Unsigned | Kind::Signed, 0) => "(others => '0')".to_owned(),
        _ => typed(bits, shape).0,
    }
}

/// Returns a constant beside a word of its shape: a number, if it is one.
pub(super) fn beside(bits: u64, shape: Shape) -> Text {
    match number(bits, shape) {
        Some(number) if number < 0 => Text(number.to_string(), Rank::Sign),
        Some(number) => Text::atom(number.to_string()),
        None => typed(bits, shape),
    }
}

#[cfg(test)]
mod tests {
    use super::{assigned, beside, typed};
    use crate::netlist::{BIT, signed, unsigned};

    #[test]
    fn constants_of_every_width() {
        for (bits, shape, expected) in [
            (1, BIT, "'1'"),
            (0, unsigned(4), "to_unsigned(0, 4)"),
            (0x7fff_ffff, unsigned(31), "to_unsigned(2147483647, 31)"),
            (0x8000_0000, unsigned(32), "unsigned'(x\"80000000\")"),
            (0x15, unsigned(42), "to_unsigned(21, 42)"),
            (1 << 41, unsigned(42), "unsigned'(42x\"20000000000\")"),
            (0xd, signed(4), "to_signed(-3, 4)"),
            (1 << 31, signed(32), "signed'(x\"80000000\")"),
            (u64::MAX, signed(64), "to_signed(-1, 64)"),
            (u64::MAX, unsigned(64), "unsigned'(x\"ffffffffffffffff\")"),
        ] {
            assert_eq!(typed(bits, shape).0, expected);
        }
        assert_eq!(assigned(0, signed(4)), "(others => '0')");
        assert_eq!(assigned(0, BIT), "'0'");
        assert_eq!(assigned(15, signed(4)), "to_signed(-1, 4)");
        assert_eq!(beside(15, signed(4)).0, "-1");
        assert_eq!(beside(15, unsigned(4)).0, "15");
    }
}
