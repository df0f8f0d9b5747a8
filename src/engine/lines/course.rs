//! What a try found, kept for those to come: while the same registers move and the same choices are
//! made, only the words that bound them are looked at.

use super::pair::{Line, within};
use super::walk::Moving;
use crate::engine::flat::mask;
use crate::engine::layout::Slot;
use crate::engine::plan::Code;
use crate::engine::value::signed;

/// A word of a course.
pub(super) type Word = u32;

/// A word plus a number, modulo as many bits as are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Sum {
    pub word: Word,
    pub plus: u64,
}

/// What is to be so, and for how many ticks it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bound {
    /// It is one of so many words from a first one on, and moves.
    Within {
        sum: Sum,
        mask: u64,
        /// The last of them, counted from the first, which the sum has been lowered by.
        span: u64,
        up: bool,
        speed: u64,
    },
    /// It is not zero, and moves.
    Apart { sum: Sum, width: u8, slope: u64 },
    /// The first is less than the second, or is not; they get closer by so much in a tick.
    Order {
        sums: [Sum; 2],
        mask: u64,
        below: bool,
        speed: u64,
    },
}

/// A step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Making {
    pub code: Code,
    pub width: u8,
    pub from: u8,
    pub by: u8,
    pub a: Word,
    pub b: Word,
    pub to: Word,
}

/// How registers move while choices are as they were.
#[derive(Debug, Clone, Default)]
pub(super) struct Course {
    /// The edge blocks that it knows.
    pub edges: Vec<u64>,
    pub moving: Vec<Moving>,
    /// What is to stand where.
    pub guards: Vec<(Slot, u64)>,
    /// The guard that failed last.
    pub weak: usize,
    pub words: Vec<u64>,
    /// Words that stand in the slab.
    pub loads: Vec<(Word, Slot)>,
    pub makings: Vec<Making>,
    pub bounds: Vec<Bound>,
    /// Compiled steps that take as long as to look at it.
    pub steps: u64,
}

impl Course {
    /// For how many ticks, at most so many, registers move as they did; none if something else runs
    /// or other choices are made.
    pub fn run(&mut self, slab: &[u64], due: &[u64], most: u64) -> Option<u64> {
        let holds = |&(slot, word): &(Slot, u64)| slab[slot as usize] == word;
        if !self.guards.get(self.weak).is_none_or(holds) {
            return None;
        }
        if due
            .iter()
            .zip(&self.edges)
            .any(|(due, edges)| due & !edges != 0)
        {
            return None;
        }
        if let Some(weak) = self.guards.iter().position(|guard| !holds(guard)) {
            self.weak = weak;
            return None;
        }
        for &(word, slot) in &self.loads {
            self.words[word as usize] = slab[slot as usize];
        }
        for making in &self.makings {
            self.words[making.to as usize] = making.make(&self.words);
        }
        let mut until = most;
        for bound in &self.bounds {
            until = until.min(bound.holds(&self.words)?);
        }
        Some(until)
    }

    /// Marks the slots of guards that fail; whether no other choice was made.
    pub fn loosen(&self, slab: &[u64], loose: &mut [bool]) -> bool {
        let mut loosened = false;
        for &(slot, word) in &self.guards {
            let is = slab[slot as usize];
            if is != word {
                // Bits are choices.
                if is.max(word) < 2 || loose[slot as usize] {
                    return false;
                }
                loosened = true;
            }
        }
        for &(slot, word) in self.guards.iter().filter(|_| loosened) {
            loose[slot as usize] |= slab[slot as usize] != word;
        }
        loosened
    }
}

impl Sum {
    fn of(self, words: &[u64]) -> u64 {
        words[self.word as usize].wrapping_add(self.plus)
    }
}

impl Bound {
    /// For how many ticks; none if it does not.
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

impl Making {
    fn make(&self, words: &[u64]) -> u64 {
        let (a, b) = (words[self.a as usize], words[self.b as usize]);
        of(self.code, [self.width, self.from, self.by], a, b)
    }
}

/// What an operation that looks at all of its operands makes; `bits` are width, width of the first
/// operand, and [`by`](crate::engine::plan::Step::by).
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
