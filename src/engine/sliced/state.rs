//! Tick of a circuit as gates: from its state and input ports to the state after the edge.

use super::NotSliced;
use super::gates::{Gates, HIGH, Wire};
use super::lower::Lowering;
use crate::engine::flat::{Flat, Place, Port};

/// Wires of a circuit's state.
#[derive(Debug, Clone)]
pub struct State {
    /// Wires of each register; none outside the cone.
    pub registers: Vec<Vec<Wire>>,
    /// Wires of each memory, by address; empty for a ROM. `None` if a read may give any word.
    pub memories: Vec<Option<Vec<Vec<Wire>>>>,
}

impl State {
    /// Assigns the bits of a case from the lowest up, in the order of the leaves.
    fn of(flat: &Flat, gates: &mut Gates) -> Self {
        let mut state = State {
            registers: vec![Vec::new(); flat.registers.len()],
            memories: flat
                .memories
                .iter()
                .map(|memory| match memory.port {
                    Port::Rom => Some(Vec::new()),
                    _ => Some(vec![Vec::new(); memory.contents.len()]),
                })
                .collect(),
        };
        let mut first = 0;
        let mut bits = |width: u8| {
            first += u32::from(width);
            let bits = first - u32::from(width)..first;
            bits.map(|bit| gates.input(bit)).collect::<Vec<_>>()
        };
        for place in held(flat) {
            match place {
                Place::Register(register) => {
                    let width = flat.registers[register as usize].width;
                    state.registers[register as usize] = bits(width);
                }
                Place::Word(memory, word) => {
                    let width = flat.memories[memory as usize].width;
                    let words = state.memories[memory as usize].as_mut();
                    if let Some(wires) = words.and_then(|words| words.get_mut(word as usize)) {
                        *wires = bits(width);
                    }
                }
                Place::Node(_) | Place::Input(_) => {}
            }
        }
        state
    }
}

/// Returns the state of a circuit, in the order of its leaves.
fn held(flat: &Flat) -> impl Iterator<Item = Place> + '_ {
    let leaves = &flat.leaves[flat.parts[0]..flat.parts[1]];
    let rom = |place: &Place| match *place {
        Place::Word(memory, _) => flat.memories[memory as usize].port == Port::Rom,
        _ => false,
    };
    leaves.iter().copied().filter(move |place| !rom(place))
}

/// Returns the state after the edge of a tick that starts in `before`.
pub fn after(lowering: &mut Lowering<'_>, before: &State) -> State {
    let flat = lowering.flat();
    let registers = flat.registers.iter();
    let registers = registers.map(|register| lowering.word(register.next).to_vec());
    let registers = registers.collect();
    let memories = flat.memories.iter().zip(&before.memories);
    let memories = memories.map(|(memory, words)| {
        let words = words.as_ref()?;
        Some(match memory.port {
            _ if words.is_empty() => Vec::new(),
            Port::Rom => Vec::new(),
            Port::Ram {
                enable,
                address,
                data,
            } => {
                let enable = lowering.word(enable)[0];
                let [address, data] = [address, data].map(|id| lowering.word(id).to_vec());
                let gates = &mut lowering.gates;
                let words = words.iter().enumerate().map(|(word, held)| {
                    let here = gates.is(&address, word as u64);
                    let here = gates.and(enable, here);
                    chosen(gates, here, &data, held)
                });
                words.collect()
            }
            Port::Shift { enable, data } => {
                let enable = lowering.word(enable)[0];
                let data = lowering.word(data).to_vec();
                let before = std::iter::once(&data).chain(words);
                let gates = &mut lowering.gates;
                let words = before.zip(words);
                words
                    .map(|(data, held)| chosen(gates, enable, data, held))
                    .collect()
            }
        })
    });
    State {
        registers,
        memories: memories.collect(),
    }
}

/// Returns the first word if `choose` is high, else the second.
fn chosen(gates: &mut Gates, choose: Wire, then: &[Wire], other: &[Wire]) -> Vec<Wire> {
    let pairs = then.iter().zip(other);
    pairs
        .map(|(&then, &other)| gates.mux(choose, then, other))
        .collect()
}

/// Tick as gates.
pub struct Edge {
    pub gates: Gates,
    /// Bits of the state after the tick.
    pub after: Vec<Wire>,
    /// For each set of properties a wire that is high if all of them hold.
    pub all: [Wire; 2],
}

/// Returns the gates of a tick. Input ports are the bits of a case from `inputs` on.
pub fn tick(flat: &Flat, properties: [&[usize]; 2], inputs: u32) -> Result<Edge, NotSliced> {
    let mut gates = Gates::new();
    let before = State::of(flat, &mut gates);
    let state = Some(before.clone());
    let mut lowering = Lowering::of(flat, state, inputs, gates, &|_| true)?;
    let after = after(&mut lowering, &before);
    let mut out = Vec::new();
    for place in held(flat) {
        match place {
            Place::Register(register) => out.extend(&after.registers[register as usize]),
            Place::Word(memory, word) => {
                let words = after.memories[memory as usize].as_ref();
                out.extend(&words.ok_or(NotSliced)?[word as usize]);
            }
            Place::Node(_) | Place::Input(_) => {}
        }
    }
    let mut all = [HIGH; 2];
    for (all, properties) in all.iter_mut().zip(properties) {
        for &property in properties {
            let id = *flat.properties.get(property).ok_or(NotSliced)?;
            let holds = lowering.word(id)[0];
            *all = lowering.gates.and(*all, holds);
        }
    }
    Ok(Edge {
        gates: lowering.gates,
        after: out,
        all,
    })
}
