//! Steps of a block.

use super::planning::Planning;
use super::{Block, Code, Step, Write};
use crate::engine::flat::{Id, Op, Port};
use crate::engine::layout::{Layout, Slot};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

impl Planning<'_> {
    pub fn block(&mut self, place: usize, nodes: &[Id], scratch: &mut Vec<Slot>) -> Block {
        let (level, instance) = self.order[place];
        let mut block = Block {
            instance,
            ..Block::default()
        };
        let mut builder = Builder {
            known: FxHashMap::default(),
            used: 0,
            scratch,
            reads: BTreeSet::new(),
        };
        for &id in nodes {
            let slot = self.make(id, place, &mut block, &mut builder);
            if let Some(&to) = self.nets.get(&id) {
                block.outputs.push((slot, to));
            }
        }
        if level == self.levels.end {
            for number in 0..self.flat.registers.len() {
                let register = &self.flat.registers[number];
                if register.instance == instance {
                    let mut from = self.make(register.next, place, &mut block, &mut builder);
                    if matches!(self.flat.node(register.next).op, Op::Register(_)) {
                        // A copy, since that register may be made before this one.
                        let to = builder.scratch(&mut self.layout);
                        block.steps.push(Step {
                            code: Code::Extend,
                            width: register.width,
                            from: register.width,
                            by: 0,
                            to,
                            a: from,
                            b: 0,
                            c: 0,
                        });
                        from = to;
                    }
                    block.registers.push((number as u32, from));
                    block.commits |= self.registers[number].shadow.is_some();
                }
            }
            for number in 0..self.flat.memories.len() {
                let memory = &self.flat.memories[number];
                if memory.instance == instance && memory.port != Port::Rom {
                    let port = memory.port;
                    let mut of = |id| self.make(id, place, &mut block, &mut builder);
                    let (enable, data, address) = match port {
                        Port::Rom => continue,
                        Port::Ram {
                            enable,
                            address,
                            data,
                        } => (of(enable), of(data), Some(of(address))),
                        Port::Shift { enable, data } => (of(enable), of(data), None),
                    };
                    block.writes.push(Write {
                        memory: number as u32,
                        enable,
                        data,
                        address,
                    });
                }
            }
        }
        block.reads = builder.reads.into_iter().collect();
        block
    }

    /// Returns the slot of a node in a block; adds the steps that compute it if necessary.
    fn make(&mut self, id: Id, place: usize, block: &mut Block, builder: &mut Builder<'_>) -> Slot {
        if let Some(&slot) = builder.known.get(&id) {
            return slot;
        }
        let node = self.flat.node(id);
        let slot = match node.op {
            Op::Constant(bits) => self.constant(bits),
            Op::Input(input) => {
                let slot = self.layout.inputs[input as usize];
                builder.reads.insert(slot);
                slot
            }
            Op::Register(register) => {
                let slot = self.registers[register as usize].slot;
                builder.reads.insert(slot);
                slot
            }
            _ if self.levels.own[id as usize] && self.block_of(id) != place => {
                let slot = self.nets[&id];
                builder.reads.insert(slot);
                slot
            }
            op => {
                let mut operands = [0; 3];
                let mut from = node.width;
                let mut by = 0;
                for (index, operand) in op.operands().enumerate() {
                    operands[index] = self.make(operand, place, block, builder);
                    if index == 0 {
                        from = self.flat.node(operand).width;
                    } else {
                        by = self.flat.node(operand).width;
                    }
                }
                let [a, b, mut c] = operands;
                let code = match op {
                    Op::Not(_) => Code::Not,
                    Op::Negate(_) => Code::Negate,
                    Op::Add(..) => Code::Add,
                    Op::Subtract(..) => Code::Subtract,
                    Op::Multiply(..) => Code::Multiply,
                    Op::And(..) => Code::And,
                    Op::Or(..) => Code::Or,
                    Op::Xor(..) => Code::Xor,
                    Op::Equal(..) => Code::Equal,
                    Op::Below(..) => Code::Below,
                    Op::BelowSigned(..) => Code::BelowSigned,
                    Op::Mux(..) => Code::Mux,
                    Op::ShiftLeft(_, bits) => {
                        by = bits;
                        Code::ShiftLeft
                    }
                    Op::ShiftRight(_, bits) => {
                        by = bits;
                        Code::ShiftRight
                    }
                    Op::ShiftRightSigned(_, bits) => {
                        by = bits;
                        Code::ShiftRightSigned
                    }
                    Op::Slice(_, low) => {
                        by = low;
                        Code::Slice
                    }
                    Op::Extend(_) => Code::Extend,
                    Op::ExtendSigned(_) => Code::ExtendSigned,
                    Op::Join(..) => Code::Join,
                    Op::Read(memory, _) => {
                        c = memory;
                        Code::Read
                    }
                    Op::Constant(_) | Op::Input(_) | Op::Register(_) => Code::Extend,
                };
                let to = builder.scratch(&mut self.layout);
                block.steps.push(Step {
                    code,
                    width: node.width,
                    from,
                    by,
                    to,
                    a,
                    b,
                    c,
                });
                to
            }
        };
        builder.known.insert(id, slot);
        slot
    }
}

/// Block under construction.
struct Builder<'s> {
    known: FxHashMap<Id, Slot>,
    /// Number of scratch slots used, which all blocks share.
    used: usize,
    scratch: &'s mut Vec<Slot>,
    reads: BTreeSet<Slot>,
}

impl Builder<'_> {
    fn scratch(&mut self, layout: &mut Layout) -> Slot {
        if self.used == self.scratch.len() {
            self.scratch.push(layout.take(1));
        }
        self.used += 1;
        self.scratch[self.used - 1]
    }
}
