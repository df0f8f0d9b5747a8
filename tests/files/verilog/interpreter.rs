//! A netlist, run node by node.

use motion_rtl::netlist::{Design, Id, Kind, Module, Node, Operator, Port, Role, Shape, Value};

/// A module and those inside it, with their state and the values of the tick.
pub struct Instance<'d> {
    module: &'d Module,
    parameters: Vec<u64>,
    registers: Vec<u64>,
    memories: Vec<Vec<u64>>,
    children: Vec<Instance<'d>>,
    inputs: Vec<u64>,
    nodes: Vec<u64>,
}

fn mask(value: u64, shape: Shape) -> u64 {
    value & (u64::MAX >> (64 - shape.width))
}

fn signed(value: u64, shape: Shape) -> i64 {
    let spare = 64 - shape.width;
    (value << spare) as i64 >> spare
}

impl<'d> Instance<'d> {
    /// The circuit at power-on.
    pub fn new(design: &'d Design) -> Self {
        Self::within(design, design.modules.len() - 1, &[])
    }

    fn within(design: &'d Design, module: usize, around: &[String]) -> Self {
        let module = &design.modules[module];
        let inside = |name: &str| -> Vec<String> {
            let around = around.iter().cloned();
            around.chain([name.to_owned()]).collect()
        };
        let setting = |name: &str| {
            let path = inside(name);
            let setting = design.settings.iter().find(|setting| setting.path == path);
            setting.map(|setting| &setting.value)
        };
        let parameters = module.parameters.iter();
        let memories = module.memories.iter();
        let children = module.instances.iter();
        Instance {
            module,
            parameters: parameters
                .map(|parameter| match setting(parameter.name) {
                    Some(Value::Number(value)) => *value,
                    other => panic!("{}: {other:?}", parameter.name),
                })
                .collect(),
            registers: module
                .signals
                .iter()
                .map(|signal| signal.power_on)
                .collect(),
            memories: memories
                .map(|memory| match setting(&memory.name) {
                    Some(Value::Words(words)) => words.clone(),
                    _ => vec![0; memory.words],
                })
                .collect(),
            children: children
                .map(|child| Self::within(design, child.module, &inside(&child.name)))
                .collect(),
            inputs: Vec::new(),
            nodes: Vec::new(),
        }
    }

    /// Settles all nets.
    pub fn settle(&mut self, inputs: Vec<u64>) {
        self.inputs = inputs;
        self.nodes.clear();
        let mut settled = vec![false; self.children.len()];
        for id in 0..self.module.nodes.len() {
            if let Node::Port { instance, .. } = self.module.nodes[id].0 {
                self.settle_child(instance, &mut settled);
            }
            let value = self.compute(id);
            self.nodes.push(mask(value, self.module.nodes[id].1));
        }
        for instance in 0..settled.len() {
            self.settle_child(instance, &mut settled);
        }
    }

    fn settle_child(&mut self, instance: usize, settled: &mut [bool]) {
        if !std::mem::replace(&mut settled[instance], true) {
            let drivers = &self.module.instances[instance].inputs;
            let inputs = drivers.iter().map(|id| self.nodes[*id]).collect();
            self.children[instance].settle(inputs);
        }
    }

    fn compute(&self, id: Id) -> u64 {
        let (node, _) = self.module.nodes[id];
        let value = |id: Id| self.nodes[id];
        let shape = |id: Id| self.module.nodes[id].1;
        let extended = |id: Id| match shape(id).kind {
            Kind::Signed => signed(value(id), shape(id)) as u64,
            _ => value(id),
        };
        match node {
            Node::Constant(bits) => bits,
            Node::Parameter(index) => self.parameters[index],
            Node::Signal(index) => self.signal(index),
            Node::Port { instance, leaf } => {
                let child = &self.children[instance];
                child.module.net(leaf).map_or(0, |net| child.signal(net))
            }
            // In assertions alone, which formal tools look at.
            Node::Past(_) => 0,
            Node::Not(a) => !value(a),
            Node::Negate(a) => value(a).wrapping_neg(),
            Node::Binary(operator, a, b) => {
                assert_eq!(shape(a), shape(b), "{node:?}");
                match operator {
                    Operator::Add => value(a).wrapping_add(value(b)),
                    Operator::Subtract => value(a).wrapping_sub(value(b)),
                    Operator::Multiply => value(a).wrapping_mul(value(b)),
                    Operator::And => value(a) & value(b),
                    Operator::Or => value(a) | value(b),
                    Operator::Xor => value(a) ^ value(b),
                    Operator::Equal => u64::from(value(a) == value(b)),
                    Operator::Below => u64::from(match shape(a).kind {
                        Kind::Signed => signed(value(a), shape(a)) < signed(value(b), shape(b)),
                        _ => value(a) < value(b),
                    }),
                }
            }
            Node::Mux(choose, then, other) => value(if value(choose) == 1 { then } else { other }),
            Node::ShiftLeft(a, by) => value(a) << by,
            Node::ShiftRight(a, by) => match shape(a).kind {
                Kind::Signed => (signed(value(a), shape(a)) >> by) as u64,
                _ => value(a) >> by,
            },
            Node::Slice(a, low) => value(a) >> low,
            Node::Extend(a) => extended(a),
            Node::Join(a, b) => value(a) << shape(b).width | value(b),
            Node::Cast(a) => value(a),
            Node::Read(memory, address) => {
                let words = &self.memories[memory];
                words.get(value(address) as usize).copied().unwrap_or(0)
            }
        }
    }

