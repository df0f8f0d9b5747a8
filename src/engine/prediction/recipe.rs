//! Recipes: the result of an attempt, kept for later ones. While the same registers move and the
//! same choices are made, only the words that bound the horizon are evaluated.

use super::pair::{Line, within};
use super::walk::Moving;
use crate::engine::flat::mask;
use crate::engine::layout::Slot;
use crate::engine::plan::Code;
use crate::engine::value::signed;

/// Index of a word of a recipe.
pub(super) type Word = u32;

/// Word plus a number, modulo the bits that the bound reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Sum {
    pub word: Word,
    pub plus: u64,
}

/// Condition, and its horizon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bound {
    /// The sum is in a range and moves.
    Within {
        sum: Sum,
        mask: u64,
        /// Last word of the range, counted from its first, by which the sum is lowered.
        span: u64,
        up: bool,
        speed: u64,
    },
    /// The sum is not zero and moves.
    Apart { sum: Sum, width: u8, slope: u64 },
    /// The first is less than the second, or is not; their distance shrinks by `speed` per tick.
    Order {
        sums: [Sum; 2],
        mask: u64,
        below: bool,
        speed: u64,
    },
}

/// Operation that computes a word.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub code: Code,
    pub width: u8,
    pub from: u8,
    pub by: u8,
    pub a: Word,
    pub b: Word,
    pub to: Word,
}

/// Movement of the registers while choices are the same.
#[derive(Debug, Clone, Default)]
pub(super) struct Recipe {
    /// Edge blocks that it covers.
    pub edges: Vec<u64>,
    pub moving: Vec<Moving>,
    /// Slots, and the words that they must hold.
    pub guards: Vec<(Slot, u64)>,
    /// Guard that failed last; it is checked first.
    pub last_failed: usize,
    pub words: Vec<u64>,
    /// Words loaded from the slab.
    pub loads: Vec<(Word, Slot)>,
    pub steps: Vec<Step>,
    pub bounds: Vec<Bound>,
    /// Cost of evaluating the recipe, in compiled steps.
    pub cost: u64,
}

impl Recipe {
    /// Returns the number of ticks, at most `most`, in which registers move as recorded; `None` if
    /// other blocks run or other choices are made.
    pub fn run(&mut self, slab: &[u64], due: &[u64], most: u64) -> Option<u64> {
        let holds = |&(slot, word): &(Slot, u64)| slab[slot as usize] == word;
        if !self.guards.get(self.last_failed).is_none_or(holds) {
            return None;
        }
        if due
            .iter()
            .zip(&self.edges)
            .any(|(due, edges)| due & !edges != 0)
        {
            return None;
        }
        if let Some(last_failed) = self.guards.iter().position(|guard| !holds(guard)) {
            self.last_failed = last_failed;
            return None;
        }
        for &(word, slot) in &self.loads {
            self.words[word as usize] = slab[slot as usize];
        }
        for step in &self.steps {
            self.words[step.to as usize] = step.run(&self.words);
        }
        let mut until = most;
        for bound in &self.bounds {
            until = until.min(bound.holds(&self.words)?);
        }
        Some(until)
    }

    /// Marks the slots of failed guards to be loaded again. Returns false if a choice differs.
    pub fn mark_reloaded(&self, slab: &[u64], reloaded: &mut [bool]) -> bool {
        let mut found = false;
        for &(slot, word) in &self.guards {
            let is = slab[slot as usize];
            if is != word {
                // Bits are choices.
                if is.max(word) < 2 || reloaded[slot as usize] {
                    return false;
                }
                found = true;
            }
        }
        for &(slot, word) in self.guards.iter().filter(|_| found) {
            reloaded[slot as usize] |= slab[slot as usize] != word;
        }
        found
    }
}

impl Sum {
    fn of(self, words: &[u64]) -> u64 {
        words[self.word as usize].wrapping_add(self.plus)
    }
}

impl Bound {
    /// Returns the horizon of the condition; `None` if it is false.
    #[inline]
    fn holds(&self, words: &[u64]) -> Option<u64> {
        match *self {
            Bound::Within {
                sum,
                mask,
                span,
                up,
                speed,
            } => {
                let at = sum.of(words) & mask;
                if at > span {
                    None
                } else if speed == 0 {
                    Some(u64::MAX)
                } else {
                    Some(within(if up { span - at } else { at }, speed))
                }
            }
            Bound::Apart { sum, width, slope } => {
                let value = sum.of(words) & mask(width);
                match value {
                    0 => None,
                    _ if slope == 0 => Some(u64::MAX),
                    _ => Some(Line { value, slope }.meeting(width)),
                }
            }
            Bound::Order {
                sums,
                mask,
                below,
                speed,
            } => {
                let [one, other] = sums.map(|sum| sum.of(words) & mask);
                if (one < other) != below {
                    return None;
                }
                let room = if below { other - one - 1 } else { one - other };
                Some(if speed == 0 {
                    u64::MAX
                } else {
                    within(room, speed)
                })
            }
        }
    }
}

impl Step {
    fn run(&self, words: &[u64]) -> u64 {
        let (a, b) = (words[self.a as usize], words[self.b as usize]);
        of(self.code, [self.width, self.from, self.by], a, b)
    }
}

/// Returns the result of an operation that reads all of its operands; `bits` are width, width of
/// the first operand, and [`by`](crate::engine::plan::Step::by).
#[inline]
pub(super) fn of(code: Code, bits: [u8; 3], a: u64, b: u64) -> u64 {
    let [width, from, by] = bits;
    let value = match code {
        Code::Not => !a,
        Code::Negate => a.wrapping_neg(),
        Code::Add => a.wrapping_add(b),
        Code::Subtract => a.wrapping_sub(b),
        Code::Multiply => a.wrapping_mul(b),
        Code::And => a & b,
        Code::Or => a | b,
        Code::Xor => a ^ b,
        Code::Equal => (a == b).into(),
        Code::Below => (a < b).into(),
        Code::BelowSigned => (signed(a, from) < signed(b, from)).into(),
        Code::ShiftLeft => a.checked_shl(by.into()).unwrap_or(0),
        Code::ShiftRight | Code::Slice => a.checked_shr(by.into()).unwrap_or(0),
        Code::ShiftRightSigned => (signed(a, from) >> by.min(63)) as u64,
        Code::ExtendSigned => signed(a, from) as u64,
        Code::Join => a.checked_shl(by.into()).unwrap_or(0) | b,
        Code::Extend | Code::Mux | Code::Read => a,
    };
    value & mask(width)
}
