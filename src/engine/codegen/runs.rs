//! Order of blocks if some of them always run.

use crate::engine::layout::Slot;
use crate::engine::plan::{Code, Plan};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::ops::Range;

/// Consecutive blocks: all of them are hot, or none is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    pub hot: bool,
    pub blocks: Vec<usize>,
}

/// Divides the blocks of a phase into few runs. A block comes after those it depends on; the
/// blocks of a run are in plan order.
pub fn runs(plan: &Plan, hot: &[bool], phase: Range<usize>) -> Vec<Run> {
    let before = before(plan, phase.clone());
    let from = |first: bool| {
        let mut runs: Vec<Run> = Vec::new();
        let mut done = vec![false; phase.len()];
        let mut kind = first;
        let mut left = phase.len();
        while left > 0 {
            let mut blocks = Vec::new();
            for place in phase.clone() {
                let index = place - phase.start;
                let ready = || before[index].iter().all(|other| done[other - phase.start]);
                if !done[index] && is_hot(hot, place) == kind && ready() {
                    done[index] = true;
                    blocks.push(place);
                }
            }
            left -= blocks.len();
            if !blocks.is_empty() {
                runs.push(Run { hot: kind, blocks });
            }
            kind = !kind;
        }
        runs
    };
    let (cold, hot) = (from(false), from(true));
    match cold.len() <= hot.len() {
        true => cold,
        false => hot,
    }
}

pub fn is_hot(hot: &[bool], place: usize) -> bool {
    hot.get(place).copied().unwrap_or(false)
}

/// Returns for each block of a phase those that must run before it: they drive a net that it
/// reads, or still read a register or a memory that it writes.
fn before(plan: &Plan, phase: Range<usize>) -> Vec<Vec<usize>> {
    let mut before = vec![Vec::new(); phase.len()];
    let mut drivers: FxHashMap<Slot, usize> = FxHashMap::default();
    let mut readers: FxHashMap<Slot, Vec<usize>> = FxHashMap::default();
    for place in phase.clone() {
        let block = &plan.blocks[place];
        for &slot in &block.reads {
            if let Some(&driver) = drivers.get(&slot) {
                before[place - phase.start].push(driver);
            }
            readers.entry(slot).or_default().push(place);
        }
        for step in &block.steps {
            if step.code == Code::Read
                && let Some(memory) = plan.memories.get(step.c as usize)
            {
                readers.entry(memory.mark).or_default().push(place);
            }
        }
        for &(_, to) in &block.outputs {
            drivers.insert(to, place);
        }
        let registers = block.registers.iter();
        let made = registers.map(|&(register, _)| plan.registers[register as usize].slot);
        let written = block.writes.iter();
        let written = written.map(|write| plan.memories[write.memory as usize].mark);
        for slot in made.chain(written) {
            let readers = readers.get(&slot).into_iter().flatten();
            before[place - phase.start].extend(readers.filter(|&&other| other != place));
        }
    }
    before
}

/// Returns the woken blocks, as bits of the words of `dirty`: those that are not hot.
pub fn cold(plan: &Plan, hot: &[bool]) -> Vec<u64> {
    let mut cold = vec![0; plan.layout.block_words as usize];
    for place in (0..plan.blocks.len()).filter(|&place| !is_hot(hot, place)) {
        let bit = plan.bit(place);
        cold[bit / 64] |= 1 << (bit % 64);
    }
    cold
}

/// Number of blocks that one test skips if none of them is due.
pub const GROUP: usize = 6;

/// Groups blocks by the word of `dirty` that has their bits: word, mask, blocks.
pub fn words(plan: &Plan, blocks: &[usize]) -> Vec<(u32, u64, Vec<usize>)> {
    let mut words: BTreeMap<u32, (u64, Vec<usize>)> = BTreeMap::new();
    for &place in blocks {
        let bit = plan.bit(place);
        let (mask, places) = words.entry(bit as u32 / 64).or_default();
        *mask |= 1 << (bit % 64);
        places.push(place);
    }
    words
        .into_iter()
        .map(|(word, (mask, places))| (word, mask, places))
        .collect()
}
