use super::Netlist;
use super::build::{Builder, Building, Elaboration, PowerOn, builder, elaboration, in_place};
use super::leaves::{Leaves, NextRegisters, Ports};
use super::memory::State;
use super::module::{Child, Design, Module, NetlistError, Register, Setting, Value};
use super::nets::{Leaf, Nets};
use super::node::Node;
use super::properties::note_properties;
use super::walk::{look, make};
use crate::kernel::{Circuit, Field, Probe, Role, Shape, Words, show};
use std::mem;
use std::ops::Range;

/// The netlist of a circuit and of those inside it, with its power-on values.
///
/// # Errors
/// What a netlist cannot say of the circuit: it looks into a circuit inside it past the ports,
/// replaces that circuit's registers, or uses a memory after its edge.
pub fn elaborate<C: Circuit>(circuit: &C) -> Result<Design, Vec<NetlistError>> {
    let mut whole = Whole::begin();
    show(&circuit.power_on(), Role::Register, &mut whole);
    let (_, settings) = module(circuit, mem::take(&mut whole.power_on));
    whole.end(settings)
}

/// The elaboration of a whole circuit.
pub(super) struct Whole {
    /// A thread may be in the middle of another one.
    outer: Elaboration,
    power_on: Vec<PowerOn>,
}

impl Whole {
    pub(super) fn begin() -> Self {
        Whole {
            outer: elaboration(mem::take),
            power_on: Vec::new(),
        }
    }

    pub(super) fn end(self, mut settings: Vec<Setting>) -> Result<Design, Vec<NetlistError>> {
        let made = elaboration(|elaboration| mem::replace(elaboration, self.outer));
        settings.retain(|setting| match setting.value {
            Value::Number(_) => true,
            Value::Words(_) => is_filled(&made.modules, &setting.path),
        });
        match made.errors.is_empty() {
            true => Ok(Design {
                modules: made.modules,
                settings,
            }),
            false => Err(made.errors),
        }
    }
}

/// Collects power-on values.
impl Probe for Whole {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.power_on.push(PowerOn::Bits(bits));
    }
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let words = (0..words.len()).map(|index| words.word(index));
        self.power_on.push(PowerOn::Words(words.collect()));
    }
}

/// Makes the module of a circuit; returns its number and its settings.
fn module<C: Circuit>(circuit: &C, power_on: Vec<PowerOn>) -> (usize, Vec<Setting>) {
    begin(C::NAME, power_on);
    let i: C::In<Netlist> = make(Role::Input, &mut Leaves::default());
    let q: C::Reg<Netlist> = make(Role::Register, &mut Leaves::default());
    let w = circuit.comb::<Netlist>(&q, &i);
    let mut nets = Nets::default();
    look(&w, Role::Net, &mut nets);
    let next = circuit.next::<Netlist>(q.clone(), &w, &i);
    note_properties(circuit, &i, &q, &w);
    let mut edge = Vec::new();
    look(&next, Role::Register, &mut edge);
    end(C::ABOUT, nets, edge)
}

/// A module begins, inside the one that is being made.
pub(super) fn begin(name: &'static str, power_on: Vec<PowerOn>) {
    elaboration(|elaboration| {
        elaboration.open.push(Builder {
            name,
            power_on,
            ..Builder::default()
        });
    });
}

/// It ends; returns its number and its settings.
pub(super) fn end(about: &'static str, nets: Nets, edge: Vec<Leaf>) -> (usize, Vec<Setting>) {
    elaboration(|elaboration| {
        let builder = elaboration.open.pop().unwrap_or_default();
        let (module, settings) = builder.finish(
            about,
            nets,
            &edge,
            &elaboration.modules,
            &mut elaboration.errors,
        );
        (enter(module, &mut elaboration.modules), settings)
    })
}

/// Whether a memory has contents, in this instance of its module or in another.
fn is_filled(modules: &[Module], path: &[String]) -> bool {
    let mut module = modules.last();
    let Some((name, instances)) = path.split_last() else {
        return false;
    };
    for instance in instances {
        let child = module.and_then(|module| {
            module
                .instances
                .iter()
                .find(|child| child.name == *instance)
        });
        module = child.and_then(|child| modules.get(child.module));
    }
    module.is_some_and(|module| {
        let mut own = module.memories.iter().filter(|memory| !memory.inner);
        own.any(|memory| memory.name == *name && memory.filled)
    })
}

