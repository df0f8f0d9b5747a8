//! Unrolling of a netlist: its ticks one after the other, as gates.

use crate::engine::sliced::NotSliced;
use crate::engine::sliced::gates::{Gates, HIGH, LOW, Wire};
use crate::engine::sliced::lower::Lowering;
use crate::engine::sliced::state::{State, after};
use crate::engine::{Flat, Id, Op, Place, Port};

/// State of the first tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Start {
    /// State at power-on.
    PowerOn,
    /// Any state; its bits are inputs of the gates.
    Any,
}

/// Part of a netlist on which some nodes depend, over any number of ticks.
#[derive(Debug, Clone)]
pub(super) struct Cone {
    nodes: Vec<bool>,
    registers: Vec<bool>,
    memories: Vec<bool>,
    /// Memories whose words are state; a read of another one may give any word.
    expanded: Vec<bool>,
}

impl Cone {
    /// Returns the cone of these nodes, in which at most `memory_bits` bits of memories are expanded.
    pub fn of(flat: &Flat, asked: &[Id], memory_bits: usize) -> Self {
        let mut cone = Cone {
            nodes: vec![false; flat.nodes.len()],
            registers: vec![false; flat.registers.len()],
            memories: vec![false; flat.memories.len()],
            expanded: vec![false; flat.memories.len()],
        };
        let mut open = asked.to_vec();
        while let Some(id) = open.pop() {
            if std::mem::replace(&mut cone.nodes[id as usize], true) {
                continue;
            }
            let op = flat.node(id).op;
            open.extend(op.operands());
            match op {
                Op::Register(register) => {
                    cone.registers[register as usize] = true;
                    open.push(flat.registers[register as usize].next);
                }
                Op::Read(memory, _) => {
                    cone.memories[memory as usize] = true;
                    open.extend(flat.memories[memory as usize].port.operands());
                }
                _ => {}
            }
        }
        cone.expand(flat, memory_bits);
        cone
    }

    /// Expands memories, the smallest first, as far as they fit.
    fn expand(&mut self, flat: &Flat, mut left: usize) {
        let bits = |memory: &usize| {
            let memory = &flat.memories[*memory];
            memory.contents.len() * usize::from(memory.width)
        };
        let written = |memory: &usize| flat.memories[*memory].port != Port::Rom;
        let mut memories: Vec<usize> = (0..flat.memories.len())
            .filter(|memory| self.memories[*memory] && written(memory))
            .collect();
        memories.sort_by_key(bits);
        for memory in memories {
            let Some(rest) = left.checked_sub(bits(&memory)) else {
                break;
            };
            left = rest;
            self.expanded[memory] = true;
        }
    }

    /// True if words of a memory are state.
    pub fn is_expanded(&self) -> bool {
        self.expanded.contains(&true)
    }

    /// True if a read of some memory may give any word: a counterexample may then be spurious.
    pub fn is_abstract(&self, flat: &Flat) -> bool {
        (0..flat.memories.len()).any(|memory| self.is_free(flat, memory))
    }

    fn is_free(&self, flat: &Flat, memory: usize) -> bool {
        let written = flat.memories[memory].port != Port::Rom;
        self.memories[memory] && written && !self.expanded[memory]
    }

    /// Returns the state of the first tick; `word` makes each of its words from a width and the
    /// power-on value.
    fn state(&self, flat: &Flat, mut word: impl FnMut(u8, u64) -> Vec<Wire>) -> State {
        let registers = flat.registers.iter().zip(&self.registers);
        let registers = registers.map(|(register, inside)| match inside {
            true => word(register.width, register.power_on),
            false => Vec::new(),
        });
        let registers = registers.collect();
        let memories = flat.memories.iter().enumerate();
        let memories = memories.map(|(index, memory)| {
            if self.is_free(flat, index) {
                return None;
            }
            let words = match self.expanded[index] {
                true => &memory.contents[..],
                false => &[],
            };
            let words = words.iter();
            Some(words.map(|&bits| word(memory.width, bits)).collect())
        });
        State {
            memories: memories.collect(),
            registers,
        }
    }
}

