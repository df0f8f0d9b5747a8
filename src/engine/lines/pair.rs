//! The arithmetic of lines: what an operation makes of words that move by the same step in every
//! tick.

use crate::engine::flat::mask;
use crate::engine::value::signed;

/// A word over the ticks from now on: `value + slope * k` modulo 2^width in tick k.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Line {
    pub value: u64,
    /// The step of a tick, modulo 2^width.
    pub slope: u64,
}

/// Ticks in which a word stays within so much room, if it moves by so much a tick.
fn within(room: u64, speed: u64) -> u64 {
    let steps = if speed == 1 { room } else { room / speed };
    steps.saturating_add(1)
}

/// Where an operation is no line for good, it lowers `until` to the number of ticks in which it is.
impl Line {
    /// A word that stays as it is.
    pub fn still(value: u64) -> Line {
        Line { value, slope: 0 }
    }

    pub fn is_still(self) -> bool {
        self.slope == 0
    }

    /// Ticks before it passes the end of the unsigned words.
    fn unsigned_end(self, width: u8) -> u64 {
        match signed(self.slope, width) {
            0 => u64::MAX,
            speed @ 1.. => within(mask(width) - self.value, speed as u64),
            speed => within(self.value, speed.unsigned_abs()),
        }
    }

    /// The same words in two's complement, counted from the lowest on.
    fn lifted(self, width: u8) -> Line {
        Line {
            value: (self.value ^ (1 << (width - 1))) & mask(width),
            ..self
        }
    }

    /// Only so many bits of it.
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

    /// Of a word of `from` bits those from `by` up, which is less than `from`.
    fn high(self, by: u8, from: u8, until: &mut u64) -> Line {
        let rest = (1 << by) - 1;
        let value = self.value >> by;
        if self.slope & rest == 0 {
            // Nothing is ever carried from below.
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

    /// So many bits from `by` up.
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

    /// Zeros above, or fewer bits.
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

    /// The sign above, or fewer bits.
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

    /// Above another one of `by` bits.
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
        // It stays as it is while none of these bits does anything.
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
            // The sign turned over is a sum.
            return Line { value, ..line };
        }
        *until = 1;
        Line::still(value)
    }

    /// Whether both words, of so many bits, are the same.
    pub fn equal(self, other: Line, width: u8, until: &mut u64) -> Line {
        let apart = self.subtract(other, width);
        if !apart.is_still() {
            *until = apart.meeting(width).min(*until);
        }
        Line::still(u64::from(apart.value == 0))
    }

    /// Ticks in which a word that moves stays zero, or stays something else.
    fn meeting(self, width: u8) -> u64 {
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
        // The first k with value + slope * k = 0 modulo 2^width.
        let odd = slope >> zeros;
        let mut inverse = odd;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(odd.wrapping_mul(inverse)));
        }
        let distance = (value >> zeros).wrapping_neg();
        distance.wrapping_mul(inverse) & (mask(width) >> zeros)
    }

    /// Whether it is less than another one, both of so many bits.
    pub fn below(self, other: Line, width: u8, until: &mut u64) -> Line {
        let below = self.value < other.value;
        if self.is_still() && other.is_still() {
            return Line::still(below.into());
        }
        let ends = self.unsigned_end(width).min(other.unsigned_end(width));
        let (mine, its) = (signed(self.slope, width), signed(other.slope, width));
        let crossing = if below {
            // It is no longer where it has made up for all of the distance.
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

    /// The same in two's complement.
    pub fn below_signed(self, other: Line, width: u8, until: &mut u64) -> Line {
        let (mine, its) = (self.lifted(width), other.lifted(width));
        mine.below(its, width, until)
    }
}

/// By how much the first goes up faster than the second; 0 where it does not.
fn faster(first: i64, second: i64) -> u64 {
    if first > second {
        first.abs_diff(second)
    } else {
        0
    }
}
