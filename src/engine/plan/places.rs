//! Slots of memories, leaves and properties, and their readers.

use super::planning::Planning;
use super::{Block, Code, Plan, PlannedMemory, bit, wants};
use crate::engine::flat::{Id, Op, Place, Port};
use crate::engine::layout::{Change, Slot, Spot, Watched};
use std::collections::BTreeMap;

impl Planning<'_> {
    pub fn finish(mut self, blocks: Vec<Block>) -> Plan {
        let mut memories = Vec::new();
        for memory in &self.flat.memories {
            let shifts = matches!(memory.port, Port::Shift { .. });
            let head = shifts.then(|| self.layout.take(1));
            let (mark, written) = (self.layout.take(1), self.layout.take(1));
            memories.push(PlannedMemory {
                first: self.layout.take(memory.contents.len() as u32),
                words: memory.contents.len() as u32,
                head,
                mark,
                written,
                readers: Vec::new(),
                width: memory.width,
            });
        }
        for (planned, memory) in memories.iter().zip(&self.flat.memories) {
            for (index, &word) in memory.contents.iter().enumerate() {
                if word != 0 {
                    self.layout
                        .initial
                        .push((planned.first + index as u32, word));
                }
            }
        }
        for (planned, register) in self.registers.iter().zip(&self.flat.registers) {
            self.layout.initial.push((planned.slot, register.power_on));
        }
        let mut readers: Vec<Vec<u32>> = vec![Vec::new(); self.layout.words as usize];
        for (place, block) in blocks.iter().enumerate() {
            for &slot in &block.reads {
                readers[slot as usize].push(bit(place, self.settling) as u32);
            }
            for step in &block.steps {
                if step.code == Code::Read {
                    let known = &mut memories[step.c as usize].readers;
                    let bit = bit(place, self.settling) as u32;
                    if known.last() != Some(&bit) {
                        known.push(bit);
                    }
                }
            }
        }
        self.layout.bits = (0..blocks.len())
            .map(|block| bit(block, self.settling) as u32)
            .collect();
        self.layout.readers = readers
            .into_iter()
            .map(|blocks| {
                let mut words: BTreeMap<Slot, u64> = BTreeMap::new();
                for bit in blocks {
                    *words.entry(self.layout.dirty + bit / 64).or_default() |= 1 << (bit % 64);
                }
                words.into_iter().collect()
            })
            .collect();
        self.spots(&memories);
        Plan {
            blocks,
            settling: self.settling,
            registers: self.registers,
            memories,
            instances: self
                .flat
                .instances
                .iter()
                .map(|instance| instance.path.join("."))
                .collect(),
            layout: self.layout,
        }
    }

    /// Sets the spots of leaves and properties, and their change marks.
    fn spots(&mut self, memories: &[PlannedMemory]) {
        let mut watched: BTreeMap<Slot, (Option<u32>, Vec<u32>)> = BTreeMap::new();
        let mut spots = Vec::new();
        for (index, place) in self.flat.leaves.iter().enumerate() {
            let wanted = wants(self.wanted, index);
            let spot = match *place {
                Place::Input(input) => Spot::Slot(self.layout.inputs[input as usize]),
                Place::Register(register) => Spot::Slot(self.registers[register as usize].slot),
                Place::Word(memory, word) => match memories[memory as usize].head {
                    Some(_) => Spot::Stage(memory, word),
                    None => Spot::Slot(memories[memory as usize].first + word),
                },
                Place::Node(_) if !wanted => Spot::Gone,
                Place::Node(id) => self.spot(id),
            };
            let (slot, memory) = match (*place, spot) {
                (Place::Word(memory, _), _) => (Some(memories[memory as usize].mark), Some(memory)),
                (_, Spot::Slot(slot)) => (Some(slot), None),
                _ => (None, None),
            };
            if let Some(slot) = slot.filter(|_| wanted) {
                let (of, leaves) = watched.entry(slot).or_default();
                *of = memory;
                leaves.push(index as u32);
            }
            spots.push(spot);
        }
        let leaves = self.flat.leaves.len();
        let properties = self.flat.properties.iter().enumerate().map(|(index, &id)| {
            match wants(self.wanted, leaves + index) {
                true => self.spot(id),
                false => Spot::Gone,
            }
        });
        self.layout.properties = properties.collect();
        self.layout.leaves = spots;
        let words = watched.len().div_ceil(64) as u32;
        self.layout.changed = self.layout.take(words);
        self.layout.changed_words = words;
        let first = self.layout.changed;
        self.layout.changes = vec![None; self.layout.words as usize];
        for (index, (slot, (memory, leaves))) in watched.into_iter().enumerate() {
            let index = index as u32;
            self.layout.changes[slot as usize] = Some(Change {
                word: first + index / 64,
                mask: 1 << (index % 64),
            });
            let start = self.layout.shown.len() as u32;
            self.layout.shown.extend(leaves);
            self.layout.watched.push(Watched {
                slot,
                leaves: start..self.layout.shown.len() as u32,
                memory,
            });
        }
    }

    fn spot(&self, id: Id) -> Spot {
        match self.flat.node(id).op {
            Op::Constant(bits) => Spot::Constant(bits),
            Op::Input(input) => Spot::Slot(self.layout.inputs[input as usize]),
            Op::Register(register) => Spot::Slot(self.registers[register as usize].slot),
            _ => self
                .nets
                .get(&id)
                .map_or(Spot::Gone, |&slot| Spot::Slot(slot)),
        }
    }
}
