//! Gates in execution order.

use super::NotSliced;
use super::gates::{Gate, Gates, LOW, Wire};
use super::lower::lowered;
use super::transpose;
use crate::engine::Flat;

/// Number of 64-bit words of a slice.
pub const WORDS: usize = 8;
/// Number of cases evaluated at once.
pub const LANES: usize = 64 * WORDS;

/// One bit of every case.
type Slice = [u64; WORDS];

/// Gate in execution order: `b` if `a` is high, else `c`.
///
/// Every gate is a choice, with the constant low or the inverse of `c` in place of an input. A
/// branch on the kind of the gate would take longer than these few operations.
#[derive(Debug, Clone, Copy)]
struct Step {
    to: u32,
    a: u32,
    b: u32,
    c: u32,
    /// All bits high if `a` is inverted, else 0.
    not_a: u64,
    /// All bits high if `b` is inverted, else 0.
    not_b: u64,
}

/// Combinational netlist that evaluates many cases at once. A case is a number of at most 64 bits:
/// the input ports side by side, the first in the lowest bits.
///
/// The lowest bits number the batches of a group, the bits above them the lanes of a batch. A gate
/// runs again only in a batch in which a bit changes that it depends on. So the cases of a group
/// share the gates that do not depend on the lowest bits.
#[derive(Debug)]
pub struct Sliced {
    /// Steps, those that depend on higher bits only before others.
    steps: Vec<Step>,
    /// First step that depends on this bit of the batch's number or on a lower one.
    starts: Vec<usize>,
    /// Used bits of a case, and their slots.
    pub(super) inputs: Vec<(u32, u32)>,
    /// Slots of the leaves' bits, and their inversion.
    pub(super) out: Vec<(u32, bool)>,
    slots: usize,
}

impl Sliced {
    /// Converts the leaves of a netlist that are not input ports. A group has 2^`batch_bits`
    /// batches.
    ///
    /// # Errors
    /// Returns an error if the netlist has registers or written memories, or too many gates.
    pub fn of(flat: &Flat, batch_bits: u32) -> Result<Sliced, NotSliced> {
        let (gates, out) = lowered(flat)?;
        Ok(ordered(&gates, &out, batch_bits))
    }

    /// Returns the number of bits that number the batches of a group.
    pub fn batch_bits(&self) -> u32 {
        self.starts.len() as u32 - 1
    }
}

/// Returns for each gate the lowest bit of a case on which it depends, at most `most`.
fn lowest_bits(gates: &Gates, most: u32) -> Vec<u32> {
    let mut lowest: Vec<u32> = Vec::with_capacity(gates.gates.len());
    for gate in &gates.gates {
        let own = match *gate {
            Gate::Input(bit) => bit.min(most),
            _ => most,
        };
        let operands = gate.operands().map(|wire| lowest[wire.gate()]);
        lowest.push(operands.fold(own, u32::min));
    }
    lowest
}

/// Orders the gates and assigns a slot to each; another gate reuses it after its last use.
pub(super) fn ordered(gates: &Gates, out: &[Wire], batch_bits: u32) -> Sliced {
    const NEVER: usize = usize::MAX;
    let lowest = lowest_bits(gates, batch_bits);
    let mut order: Vec<usize> = (1..gates.gates.len()).collect();
    // A stable sort: each gate stays behind its operands, whose lowest bits are not below its own.
    order.sort_by_key(|&gate| std::cmp::Reverse(lowest[gate]));
    let mut last: Vec<Option<usize>> = vec![None; gates.gates.len()];
    for wire in out {
        last[wire.gate()] = Some(NEVER);
    }
    for &index in order.iter().rev() {
        if last[index].is_some() {
            for from in gates.gates[index].operands().map(Wire::gate) {
                // A gate that runs more often finds the value again.
                let again = lowest[from] != lowest[index];
                match again {
                    true => last[from] = Some(NEVER),
                    false => _ = last[from].get_or_insert(index),
                }
            }
        }
    }
    let mut sliced = Sliced {
        steps: Vec::new(),
        starts: vec![0; batch_bits as usize + 1],
        inputs: Vec::new(),
        out: Vec::new(),
        slots: 1,
    };
    let mut slots: Vec<u32> = vec![0; gates.gates.len()];
    let mut free: Vec<u32> = Vec::new();
    for &index in &order {
        let gate = gates.gates[index];
        if last[index].is_none() {
            continue;
        }
        // Slots used here for the last time are free for the result: a step reads before it
        // writes.
        for from in gate.operands().map(Wire::gate) {
            if last[from] == Some(index) {
                free.push(slots[from]);
                last[from] = Some(NEVER);
            }
        }
        if let Gate::Input(bit) = gate {
            // A slot of its own, which is set before the first step.
            slots[index] = sliced.slots as u32;
            sliced.slots += 1;
            sliced.inputs.push((bit, slots[index]));
            continue;
        }
        let to = free.pop().unwrap_or(sliced.slots as u32);
        sliced.slots = sliced.slots.max(to as usize + 1);
        sliced
            .steps
            .extend(step(gate, to, |wire| slots[wire.gate()]));
        let before = lowest[index] as usize;
        for start in &mut sliced.starts[..before] {
            *start = sliced.steps.len();
        }
        slots[index] = to;
    }
    let out = out.iter();
    sliced.out = out
        .map(|wire| (slots[wire.gate()], wire.is_inverse()))
        .collect();
    sliced
}

