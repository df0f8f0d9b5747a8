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
    /// In how many ticks from now on it is sure to be so; at least 1.
    pub until: u64,
}

/// Ticks in which a word stays within so much room, if it moves by so much a tick.
fn within(room: u64, speed: u64) -> u64 {
    let steps = if speed == 1 { room } else { room / speed };
    steps.saturating_add(1)
}

impl Line {
    /// A word that stays as it is.
    pub fn still(value: u64) -> Line {
        Line {
            value,
            slope: 0,
            until: u64::MAX,
        }
    }

    /// A result that is the same for so many ticks.
    fn kept(value: u64, until: u64) -> Line {
        Line {
            value,
            slope: 0,
            until,
        }
    }

    pub fn is_still(&self) -> bool {
        self.slope == 0
    }

    /// Ticks before it passes the end of the unsigned words.
    fn unsigned_end(&self, width: u8) -> u64 {
        match signed(self.slope, width) {
            0 => u64::MAX,
            speed @ 1.. => within(mask(width) - self.value, speed as u64),
            speed => within(self.value, speed.unsigned_abs()),
        }
    }

    /// Ticks before it passes the end of the words of two's complement.
    fn signed_end(&self, width: u8) -> u64 {
        // From the lowest of them on they count like unsigned words.
        let value = self.value ^ (1 << (width - 1));
        Line { value, ..*self }.unsigned_end(width)
    }

    /// Only so many bits of it.
    pub fn low(self, width: u8) -> Line {
        Line {
            value: self.value & mask(width),
            slope: self.slope & mask(width),
            ..self
        }
    }

    pub fn not(self, width: u8) -> Line {
        Line {
            value: !self.value,
            slope: self.slope.wrapping_neg(),
            ..self
        }
        .low(width)
    }

    pub fn negate(self, width: u8) -> Line {
        Line {
            value: self.value.wrapping_neg(),
            slope: self.slope.wrapping_neg(),
            ..self
        }
        .low(width)
    }

    pub fn add(self, other: Line, width: u8) -> Line {
        Line {
            value: self.value.wrapping_add(other.value),
            slope: self.slope.wrapping_add(other.slope),
            until: self.until.min(other.until),
        }
        .low(width)
    }

    pub fn subtract(self, other: Line, width: u8) -> Line {
        Line {
            value: self.value.wrapping_sub(other.value),
            slope: self.slope.wrapping_sub(other.slope),
            until: self.until.min(other.until),
        }
        .low(width)
    }

    pub fn multiply(self, other: Line, width: u8) -> Line {
        let value = self.value.wrapping_mul(other.value);
        let until = self.until.min(other.until);
        let slope = if other.is_still() {
            self.slope.wrapping_mul(other.value)
        } else if self.is_still() {
            other.slope.wrapping_mul(self.value)
        } else {
            return Line::kept(value & mask(width), 1);
        };
        Line {
            value,
            slope,
            until,
        }
        .low(width)
    }

    pub fn shift_left(self, by: u8, width: u8) -> Line {
        let shift = |word: u64| word.checked_shl(by.into()).unwrap_or(0);
        Line {
            value: shift(self.value),
            slope: shift(self.slope),
            ..self
        }
        .low(width)
    }

    /// Of a word of `from` bits those from `by` up, which is less than `from`.
    fn high(self, by: u8, from: u8) -> Line {
        let value = self.value >> by;
        let rest = mask(by.max(1)) * u64::from(by > 0);
        if self.slope & rest == 0 {
            // Nothing is ever carried from below.
            return Line {
                value,
                slope: self.slope >> by,
                ..self
            };
        }
        let below = self.value & rest;
        let carry = match signed(self.slope, from) {
            speed @ 1.. => within(rest - below, speed as u64),
            speed => within(below, speed.unsigned_abs()),
        };
        Line::kept(value, self.until.min(carry))
    }

    /// So many bits from `by` up.
    pub fn slice(self, by: u8, from: u8, width: u8) -> Line {
        if by >= from {
            return Line::still(0);
        }
        self.high(by, from).extend(from - by, width)
    }

    pub fn shift_right_signed(self, by: u8, from: u8, width: u8) -> Line {
        let by = by.min(from - 1);
        self.high(by, from).extend_signed(from - by, width)
    }

