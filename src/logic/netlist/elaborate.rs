use super::Netlist;
use super::build::{Builder, Building, PowerOn, builder, elaboration, flat, signal};
use super::memory::{NetRam, NetShiftRegister, State};
use super::module::{Child, Design, Memory, Module, NetlistError, Port, Register, Setting, Value};
use super::node::{Id, Node};
use super::properties::note_properties;
use super::words::{NetBit, NetInt, NetUInt, Word};
use crate::kernel::{Circuit, Field, Make, Path, Probe, Role, Shape, Signals, Visit, Words};
use std::mem;

/// The netlist of a circuit and of those inside it, with its power-on values.
///
/// # Errors
/// What a netlist cannot say of the circuit: it looks into a circuit inside it past the ports,
/// replaces that circuit's registers, or uses a memory after its edge.
pub fn elaborate<C: Circuit>(circuit: &C) -> Result<Design, Vec<NetlistError>> {
    // A thread may be in the middle of another one.
    let outer = elaboration(mem::take);
    let mut values = PowerOnValues(Vec::new());
    circuit
        .power_on()
        .visit(const { &Field::part(Role::Register) }, &mut values);
    let (_, mut settings) = module(circuit, values.0);
    let made = elaboration(|elaboration| mem::replace(elaboration, outer));
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

/// Makes the module of a circuit; returns its number and its settings.
fn module<C: Circuit>(circuit: &C, power_on: Vec<PowerOn>) -> (usize, Vec<Setting>) {
    elaboration(|elaboration| {
        elaboration.open.push(Builder {
            name: C::NAME,
            power_on,
            ..Builder::default()
        });
    });
    let i = C::In::<Netlist>::make(const { &Field::part(Role::Input) }, &mut Leaves::default());
    let q = C::Reg::<Netlist>::make(
        const { &Field::part(Role::Register) },
        &mut Leaves::default(),
    );
    let w = circuit.comb::<Netlist>(&q, &i);
    let mut nets = Nets::default();
    w.visit(const { &Field::part(Role::Net) }, &mut nets);
    let next = circuit.next::<Netlist>(q.clone(), &w, &i);
    note_properties(circuit, &i, &q, &w);
    let mut edge = Edge(Vec::new());
    next.visit(const { &Field::part(Role::Register) }, &mut edge);
    elaboration(|elaboration| {
        let builder = elaboration.open.pop().unwrap_or_default();
        let (module, settings) = builder.finish(
            C::ABOUT,
            nets,
            edge.0,
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
    let registers = places::<C>(q);
    let mut inputs = Edge(Vec::new());
    i.visit(const { &Field::part(Role::Input) }, &mut inputs);
    let inputs = inputs.0.into_iter().filter_map(|leaf| match leaf {
        Leaf::Word(id) => Some(id),
        Leaf::Memory(..) => None,
    });
    let power_on = builder(|builder| {
        let values = builder.power_on.get(registers.clone());
        values.unwrap_or_default().to_vec()
    });
    let (module, settings) = module(circuit, power_on);
    let instance = builder(|builder| {
        builder.instances.push(Building {
            child: Child {
                name: String::new(),
                module,
                inputs: inputs.collect(),
            },
            circuit: C::NAME,
            registers,
            settings,
        });
        builder.instances.len() - 1
    });
    let mut ports = Ports { instance, leaf: 0 };
    C::Net::make(const { &Field::part(Role::Net) }, &mut ports)
}

/// What a circuit inside the one that is being made makes of its registers.
pub(super) fn clock<C: Circuit>(q: C::Reg<Netlist>) -> C::Reg<Netlist> {
    let mut next = NextRegisters {
        place: places::<C>(&q).start,
    };
    C::Reg::make(const { &Field::part(Role::Register) }, &mut next)
}

/// Where the registers of a circuit stand among those of the one being made; none where they are
/// not its registers in their order.
fn places<C: Circuit>(q: &C::Reg<Netlist>) -> std::ops::Range<usize> {
    let mut leaves = Edge(Vec::new());
    q.visit(const { &Field::part(Role::Register) }, &mut leaves);
    builder(|builder| {
        let wanted: Vec<Option<Register>> = leaves
            .0
            .iter()
            .map(|leaf| match *leaf {
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

/// Collects power-on values.
struct PowerOnValues(Vec<PowerOn>);

impl Probe for PowerOnValues {
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        self.0.push(PowerOn::Bits(bits));
    }
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let words = (0..words.len()).map(|index| words.word(index));
        self.0.push(PowerOn::Words(words.collect()));
    }
}

/// Makes inputs and registers.
#[derive(Default)]
struct Leaves {
    path: Path,
}

impl Leaves {
    fn word<W: Word>(&mut self, field: &'static Field) -> W {
        let name = self.path.name(field);
        let scopes = self.path.scopes().to_vec();
        let role = self.path.role();
        builder(|builder| {
            let mut signal = signal(flat(&scopes, &name), field, W::SHAPE);
            signal.role = role;
            if role == Role::Register {
                if let Some(PowerOn::Bits(bits)) = builder.power_on.get(builder.registers.len()) {
                    signal.power_on = *bits;
                }
                let register = Register::Signal(builder.signals.len());
                builder.registers.push(register);
            }
            let signal = builder.signal(signal, scopes);
            W::of(builder.node(Node::Signal(signal), W::SHAPE))
        })
    }

    fn memory(&mut self, field: &'static Field, words: usize, width: usize) -> usize {
        let name = self.path.name(field);
        let scopes = self.path.scopes().to_vec();
        builder(|builder| {
            let filled = match builder.power_on.get(builder.registers.len()) {
                Some(PowerOn::Words(words)) => words.iter().any(|word| *word != 0),
                _ => false,
            };
            builder.memories.push(Memory {
                name: flat(&scopes, &name),
                doc: field.doc,
                words,
                width,
                port: Port::Rom,
                filled,
                inner: false,
            });
            builder.memory_scopes.push(scopes);
            let memory = builder.memories.len() - 1;
            builder.registers.push(Register::Memory(memory));
            memory
        })
    }
}

impl Make<Netlist> for Leaves {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn bit(&mut self, field: &'static Field) -> NetBit {
        self.word(field)
    }
    fn unsigned<const N: usize>(&mut self, field: &'static Field) -> NetUInt<N> {
        self.word(field)
    }
    fn signed<const N: usize>(&mut self, field: &'static Field) -> NetInt<N> {
        self.word(field)
    }
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field) -> NetRam<A, D> {
        NetRam {
            memory: self.memory(field, 1 << A, D),
            state: State::Before,
        }
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
    ) -> NetShiftRegister<K, D> {
        NetShiftRegister {
            memory: self.memory(field, K, D),
            state: State::Before,
        }
    }
}

/// Makes the nets of an instance.
struct Ports {
    instance: usize,
    leaf: usize,
}

/// Makes the registers of an instance after the edge.
struct NextRegisters {
    place: usize,
}

/// A maker of words that are all nodes of one kind, and of memories after their edge.
macro_rules! make_leaves {
    ($maker:ty, $node:expr, $memory:expr) => {
        impl Make<Netlist> for $maker {
            fn enter(&mut self, _: &'static Field) {}
            fn leave(&mut self) {}
            fn element(&mut self, _: usize) {}
            fn bit(&mut self, _: &'static Field) -> NetBit {
                $node(self)
            }
            fn unsigned<const N: usize>(&mut self, _: &'static Field) -> NetUInt<N> {
                $node(self)
            }
            fn signed<const N: usize>(&mut self, _: &'static Field) -> NetInt<N> {
                $node(self)
            }
            fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field) -> NetRam<A, D> {
                let (memory, state) = $memory(self);
                NetRam { memory, state }
            }
            fn shift_register<const K: usize, const D: usize>(
                &mut self,
                _: &'static Field,
            ) -> NetShiftRegister<K, D> {
                let (memory, state) = $memory(self);
                NetShiftRegister { memory, state }
            }
        }
    };
}

pub(super) use make_leaves;

make_leaves!(Ports, Ports::next, |_: &mut Ports| (0, State::Next));
make_leaves!(NextRegisters, NextRegisters::next, NextRegisters::memory);

impl Ports {
    fn next<W: Word>(&mut self) -> W {
        let node = Node::Port {
            instance: self.instance,
            leaf: self.leaf,
        };
        self.leaf += 1;
        W::of(super::build::node(node, W::SHAPE))
    }
}

impl NextRegisters {
    fn next<W: Word>(&mut self) -> W {
        self.place += 1;
        W::of(super::build::node(Node::Next(self.place - 1), W::SHAPE))
    }

    fn memory(&mut self) -> (usize, State) {
        self.place += 1;
        let place = self.place - 1;
        let memory = builder(|builder| match builder.registers.get(place) {
            Some(Register::Memory(memory)) => *memory,
            _ => usize::MAX,
        });
        (memory, State::Next)
    }
}

/// A leaf after the edge, or of the inputs of an instance.
#[derive(Debug, Clone, Copy)]
pub(super) enum Leaf {
    Word(Id),
    Memory(usize, State),
}

/// Collects leaves.
pub(super) struct Edge(pub(super) Vec<Leaf>);

impl Visit<Netlist> for Edge {
    fn enter(&mut self, _: &'static Field) {}
    fn leave(&mut self) {}
    fn element(&mut self, _: usize) {}
    fn bit(&mut self, _: &'static Field, value: NetBit) {
        self.0.push(Leaf::Word(value.id()));
    }
    fn unsigned<const N: usize>(&mut self, _: &'static Field, value: NetUInt<N>) {
        self.0.push(Leaf::Word(value.id()));
    }
    fn signed<const N: usize>(&mut self, _: &'static Field, value: NetInt<N>) {
        self.0.push(Leaf::Word(value.id()));
    }
    fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field, ram: &NetRam<A, D>) {
        self.0.push(Leaf::Memory(ram.memory, ram.state));
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        _: &'static Field,
        register: &NetShiftRegister<K, D>,
    ) {
        self.0.push(Leaf::Memory(register.memory, register.state));
    }
}

/// Collects nets: makes signals of a circuit's own ones, finds the names of its instances.
#[derive(Default)]
pub(super) struct Nets {
    path: Path,
    /// How many structs have been entered, and at which one each nested part begins.
    depth: usize,
    parts: Vec<(usize, Role)>,
    /// How many leaves there were when each struct that is open was entered.
    entered: Vec<usize>,
    /// The signal of each leaf, if it is not one of an instance.
    pub(super) leaves: Vec<Option<usize>>,
    /// The scopes that are instances, with the instance where a net tells it.
    pub(super) instances: Vec<(Vec<String>, Option<usize>)>,
}

impl Nets {
    fn word<W: Word>(&mut self, field: &'static Field, value: W) {
        let name = self.path.name(field);
        if let Some((_, role)) = self.parts.first() {
            self.leaves.push(None);
            let node = builder(|builder| builder.nodes.get(value.id()).map(|(node, _)| *node));
            let (Role::Net, Some(Node::Port { instance, .. })) = (role, node) else {
                return;
            };
            if let Some((_, known)) = self.instances.last_mut() {
                *known = Some(instance);
            }
            return;
        }
        let scopes = self.path.scopes().to_vec();
        let mut signal = signal(flat(&scopes, &name), field, W::SHAPE);
        signal.driver = Some(value.id());
        let signal = builder(|builder| builder.signal(signal, scopes));
        self.leaves.push(Some(signal));
    }
}

impl Visit<Netlist> for Nets {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
        self.depth += 1;
        self.entered.push(self.leaves.len());
        let Some(role) = field.role.filter(|_| self.depth > 1) else {
            return;
        };
        if self.parts.is_empty() {
            let scopes = self.path.scopes();
            if self.instances.last().is_none_or(|(last, _)| last != scopes) {
                self.instances.push((scopes.to_vec(), None));
            }
        }
        self.parts.push((self.depth, role));
    }
    fn leave(&mut self) {
        let scopes = self.path.scopes();
        let empty = self.entered.pop() == Some(self.leaves.len()) && self.parts.is_empty();
        // An instance without inputs and nets.
        if empty
            && !scopes.is_empty()
            && self.instances.last().is_none_or(|(last, _)| last != scopes)
        {
            self.instances.push((scopes.to_vec(), None));
        }
        self.path.leave();
        if self
            .parts
            .last()
            .is_some_and(|(depth, _)| *depth == self.depth)
        {
            self.parts.pop();
        }
        self.depth -= 1;
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn bit(&mut self, field: &'static Field, value: NetBit) {
        self.word(field, value);
    }
    fn unsigned<const N: usize>(&mut self, field: &'static Field, value: NetUInt<N>) {
        self.word(field, value);
    }
    fn signed<const N: usize>(&mut self, field: &'static Field, value: NetInt<N>) {
        self.word(field, value);
    }
    fn ram<const A: usize, const D: usize>(&mut self, _: &'static Field, _: &NetRam<A, D>) {
        self.leaves.push(None);
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        _: &'static Field,
        _: &NetShiftRegister<K, D>,
    ) {
        self.leaves.push(None);
    }
}
