use wellen::BitVecRef;

/// Greatest width of a signal that is compared, in bits.
pub const WIDEST: u32 = 64;

/// Up to 64 bits of 0, 1, x and z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Value {
    /// Bits that are 1; among the unknown bits, those that are z.
    ones: u64,
    /// Bits that are x or z.
    unknown: u64,
}

fn mask(width: u32) -> u64 {
    u64::MAX.checked_shr(WIDEST - width).unwrap_or(0)
}

impl Value {
    /// Single bit that is 1.
    pub const HIGH: Self = Value {
        ones: 1,
        unknown: 0,
    };

    /// Returns a value with all bits x.
    pub fn unknown(width: u32) -> Self {
        Value {
            ones: 0,
            unknown: mask(width),
        }
    }

    /// Reads `width` bits from bit `low` up.
    pub fn read(bits: BitVecRef<'_>, low: u32, width: u32) -> Self {
        if let Some(bytes) = bits.be_bytes()
            && bytes.len() <= 8
        {
            // The first byte may contain bits that do not belong to the value.
            let all = bytes
                .iter()
                .fold(0, |all, &byte| all << 8 | u64::from(byte));
            return Value {
                ones: all >> low & mask(width),
                unknown: 0,
            };
        }
        let mut value = Value {
            ones: 0,
            unknown: 0,
        };
        for bit in (low..low + width).rev() {
            // Strengths are ignored: h is 1, l is 0.
            let (one, unknown) = match bits.get_bit(bit).as_ascii() {
                '0' | 'l' => (0, 0),
                '1' | 'h' => (1, 0),
                'z' => (1, 1),
                _ => (0, 1),
            };
            value.ones = value.ones << 1 | one;
            value.unknown = value.unknown << 1 | unknown;
        }
        value
    }

    /// Inverts the known bits.
    pub fn inverted(self, width: u32) -> Self {
        Value {
            ones: self.ones ^ (mask(width) & !self.unknown),
            ..self
        }
    }

    /// Returns the bits, if all of them are 0 or 1.
    pub fn known(self) -> Option<u64> {
        self.is_known().then_some(self.ones)
    }

    pub fn is_known(self) -> bool {
        self.unknown == 0
    }

    /// Formats the value for a table: hexadecimal, or binary if a bit is unknown.
    pub fn cell(self, width: u32) -> String {
        if self.is_known() {
            let digits = width.div_ceil(4) as usize;
            return format!("{:0digits$x}", self.ones);
        }
        let bit = |at: u32| match (self.unknown >> at & 1, self.ones >> at & 1) {
            (0, 0) => '0',
            (0, _) => '1',
            (_, 0) => 'x',
            _ => 'z',
        };
        (0..width).rev().map(bit).collect()
    }

    /// Formats the value alone: with its base, and in decimal.
    pub fn shown(self, width: u32) -> String {
        match (self.is_known(), width) {
            (_, 1) => self.cell(1),
            (true, _) => format!("0x{} = {}", self.cell(width), self.ones),
            (false, _) => format!("0b{}", self.cell(width)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_shown_in_hex_and_where_a_bit_is_unknown_in_binary() {
        let value = Value {
            ones: 0b1_0010,
            unknown: 0b0_0110,
        };
        assert_eq!(value.cell(5), "10xz0");
        assert_eq!(value.shown(5), "0b10xz0");
        assert_eq!(value.inverted(5).cell(5), "01xz1");
        let known = Value {
            ones: 0x2a,
            unknown: 0,
        };
        assert_eq!(known.shown(9), "0x02a = 42");
        assert_eq!(Value::unknown(1).shown(1), "x");
        assert_eq!(Value::unknown(64).unknown, u64::MAX);
    }
}
