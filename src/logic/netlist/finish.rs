//! What is left to do when a circuit has been run: who owns what, and whether it may.

use super::build::{Builder, PowerOn};
use super::memory::State;
use super::module::{Child, Module, NetlistError, Port, Register, Setting, Value};
use super::nets::{Leaf, Nets};
use super::node::{Id, Node};

impl Builder {
    /// The module, its parameters and what its memories hold at power-on.
    pub(super) fn finish(
        mut self,
        about: &'static str,
        nets: Nets,
        edge: &[Leaf],
        modules: &[Module],
        errors: &mut Vec<NetlistError>,
    ) -> (Module, Vec<Setting>) {
        self.name_instances(nets.instances);
        let owners = self.claim(modules);
        self.drive(edge, errors);
        let settings = self.settings();
        let module = Module {
            name: self.name.to_owned(),
            about,
            nodes: self.nodes,
            signals: self.signals,
            parameters: self
                .parameters
                .into_iter()
                .map(|(parameter, _)| parameter)
                .collect(),
            memories: self.memories,
            assertions: self.assertions,
            instances: self
                .instances
                .into_iter()
                .map(|building| building.child)
                .collect(),
            registers: self.registers,
            nets: nets.leaves,
            net_nodes: nets.nodes,
            owners,
        };
        module.check(modules, errors);
        (module, settings)
    }

    /// Gives every instance the name of its scope: a net of it stands there, or its registers do.
    fn name_instances(&mut self, mut scopes: Vec<(Vec<String>, Option<usize>)>) {
        for (index, building) in self.instances.iter_mut().enumerate() {
            let register = self.registers.get(building.registers.start);
            let around = match register.filter(|_| !building.registers.is_empty()) {
                Some(Register::Signal(signal)) => self.scopes.get(*signal),
                Some(Register::Memory(memory)) => self.memory_scopes.get(*memory),
                None => None,
            };
            let by_net = |(_, instance): &(Vec<String>, Option<usize>)| *instance == Some(index);
            let by_register = |(scopes, instance): &(Vec<String>, Option<usize>)| {
                instance.is_none() && around.is_some_and(|around| around.starts_with(scopes))
            };
            let place = scopes
                .iter()
                .position(by_net)
                .or_else(|| scopes.iter().position(by_register));
            building.child.name = match place {
                Some(place) => scopes.remove(place).0.join("_"),
                None => format!("{}_{index}", building.circuit),
            };
        }
    }

    /// Gives the registers of instances to them.
    fn claim(&mut self, modules: &[Module]) -> Vec<Option<(usize, usize)>> {
        let mut owners = vec![None; self.memories.len()];
        for (instance, building) in self.instances.iter().enumerate() {
            let inside = &modules[building.child.module].registers;
            for (register, inner) in self.registers[building.registers.clone()]
                .iter()
                .zip(inside)
            {
                match (register, inner) {
                    (Register::Signal(signal), Register::Signal(inner)) => {
                        self.signals[*signal].owner = Some((instance, *inner));
                    }
                    (Register::Memory(memory), Register::Memory(inner)) => {
                        self.memories[*memory].inner = true;
                        owners[*memory] = Some((instance, *inner));
                    }
                    _ => {}
                }
            }
        }
        owners
    }

    /// Takes over what the edge makes of each register and memory.
    fn drive(&mut self, edge: &[Leaf], errors: &mut Vec<NetlistError>) {
        for (place, (register, leaf)) in self.registers.iter().zip(edge).enumerate() {
            let owner = self
                .instances
                .iter()
                .find(|building| building.registers.contains(&place));
            let by_instance = match (register, *leaf) {
                (Register::Signal(signal), Leaf::Word(id)) => {
                    let next = self.nodes.get(id).map(|(node, _)| *node);
                    if let Some(Node::Next(made)) = next {
                        made == place
                    } else {
                        self.signals[*signal].driver = Some(id);
                        false
                    }
                }
                (Register::Memory(memory), Leaf::Memory(made, state)) => {
                    let memory = &mut self.memories[*memory];
                    memory.port = match state {
                        State::Before | State::Next => Port::Rom,
                        State::Written(enable, address, data) => Port::Ram {
                            enable,
                            address,
                            data,
                        },
                        State::Shifted(enable, data) => Port::Shift { enable, data },
                    };
                    state == State::Next
                        && self.registers.get(place) == Some(&Register::Memory(made))
                }
                _ => false,
            };
            let owned = owner.is_some();
            if owned != by_instance {
                errors.push(NetlistError::Registers {
                    module: self.name.to_owned(),
                    instance: owner
                        .map(|owner| owner.child.name.clone())
                        .unwrap_or_default(),
                });
            }
        }
    }

