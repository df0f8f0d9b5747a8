//! Gates of single wires, made of the nodes of a netlist.

use rustc_hash::FxHashMap;
use std::ops::Not;

/// A gate's wire, or its inverse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wire(u32);

/// The wire that is always low.
pub const LOW: Wire = Wire(0);
/// The wire that is always high.
pub const HIGH: Wire = Wire(1);

impl Wire {
    fn of(gate: usize) -> Self {
        Wire((gate as u32) << 1)
    }

    /// The gate that it comes from: an index into [`Gates::gates`].
    pub fn gate(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether it is the inverse.
    pub fn is_inverse(self) -> bool {
        self.0 & 1 == 1
    }

    /// The wire where `inverse` is not set, else its inverse.
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

/// What a gate does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Gate {
    /// Nothing: its wire is low.
    Low,
    /// It is a bit of a case.
    Input(u32),
    /// High where both are.
    And(Wire, Wire),
    /// High where one of them is; neither is an inverse.
    Xor(Wire, Wire),
    /// The second where the first is high, else the third; first and third are no inverses.
    Mux(Wire, Wire, Wire),
}

impl Gate {
    /// The wires it takes.
    pub fn operands(self) -> impl Iterator<Item = Wire> {
        let operands = match self {
            Gate::Low | Gate::Input(_) => [None; 3],
            Gate::And(a, b) | Gate::Xor(a, b) => [Some(a), Some(b), None],
            Gate::Mux(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }
}

/// Gates, each behind those that it takes, no two of which do the same.
#[derive(Debug)]
pub struct Gates {
    /// They; the first is [`Gate::Low`].
    pub gates: Vec<Gate>,
    known: FxHashMap<Gate, usize>,
}

impl Gates {
    /// None but the first.
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

    /// A bit of a case.
    pub fn input(&mut self, bit: u32) -> Wire {
        self.gate(Gate::Input(bit))
    }

    /// High where both are.
    pub fn and(&mut self, a: Wire, b: Wire) -> Wire {
        let (a, b) = (a.min(b), a.max(b));
        match (a, b) {
            (LOW, _) => LOW,
            (HIGH, other) => other,
            _ if a == b => a,
            _ if a == !b => LOW,
            _ => self.gate(Gate::And(a, b)),
        }
    }

    /// High where one of them is.
    pub fn or(&mut self, a: Wire, b: Wire) -> Wire {
        !self.and(!a, !b)
    }

    /// High where they differ.
    pub fn xor(&mut self, a: Wire, b: Wire) -> Wire {
        let inverse = a.is_inverse() != b.is_inverse();
        let (a, b) = (a.plain().min(b.plain()), a.plain().max(b.plain()));
        let plain = match (a, b) {
            (LOW, other) => other,
            _ if a == b => LOW,
            _ => self.gate(Gate::Xor(a, b)),
        };
        plain.inverted(inverse)
    }

    /// `then` where `choose` is high, else `other`.
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

    /// The sum of two words of the same width, and what is carried out of it.
    pub fn add(&mut self, a: &[Wire], b: &[Wire], mut carry: Wire) -> (Vec<Wire>, Wire) {
        let mut sum = Vec::with_capacity(a.len());
        for (&a, &b) in a.iter().zip(b) {
            let differ = self.xor(a, b);
            sum.push(self.xor(differ, carry));
            carry = self.mux(differ, carry, a);
        }
        (sum, carry)
    }

    /// The product of two words of the same width, cut to it.
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

    /// High where two words of the same width are the same.
    pub fn equal(&mut self, a: &[Wire], b: &[Wire]) -> Wire {
        let mut same = HIGH;
        for (&a, &b) in a.iter().zip(b) {
            let differ = self.xor(a, b);
            same = self.and(same, !differ);
        }
        same
    }

    /// High where a word is a number.
    pub fn is(&mut self, word: &[Wire], number: u64) -> Wire {
        let mut is = HIGH;
        for (bit, &wire) in word.iter().enumerate() {
            let wire = wire.inverted(number.checked_shr(bit as u32).unwrap_or(0) & 1 == 0);
            is = self.and(is, wire);
        }
        // A number that does not fit into the word is none that it can be.
        match number.checked_shr(word.len() as u32).unwrap_or(0) {
            0 => is,
            _ => LOW,
        }
    }

    /// High where the first of two words of the same width is less: where their difference borrows.
    pub fn below(&mut self, a: &[Wire], b: &[Wire]) -> Wire {
        let b: Vec<Wire> = b.iter().map(|&wire| !wire).collect();
        !self.add(a, &b, HIGH).1
    }

    /// The word at an address of a table, zero past its end.
    pub fn table(&mut self, words: &[u64], address: &[Wire], width: u8) -> Vec<Wire> {
        let bit = |word: u64, bit: u8| if word >> bit & 1 == 1 { HIGH } else { LOW };
        (0..width)
            .map(|at| {
                let column: Vec<Wire> = words.iter().map(|&word| bit(word, at)).collect();
                self.choose(column, address)
            })
            .collect()
    }

    /// The wire at an address of a column, low past its end.
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
