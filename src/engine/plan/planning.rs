//! Plan under construction: which nodes get a slot, and in which block they are.

use super::levels::{EdgeReads, Levels, through};
use super::{Plan, PlannedRegister, bit, wants};
use crate::engine::flat::{Flat, Id, Place};
use crate::engine::layout::{Layout, Slot};
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

pub(super) struct Planning<'f> {
    pub flat: &'f Flat,
    pub levels: &'f Levels,
    pub order: &'f [(u32, u32)],
    pub wanted: &'f [bool],
    /// Block of each level and instance.
    pub place: FxHashMap<(u32, u32), usize>,
    pub settling: usize,
    pub layout: Layout,
    /// Slots of nodes that others read.
    pub nets: FxHashMap<Id, Slot>,
    pub constants: BTreeMap<u64, Slot>,
    pub registers: Vec<PlannedRegister>,
}

impl<'f> Planning<'f> {
    pub fn new(
        flat: &'f Flat,
        levels: &'f Levels,
        order: &'f [(u32, u32)],
        wanted: &'f [bool],
    ) -> Self {
        let settling = order
            .iter()
            .filter(|(level, _)| *level < levels.end)
            .count();
        let blocks = bit(order.len(), settling);
        let mut layout = Layout::new(blocks);
        layout.inputs = flat.inputs.iter().map(|_| layout.take(1)).collect();
        let registers = flat.registers.iter().map(|register| PlannedRegister {
            slot: layout.take(1),
            shadow: None,
            width: register.width,
        });
        let registers = registers.collect();
        Planning {
            flat,
            levels,
            order,
            wanted,
            place: order
                .iter()
                .enumerate()
                .map(|(place, key)| (*key, place))
                .collect(),
            settling,
            layout,
            nets: FxHashMap::default(),
            constants: BTreeMap::new(),
            registers,
        }
    }

    /// Returns the block of a stored node.
    pub fn block_of(&self, id: Id) -> usize {
        let key = (self.levels.level[id as usize], self.flat.node(id).instance);
        self.place[&key]
    }

    pub fn plan(mut self, reads: &EdgeReads) -> Plan {
        let mut nodes: Vec<Vec<Id>> = vec![Vec::new(); self.order.len()];
        for id in 0..self.flat.nodes.len() as Id {
            if self.levels.own[id as usize] {
                nodes[self.block_of(id)].push(id);
            }
        }
        self.shadow(reads);
        self.store();
        let mut scratch = Vec::new();
        let mut blocks = Vec::new();
        for (place, nodes) in nodes.iter().enumerate() {
            blocks.push(self.block(place, nodes, &mut scratch));
        }
        self.finish(blocks)
    }

    /// Gives a shadow to each register that a later edge reads.
    fn shadow(&mut self, reads: &EdgeReads) {
        for (owner, registers) in reads {
            let Some(&reader) = self.place.get(&(self.levels.end, *owner)) else {
                continue;
            };
            for &register in registers {
                let writer = self.flat.registers[register as usize].instance;
                let writer = self.place[&(self.levels.end, writer)];
                let planned = &mut self.registers[register as usize];
                if reader > writer && planned.shadow.is_none() {
                    planned.shadow = Some(self.layout.take(1));
                }
            }
        }
    }

    /// Gives slots to nodes that other blocks read, or that are wanted.
    fn store(&mut self) {
        let (flat, levels) = (self.flat, self.levels);
        let mut stored = BTreeSet::new();
        let mut stack = Vec::new();
        let mut see = |stored: &mut BTreeSet<Id>, from: Id, key: (u32, u32)| {
            through(flat, &levels.own, std::iter::once(from), &mut stack, |id| {
                if (levels.level[id as usize], flat.node(id).instance) != key {
                    stored.insert(id);
                }
            });
        };
        for id in 0..flat.nodes.len() as Id {
            if levels.own[id as usize] {
                let node = flat.node(id);
                let key = (levels.level[id as usize], node.instance);
                node.op
                    .operands()
                    .for_each(|from| see(&mut stored, from, key));
            }
        }
        for register in &flat.registers {
            see(&mut stored, register.next, (levels.end, register.instance));
        }
        for memory in &flat.memories {
            let key = (levels.end, memory.instance);
            memory
                .port
                .operands()
                .for_each(|from| see(&mut stored, from, key));
        }
        for (index, place) in flat.leaves.iter().enumerate() {
            if let (Place::Node(id), true) = (*place, wants(self.wanted, index))
                && levels.own[id as usize]
            {
                stored.insert(id);
            }
        }
        for (index, &id) in flat.properties.iter().enumerate() {
            if wants(self.wanted, flat.leaves.len() + index) && levels.own[id as usize] {
                stored.insert(id);
            }
        }
        for id in stored {
            let slot = self.layout.take(1);
            self.nets.insert(id, slot);
        }
    }

    pub fn constant(&mut self, bits: u64) -> Slot {
        let layout = &mut self.layout;
        *self.constants.entry(bits).or_insert_with(|| {
            let slot = layout.take(1);
            layout.initial.push((slot, bits));
            layout.constants.push((slot, bits));
            slot
        })
    }
}
