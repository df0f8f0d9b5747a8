//! Instructions on words of the slab.

use crate::engine::flat::mask;
use crate::engine::layout::{Layout, Slot};
use cranelift_codegen::cursor::{Cursor, FuncCursor};
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    Block, BlockArg, BlockCall, Function, InsertBuilder, InstBuilder, JumpTableData, MemFlagsData,
    Value, types,
};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Word in a machine register.
#[derive(Clone, Copy)]
pub(super) struct Word {
    pub value: Value,
    /// Number of low bits that may be set; higher bits are 0. It may exceed the width of the word:
    /// masking is delayed until the upper bits matter.
    pub bits: u8,
    pub width: u8,
}

/// Bits to set, as words of the slab and masks.
type Bits = Vec<(Slot, u64)>;

/// Changes of the current block: for each set of bits, a word that is not 0 if they are to be set.
pub(super) type Changes = BTreeMap<Bits, Word>;

/// Known word of a slot, and its validity.
#[derive(Clone, Copy, Default)]
struct Known {
    /// Block and part in which the word became known.
    since: (u32, u32),
    word: Option<Word>,
}

pub(super) struct Emitter<'f> {
    cursor: FuncCursor<'f>,
    layout: &'f Layout,
    /// Woken blocks, as bits of the words of `dirty`; the other blocks always run.
    cold: Vec<u64>,
    base: Value,
    constants: FxHashMap<Slot, u64>,
    /// Known words of slots, valid if their epoch is that of the current block.
    known: Vec<Known>,
    /// Words that became known since the outermost [`open`](Self::open), with what was known before.
    undo: Vec<(Slot, Known)>,
    scopes: u32,
    epoch: u32,
    /// Current part of the block.
    part: u32,
    /// Greatest number of words computed in a part.
    pub part_size: usize,
    /// True if an offset beyond the slab was requested.
    pub outside: bool,
}

impl<'f> Emitter<'f> {
    /// Creates an emitter at the beginning of a function; also returns the function's parameters.
    pub fn new(
        func: &'f mut Function,
        layout: &'f Layout,
        cold: Vec<u64>,
        part_size: usize,
    ) -> (Self, Vec<Value>) {
        let entry = func.dfg.make_block();
        let types: Vec<_> = func.signature.params.iter().map(|p| p.value_type).collect();
        let parameters: Vec<_> = types
            .into_iter()
            .map(|kind| func.dfg.append_block_param(entry, kind))
            .collect();
        let mut emitter = Emitter {
            cursor: FuncCursor::new(func),
            layout,
            cold,
            base: parameters[0],
            constants: layout.constants.iter().copied().collect(),
            known: vec![Known::default(); layout.words as usize],
            undo: Vec::new(),
            scopes: 0,
            epoch: 0,
            part: 0,
            part_size,
            outside: false,
        };
        emitter.begin(entry);
        (emitter, parameters)
    }

    pub fn ins(&mut self) -> InsertBuilder<'_, &mut FuncCursor<'f>> {
        self.cursor.ins()
    }

    /// Creates a block without instructions.
    pub fn block(&mut self) -> Block {
        self.cursor.func.dfg.make_block()
    }

    /// Creates a block with a word as parameter.
    pub fn block_with(&mut self) -> (Block, Value) {
        let block = self.block();
        let word = self.cursor.func.dfg.append_block_param(block, types::I64);
        (block, word)
    }

    /// Creates a block with two words as parameters.
    pub fn block_with_two(&mut self) -> (Block, Value, Value) {
        let (block, first) = self.block_with();
        let second = self.cursor.func.dfg.append_block_param(block, types::I64);
        (block, first, second)
    }

    /// Continues in a block.
    pub fn begin(&mut self, block: Block) {
        self.cursor.func.layout.append_block(block);
        self.cursor.goto_bottom(block);
    }

    /// Jumps to a block, and continues in it.
    pub fn continue_in(&mut self, block: Block) {
        self.jump(block);
        self.begin(block);
    }

