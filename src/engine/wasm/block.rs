//! Instructions of a block.

use super::emit::{Changes, Emitter, Value, Word};
use crate::engine::codegen::{is_long, kept};
use crate::engine::flat::mask;
use crate::engine::layout::Slot;
use crate::engine::plan::{Block, Code, Plan, PlannedMemory, Step, Write};
use crate::engine::value;

/// Emits a block that settles nets.
pub(super) fn settle(emitter: &mut Emitter<'_>, plan: &Plan, block: &Block) {
    steps(emitter, plan, block);
    parts(
        emitter,
        block,
        &block.outputs,
        |emitter, &(from, to), changes| {
            let word = emitter.clean(from, 64);
            emitter.store_tracked(to, word, changes);
        },
    );
}

/// Emits a block that makes the edge: registers are written after everything that reads them.
pub(super) fn edge(emitter: &mut Emitter<'_>, plan: &Plan, place: usize) {
    let block = &plan.blocks[place];
    steps(emitter, plan, block);
    parts(emitter, block, &block.writes, |emitter, write, _| {
        self::write(emitter, plan, place, write);
    });
    parts(
        emitter,
        block,
        &block.registers,
        |emitter, &(register, from), changes| {
            let register = &plan.registers[register as usize];
            let word = emitter.clean(from, register.width);
            match register.shadow {
                Some(shadow) => emitter.store(shadow, word.value),
                None => emitter.store_tracked(register.slot, word, changes),
            }
        },
    );
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
                let word = emitter.clean(shadow, register.width);
                emitter.store_tracked(register.slot, word, changes);
            }
        },
    );
}

/// Emits code for all items in parts, and sets the bits of what they change.
fn parts<T>(
    emitter: &mut Emitter<'_>,
    block: &Block,
    all: &[T],
    mut each: impl FnMut(&mut Emitter<'_>, &T, &mut Changes),
) {
    for part in all.chunks(emitter.part_size) {
        in_part(emitter, block, |emitter| {
            let mut changes = Changes::new();
            for one in part {
                each(emitter, one, &mut changes);
            }
            emitter.flush(changes);
        });
    }
}

/// Emits a part of a block: as a function of its own if the block is long.
fn in_part(emitter: &mut Emitter<'_>, block: &Block, emit: impl FnOnce(&mut Emitter<'_>)) {
    match is_long(block, emitter.part_size) {
        true => emitter.outline(emit),
        false => emit(emitter),
    }
}

fn steps(emitter: &mut Emitter<'_>, plan: &Plan, block: &Block) {
    let kept = kept(block, emitter.part_size);
    for part in block.steps.chunks(emitter.part_size) {
        in_part(emitter, block, |emitter| {
            for step in part {
                let (value, bits) = result(emitter, plan, step);
                let width = step.width;
                emitter.know(step.to, Word { value, bits, width });
                if kept.contains(&step.to) {
                    emitter.keep(step.to, width);
                }
            }
        });
    }
}

/// Emits a write to a memory.
fn write(emitter: &mut Emitter<'_>, plan: &Plan, place: usize, write: &Write) {
    let memory = &plan.memories[write.memory as usize];
    let enable = emitter.clean(write.enable, 1).value;
    let data = emitter.clean(write.data, memory.width).value;
    let address = write
        .address
        .map(|address| emitter.clean(address, 64).value);
    emitter.when(enable, |emitter| match (address, memory.head) {
        (Some(address), _) => write_word(emitter, memory, address, data),
        (None, Some(head)) => shift(emitter, memory, head, data, plan.bit(place) as u32),
        (None, None) => {}
    });
}

/// Emits a RAM write, skipped if the address is past the end or the word is unchanged.
fn write_word(emitter: &mut Emitter<'_>, memory: &PlannedMemory, address: Value, data: Value) {
    let words = Value::Number(memory.words.into());
    let within = emitter.compare([address, words], |ins| {
        ins.i64_lt_u();
    });
    emitter.when(within, |emitter| {
        let old = emitter.load_of(memory.first, memory.words, address);
        let other = emitter.compare([old, data], |ins| {
            ins.i64_ne();
        });
        emitter.when(other, |emitter| store(emitter, memory, address, data));
    });
}

/// Emits the shift of all stages of a shift register.
fn shift(emitter: &mut Emitter<'_>, memory: &PlannedMemory, head: Slot, data: Value, bit: u32) {
    // Shifting continues even if no operand changes.
    emitter.wake(&[bit]);
    let before = emitter.load(head);
    let last = Value::Number(u64::from(memory.words).saturating_sub(1));
    let less = emitter.apply([before, Value::Number(1)], |ins| {
        ins.i64_sub();
    });
    let first = emitter.select(before, less, last);
    let first = emitter.bounded(first, memory.words);
    emitter.store(head, first);
    if memory.words > 0 {
        store(emitter, memory, first, data);
    }
}

fn store(emitter: &mut Emitter<'_>, memory: &PlannedMemory, index: Value, data: Value) {
    emitter.store_of(memory.first, memory.words, index, data);
    emitter.store(memory.written, index);
    emitter.change(memory.mark, |ins| {
        ins.i64_const(1).i64_add();
    });
    emitter.wake_readers(memory.mark);
    emitter.wake(&memory.readers);
}

