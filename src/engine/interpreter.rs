//! Reference backend: runs a plan block by block, and a block step by step.

use super::flat::mask;
use super::layout::{Layout, Slot};
use super::plan::{Block, Code, Plan, PlannedMemory, Step, Write};
use super::value::signed;

/// Number of runs of each block.
pub type Counts = Vec<u64>;

/// Settles the nets of a tick: runs the woken blocks.
pub fn settle(plan: &Plan, slab: &mut [u64], counts: &mut Counts) {
    let settling = plan.settling;
    for word in 0..settling.div_ceil(64) {
        let dirty = plan.layout.dirty as usize + word;
        // A block wakes only later ones.
        while slab[dirty] != 0 {
            let place = word * 64 + slab[dirty].trailing_zeros() as usize;
            slab[dirty] &= slab[dirty] - 1;
            counts[place] += 1;
            settle_block(plan, &plan.blocks[place], slab);
        }
    }
}

/// Makes the edge: registers and memories of the next tick.
pub fn edge(plan: &Plan, slab: &mut [u64], counts: &mut Counts) {
    let first = plan.settling.div_ceil(64);
    let words = plan.layout.block_words as usize;
    // Blocks woken by an edge run after it.
    let count = words - first.min(words);
    // Few words need no allocation, which takes longer than a small circuit's edge.
    let (mut few, mut many) = ([0; 8], Vec::new());
    let due = match few.get_mut(..count) {
        Some(few) => few,
        None => {
            many.resize(count, 0);
            &mut many[..]
        }
    };
    for (word, due) in (first..words).zip(&mut *due) {
        let dirty = plan.layout.dirty as usize + word;
        *due = std::mem::take(&mut slab[dirty]);
    }
    for (word, mut due) in (first..words).zip(due.iter().copied()) {
        while due != 0 {
            let edge = (word - first) * 64 + due.trailing_zeros() as usize;
            due &= due - 1;
            let place = plan.settling + edge;
            counts[place] += 1;
            edge_block(plan, place, slab);
        }
    }
    for word in first..words {
        let commit = plan.layout.commit as usize + word;
        let mut due = std::mem::take(&mut slab[commit]);
        while due != 0 {
            let edge = (word - first) * 64 + due.trailing_zeros() as usize;
            due &= due - 1;
            for &(register, _) in &plan.blocks[plan.settling + edge].registers {
                let register = plan.registers[register as usize];
                if let Some(shadow) = register.shadow {
                    let value = slab[shadow as usize];
                    put(&plan.layout, slab, register.slot, value);
                }
            }
        }
    }
}

/// Stores a word in its slot; if it differs from the old one, wakes its readers.
#[inline]
pub fn put(layout: &Layout, slab: &mut [u64], slot: Slot, value: u64) {
    let old = std::mem::replace(&mut slab[slot as usize], value);
    if old != value {
        wake_readers(layout, slab, slot);
    }
}

/// Wakes the readers of a slot and marks it as changed.
fn wake_readers(layout: &Layout, slab: &mut [u64], slot: Slot) {
    for &(word, bits) in &layout.readers[slot as usize] {
        slab[word as usize] |= bits;
    }
    if let Some(change) = layout.changes[slot as usize] {
        slab[change.word as usize] |= change.mask;
        slab[layout.event as usize] = 1;
    }
}

fn settle_block(plan: &Plan, block: &Block, slab: &mut [u64]) {
    steps(plan, block, slab);
    for &(from, to) in &block.outputs {
        let value = slab[from as usize];
        put(&plan.layout, slab, to, value);
    }
}

