//! Flattening: turns a design of modules into one netlist.

mod leaves;
mod operation;
mod stated;

use super::flat::{EngineError, Flat, Id, Instance, Memory, Node, Op, Port, Register, mask};
use crate::netlist::{self, Design, Module, Role, Value};
use operation::operation;
pub(crate) use stated::Statement;
use std::collections::HashMap;

impl Flat {
    /// Flattens a design.
    ///
    /// # Errors
    /// Returns an error if the design is not one that [`elaborate`](crate::hdl::elaborate())
    /// makes: a node or an instance depends on itself, a word has no bits or more than 64, a
    /// register or net has no driver.
    pub fn of(design: &Design) -> Result<Flat, EngineError> {
        let mut flattening = Flattening::of(design)?;
        let assertions: Vec<_> = flattening.parts[0].module.assertions.iter().collect();
        flattening.flat.properties = flattening.stated(0, &assertions)?;
        flattening.leaves(0)?;
        Ok(flattening.flat)
    }
}

struct Flattening<'d> {
    design: &'d Design,
    /// Values of parameters and contents of memories, by path.
    numbers: HashMap<&'d [String], u64>,
    words: HashMap<&'d [String], &'d [u64]>,
    flat: Flat,
    /// Instances; the outermost is first.
    parts: Vec<Part<'d>>,
}

/// Instance under construction.
struct Part<'d> {
    module: &'d Module,
    instance: u32,
    /// Its own registers and memories, by signal and memory index; those of inner instances are
    /// absent.
    registers: Vec<Option<u32>>,
    memories: Vec<Option<u32>>,
    children: Vec<usize>,
    /// Drivers of its input ports, in order.
    inputs: Vec<Id>,
    /// Nodes made so far.
    map: Vec<Id>,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Waiting,
    Settling,
    Settled,
}

fn circle(module: &Module, node: netlist::Id) -> EngineError {
    EngineError::Circle {
        module: module.name.clone(),
        node,
    }
}

fn unsettled(module: &Module, what: &str) -> EngineError {
    EngineError::Unsettled {
        module: module.name.clone(),
        what: what.to_owned(),
    }
}

fn width(module: &Module, what: impl Into<String>, width: usize) -> Result<u8, EngineError> {
    match u8::try_from(width) {
        Ok(bits @ 1..=64) => Ok(bits),
        _ => Err(EngineError::Width {
            module: module.name.clone(),
            what: what.into(),
            width,
        }),
    }
}

impl<'d> Flattening<'d> {
    /// Makes all nodes but those of properties.
    fn of(design: &'d Design) -> Result<Self, EngineError> {
        let top = design
            .modules
            .len()
            .checked_sub(1)
            .ok_or(EngineError::Empty)?;
        let mut flattening = Flattening {
            design,
            numbers: HashMap::new(),
            words: HashMap::new(),
            flat: Flat::default(),
            parts: Vec::new(),
        };
        for setting in &design.settings {
            match &setting.value {
                Value::Number(number) => {
                    flattening.numbers.insert(&setting.path, *number).is_some()
                }
                Value::Words(words) => flattening.words.insert(&setting.path, words).is_some(),
            };
        }
        let whole = flattening.allocate(top, Vec::new())?;
        let inputs = flattening.ports();
        flattening.parts[whole].inputs = inputs;
        flattening.settle(whole)?;
        Ok(flattening)
    }

