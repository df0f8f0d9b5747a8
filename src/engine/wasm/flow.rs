//! Control flow of a module: edges and settlings in a loop, and in each the blocks that are due.

use super::block;
use super::emit::{Emitter, Value};
use super::{CompileError, EDGE};
use crate::engine::codegen::{GROUP, cold, is_hot, is_whole, runs, words};
use crate::engine::layout::Slot;
use crate::engine::plan::Plan;
use wasm_encoder::{BlockType, Function, InstructionSink};

/// Emits the functions of a plan with their types; the last one is the entry.
pub(super) fn emit(
    plan: &Plan,
    hot: &[bool],
    part_size: usize,
    long: usize,
) -> Result<Vec<(u32, Function)>, CompileError> {
    if !is_whole(plan) {
        return Err(CompileError::Plan);
    }
    let cold = cold(plan, hot);
    let mut flow = Flow {
        emitter: Emitter::new(&plan.layout, cold.clone(), part_size),
        plan,
        hot,
        cold,
        long,
        functions: Vec::new(),
    };
    flow.settle();
    let settle = flow.end();
    flow.edge();
    let edge = flow.end();
    let event = flow.emitter.place(plan.layout.event, 1);
    if flow.emitter.outside {
        return Err(CompileError::Plan);
    }
    // The blocks are functions of their own: hosts replace a function by a faster one when it is
    // called, and not while it runs.
    Ok(flow.emitter.functions(|ins| {
        let [slab, phase, ticks] = [0, 1, 2];
        ins.loop_(BlockType::Empty);
        ins.local_get(phase).if_(BlockType::Empty);
        call(ins, slab, &edge);
        ins.local_get(ticks).i64_eqz().if_(BlockType::Empty);
        ins.i64_const(0).return_().end().end();
        call(ins, slab, &settle);
        ins.local_get(ticks).i64_const(1).i64_sub().local_set(ticks);
        ins.i32_const(EDGE as i32).local_set(phase);
        // The next tick, if there is one and nothing watched has changed.
        ins.local_get(ticks).i64_const(0).i64_ne();
        ins.local_get(slab).i64_load(event).i64_eqz();
        ins.i32_and().br_if(0).end();
        ins.local_get(ticks);
    }))
}

fn call(ins: &mut InstructionSink<'_>, slab: u32, functions: &[u32]) {
    for &function in functions {
        ins.local_get(slab).call(function);
    }
}

struct Flow<'p> {
    emitter: Emitter<'p>,
    plan: &'p Plan,
    hot: &'p [bool],
    /// Woken blocks, as bits of the words of `dirty`.
    cold: Vec<u64>,
    /// Number of bytes from which on a function is ended.
    long: usize,
    /// Functions of the current phase.
    functions: Vec<u32>,
}

/// Bits of the blocks that are due.
#[derive(Clone, Copy)]
enum Due {
    /// Word of the slab: a block sets the bits of later ones, and all are cleared in the end.
    Word(Slot),
    /// Global with a word that was taken before the first block runs.
    Taken(u32),
}

impl Flow<'_> {
    fn settle(&mut self) {
        let plan = self.plan;
        for run in runs(plan, self.hot, 0..plan.settling) {
            let emit = |emitter: &mut Emitter<'_>, place: usize| {
                block::settle(emitter, plan, &plan.blocks[place]);
            };
            match run.hot {
                true => self.all(&run.blocks, emit),
                false => self.due(
                    &run.blocks,
                    |word| Due::Word(plan.layout.dirty + word),
                    emit,
                ),
            }
        }
    }

    fn edge(&mut self) {
        let plan = self.plan;
        let all: Vec<usize> = (plan.settling..plan.blocks.len()).collect();
        // Blocks woken by an edge run after it.
        for (word, mask, _) in words(plan, &all) {
            if self.cold[word as usize] & mask != 0 {
                let slot = plan.layout.dirty + word;
                self.emitter.push_slot(slot);
                self.emitter.ins().global_set(word);
                self.emitter.store(slot, Value::Number(0));
            }
        }
        for run in runs(plan, self.hot, plan.settling..plan.blocks.len()) {
            let emit = |emitter: &mut Emitter<'_>, place| block::edge(emitter, plan, place);
            match run.hot {
                true => self.all(&run.blocks, emit),
                false => self.due(&run.blocks, Due::Taken, emit),
            }
        }
        let commits = all.into_iter().filter(|&place| plan.blocks[place].commits);
        let (hot, cold): (Vec<usize>, Vec<usize>) =
            commits.partition(|&place| is_hot(self.hot, place));
        let emit = |emitter: &mut Emitter<'_>, place: usize| {
            block::commit(emitter, plan, &plan.blocks[place]);
        };
        self.all(&hot, emit);
        self.due(&cold, Due::Taken, emit);
    }

    /// Emits blocks that always run.
    fn all(&mut self, places: &[usize], emit: impl Fn(&mut Emitter<'_>, usize)) {
        for &place in places {
            self.emitter.forget();
            emit(&mut self.emitter, place);
            self.split();
        }
    }

    /// Emits blocks that run if their bits are set.
    fn due(
        &mut self,
        places: &[usize],
        due: impl Fn(u32) -> Due,
        emit: impl Fn(&mut Emitter<'_>, usize),
    ) {
        for (word, mask, places) in words(self.plan, places) {
            let due = due(word);
            let bit = |place: usize| 1 << (self.plan.bit(place) % 64);
            when(&mut self.emitter, due, mask, |emitter| {
                for group in places.chunks(GROUP) {
                    let bits = group.iter().fold(0, |bits, &place| bits | bit(place));
                    let each = |emitter: &mut Emitter<'_>| {
                        for &place in group {
                            let one = |emitter: &mut Emitter<'_>| {
                                emitter.forget();
                                emit(emitter, place);
                            };
                            match bit(place) == bits {
                                true => one(emitter),
                                false => when(emitter, due, bit(place), one),
                            }
                        }
                    };
                    match bits == mask {
                        true => each(emitter),
                        false => when(emitter, due, bits, each),
                    }
                }
                if let Due::Word(slot) = due {
                    emitter.change(slot, |ins| {
                        ins.i64_const(!mask as i64).i64_and();
                    });
                }
            });
            self.split();
        }
    }

    /// Ends the current function if it is long.
    fn split(&mut self) {
        if self.emitter.length() > self.long {
            self.functions.push(self.emitter.finish());
        }
    }

    /// Ends a phase; returns its functions.
    fn end(&mut self) -> Vec<u32> {
        self.functions.push(self.emitter.finish());
        std::mem::take(&mut self.functions)
    }
}

/// Emits code that runs if one of these bits is set.
fn when(emitter: &mut Emitter<'_>, due: Due, bits: u64, emit: impl FnOnce(&mut Emitter<'_>)) {
    match due {
        Due::Word(slot) => emitter.push_slot(slot),
        Due::Taken(global) => {
            emitter.ins().global_get(global);
        }
    }
    emitter.ins().i64_const(bits as i64).i64_and();
    emitter.when_top(emit);
}
