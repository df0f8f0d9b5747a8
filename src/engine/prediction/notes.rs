//! State of a recipe while it is recorded.

use super::pair::{Line, faster};
use super::recipe::{Bound, Recipe, Step, Sum, Word};
use crate::engine::flat::mask;
use crate::engine::layout::Slot;
use crate::engine::plan::Code;
use crate::engine::value::signed;
use rustc_hash::FxHashMap;

/// Node in a recipe.
#[derive(Debug, Clone, Copy)]
pub(super) struct Traced {
    pub line: Line,
    pub what: What,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum What {
    /// Constant as long as the guards hold.
    Number,
    /// Word of the slab whose value nothing has requested yet.
    Slot(Slot),
    Word(Word),
}
/// Recipe under construction.
pub(super) struct Notes<'r> {
    slab: &'r [u64],
    /// Slots whose words are loaded again each time instead of guarded.
    reloaded: &'r [bool],
    recipe: Recipe,
    guarded: FxHashMap<Slot, ()>,
    loaded: FxHashMap<Slot, Word>,
    numbers: FxHashMap<u64, Word>,
    /// Words that are another word plus a number, with the width of the sum.
    pub sums: FxHashMap<Word, (Sum, u8)>,
}

impl<'r> Notes<'r> {
    pub fn new(slab: &'r [u64], reloaded: &'r [bool]) -> Self {
        Notes {
            slab,
            reloaded,
            recipe: Recipe::default(),
            guarded: FxHashMap::default(),
            loaded: FxHashMap::default(),
            numbers: FxHashMap::default(),
            sums: FxHashMap::default(),
        }
    }

    /// Returns the recipe without words that no bound needs.
    pub fn recipe(mut self) -> Recipe {
        let recipe = &mut self.recipe;
        let mut asked = vec![false; recipe.words.len()];
        for bound in &recipe.bounds {
            match bound {
                Bound::Within { sum, .. } | Bound::Apart { sum, .. } => {
                    asked[sum.word as usize] = true;
                }
                Bound::Order { sums, .. } => {
                    sums.iter().for_each(|sum| asked[sum.word as usize] = true);
                }
            }
        }
        for step in recipe.steps.iter().rev() {
            if asked[step.to as usize] {
                asked[step.a as usize] = true;
                asked[step.b as usize] = true;
            }
        }
        recipe.steps.retain(|step| asked[step.to as usize]);
        recipe.loads.retain(|(word, _)| asked[*word as usize]);
        self.recipe
    }

    pub fn not(&mut self, a: Traced, width: u8) -> Traced {
        self.result(a.line.not(width), Code::Not, [width, width, 0], a, a)
    }

    pub fn add(&mut self, a: Traced, b: Traced, width: u8) -> Traced {
        let line = a.line.add(b.line, width);
        let sum = self.result(line, Code::Add, [width, width, 0], a, b);
        match (sum.what, a.what, b.what) {
            (What::Word(to), What::Word(word), What::Number) => {
                self.known_sum(to, word, b.line.value, width);
            }
            (What::Word(to), What::Number, What::Word(word)) => {
                self.known_sum(to, word, a.line.value, width);
            }
            _ => {}
        }
        sum
    }

    pub fn and(&mut self, a: Traced, b: Traced, width: u8) -> Option<Traced> {
        let (a, b) = self.one_number(a, b)?;
        let (moves, with) = if b.line.is_still() { (a, b) } else { (b, a) };
        let bits = [width, width, 0];
        if moves.line.is_still() {
            let line = Line::still(a.line.value & b.line.value);
            return Some(self.result(line, Code::And, bits, a, b));
        }
        let low = with.line.value.trailing_ones() as u8;
        if low > 0 && with.line.value == mask(low) {
            let low = low.min(width);
            let word = self.result(
                moves.line.low(low),
                Code::Slice,
                [low, width, 0],
                moves,
                moves,
            );
            return Some(self.extend(word, low, width, false));
        }
        let first = with.line.value.trailing_zeros() as u8;
        let high = (first < width).then(|| self.high(moves, first, width))?;
        high.line.is_still().then_some(())?;
        let line = Line::still(a.line.value & b.line.value);
        Some(self.result(line, Code::And, bits, a, b))
    }