/// Adds a module, unless the same is there; another of the same circuit gets a number.
fn enter(mut module: Module, modules: &mut Vec<Module>) -> usize {
    let circuit = module.name.clone();
    let filled: Vec<bool> = module.memories.iter().map(|memory| memory.filled).collect();
    let mut number = 1;
    for (index, other) in modules.iter_mut().enumerate() {
        module.name.clone_from(&other.name);
        for (memory, other) in module.memories.iter_mut().zip(&other.memories) {
            memory.filled = other.filled;
        }
        if module == *other {
            for (other, filled) in other.memories.iter_mut().zip(filled) {
                other.filled |= filled;
            }
            return index;
        }
        let numbered = other.name.strip_prefix(&circuit);
        if numbered.is_some_and(|rest| rest.is_empty() || rest == format!("_{number}")) {
            number += 1;
        }
    }
    for (memory, filled) in module.memories.iter_mut().zip(filled) {
        memory.filled = filled;
    }
    module.name = match number {
        1 => circuit,
        _ => format!("{circuit}_{number}"),
    };
    modules.push(module);
    modules.len() - 1
}

/// The nets of a circuit inside the one that is being made.
pub(super) fn settle<C: Circuit>(
    circuit: &C,
    q: &C::Reg<Netlist>,
    i: &C::In<Netlist>,
) -> C::Net<Netlist> {
    if in_place() {
        return circuit.comb(q, i);
    }
    let (mut registers, mut inputs) = (Vec::new(), Vec::new());
    look(q, Role::Register, &mut registers);
    look(i, Role::Input, &mut inputs);
    let registers = places(registers);
    let made = module(circuit, power_on(registers.clone()));
    let instance = instance(C::NAME, registers, inputs, made);
    make(Role::Net, &mut Ports { instance, leaf: 0 })
}

/// What registers of the module that is being made hold at power-on.
fn power_on(registers: Range<usize>) -> Vec<PowerOn> {
    builder(|builder| {
        let values = builder.power_on.get(registers);
        values.unwrap_or_default().to_vec()
    })
}

/// Adds an instance to the module that is being made; returns its number.
fn instance(
    circuit: &'static str,
    registers: Range<usize>,
    inputs: Vec<Leaf>,
    (module, settings): (usize, Vec<Setting>),
) -> usize {
    let inputs = inputs.into_iter().filter_map(|leaf| match leaf {
        Leaf::Word(id) => Some(id),
        Leaf::Memory(..) => None,
    });
    builder(|builder| {
        builder.instances.push(Building {
            child: Child {
                name: String::new(),
                module,
                inputs: inputs.collect(),
            },
            circuit,
            registers,
            settings,
        });
        builder.instances.len() - 1
    })
}

/// What a circuit inside the one that is being made makes of its registers.
pub(super) fn clock<C: Circuit>(
    circuit: &C,
    q: C::Reg<Netlist>,
    w: &C::Net<Netlist>,
    i: &C::In<Netlist>,
) -> C::Reg<Netlist> {
    if in_place() {
        return circuit.next(q, w, i);
    }
    let mut registers = Vec::new();
    look(&q, Role::Register, &mut registers);
    let place = places(registers).start;
    make(Role::Register, &mut NextRegisters { place })
}

/// Where the registers of a circuit stand among those of the one being made; none where they are
/// not its registers in their order.
fn places(leaves: Vec<Leaf>) -> Range<usize> {
    builder(|builder| {
        let wanted: Vec<Option<Register>> = leaves
            .into_iter()
            .map(|leaf| match leaf {
                Leaf::Word(id) => match builder.nodes.get(id) {
                    Some((Node::Signal(signal), _)) => Some(Register::Signal(*signal)),
                    _ => None,
                },
                Leaf::Memory(memory, State::Before) => Some(Register::Memory(memory)),
                Leaf::Memory(..) => None,
            })
            .collect();
        let start = builder
            .registers
            .iter()
            .position(|register| wanted.first() == Some(&Some(*register)))
            .unwrap_or(builder.registers.len());
        let end = start + wanted.len();
        let there = builder.registers.get(start..end).is_some_and(|registers| {
            let registers = registers.iter().map(|register| Some(*register));
            registers.eq(wanted)
        });
        if there { start..end } else { start..start }
    })
}
