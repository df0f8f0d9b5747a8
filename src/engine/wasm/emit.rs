//! Instructions on words of the slab.

use super::{BLOCKS, ENTRY};
use crate::engine::flat::mask;
use crate::engine::layout::{Layout, Slot};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use wasm_encoder::{BlockType, Function, InstructionSink, MemArg, MemArgTarget, ValType};

/// Number, or word in a local variable. A local is set once in each run of its block.
#[derive(Debug, Clone, Copy)]
pub(super) enum Value {
    Number(u64),
    Local(u32),
}

/// Word of a slot.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word {
    pub value: Value,
    /// Number of low bits that may be set; higher bits are 0. It may exceed the width of the word:
    /// masking is delayed until the upper bits matter.
    pub bits: u8,
    pub width: u8,
}

/// Bits to set, as words of the slab and masks.
type Bits = Vec<(Slot, u64)>;

/// Changes of the current block: for each set of bits, words of which one is not 0 if they are to be
/// set.
pub(super) type Changes = BTreeMap<Bits, Vec<Value>>;

/// Local with the address of the slab.
const SLAB: u32 = 0;

/// Function of blocks under construction.
#[derive(Default)]
struct Body {
    code: Vec<u8>,
    /// Number of locals of the current block.
    used: u32,
    /// Number of locals.
    locals: u32,
    known: FxHashMap<Slot, Word>,
}

pub(super) struct Emitter<'p> {
    layout: &'p Layout,
    /// Woken blocks, as bits of the words of `dirty`; the other blocks always run.
    cold: Vec<u64>,
    constants: FxHashMap<Slot, u64>,
    body: Body,
    /// Finished functions with their types.
    functions: Vec<(u32, Function)>,
    /// Greatest number of words computed in a part.
    pub part_size: usize,
    /// True if an offset beyond the slab was requested.
    pub outside: bool,
}

impl<'p> Emitter<'p> {
    pub fn new(layout: &'p Layout, cold: Vec<u64>, part_size: usize) -> Self {
        Emitter {
            layout,
            cold,
            constants: layout.constants.iter().copied().collect(),
            body: Body::default(),
            functions: Vec::new(),
            part_size,
            outside: false,
        }
    }