    pub fn jump(&mut self, to: Block) {
        self.ins().jump(to, &[]);
    }

    pub fn jump_with(&mut self, to: Block, word: Value) {
        self.ins().jump(to, &[BlockArg::Value(word)]);
    }

    pub fn jump_with_two(&mut self, to: Block, first: Value, second: Value) {
        let words = [BlockArg::Value(first), BlockArg::Value(second)];
        self.ins().jump(to, &words);
    }

    pub fn branch(&mut self, choose: Value, then: Block, other: Block) {
        self.ins().brif(choose, then, &[], other, &[]);
    }

    /// Jumps to the block with this number.
    pub fn branch_to(&mut self, number: Value, blocks: &[Block]) {
        let number = self.ins().ireduce(types::I32, number);
        let dfg = &mut self.cursor.func.dfg;
        let calls: Vec<BlockCall> = blocks.iter().map(|&to| dfg.block_call(to, &[])).collect();
        if let Some((last, calls)) = calls.split_last() {
            let table = JumpTableData::new(*last, calls);
            let table = self.cursor.func.create_jump_table(table);
            self.ins().br_table(number, table);
        }
    }

    pub fn number(&mut self, number: u64) -> Value {
        self.ins().iconst(types::I64, number as i64)
    }

    /// Returns the byte offset of `words` words in the slab; every access goes through here.
    fn offset(&mut self, slot: Slot, words: u32) -> i32 {
        let end = u64::from(slot) + u64::from(words);
        match i32::try_from(u64::from(slot) * 8) {
            Ok(offset) if end <= u64::from(self.layout.words) => offset,
            _ => {
                self.outside = true;
                0
            }
        }
    }

    pub fn load(&mut self, slot: Slot) -> Value {
        let (base, offset) = (self.base, self.offset(slot, 1));
        self.ins()
            .load(types::I64, MemFlagsData::trusted(), base, offset)
    }

    pub fn store(&mut self, slot: Slot, word: Value) {
        let (base, offset) = (self.base, self.offset(slot, 1));
        self.ins()
            .store(MemFlagsData::trusted(), word, base, offset);
    }

    /// Loads a word of an array of `words` words. The index must be below `words`: see
    /// [`Self::bounded`].
    pub fn load_of(&mut self, first: Slot, words: u32, index: Value) -> Value {
        let offset = self.offset(first, words);
        let place = self.place(index);
        self.ins()
            .load(types::I64, MemFlagsData::trusted(), place, offset)
    }

    /// Stores a word in an array of `words` words. The index must be below `words`.
    pub fn store_of(&mut self, first: Slot, words: u32, index: Value, word: Value) {
        let offset = self.offset(first, words);
        let place = self.place(index);
        self.ins()
            .store(MemFlagsData::trusted(), word, place, offset);
    }

    /// Loads a word outside of the slab.
    pub fn load_at(&mut self, place: Value, offset: usize) -> Value {
        let flags = MemFlagsData::trusted();
        self.ins().load(types::I64, flags, place, offset as i32)
    }

    /// Stores a word outside of the slab.
    pub fn store_at(&mut self, place: Value, offset: usize, word: Value) {
        let flags = MemFlagsData::trusted();
        self.ins().store(flags, word, place, offset as i32);
    }

    /// Returns the place of a word of an array.
    pub fn place_of(&mut self, base: Value, index: Value) -> Value {
        let bytes = self.ins().ishl_imm_u(index, 3);
        self.ins().iadd(base, bytes)
    }

    fn place(&mut self, index: Value) -> Value {
        self.place_of(self.base, index)
    }

    /// Loads a word of the slab by a slot that is known to be in it.
    pub fn load_slot(&mut self, slot: Value) -> Value {
        let place = self.place(slot);
        self.load_at(place, 0)
    }

