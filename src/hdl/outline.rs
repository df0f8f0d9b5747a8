//! The signals of a circuit by name, in the order of its waves.

use super::Circuit;
use super::memory::Contents;
use super::record::{Cells, MemoryShape, Pass, Source};
use super::{Declarations, Outline};
use crate::netlist::{Field, Role, Shape};

/// Returns the signals of a circuit: input ports, registers, nets. Power-on values are left at 0.
/// `beside` shows the input ports that stand beside the circuit.
pub(crate) fn declarations<C: Circuit>(
    circuit: &C,
    beside: &mut dyn FnMut(&mut dyn Source),
) -> Declarations {
    let mut declarations = Declarations::within(circuit.name());
    let mut shown = Shown {
        outline: &mut declarations,
        pass: Pass::Registers,
    };
    circuit.make_shapes(Role::Input, &mut shown);
    beside(&mut shown);
    circuit.make_shapes(Role::Register, &mut shown);
    circuit.make_shapes(Role::Net, &mut shown);
    declarations
}

/// Source that passes names and shapes of a walk on.
pub(crate) struct Shown<'a> {
    pub outline: &'a mut dyn Outline,
    pub pass: Pass,
}

impl Source for Shown<'_> {
    fn enter(&mut self, field: &'static Field) {
        self.outline.enter(field);
    }
    fn leave(&mut self) {
        self.outline.leave();
    }
    fn element(&mut self, index: usize) {
        self.outline.element(index);
    }
    fn fraction(&mut self, bits: usize) {
        self.outline.fraction(bits);
    }
    fn pass(&mut self, pass: Pass) {
        self.pass = pass;
    }
    fn passing(&self) -> Pass {
        self.pass
    }
    fn word(&mut self, field: &'static Field, shape: Shape, _: i128) -> u64 {
        self.outline.leaf(field, shape);
        0
    }
    fn memory(
        &mut self,
        field: &'static Field,
        label: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        self.outline.memory(field, label, shape.words, shape.width);
        Cells::at(0, shape)
    }
}
