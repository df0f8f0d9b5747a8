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

/// A word in the making.
#[derive(Clone, Copy)]
pub(super) struct Word {
    pub value: Value,
    /// The bits above so many are 0. They may be more than the word has, and those in between
    /// anything: a mask waits until somebody sees them.
    pub bits: u8,
    pub width: u8,
}

/// What changes set: bits in words.
type Marks = Vec<(Slot, u64)>;

/// What has changed, by whom it tells.
pub(super) type Changes = BTreeMap<Marks, Word>;

/// Knowledge of a slot: a word, and how long it holds.
#[derive(Clone, Copy, Default)]
struct Known {
    /// Since which block, and which part of it.
    since: (u32, u32),
    word: Option<Word>,
}

pub(super) struct Emitter<'f> {
    cursor: FuncCursor<'f>,
    layout: &'f Layout,
    /// The blocks that are woken, as bits of the words of `dirty`.
    cold: Vec<u64>,
    base: Value,
    constants: FxHashMap<Slot, u64>,
    /// Words of slots that hold in the block under way, if their number is that of the block.
    known: Vec<Known>,
    epoch: u32,
    /// The part of the block.
    part: u32,
    /// How many words a part makes at most.
    pub part_size: usize,
    /// Whether an offset was asked for that no slab has.
    pub outside: bool,
}

impl<'f> Emitter<'f> {
    /// One at the beginning of a function, of which it gives the parameters.
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

    /// A new block, which goes nowhere yet.
    pub fn block(&mut self) -> Block {
        self.cursor.func.dfg.make_block()
    }

    /// A new block with a word as parameter.
    pub fn block_with(&mut self) -> (Block, Value) {
        let block = self.block();
        let word = self.cursor.func.dfg.append_block_param(block, types::I64);
        (block, word)
    }

    /// Goes on in a block.
    pub fn begin(&mut self, block: Block) {
        self.cursor.func.layout.append_block(block);
        self.cursor.goto_bottom(block);
    }

    pub fn jump(&mut self, to: Block) {
        self.ins().jump(to, &[]);
    }

    pub fn jump_with(&mut self, to: Block, word: Value) {
        self.ins().jump(to, &[BlockArg::Value(word)]);
    }

    pub fn branch(&mut self, choose: Value, then: Block, other: Block) {
        self.ins().brif(choose, then, &[], other, &[]);
    }

    /// Goes to the block with this number.
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

    /// The place of so many words in the slab: the only way to one.
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

    /// A word of a memory of so many. The index is below `words`: see [`Self::bounded`].
    pub fn load_of(&mut self, first: Slot, words: u32, index: Value) -> Value {
        let offset = self.offset(first, words);
        let place = self.place(index);
        self.ins()
            .load(types::I64, MemFlagsData::trusted(), place, offset)
    }

    /// The same.
    pub fn store_of(&mut self, first: Slot, words: u32, index: Value, word: Value) {
        let offset = self.offset(first, words);
        let place = self.place(index);
        self.ins()
            .store(MemFlagsData::trusted(), word, place, offset);
    }

    fn place(&mut self, index: Value) -> Value {
        let base = self.base;
        let bytes = self.ins().ishl_imm_u(index, 3);
        self.ins().iadd(base, bytes)
    }

    /// The index, or another one below `words`, of which there is one at least.
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

    /// The bits that a number has too.
    pub fn and(&mut self, word: Value, number: u64) -> Value {
        let number = self.number(number);
        self.ins().band(word, number)
    }

    /// The low bits of a word.
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

    /// Nothing is known of any slot any more.
    pub fn forget(&mut self) {
        self.epoch += 1;
    }

    /// Another part of the block begins: words are loaded again, so that no more of them are alive
    /// at once than a part has. Those of steps are to be [stored](Self::keep) before.
    pub fn part(&mut self) {
        self.part += 1;
    }

