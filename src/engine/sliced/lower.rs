//! Conversion of a netlist's nodes into wires.

use super::NotSliced;
use super::gates::{Gates, HIGH, LOW, Wire};
use super::state::State;
use crate::engine::flat::{Flat, Id, Op, Place, Port};
use rustc_hash::FxHashMap;

/// Greatest number of gates; larger circuits do not pay.
const MOST: usize = 1 << 22;

/// Wires of a netlist, lowest bit first.
pub struct Lowering<'f> {
    flat: &'f Flat,
    /// First bit of each input port.
    ports: Vec<u32>,
    /// Registers and memories, if they are bits of a case too.
    state: Option<State>,
    /// Gates, those of the nodes among them.
    pub gates: Gates,
    words: Vec<Vec<Wire>>,
    /// First bit of a case that nothing uses.
    pub unused: u32,
    /// Reads that may give any word, by memory and address.
    reads: FxHashMap<(u32, Vec<Wire>), Vec<Wire>>,
}

/// Returns the gates of a combinational netlist, and the wires of its leaves that are not input
/// ports, in order.
pub fn lowered(flat: &Flat) -> Result<(Gates, Vec<Wire>), NotSliced> {
    let mut lowering = Lowering::of(flat, None, 0, Gates::new(), &|_| true)?;
    let mut out = Vec::new();
    for place in &flat.leaves[flat.parts[0]..] {
        match *place {
            Place::Node(id) => out.extend_from_slice(lowering.word(id)),
            Place::Input(port) => out.extend(lowering.port(port)),
            Place::Register(_) | Place::Word(..) => return Err(NotSliced),
        }
    }
    Ok((lowering.gates, out))
}

/// Shifts a word left by `low` bits, filled with zeros.
fn moved(word: &[Wire], low: usize, width: usize) -> Vec<Wire> {
    let zeros = std::iter::repeat_n(LOW, low);
    let moved = zeros.chain(word.iter().copied());
    let above = std::iter::repeat(LOW);
    moved.chain(above).take(width).collect()
}

/// Returns a word from bit `low` up, filled with `above`.
fn from(word: &[Wire], low: usize, above: Wire, width: usize) -> Vec<Wire> {
    let word = word.iter().copied().skip(low);
    word.chain(std::iter::repeat(above)).take(width).collect()
}

fn inverse(word: &[Wire]) -> Vec<Wire> {
    word.iter().map(|&wire| !wire).collect()
}

/// Inverts the sign, which maps two's complement order to unsigned order.
fn in_order(word: &[Wire]) -> Vec<Wire> {
    let mut word = word.to_vec();
    if let Some(sign) = word.last_mut() {
        *sign = !*sign;
    }
    word
}

impl<'f> Lowering<'f> {
    /// Converts all nodes in the cone; others have no wires. Input ports are the bits of a case from
    /// `first` on.
    pub fn of(
        flat: &'f Flat,
        state: Option<State>,
        first: u32,
        gates: Gates,
        cone: &dyn Fn(Id) -> bool,
    ) -> Result<Self, NotSliced> {
        let mut bits = first;
        let ports = flat.inputs.iter().map(|&width| {
            bits += u32::from(width);
            bits - u32::from(width)
        });
        let mut lowering = Lowering {
            ports: ports.collect(),
            flat,
            state,
            gates,
            words: Vec::with_capacity(flat.nodes.len()),
            unused: bits,
            reads: FxHashMap::default(),
        };
        for id in 0..flat.nodes.len() as Id {
            let word = match cone(id) {
                true => lowering.node(id)?,
                false => Vec::new(),
            };
            lowering.words.push(word);
            if lowering.gates.gates.len() > MOST {
                return Err(NotSliced);
            }
        }
        Ok(lowering)
    }

    /// Returns the wires of a node.
    pub fn word(&self, id: Id) -> &[Wire] {
        &self.words[id as usize]
    }

