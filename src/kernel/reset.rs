use super::Circuit;
use super::probe::{Probe, Words};
use super::signals::{Field, Make, Role, Shape, Signals, Visit};
use crate::logic::{Image, Sim, Unsigned, sim::*};
use std::any::Any;
use std::collections::VecDeque;

/// The registers after an edge with reset: flip-flops as at power-on, memories as the edge made
/// them.
///
/// Memories are taken whole, with what they say they changed: waves look at nothing else.
pub(super) fn reset<C: Circuit>(circuit: &C, edge: &C::Reg<Sim>) -> C::Reg<Sim> {
    let field = const { &Field::part(Role::Register) };
    let mut flip_flops = FlipFlops::default();
    circuit.power_on().visit(field, &mut flip_flops);
    let mut memories = Memories::default();
    edge.visit(field, &mut memories);
    let mut registers = Registers {
        flip_flops,
        memories,
    };
    C::Reg::make(field, &mut registers)
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

impl Memories {
    /// The next one; none only if it were asked for another type than it has, which the same walk
    /// cannot.
    fn take<T: 'static>(&mut self) -> Option<T> {
        let memory = self.0.pop_front()?.downcast().ok()?;
        Some(*memory)
    }
}

impl Visit<Sim> for Memories {
    fn enter(&mut self, _: &'static Field) {}
    fn leave(&mut self) {}
    fn element(&mut self, _: usize) {}
    fn bit(&mut self, _: &'static Field, _: Wire) {}
    fn unsigned<const N: usize>(&mut self, _: &'static Field, _: UInt<N>) {}
    fn signed<const N: usize>(&mut self, _: &'static Field, _: Int<N>) {}
    fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field, ram: &SimRam<A, D>) {
        self.0.push_back(Box::new(ram.clone()));
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        _: &'static Field,
        register: &SimShiftRegister<K, D>,
    ) {
        self.0.push_back(Box::new(register.clone()));
    }
}

/// Puts both together again.
struct Registers {
    flip_flops: FlipFlops,
    memories: Memories,
}

impl Registers {
    fn bits(&mut self) -> u64 {
        self.flip_flops.0.pop_front().unwrap_or(0)
    }
}

impl Make<Sim> for Registers {
    fn enter(&mut self, _: &'static Field) {}
    fn leave(&mut self) {}
    fn element(&mut self, _: usize) {}
    fn bit(&mut self, _: &'static Field) -> Wire {
        (self.bits() == 1).into()
    }
    fn unsigned<const N: usize>(&mut self, _: &'static Field) -> UInt<N> {
        self.bits().into()
    }
    fn signed<const N: usize>(&mut self, _: &'static Field) -> Int<N> {
        UInt::from(self.bits()).signed()
    }
    fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field) -> SimRam<A, D> {
        self.memories
            .take()
            .unwrap_or_else(|| Image::zeroed().into())
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        _: &'static Field,
    ) -> SimShiftRegister<K, D> {
        self.memories
            .take()
            .unwrap_or_else(|| SimShiftRegister::new([]))
    }
}