    /// A slot holds this from here on.
    pub fn know(&mut self, slot: Slot, word: Word) {
        let since = (self.epoch, self.part);
        if let Some(known) = self.known.get_mut(slot as usize) {
            *known = Known {
                since,
                word: Some(word),
            };
        }
    }

    /// Stores what a step has made, for other parts of the block.
    pub fn keep(&mut self, slot: Slot, width: u8) {
        let value = self.clean(slot, width);
        self.store(slot, value);
    }

    /// What a slot of so many bits holds, with anything above them.
    pub fn word(&mut self, slot: Slot, width: u8) -> Word {
        let known = self.known.get(slot as usize).copied().unwrap_or_default();
        let known = known.word.map(|word| (known.since, word));
        let word = match (self.constants.get(&slot).copied(), known) {
            // One slot has a constant for all widths.
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

    /// What a slot holds, with zeros above its bits.
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

    /// The blocks of a word of `dirty` that are woken.
    pub fn cold_of(&self, word: u32) -> u64 {
        self.cold.get(word as usize).copied().unwrap_or(0)
    }

    /// What a slot always holds, if it does.
    pub fn constant(&self, slot: Slot) -> Option<u64> {
        self.constants.get(&slot).copied()
    }

    /// Puts words in their places, and notes whom that tells, if they are other ones.
    pub fn put(&mut self, slot: Slot, word: Word, changes: &mut Changes) {
        let marks = self.marks(slot);
        if !marks.is_empty() {
            let old = self.word(slot, word.width);
            let value = self.ins().bxor(old.value, word.value);
            let bits = old.bits.max(word.bits);
            self.note(
                marks,
                Word {
                    value,
                    bits,
                    ..word
                },
                changes,
            );
        }
        self.store(slot, word.value);
        self.know(slot, word);
    }

    /// Notes that a slot changes where a word is not 0.
    pub fn changes(&mut self, slot: Slot, word: Word, changes: &mut Changes) {
        let marks = self.marks(slot);
        self.note(marks, word, changes);
    }

    /// Notes that these are to be set where a word is not 0.
    pub fn note(&mut self, marks: Marks, word: Word, changes: &mut Changes) {
        if marks.is_empty() {
            return;
        }
        let word = match changes.get(&marks) {
            Some(other) => Word {
                value: self.ins().bor(other.value, word.value),
                bits: word.bits.max(other.bits),
                ..word
            },
            None => word,
        };
        changes.insert(marks, word);
    }

    /// Whom it tells that a slot changes, without blocks that run anyway.
    fn marks(&self, slot: Slot) -> Marks {
        let layout = self.layout;
        let readers = layout.readers.get(slot as usize).into_iter().flatten();
        let mut marks = self.woken(readers.copied());
        if let Some(Some(change)) = layout.changes.get(slot as usize) {
            marks.push((change.word, change.mask));
            marks.push((layout.event, 1));
        }
        marks
    }

    /// Those bits of words of `dirty` whose blocks are woken.
    pub fn woken(&self, readers: impl Iterator<Item = (Slot, u64)>) -> Marks {
        readers
            .filter_map(|(word, bits)| {
                let number = word.checked_sub(self.layout.dirty)? as usize;
                let bits = bits & self.cold.get(number)?;
                (bits != 0).then_some((word, bits))
            })
            .collect()
    }

    /// The marks that wake these blocks.
    pub fn wakes(&self, bits: &[u32]) -> Marks {
        let mut words: BTreeMap<Slot, u64> = BTreeMap::new();
        for bit in bits {
            *words.entry(self.layout.dirty + bit / 64).or_default() |= 1 << (bit % 64);
        }
        self.woken(words.into_iter())
    }

    /// Sets what is noted.
    pub fn tell(&mut self, changes: Changes) {
        let mut words: BTreeMap<Slot, BTreeMap<u64, Word>> = BTreeMap::new();
        for (marks, word) in changes {
            for (slot, bits) in marks {
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

    /// The bits where a word is not 0.
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