    /// Zeros above, or fewer bits.
    pub fn extend(self, from: u8, width: u8) -> Line {
        if self.is_still() || width <= from {
            return self.low(width);
        }
        Line {
            value: self.value,
            slope: signed(self.slope, from) as u64,
            until: self.until.min(self.unsigned_end(from)),
        }
        .low(width)
    }

    /// The sign above, or fewer bits.
    pub fn extend_signed(self, from: u8, width: u8) -> Line {
        let value = signed(self.value, from) as u64;
        if self.is_still() || width <= from {
            return Line { value, ..self }.low(width);
        }
        Line {
            value,
            slope: signed(self.slope, from) as u64,
            until: self.until.min(self.signed_end(from)),
        }
        .low(width)
    }

    /// Above another one of `by` bits.
    pub fn join(self, low: Line, by: u8, width: u8) -> Line {
        self.shift_left(by, width).add(low.extend(by, width), width)
    }

    pub fn and(self, other: Line, width: u8) -> Line {
        let zero = |line: &Line| line.value == 0 && line.is_still();
        match (zero(&self), zero(&other)) {
            (true, true) => Line::kept(0, self.until.max(other.until)),
            (true, false) => self,
            (false, true) => other,
            _ if self.is_still() => other.masked(self, width),
            _ => self.masked(other, width),
        }
    }

    /// Its bits that another one has too, which hardly ever moves.
    fn masked(self, with: Line, width: u8) -> Line {
        let value = self.value & with.value;
        let until = self.until.min(with.until);
        if self.is_still() && with.is_still() {
            return Line::kept(value, until);
        }
        let first = with.value.trailing_zeros() as u8;
        if !with.is_still() || first >= width {
            return Line::kept(value, 1);
        }
        if with.value.wrapping_add(1).is_power_of_two() || with.value == u64::MAX {
            let bits = with.value.trailing_ones() as u8;
            let line = self.low(bits.min(width)).extend(bits.min(width), width);
            return Line {
                until: line.until.min(until),
                ..line
            };
        }
        // It stays as it is while none of these bits does anything.
        let high = self.high(first, width);
        let until = if high.is_still() { high.until } else { 1 };
        Line::kept(value, until.min(with.until))
    }

    pub fn or(self, other: Line, width: u8) -> Line {
        let both = self.not(width).and(other.not(width), width);
        both.not(width)
    }

    pub fn xor(self, other: Line, width: u8) -> Line {
        let value = self.value ^ other.value;
        let until = self.until.min(other.until);
        if self.is_still() && other.is_still() {
            return Line::kept(value, until);
        }
        let (line, with) = if other.is_still() {
            (self, other)
        } else {
            (other, self)
        };
        match with.value {
            _ if !with.is_still() => Line::kept(value, 1),
            0 => Line { until, ..line },
            all if all == mask(width) => Line {
                until,
                ..line.not(width)
            },
            // The sign turned over is a sum.
            sign if sign == 1 << (width - 1) => Line {
                value,
                until,
                ..line
            },
            _ => Line::kept(value, 1),
        }
    }

    /// Whether both words, of so many bits, are the same.
    pub fn equal(self, other: Line, width: u8) -> Line {
        let until = self.until.min(other.until);
        let meeting = self.subtract(other, width).meeting(width);
        Line::kept(u64::from(self.value == other.value), until.min(meeting))
    }

    /// Ticks in which it stays zero, or stays something else.
    pub fn meeting(self, width: u8) -> u64 {
        let Line { value, slope, .. } = self;
        if slope == 0 {
            return u64::MAX;
        }
        if value == 0 {
            return 1;
        }
        let (zeros, speed) = (slope.trailing_zeros(), signed(slope, width));
        match speed {
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
    pub fn below(self, other: Line, width: u8) -> Line {
        let until = self.until.min(other.until);
        let below = self.value < other.value;
        if self.is_still() && other.is_still() {
            return Line::kept(below.into(), until);
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
        Line::kept(below.into(), until.min(ends).min(crossing))
    }

    /// The same in two's complement.
    pub fn below_signed(self, other: Line, width: u8) -> Line {
        let sign = 1 << (width - 1);
        let turned = |line: Line| Line {
            value: line.value ^ sign,
            ..line
        };
        turned(self).below(turned(other), width)
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
