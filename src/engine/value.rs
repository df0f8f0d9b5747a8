//! Value of a node from the values of its operands: the meaning that every backend has.

use super::flat::{Id, Node, Op, mask};

/// Returns the value of a node that is not an input port, register or memory word; `operand`
/// returns value and width of an operand.
pub fn of(node: Node, operand: impl Fn(Id) -> (u64, u8)) -> u64 {
    let word = |id| operand(id).0;
    let value = match node.op {
        Op::Constant(bits) => bits,
        Op::Input(_) | Op::Register(_) | Op::Read(..) => 0,
        Op::Not(a) => !word(a),
        Op::Negate(a) => word(a).wrapping_neg(),
        Op::Add(a, b) => word(a).wrapping_add(word(b)),
        Op::Subtract(a, b) => word(a).wrapping_sub(word(b)),
        Op::Multiply(a, b) => word(a).wrapping_mul(word(b)),
        Op::And(a, b) => word(a) & word(b),
        Op::Or(a, b) => word(a) | word(b),
        Op::Xor(a, b) => word(a) ^ word(b),
        Op::Equal(a, b) => (word(a) == word(b)).into(),
        Op::Below(a, b) => (word(a) < word(b)).into(),
        Op::BelowSigned(a, b) => {
            let ((a, width), b) = (operand(a), word(b));
            (signed(a, width) < signed(b, width)).into()
        }
        Op::Mux(choose, then, other) => match word(choose) {
            0 => word(other),
            _ => word(then),
        },
        Op::ShiftLeft(a, by) => word(a).checked_shl(by.into()).unwrap_or(0),
        Op::ShiftRight(a, by) | Op::Slice(a, by) => word(a).checked_shr(by.into()).unwrap_or(0),
        Op::ShiftRightSigned(a, by) => {
            let (a, width) = operand(a);
            (signed(a, width) >> by.min(63)) as u64
        }
        Op::Extend(a) => word(a),
        Op::ExtendSigned(a) => {
            let (a, width) = operand(a);
            signed(a, width) as u64
        }
        Op::Join(high, low) => {
            let (low, width) = operand(low);
            word(high).checked_shl(width.into()).unwrap_or(0) | low
        }
    };
    value & mask(node.width)
}

/// Reads the low `width` bits of a word as two's complement.
#[inline]
pub(crate) const fn signed(word: u64, width: u8) -> i64 {
    let spare = 64 - width as u32;
    (word << spare) as i64 >> spare
}
