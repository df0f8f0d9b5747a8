//! Machine code of a block, inlined into the function.

use super::choices::Choices;
use super::emit::{Changes, Emitter, Word};
use crate::engine::codegen::{is_long, kept};
use crate::engine::flat::mask;
use crate::engine::layout::Slot;
use crate::engine::plan::{Block, Code, Plan, PlannedMemory, Step, Write};
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, InstBuilder, Type, Value, types};

/// Emits a block that settles nets.
pub(super) fn settle(emitter: &mut Emitter<'_>, plan: &Plan, block: &Block) {
    steps(emitter, plan, block);
    parts(
        emitter,
        block,
        &block.outputs,
        |emitter, &(from, to), changes| {
            let word = clean(emitter, from, 64);
            emitter.store_tracked(to, word, changes);
        },
    );
}

/// Emits a block that makes the edge: registers are written after everything that reads them.
pub(super) fn edge(emitter: &mut Emitter<'_>, plan: &Plan, place: usize) {
    let block = &plan.blocks[place];
    if !is_long(block, emitter.part_size) {
        return by_choices(emitter, plan, place);
    }
    steps(emitter, plan, block);
    parts(emitter, block, &block.writes, |emitter, write, _| {
        Port::of(emitter, plan, write).emit(emitter, plan, place);
    });
    parts(
        emitter,
        block,
        &block.registers,
        |emitter, &(register, from), changes| {
            let register = &plan.registers[register as usize];
            let word = clean(emitter, from, register.width);
            match register.shadow {
                Some(shadow) => emitter.store(shadow, word.value),
                None => emitter.store_tracked(register.slot, word, changes),
            }
        },
    );
}

/// Emits a block whose words are computed where they are needed.
fn by_choices(emitter: &mut Emitter<'_>, plan: &Plan, place: usize) {
    let block = &plan.blocks[place];
    let mut choices = Choices::new(emitter, plan, block);
    choices.reads_first();
    for write in &block.writes {
        choices.need(write.enable);
        let enable = choices.emitter.clean(write.enable, 1);
        let (on, done) = (choices.emitter.block(), choices.emitter.block());
        choices.emitter.branch(enable, on, done);
        choices.emitter.begin(on);
        choices.scope(|choices| {
            choices.need(write.data);
            write.address.iter().for_each(|&slot| choices.need(slot));
            let port = Port::of(choices.emitter, plan, write);
            port.write(choices.emitter, plan, place, done);
        });
        choices.emitter.continue_in(done);
    }
    choices.registers();
}

/// Commits the shadows of a block to its registers.
pub(super) fn commit(emitter: &mut Emitter<'_>, plan: &Plan, block: &Block) {
    parts(
        emitter,
        block,
        &block.registers,
        |emitter, &(register, _), changes| {
            let register = &plan.registers[register as usize];
            if let Some(shadow) = register.shadow {
                let word = clean(emitter, shadow, register.width);
                emitter.store_tracked(register.slot, word, changes);
            }
        },
    );
}

/// Emits code for all items in parts, and sets the dirty bits of what they change.
fn parts<T>(
    emitter: &mut Emitter<'_>,
    block: &Block,
    all: &[T],
    mut each: impl FnMut(&mut Emitter<'_>, &T, &mut Changes),
) {
    let size = emitter.part_size;
    for part in all.chunks(size) {
        if is_long(block, size) {
            emitter.part();
        }
        let mut changes = Changes::new();
        for one in part {
            each(emitter, one, &mut changes);
        }
        emitter.flush(changes);
    }
}

pub(super) fn clean(emitter: &mut Emitter<'_>, slot: Slot, width: u8) -> Word {
    emitter.clean(slot, width);
    emitter.word(slot, width)
}

/// Port of a memory, with the words that it reads.
struct Port<'p> {
    memory: &'p PlannedMemory,
    enable: Value,
    data: Value,
    address: Option<Value>,
}

impl<'p> Port<'p> {
    fn of(emitter: &mut Emitter<'_>, plan: &'p Plan, write: &Write) -> Self {
        let memory = &plan.memories[write.memory as usize];
        Port {
            memory,
            enable: emitter.clean(write.enable, 1),
            data: emitter.clean(write.data, memory.width),
            address: write.address.map(|address| emitter.clean(address, 64)),
        }
    }

    fn emit(self, emitter: &mut Emitter<'_>, plan: &Plan, place: usize) {
        let (write, done) = (emitter.block(), emitter.block());
        emitter.branch(self.enable, write, done);
        emitter.begin(write);
        self.write(emitter, plan, place, done);
        emitter.continue_in(done);
    }

    /// Emits an enabled write; leaves for `done` if it changes nothing.
    fn write(&self, emitter: &mut Emitter<'_>, plan: &Plan, place: usize, done: ir::Block) {
        match (self.address, self.memory.head) {
            (Some(address), _) => self.word(emitter, address, done),
            (None, Some(head)) => self.shift(emitter, head, plan.bit(place) as u32),
            (None, None) => {}
        }
    }