    /// Allocates registers and memories of a module and of all modules inside it.
    fn allocate(&mut self, module: usize, path: Vec<String>) -> Result<usize, EngineError> {
        let module = self.design.modules.get(module).ok_or(EngineError::Empty)?;
        let instance = self.flat.instances.len() as u32;
        self.flat.instances.push(Instance {
            path: path.clone(),
            circuit: module.name.clone(),
        });
        let mut part = Part {
            module,
            instance,
            registers: vec![None; module.signals.len()],
            memories: vec![None; module.memories.len()],
            children: Vec::new(),
            inputs: Vec::new(),
            map: Vec::new(),
            state: State::Waiting,
        };
        for (index, signal) in module.signals.iter().enumerate() {
            let width = width(module, &signal.name, signal.shape.width)?;
            if signal.role == Role::Register && signal.owner.is_none() {
                part.registers[index] = Some(self.flat.registers.len() as u32);
                self.flat.registers.push(Register {
                    width,
                    power_on: signal.power_on & mask(width),
                    next: 0,
                    instance,
                });
            }
        }
        for (index, memory) in module.memories.iter().enumerate() {
            let width = width(module, &memory.name, memory.width)?;
            if !memory.inner {
                let mut place = path.clone();
                place.push(memory.name.clone());
                let given = self.words.get(&place[..]).copied().unwrap_or(&[]);
                let mut contents: Vec<u64> = given
                    .iter()
                    .take(memory.words)
                    .map(|word| word & mask(width))
                    .collect();
                contents.resize(memory.words, 0);
                part.memories[index] = Some(self.flat.memories.len() as u32);
                self.flat.memories.push(Memory {
                    width,
                    contents,
                    port: Port::Rom,
                    instance,
                });
            }
        }
        let place = self.parts.len();
        self.parts.push(part);
        for child in &module.instances {
            let mut path = path.clone();
            path.push(child.name.clone());
            let child = self.allocate(child.module, path)?;
            self.parts[place].children.push(child);
        }
        Ok(place)
    }

    fn add(&mut self, part: usize, op: Op, width: u8) -> Id {
        let instance = self.parts[part].instance;
        self.flat.nodes.push(Node {
            op,
            width,
            instance,
        });
        self.flat.nodes.len() as Id - 1
    }

    /// Returns the input ports of the outermost circuit.
    fn ports(&mut self) -> Vec<Id> {
        let module = self.parts[0].module;
        let inputs = module
            .signals
            .iter()
            .filter(|signal| signal.role == Role::Input && signal.owner.is_none());
        inputs
            .map(|signal| {
                // Already checked with the registers.
                let width = signal.shape.width as u8;
                self.flat.inputs.push(width);
                self.add(0, Op::Input(self.flat.inputs.len() as u32 - 1), width)
            })
            .collect()
    }

    /// Returns the register of a signal of a part, or of an instance inside it.
    fn register(&self, mut part: usize, mut signal: usize) -> Option<u32> {
        loop {
            let here = &self.parts[part];
            match here.module.signals.get(signal)?.owner {
                None => return here.registers[signal],
                Some((instance, inner)) => {
                    part = *here.children.get(instance)?;
                    signal = inner;
                }
            }
        }
    }

    /// Makes the nodes of a part whose input ports are known.
    fn settle(&mut self, part: usize) -> Result<(), EngineError> {
        let module = self.parts[part].module;
        self.parts[part].state = State::Settling;
        let ports = self.input_ports(part);
        for index in 0..module.logic.min(module.nodes.len()) {
            let id = self.node(part, index, &ports)?;
            self.parts[part].map.push(id);
        }
        for child in 0..module.instances.len() {
            self.child(part, child)?;
        }
        self.drive(part)?;
        self.parts[part].state = State::Settled;
        Ok(())
    }

    /// Returns the input ports of a part, by signal index.
    fn input_ports(&self, part: usize) -> Vec<usize> {
        let signals = self.parts[part].module.signals.iter().enumerate();
        let ports =
            signals.filter(|(_, signal)| signal.role == Role::Input && signal.owner.is_none());
        ports.map(|(index, _)| index).collect()
    }

    /// Settles an inner instance unless it is settled.
    fn child(&mut self, part: usize, child: usize) -> Result<usize, EngineError> {
        let module = self.parts[part].module;
        let missing = || unsettled(module, &format!("part {child}"));
        let place = *self.parts[part].children.get(child).ok_or_else(missing)?;
        match self.parts[place].state {
            State::Settled => return Ok(place),
            State::Settling => {
                return Err(circle(module, self.parts[part].map.len()));
            }
            State::Waiting => {}
        }
        let inputs = module.instances[child].inputs.iter();
        let inputs: Result<Vec<Id>, _> = inputs.map(|&id| self.made(part, id)).collect();
        self.parts[place].inputs = inputs?;
        self.settle(place)?;
        Ok(place)
    }

    /// Returns the flat node of a part's node.
    fn made(&self, part: usize, id: netlist::Id) -> Result<Id, EngineError> {
        let part = &self.parts[part];
        part.map
            .get(id)
            .copied()
            .ok_or_else(|| circle(part.module, id))
    }

