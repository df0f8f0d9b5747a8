//! Places of the leaves of a walk over the outermost circuit.

use super::{Flattening, unsettled};
use crate::engine::flat::{EngineError, Op, Place};
use crate::netlist;

impl Flattening<'_> {
    /// Sets the places of the leaves of a walk over the outermost circuit.
    pub(super) fn leaves(&mut self, whole: usize) -> Result<(), EngineError> {
        let module = self.parts[whole].module;
        let inputs = (0..self.flat.inputs.len() as u32).map(Place::Input);
        self.flat.leaves = inputs.collect();
        self.flat.parts[0] = self.flat.leaves.len();
        for register in module.register_leaves() {
            match register {
                netlist::Register::Signal(signal) => {
                    let missing = || unsettled(module, &format!("signal {signal}"));
                    let register = self.register(whole, signal).ok_or_else(missing)?;
                    self.flat.leaves.push(Place::Register(register));
                }
                netlist::Register::Memory(memory) => {
                    let missing = || unsettled(module, &format!("memory {memory}"));
                    let memory = self.memory(whole, memory).ok_or_else(missing)?;
                    let words = self.flat.memories[memory as usize].contents.len() as u32;
                    let words = (0..words).map(|word| Place::Word(memory, word));
                    self.flat.leaves.extend(words);
                }
            }
        }
        self.flat.parts[1] = self.flat.leaves.len();
        for leaf in 0..module.net_leaves() {
            let node = self.net(whole, leaf)?;
            self.flat.leaves.push(Place::Node(node));
        }
        for place in &mut self.flat.leaves {
            if let Place::Node(id) = *place {
                *place = match self.flat.nodes[id as usize].op {
                    Op::Input(input) => Place::Input(input),
                    Op::Register(register) => Place::Register(register),
                    _ => Place::Node(id),
                };
            }
        }
        Ok(())
    }
}
