//! Control flow of the function: edges and settlings in a loop, and in each the blocks that are
//! due.

use super::emit::Emitter;
use super::{ARRIVE, CompileError, EDGE, PHASES, SETTLE, block};
use crate::engine::codegen::{GROUP, cold, is_hot, is_whole, runs, words};
use crate::engine::layout::Slot;
use crate::engine::plan::Plan;
use cranelift_codegen::ir::{Block, Function, InstBuilder, Value};
use std::collections::BTreeMap;

/// Emits the function of a plan; see [`super::Code`] for its parameters and result.
pub(super) fn emit(
    plan: &Plan,
    hot: &[bool],
    part_size: usize,
    func: &mut Function,
) -> Result<(), CompileError> {
    if !is_whole(plan) {
        return Err(CompileError::Plan);
    }
    let cold = cold(plan, hot);
    let (emitter, parameters) = Emitter::new(func, &plan.layout, cold, part_size);
    let mut flow = Flow {
        emitter,
        plan,
        hot,
        tables: parameters[3],
    };
    flow.function(parameters[1], parameters[2]);
    match flow.emitter.outside {
        true => Err(CompileError::Plan),
        false => Ok(()),
    }
}

pub(super) struct Flow<'f> {
    pub emitter: Emitter<'f>,
    pub plan: &'f Plan,
    hot: &'f [bool],
    /// Address of the [`Tables`] of a replay, or 0.
    pub tables: Value,
}

