//! Tick of a circuit as gates: from its state and input ports to the state after the edge.

use super::NotSliced;
use super::gates::{Gates, HIGH, Wire};
use super::lower::Lowering;
use crate::engine::flat::{Flat, Place, Port};

/// Wires of a circuit's state.
#[derive(Clone)]
pub struct State {
    /// Wires of each register.
    pub registers: Vec<Vec<Wire>>,
    /// Wires of each memory, by address; empty for a ROM.
    pub memories: Vec<Vec<Vec<Wire>>>,
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
                    Port::Rom => Vec::new(),
                    _ => vec![Vec::new(); memory.contents.len()],
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
                    let words = &mut state.memories[memory as usize];
                    if let Some(wires) = words.get_mut(word as usize) {
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
    let mut lowering = Lowering::of(flat, Some(before.clone()), inputs, gates)?;
    let mut out = Vec::new();
    for place in held(flat) {
        match place {
            Place::Register(register) => {
                let next = flat.registers[register as usize].next;
                out.extend_from_slice(lowering.word(next));
            }
            Place::Word(memory, word) => {
                let words = &before.memories[memory as usize];
                let held = &words[word as usize];
                let port = flat.memories[memory as usize].port;
                let (enable, data) = match port {
                    Port::Rom => continue,
                    Port::Ram {
                        enable,
                        address,
                        data,
                    } => {
                        let address = lowering.word(address).to_vec();
                        let enable = lowering.word(enable)[0];
                        let here = lowering.gates.is(&address, word.into());
                        let enable = lowering.gates.and(enable, here);
                        (enable, lowering.word(data).to_vec())
                    }
                    Port::Shift { enable, data } => {
                        let enable = lowering.word(enable)[0];
                        let data = match word.checked_sub(1) {
                            None => lowering.word(data).to_vec(),
                            Some(before) => words[before as usize].clone(),
                        };
                        (enable, data)
                    }
                };
                for (&data, &held) in data.iter().zip(held) {
                    out.push(lowering.gates.mux(enable, data, held));
                }
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