    fn signal(&self, index: usize) -> u64 {
        let signal = &self.module.signals[index];
        match (signal.owner, signal.role) {
            (Some((instance, inner)), _) => self.children[instance].signal(inner),
            (None, Role::Register) => self.registers[index],
            (None, Role::Net) => self.nodes[signal.driver.expect("a net is driven")],
            (None, Role::Input) => {
                let inputs = self.module.signals[..index].iter();
                self.inputs[inputs.filter(|signal| signal.role == Role::Input).count()]
            }
        }
    }

    /// The edge, with a reset or without.
    pub fn edge(&mut self, reset: bool) {
        let before = self.registers.clone();
        for (index, signal) in self.module.signals.iter().enumerate() {
            if signal.role == Role::Register && signal.owner.is_none() {
                let next = signal.driver.map_or(before[index], |id| self.nodes[id]);
                self.registers[index] = if reset { signal.power_on } else { next };
            }
        }
        let memories = self.module.memories.iter().zip(&mut self.memories);
        for (memory, words) in memories.filter(|(memory, _)| !memory.inner) {
            match memory.port {
                Port::Ram {
                    enable,
                    address,
                    data,
                } if self.nodes[enable] == 1 => {
                    words[self.nodes[address] as usize] = self.nodes[data];
                }
                Port::Shift { enable, data } if self.nodes[enable] == 1 => {
                    words.rotate_right(1);
                    words[0] = self.nodes[data];
                }
                _ => {}
            }
        }
        for child in &mut self.children {
            child.edge(reset);
        }
    }

    /// The paths of every signal and of every word of a memory, joined by `_`.
    pub fn names(&self, around: &str) -> Vec<String> {
        let mut names = Vec::new();
        let module = self.module;
        let own = module
            .signals
            .iter()
            .filter(|signal| signal.owner.is_none());
        names.extend(own.map(|signal| format!("{around}_{}", signal.name)));
        for (name, label, words) in self.shown_memories() {
            names.extend((0..words.len()).map(|index| format!("{around}_{name}_{label}{index}")));
        }
        for (child, instance) in module.instances.iter().zip(&self.children) {
            names.extend(instance.names(&format!("{around}_{}", child.name)));
        }
        names
    }

    /// Their values, in the same order, behind what is there.
    pub fn values(&self, values: &mut Vec<u64>) {
        let own = self.module.signals.iter().enumerate();
        let own = own.filter(|(_, signal)| signal.owner.is_none());
        values.extend(own.map(|(index, _)| self.signal(index)));
        for (_, _, words) in self.shown_memories() {
            values.extend(words);
        }
        for instance in &self.children {
            instance.values(values);
        }
    }

    /// Name, label of a word and words of each memory that is signals, which a ROM is not.
    fn shown_memories(&self) -> impl Iterator<Item = (&str, &str, &[u64])> {
        let memories = self.module.memories.iter().zip(&self.memories);
        let shown = memories.filter(|(memory, _)| !memory.inner && !memory.name.starts_with("rom"));
        shown.map(|(memory, words)| {
            let label = match memory.port {
                Port::Shift { .. } => "stage",
                _ => "word",
            };
            (&memory.name[..], label, &words[..])
        })
    }
}
