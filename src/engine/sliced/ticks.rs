//! A tick of a circuit for many cases at once.

use super::steps::{Run, Sliced, ordered};
use super::{NotSliced, state, transpose};
use crate::engine::Flat;

/// Tick of a circuit with at most 64 bits of state and 64 bits of input ports, both packed in the
/// order of their leaves.
#[derive(Debug)]
pub struct Tick {
    sliced: Sliced,
    /// Bits of the state and their slots.
    state: Vec<(usize, u32)>,
    /// Bits of the input ports and their slots.
    inputs: Vec<(usize, u32)>,
    /// Number of bits of state.
    bits: usize,
}

impl Tick {
    /// Converts a tick of a netlist with these properties; those in `given` exclude cases.
    ///
    /// # Errors
    /// Returns an error if the state or the input ports have more bits, there are too many gates,
    /// or there is no such property.
    pub fn of(flat: &Flat, properties: &[usize], given: &[usize]) -> Result<Tick, NotSliced> {
        let ports = flat.inputs.iter().map(|&width| u32::from(width));
        if ports.sum::<u32>() > 64 {
            return Err(NotSliced);
        }
        let mut edge = state::tick(flat, [properties, given], 64)?;
        let bits = edge.after.len();
        if bits > 64 {
            return Err(NotSliced);
        }
        edge.after.extend(edge.all);
        let sliced = ordered(&edge.gates, &edge.after, 0);
        let used = sliced.inputs.iter();
        let used = used.map(|&(bit, slot)| (bit as usize, slot));
        let (state, inputs): (Vec<_>, Vec<_>) = used.partition(|(bit, _)| *bit < 64);
        Ok(Tick {
            state,
            inputs: inputs
                .into_iter()
                .map(|(bit, slot)| (bit - 64, slot))
                .collect(),
            bits,
            sliced,
        })
    }
}

/// Bit by bit the words of 64 cases.
#[derive(Debug, Clone)]
pub struct Turned([u64; 64]);

impl Turned {
    /// Turns the words of at most 64 cases.
    pub fn of(words: impl Iterator<Item = u64>) -> Self {
        let mut turned = [0; 64];
        for (turned, word) in turned.iter_mut().zip(words) {
            *turned = word;
        }
        transpose(&mut turned);
        Turned(turned)
    }
}

/// Different states that are looked for one by one before all cases are turned.
const FEW: usize = 16;

/// Evaluation of [`LANES`](super::LANES) cases of a tick.
#[derive(Debug)]
pub struct Ticks<'t> {
    tick: &'t Tick,
    run: Run<'t>,
    /// Different states to look for one by one: fewer where there were many.
    few: usize,
}

impl<'t> Ticks<'t> {
    /// Creates an evaluation without cases.
    pub fn new(tick: &'t Tick) -> Self {
        Ticks {
            run: Run::new(&tick.sliced),
            tick,
            few: FEW,
        }
    }

    /// Sets the state of 64 cases, of which `word` says which.
    pub fn state(&mut self, word: usize, state: u64) {
        for &(bit, slot) in &self.tick.state {
            let bit = state >> bit & 1;
            self.run.slices[slot as usize][word] = bit.wrapping_neg();
        }
    }

    /// Sets the states of 64 cases.
    pub fn states(&mut self, word: usize, states: &Turned) {
        for &(bit, slot) in &self.tick.state {
            self.run.slices[slot as usize][word] = states.0[bit];
        }
    }

    /// Sets the input ports of 64 cases.
    pub fn inputs(&mut self, word: usize, inputs: &Turned) {
        for &(bit, slot) in &self.tick.inputs {
            self.run.slices[slot as usize][word] = inputs.0[bit];
        }
    }

    /// Runs one tick of all cases.
    pub fn run(&mut self) {
        self.run.steps(0);
    }

    /// Returns a bit for each of 64 cases: high where all properties hold.
    pub fn holds(&self, word: usize) -> u64 {
        self.run.slice(self.tick.sliced.out[self.tick.bits], word)
    }

    /// Returns a bit for each of 64 cases: low where it is excluded.
    pub fn given(&self, word: usize) -> u64 {
        self.run
            .slice(self.tick.sliced.out[self.tick.bits + 1], word)
    }

    /// Returns the states after the tick, bit by bit.
    fn turned(&self, word: usize) -> [u64; 64] {
        let mut after = [0; 64];
        let out = &self.tick.sliced.out[..self.tick.bits];
        for (after, &wire) in after.iter_mut().zip(out) {
            *after = self.run.slice(wire, word);
        }
        after
    }

    /// Returns the states after the tick.
    pub fn after(&self, word: usize) -> [u64; 64] {
        let mut after = self.turned(word);
        transpose(&mut after);
        after
    }

    /// Returns the first of 64 cases, of those `among` them, that leads to a state.
    pub fn leading(&self, word: usize, among: u64, to: u64) -> Option<usize> {
        let left = alike(&self.turned(word)[..self.tick.bits], among, to);
        (left != 0).then(|| left.trailing_zeros() as usize)
    }

    /// Calls `each` with the states after the tick of 64 cases, of those `among` them, in the order
    /// of the first case that leads to each. A state may come more than once.
    pub fn each_after(&mut self, word: usize, among: u64, mut each: impl FnMut(u64)) {
        let mut turned = self.turned(word);
        let mut left = among;
        for _ in 0..self.few {
            if left == 0 {
                self.few = FEW;
                return;
            }
            let first = left.trailing_zeros();
            let turned = &turned[..self.tick.bits];
            let state = turned
                .iter()
                .rev()
                .fold(0, |state, slice| state << 1 | slice >> first & 1);
            each(state);
            left &= !alike(turned, left, state);
        }
        if left != 0 {
            self.few = (self.few / 2).max(1);
            transpose(&mut turned);
            let mut last = None;
            while left != 0 {
                let state = turned[left.trailing_zeros() as usize];
                if last != Some(state) {
                    each(state);
                }
                last = Some(state);
                left &= left - 1;
            }
        }
    }
}

/// Returns the cases `among` them that have a state.
fn alike(turned: &[u64], among: u64, state: u64) -> u64 {
    let bits = turned.iter().enumerate();
    bits.fold(among, |among, (bit, slice)| {
        among & !(slice ^ (state >> bit & 1).wrapping_neg())
    })
}
