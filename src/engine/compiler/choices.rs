//! Machine code of an edge block whose registers take their words from multiplexers: those with the
//! same select signal share a branch, so that a held register costs nothing, and the words of a side
//! are computed on that side alone.

use super::PART;
use super::block::{clean, value};
use super::emit::{Changes, Emitter, Word};
use crate::engine::layout::Slot;
use crate::engine::plan::{Block, Code, Plan, PlannedRegister};
use rustc_hash::FxHashMap;

/// Set of steps, or of registers, of a block that is compiled in one part.
type Set = u128;

const _: () = assert!(PART <= Set::BITS as usize);

/// Greatest nesting depth of choices.
const DEEP: usize = 12;
/// Greatest number of branches per register; further choices are selections of two words.
const MANY: usize = 8;

/// Steps that are emitted where their words are needed.
pub(super) struct Choices<'c, 'f> {
    pub emitter: &'c mut Emitter<'f>,
    plan: &'c Plan,
    block: &'c Block,
    makers: FxHashMap<Slot, usize>,
    /// By step: the steps on which it depends, itself included.
    cones: Vec<Set>,
    /// By step: the registers of this block that it, or one on which it depends, reads.
    reads: Vec<Set>,
    /// Place of each register in the block, by its slot.
    places: FxHashMap<Slot, usize>,
    /// Steps that are emitted on the way here.
    made: Set,
    /// Choices made on the way here.
    known: Vec<(Slot, bool)>,
    /// Number of branches that may still be emitted.
    branches: usize,
}

/// Register, by its place in the block, and the slot of its new word.
type Root = (usize, Slot);

/// Registers whose outermost multiplexers have the same select signal.
struct Group {
    on: Slot,
    high: Vec<Root>,
    low: Vec<Root>,
}

impl<'c, 'f> Choices<'c, 'f> {
    pub fn new(emitter: &'c mut Emitter<'f>, plan: &'c Plan, block: &'c Block) -> Self {
        let registers = block.registers.iter();
        let slots = registers.map(|&(register, _)| plan.registers[register as usize].slot);
        let places = slots.enumerate().map(|(place, slot)| (slot, place));
        let mut choices = Choices {
            emitter,
            plan,
            block,
            makers: FxHashMap::default(),
            cones: Vec::with_capacity(block.steps.len()),
            reads: Vec::with_capacity(block.steps.len()),
            places: places.collect(),
            made: 0,
            known: Vec::new(),
            branches: MANY * block.registers.len(),
        };
        for (number, step) in block.steps.iter().enumerate() {
            let third = (step.code == Code::Mux).then_some(step.c);
            let second = (step.code != Code::Read).then_some(step.b);
            let operands = [Some(step.a), second, third];
            let (mut cone, mut reads) = (1 << number, 0);
            for slot in operands.into_iter().flatten() {
                cone |= choices.cone(slot);
                reads |= choices.read(slot);
            }
            choices.cones.push(cone);
            choices.reads.push(reads);
            choices.makers.insert(step.to, number);
        }
        choices
    }

    fn register(&self, place: usize) -> PlannedRegister {
        self.plan.registers[self.block.registers[place].0 as usize]
    }

    /// Returns the steps on which a slot depends.
    fn cone(&self, slot: Slot) -> Set {
        self.makers.get(&slot).map_or(0, |&step| self.cones[step])
    }

    /// Returns the registers of this block on which a slot depends.
    fn read(&self, slot: Slot) -> Set {
        match self.makers.get(&slot) {
            Some(&step) => self.reads[step],
            None => self.places.get(&slot).map_or(0, |&place| 1 << place),
        }
    }

    /// Emits the steps on which a slot depends.
    pub fn need(&mut self, slot: Slot) {
        self.make(self.cone(slot));
    }

    fn make(&mut self, steps: Set) {
        let mut left = steps & !self.made;
        self.made |= steps;
        while left != 0 {
            let step = &self.block.steps[left.trailing_zeros() as usize];
            left &= left - 1;
            let (value, bits) = value(self.emitter, self.plan, step);
            let width = step.width;
            self.emitter.know(step.to, Word { value, bits, width });
        }
    }

    /// Emits one side of a branch; words that become known there are forgotten behind it.
    pub fn scope(&mut self, emit: impl FnOnce(&mut Self)) {
        let made = self.made;
        let mark = self.emitter.open();
        emit(self);
        self.emitter.close(mark);
        self.made = made;
    }

    /// Emits the steps whose words the memory writes of this block change.
    pub fn reads_first(&mut self) {
        for (number, step) in self.block.steps.iter().enumerate() {
            let written = || self.block.writes.iter().any(|write| write.memory == step.c);
            if step.code == Code::Read && written() {
                self.make(self.cones[number]);
            }
        }
    }

    /// Emits the new words of all registers.
    pub fn registers(&mut self) {
        let registers = self.block.registers.iter().enumerate();
        self.grow(registers.map(|(place, &(_, from))| (place, from)).collect());
    }