impl Flow<'_> {
    fn function(&mut self, phase: Value, ticks: Value) {
        let tables = self.tables;
        let (settle, settles) = self.emitter.block_with();
        let (edge, edges) = self.emitter.block_with();
        let (on, left) = self.emitter.block_with();
        let (exit, result) = self.emitter.block_with();
        let arrive = self.emitter.block();
        let enter: [Block; PHASES] = std::array::from_fn(|_| self.emitter.block());
        self.emitter.branch_to(phase, &enter);
        for (phase, block) in (0..).zip(enter) {
            self.emitter.begin(block);
            match phase {
                SETTLE => {
                    let one = self.emitter.number(1);
                    self.emitter.jump_with(settle, one);
                }
                EDGE => self.emitter.jump_with(edge, ticks),
                ARRIVE => self.emitter.jump(arrive),
                _ => self.emitter.jump_with(on, ticks),
            }
        }

        self.emitter.begin(edge);
        self.edge();
        let [more, done, alone] = std::array::from_fn(|_| self.emitter.block());
        self.emitter.branch(edges, more, done);
        self.emitter.begin(done);
        self.emitter.branch(tables, arrive, alone);
        self.emitter.begin(alone);
        self.emitter.jump_with(exit, edges);
        self.emitter.begin(more);
        self.emitter.jump_with(settle, edges);

        self.emitter.begin(settle);
        self.settle();
        let left_now = self.emitter.ins().iadd_imm_s(settles, -1);
        let event = self.emitter.load(self.plan.layout.event);
        let [changed, same, shown, stop] = std::array::from_fn(|_| self.emitter.block());
        self.emitter.branch(event, changed, same);
        self.emitter.begin(same);
        self.emitter.jump_with(on, left_now);
        self.emitter.begin(changed);
        self.emitter.branch(tables, shown, stop);
        self.emitter.begin(stop);
        self.emitter.jump_with(exit, left_now);
        self.emitter.begin(shown);
        self.row(left_now, on, exit);

        self.emitter.begin(on);
        let [again, last, last_of_replay, leave] = std::array::from_fn(|_| self.emitter.block());
        self.emitter.branch(left, again, last);
        self.emitter.begin(again);
        self.emitter.jump_with(edge, left);
        self.emitter.begin(last);
        self.emitter.branch(tables, last_of_replay, leave);
        self.emitter.begin(last_of_replay);
        self.stops(edge, leave, left);
        self.emitter.begin(leave);
        self.emitter.jump_with(exit, left);

        self.emitter.begin(arrive);
        self.arrive(settle, exit);

        self.emitter.begin(exit);
        self.emitter.ins().return_(&[result]);
    }

    fn settle(&mut self) {
        for run in runs(self.plan, self.hot, 0..self.plan.settling) {
            if run.hot {
                for &place in &run.blocks {
                    self.emitter.forget();
                    block::settle(&mut self.emitter, self.plan, &self.plan.blocks[place]);
                }
                continue;
            }
            for (word, mask, places) in words(self.plan, &run.blocks) {
                let due = Due::Word(self.plan.layout.dirty + word);
                self.blocks(due, mask, &places, |flow, place| {
                    block::settle(&mut flow.emitter, flow.plan, &flow.plan.blocks[place]);
                });
            }
        }
    }

    fn edge(&mut self) {
        let plan = self.plan;
        // Blocks woken by an edge run after it.
        let mut due: BTreeMap<u32, Value> = BTreeMap::new();
        let all: Vec<usize> = (plan.settling..plan.blocks.len()).collect();
        for (word, mask, _) in words(plan, &all) {
            let slot = plan.layout.dirty + word;
            let cold = self.emitter.cold_of(word) & mask;
            if cold != 0 {
                let taken = self.emitter.load(slot);
                let none = self.emitter.number(0);
                self.emitter.store(slot, none);
                due.insert(word, taken);
            }
        }
        for run in runs(plan, self.hot, plan.settling..plan.blocks.len()) {
            if run.hot {
                for &place in &run.blocks {
                    self.emitter.forget();
                    block::edge(&mut self.emitter, plan, place);
                }
                continue;
            }
            for (word, mask, places) in words(plan, &run.blocks) {
                if let Some(&due) = due.get(&word) {
                    self.blocks(Due::Taken(due), mask, &places, |flow, place| {
                        block::edge(&mut flow.emitter, plan, place)
                    });
                }
            }
        }
        let commits: Vec<usize> = all
            .into_iter()
            .filter(|&place| plan.blocks[place].commits)
            .collect();
        let (hot, cold): (Vec<usize>, Vec<usize>) = commits
            .into_iter()
            .partition(|&place| is_hot(self.hot, place));
        for place in hot {
            self.emitter.forget();
            block::commit(&mut self.emitter, plan, &plan.blocks[place]);
        }
        for (word, mask, places) in words(plan, &cold) {
            if let Some(&due) = due.get(&word) {
                self.blocks(Due::Taken(due), mask, &places, |flow, place| {
                    block::commit(&mut flow.emitter, plan, &plan.blocks[place])
                });
            }
        }
    }

    /// Emits some blocks of a word of `dirty`; each runs if its bit is set.
    fn blocks(
        &mut self,
        due: Due,
        mask: u64,
        places: &[usize],
        mut emit: impl FnMut(&mut Self, usize),
    ) {
        let end = self.unless_due(due, mask);
        for group in places.chunks(GROUP) {
            let bits = group.iter().map(|&place| self.bit(place));
            let bits = bits.fold(0, |bits, bit| bits | bit);
            let past = (bits != mask).then(|| self.unless_due(due, bits));
            for &place in group {
                let bit = self.bit(place);
                let done = (bit != bits).then(|| self.unless_due(due, bit));
                self.emitter.forget();
                emit(self, place);
                if let Some(done) = done {
                    self.emitter.continue_in(done);
                }
            }
            if let Some(past) = past {
                self.emitter.continue_in(past);
            }
        }
        if let Due::Word(slot) = due {
            let all = self.emitter.load(slot);
            let rest = self.emitter.and(all, !mask);
            self.emitter.store(slot, rest);
        }
        self.emitter.continue_in(end);
    }

    fn bit(&self, place: usize) -> u64 {
        1 << (self.plan.bit(place) % 64)
    }

    /// Continues if one of these bits is set, else jumps to the block that is returned.
    fn unless_due(&mut self, due: Due, bits: u64) -> Block {
        let word = match due {
            Due::Word(slot) => self.emitter.load(slot),
            Due::Taken(word) => word,
        };
        let some = self.emitter.and(word, bits);
        let [go, past] = [self.emitter.block(), self.emitter.block()];
        self.emitter.branch(some, go, past);
        self.emitter.begin(go);
        past
    }
}

/// Bits of the blocks that are due.
#[derive(Clone, Copy)]
enum Due {
    /// Word of the slab: a block sets the bits of later ones, and all are cleared in the end.
    Word(Slot),
    /// Word that was taken before the first block runs.
    Taken(Value),
}