    /// Parameters and contents of memories, those of instances under their names.
    fn settings(&mut self) -> Vec<Setting> {
        let mut settings = Vec::new();
        let held = self.registers.iter().zip(&self.power_on);
        let held = held.filter_map(|(register, power_on)| match (register, power_on) {
            (Register::Memory(memory), PowerOn::Words(words)) => Some((*memory, words)),
            _ => None,
        });
        let roms = self.roms.iter().map(|(memory, words)| (*memory, words));
        for (parameter, value) in &self.parameters {
            settings.push(Setting {
                path: vec![parameter.name.to_owned()],
                width: parameter.width,
                value: Value::Number(*value),
            });
        }
        for (memory, words) in held.chain(roms) {
            let memory = &self.memories[memory];
            if !memory.inner {
                settings.push(Setting {
                    path: vec![memory.name.clone()],
                    width: memory.width,
                    value: Value::Words(words.clone()),
                });
            }
        }
        for building in &mut self.instances {
            for mut inner in std::mem::take(&mut building.settings) {
                inner.path.insert(0, building.child.name.clone());
                settings.push(inner);
            }
        }
        settings
    }
}

impl Module {
    /// The nodes that something is driven by: nets, registers, memories, inputs of instances.
    pub fn roots(&self) -> impl Iterator<Item = Id> + '_ {
        let signals = self.signals.iter().filter_map(|signal| signal.driver);
        let memories = self.memories.iter().flat_map(|memory| {
            let ids = match memory.port {
                Port::Rom => [None; 3],
                Port::Ram {
                    enable,
                    address,
                    data,
                } => [Some(enable), Some(address), Some(data)],
                Port::Shift { enable, data } => [Some(enable), Some(data), None],
            };
            ids.into_iter().flatten()
        });
        let inputs = self.instances.iter().flat_map(|child| &child.inputs);
        signals.chain(memories).chain(inputs.copied())
    }

    /// Which nodes are used.
    pub fn live(&self) -> Vec<bool> {
        let mut live = vec![false; self.nodes.len()];
        for root in self.roots() {
            live[root] = true;
        }
        for id in (0..live.len()).rev() {
            if live[id] {
                for operand in self.nodes[id].0.operands() {
                    live[operand] = true;
                }
            }
        }
        live
    }

    /// Looks for reads past the ports of instances.
    fn check(&self, modules: &[Module], errors: &mut Vec<NetlistError>) {
        let not_a_port = |child: &Child, signal: &str| NetlistError::NotAPort {
            module: self.name.clone(),
            instance: child.name.clone(),
            signal: signal.to_owned(),
        };
        let live = self.live();
        for (node, _) in self
            .nodes
            .iter()
            .zip(&live)
            .filter(|(_, live)| **live)
            .map(|(node, _)| node)
        {
            let read = match *node {
                Node::Signal(signal) => self.signals[signal]
                    .owner
                    .map(|(instance, inner)| (instance, Some(inner))),
                Node::Port { instance, leaf } => {
                    let inside = &modules[self.instances[instance].module];
                    Some((instance, inside.nets.get(leaf).copied().flatten()))
                }
                Node::Read(memory, _) if self.memories[memory].inner => Some((0, None)),
                _ => None,
            };
            let Some((instance, inner)) = read else {
                continue;
            };
            let child = &self.instances[instance];
            let signal = inner.map(|inner| &modules[child.module].signals[inner]);
            match signal {
                Some(signal) if signal.is_port() => {}
                Some(signal) => errors.push(not_a_port(child, &signal.name)),
                None => errors.push(not_a_port(child, "a signal or memory further inside")),
            }
        }
    }

    /// The node that leaf `leaf` of the walk over the nets shows.
    pub(crate) fn net_node(&self, leaf: usize) -> Option<Id> {
        self.net_nodes.get(leaf).copied()
    }

    /// How many leaves the walk over the nets has.
    pub(crate) fn net_leaves(&self) -> usize {
        self.net_nodes.len()
    }

    /// The leaves of the walk over the registers; a memory is one.
    pub(crate) fn register_leaves(&self) -> impl Iterator<Item = Register> + '_ {
        self.registers.iter().copied()
    }

    /// The instance that a memory belongs to, and which one it is there.
    pub(crate) fn memory_owner(&self, memory: usize) -> Option<(usize, usize)> {
        self.owners.get(memory).copied().flatten()
    }

    /// The net that leaf `leaf` of the walk over the nets is.
    pub fn net(&self, leaf: usize) -> Option<usize> {
        self.nets.get(leaf).copied().flatten()
    }
}