    /// Emits a RAM write, skipped if the address is past the end or the word is unchanged.
    fn word(&self, emitter: &mut Emitter<'_>, address: Value, done: ir::Block) {
        let memory = self.memory;
        let words = emitter.number(memory.words.into());
        let within = emitter.ins().icmp(IntCC::UnsignedLessThan, address, words);
        let (look, write) = (emitter.block(), emitter.block());
        emitter.branch(within, look, done);
        emitter.begin(look);
        let old = emitter.load_of(memory.first, memory.words, address);
        let other = emitter.ins().icmp(IntCC::NotEqual, old, self.data);
        emitter.branch(other, write, done);
        emitter.begin(write);
        self.store(emitter, address);
    }

    /// Emits the shift of all stages of a shift register.
    fn shift(&self, emitter: &mut Emitter<'_>, head: Slot, bit: u32) {
        let memory = self.memory;
        let mut changes = Changes::new();
        let own = emitter.bits_of_blocks(&[bit]);
        let one = one(emitter);
        emitter.record(own, one, &mut changes);
        emitter.flush(changes);
        let before = emitter.load(head);
        let last = emitter.number(u64::from(memory.words).saturating_sub(1));
        let less = emitter.ins().iadd_imm_s(before, -1);
        let first = emitter.ins().select(before, less, last);
        let first = emitter.bounded(first, memory.words);
        emitter.store(head, first);
        if memory.words > 0 {
            self.store(emitter, first);
        }
    }

    fn store(&self, emitter: &mut Emitter<'_>, index: Value) {
        let memory = self.memory;
        emitter.store_of(memory.first, memory.words, index, self.data);
        emitter.store(memory.written, index);
        let mark = emitter.load(memory.mark);
        let mark = emitter.ins().iadd_imm_s(mark, 1);
        emitter.store(memory.mark, mark);
        let mut changes = Changes::new();
        let one = one(emitter);
        emitter.record_slot(memory.mark, one, &mut changes);
        let readers = emitter.bits_of_blocks(&memory.readers);
        emitter.record(readers, one, &mut changes);
        emitter.flush(changes);
    }
}

fn one(emitter: &mut Emitter<'_>) -> Word {
    Word {
        value: emitter.number(1),
        bits: 1,
        width: 1,
    }
}

fn steps(emitter: &mut Emitter<'_>, plan: &Plan, block: &Block) {
    let size = emitter.part_size;
    let kept = kept(block, size);
    for (number, step) in block.steps.iter().enumerate() {
        if number > 0 && number.is_multiple_of(size) {
            emitter.part();
        }
        let (value, bits) = value(emitter, plan, step);
        let width = step.width;
        emitter.know(step.to, Word { value, bits, width });
        if kept.contains(&step.to) {
            emitter.keep(step.to, width);
        }
    }
}