/// Wires of a tick.
#[derive(Debug)]
pub(super) struct Frame {
    /// State before the edge.
    pub state: State,
    /// Input ports.
    pub ports: Vec<Vec<Wire>>,
    /// Properties of the netlist; low if the cone does not contain them.
    pub properties: Vec<Wire>,
}

/// Ticks of a netlist from a state on.
#[derive(Debug)]
pub(super) struct Frames<'f> {
    flat: &'f Flat,
    cone: &'f Cone,
    pub gates: Gates,
    /// First bit of a case that no tick uses.
    unused: u32,
    frames: Vec<Frame>,
    /// State after the edge of the last tick.
    next: State,
}

impl<'f> Frames<'f> {
    pub fn new(flat: &'f Flat, cone: &'f Cone, start: Start) -> Self {
        let mut gates = Gates::new();
        let mut unused = 0;
        let next = cone.state(flat, |width, power_on| match start {
            Start::PowerOn => constant(width, power_on),
            Start::Any => {
                let bits = unused..unused + u32::from(width);
                unused = bits.end;
                bits.map(|bit| gates.input(bit)).collect()
            }
        });
        Frames {
            flat,
            cone,
            gates,
            unused,
            frames: Vec::new(),
            next,
        }
    }

    /// Returns a tick, counted from 0, and the gates.
    ///
    /// # Errors
    /// Returns an error if a tick has too many gates.
    pub fn tick(&mut self, tick: usize) -> Result<(&Frame, &Gates), NotSliced> {
        while self.frames.len() <= tick {
            self.unroll()?;
        }
        Ok((&self.frames[tick], &self.gates))
    }

    /// Returns the state before a tick.
    ///
    /// # Errors
    /// Returns an error if a tick before it has too many gates.
    pub fn state(&mut self, tick: usize) -> Result<&State, NotSliced> {
        while self.frames.len() < tick {
            self.unroll()?;
        }
        Ok(self.frames.get(tick).map_or(&self.next, |it| &it.state))
    }

    /// Returns the inputs of the gates so far, from a bit on.
    pub fn free(&mut self, first: usize) -> Vec<Wire> {
        let bits = first as u32..self.unused;
        bits.map(|bit| self.gates.input(bit)).collect()
    }

    fn unroll(&mut self) -> Result<(), NotSliced> {
        let gates = std::mem::replace(&mut self.gates, Gates::new());
        let cone = |id: Id| self.cone.nodes[id as usize];
        let state = self.next.clone();
        let lowering = Lowering::of(self.flat, Some(state.clone()), self.unused, gates, &cone);
        let mut lowering = lowering?;
        self.next = after(&mut lowering, &state);
        // The node that a register takes may be in the cone without it.
        for (word, inside) in self.next.registers.iter_mut().zip(&self.cone.registers) {
            if !inside {
                word.clear();
            }
        }
        let properties = self.flat.properties.iter();
        let properties = properties.map(|&id| lowering.word(id).first().copied().unwrap_or(LOW));
        let properties = properties.collect();
        let ports = 0..self.flat.inputs.len() as u32;
        let ports = ports.map(|port| lowering.port(port)).collect();
        self.unused = lowering.unused;
        self.gates = lowering.gates;
        self.frames.push(Frame {
            state,
            ports,
            properties,
        });
        Ok(())
    }

    /// Returns the bits of the state, in one order for every tick: place, index and wire of each.
    pub fn bits(state: &State) -> Vec<(Place, usize, Wire)> {
        let registers = state.registers.iter().enumerate();
        let registers = registers.map(|(index, word)| (Place::Register(index as u32), word));
        let memories = state.memories.iter().enumerate();
        let words = memories.flat_map(|(memory, words)| {
            let words = words.iter().flatten().enumerate();
            words.map(move |(index, word)| (Place::Word(memory as u32, index as u32), word))
        });
        let bits = registers.chain(words).flat_map(|(place, word)| {
            let bits = word.iter().enumerate();
            bits.map(move |(bit, &wire)| (place, bit, wire))
        });
        bits.collect()
    }
}

/// Returns a word of constant wires.
fn constant(width: u8, bits: u64) -> Vec<Wire> {
    let bit = |bit: u8| if bits >> bit & 1 == 1 { HIGH } else { LOW };
    (0..width).map(bit).collect()
}