/// Returns the step of a gate, which stores its wire in slot `to`; `at` returns the slots of its
/// operands.
fn step(gate: Gate, to: u32, at: impl Fn(Wire) -> u32) -> Option<Step> {
    let (a, b, c) = match gate {
        Gate::Low | Gate::Input(_) => return None,
        Gate::And(a, b) => (a, b, LOW),
        Gate::Xor(a, b) => (a, !b, b),
        Gate::Mux(a, b, c) => (a, b, c),
    };
    Some(Step {
        to,
        a: at(a),
        b: at(b),
        c: at(c),
        not_a: filled(a.is_inverse().into(), 0),
        not_b: filled(b.is_inverse().into(), 0),
    })
}

/// Slices of [`LANES`] cases.
#[derive(Debug)]
pub struct Run<'s> {
    sliced: &'s Sliced,
    pub(super) slices: Vec<Slice>,
}

/// Bits that number 64 consecutive cases.
const WITHIN: [u64; 6] = [
    0xaaaa_aaaa_aaaa_aaaa,
    0xcccc_cccc_cccc_cccc,
    0xf0f0_f0f0_f0f0_f0f0,
    0xff00_ff00_ff00_ff00,
    0xffff_0000_ffff_0000,
    0xffff_ffff_0000_0000,
];

impl<'s> Run<'s> {
    /// Creates an evaluation without cases.
    pub fn new(sliced: &'s Sliced) -> Self {
        Run {
            sliced,
            slices: vec![[0; WORDS]; sliced.slots],
        }
    }

    /// Evaluates the next batch of a group: the cases `first + batch + (lane << batch_bits)`. The
    /// batches of a group run from 0 up; `first` is a multiple of the number of its cases.
    pub fn run(&mut self, first: u64, batch: u64) {
        let batch_bits = self.sliced.batch_bits();
        // The highest bit that changes; all below it change too.
        let changed = batch.trailing_zeros().min(batch_bits);
        for &(bit, slot) in &self.sliced.inputs {
            let lane = bit.checked_sub(batch_bits);
            if lane.map_or(bit, |_| batch_bits) > changed {
                continue;
            }
            self.slices[slot as usize] = words(|word| match lane {
                Some(lane) if lane < 6 => WITHIN[lane as usize],
                Some(lane) => filled((first >> batch_bits) + 64 * word as u64, lane),
                None => filled(batch, bit),
            });
        }
        self.steps(self.sliced.starts[changed as usize]);
    }

    /// Runs the steps from `start` on.
    pub(super) fn steps(&mut self, start: usize) {
        let slices = &mut self.slices[..];
        for step in &self.sliced.steps[start..] {
            // No `map` of arrays: it is inlined in some builds only, like `array::from_fn`.
            let a = &slices[step.a as usize];
            let b = &slices[step.b as usize];
            let c = &slices[step.c as usize];
            slices[step.to as usize] =
                words(|word| ((b[word] ^ step.not_b ^ c[word]) & (a[word] ^ step.not_a)) ^ c[word]);
        }
    }

    /// Returns the leaves of 64 cases of the batch, each packed like its case; `word` selects the
    /// 64.
    pub fn seen(&self, word: usize) -> [u64; 64] {
        let mut seen = [0; 64];
        for (seen, &wire) in seen.iter_mut().zip(&self.sliced.out) {
            *seen = self.slice(wire, word);
        }
        transpose(&mut seen);
        seen
    }

    /// Returns the leaves' bits from index `from` on, a bit for each of 64 cases.
    pub fn bits(&self, from: usize, word: usize) -> impl Iterator<Item = u64> {
        let out = self.sliced.out[from..].iter();
        out.map(move |&wire| self.slice(wire, word))
    }

    /// Returns the first `bits` bits of the leaves of one case, packed like its case.
    pub fn case(&self, bits: usize, lane: usize) -> u64 {
        let out = self.sliced.out[..bits].iter().rev();
        let bit = |&wire| self.slice(wire, lane / 64) >> (lane % 64) & 1;
        out.fold(0, |case, wire| case << 1 | bit(wire))
    }

    #[inline]
    pub(super) fn slice(&self, (slot, inverse): (u32, bool), word: usize) -> u64 {
        let bits = self.slices[slot as usize][word];
        if inverse { !bits } else { bits }
    }
}

/// Returns a word that is filled with a bit of a number.
#[inline(always)]
fn filled(number: u64, bit: u32) -> u64 {
    (number >> bit & 1).wrapping_neg()
}

/// Returns a slice of these words. A loop, as what `array::from_fn` calls is inlined in some builds
/// only, and takes longer than the gates where it is not.
#[inline(always)]
fn words(word: impl Fn(usize) -> u64) -> Slice {
    let mut slice = [0; WORDS];
    for (index, bits) in slice.iter_mut().enumerate() {
        *bits = word(index);
    }
    slice
}
