//! Gates of single wires, made from the nodes of a netlist.

use rustc_hash::FxHashMap;
use std::ops::Not;

/// Output of a gate, or its inverse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wire(u32);

/// Number of gates in a row that a simplification looks at.
const DEPTH: usize = 2;

/// Constant low wire.
pub const LOW: Wire = Wire(0);
/// Constant high wire.
pub const HIGH: Wire = Wire(1);

impl Wire {
    fn of(gate: usize) -> Self {
        Wire((gate as u32) << 1)
    }

    /// Returns the gate that drives the wire: an index into [`Gates::gates`].
    pub fn gate(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// True if the wire is an inverse.
    pub fn is_inverse(self) -> bool {
        self.0 & 1 == 1
    }

    /// Returns the wire, or its inverse if `inverse` is true.
    fn inverted(self, inverse: bool) -> Self {
        Wire(self.0 ^ u32::from(inverse))
    }

    fn plain(self) -> Self {
        Wire(self.0 & !1)
    }
}

impl Not for Wire {
    type Output = Self;
    fn not(self) -> Self {
        self.inverted(true)
    }
}

/// Function of a gate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Gate {
    /// Constant low.
    Low,
    /// Bit of a case.
    Input(u32),
    /// High if both inputs are.
    And(Wire, Wire),
    /// High if exactly one input is; neither is an inverse.
    Xor(Wire, Wire),
    /// Second input if the first is high, else the third; first and third are no inverses.
    Mux(Wire, Wire, Wire),
}