    /// Limits an index to values below `words`, which must be at least 1.
    pub fn bounded(&mut self, index: Value, words: u32) -> Value {
        let last = u64::from(words.saturating_sub(1));
        match words.is_power_of_two() {
            true => self.and(index, last),
            false => {
                let last = self.number(last);
                let within = self.ins().icmp(IntCC::UnsignedLessThan, index, last);
                self.ins().select(within, index, last)
            }
        }
    }

    /// Returns the bitwise and with a number.
    pub fn and(&mut self, word: Value, number: u64) -> Value {
        let number = self.number(number);
        self.ins().band(word, number)
    }

    /// Returns the low bits of a word.
    pub fn masked(&mut self, word: Value, width: u8) -> Value {
        let narrow = match width {
            8 => types::I8,
            16 => types::I16,
            32 => types::I32,
            _ => return self.and(word, mask(width)),
        };
        let low = self.ins().ireduce(narrow, word);
        self.ins().uextend(types::I64, low)
    }

    /// Forgets the known words of all slots.
    pub fn forget(&mut self) {
        self.epoch += 1;
    }

    /// Begins code that runs on some paths only: what becomes known there is forgotten when it is
    /// [closed](Self::close).
    pub fn open(&mut self) -> usize {
        self.scopes += 1;
        self.undo.len()
    }

    /// Ends the code that began with `mark`.
    pub fn close(&mut self, mark: usize) {
        self.scopes -= 1;
        while self.undo.len() > mark
            && let Some((slot, before)) = self.undo.pop()
        {
            if let Some(known) = self.known.get_mut(slot as usize) {
                *known = before;
            }
        }
    }

    /// Begins another part of the block: words are loaded again, which limits the number of live
    /// values. Results of steps must be [stored](Self::keep) before.
    pub fn part(&mut self) {
        self.part += 1;
    }

    /// Records the word that a slot holds from here on.
    pub fn know(&mut self, slot: Slot, word: Word) {
        let since = (self.epoch, self.part);
        if let Some(known) = self.known.get_mut(slot as usize) {
            if self.scopes > 0 {
                self.undo.push((slot, *known));
            }
            *known = Known {
                since,
                word: Some(word),
            };
        }
    }

    /// Stores the result of a step for other parts of the block.
    pub fn keep(&mut self, slot: Slot, width: u8) {
        let value = self.clean(slot, width);
        self.store(slot, value);
    }

    /// Returns the word of a slot of `width` bits; bits above them are arbitrary.
    pub fn word(&mut self, slot: Slot, width: u8) -> Word {
        let known = self.known.get(slot as usize).copied().unwrap_or_default();
        let known = known.word.map(|word| (known.since, word));
        let word = match (self.constants.get(&slot).copied(), known) {
            // One slot holds a constant for all widths.
            (Some(_), Some((since, word))) if since == (self.epoch, self.part) => {
                return Word { width, ..word };
            }
            (None, Some((since, word))) if since == (self.epoch, self.part) => return word,
            (None, Some(((epoch, _), word))) if epoch == self.epoch => Word {
                value: self.load(slot),
                ..word
            },
            (Some(number), _) => Word {
                value: self.number(number),
                bits: 64 - number.leading_zeros() as u8,
                width,
            },
            (None, _) => Word {
                value: self.load(slot),
                bits: width,
                width,
            },
        };
        self.know(slot, word);
        word
    }

    /// Returns the word of a slot, with zeros above its bits.
    pub fn clean(&mut self, slot: Slot, width: u8) -> Value {
        let word = self.word(slot, width);
        if word.bits <= word.width {
            return word.value;
        }
        let value = self.masked(word.value, word.width);
        let bits = word.width;
        self.know(
            slot,
            Word {
                value,
                bits,
                ..word
            },
        );
        value
    }

    /// Returns the woken blocks in a word of `dirty`.
    pub fn cold_of(&self, word: u32) -> u64 {
        self.cold.get(word as usize).copied().unwrap_or(0)
    }