    fn node(&mut self, part: usize, index: usize, ports: &[usize]) -> Result<Id, EngineError> {
        use netlist::Node;
        let module = self.parts[part].module;
        let (node, shape) = module.nodes[index];
        let width = width(module, format!("node {index}"), shape.width)?;
        let of = |id| self.made(part, id);
        let op = match node {
            Node::Constant(bits) => Op::Constant(bits & mask(width)),
            Node::Parameter(parameter) => {
                let missing = || unsettled(module, &format!("parameter {parameter}"));
                let parameter = module.parameters.get(parameter).ok_or_else(missing)?;
                let mut path = self.flat.instances[self.parts[part].instance as usize]
                    .path
                    .clone();
                path.push(parameter.name.to_owned());
                let number = self.numbers.get(&path[..]);
                let number = number.ok_or_else(|| unsettled(module, parameter.name))?;
                Op::Constant(number & mask(width))
            }
            Node::Signal(signal) => {
                if let Some(port) = ports.iter().position(|&port| port == signal) {
                    let inputs = &self.parts[part].inputs;
                    let name = || unsettled(module, &module.signals[signal].name);
                    return inputs.get(port).copied().ok_or_else(name);
                }
                let missing = || unsettled(module, &format!("signal {signal}"));
                Op::Register(self.register(part, signal).ok_or_else(missing)?)
            }
            Node::Port { instance, leaf } => {
                let child = self.child(part, instance)?;
                return self.net(child, leaf);
            }
            // Used in properties only, which are made separately.
            Node::Past(a) => return of(a),
            Node::Read(memory, a) => {
                let missing = || unsettled(module, &format!("memory {memory}"));
                let memory = self.parts[part].memories.get(memory).copied().flatten();
                Op::Read(memory.ok_or_else(missing)?, of(a)?)
            }
            node => {
                let before = |id: netlist::Id| module.nodes[id].1;
                operation(node, shape, before, of)?
            }
        };
        Ok(self.add_unless_same(part, op, width))
    }

    /// Adds an operation; one that changes no bit is the operand itself.
    fn add_unless_same(&mut self, part: usize, op: Op, width: u8) -> Id {
        match op {
            Op::Slice(a, 0) | Op::Extend(a) | Op::ExtendSigned(a)
                if self.flat.node(a).width == width =>
            {
                a
            }
            op => self.add(part, op, width),
        }
    }

    /// Returns the node of a leaf of the walk over the nets of a settled part.
    fn net(&self, part: usize, leaf: usize) -> Result<Id, EngineError> {
        let module = self.parts[part].module;
        let node = module.net_node(leaf);
        self.made(
            part,
            node.ok_or_else(|| unsettled(module, &format!("net {leaf}")))?,
        )
    }

    /// Connects registers and memories of a settled part to their values after the edge.
    fn drive(&mut self, part: usize) -> Result<(), EngineError> {
        let module = self.parts[part].module;
        for (index, signal) in module.signals.iter().enumerate() {
            let driver = match (signal.role, signal.owner) {
                (Role::Input, _) | (_, Some(_)) => continue,
                _ => signal
                    .driver
                    .ok_or_else(|| unsettled(module, &signal.name))?,
            };
            let driver = self.made(part, driver)?;
            if let Some(register) = self.parts[part].registers[index] {
                self.flat.registers[register as usize].next = driver;
            }
        }
        for (index, memory) in module.memories.iter().enumerate() {
            let Some(place) = self.parts[part].memories[index] else {
                continue;
            };
            let of = |id| self.made(part, id);
            let port = match memory.port {
                netlist::Port::Rom => Port::Rom,
                netlist::Port::Ram {
                    enable,
                    address,
                    data,
                } => Port::Ram {
                    enable: of(enable)?,
                    address: of(address)?,
                    data: of(data)?,
                },
                netlist::Port::Shift { enable, data } => Port::Shift {
                    enable: of(enable)?,
                    data: of(data)?,
                },
            };
            self.flat.memories[place as usize].port = port;
        }
        Ok(())
    }

    /// Returns the memory of a part, or of an instance inside it; inner memories come in the order
    /// of the registers.
    fn memory(&self, part: usize, memory: usize) -> Option<u32> {
        let here = &self.parts[part];
        match here.memories.get(memory).copied().flatten() {
            Some(memory) => Some(memory),
            None => {
                let (instance, inner) = here.module.memory_owner(memory)?;
                self.memory(*here.children.get(instance)?, inner)
            }
        }
    }
}