    /// Upper bits, from bit `by` on, which must exist.
    pub fn high(&mut self, a: Traced, by: u8, from: u8) -> Traced {
        let rest = (1 << by) - 1;
        let line = a.line.high(by, from, &mut 0);
        if a.line.slope & rest != 0 {
            let sum = self.sum(a, rest);
            self.within(sum, rest, rest, signed(a.line.slope, from));
        }
        self.result(line, Code::Slice, [from - by, from, by], a, a)
    }

    pub fn extend(&mut self, a: Traced, from: u8, width: u8, is_signed: bool) -> Traced {
        if !a.line.is_still() && width > from {
            let mut sum = self.sum(a, mask(from));
            if is_signed {
                sum.plus = sum.plus.wrapping_add(1 << (from - 1));
            }
            self.within(sum, mask(from), mask(from), signed(a.line.slope, from));
        }
        let (code, line) = match is_signed {
            true => (
                Code::ExtendSigned,
                a.line.extend_signed(from, width, &mut 0),
            ),
            false => (Code::Extend, a.line.extend(from, width, &mut 0)),
        };
        if width == from {
            return a;
        }
        self.result(line, code, [width, from, 0], a, a)
    }

    pub fn equal(&mut self, a: Traced, b: Traced, width: u8) -> Option<Traced> {
        let (a, b) = (self.take(a), self.take(b));
        let apart = a.line.subtract(b.line, width);
        let is = number(u64::from(apart.value == 0));
        let (slope, sum) = match (a.what, b.what) {
            (What::Number, What::Number) => return Some(is),
            (What::Number, _) => {
                let sum = self.sum(b, mask(width));
                (b.line.slope, sum.less(a.line.value))
            }
            (_, What::Number) => {
                let sum = self.sum(a, mask(width));
                (a.line.slope, sum.less(b.line.value))
            }
            _ => {
                let (a, b) = (self.word(a), self.word(b));
                let word = self.make(Code::Subtract, [width, width, 0], a, b);
                (apart.slope, Sum { word, plus: 0 })
            }
        };
        if apart.value != 0 {
            self.bound(Bound::Apart { sum, width, slope });
        } else if slope == 0 {
            self.within(sum, mask(width), 0, 0);
        } else {
            return None;
        }
        Some(is)
    }

    /// Order; `lift` is the sign bit for a signed comparison, else 0.
    pub fn below(&mut self, a: Traced, b: Traced, width: u8, lift: u64) -> Option<Traced> {
        let all = mask(width);
        let value = |traced: Traced| (traced.line.value ^ lift) & all;
        let below = value(a) < value(b);
        let is = Some(number(below.into()));
        let speed = |traced: Traced| signed(traced.line.slope, width);
        let lifted = |sum: Sum| sum.less(lift.wrapping_neg());
        let (moves, first, last) = match (a.what, b.what) {
            (What::Number, What::Number) => return is,
            (_, What::Number) if below => (a, 0, value(b) - 1),
            (_, What::Number) => (a, value(b), all),
            (What::Number, _) if below => (b, value(a) + 1, all),
            (What::Number, _) => (b, 0, value(a)),
            _ => {
                let mut sums = [a, b].map(|traced| {
                    let sum = lifted(self.sum(traced, all));
                    if !traced.line.is_still() {
                        self.within(sum, all, all, speed(traced));
                    }
                    sum
                });
                let closer = if below {
                    (speed(a), speed(b))
                } else {
                    (speed(b), speed(a))
                };
                let speed = faster(closer.0, closer.1);
                sums.iter_mut().for_each(|sum| sum.plus &= all);
                self.bound(Bound::Order {
                    sums,
                    mask: all,
                    below,
                    speed,
                });
                return is;
            }
        };
        let sum = lifted(self.sum(moves, all)).less(first);
        self.within(sum, all, last - first, speed(moves));
        is
    }

    pub fn is_high(&mut self, on: Traced) -> Option<bool> {
        let high = on.line.value != 0;
        match on.what {
            What::Word(word) if high && on.line.is_still() => {
                let sum = Sum { word, plus: 0 };
                let (width, slope) = (64, 0);
                self.bound(Bound::Apart { sum, width, slope });
            }
            _ => {
                self.pin(on)?;
            }
        }
        Some(high)
    }

    /// Guards the current value, and returns it as a constant.
    pub fn pin(&mut self, traced: Traced) -> Option<Traced> {
        let value = traced.line.value;
        match traced.what {
            _ if !traced.line.is_still() => return None,
            What::Number => {}
            What::Slot(slot) => self.guard(slot),
            What::Word(word) => self.same(word, value, 64),
        }
        Some(number(value))
    }

