//! Restoring division, bit by bit. A word holds the remaining dividend bits above, and the quotient
//! bits so far below.

use crate::prelude::*;

/// A stage: the division of one bit.
#[derive(Clone, Copy)]
pub(super) struct Stage {
    /// Remainder before the stage, with the next dividend bit appended.
    pub partial: U,
    /// Quotient bit: `partial` is at least the divisor.
    pub fits: Bit,
    /// Values after the stage.
    pub after: Divided,
}

/// Values between two stages.
#[derive(Clone, Copy)]
pub(super) struct Divided {
    pub remainder: U,
    /// Remaining dividend bits above, quotient bits below.
    pub quotient: U,
}

impl Divided {
    /// Divides the next bit.
    pub fn stage(self, by: U) -> Stage {
        let word = by.width();
        let highest = self.quotient.bit(word - 1).word();
        let partial = self.remainder.shift_left(1) | highest.resize(word);
        let fits = !partial.below(by);
        let after = Divided {
            remainder: fits.mux(partial - by, partial),
            quotient: self.quotient.shift_left(1) | fits.word().resize(word),
        };
        Stage {
            partial,
            fits,
            after,
        }
    }

    /// High if the remainder with the next dividend bit appended equals the quotient bit of `after`
    /// times the divisor, plus the remainder of `after`; and if the other bits are moved up.
    pub fn becomes(self, after: Divided, by: U) -> Bit {
        let word = by.width();
        // A word of 64 bits needs no further bit, as the divisor is below half of its range.
        let wide = |value: U| value.resize((word + 1).min(64));
        let highest = self.quotient.bit(word - 1).word();
        let partial = wide(self.remainder).shift_left(1) | wide(highest);
        let taken = after.quotient.bit(0).mux(wide(by), 0);
        let divided = partial.equals(wide(after.remainder) + taken);
        let moved = (self.quotient.shift_left(1) ^ after.quotient).shift_right(1);
        divided & moved.is_zero()
    }
}