/// Emits the value of a step; also returns the number of low bits that may be high.
pub(super) fn value(emitter: &mut Emitter<'_>, plan: &Plan, step: &Step) -> (Value, u8) {
    let Step {
        code,
        width,
        from,
        by,
        a,
        b,
        c,
        ..
    } = *step;
    match code {
        Code::Not => {
            let a = emitter.word(a, from);
            let all = emitter.number(mask(width));
            (emitter.ins().bxor(a.value, all), a.bits.max(width))
        }
        Code::Negate => {
            let a = emitter.word(a, from);
            (emitter.ins().ineg(a.value), 64)
        }
        Code::Add => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            let bits = (a.bits.max(b.bits) + 1).min(64);
            (emitter.ins().iadd(a.value, b.value), bits)
        }
        Code::Subtract => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            (emitter.ins().isub(a.value, b.value), 64)
        }
        Code::Multiply => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            let bits = (a.bits + b.bits).min(64);
            (emitter.ins().imul(a.value, b.value), bits)
        }
        Code::And => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            (emitter.ins().band(a.value, b.value), a.bits.min(b.bits))
        }
        Code::Or => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            (emitter.ins().bor(a.value, b.value), a.bits.max(b.bits))
        }
        Code::Xor => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            (emitter.ins().bxor(a.value, b.value), a.bits.max(b.bits))
        }
        Code::Equal => {
            let (a, b) = (emitter.clean(a, from), emitter.clean(b, by));
            compare(emitter, IntCC::Equal, a, b)
        }
        Code::Below => {
            let (a, b) = (emitter.clean(a, from), emitter.clean(b, by));
            compare(emitter, IntCC::UnsignedLessThan, a, b)
        }
        Code::BelowSigned => {
            let (a, b) = (signed(emitter, a, from), signed(emitter, b, by));
            compare(emitter, IntCC::SignedLessThan, a, b)
        }
        Code::Mux => {
            let choose = emitter.clean(a, from);
            let (then, other) = (emitter.word(b, width), emitter.word(c, width));
            let value = emitter.ins().select(choose, then.value, other.value);
            (value, then.bits.max(other.bits))
        }
        Code::ShiftLeft if by >= 64 => (emitter.number(0), 0),
        Code::ShiftLeft => {
            let a = emitter.word(a, from);
            let value = emitter.ins().ishl_imm_u(a.value, i64::from(by));
            (value, (a.bits + by).min(64))
        }
        Code::ShiftRight | Code::Slice if by >= 64 => (emitter.number(0), 0),
        Code::ShiftRight | Code::Slice => {
            // Bits above those of the operand matter if they move down to it.
            if u16::from(by) + u16::from(width) >= u16::from(from) {
                emitter.clean(a, from);
            }
            let a = emitter.word(a, from);
            let value = emitter.ins().ushr_imm_u(a.value, i64::from(by));
            (value, a.bits.saturating_sub(by))
        }
        Code::ShiftRightSigned => {
            let word = emitter.word(a, from);
            let spare = 64 - from.min(64);
            let top = emitter.ins().ishl_imm_u(word.value, i64::from(spare));
            let by = i64::from((by.min(63) + spare).min(63));
            (emitter.ins().sshr_imm_u(top, by), 64)
        }
        Code::Extend => {
            emitter.clean(a, from);
            let a = emitter.word(a, from);
            (a.value, a.bits)
        }
        Code::ExtendSigned => {
            let word = emitter.word(a, from);
            match narrow(from) {
                _ if word.bits < from => (word.value, word.bits),
                _ if from == 64 => (word.value, 64),
                Some(kind) => {
                    let low = emitter.ins().ireduce(kind, word.value);
                    (emitter.ins().sextend(types::I64, low), 64)
                }
                None => {
                    let spare = i64::from(64 - from);
                    let up = emitter.ins().ishl_imm_u(word.value, spare);
                    (emitter.ins().sshr_imm_u(up, spare), 64)
                }
            }
        }
        Code::Join => {
            let high = emitter.word(a, from);
            emitter.clean(b, by);
            let low = emitter.word(b, by);
            let value = emitter.ins().ishl_imm_u(high.value, i64::from(by.min(63)));
            let bits = (high.bits + by).min(64).max(low.bits);
            (emitter.ins().bor(value, low.value), bits)
        }
        Code::Read => {
            let address = emitter.clean(a, from);
            read(emitter, &plan.memories[c as usize], address, from)
        }
    }
}

fn compare(emitter: &mut Emitter<'_>, how: IntCC, a: Value, b: Value) -> (Value, u8) {
    let value = emitter.ins().icmp(how, a, b);
    (emitter.ins().uextend(types::I64, value), 1)
}

/// Returns the machine type of words of `width` bits, if there is one.
fn narrow(width: u8) -> Option<Type> {
    match width {
        8 => Some(types::I8),
        16 => Some(types::I16),
        32 => Some(types::I32),
        _ => None,
    }
}

/// Emits a word for a two's complement comparison: its sign is the highest bit of its type.
fn signed(emitter: &mut Emitter<'_>, slot: Slot, width: u8) -> Value {
    let word = emitter.word(slot, width);
    match (narrow(width), emitter.constant(slot)) {
        (Some(kind), _) => emitter.ins().ireduce(kind, word.value),
        (None, Some(number)) => emitter.number(number << (64 - width)),
        (None, None) => {
            let spare = i64::from(64 - width);
            emitter.ins().ishl_imm_u(word.value, spare)
        }
    }
}

/// Emits the word of a memory, or the stage of a shift register; 0 past its end.
fn read(
    emitter: &mut Emitter<'_>,
    memory: &PlannedMemory,
    address: Value,
    width: u8,
) -> (Value, u8) {
    let words = memory.words;
    if words == 0 {
        return (emitter.number(0), 0);
    }
    let place = match memory.head {
        Some(head) => {
            let head = emitter.load(head);
            let place = emitter.ins().iadd(address, head);
            match words.is_power_of_two() {
                true => place,
                false => {
                    let count = emitter.number(words.into());
                    let past = emitter.ins().isub(place, count);
                    let within = emitter.ins().icmp(IntCC::UnsignedLessThan, place, count);
                    emitter.ins().select(within, place, past)
                }
            }
        }
        None => address,
    };
    let place = emitter.bounded(place, words);
    let word = emitter.load_of(memory.first, words, place);
    if u64::from(words) > mask(width) {
        return (word, memory.width);
    }
    let (count, none) = (emitter.number(words.into()), emitter.number(0));
    let within = emitter.ins().icmp(IntCC::UnsignedLessThan, address, count);
    (emitter.ins().select(within, word, none), memory.width)
}
