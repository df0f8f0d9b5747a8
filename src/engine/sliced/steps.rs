//! Gates in execution order.

use super::NotSliced;
use super::gates::{Gate, Gates, Wire};
use super::lower::lowered;
use super::transpose;
use crate::engine::Flat;

/// Number of 64-bit words of a slice.
pub const WORDS: usize = 8;
/// Number of cases evaluated at once.
pub const LANES: usize = 64 * WORDS;

/// One bit of every case.
type Slice = [u64; WORDS];

/// Operation of a step, with the inversion of its operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Code {
    And,
    /// Second operand inverted.
    AndNot,
    /// Both operands inverted.
    Nor,
    Xor,
    Mux,
    /// Second operand inverted.
    MuxNot,
}

#[derive(Debug, Clone, Copy)]
struct Step {
    code: Code,
    to: u32,
    a: u32,
    b: u32,
    c: u32,
}

/// Combinational netlist that evaluates many cases at once. A case is a number of at most 64 bits:
/// the input ports side by side, the first in the lowest bits.
#[derive(Debug)]
pub struct Sliced {
    steps: Vec<Step>,
    /// Used bits of a case, and their slots.
    pub(super) inputs: Vec<(u32, u32)>,
    /// Slots of the leaves' bits, and their inversion.
    pub(super) out: Vec<(u32, bool)>,
    slots: usize,
}

impl Sliced {
    /// Converts the leaves of a netlist that are not input ports.
    ///
    /// # Errors
    /// Returns an error if the netlist has registers or written memories, or too many gates.
    pub fn of(flat: &Flat) -> Result<Sliced, NotSliced> {
        let (gates, out) = lowered(flat)?;
        Ok(ordered(&gates, &out))
    }
}

/// Assigns a slot to each gate; another gate reuses it after its last use.
pub(super) fn ordered(gates: &Gates, out: &[Wire]) -> Sliced {
    const NEVER: usize = usize::MAX;
    let count = gates.gates.len();
    let mut last: Vec<Option<usize>> = vec![None; count];
    for wire in out {
        last[wire.gate()] = Some(NEVER);
    }
    for (index, gate) in gates.gates.iter().enumerate().rev() {
        if last[index].is_some() {
            for wire in gate.operands() {
                last[wire.gate()].get_or_insert(index);
            }
        }
    }
    let mut sliced = Sliced {
        steps: Vec::new(),
        inputs: Vec::new(),
        out: Vec::new(),
        slots: 1,
    };
    let mut slots: Vec<u32> = vec![0; count];
    let mut free: Vec<u32> = Vec::new();
    for (index, gate) in gates.gates.iter().enumerate().skip(1) {
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
        if let Gate::Input(bit) = *gate {
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
            .extend(step(*gate, to, |wire| slots[wire.gate()]));
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
    let (code, a, b, c) = match gate {
        Gate::Low | Gate::Input(_) => return None,
        Gate::And(a, b) => {
            let (a, b) = if a.is_inverse() { (b, a) } else { (a, b) };
            let code = match (a.is_inverse(), b.is_inverse()) {
                (true, _) => Code::Nor,
                (_, true) => Code::AndNot,
                _ => Code::And,
            };
            (code, a, b, a)
        }
        Gate::Xor(a, b) => (Code::Xor, a, b, a),
        Gate::Mux(a, b, c) if b.is_inverse() => (Code::MuxNot, a, b, c),
        Gate::Mux(a, b, c) => (Code::Mux, a, b, c),
    };
    let [a, b, c] = [a, b, c].map(at);
    Some(Step { code, to, a, b, c })
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

    /// Evaluates the cases from `first` on; `first` is a multiple of [`LANES`].
    pub fn run(&mut self, first: u64) {
        for &(bit, slot) in &self.sliced.inputs {
            self.slices[slot as usize] = words(|word| {
                let within = WITHIN.get(bit as usize).copied();
                let cases = first + 64 * word as u64;
                within.unwrap_or(if cases >> bit & 1 == 1 { u64::MAX } else { 0 })
            });
        }
        self.steps();
    }

    pub(super) fn steps(&mut self) {
        let slices = &mut self.slices[..];
        for step in &self.sliced.steps {
            let a = &slices[step.a as usize];
            let b = &slices[step.b as usize];
            slices[step.to as usize] = match step.code {
                Code::And => each(a, b, |a, b| a & b),
                Code::AndNot => each(a, b, |a, b| a & !b),
                Code::Nor => each(a, b, |a, b| !(a | b)),
                Code::Xor => each(a, b, |a, b| a ^ b),
                Code::Mux => {
                    let c = &slices[step.c as usize];
                    each3(a, b, c, |a, b, c| ((b ^ c) & a) ^ c)
                }
                Code::MuxNot => {
                    let c = &slices[step.c as usize];
                    each3(a, b, c, |a, b, c| ((!b ^ c) & a) ^ c)
                }
            };
        }
    }

    /// Returns the leaves of 64 consecutive cases, each packed like its case; `word` selects the
    /// 64.
    pub fn seen(&self, word: usize) -> [u64; 64] {
        let mut seen = [0; 64];
        for (seen, &wire) in seen.iter_mut().zip(&self.sliced.out) {
            *seen = self.slice(wire, word);
        }
        transpose(&mut seen);
        seen
    }

    #[inline]
    pub(super) fn slice(&self, (slot, inverse): (u32, bool), word: usize) -> u64 {
        let bits = self.slices[slot as usize][word];
        if inverse { !bits } else { bits }
    }
}

#[inline(always)]
fn each(a: &Slice, b: &Slice, gate: impl Fn(u64, u64) -> u64) -> Slice {
    words(|word| gate(a[word], b[word]))
}

#[inline(always)]
fn each3(a: &Slice, b: &Slice, c: &Slice, gate: impl Fn(u64, u64, u64) -> u64) -> Slice {
    words(|word| gate(a[word], b[word], c[word]))
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