    /// Returns the constant of a slot, if it has one.
    pub fn constant(&self, slot: Slot) -> Option<u64> {
        self.constants.get(&slot).copied()
    }

    /// Stores a word in its slot, and records the bits to set if it differs from the old one.
    pub fn store_tracked(&mut self, slot: Slot, word: Word, changes: &mut Changes) {
        self.replace(slot, word, changes);
        self.know(slot, word);
    }

    /// Stores a word as [`store_tracked`](Self::store_tracked) does; code after it that reads the
    /// slot still gets the old word if that was known.
    pub fn replace(&mut self, slot: Slot, word: Word, changes: &mut Changes) {
        let targets = self.bits_of(slot);
        if !targets.is_empty() {
            let old = self.word(slot, word.width);
            let value = self.ins().bxor(old.value, word.value);
            let bits = old.bits.max(word.bits);
            self.record(
                targets,
                Word {
                    value,
                    bits,
                    ..word
                },
                changes,
            );
        }
        self.store(slot, word.value);
    }

    /// Records that a slot changes if a word is not 0.
    pub fn record_slot(&mut self, slot: Slot, word: Word, changes: &mut Changes) {
        let targets = self.bits_of(slot);
        self.record(targets, word, changes);
    }

    /// Records bits to set if a word is not 0.
    pub fn record(&mut self, targets: Bits, word: Word, changes: &mut Changes) {
        if targets.is_empty() {
            return;
        }
        let word = match changes.get(&targets) {
            Some(other) => Word {
                value: self.ins().bor(other.value, word.value),
                bits: word.bits.max(other.bits),
                ..word
            },
            None => word,
        };
        changes.insert(targets, word);
    }

    /// Returns the dirty bits to set when this slot changes, without those of blocks that always
    /// run.
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
    pub fn woken(&self, readers: impl Iterator<Item = (Slot, u64)>) -> Bits {
        readers
            .filter_map(|(word, bits)| {
                let number = word.checked_sub(self.layout.dirty)? as usize;
                let bits = bits & self.cold.get(number)?;
                (bits != 0).then_some((word, bits))
            })
            .collect()
    }

    /// Returns the bits that wake these blocks.
    pub fn bits_of_blocks(&self, bits: &[u32]) -> Bits {
        let mut words: BTreeMap<Slot, u64> = BTreeMap::new();
        for bit in bits {
            *words.entry(self.layout.dirty + bit / 64).or_default() |= 1 << (bit % 64);
        }
        self.woken(words.into_iter())
    }

    /// Emits code that sets the recorded bits.
    pub fn flush(&mut self, changes: Changes) {
        let mut words: BTreeMap<Slot, BTreeMap<u64, Word>> = BTreeMap::new();
        for (targets, word) in changes {
            for (slot, bits) in targets {
                let masks = words.entry(slot).or_default();
                let word = match masks.get(&bits) {
                    Some(other) => Word {
                        value: self.ins().bor(other.value, word.value),
                        bits: word.bits.max(other.bits),
                        ..word
                    },
                    None => word,
                };
                masks.insert(bits, word);
            }
        }
        for (slot, masks) in words {
            let mut all = self.load(slot);
            for (bits, word) in masks {
                let set = self.spread(word, bits);
                all = self.ins().bor(all, set);
            }
            self.store(slot, all);
        }
    }

    /// Returns `bits` if a word is not 0, else 0.
    fn spread(&mut self, word: Word, bits: u64) -> Value {
        match word.bits {
            1 if bits == 1 => word.value,
            1 if bits.is_power_of_two() => {
                let by = i64::from(bits.trailing_zeros());
                self.ins().ishl_imm_u(word.value, by)
            }
            1 => {
                let all = self.ins().ineg(word.value);
                self.and(all, bits)
            }
            _ => {
                let (set, clear) = (self.number(bits), self.number(0));
                self.ins().select(word.value, set, clear)
            }
        }
    }
}