impl Gate {
    /// Returns the inputs of the gate.
    pub fn operands(self) -> impl Iterator<Item = Wire> {
        let operands = match self {
            Gate::Low | Gate::Input(_) => [None; 3],
            Gate::And(a, b) | Gate::Xor(a, b) => [Some(a), Some(b), None],
            Gate::Mux(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }
}

/// Gates, each after its inputs, without duplicates.
#[derive(Debug)]
pub struct Gates {
    /// Gates; the first is [`Gate::Low`].
    pub gates: Vec<Gate>,
    known: FxHashMap<Gate, usize>,
}

impl Gates {
    /// Returns the first gate only.
    pub fn new() -> Self {
        Gates {
            gates: vec![Gate::Low],
            known: FxHashMap::default(),
        }
    }

    fn gate(&mut self, gate: Gate) -> Wire {
        let gates = &mut self.gates;
        Wire::of(*self.known.entry(gate).or_insert_with(|| {
            gates.push(gate);
            gates.len() - 1
        }))
    }

    /// Returns a bit of a case.
    pub fn input(&mut self, bit: u32) -> Wire {
        self.gate(Gate::Input(bit))
    }

    /// Returns high if both inputs are.
    pub fn and(&mut self, a: Wire, b: Wire) -> Wire {
        let (a, b) = (a.min(b), a.max(b));
        match (a, b) {
            (LOW, _) => LOW,
            (HIGH, other) => other,
            _ if self.needs(a, b, DEPTH) => a,
            _ if self.needs(b, a, DEPTH) => b,
            _ if self.needs(a, !b, DEPTH) || self.needs(b, !a, DEPTH) => LOW,
            _ => self.gate(Gate::And(a, b)),
        }
    }

    /// True if a wire is an `and` of `part` and others, some gates deep, or `part` itself.
    fn needs(&self, wire: Wire, part: Wire, depth: usize) -> bool {
        let deeper = |wire| depth > 0 && self.needs(wire, part, depth - 1);
        match self.gates[wire.gate()] {
            _ if wire == part => true,
            Gate::And(a, b) if !wire.is_inverse() => deeper(a) || deeper(b),
            _ => false,
        }
    }

    /// Returns high if an input is.
    pub fn or(&mut self, a: Wire, b: Wire) -> Wire {
        !self.and(!a, !b)
    }

    /// Returns high if the inputs differ.
    pub fn xor(&mut self, a: Wire, b: Wire) -> Wire {
        let inverse = a.is_inverse() != b.is_inverse();
        let (a, b) = (a.plain().min(b.plain()), a.plain().max(b.plain()));
        let plain = match (a, b) {
            (LOW, other) => other,
            _ if a == b => LOW,
            _ => match self.changed(a, b).or_else(|| self.changed(b, a)) {
                // A chosen word differs from one of the two if the other is chosen and differs.
                Some((choose, other, same)) => {
                    let differ = self.xor(other, same);
                    self.and(choose, differ)
                }
                None => self.gate(Gate::Xor(a, b)),
            },
        };
        plain.inverted(inverse)
    }

    /// Returns the condition under which a choice is not `same`, which is one of its inputs, the
    /// other input, and `same`.
    fn changed(&self, wire: Wire, same: Wire) -> Option<(Wire, Wire, Wire)> {
        match self.gates[wire.gate()] {
            Gate::Mux(choose, then, other) if other == same => Some((choose, then, same)),
            Gate::Mux(choose, then, other) if then == same => Some((!choose, other, same)),
            _ => None,
        }
    }

    /// Returns `then` if `choose` is high, else `other`.
    pub fn mux(&mut self, choose: Wire, then: Wire, other: Wire) -> Wire {
        if choose.is_inverse() {
            return self.mux(!choose, other, then);
        }
        if choose == LOW || then == other {
            return other;
        }
        match (then, other) {
            _ if then == !other => self.xor(choose, other),
            (LOW, _) => self.and(!choose, other),
            (HIGH, _) => self.or(choose, other),
            (_, LOW) => self.and(choose, then),
            (_, HIGH) => self.or(!choose, then),
            _ if then == choose => self.or(choose, other),
            _ if then == !choose => self.and(!choose, other),
            _ if other == choose => self.and(choose, then),
            _ if other == !choose => self.or(!choose, then),
            _ => {
                let inverse = other.is_inverse();
                let [then, other] = [then, other].map(|wire| wire.inverted(inverse));
                self.gate(Gate::Mux(choose, then, other)).inverted(inverse)
            }
        }
    }

    /// Returns sum and carry of two words of the same width.
    pub fn add(&mut self, a: &[Wire], b: &[Wire], mut carry: Wire) -> (Vec<Wire>, Wire) {
        let mut sum = Vec::with_capacity(a.len());
        for (&a, &b) in a.iter().zip(b) {
            let differ = self.xor(a, b);
            sum.push(self.xor(differ, carry));
            carry = self.mux(differ, carry, a);
        }
        (sum, carry)
    }

    /// Returns the product of two words of the same width, cut to that width.
    pub fn multiply(&mut self, a: &[Wire], b: &[Wire]) -> Vec<Wire> {
        let mut product = vec![LOW; a.len()];
        for (low, &bit) in b.iter().enumerate() {
            if bit == LOW {
                continue;
            }
            let row = &a[..a.len() - low];
            let row: Vec<Wire> = row.iter().map(|&wire| self.and(wire, bit)).collect();
            let (sum, _) = self.add(&product[low..], &row, LOW);
            product.splice(low.., sum);
        }
        product
    }

    /// Returns high if two words of the same width are equal.
    pub fn equal(&mut self, a: &[Wire], b: &[Wire]) -> Wire {
        let mut same = HIGH;
        for (&a, &b) in a.iter().zip(b) {
            let differ = self.xor(a, b);
            same = self.and(same, !differ);
        }
        same
    }

    /// Returns high if a word equals a number.
    pub fn is(&mut self, word: &[Wire], number: u64) -> Wire {
        let mut is = HIGH;
        for (bit, &wire) in word.iter().enumerate() {
            let wire = wire.inverted(number.checked_shr(bit as u32).unwrap_or(0) & 1 == 0);
            is = self.and(is, wire);
        }
        // A number wider than the word equals none of its values.
        match number.checked_shr(word.len() as u32).unwrap_or(0) {
            0 => is,
            _ => LOW,
        }
    }

    /// Returns high if the first of two words of the same width is less: their difference borrows.
    pub fn below(&mut self, a: &[Wire], b: &[Wire]) -> Wire {
        let b: Vec<Wire> = b.iter().map(|&wire| !wire).collect();
        !self.add(a, &b, HIGH).1
    }

    /// Returns the word at an address of a table; zero past its end.
    pub fn table(&mut self, words: &[u64], address: &[Wire], width: u8) -> Vec<Wire> {
        let bit = |word: u64, bit: u8| if word >> bit & 1 == 1 { HIGH } else { LOW };
        (0..width)
            .map(|at| {
                let column: Vec<Wire> = words.iter().map(|&word| bit(word, at)).collect();
                self.choose(column, address)
            })
            .collect()
    }

    /// Returns the wire at an address of a column; low past its end.
    pub fn choose(&mut self, mut column: Vec<Wire>, address: &[Wire]) -> Wire {
        for &bit in address {
            let pairs = column.chunks(2);
            column = pairs
                .map(|pair| {
                    let high = pair.get(1).copied().unwrap_or(LOW);
                    self.mux(bit, high, pair[0])
                })
                .collect();
        }
        column.first().copied().unwrap_or(LOW)
    }
}
