use super::Circuit;
use super::probe::{Probe, Source, Words, show, supply};
use super::signals::{Field, Role, Shape};
use crate::logic::Sim;
use std::any::Any;
use std::collections::VecDeque;

/// The registers after an edge with reset: flip-flops as at power-on, memories as the edge made
/// them.
///
/// Memories are taken whole, with the count of their changes: waves look at nothing else.
pub(super) fn reset<C: Circuit>(circuit: &C, edge: &C::Reg<Sim>) -> C::Reg<Sim> {
    let mut flip_flops = FlipFlops::default();
    show(&circuit.power_on(), Role::Register, &mut flip_flops);
    let mut memories = Memories::default();
    show(edge, Role::Register, &mut memories);
    let mut registers = Registers {
        flip_flops,
        memories,
    };
    supply(Role::Register, &mut registers)
}

/// The flip-flops of a walk, in its order.
#[derive(Default)]
struct FlipFlops(VecDeque<u64>);

impl Probe for FlipFlops {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.0.push_back(bits);
    }
    fn memory(&mut self, _: &'static Field, _: &dyn Words) {}
}

/// The memories of a walk, in its order.
#[derive(Default)]
struct Memories(VecDeque<Box<dyn Any>>);

impl Probe for Memories {
    fn leaf(&mut self, _: &'static Field, _: Shape, _: u64) {}
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        self.0.push_back(words.whole());
    }
}

/// Puts both together again.
struct Registers {
    flip_flops: FlipFlops,
    memories: Memories,
}

impl Source for Registers {
    fn leaf(&mut self, _: &'static Field, _: Shape) -> u64 {
        self.flip_flops.0.pop_front().unwrap_or(0)
    }
    fn memory(&mut self) -> Option<Box<dyn Any>> {
        self.memories.0.pop_front()
    }
}