    /// Requests the value.
    pub fn take(&mut self, traced: Traced) -> Traced {
        let What::Slot(slot) = traced.what else {
            return traced;
        };
        if self.reloaded[slot as usize] {
            let what = What::Word(self.load(slot));
            return Traced { what, ..traced };
        }
        self.guard(slot);
        number(traced.line.value)
    }

    /// Of two words, pins one that does not move, unless both do not.
    pub fn one_number(&mut self, a: Traced, b: Traced) -> Option<(Traced, Traced)> {
        match (a.line.is_still(), b.line.is_still()) {
            (true, true) => Some((a, b)),
            (true, false) => Some((self.pin(a)?, b)),
            (false, true) => Some((a, self.pin(b)?)),
            (false, false) => None,
        }
    }

    pub fn guard(&mut self, slot: Slot) {
        if self.guarded.insert(slot, ()).is_none() {
            let word = self.slab[slot as usize];
            self.recipe.guards.push((slot, word));
        }
    }

    fn bound(&mut self, bound: Bound) {
        if !self.recipe.bounds.contains(&bound) {
            self.recipe.bounds.push(bound);
        }
    }

    fn within(&mut self, sum: Sum, mask: u64, span: u64, speed: i64) {
        let sum = Sum {
            plus: sum.plus & mask,
            ..sum
        };
        self.bound(Bound::Within {
            sum,
            mask,
            span,
            up: speed > 0,
            speed: speed.unsigned_abs(),
        });
    }

    pub fn same(&mut self, word: Word, value: u64, width: u8) {
        let sum = Sum { word, plus: 0 };
        self.within(sum.less(value), mask(width), 0, 0);
    }

    fn fresh(&mut self, value: u64) -> Word {
        self.recipe.words.push(value);
        self.recipe.words.len() as Word - 1
    }

    pub fn load(&mut self, slot: Slot) -> Word {
        if let Some(&word) = self.loaded.get(&slot) {
            return word;
        }
        let word = self.fresh(0);
        self.loaded.insert(slot, word);
        self.recipe.loads.push((word, slot));
        word
    }

    /// Returns the index of the word; loads it from the slab if necessary.
    pub fn word(&mut self, traced: Traced) -> Word {
        let value = traced.line.value;
        match self.take(traced).what {
            What::Word(word) => word,
            _ => match self.numbers.get(&value) {
                Some(&word) => word,
                None => {
                    let word = self.fresh(value);
                    self.numbers.insert(value, word);
                    word
                }
            },
        }
    }

    /// Returns the word, or the sum that computes it if no more than `bits` are read.
    fn sum(&mut self, traced: Traced, bits: u64) -> Sum {
        let word = self.word(traced);
        match self.sums.get(&word) {
            Some(&(sum, width)) if bits & !mask(width) == 0 => sum,
            _ => Sum { word, plus: 0 },
        }
    }

    pub fn known_sum(&mut self, to: Word, word: Word, plus: u64, width: u8) {
        let all = mask(width);
        let sum = match self.sums.get(&word) {
            Some(&(sum, known)) if known == width => Sum {
                plus: sum.plus.wrapping_add(plus) & all,
                ..sum
            },
            _ => Sum {
                word,
                plus: plus & all,
            },
        };
        self.sums.insert(to, (sum, width));
    }

    pub fn make(&mut self, code: Code, bits: [u8; 3], a: Word, b: Word) -> Word {
        let to = self.fresh(0);
        let [width, from, by] = bits;
        self.recipe.steps.push(Step {
            code,
            width,
            from,
            by,
            a,
            b,
            to,
        });
        to
    }

    /// Returns a constant if both operands are, else adds an operation.
    pub fn result(
        &mut self,
        line: Line,
        code: Code,
        bits: [u8; 3],
        a: Traced,
        b: Traced,
    ) -> Traced {
        if a.what == What::Number && b.what == What::Number {
            return number(line.value);
        }
        let (a, b) = (self.word(a), self.word(b));
        let what = What::Word(self.make(code, bits, a, b));
        Traced { line, what }
    }
}

impl Sum {
    fn less(self, by: u64) -> Sum {
        Sum {
            plus: self.plus.wrapping_sub(by),
            ..self
        }
    }
}

pub(super) fn number(value: u64) -> Traced {
    let line = Line::still(value);
    let what = What::Number;
    Traced { line, what }
}