    /// Returns a choice that is not made yet: its condition, and the slots if it is high and low.
    fn choice(&self, (place, from): Root) -> Option<(Slot, Slot, Slot)> {
        let register = self.register(place);
        let number = *self.makers.get(&from)?;
        let step = &self.block.steps[number];
        let is_made = self.made >> number & 1 != 0;
        let is_choice = step.code == Code::Mux && step.width == register.width;
        if !is_choice || is_made || register.shadow.is_some() {
            return None;
        }
        let (mut on, mut high, mut low) = (step.a, step.b, step.c);
        while let Some(&inner) = self.makers.get(&on)
            && let inner = &self.block.steps[inner]
            && inner.code == Code::Not
            && inner.width == 1
        {
            on = inner.a;
            (high, low) = (low, high);
        }
        Some((on, high, low))
    }

    /// Emits the new words of some registers.
    fn grow(&mut self, roots: Vec<Root>) {
        let (words, groups) = self.sort(roots);
        self.branches -= groups.len();
        // Words of this level are made before a choice changes what they read, and are stored after
        // all choices have read what they change.
        let words: Vec<(usize, Word)> = words
            .into_iter()
            .map(|(place, from)| {
                self.need(from);
                let width = self.register(place).width;
                (place, clean(self.emitter, from, width))
            })
            .collect();
        self.keep_old(&groups);
        for group in groups {
            self.choose(group);
        }
        self.store(&words);
    }

    /// Divides registers into those that take a word, and those that make a choice first; those that
    /// hold their word are left out.
    fn sort(&self, roots: Vec<Root>) -> (Vec<Root>, Vec<Group>) {
        let mut groups: Vec<Group> = Vec::new();
        let mut leaves: Vec<Root> = Vec::new();
        for (place, mut from) in roots {
            let choice = loop {
                let Some((on, high, low)) = self.choice((place, from)) else {
                    break None;
                };
                match self.known.iter().find(|(known, _)| *known == on) {
                    Some((_, true)) => from = high,
                    Some((_, false)) => from = low,
                    None => break Some((on, high, low)),
                }
            };
            let full = self.known.len() >= DEEP || groups.len() >= self.branches;
            let Some((on, high, low)) = choice.filter(|_| !full) else {
                let is_held = self.places.get(&from) == Some(&place);
                if !is_held || self.register(place).shadow.is_some() {
                    leaves.push((place, from));
                }
                continue;
            };
            let number = groups.iter().position(|group| group.on == on);
            let number = number.unwrap_or_else(|| {
                groups.push(Group {
                    on,
                    high: Vec::new(),
                    low: Vec::new(),
                });
                groups.len() - 1
            });
            groups[number].high.push((place, high));
            groups[number].low.push((place, low));
        }
        (leaves, groups)
    }

    /// Loads the registers that one group changes before another one reads them.
    fn keep_old(&mut self, groups: &[Group]) {
        let mut changed: Set = 0;
        for group in groups {
            let roots = || group.high.iter().chain(&group.low);
            let reads = roots().map(|&(_, from)| self.read(from));
            let mut read = reads.fold(self.read(group.on), |all, set| all | set) & changed;
            changed |= roots().fold(0, |all, &(place, _)| all | 1 << place);
            while read != 0 {
                let register = self.register(read.trailing_zeros() as usize);
                read &= read - 1;
                self.emitter.word(register.slot, register.width);
            }
        }
    }

    fn store(&mut self, words: &[(usize, Word)]) {
        let mut changes = Changes::new();
        for &(place, word) in words {
            let register = self.register(place);
            match register.shadow {
                Some(shadow) => self.emitter.store(shadow, word.value),
                None => self.emitter.replace(register.slot, word, &mut changes),
            }
        }
        self.emitter.flush(changes);
    }

    fn choose(&mut self, group: Group) {
        let Group { on, high, low } = group;
        // A step that both sides need is emitted once.
        let [of_high, of_low] = [&high, &low].map(|side| {
            let cones = side.iter().map(|&(_, from)| self.cone(from));
            cones.fold(0, |all, cone| all | cone)
        });
        self.make(self.cone(on) | of_high & of_low);
        let choose = self.emitter.clean(on, 1);
        let next = self.emitter.block();
        let [then, other] = [&high, &low].map(|side| {
            let holds = |(place, from): &Root| self.places.get(from) == Some(place);
            match side.iter().all(holds) {
                true => next,
                false => self.emitter.block(),
            }
        });
        self.emitter.branch(choose, then, other);
        for (block, level, roots) in [(then, true, high), (other, false, low)] {
            if block == next {
                continue;
            }
            self.emitter.begin(block);
            self.known.push((on, level));
            self.scope(|side| side.grow(roots));
            self.known.pop();
            self.emitter.jump(next);
        }
        self.emitter.begin(next);
    }
}