    pub fn ins(&mut self) -> InstructionSink<'_> {
        InstructionSink::new(&mut self.body.code)
    }

    /// Returns the number of bytes of the current function.
    pub fn length(&self) -> usize {
        self.body.code.len()
    }

    /// Ends the current function and begins another one; returns its number.
    pub fn finish(&mut self) -> u32 {
        let body = std::mem::take(&mut self.body);
        let mut function = Function::new([(body.locals, ValType::I64)]);
        function.raw(body.code).instructions().end();
        self.functions.push((BLOCKS, function));
        self.functions.len() as u32 - 1
    }

    /// Emits code as a function of its own, and calls it.
    pub fn outline(&mut self, emit: impl FnOnce(&mut Self)) {
        let outer = std::mem::take(&mut self.body);
        emit(self);
        let number = self.finish();
        self.body = outer;
        self.call(number);
    }

    pub fn call(&mut self, number: u32) {
        self.ins().local_get(SLAB).call(number);
    }

    /// Returns all functions, of which the entry is the last.
    pub fn functions(
        mut self,
        entry: impl FnOnce(&mut InstructionSink<'_>),
    ) -> Vec<(u32, Function)> {
        let mut function = Function::new([]);
        entry(&mut function.instructions());
        function.instructions().end();
        self.functions.push((ENTRY, function));
        self.functions
    }

    /// Forgets the known words of all slots.
    pub fn forget(&mut self) {
        self.body.known.clear();
        self.body.used = 0;
    }

    fn push(&mut self, value: Value) {
        match value {
            Value::Number(number) => self.ins().i64_const(number as i64),
            Value::Local(local) => self.ins().local_get(local),
        };
    }

    /// Moves the top of the stack to a new local.
    fn pop(&mut self) -> Value {
        self.body.used += 1;
        self.body.locals = self.body.locals.max(self.body.used);
        let local = SLAB + self.body.used;
        self.ins().local_set(local);
        Value::Local(local)
    }

    /// Emits operands and instructions that leave one word.
    pub fn apply<const N: usize>(
        &mut self,
        operands: [Value; N],
        emit: impl FnOnce(&mut InstructionSink<'_>),
    ) -> Value {
        operands.into_iter().for_each(|value| self.push(value));
        emit(&mut self.ins());
        self.pop()
    }

    pub fn compare(
        &mut self,
        operands: [Value; 2],
        emit: impl FnOnce(&mut InstructionSink<'_>),
    ) -> Value {
        self.apply(operands, |ins| {
            emit(ins);
            ins.i64_extend_i32_u();
        })
    }

    /// Returns `then` if a word is not 0, else `other`.
    pub fn select(&mut self, choose: Value, then: Value, other: Value) -> Value {
        self.apply([then, other, choose], |ins| {
            ins.i64_const(0).i64_ne().select();
        })
    }

    /// Emits code that runs if a word is not 0. What becomes known there is to be forgotten.
    pub fn when(&mut self, choose: Value, emit: impl FnOnce(&mut Self)) {
        self.push(choose);
        self.when_top(emit);
    }

    /// Emits code that runs if the top of the stack is not 0.
    pub fn when_top(&mut self, emit: impl FnOnce(&mut Self)) {
        self.ins().i64_const(0).i64_ne().if_(BlockType::Empty);
        emit(self);
        self.ins().end();
    }

    /// Returns the place of `words` words in the slab; every access goes through here.
    pub fn place(&mut self, slot: Slot, words: u32) -> MemArg {
        let end = u64::from(slot) + u64::from(words);
        let mut offset = u64::from(slot) * 8;
        if end > u64::from(self.layout.words) || u32::try_from(end * 8).is_err() {
            self.outside = true;
            offset = 0;
        }
        MemArg {
            offset,
            align: 3,
            target: MemArgTarget::Memory(0),
            ordering: None,
        }
    }

    /// Pushes the word of a slot.
    pub fn push_slot(&mut self, slot: Slot) {
        let place = self.place(slot, 1);
        self.ins().local_get(SLAB).i64_load(place);
    }

    pub fn load(&mut self, slot: Slot) -> Value {
        self.push_slot(slot);
        self.pop()
    }

    pub fn store(&mut self, slot: Slot, word: Value) {
        let place = self.place(slot, 1);
        self.ins().local_get(SLAB);
        self.push(word);
        self.ins().i64_store(place);
    }

    /// Sets, clears or keeps bits of a slot.
    pub fn change(&mut self, slot: Slot, emit: impl FnOnce(&mut InstructionSink<'_>)) {
        let place = self.place(slot, 1);
        let mut ins = self.ins();
        ins.local_get(SLAB).local_get(SLAB).i64_load(place);
        emit(&mut ins);
        ins.i64_store(place);
    }

    /// Loads a word of an array of `words` words. The index must be below `words`: see
    /// [`Self::bounded`].
    pub fn load_of(&mut self, first: Slot, words: u32, index: Value) -> Value {
        let place = self.place(first, words);
        self.push_address(index);
        self.ins().i64_load(place);
        self.pop()
    }

    /// Stores a word in an array of `words` words. The index must be below `words`.
    pub fn store_of(&mut self, first: Slot, words: u32, index: Value, word: Value) {
        let place = self.place(first, words);
        self.push_address(index);
        self.push(word);
        self.ins().i64_store(place);
    }

    fn push_address(&mut self, index: Value) {
        self.push(index);
        let mut ins = self.ins();
        ins.i32_wrap_i64().i32_const(3).i32_shl();
        ins.local_get(SLAB).i32_add();
    }

    /// Limits an index to values below `words`, which must be at least 1.
    pub fn bounded(&mut self, index: Value, words: u32) -> Value {
        let last = Value::Number(u64::from(words.saturating_sub(1)));
        match words.is_power_of_two() {
            true => self.apply([index, last], |ins| {
                ins.i64_and();
            }),
            false => self.apply([index, last, index, last], |ins| {
                ins.i64_lt_u().select();
            }),
        }
    }

    /// Records the word that a slot holds from here on.
    pub fn know(&mut self, slot: Slot, word: Word) {
        self.body.known.insert(slot, word);
    }

    /// Stores the result of a step for other parts of the block.
    pub fn keep(&mut self, slot: Slot, width: u8) {
        let word = self.clean(slot, width);
        self.store(slot, word.value);
    }

    /// Returns the word of a slot of `width` bits; bits above them are arbitrary.
    pub fn word(&mut self, slot: Slot, width: u8) -> Word {
        if let Some(&number) = self.constants.get(&slot) {
            // One slot holds a constant for all widths.
            return Word {
                value: Value::Number(number),
                bits: 64 - number.leading_zeros() as u8,
                width,
            };
        }
        if let Some(&word) = self.body.known.get(&slot) {
            return word;
        }
        let word = Word {
            value: self.load(slot),
            bits: width,
            width,
        };
        self.know(slot, word);
        word
    }

    /// Returns the word of a slot, with zeros above its bits.
    pub fn clean(&mut self, slot: Slot, width: u8) -> Word {
        let word = self.word(slot, width);
        if word.bits <= word.width {
            return word;
        }
        let low = mask(word.width);
        let clean = Word {
            value: match word.value {
                Value::Number(number) => Value::Number(number & low),
                value => self.apply([value, Value::Number(low)], |ins| {
                    ins.i64_and();
                }),
            },
            bits: word.width,
            width: word.width,
        };
        self.know(slot, clean);
        clean
    }

    /// Stores a word in its slot, and records the bits to set if it differs from the old one.
    pub fn store_tracked(&mut self, slot: Slot, word: Word, changes: &mut Changes) {
        let targets = self.bits_of(slot);
        if !targets.is_empty() {
            let old = self.word(slot, word.width);
            let difference = self.apply([old.value, word.value], |ins| {
                ins.i64_xor();
            });
            changes.entry(targets).or_default().push(difference);
        }
        self.store(slot, word.value);
        self.know(slot, word);
    }

    /// Returns the bits to set when this slot changes, without those of blocks that always run.
    fn bits_of(&self, slot: Slot) -> Bits {
        let layout = self.layout;
        let readers = layout.readers.get(slot as usize).into_iter().flatten();
        let mut targets = self.woken(readers.copied());
        if let Some(Some(change)) = layout.changes.get(slot as usize) {
            targets.push((change.word, change.mask));
            targets.push((layout.event, 1));
        }
        targets
    }

    /// Returns those bits of words of `dirty` that belong to woken blocks.
    fn woken(&self, readers: impl Iterator<Item = (Slot, u64)>) -> Bits {
        readers
            .filter_map(|(word, bits)| {
                let number = word.checked_sub(self.layout.dirty)? as usize;
                let bits = bits & self.cold.get(number)?;
                (bits != 0).then_some((word, bits))
            })
            .collect()
    }

    /// Emits code that wakes the readers of a slot and marks it as changed.
    pub fn wake_readers(&mut self, slot: Slot) {
        let bits = self.bits_of(slot);
        self.set(&bits);
    }

    /// Emits code that wakes these blocks.
    pub fn wake(&mut self, bits: &[u32]) {
        let mut words: BTreeMap<Slot, u64> = BTreeMap::new();
        for bit in bits {
            *words.entry(self.layout.dirty + bit / 64).or_default() |= 1 << (bit % 64);
        }
        let bits = self.woken(words.into_iter());
        self.set(&bits);
    }

    fn set(&mut self, bits: &Bits) {
        for &(slot, bits) in bits {
            self.change(slot, |ins| {
                ins.i64_const(bits as i64).i64_or();
            });
        }
    }

    /// Emits code that sets the recorded bits.
    pub fn flush(&mut self, changes: Changes) {
        for (bits, words) in changes {
            for (number, word) in words.into_iter().enumerate() {
                self.push(word);
                if number > 0 {
                    self.ins().i64_or();
                }
            }
            self.when_top(|emitter| emitter.set(&bits));
        }
    }
}
