//! Arithmetic of lines: the result of an operation on words that change linearly.

use crate::engine::flat::mask;
use crate::engine::value::signed;

/// Word over the ticks from now on: `value + slope * k` modulo 2^width in tick k.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Line {
    pub value: u64,
    /// Change per tick, modulo 2^width.
    pub slope: u64,
}

/// Returns the number of ticks in which a word that moves by `speed` per tick stays within `room`.
pub(super) fn within(room: u64, speed: u64) -> u64 {
    let steps = if speed == 1 { room } else { room / speed };
    steps.saturating_add(1)
}

/// Operations on lines. If the result is a line for a limited time only, `until` is lowered to
/// that number of ticks.
impl Line {
    /// Returns a constant word.
    pub fn still(value: u64) -> Line {
        Line { value, slope: 0 }
    }

    pub fn is_still(self) -> bool {
        self.slope == 0
    }

    /// Returns the number of ticks before the word passes the end of the unsigned range.
    fn unsigned_end(self, width: u8) -> u64 {
        match signed(self.slope, width) {
            0 => u64::MAX,
            speed @ 1.. => within(mask(width) - self.value, speed as u64),
            speed => within(self.value, speed.unsigned_abs()),
        }
    }

    /// Returns the two's complement words counted from the lowest.
    fn lifted(self, width: u8) -> Line {
        Line {
            value: (self.value ^ (1 << (width - 1))) & mask(width),
            ..self
        }
    }

    /// Cuts the line to `width` bits.
    pub fn low(self, width: u8) -> Line {
        Line {
            value: self.value & mask(width),
            slope: self.slope & mask(width),
        }
    }

    pub fn not(self, width: u8) -> Line {
        Line {
            value: !self.value,
            slope: self.slope.wrapping_neg(),
        }
        .low(width)
    }

    pub fn negate(self, width: u8) -> Line {
        Line {
            value: self.value.wrapping_neg(),
            slope: self.slope.wrapping_neg(),
        }
        .low(width)
    }

    pub fn add(self, other: Line, width: u8) -> Line {
        Line {
            value: self.value.wrapping_add(other.value),
            slope: self.slope.wrapping_add(other.slope),
        }
        .low(width)
    }

    pub fn subtract(self, other: Line, width: u8) -> Line {
        Line {
            value: self.value.wrapping_sub(other.value),
            slope: self.slope.wrapping_sub(other.slope),
        }
        .low(width)
    }

    pub fn multiply(self, other: Line, width: u8, until: &mut u64) -> Line {
        let slope = if other.is_still() {
            self.slope.wrapping_mul(other.value)
        } else if self.is_still() {
            other.slope.wrapping_mul(self.value)
        } else {
            *until = 1;
            0
        };
        Line {
            value: self.value.wrapping_mul(other.value),
            slope,
        }
        .low(width)
    }

    pub fn shift_left(self, by: u8, width: u8) -> Line {
        let shift = |word: u64| word.checked_shl(by.into()).unwrap_or(0);
        Line {
            value: shift(self.value),
            slope: shift(self.slope),
        }
        .low(width)
    }

    /// Returns the bits from `by` up of a word of `from` bits; `by` must be below `from`.
    pub fn high(self, by: u8, from: u8, until: &mut u64) -> Line {
        let rest = (1 << by) - 1;
        let value = self.value >> by;
        if self.slope & rest == 0 {
            // Lower bits never carry.
            let slope = self.slope >> by;
            return Line { value, slope };
        }
        let below = self.value & rest;
        let carry = match signed(self.slope, from) {
            speed @ 1.. => within(rest - below, speed as u64),
            speed => within(below, speed.unsigned_abs()),
        };
        *until = carry.min(*until);
        Line::still(value)
    }

    /// Returns `width` bits from `by` up.
    pub fn slice(self, by: u8, from: u8, width: u8, until: &mut u64) -> Line {
        if by >= from {
            return Line::still(self.value.checked_shr(by.into()).unwrap_or(0)).low(width);
        }
        self.high(by, from, until).extend(from - by, width, until)
    }

    pub fn shift_right_signed(self, by: u8, from: u8, width: u8, until: &mut u64) -> Line {
        let by = by.min(from - 1);
        let line = self.high(by, from, until);
        line.extend_signed(from - by, width, until)
    }

    /// Zero-extends or cuts.
    pub fn extend(self, from: u8, width: u8, until: &mut u64) -> Line {
        if self.is_still() || width <= from {
            return self.low(width);
        }
        *until = self.unsigned_end(from).min(*until);
        Line {
            slope: signed(self.slope, from) as u64,
            ..self
        }
        .low(width)
    }