fn edge_block(plan: &Plan, place: usize, slab: &mut [u64]) {
    let block = &plan.blocks[place];
    steps(plan, block, slab);
    for &(register, from) in &block.registers {
        let register = plan.registers[register as usize];
        if let Some(shadow) = register.shadow {
            slab[shadow as usize] = slab[from as usize];
        }
    }
    for write in &block.writes {
        self::write(plan, place, write, slab);
    }
    for &(register, from) in &block.registers {
        let register = plan.registers[register as usize];
        if register.shadow.is_none() {
            let value = slab[from as usize];
            put(&plan.layout, slab, register.slot, value);
        }
    }
    if block.commits {
        let bit = plan.bit(place);
        slab[plan.layout.commit as usize + bit / 64] |= 1 << (bit % 64);
    }
}

fn write(plan: &Plan, place: usize, write: &Write, slab: &mut [u64]) {
    if slab[write.enable as usize] == 0 {
        return;
    }
    let memory = &plan.memories[write.memory as usize];
    let data = slab[write.data as usize];
    let word = match (write.address, memory.head) {
        (Some(address), _) => slab[address as usize],
        (None, Some(head)) => {
            let before = slab[head as usize].checked_sub(1);
            let head_word = before.unwrap_or(u64::from(memory.words).saturating_sub(1));
            slab[head as usize] = head_word;
            // Shifting continues even if no operand changes.
            let bit = plan.bit(place);
            slab[plan.layout.dirty as usize + bit / 64] |= 1 << (bit % 64);
            head_word
        }
        (None, None) => return,
    };
    if word < u64::from(memory.words) {
        let old = std::mem::replace(&mut slab[memory.first as usize + word as usize], data);
        // A stage that keeps its word still moves all others.
        if old == data && memory.head.is_none() {
            return;
        }
        slab[memory.written as usize] = word;
        slab[memory.mark as usize] = slab[memory.mark as usize].wrapping_add(1);
        wake_readers(&plan.layout, slab, memory.mark);
        for bit in &memory.readers {
            slab[(plan.layout.dirty + bit / 64) as usize] |= 1 << (bit % 64);
        }
    }
}

/// Returns the word of a memory at an address, or the stage of a shift register.
#[inline]
pub fn read(memory: &PlannedMemory, slab: &[u64], address: u64) -> u64 {
    if address >= u64::from(memory.words) {
        return 0;
    }
    let mut place = address as usize;
    if let Some(head) = memory.head {
        place += slab[head as usize] as usize;
        if place >= memory.words as usize {
            place -= memory.words as usize;
        }
    }
    slab[memory.first as usize + place]
}

fn steps(plan: &Plan, block: &Block, slab: &mut [u64]) {
    for step in &block.steps {
        slab[step.to as usize] = value(plan, step, slab);
    }
}

/// Returns the result of a step.
#[inline]
fn value(plan: &Plan, step: &Step, slab: &[u64]) -> u64 {
    let a = slab[step.a as usize];
    let b = || slab[step.b as usize];
    let value = match step.code {
        Code::Not => !a,
        Code::Negate => a.wrapping_neg(),
        Code::Add => a.wrapping_add(b()),
        Code::Subtract => a.wrapping_sub(b()),
        Code::Multiply => a.wrapping_mul(b()),
        Code::And => a & b(),
        Code::Or => a | b(),
        Code::Xor => a ^ b(),
        Code::Equal => (a == b()).into(),
        Code::Below => (a < b()).into(),
        Code::BelowSigned => (signed(a, step.from) < signed(b(), step.from)).into(),
        Code::Mux => match a {
            0 => slab[step.c as usize],
            _ => b(),
        },
        Code::ShiftLeft => a.checked_shl(step.by.into()).unwrap_or(0),
        Code::ShiftRight | Code::Slice => a.checked_shr(step.by.into()).unwrap_or(0),
        Code::ShiftRightSigned => (signed(a, step.from) >> step.by.min(63)) as u64,
        Code::Extend => a,
        Code::ExtendSigned => signed(a, step.from) as u64,
        Code::Join => a.checked_shl(step.by.into()).unwrap_or(0) | b(),
        Code::Read => read(&plan.memories[step.c as usize], slab, a),
    };
    value & mask(step.width)
}