/// Emits the value of a step; also returns the number of low bits that may be high.
fn result(emitter: &mut Emitter<'_>, plan: &Plan, step: &Step) -> (Value, u8) {
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
            let all = Value::Number(mask(width));
            let value = emitter.apply([a.value, all], |ins| {
                ins.i64_xor();
            });
            (value, a.bits.max(width))
        }
        Code::Negate => {
            let a = emitter.word(a, from);
            let value = emitter.apply([Value::Number(0), a.value], |ins| {
                ins.i64_sub();
            });
            (value, 64)
        }
        Code::Add | Code::Subtract | Code::Multiply | Code::And | Code::Or | Code::Xor => {
            let (a, b) = (emitter.word(a, from), emitter.word(b, by));
            let value = emitter.apply([a.value, b.value], |ins| {
                match code {
                    Code::Add => ins.i64_add(),
                    Code::Subtract => ins.i64_sub(),
                    Code::Multiply => ins.i64_mul(),
                    Code::And => ins.i64_and(),
                    Code::Or => ins.i64_or(),
                    _ => ins.i64_xor(),
                };
            });
            let bits = match code {
                Code::Add => a.bits.max(b.bits) + 1,
                Code::Subtract => 64,
                Code::Multiply => a.bits + b.bits,
                Code::And => a.bits.min(b.bits),
                _ => a.bits.max(b.bits),
            };
            (value, bits.min(64))
        }
        Code::Equal | Code::Below => {
            let (a, b) = (emitter.clean(a, from), emitter.clean(b, by));
            let value = emitter.compare([a.value, b.value], |ins| {
                match code {
                    Code::Equal => ins.i64_eq(),
                    _ => ins.i64_lt_u(),
                };
            });
            (value, 1)
        }
        Code::BelowSigned => {
            let (a, b) = (signed(emitter, a, from), signed(emitter, b, by));
            let value = emitter.compare([a, b], |ins| {
                ins.i64_lt_s();
            });
            (value, 1)
        }
        Code::Mux => {
            let choose = emitter.clean(a, from);
            let (then, other) = (emitter.word(b, width), emitter.word(c, width));
            let value = emitter.select(choose.value, then.value, other.value);
            (value, then.bits.max(other.bits))
        }
        Code::ShiftLeft | Code::ShiftRight | Code::Slice if by >= 64 => (Value::Number(0), 0),
        Code::ShiftLeft => {
            let a = emitter.word(a, from);
            (left(emitter, a.value, by), (a.bits + by).min(64))
        }
        Code::ShiftRight | Code::Slice => {
            // Bits above those of the operand matter if they move down to it.
            let a = match u16::from(by) + u16::from(width) >= u16::from(from) {
                true => emitter.clean(a, from),
                false => emitter.word(a, from),
            };
            let value = emitter.apply([a.value, Value::Number(by.into())], |ins| {
                ins.i64_shr_u();
            });
            (value, a.bits.saturating_sub(by))
        }
        Code::ShiftRightSigned => {
            let a = signed(emitter, a, from);
            let by = Value::Number(by.min(63).into());
            let value = emitter.apply([a, by], |ins| {
                ins.i64_shr_s();
            });
            (value, 64)
        }
        Code::Extend => {
            let a = emitter.clean(a, from);
            (a.value, a.bits)
        }
        Code::ExtendSigned => {
            let word = emitter.word(a, from);
            match word.bits < from {
                true => (word.value, word.bits),
                false => (signed(emitter, a, from), 64),
            }
        }
        Code::Join => {
            let (high, low) = (emitter.word(a, from), emitter.clean(b, by));
            let up = left(emitter, high.value, by.min(63));
            let value = emitter.apply([up, low.value], |ins| {
                ins.i64_or();
            });
            (value, (high.bits + by).min(64).max(low.bits))
        }
        Code::Read => {
            let address = emitter.clean(a, from);
            let memory = &plan.memories[c as usize];
            (read(emitter, memory, address.value, from), memory.width)
        }
    }
}

fn left(emitter: &mut Emitter<'_>, word: Value, by: u8) -> Value {
    emitter.apply([word, Value::Number(by.into())], |ins| {
        ins.i64_shl();
    })
}

/// Emits the word of a slot as a number in two's complement.
fn signed(emitter: &mut Emitter<'_>, slot: Slot, width: u8) -> Value {
    let word = emitter.word(slot, width).value;
    match (word, width) {
        (_, 64) => word,
        (Value::Number(number), _) => {
            Value::Number(value::signed(number & mask(width), width) as u64)
        }
        (_, 8 | 16 | 32) => emitter.apply([word], |ins| {
            match width {
                8 => ins.i64_extend8_s(),
                16 => ins.i64_extend16_s(),
                _ => ins.i64_extend32_s(),
            };
        }),
        _ => {
            let top = left(emitter, word, 64 - width);
            emitter.apply([top, Value::Number(64 - u64::from(width))], |ins| {
                ins.i64_shr_s();
            })
        }
    }
}

/// Emits the word of a memory, or the stage of a shift register; 0 past its end.
fn read(emitter: &mut Emitter<'_>, memory: &PlannedMemory, address: Value, width: u8) -> Value {
    let words = memory.words;
    if words == 0 {
        return Value::Number(0);
    }
    let count = Value::Number(words.into());
    let place = match memory.head {
        Some(head) => {
            let head = emitter.load(head);
            let place = emitter.apply([address, head], |ins| {
                ins.i64_add();
            });
            match words.is_power_of_two() {
                true => place,
                false => {
                    let past = emitter.apply([place, count], |ins| {
                        ins.i64_sub();
                    });
                    emitter.apply([place, past, place, count], |ins| {
                        ins.i64_lt_u().select();
                    })
                }
            }
        }
        None => address,
    };
    let place = emitter.bounded(place, words);
    let word = emitter.load_of(memory.first, words, place);
    if u64::from(words) > mask(width) {
        return word;
    }
    emitter.apply([word, Value::Number(0), address, count], |ins| {
        ins.i64_lt_u().select();
    })
}