    /// Returns the netlist.
    pub fn flat(&self) -> &'f Flat {
        self.flat
    }

    /// Returns the wires of an input port.
    pub fn port(&mut self, port: u32) -> Vec<Wire> {
        let first = self.ports[port as usize];
        let bits = first..first + u32::from(self.flat.inputs[port as usize]);
        bits.map(|bit| self.gates.input(bit)).collect()
    }

    fn node(&mut self, id: Id) -> Result<Vec<Wire>, NotSliced> {
        let node = self.flat.node(id);
        let width = usize::from(node.width);
        let words = &self.words;
        let word = |id: Id| &words[id as usize][..];
        let sign = |id: Id| word(id).last().copied().unwrap_or(LOW);
        let gates = &mut self.gates;
        let mut pairs = |a: Id, b: Id, gate: fn(&mut Gates, Wire, Wire) -> Wire| {
            let pairs = word(a).iter().zip(word(b));
            pairs.map(|(&a, &b)| gate(gates, a, b)).collect()
        };
        Ok(match node.op {
            Op::Constant(bits) => (0..width)
                .map(|bit| if bits >> bit & 1 == 1 { HIGH } else { LOW })
                .collect(),
            Op::Input(port) => self.port(port),
            Op::Register(register) => {
                let state = self.state.as_ref().ok_or(NotSliced)?;
                state.registers[register as usize].clone()
            }
            Op::Not(a) => inverse(word(a)),
            Op::Negate(a) => gates.add(&inverse(word(a)), &vec![LOW; width], HIGH).0,
            Op::Add(a, b) => gates.add(word(a), word(b), LOW).0,
            Op::Subtract(a, b) => gates.add(word(a), &inverse(word(b)), HIGH).0,
            Op::Multiply(a, b) => gates.multiply(word(a), word(b)),
            Op::And(a, b) => pairs(a, b, Gates::and),
            Op::Or(a, b) => pairs(a, b, Gates::or),
            Op::Xor(a, b) => pairs(a, b, Gates::xor),
            Op::Equal(a, b) => vec![gates.equal(word(a), word(b))],
            Op::Below(a, b) => vec![gates.below(word(a), word(b))],
            Op::BelowSigned(a, b) => {
                let [a, b] = [a, b].map(|id| in_order(word(id)));
                vec![gates.below(&a, &b)]
            }
            Op::Mux(choose, then, other) => {
                let choose = word(choose)[0];
                let pairs = word(then).iter().zip(word(other));
                pairs
                    .map(|(&then, &other)| gates.mux(choose, then, other))
                    .collect()
            }
            Op::ShiftLeft(a, by) => moved(word(a), by.into(), width),
            Op::ShiftRight(a, by) | Op::Slice(a, by) => from(word(a), by.into(), LOW, width),
            Op::ShiftRightSigned(a, by) => from(word(a), by.into(), sign(a), width),
            Op::Extend(a) => from(word(a), 0, LOW, width),
            Op::ExtendSigned(a) => from(word(a), 0, sign(a), width),
            Op::Join(high, low) => {
                let joined = [word(low), word(high)].concat();
                from(&joined, 0, LOW, width)
            }
            Op::Read(number, address) => {
                let memory = &self.flat.memories[number as usize];
                match (memory.port, &self.state) {
                    (Port::Rom, _) => gates.table(&memory.contents, word(address), memory.width),
                    (_, Some(state)) => match &state.memories[number as usize] {
                        Some(words) => {
                            let column = |bit: usize| words.iter().map(|word| word[bit]).collect();
                            (0..width)
                                .map(|bit| gates.choose(column(bit), word(address)))
                                .collect()
                        }
                        None => {
                            let read = (number, word(address).to_vec());
                            let first = self.unused;
                            let any = self.reads.entry(read).or_insert_with(|| {
                                self.unused = first + width as u32;
                                let bits = first..self.unused;
                                bits.map(|bit| gates.input(bit)).collect()
                            });
                            any.clone()
                        }
                    },
                    (_, None) => return Err(NotSliced),
                }
            }
        })
    }
}