    /// Sign-extends or cuts.
    pub fn extend_signed(self, from: u8, width: u8, until: &mut u64) -> Line {
        let value = signed(self.value, from) as u64;
        if self.is_still() || width <= from {
            return Line { value, ..self }.low(width);
        }
        *until = self.lifted(from).unsigned_end(from).min(*until);
        Line {
            value,
            slope: signed(self.slope, from) as u64,
        }
        .low(width)
    }

    /// Concatenates the line above another of `by` bits.
    pub fn join(self, low: Line, by: u8, width: u8, until: &mut u64) -> Line {
        let low = low.extend(by, width, until);
        self.shift_left(by, width).add(low, width)
    }

    pub fn and(self, other: Line, width: u8, until: &mut u64) -> Line {
        let (line, with) = match other.is_still() {
            true => (self, other),
            false => (other, self),
        };
        let value = line.value & with.value;
        if line.is_still() {
            return Line::still(value);
        }
        let first = with.value.trailing_zeros() as u8;
        if !with.is_still() || first >= width {
            *until = 1;
            return Line::still(value);
        }
        let bits = with.value.trailing_ones() as u8;
        if bits > 0 && with.value == mask(bits) {
            let bits = bits.min(width);
            return line.low(bits).extend(bits, width, until);
        }
        // Constant while none of these bits changes.
        if !line.high(first, width, until).is_still() {
            *until = 1;
        }
        Line::still(value)
    }

    pub fn or(self, other: Line, width: u8, until: &mut u64) -> Line {
        let neither = self.not(width).and(other.not(width), width, until);
        neither.not(width)
    }

    pub fn xor(self, other: Line, width: u8, until: &mut u64) -> Line {
        let (line, with) = match other.is_still() {
            true => (self, other),
            false => (other, self),
        };
        let value = line.value ^ with.value;
        if line.is_still() || with == Line::still(0) {
            return Line { value, ..line };
        }
        if with == Line::still(mask(width)) {
            return line.not(width);
        }
        if with == Line::still(1 << (width - 1)) {
            // Inverting the sign is an addition.
            return Line { value, ..line };
        }
        *until = 1;
        Line::still(value)
    }

    /// Compares two words of `width` bits for equality.
    pub fn equal(self, other: Line, width: u8, until: &mut u64) -> Line {
        let apart = self.subtract(other, width);
        if !apart.is_still() {
            *until = apart.meeting(width).min(*until);
        }
        Line::still(u64::from(apart.value == 0))
    }

    /// Returns the number of ticks in which a moving word stays zero, or stays nonzero.
    pub fn meeting(self, width: u8) -> u64 {
        let Line { value, slope } = self;
        if value == 0 {
            return 1;
        }
        let zeros = slope.trailing_zeros();
        match signed(slope, width) {
            1 => return value.wrapping_neg() & mask(width),
            -1 => return value,
            _ if value.trailing_zeros() < zeros => return u64::MAX,
            _ => {}
        }
        // Smallest k with value + slope * k = 0 modulo 2^width.
        let odd = slope >> zeros;
        let mut inverse = odd;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(odd.wrapping_mul(inverse)));
        }
        let distance = (value >> zeros).wrapping_neg();
        distance.wrapping_mul(inverse) & (mask(width) >> zeros)
    }

    /// True if the word is less than another, both of `width` bits.
    pub fn below(self, other: Line, width: u8, until: &mut u64) -> Line {
        let below = self.value < other.value;
        if self.is_still() && other.is_still() {
            return Line::still(below.into());
        }
        let ends = self.unsigned_end(width).min(other.unsigned_end(width));
        let (mine, its) = (signed(self.slope, width), signed(other.slope, width));
        let crossing = if below {
            // Stop when it has made up the distance.
            match faster(mine, its) {
                0 => u64::MAX,
                speed => within(other.value - self.value - 1, speed),
            }
        } else {
            match faster(its, mine) {
                0 => u64::MAX,
                speed => within(self.value - other.value, speed),
            }
        };
        *until = crossing.min(ends).min(*until);
        Line::still(below.into())
    }

    /// Compares in two's complement.
    pub fn below_signed(self, other: Line, width: u8, until: &mut u64) -> Line {
        let (mine, its) = (self.lifted(width), other.lifted(width));
        mine.below(its, width, until)
    }
}

/// Returns how much faster the first goes up than the second; 0 if it does not.
pub(super) fn faster(first: i64, second: i64) -> u64 {
    if first > second {
        first.abs_diff(second)
    } else {
        0
    }
}
